//! What a row of numbers stands for.

use kdray::Ray;

/// Something that queries are about, read from a row of numbers.
pub(crate) trait Row: Copy + Send + Sync {
    /// One of them, in words.
    const ONE: &'static str;
    /// Several of them.
    const MANY: &'static str;
    /// How many numbers there may be in a row.
    const WIDTHS: &'static [usize];
    /// The shapes of arrays of them.
    const SHAPES: &'static str;
    /// What to write in a line.
    const NUMBERS: &'static str;
    /// What those do that count as hits: see [`Answer::is_hit`](super::super::Answer::is_hit).
    const HIT: &'static str;
    /// What is said of those with a [`problem`](Self::problem).
    const IF_BAD: &'static str;

    /// From as many numbers as one of the widths.
    fn of(row: &[f64]) -> Self;

    /// Why it has no answer.
    fn problem(&self) -> Option<String>;
}

impl Row for Ray {
    const ONE: &'static str = "ray";
    const MANY: &'static str = "rays";
    const WIDTHS: &'static [usize] = &[6, 8];
    const SHAPES: &'static str = "N x 6 (origin, direction) or N x 8 (and t_min, t_max)";
    const NUMBERS: &'static str = "6 (origin, direction) or 8 (and t_min, t_max)";
    const HIT: &'static str = "hit";
    const IF_BAD: &'static str = "cannot be traced and count as misses";

    fn of(row: &[f64]) -> Self {
        let ray = Self::new([row[0], row[1], row[2]], [row[3], row[4], row[5]]);
        match row {
            [.., t_min, t_max] if row.len() == 8 => ray.with_interval(*t_min, *t_max),
            _ => ray,
        }
    }

    fn problem(&self) -> Option<String> {
        self.check().err().map(|error| error.to_string())
    }
}

/// A point.
impl Row for [f64; 3] {
    const ONE: &'static str = "point";
    const MANY: &'static str = "points";
    const WIDTHS: &'static [usize] = &[3];
    const SHAPES: &'static str = "N x 3 (x, y, z)";
    const NUMBERS: &'static str = "3 (x, y, z)";
    const HIT: &'static str = "are inside or on the surface";
    const IF_BAD: &'static str = "are not finite and have no answer";

    fn of(row: &[f64]) -> Self {
        [row[0], row[1], row[2]]
    }

    fn problem(&self) -> Option<String> {
        let is_finite = self.iter().all(|x| x.is_finite());
        (!is_finite).then(|| "a coordinate is infinite or NaN; give finite ones".to_owned())
    }
}
