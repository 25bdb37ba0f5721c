//! Where a line passes a ball.

use super::{Ray, power_of_two_below};

/// The part of a line inside a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Chord {
    /// Where the line enters and where it leaves; NaN if the numbers are beyond what f64 holds.
    /// Far from the ball the two may round to one.
    pub(crate) t: [f64; 2],
    /// Whether the line only touches the ball.
    pub(crate) is_tangent: bool,
}

/// Where the line of `ray` meets the sphere of `radius` around `center`; `None` if it passes by.
///
/// Solves |E + D·t − center|² = radius² from the point of the line nearest to the centre, where the
/// quadratic has no linear term to cancel with. Lengths and D are scaled to about one first, by
/// powers of two, so that no square over- or underflows.
pub(crate) fn chord<const K: usize>(ray: &Ray<K>, center: &[f64; K], radius: f64) -> Option<Chord> {
    let from_center: [f64; K] = std::array::from_fn(|k| ray.origin[k] - center[k]);
    let unit = magnitude(largest(&from_center).max(radius));
    let speed = magnitude(largest(&ray.direction));
    let (e, d) = (from_center.map(|x| x / unit), ray.direction.map(|x| x / speed));
    let radius = radius / unit;
    let length_squared = dot(&d, &d);
    let t_nearest = -dot(&e, &d) / length_squared;
    let nearest: [f64; K] = std::array::from_fn(|k| e[k] + t_nearest * d[k]);
    let half_squared = (radius * radius - dot(&nearest, &nearest)) / length_squared;
    if half_squared < 0.0 {
        return None;
    }
    let half = half_squared.sqrt();
    let t = [t_nearest - half, t_nearest + half].map(|t| t * unit / speed);
    Some(Chord { t, is_tangent: half_squared == 0.0 })
}

fn dot<const K: usize>(a: &[f64; K], b: &[f64; K]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn largest<const K: usize>(v: &[f64; K]) -> f64 {
    v.iter().fold(0.0, |largest, x| x.abs().max(largest))
}

/// The power of two that x is one to two times, for x not below the smallest normal number.
fn magnitude(x: f64) -> f64 {
    power_of_two_below(x.max(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_through_the_middle_is_inside_for_the_diameter() {
        let ray = Ray::new([0.0; 3], [0.0, 0.0, 0.5]);
        let met =
            |x, z, radius| chord(&ray, &[x, 0.0, z], radius).map(|met| (met.t, met.is_tangent));
        assert_eq!(met(0.0, 5.0, 2.0), Some(([6.0, 14.0], false)));
        assert_eq!(met(2.0, 5.0, 2.0), Some(([10.0, 10.0], true)));
        assert_eq!(met(2.1, 5.0, 2.0), None);
        assert_eq!(met(0.0, 0.0, 0.0), Some(([0.0, 0.0], true)));
    }

    #[test]
    fn directions_and_distances_of_any_size_are_met() {
        for exponent in [-1000, -520, 0, 520, 1000] {
            let scale = 2.0_f64.powi(exponent);
            let ray = Ray::new([0.0; 3], [0.0, scale, scale]);
            let [enter, leave] = chord(&ray, &[0.0, 5.0, 5.0], 1.0).unwrap().t;
            let half = 0.5_f64.sqrt();
            assert!(((5.0 - half) / scale / enter - 1.0).abs() < 1e-15, "2^{exponent}");
            assert!(((5.0 + half) / scale / leave - 1.0).abs() < 1e-15, "2^{exponent}");
            let ray = Ray::new([0.0, 0.0, -scale], [0.0, 0.0, 1.0]);
            let met = chord(&ray, &[0.0; 3], 0.5 * scale).unwrap();
            assert_eq!(met.t, [0.5 * scale, 1.5 * scale], "2^{exponent}");
        }
    }
}
