//! Polygons into triangles that keep the polygon's outline exactly.

use earcut::Earcut;
use glam::{DVec2, DVec3};

/// Above this many corners a concave polygon is refused: ear cutting can take quadratic time.
pub(crate) const MAX_CONCAVE_CORNERS: usize = 1 << 14;

/// A concave polygon has more than [`MAX_CONCAVE_CORNERS`] corners.
#[derive(Debug, PartialEq)]
pub(crate) struct TooManyCorners;

/// Splits polygons. Keeps its memory from one to the next.
pub(crate) struct Triangulator {
    earcut: Earcut<f64>,
    flat: Vec<[f64; 2]>,
}

impl Triangulator {
    pub(crate) fn new() -> Self {
        Self { earcut: Earcut::new(), flat: Vec::new() }
    }

    /// Puts triangles of corner numbers into `out`, wound as the polygon is.
    ///
    /// The polygon is seen along the largest axis of its Newell normal, which changes no
    /// coordinate. Convex ones become a fan, concave ones are cut by ears (the `earcut` crate).
    /// In every case the directed edges of the triangles, less those met in both directions, are
    /// the polygon's own: no corner is lost, so that closed meshes stay closed.
    pub(crate) fn split(
        &mut self,
        points: &[[f32; 3]],
        out: &mut Vec<[u32; 3]>,
    ) -> Result<(), TooManyCorners> {
        out.clear();
        if points.len() <= 3 {
            fan(points.len(), out);
            return Ok(());
        }
        self.flat.clear();
        let [i, j] = axes_across(newell_normal(points));
        self.flat.extend(points.iter().map(|p| [f64::from(p[i]), f64::from(p[j])]));
        if is_convex(&self.flat) {
            fan(points.len(), out);
        } else if points.len() > MAX_CONCAVE_CORNERS {
            return Err(TooManyCorners);
        } else {
            self.cut_ears(out);
        }
        Ok(())
    }

    fn cut_ears(&mut self, out: &mut Vec<[u32; 3]>) {
        let mut indices: Vec<u32> = Vec::new();
        self.earcut.earcut_slice(&self.flat, &[], &mut indices);
        out.extend(indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]));
        let counter_clockwise = |t: &[u32; 3]| turn(&self.flat, t.map(|i| i as usize)) >= 0.0;
        for triangle in out.iter_mut() {
            if !counter_clockwise(triangle) {
                triangle.swap(1, 2);
            }
        }
        add_lost_corners(self.flat.len(), out);
        if !outline_is_kept(self.flat.len(), out) {
            out.clear();
            fan(self.flat.len(), out);
        }
    }
}

fn fan(corners: usize, out: &mut Vec<[u32; 3]>) {
    out.extend((2..corners as u32).map(|i| [0, i - 1, i]));
}

/// The normal of a polygon, twice its area in length (Newell; Sutherland, Sproull & Schumacker
/// 1974).
fn newell_normal(points: &[[f32; 3]]) -> DVec3 {
    let point = |i: usize| DVec3::from(points[i % points.len()].map(f64::from));
    let origin = point(0);
    (0..points.len()).map(|i| (point(i) - origin).cross(point(i + 1) - origin)).sum()
}

/// The two axes besides the normal's largest, in the order in which the polygon turns left.
fn axes_across(normal: DVec3) -> [usize; 2] {
    let size = normal.abs();
    let k = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let [i, j] = [(k + 1) % 3, (k + 2) % 3];
    if normal[k] < 0.0 { [j, i] } else { [i, j] }
}

/// Twice the signed area of the triangle of three corners.
fn turn(flat: &[[f64; 2]], [a, b, c]: [usize; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(|i| DVec2::from(flat[i]));
    (b - a).perp_dot(c - b)
}

/// No corner turns right, and the outline goes around once: it changes its direction along the
/// first axis twice.
fn is_convex(flat: &[[f64; 2]]) -> bool {
    let n = flat.len();
    let left = (0..n).all(|i| turn(flat, [i, (i + 1) % n, (i + 2) % n]) >= 0.0);
    left && (0..2).all(|axis| {
        let steps = (0..n).map(|i| flat[(i + 1) % n][axis] - flat[i][axis]);
        let directions: Vec<bool> = steps.filter(|&d| d != 0.0).map(|d| d > 0.0).collect();
        let last = directions.last().copied();
        let changes = directions.iter().zip(last.iter().chain(&directions));
        changes.filter(|(now, before)| now != before).count() <= 2
    })
}

/// Ear cutting passes over corners on straight lines; gives each run of them a fan of (nearly) flat
/// triangles, which join the outline to the edge that replaced it.
fn add_lost_corners(corners: usize, out: &mut Vec<[u32; 3]>) {
    let mut used = vec![false; corners];
    out.iter().flatten().for_each(|&corner| used[corner as usize] = true);
    let kept: Vec<usize> = (0..corners).filter(|&i| used[i]).collect();
    for (position, &first) in kept.iter().enumerate() {
        let next = kept.get(position + 1).copied().unwrap_or(kept[0] + corners);
        for corner in first + 1..next {
            let [a, b, c] = [first, corner, corner + 1].map(|i| (i % corners) as u32);
            out.push([a, b, c]);
        }
    }
}

/// The directed edges of the triangles cancel to the polygon's.
fn outline_is_kept(corners: usize, triangles: &[[u32; 3]]) -> bool {
    let n = corners as u32;
    let outline = (0..n).map(|i| ((i + 1) % n, i));
    let edges = triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let mut net: Vec<(u32, u32, i32)> =
        outline.chain(edges).map(|(a, b)| if a < b { (a, b, 1) } else { (b, a, -1) }).collect();
    net.sort_unstable();
    net.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1))
        .all(|same| same[0].0 == same[0].1 || same.iter().map(|edge| edge.2).sum::<i32>() == 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(points: &[[f32; 3]]) -> Vec<[u32; 3]> {
        let mut out = Vec::new();
        Triangulator::new().split(points, &mut out).unwrap();
        out
    }

    fn area(points: &[[f32; 3]], triangles: &[[u32; 3]]) -> (f64, f64) {
        let normal = newell_normal(points);
        let mut sum = (0.0, 0.0);
        for triangle in triangles {
            let corners = triangle.map(|i| points[i as usize]);
            let part = newell_normal(&corners);
            sum.0 += part.dot(normal.normalize_or_zero()) / 2.0;
            sum.1 += part.length() / 2.0;
        }
        sum
    }

    /// Checks that the triangles tile the polygon: same area, none turned over, outline kept.
    fn check(points: &[[f32; 3]], expected_area: f64) {
        for turned in [false, true] {
            let mut points = points.to_vec();
            if turned {
                points.reverse();
            }
            let triangles = split(&points);
            assert!(outline_is_kept(points.len(), &triangles), "{points:?} {triangles:?}");
            let (signed, total) = area(&points, &triangles);
            assert!((signed - expected_area).abs() < 1e-6, "{signed} of {points:?} {triangles:?}");
            assert!((total - expected_area).abs() < 1e-6, "{total} of {points:?} {triangles:?}");
        }
    }

    /// The points in four planes, among them one that is not axis-aligned.
    fn check_everywhere(flat: &[[f32; 2]], expected_area: f64) {
        let in_planes: [fn(&[f32; 2]) -> [f32; 3]; 3] =
            [|p| [p[0], p[1], 3.0], |p| [p[1], -2.0, p[0]], |p| [5.0, p[0], p[1]]];
        for place in in_planes {
            check(&flat.iter().map(place).collect::<Vec<_>>(), expected_area);
        }
        let slanted: Vec<_> = flat.iter().map(|p| [p[0], p[1], p[0] + p[1]]).collect();
        check(&slanted, expected_area * 3f64.sqrt());
    }

    #[test]
    fn convex_and_concave_polygons_keep_their_area() {
        check_everywhere(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]], 2.0);
        check_everywhere(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 1.0], [0.0, 4.0]], 10.0);
        let comb: Vec<[f32; 2]> = (0..40)
            .map(|i| [i as f32, [0.0, 5.0][i % 2]])
            .chain([[39.0, 9.0], [0.0, 9.0]])
            .collect();
        check_everywhere(&comb, f64::from(39 * 9) - 0.5 * 39.0 * 5.0);
    }

    #[test]
    fn corners_on_straight_edges_are_kept() {
        // An L with an extra corner in the middle of each edge.
        let l = [[0, 0], [2, 0], [4, 0], [4, 1], [4, 2], [3, 2], [2, 2], [2, 3], [2, 4], [1, 4]];
        let mut l: Vec<[f32; 2]> = l.iter().map(|p| p.map(|x| x as f32)).collect();
        l.extend([[0.0, 4.0], [0.0, 2.0]]);
        check_everywhere(&l, 12.0);
    }

    #[test]
    fn a_hole_joined_by_a_bridge_is_kept_open() {
        let ring = [[0, 0], [6, 0], [6, 6], [0, 6], [0, 0], [2, 2], [2, 4], [4, 4], [4, 2], [2, 2]];
        let ring: Vec<[f32; 2]> = ring.iter().map(|p| p.map(|x| x as f32)).collect();
        check_everywhere(&ring, 32.0);
    }

    #[test]
    fn hopeless_polygons_keep_their_outline() {
        let hopeless: [&[[f32; 3]]; 5] = [
            &[[0.0; 3]; 5],
            &[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]],
            &[[0.0; 3], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            &[[0.0; 3], [4.0, 3.0, 0.0], [-1.0, 3.0, 0.0], [3.0, 0.0, 0.0], [1.0, 5.0, 0.0]],
            &[[f32::MAX; 3], [f32::MIN; 3], [f32::MAX, 0.0, 1.0], [0.0, f32::MIN, 9.0]],
        ];
        for points in hopeless {
            assert!(outline_is_kept(points.len(), &split(points)), "{points:?}");
        }
        assert!(split(&[[0.0; 3], [1.0; 3]]).is_empty());
    }

    #[test]
    fn endless_outlines_are_refused() {
        let zigzag: Vec<[f32; 3]> =
            (0..=MAX_CONCAVE_CORNERS).map(|i| [i as f32, (i % 2) as f32, 0.0]).collect();
        assert_eq!(Triangulator::new().split(&zigzag, &mut Vec::new()), Err(TooManyCorners));
    }
}
