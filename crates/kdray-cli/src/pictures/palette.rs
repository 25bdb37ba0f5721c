//! Colours that people with any colour vision can tell apart (Okabe and Ito 2008).

pub(crate) const BLACK: &str = "#1a1a1a";
pub(crate) const GREY: &str = "#767676";
pub(crate) const PALE: &str = "#d4d4d4";
pub(crate) const WHITE: &str = "#ffffff";
pub(crate) const ORANGE: &str = "#e69f00";
pub(crate) const SKY: &str = "#56b4e9";
pub(crate) const GREEN: &str = "#009e73";
pub(crate) const BLUE: &str = "#0072b2";
pub(crate) const VERMILION: &str = "#d55e00";

/// A leaf that a ray visits.
pub(crate) const VISITED: &str = "#fbd78f";

/// A leaf in which a packet had nothing to test.
pub(crate) const PASSED: &str = "#a5d3f0";

/// What the bound of a packet left out in one decision.
pub(crate) const LEFT_OUT: &str = "#e3eff8";

/// The colours of the axes x, y and z, and so of the planes perpendicular to them.
pub(crate) const AXES: [&str; 3] = [VERMILION, GREEN, BLUE];

/// The names of the axes.
pub(crate) const AXIS_NAMES: [&str; 3] = ["x", "y", "z"];

/// From which number of primitives on a leaf has which shade.
const SHADES: [(usize, &str); 6] =
    [(0, WHITE), (1, "#efeaf5"), (2, "#d9cfe8"), (4, "#bda9d6"), (8, "#9d80c0"), (16, "#7a569f")];

/// The colour of a leaf with so many primitives.
pub(crate) fn leaf_shade(primitives: usize) -> &'static str {
    SHADES.iter().rev().find(|(from, _)| primitives >= *from).map_or(WHITE, |(_, color)| color)
}

/// What the shades of leaves mean: colours and the numbers of primitives they stand for.
pub(crate) fn leaf_shades() -> impl Iterator<Item = (&'static str, String)> {
    SHADES.iter().enumerate().map(|(i, &(from, color))| {
        let label = match SHADES.get(i + 1) {
            None => format!("≥ {from}"),
            Some(&(next, _)) if next == from + 1 => from.to_string(),
            Some(&(next, _)) => format!("{from}–{}", next - 1),
        };
        (color, label)
    })
}

/// A colour for a depth in the tree of at most `max` (viridis, from its bright end).
pub(crate) fn depth_color(depth: u32, max: u32) -> String {
    const STOPS: [[f64; 3]; 5] = [
        [253.0, 231.0, 37.0],
        [94.0, 201.0, 98.0],
        [33.0, 145.0, 140.0],
        [59.0, 82.0, 139.0],
        [68.0, 1.0, 84.0],
    ];
    let place = f64::from(depth) / f64::from(max.max(1)) * (STOPS.len() - 1) as f64;
    let low = (place as usize).min(STOPS.len() - 2);
    let share = place - low as f64;
    let [r, g, b] = std::array::from_fn(|i| {
        (STOPS[low][i] + share * (STOPS[low + 1][i] - STOPS[low][i])).round() as u8
    });
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shades_cover_all_numbers() {
        let labels: Vec<String> = leaf_shades().map(|(_, label)| label).collect();
        assert_eq!(labels, ["0", "1", "2–3", "4–7", "8–15", "≥ 16"]);
        assert_eq!((leaf_shade(0), leaf_shade(3), leaf_shade(4)), (WHITE, "#d9cfe8", "#bda9d6"));
        assert_eq!(leaf_shade(1_000_000), "#7a569f");
    }

    #[test]
    fn depths_run_from_yellow_to_purple() {
        assert_eq!(
            (depth_color(0, 4).as_str(), depth_color(4, 4).as_str()),
            ("#fde725", "#440154")
        );
        assert_eq!(depth_color(0, 0), "#fde725");
    }
}
