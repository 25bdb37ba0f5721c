//! Whether a ray begins inside.

use super::aim::Aim;
use super::block::BlockTest;
use super::count::Count;
use super::search::{Search, triangle};
use crate::exact::is_on_triangle;
use crate::geometry::{Coordinate, Ray};
use crate::layout::TriangleBlock;
use crate::primitives::TriangleMesh;
use crate::simd::Lanes;
use fearless_simd::prelude::*;

/// A direction that leads out along an axis, in units of the tree. Not quite parallel to it, for triangles often are,
/// and those that a ray runs in need the exact test.
pub(crate) fn way_out(axis: usize, sign: f64) -> [f64; 3] {
    let mut direction = [1.0 / 29.0; 3];
    direction[axis] = sign;
    direction[(axis + 1) % 3] = 1.0 / 53.0;
    direction
}

/// Whether a closed mesh holds the ray's origin: inside, by the parity of crossings, or on its surface.
///
/// A triangle that holds the origin is met at t = 0, so that it is a candidate, and never a sure one: its T is
/// zero, also if the ray runs in its plane. So only doubtful lanes are asked for the surface. That holds for rays
/// from t = 0 on whose origin is within the tree's reach, as those of `Scene::way_out` are: of an origin that is
/// moved along the ray, T is not zero.
pub(crate) struct Inside<'a, T: 'static> {
    count: Count<'a, T>,
    origin: [f64; 3],
    is_on_surface: bool,
}

/// What was found.
#[derive(Default)]
pub(crate) struct Crossed {
    ids: Vec<u32>,
    is_on_surface: bool,
}

impl Crossed {
    /// What says that.
    pub(crate) fn of(is_inside: bool) -> Self {
        Self { ids: Vec::new(), is_on_surface: is_inside }
    }

    pub(crate) fn is_inside(&self) -> bool {
        self.is_on_surface || self.ids.len() % 2 == 1
    }
}

impl<'a, T: Coordinate> Search<'a> for Inside<'a, T> {
    type Coordinate = T;
    type Answer = Crossed;
    const SHORTENS: bool = false;

    #[inline(always)]
    fn new(ray: &Ray<3>, mesh: &'a TriangleMesh<T>, answer: &mut Crossed) -> Self {
        let count = Count::new(ray, mesh, &mut answer.ids);
        Self { count, origin: ray.origin, is_on_surface: false }
    }

    #[inline(always)]
    fn visit<S: Lanes>(&mut self, simd: S, block: &TriangleBlock, aim: &mut Aim) -> bool {
        let test = BlockTest::new::<T, true>(simd, block, aim);
        let candidates = test.candidates(aim).to_bitmask();
        if candidates != 0 {
            let sure = test.sure(aim).to_bitmask();
            self.is_on_surface = self.is_on_one(block, candidates & !sure);
            self.count.add(block, candidates, sure);
        }
        self.is_on_surface
    }

    #[inline(always)]
    fn answer(&mut self, answer: &mut Crossed) {
        answer.is_on_surface = self.is_on_surface;
        self.count.answer(&mut answer.ids);
    }
}

impl<T: Coordinate> Inside<'_, T> {
    /// Whether the origin is on one of these triangles.
    #[inline(always)]
    fn is_on_one(&self, block: &TriangleBlock, doubtful: u64) -> bool {
        doubtful != 0 && self.is_on_one_exactly(block, doubtful)
    }

    #[cold]
    #[inline(never)]
    fn is_on_one_exactly(&self, block: &TriangleBlock, doubtful: u64) -> bool {
        (0..8).filter(|lane| doubtful >> lane & 1 == 1).any(|lane| {
            let corners = triangle(self.count.mesh, block, lane);
            is_on_triangle(self.origin, corners.map(|p| p.map(T::to_f64)))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::InstructionSet;
    use crate::traverse::wide::one_block::OneBlock;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    type Corners = [[f64; 3]; 3];

    fn ways_out() -> impl Iterator<Item = [f64; 3]> {
        (0..3).flat_map(|axis| [-1.0, 1.0].map(|sign| way_out(axis, sign)))
    }

    /// The point a + s (b − a) + t (c − a).
    fn mixed([a, b, c]: Corners, s: f64, t: f64) -> [f64; 3] {
        [0, 1, 2].map(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]))
    }

    /// Eight triangles: fat ones, slivers, some nearly along a way out, and two without area. Corners are short
    /// numbers, so that many points of edges and faces are f64, or have all their digits.
    fn triangles(size: f64, center: [f64; 3], is_short: bool, random: &mut Pcg64) -> Vec<Corners> {
        let ways: Vec<_> = ways_out().collect();
        let step = size / f64::from(1 << 8);
        let short = |x: f64| if is_short { (x / step).round() * step } else { x };
        let mut near = |p: [f64; 3], by: f64| p.map(|x| x + by * random.random_range(-1.0..1.0));
        let triangle = |kind: usize| {
            let middle = near(center, 1.0);
            let [a, b, c] = [near(middle, size), near(middle, size), near(middle, size)];
            let along = |p: [f64; 3]| [0, 1, 2].map(|k| p[k] + size * ways[kind % 6][k]);
            match kind {
                0..3 => [a, b, c],
                3 => [a, b, near(b, 0.01 * size)],
                4 => [a, along(a), c],
                5 => [a, along(a), along(c)],
                6 => [a, b, b],
                _ => [a, a, a],
            }
        };
        (0..8).map(triangle).map(|corners| corners.map(|p| p.map(short))).collect()
    }

    /// Of how many triangles that hold an origin, in corners, on edges and in faces, the filter was asked; and how
    /// many others it was sure of.
    fn check<T: Coordinate>(size: f64, center: [f64; 3], is_short: bool) -> [usize; 4] {
        let mut random = Pcg64::seed_from_u64(3);
        let mut counts = [0; 4];
        for _ in 0..6 {
            let soup = triangles(size, center, is_short, &mut random);
            let soup = soup.into_iter().map(|corners| corners.map(|p| p.map(T::from_f64)));
            let mesh = TriangleMesh::<T>::from_soup(soup.collect::<Vec<_>>()).unwrap();
            let one = OneBlock::of(&mesh);
            let corners = |id: u32| mesh.corners(id).map(|p| p.map(T::to_f64));
            for (id, (i, j)) in (0..8).flat_map(|id| PLACES.map(|place| (id, place))) {
                let origin = mixed(corners(id), 0.25 * f64::from(i), 0.25 * f64::from(j));
                let place = [i, j, 4 - i - j].iter().filter(|&&weight| weight > 0).count() - 1;
                for direction in ways_out() {
                    let scale = one.tree.space().scale();
                    let ray = Ray::new(origin, direction.map(|d| d / scale));
                    for set in InstructionSet::available() {
                        let [candidates, sure] = one.filter(set, &ray);
                        for lane in 0..8 {
                            let id = one.block().id(lane);
                            let (may, must) = (candidates >> lane & 1, sure >> lane & 1);
                            if is_on_triangle(origin, corners(id)) {
                                assert_eq!((may, must), (1, 0), "{set}: {id} {ray:?}, {size}");
                                counts[place] += 1;
                            } else {
                                counts[3] += usize::from(must == 1);
                            }
                        }
                    }
                }
            }
        }
        counts
    }

    /// Weights of b and c, in quarters: corners, points of edges, points within.
    const PLACES: [(u8, u8); 9] =
        [(0, 0), (4, 0), (0, 4), (2, 0), (1, 3), (0, 3), (1, 1), (2, 1), (1, 2)];

    #[test]
    fn triangles_that_hold_the_origin_are_candidates_and_never_sure() {
        let mut sure = 0;
        for size in [1.0, 0.1, 1e-2, 1e-3, 1e-5] {
            let here = [0.25, -0.5, 0.125];
            for short in [check::<f32>(size, [0.0; 3], true), check::<f64>(size, here, true)] {
                assert!(short[..3].iter().all(|&count| count > 100), "{size}: {short:?}");
                sure += short[3];
            }
            // Of numbers with all digits the corners are sure to be on the surface.
            let all_digits = [check::<f32>(size, here, false), check::<f64>(size, here, false)];
            let far = check::<f64>(size, [5e5, 5.4e6, 100.0], false);
            assert!(all_digits.iter().chain([&far]).all(|it| it[0] > 1000), "{size}: {far:?}");
        }
        assert!(sure > 100, "{sure}");
    }
}
