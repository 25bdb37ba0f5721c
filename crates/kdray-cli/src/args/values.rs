//! Values with commas, crosses and dots: `x,y,z`, `WxH` and `a..b`.

use kdray_render::{Crop, PngDepth};
use std::{ops::Range, str::FromStr};

/// The most pixels of a picture.
const MAX_PIXELS: usize = 1 << 28;

/// The size of a picture in pixels; neither is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    /// Pixels across.
    pub(crate) width: usize,
    /// Pixels down.
    pub(crate) height: usize,
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (width, height) = text
            .split_once(['x', 'X'])
            .and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)))
            .ok_or("give width and height in pixels, such as 960x540")?;
        match usize::checked_mul(width, height) {
            Some(0) => Err("a picture needs at least one pixel across and one down".to_owned()),
            Some(1..=MAX_PIXELS) => Ok(Self { width, height }),
            _ => Err(format!("a picture may have {MAX_PIXELS} pixels at most")),
        }
    }
}

/// Reads `N` finite numbers with commas between them.
pub(crate) fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let Ok(parts) = <[&str; N]>::try_from(parts) else {
        return Err(format!("give {N} numbers with commas between them"));
    };
    let mut values = [0.0_f64; N];
    for (value, part) in values.iter_mut().zip(parts) {
        *value = part.parse().map_err(|_| format!("`{part}` is not a number"))?;
        if !value.is_finite() {
            return Err(format!("`{part}` is not a finite number"));
        }
    }
    Ok(values)
}

/// Reads a colour, `r,g,b`: three numbers of which none is negative.
pub(crate) fn color(text: &str) -> Result<[f32; 3], String> {
    let values = numbers::<3>(text)?;
    if values.iter().any(|&value| value < 0.0 || value > f32::MAX.into()) {
        return Err("give three numbers from 0, such as 0.2,0.4,1".to_owned());
    }
    Ok(values.map(|value| value as f32))
}

/// Reads a rectangle of pixels, `x,y,WxH`.
pub(crate) fn crop(text: &str) -> Result<Crop, String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let place = |part: &str| part.parse::<usize>().ok();
    let form = || "give the upper left pixel and the size, such as 0,270,480x270".to_owned();
    let [x, y, size] = parts[..] else { return Err(form()) };
    let (x, y) = place(x).zip(place(y)).ok_or_else(form)?;
    let Size { width, height } = size.parse()?;
    Ok(Crop { x, y, width, height })
}

/// Reads a range of samples, `a..b`, that is not empty.
pub(crate) fn sample_range(text: &str) -> Result<Range<u32>, String> {
    let range = text.split_once("..").and_then(|(start, end)| {
        Some(start.trim().parse::<u32>().ok()?..end.trim().parse::<u32>().ok()?)
    });
    let form = "give the first sample and the one behind the last, such as 0..8";
    range.filter(|range| !range.is_empty()).ok_or_else(|| form.to_owned())
}

/// Reads a number of bytes, such as `8GiB` or `500MB`.
pub(crate) fn bytes(text: &str) -> Result<u64, String> {
    let explained = || format!("`{text}` is no size; give one such as 8GiB or 500MB");
    let end = text.find(|c: char| c != '.' && !c.is_ascii_digit()).unwrap_or(text.len());
    let unit = match text[end..].trim().to_ascii_lowercase().as_str() {
        "" | "b" => 1,
        "kb" => 1000,
        "mb" => 1_000_000,
        "gb" => 1_000_000_000,
        "tb" => 1_000_000_000_000,
        "k" | "kib" => 1 << 10,
        "m" | "mib" => 1 << 20,
        "g" | "gib" => 1 << 30,
        "t" | "tib" => 1 << 40,
        _ => return Err(explained()),
    };
    if let Ok(number) = text[..end].parse::<u64>() {
        return number.checked_mul(unit).ok_or_else(explained);
    }
    let number: f64 = text[..end].parse().map_err(|_| explained())?;
    let bytes = number * unit as f64;
    if bytes < u64::MAX as f64 { Ok(bytes as u64) } else { Err(explained()) }
}

/// Reads a number above zero.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    let [value] = numbers::<1>(text).map_err(|_| "give a number above zero".to_owned())?;
    if value > 0.0 { Ok(value) } else { Err("give a number above zero".to_owned()) }
}

/// The same for one of 32 bits.
pub(crate) fn positive_f32(text: &str) -> Result<f32, String> {
    let value = positive(text)? as f32;
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err("give a number of 32 bits".into())
    }
}

/// Reads an angle of view in degrees.
pub(crate) fn field_of_view(text: &str) -> Result<f64, String> {
    let degrees = positive(text).ok().filter(|degrees| *degrees < 180.0);
    degrees.ok_or_else(|| "give degrees between 0 and 180".to_owned())
}

/// Reads bits a channel.
pub(crate) fn bits(text: &str) -> Result<PngDepth, String> {
    match text {
        "8" => Ok(PngDepth::Eight),
        "16" => Ok(PngDepth::Sixteen),
        _ => Err("give 8 or 16".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_two_sides() {
        assert_eq!("3x2".parse(), Ok(Size { width: 3, height: 2 }));
        for bad in ["", "3", "3x", "0x2", "2x0", "-1x2", "3.5x2", "99999999x99999999"] {
            assert!(bad.parse::<Size>().is_err(), "{bad}");
        }
    }

    #[test]
    fn crops_have_a_place_and_a_size() {
        assert_eq!(crop("1, 2,3x4"), Ok(Crop { x: 1, y: 2, width: 3, height: 4 }));
        for bad in ["", "1,2", "1,2,3", "1,2,3x", "-1,2,3x4", "1,2,0x4", "1,2,3x4,5", "1.5,2,3x4"] {
            assert!(crop(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn ranges_of_samples_are_not_empty() {
        assert_eq!(sample_range("3..7"), Ok(3..7));
        for bad in ["", "3", "..", "3..", "..7", "7..7", "7..3", "3..=7", "-1..2", "3-7"] {
            assert!(sample_range(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn bytes_have_units() {
        let most = u64::MAX.to_string();
        for (text, number) in [("16GiB", 1 << 34), ("1.5 kB", 1500), ("7", 7), (&most, u64::MAX)] {
            assert_eq!(bytes(text), Ok(number), "{text}");
        }
        for bad in ["", "GiB", "-1GB", "none", "1.2.3", "18446744073709551616KiB"] {
            assert!(bytes(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn ranges_of_numbers_are_kept() {
        assert_eq!(
            (positive("1e-3"), positive_f32("2"), field_of_view("90")),
            (Ok(0.001), Ok(2.0), Ok(90.0))
        );
        for bad in ["0", "-1", "nan", "inf", "x", ""] {
            assert!(positive(bad).is_err() && field_of_view(bad).is_err(), "{bad}");
        }
        assert!(positive_f32("1e39").is_err() && positive_f32("1e-60").is_err());
        assert!(field_of_view("180").is_err());
    }

    #[test]
    fn triples_are_three_finite_numbers() {
        assert_eq!(numbers("-1, 2.5,3e-2"), Ok([-1.0, 2.5, 0.03]));
        for bad in ["", "1,2", "1,2,3,4", "1,two,3", "1,nan,3", "1,2,inf"] {
            assert!(numbers::<3>(bad).is_err(), "{bad}");
        }
    }
}
