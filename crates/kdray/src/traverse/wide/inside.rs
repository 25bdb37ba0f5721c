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
