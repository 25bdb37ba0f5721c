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
    fn triples_are_three_finite_numbers() {
        assert_eq!(numbers("-1, 2.5,3e-2"), Ok([-1.0, 2.5, 0.03]));
        for bad in ["", "1,2", "1,2,3,4", "1,two,3", "1,nan,3", "1,2,inf"] {
            assert!(numbers::<3>(bad).is_err(), "{bad}");
        }
    }
}
