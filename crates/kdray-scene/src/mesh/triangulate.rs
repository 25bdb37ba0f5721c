//! Polygons into triangles that keep the polygon's outline exactly.
//!
//! Ears are cut by hand: the `earcut` crate drops corners on straight edges, which opens closed
//! meshes, and takes cubic time for outlines that overlap themselves.

use glam::{DVec2, DVec3};

/// Above this many corners a concave polygon is refused, for ear cutting takes quadratic time.
pub(crate) const MAX_CONCAVE_CORNERS: usize = 1 << 14;

/// A concave polygon has more than [`MAX_CONCAVE_CORNERS`] corners.
#[derive(Debug, PartialEq)]
pub(crate) struct TooManyCorners;

/// Puts triangles of corner numbers into `out`, wound as the polygon is.
///
/// The polygon is seen along the largest axis of its Newell normal, which changes no coordinate.
/// Convex ones become a fan, concave ones are cut by ears (Meisters 1975). In every case, also for
/// outlines that cross themselves, the directed edges of the triangles, less those met in both
/// directions, are the polygon's own: no corner is lost, so that closed meshes stay closed.
pub(crate) fn triangulate(
    points: &[[f32; 3]],
    out: &mut Vec<[u32; 3]>,
) -> Result<(), TooManyCorners> {
    out.clear();
    if points.len() <= 3 {
        fan(points.len(), out);
        return Ok(());
    }
    let [i, j] = axes_across(newell_normal(points));
    let flat: Vec<[f64; 2]> = points.iter().map(|p| [f64::from(p[i]), f64::from(p[j])]).collect();
    if is_convex(&flat) {
        fan(points.len(), out);
    } else if points.len() > MAX_CONCAVE_CORNERS {
        return Err(TooManyCorners);
    } else {
        Outline::new(&flat).cut_ears(out);
    }
    Ok(())
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

/// What is left of a polygon while ears are cut off.
struct Outline<'a> {
    flat: &'a [[f64; 2]],
    previous: Vec<usize>,
    next: Vec<usize>,
    /// Corners that do not turn left: only they can lie in the way of an ear.
    blockers: Vec<usize>,
    /// Whether a corner is in that list.
    is_blocker: Vec<bool>,
    /// Whether a corner is an ear, as far as known. It changes only with its neighbours.
    ear: Vec<Option<bool>>,
    left: usize,
}

/// How often all corners are looked at anew when none seems to be an ear; needed where outlines
/// touch themselves.
const MAX_RETRIES: usize = 8;

impl<'a> Outline<'a> {
    fn new(flat: &'a [[f64; 2]]) -> Self {
        let n = flat.len();
        let previous: Vec<usize> = (0..n).map(|i| (i + n - 1) % n).collect();
        let next: Vec<usize> = (0..n).map(|i| (i + 1) % n).collect();
        let (blockers, is_blocker) = (Vec::new(), vec![false; n]);
        let ear = vec![None; n];
        let mut outline = Self { flat, previous, next, blockers, is_blocker, ear, left: n };
        (0..n).for_each(|corner| outline.note_blocker(corner));
        outline
    }

    fn triangle_at(&self, corner: usize) -> [usize; 3] {
        [self.previous[corner], corner, self.next[corner]]
    }

    fn turn_at(&self, corner: usize) -> f64 {
        turn(self.flat, self.triangle_at(corner))
    }

    fn cut_ears(&mut self, out: &mut Vec<[u32; 3]>) {
        let (mut corner, mut missed, mut retries) = (0, 0, 0);
        while self.left > 3 {
            let is_ear = match self.ear[corner] {
                Some(known) => known,
                None => self.is_ear(corner),
            };
            self.ear[corner] = Some(is_ear);
            if is_ear {
                // Going on behind the neighbour avoids fans of needles.
                let after = self.next[self.next[corner]];
                self.cut(corner, out);
                (corner, missed) = (after, 0);
                continue;
            }
            corner = self.next[corner];
            missed += 1;
            if missed < self.left {
                continue;
            }
            missed = 0;
            if retries < MAX_RETRIES {
                retries += 1;
                self.ear.fill(None);
            } else if let Some(flat) = self.flat_corner(corner) {
                corner = self.next[flat];
                self.cut(flat, out);
            } else {
                break;
            }
        }
        // One triangle is left; or an outline without ears, of which a fan is as good as anything.
        let mut last = self.next[corner];
        while self.next[last] != corner {
            out.push([corner, last, self.next[last]].map(|i| i as u32));
            last = self.next[last];
        }
    }

    /// Turns left, and no other corner lies in the triangle.
    fn is_ear(&mut self, corner: usize) -> bool {
        let triangle = self.triangle_at(corner);
        if turn(self.flat, triangle) <= 0.0 {
            return false;
        }
        let [low, high] = bounds(triangle.map(|i| self.flat[i]));
        let mut i = 0;
        while let Some(&blocker) = self.blockers.get(i) {
            let [x, y] = self.flat[blocker];
            let is_near = x >= low[0] && x <= high[0] && y >= low[1] && y <= high[1];
            if self.next[blocker] == CUT || is_near && self.turn_at(blocker) > 0.0 {
                self.blockers.swap_remove(i);
                self.is_blocker[blocker] = false;
            } else if is_near && is_inside(self.flat, triangle, blocker) {
                return false;
            } else {
                i += 1;
            }
        }
        true
    }

    fn cut(&mut self, corner: usize, out: &mut Vec<[u32; 3]>) {
        let [before, _, after] = self.triangle_at(corner);
        out.push([before, corner, after].map(|i| i as u32));
        self.next[before] = after;
        self.previous[after] = before;
        self.next[corner] = CUT;
        self.left -= 1;
        for neighbour in [before, after] {
            self.ear[neighbour] = None;
            // A corner can also become straight or turn right where outlines touch themselves.
            self.note_blocker(neighbour);
        }
    }

    fn note_blocker(&mut self, corner: usize) {
        if !self.is_blocker[corner] && self.turn_at(corner) <= 0.0 {
            self.is_blocker[corner] = true;
            self.blockers.push(corner);
        }
    }

    /// A corner on a straight line.
    fn flat_corner(&self, start: usize) -> Option<usize> {
        let corners = std::iter::successors(Some(start), |&corner| Some(self.next[corner]));
        corners.take(self.left).find(|&corner| self.turn_at(corner) == 0.0)
    }
}

fn bounds([a, b, c]: [[f64; 2]; 3]) -> [[f64; 2]; 2] {
    let low = [0, 1].map(|axis| a[axis].min(b[axis]).min(c[axis]));
    let high = [0, 1].map(|axis| a[axis].max(b[axis]).max(c[axis]));
    [low, high]
}

/// Marks corners that have been cut off.
const CUT: usize = usize::MAX;

/// The corner lies in the closed triangle, but not at one of its corners, as where two parts of an
/// outline touch or a bridge leads to a hole.
fn is_inside(flat: &[[f64; 2]], [a, b, c]: [usize; 3], corner: usize) -> bool {
    let at_corner = [a, b, c].iter().any(|&other| flat[other] == flat[corner]);
    !at_corner && [[a, b], [b, c], [c, a]].iter().all(|&[i, j]| turn(flat, [i, j, corner]) >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(points: &[[f32; 3]]) -> Vec<[u32; 3]> {
        let mut out = Vec::new();
        triangulate(points, &mut out).unwrap();
        out
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
        for axis in 0..3 {
            let place = |p: &[f32; 2]| {
                let mut point = [p[0], p[1], 3.0];
                point.rotate_left(axis);
                point
            };
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
    fn outlines_around_the_same_square_again_and_again_end_soon() {
        let square = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let often: Vec<[f32; 3]> = (0..4000).map(|i| square[(i * i + i / 7) % 4]).collect();
        let triangles = split(&often);
        assert!(outline_is_kept(often.len(), &triangles));
    }

    #[test]
    fn random_star_shapes_are_tiled() {
        // By hand, so that no new version of a crate draws other shapes.
        let mut state = 1_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24)
        };
        for corners in 4..200 {
            let points: Vec<[f32; 2]> = (0..corners)
                .map(|i| {
                    let angle = std::f64::consts::TAU * f64::from(i) / f64::from(corners);
                    let radius = 0.2 + random();
                    [(radius * angle.cos()) as f32, (radius * angle.sin()) as f32]
                })
                .collect();
            let lifted: Vec<[f32; 3]> = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
            check_everywhere(&points, newell_normal(&lifted).length() / 2.0);
        }
    }

    #[test]
    fn endless_outlines_are_refused() {
        let zigzag: Vec<[f32; 3]> =
            (0..=MAX_CONCAVE_CORNERS).map(|i| [i as f32, (i % 2) as f32, 0.0]).collect();
        assert_eq!(triangulate(&zigzag, &mut Vec::new()), Err(TooManyCorners));
    }
}
