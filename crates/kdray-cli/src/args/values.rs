//! Values with commas and crosses: `x,y,z` and `WxH`.

use std::str::FromStr;

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
    fn triples_are_three_finite_numbers() {
        assert_eq!(numbers("-1, 2.5,3e-2"), Ok([-1.0, 2.5, 0.03]));
        for bad in ["", "1,2", "1,2,3,4", "1,two,3", "1,nan,3", "1,2,inf"] {
            assert!(numbers::<3>(bad).is_err(), "{bad}");
        }
    }
}
