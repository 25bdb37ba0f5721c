//! Beginning a search at a hint's node instead of the root.

use super::aim::Aim;
use super::search::Search;
use super::slab::Slabs;
use super::stack::Stack;
use crate::layout::{Hint, Home, Link, WideTree};
use crate::simd::Lanes;
use fearless_simd::prelude::*;
use fearless_simd::{f32x4, f32x8};

/// Climbs from the node of `hint` to the first whose cell holds the ray's open part, pushes all that
/// the ray meets beside the way, and gives the hint's node, which is to be searched first.
///
/// All of the way is climbed before anything is searched, though what is found at the hint's node may
/// make it needless. So its steps do not wait for each other, and no branch but the last is foretold
/// wrongly; to climb when the search below was over gained half as much.
#[inline(always)]
pub(super) fn climb<'a, S: Lanes, Q: Search<'a>>(
    simd: S,
    tree: &WideTree,
    hint: Hint,
    aim: &Aim,
    slabs: &Slabs<S>,
    stack: &mut Stack,
) -> Link {
    let span = Span::new(simd, aim);
    let mut home = tree.home(hint);
    let first = home.link();
    // The root's home holds every ray.
    while !span.is_in(simd, home) {
        let place = home.place();
        home = tree.home_above(home);
        stack.push::<S, Q>(&slabs.meet_but(simd, tree.node(home.link()), place));
    }
    first
}

/// The box around a ray's open part: the lower faces in the lanes 0 to 2, the upper ones, negated,
/// in the lanes 4 to 6.
struct Span<S: Lanes>(f32x8<S>);

impl<S: Lanes> Span<S> {
    #[inline(always)]
    fn new(simd: S, aim: &Aim) -> Self {
        let origin = f32x4::load_array_ref(simd, &aim.origin);
        let direction = f32x4::load_array_ref(simd, &aim.direction);
        let (near, far) = (direction * aim.t_near + origin, direction * aim.t_far + origin);
        Self(simd.combine_f32x4(near.min(far), -near.max(far)))
    }

    /// Whether all that the ray hits is surely listed below a node: its open part lies in the node's
    /// cell, off the faces that the cell shares with others.
    ///
    /// With u half the distance from 1 to the next f32 and R the tree's reach, an end of the part is
    /// o + t·d. The origin is rounded and, where it was moved, off by 2 u R at most; the direction,
    /// the product and the sum are rounded once each. Where the end lies within the reach on an
    /// axis, t·d is at most 2 R there, so that the end is off by 7 u R at most: less than the 12 u R
    /// by which homes are smaller than cells. Where it lies beyond, it is off by 7 u of itself at
    /// most, and so comes out beyond all faces but for 7 u R, as it should.
    #[inline(always)]
    fn is_in(&self, simd: S, home: &Home) -> bool {
        const FACES: u64 = 0b0111_0111;
        let inside = self.0.simd_ge(f32x8::load_array_ref(simd, home.faces()));
        inside.to_bitmask() & FACES == FACES
    }
}
