//! The lines of triangles in a packet's plane.

use super::rays::{Bounds, Set};
use crate::simd::Lanes;
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, mask32x8};

/// A·x + B·y + C of eight triangles.
pub(super) type Form<S> = [f32x8<S>; 3];

/// What a packet needs to know of eight triangles. A point (x, y) is inside a triangle where all edge
/// forms have the sign of the triangle, which is taken out; there the form `depth` is w.
pub(super) struct Forms<S: Lanes> {
    pub(super) edges: [Form<S>; 3],
    pub(super) depth: Form<S>,
    /// How far the edge forms may be off.
    pub(super) edge_error: f32x8<S>,
    /// How far w may be off.
    pub(super) depth_error: f32x8<S>,
    /// Triangles of which the above is right. Of others only the edge forms are, and their sign is not.
    pub(super) good: mask32x8<S>,
    /// Lanes with a triangle.
    pub(super) present: mask32x8<S>,
}

/// Which of eight triangles the rays of a packet may hit.
pub(super) struct Within {
    /// Of those that are good.
    pub(super) good: u32,
    /// Those that may lie before the beginning of a ray.
    pub(super) early: u32,
    /// All that are not good.
    pub(super) others: u32,
}

/// The rows of [`Forms`] in memory, to be read for one triangle at a time.
#[repr(align(32))]
pub(super) struct Table {
    rows: [[f32; 8]; ROWS],
}

const ROWS: usize = 14;

/// The numbers of one triangle, each in all lanes.
pub(super) struct Lines<S: Lanes> {
    pub(super) edges: [Form<S>; 3],
    pub(super) depth: Form<S>,
    pub(super) edge_error: f32x8<S>,
    pub(super) depth_error: f32x8<S>,
    /// For each form which bounds of x and y make it greatest.
    corners: [[usize; 2]; 4],
}

/// The greatest value of a form in a rectangle.
#[inline(always)]
pub(super) fn greatest<S: Lanes>(
    [a, b, c]: &Form<S>,
    x: [f32x8<S>; 2],
    y: [f32x8<S>; 2],
) -> f32x8<S> {
    let x = a.simd_lt(0.0).select(x[0], x[1]);
    let y = b.simd_lt(0.0).select(y[0], y[1]);
    a.mul_add(x, b.mul_add(y, *c))
}

impl<S: Lanes> Forms<S> {
    /// The lanes with triangles that rays within bounds may hit.
    #[inline(always)]
    pub(super) fn within(&self, simd: S, bounds: &Bounds) -> Within {
        let (x, y) = bounds.in_all_lanes(simd);
        let [a, b, c] = &self.edges;
        let inside = greatest(a, x, y).min(greatest(b, x, y)).min(greatest(c, x, y));
        let depth = greatest(&self.depth, x, y) + self.depth_error;
        let met = inside.simd_ge(-self.edge_error) & depth.simd_ge(bounds.low);
        let early = depth.simd_ge(bounds.least_near).to_bitmask() as u32;
        let good = self.good.to_bitmask() as u32;
        let others = self.present.to_bitmask() as u32 & !good;
        Within { good: met.to_bitmask() as u32 & good, early, others }
    }

    /// The lanes with triangles of which one edge form is surely positive for all rays within bounds, and
    /// another one surely negative: whichever sign the triangle has, they miss it.
    #[inline(always)]
    pub(super) fn mixed(&self, simd: S, bounds: &Bounds) -> u32 {
        let (x, y) = bounds.in_all_lanes(simd);
        let negative = |form: &Form<S>| greatest(&[-form[0], -form[1], -form[2]], x, y);
        let [a, b, c] = &self.edges;
        let most = greatest(a, x, y).min(greatest(b, x, y)).min(greatest(c, x, y));
        // Minus the greatest of what the forms are at the least.
        let least = negative(a).min(negative(b)).min(negative(c));
        let mixed = most.simd_lt(-self.edge_error) & least.simd_lt(-self.edge_error);
        mixed.to_bitmask() as u32
    }

    #[inline(always)]
    pub(super) fn store(&self, table: &mut Table) {
        let [e, f, g] = self.edges;
        let rows = [e, f, g, self.depth];
        let errors = [self.edge_error, self.depth_error];
        for (form, rows) in rows.iter().zip(table.rows.chunks_exact_mut(3)) {
            for (number, row) in form.iter().zip(rows) {
                *row = *number.as_array();
            }
        }
        for (number, row) in errors.iter().zip(&mut table.rows[12..]) {
            *row = *number.as_array();
        }
    }
}

impl Table {
    pub(super) const EMPTY: Self = Self { rows: [[0.0; 8]; ROWS] };

    #[inline(always)]
    pub(super) fn lines<S: Lanes>(&self, simd: S, lane: usize) -> Lines<S> {
        let number = |row: usize| f32x8::splat(simd, self.rows[row][lane & 7]);
        let form = |row: usize| [number(row), number(row + 1), number(row + 2)];
        let upper = |row: usize| usize::from(self.rows[row][lane & 7] >= 0.0);
        let corner = |row: usize| [upper(row), upper(row + 1)];
        Lines {
            corners: [corner(0), corner(3), corner(6), corner(9)],
            edges: [form(0), form(3), form(6)],
            depth: form(9),
            edge_error: number(12),
            depth_error: number(13),
        }
    }
}

impl<S: Lanes> Lines<S> {
    /// Which of eight sub-frusta the triangle may meet.
    #[inline(always)]
    pub(super) fn met(&self, simd: S, set: &Set) -> u32 {
        let greatest = |[a, b, c]: &Form<S>, [i, j]: [usize; 2]| {
            let x = f32x8::load_array_ref(simd, &set.x[i & 1]);
            let y = f32x8::load_array_ref(simd, &set.y[j & 1]);
            a.mul_add(x, b.mul_add(y, *c))
        };
        let ([a, b, c], at) = (&self.edges, &self.corners);
        let inside = greatest(a, at[0]).min(greatest(b, at[1])).min(greatest(c, at[2]));
        let depth = greatest(&self.depth, at[3]) + self.depth_error;
        let low = f32x8::load_array_ref(simd, &set.low);
        let met = inside.simd_ge(-self.edge_error) & depth.simd_ge(low);
        met.to_bitmask() as u32
    }
}

/// A·x + B·y + C.
#[inline(always)]
pub(super) fn value<S: Lanes>([a, b, c]: &Form<S>, x: f32x8<S>, y: f32x8<S>) -> f32x8<S> {
    a.mul_add(x, b.mul_add(y, *c))
}
