//! The triangle test on eight triangles at once.

use super::aim::Aim;
use super::rounding::{ROUNDING, UNDERFLOW};
use super::vector::{Vector, cross, difference, dot, flip_sign, largest, splat};
use crate::geometry::{Coordinate, TreeSpace};
use crate::layout::TriangleBlock;
use crate::simd::Lanes;
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, mask32x8};

/// See [`error_bounds`].
pub(super) const EDGE_ERROR: f32 = 48.0 * ROUNDING;
const VOLUME_ERROR: f32 = 64.0 * ROUNDING;
pub(super) const T_ERROR: f32 = 40.0 * ROUNDING;
/// What m and n count as at least, 2^-50. What underflow takes of den, 2^-148 and as much a unit of
/// m, is multiplied by t. As t's share of the error is m n D by 40 u, and D ≥ 2^-16, that is more.
const LEAST_EDGE: f32 = 1.0 / (1_u64 << 50) as f32;

/// What ē counts as at least for corners that were rounded, and by how much M counts as more.
const LEAST_ROUNDED_EDGE: f32 = 8.0 * ROUNDING * TreeSpace::FARTHEST;
const ROUNDED_DISTANCE: f32 = 0.25 * TreeSpace::FARTHEST;

/// Möller and Trumbore's numbers (1997) of eight triangles, with the sign of den taken out: a ray
/// hits where U, V and W are not negative, at t = T / den.
#[derive(Clone, Copy)]
pub(super) struct BlockTest<S: Lanes> {
    pub(super) u: f32x8<S>,
    pub(super) v: f32x8<S>,
    pub(super) w: f32x8<S>,
    /// T, six times the volume of the triangle and the origin.
    pub(super) volume: f32x8<S>,
    pub(super) den: f32x8<S>,
    /// den with its sign: positive where the front is seen.
    pub(super) facing: f32x8<S>,
    /// How far U, V and W may be off.
    edge_error: f32x8<S>,
    /// How far den may be off, or more: where it is not above, its sign is not sure.
    den_error: f32x8<S>,
    /// How far T − t · den may be off for t = t_near, and for t = t_far.
    near_error: f32x8<S>,
    far_error: f32x8<S>,
    /// How far it may be off for t = 0, and how much more a unit of t.
    origin_error: f32x8<S>,
    t_error: f32x8<S>,
}

/// Bounds for where the ray meets triangles.
#[derive(Clone, Copy)]
pub(super) struct Depths<S: Lanes> {
    /// The true t is above this and below `high` where the ray surely hits, within its interval and
    /// at a t above zero. Elsewhere this is minus infinity and `high` is infinity.
    pub(super) low: f32x8<S>,
    pub(super) high: f32x8<S>,
}

impl<S: Lanes> BlockTest<S> {
    /// The error bounds are only right if EXACT; otherwise zero.
    #[inline(always)]
    pub(super) fn new<T: Coordinate, const EXACT: bool>(
        simd: S,
        block: &TriangleBlock,
        aim: &Aim,
    ) -> Self {
        simd.step(
            #[inline(always)]
            || Self::numbers::<T, EXACT>(simd, block, aim),
        )
    }

    #[inline(always)]
    fn numbers<T: Coordinate, const EXACT: bool>(
        simd: S,
        block: &TriangleBlock,
        aim: &Aim,
    ) -> Self {
        let (a, b, c) = (corner(simd, block, 0), corner(simd, block, 1), corner(simd, block, 2));
        let (e1, e2) = (difference(b, a), difference(c, a));
        let (origin, direction) = (splat(simd, &aim.origin), splat(simd, &aim.direction));
        let s = difference(origin, a);
        let p = cross(direction, e2);
        let q = cross(s, e1);
        let (den, u, v, volume) = (dot(p, e1), dot(p, s), dot(q, direction), dot(q, e2));
        let w = den - u - v;
        let [edge_error, near_error, far_error, origin_error, t_error] = if EXACT {
            error_bounds::<S, T>(simd, aim, [largest(e1), largest(e2), largest(s)])
        } else {
            [f32x8::splat(simd, 0.0); 5]
        };
        let signed = |x: f32x8<S>| flip_sign(x, den);
        let (u, v, w, volume) = (signed(u), signed(v), signed(w), signed(volume));
        Self {
            u,
            v,
            w,
            volume,
            den: den.abs(),
            facing: den,
            edge_error,
            den_error: if T::FITS_TREE { t_error } else { edge_error },
            near_error,
            far_error,
            origin_error,
            t_error,
        }
    }

    /// The lanes that may be hit within the ray's interval.
    #[inline(always)]
    pub(super) fn candidates(&self, aim: &Aim) -> mask32x8<S> {
        self.den.simd.step(
            #[inline(always)]
            || {
                let inside = (self.u.min(self.v).min(self.w) + self.edge_error).simd_ge(0.0);
                let behind = self.den.mul_sub(aim.t_near, self.near_error).simd_le(self.volume);
                let before = self.den.mul_add(aim.t_far, self.far_error).simd_ge(self.volume);
                // With a wrong sign of den T has one too, and may seem to be before t = 0, at any t.
                let turned = self.den.simd_le(self.den_error);
                inside & (behind & before | turned)
            },
        )
    }

    /// The lanes that are surely hit within the ray's interval.
    #[inline(always)]
    pub(super) fn sure(&self, aim: &Aim) -> mask32x8<S> {
        self.den.simd.step(
            #[inline(always)]
            || {
                let inside = (self.u.min(self.v).min(self.w) - self.edge_error).simd_gt(0.0);
                let behind = self.den.mul_add(aim.t_near, self.near_error).simd_lt(self.volume);
                let before = self.den.mul_sub(aim.t_far, self.far_error).simd_gt(self.volume);
                inside & behind & before
            },
        )
    }

    /// Bounds for t. From |T − t·den| ≤ e0 + e1·t for t ≥ 0 follows
    /// (T − e0) / (den + e1) ≤ t ≤ (T + e0) / (den − e1); a relative 2^-21 covers the rounding.
    #[inline(always)]
    pub(super) fn depths(&self, simd: S, aim: &Aim) -> Depths<S> {
        const ROOM: f32 = 1.0 / (1 << 21) as f32;
        simd.step(
            #[inline(always)]
            || {
                let all = |x: f32| f32x8::splat(simd, x);
                let ahead = self.volume.simd_gt(self.origin_error);
                let steep = self.den.simd_gt(self.t_error + self.t_error);
                let sure = self.sure(aim) & ahead & steep;
                let low = (self.volume - self.origin_error) / (self.den + self.t_error);
                let high = (self.volume + self.origin_error) / (self.den - self.t_error);
                Depths {
                    low: sure.select(low * (1.0 - ROOM), all(f32::NEG_INFINITY)),
                    high: sure.select(high * (1.0 + ROOM), all(f32::INFINITY)),
                }
            },
        )
    }
}

/// Bounds for the errors of U, V and W, and of T − t·den for t = t_near and for t = t_far.
///
/// With u half the distance from 1 to the next f32, D = |d|₁, m and n the largest coordinates of e1
/// and e2, ē the larger of them, M that of s. Each term of U is rounded in d, e2 and s, twice in the
/// cross product and three times in the dot product, and the terms sum to 2·D·ē·M: 16 u D ē M. V
/// likewise; den, whose terms sum to 2·D·m·n, 16 u D m n. W = (den − U) − V gathers all three, and
/// two more roundings: 38 u D ē (M + ē). T has terms of 6·m·n·M in sum and eight roundings:
/// 48 u m n M. T is compared with t·den, to which den adds 16 u D m n t, and the product a rounding of it.
/// (m·n, not ē²: of slender triangles it is much less.) Where the sign of den is not sure, that of T is not
/// either, and T tells nothing: see [`BlockTest::candidates`].
///
/// An origin that is not an f32 is off by E: U by 2·D·ē·E, T by 6·m·n·E. With M not below
/// E / (2 u), as [`Aim`] sees to, that is at most 4 u D ē M, for W 8 u D ē M, and 12 u m n M more: 46
/// and 60 in all.
///
/// # Corners that were rounded
/// Those of f64 meshes are off by ρ = u (1 + 2^-20) at most on each axis, for the tree's coordinates are
/// below 2; in that is what f64 does to corners and origin (see [`TreeSpace`]). All above holds for the
/// triangle as it stands in the block. The true one is another, so let the ray hit one of the two, at
/// Q, and see how far the numbers of the other are off. U does not change if the origin moves along the
/// ray, so take it from Q, which is not farther than ē from a and 2 ē from b and c. Of the other
/// triangle an edge differs by 2 ρ and a corner by ρ, and ē by 2 ρ: U and V by
/// 2 D (3 ρ (ē + 2 ρ) + 2 ρ²), W, of the edge bc, by 2 D (6 ρ (ē + 2 ρ) + 2 ρ²), den by
/// 2 D (4 ρ ē + 4 ρ²). If that makes den change its sign, the true den is below it, and so are U, V and W:
/// in all 20 ρ D ē + 36 ρ² D at most. A larger M by 1/2 gives 24 ρ D ē, which is as much if ē is not
/// below 16 ρ.
///
/// At the true t of the hit, Q lies in one plane and by ρ at most off the other: |T − t·den| is not above
/// 6 m n ρ. A larger M by 1/2 gives 32 m n ρ.
#[inline(always)]
fn error_bounds<S: Lanes, T: Coordinate>(
    simd: S,
    aim: &Aim,
    [m, n, distance]: [f32x8<S>; 3],
) -> [f32x8<S>; 5] {
    let all = |x: f32| f32x8::splat(simd, x);
    let distance = distance.max(all(aim.least_distance));
    let (m, n) = (m.max(all(LEAST_EDGE)), n.max(all(LEAST_EDGE)));
    let (edge, distance) = if T::FITS_TREE {
        (m.max(n), distance)
    } else {
        (m.max(n).max(all(LEAST_ROUNDED_EDGE)), distance + ROUNDED_DISTANCE)
    };
    let edge_error = (edge * (edge + distance)).mul_add(all(aim.edge_rate), all(UNDERFLOW));
    let volume_rate = distance * all(VOLUME_ERROR);
    let edges = m * n;
    let error = |rate: f32| edges.mul_add(volume_rate + all(rate), all(UNDERFLOW));
    let (near_error, far_error) = (error(aim.near_rate), error(aim.far_rate));
    let origin_error = error(aim.rate_at(0.0));
    [edge_error, near_error, far_error, origin_error, edges * all(aim.t_rate)]
}

/// A corner of each triangle.
#[inline(always)]
fn corner<S: Lanes>(simd: S, block: &TriangleBlock, place: usize) -> Vector<S> {
    let load = |axis| f32x8::load_array_ref(simd, block.corner(place, axis));
    [load(0), load(1), load(2)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Ray;
    use crate::primitives::{HitRule, TriangleMesh, intersect_triangle};
    use crate::simd::InstructionSet;
    use crate::traverse::wide::one_block::OneBlock;
    use rand::{RngExt, SeedableRng};

    /// Eight triangles of that size within one around a centre; and rays at, and close to, their edges
    /// and corners. How many of the answers were doubtful, and how many were sure.
    fn check<T: Coordinate>(size: f64, center: [f64; 3], seed: u64) -> [usize; 2] {
        let mut random = rand_pcg::Pcg64::seed_from_u64(seed);
        let mut near = |p: [f64; 3], by: f64| p.map(|x| x + by * random.random_range(-1.0..1.0));
        let soup: Vec<[[T; 3]; 3]> = (0..8)
            .map(|_| {
                let middle = near(center, 1.0);
                [0; 3].map(|_| near(middle, size).map(T::from_f64))
            })
            .collect();
        let mesh = TriangleMesh::from_soup(soup).unwrap();
        let one = OneBlock::of(&mesh);
        let mut counts = [0; 2];
        for round in 0..4000 {
            let id = round % 8;
            let [a, b, c] = mesh.corners(id).map(|p| p.map(T::to_f64));
            let s = [0.0, 0.3, 0.5, 1.0][round as usize / 8 % 4];
            let by = 10.0_f64.powi(-(round as i32 / 32 % 10));
            let target = near([0, 1, 2].map(|k| b[k] + s * (c[k] - b[k])), by * size);
            let origin = if round % 3 == 0 { near(a, 2.0 * size) } else { near(center, 3.0) };
            // Half of the origins are such that f32 hardly rounds them, for that blurs the filter, too.
            let (space, grid) = (one.tree.space(), f64::from(1 << 20));
            let short = space.point(origin).map(|x| (x * grid).round() / grid);
            let short = [0, 1, 2].map(|k| short[k] / space.scale() + space.center()[k]);
            let origin = if round % 2 == 0 { short } else { origin };
            let ray = Ray::through(origin, target);
            let ray = if round % 5 == 0 { ray.with_interval(0.0, 1.0) } else { ray };
            for set in InstructionSet::available() {
                let [candidates, sure] = one.filter(set, &ray);
                for lane in 0..8 {
                    let id = one.block().id(lane);
                    let hit = intersect_triangle(&mesh.corners(id), id, &ray, HitRule::Touching);
                    let (may, must) = (candidates >> lane & 1 == 1, sure >> lane & 1 == 1);
                    assert!(may || hit.is_none(), "{set} leaves out {hit:?} of {ray:?}, {size}");
                    assert!(!must || hit.is_some(), "{set} is sure of {id} and {ray:?}, {size}");
                    counts[0] += usize::from(may && !must);
                    counts[1] += usize::from(must);
                }
            }
        }
        counts
    }

    #[test]
    fn the_filter_is_right_of_what_it_is_sure() {
        for (seed, size) in [1.0, 0.1, 1e-2, 1e-3, 1e-4].into_iter().enumerate() {
            let here = check::<f32>(size, [0.0; 3], seed as u64);
            let rounded = check::<f64>(size, [0.0; 3], seed as u64);
            check::<f64>(size, [5e5, 5.4e6, 100.0], seed as u64);
            for [doubtful, sure] in [here, rounded] {
                assert!(doubtful > 100 && sure > 100, "{size}: {here:?}, rounded {rounded:?}");
            }
        }
        for size in [1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
            check::<f64>(size, [0.0; 3], 9);
        }
    }
}
