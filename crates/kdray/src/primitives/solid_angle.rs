//! How large a triangle looks from a point.

use crate::exact::{Scaled, cross_component, side_of_plane, volume};
use crate::geometry::inverse_power_of_two;
use glam::DVec3;
use std::cmp::Ordering;
use std::f64::consts::PI;
use std::ops::Range;

/// Products of three shorter or longer lengths may under- or overflow; of these, the squares.
const SQUARES: Range<f64> = 1e-200..1e200;

/// From here on a quarter of a way stands for it: 2^1000.
const LONGEST: f64 = f64::from_bits((1023 + 1000) << 52);

/// Beside an edge, where numerator and denominator of the tangent are smaller than this, in units of the product of
/// the lengths that each is made of, they have lost too many digits: they are off by some 2^-50 of it.
const BESIDE_EDGE: f64 = 1.0 / (1_u64 << 20) as f64;

/// The solid angle that a triangle covers seen from `point`, as a share of the whole sphere:
/// positive from behind, negative from the front, zero in the triangle's plane.
///
/// Van Oosterom and Strackee's formula (1983). Where a quarter of the sphere or more is covered, near a
/// triangle, the share leaps from a half to minus a half at the plane: there its sign is exact, and it is zero in
/// the plane exactly, for the side that the point is on is decided without rounding. So it is close to an edge, where
/// all shares meet. Farther away it goes through zero without a leap, and in the plane may be off by rounding, either way.
pub fn solid_angle(point: [f64; 3], corners: [[f64; 3]; 3]) -> f64 {
    let mut ways = corners.map(|corner| way(point, corner).0);
    let in_range = |way: &DVec3| SQUARES.contains(&way.length_squared());
    if !ways.iter().all(in_range) {
        // How far away corners are does not matter.
        ways = ways.map(|way| scaled(way).0.normalize_or_zero());
    }
    let [a, b, c] = ways;
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let volume = a.dot(b.cross(c));
    let product = la * lb * lc;
    let below = product + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    let is_beside_edge = volume.abs().max(below.abs()) < BESIDE_EDGE * product;
    let share = if is_beside_edge { beside_edge(point, corners) } else { share(volume, below) };
    if below > BESIDE_EDGE * product {
        return share;
    }
    match side_of_plane(point, corners) {
        Ordering::Equal => 0.0,
        Ordering::Less => share.abs(),
        Ordering::Greater => -share.abs(),
    }
}

/// The way from one point to another, or a quarter of it if it may be too long; and by which power of two it was
/// divided.
fn way(from: [f64; 3], to: [f64; 3]) -> (DVec3, i32) {
    let (from, to) = (DVec3::from(from), DVec3::from(to));
    let way = to - from;
    if way.abs().max_element() < LONGEST { (way, 0) } else { (0.25 * to - 0.25 * from, 2) }
}

/// A vector times a power of two, by which its largest component is one to two, or for the smallest numbers less;
/// and that power.
fn scaled(way: DVec3) -> (DVec3, f64) {
    let factor = inverse_power_of_two(way.abs().max_element());
    (way * factor, factor)
}

/// Half the angle, over pi, from what its tangent is the quotient of. A quarter of the sphere is covered where
/// `below` is zero.
fn share(volume: f64, below: f64) -> f64 {
    volume.atan2(below) / (2.0 * PI)
}

/// The share of a triangle, up to its sign, for a point so close to an edge that all digits of `volume` and of `below`
/// cancel.
///
/// Seen from there, the ends of that edge are a and b in nearly opposite directions, of length one here like c. What
/// is small in both is m = a x b. As a + b = 2·((b − a) x m) / |b − a|², below = (m · m + (c x b) · m − (c x a) · m) / (1 − a · b);
/// and volume = c · m. The cross products and the volume are summed without rounding, from the corners as they are; what
/// cancels in the dot products is small beside the volume. Of several edges as close, in a thin triangle, the closest is taken.
#[cold]
fn beside_edge(point: [f64; 3], corners: [[f64; 3]; 3]) -> f64 {
    let ends = corners.map(|corner| End::of(point, corner));
    let edge = |i: usize| [ends[i], ends[(i + 1) % 3], ends[(i + 2) % 3]];
    let opposite = [0, 1, 2].map(edge).into_iter().filter(|[a, b, _]| a.way.dot(b.way) < 0.0);
    let crossed = opposite.filter_map(|[a, b, c]| Some((Crossed::of(point, a, b)?, [a, b, c])));
    let closest = crossed.min_by(|(one, _), (other, _)| one.size.total_cmp(&other.size));
    // On the edge itself it is nothing.
    closest.map_or(0.0, |(Crossed { way: m, size, largest }, [a, b, c])| {
        let with_c = |end| {
            Crossed::of(point, c, end).map_or(0.0, |crossed| crossed.size * crossed.way.dot(m))
        };
        let below = (size * m.dot(m) + with_c(b) - with_c(a)) / (1.0 - a.way.dot(b.way));
        let volume = volume(point, corners).value().divided_by(times(largest, c.length));
        share(volume, below)
    })
}

/// A corner as seen from a point.
#[derive(Clone, Copy)]
struct End {
    corner: [f64; 3],
    /// The way there, made one long; zero if it is none.
    way: DVec3,
    /// How long that was.
    length: Scaled,
}

impl End {
    fn of(point: [f64; 3], corner: [f64; 3]) -> Self {
        let (way, divided) = way(point, corner);
        let (way, factor) = scaled(way);
        let exponent = divided - exponent_of_power_of_two(factor);
        let length = Scaled { mantissa: way.length(), exponent };
        Self { corner, way: way.normalize_or_zero(), length }
    }
}

/// a x b of the ways to two corners.
struct Crossed {
    /// Such that its largest component is one. Each errs by some units in its last place.
    way: DVec3,
    /// That component.
    largest: Scaled,
    /// The same, if both ways were of length one.
    size: f64,
}

impl Crossed {
    /// `None` if it is zero.
    fn of(point: [f64; 3], a: End, b: End) -> Option<Self> {
        let component = |axes| cross_component(point, a.corner, b.corner, axes).value();
        let components = [(1, 2), (2, 0), (0, 1)].map(component);
        let others = components.into_iter().filter(|it| it.mantissa != 0.0);
        let abs = |it: Scaled| Scaled { mantissa: it.mantissa.abs(), ..it };
        let by_size = |a: &Scaled, b: &Scaled| {
            a.exponent.cmp(&b.exponent).then(a.mantissa.total_cmp(&b.mantissa))
        };
        let largest = others.map(abs).max_by(by_size)?;
        let way = components.map(|it| it.divided_by(largest)).into();
        Some(Self { way, largest, size: largest.divided_by(times(a.length, b.length)) })
    }
}

fn times(a: Scaled, b: Scaled) -> Scaled {
    Scaled { mantissa: a.mantissa * b.mantissa, exponent: a.exponent + b.exponent }
}

/// That of a normal number that is one.
fn exponent_of_power_of_two(power: f64) -> i32 {
    (power.to_bits() >> 52) as i32 - 1023
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    #[test]
    fn an_octant_is_an_eighth() {
        assert!((solid_angle([0.0; 3], CORNERS) - 0.125).abs() < 1e-15);
        let turned = [CORNERS[1], CORNERS[0], CORNERS[2]];
        assert!((solid_angle([0.0; 3], turned) + 0.125).abs() < 1e-15);
    }

    #[test]
    fn close_to_the_inside_it_is_half_of_the_sphere_on_either_side() {
        let on = [0.25, 0.25, 0.5];
        assert_eq!(solid_angle(on, CORNERS), 0.0);
        for (z, share) in [(0.5_f64.next_up(), -0.5), (0.5_f64.next_down(), 0.5)] {
            assert!((solid_angle([0.25, 0.25, z], CORNERS) - share).abs() < 1e-12);
        }
    }

    /// A cube whose axes are no axes of f64, with its faces outward.
    fn turned_cube(size: f64) -> Vec<[[f64; 3]; 3]> {
        let [x, y] = [DVec3::new(0.36, 0.48, -0.8), DVec3::new(-0.8, 0.6, 0.0)];
        let corner = |i: usize| {
            let side = |bit: usize| if i & bit == 0 { -size } else { size };
            (side(1) * x + side(2) * y + side(4) * x.cross(y)).to_array()
        };
        let faces =
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let halves = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        halves.map(|half| half.map(corner)).collect()
    }

    /// A tetrahedron outward, of which the first face is thin.
    fn on_a_sliver([a, b, c]: [[f64; 3]; 3], apex: [f64; 3]) -> Vec<[[f64; 3]; 3]> {
        vec![[a, b, c], [a, apex, b], [b, apex, c], [c, apex, a]]
    }

    /// From beside every edge, all of a closed mesh covers the whole sphere or nothing.
    fn assert_whole(mesh: &[[[f64; 3]; 3]], name: &str) {
        let edges = mesh.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        for (edge, number) in edges.zip(1..) {
            for share in [1e-12, 1e-3, f64::from(number) / 37.0] {
                let middle = DVec3::from(edge[0]).lerp(edge[1].into(), share).to_array();
                // From none to three units in the last place aside on each axis.
                for steps in (0..64).step_by(3) {
                    let moved =
                        |k: usize, x: f64| (0..steps >> (2 * k) & 3).fold(x, |x, _| x.next_up());
                    let point = [0, 1, 2].map(|k| moved(k, middle[k]));
                    let sum: f64 = mesh.iter().map(|&side| solid_angle(point, side)).sum();
                    let is_on = mesh.iter().any(|&side| crate::exact::is_on_triangle(point, side));
                    let off = (sum - sum.round()).abs();
                    assert!(is_on || off < 1e-7, "{name}, {edge:?} at {share}, {steps}: {sum}");
                }
            }
        }
    }

    #[test]
    fn closed_meshes_cover_all_or_nothing_beside_edges_too() {
        for size in [1e-300, 1e-170, 1e-30, 1.0, 1e200, 1e307] {
            assert_whole(&turned_cube(size), &format!("{size:e}"));
        }
        let ends = [[0.225, 0.052, -0.726], [-0.338, -0.031, 0.269]].map(DVec3::from);
        for thin in [1e-7, 1e-10, 1e-12, 1e-14, 1e-16] {
            let top = ends[0].lerp(ends[1], 0.6387) + thin * DVec3::new(1.677, 0.9, -0.2007);
            let sliver = [ends[0], ends[1], top].map(|corner| corner.to_array());
            assert_whole(&on_a_sliver(sliver, [-0.18, 0.84, -0.71]), &format!("thin {thin:e}"));
        }
    }

    #[test]
    fn beside_edge_and_corner_it_is_the_share_of_the_angle() {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        for distance in [1e-9, 1e-150, 1e-161, 1e-170, 1e-200, 1e-280, 1e-298] {
            let above = 1e-20 * distance;
            let share = solid_angle([distance, above, above], corners);
            assert!((share + 0.375).abs() < 1e-8, "{distance:e}: {share}");
        }
    }

    #[test]
    fn size_does_not_matter() {
        for scale in [1e-310, 1e-200, 1e-90, 1e90, 1e200, 1e308] {
            let corners = CORNERS.map(|p| p.map(|x| x * scale));
            let share = solid_angle([0.25 * scale; 3], corners);
            assert!(
                (share / solid_angle([0.25; 3], CORNERS) - 1.0).abs() < 1e-12,
                "{scale}: {share}"
            );
        }
    }

    #[test]
    fn what_has_no_area_covers_nothing() {
        let line = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
        for point in [[0.0; 3], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]] {
            assert_eq!(solid_angle(point, line), 0.0, "{point:?}");
        }
        assert_eq!(solid_angle([3.0, 1.0, 0.0], [[1.0, 2.0, 3.0]; 3]), 0.0);
    }
}
