//! One ray through the wide tree.

use super::aim::Aim;
use super::climb::climb;
use super::line::NoAim;
use super::search::Search;
use super::slab::{Meeting, Slabs};
use super::stack::Stack;
use crate::geometry::Ray;
use crate::layout::{Hint, Link, WideTree};
use crate::primitives::TriangleMesh;
use crate::simd::{InstructionSet, Kernel, Lanes};

/// A search along one ray, which begins at the root, or at a hint's node if NEAR.
struct Single<'a, 's, Q: Search<'a>, const NEAR: bool> {
    tree: &'a WideTree,
    mesh: &'a TriangleMesh<Q::Coordinate>,
    ray: &'s Ray<3>,
    hint: Hint,
    stack: &'s mut Stack,
    /// In the caller's place, because to copy it from hand to hand takes time.
    answer: &'s mut Q::Answer,
}

/// Searches along `ray`; sets `answer` if something is found.
#[inline(always)]
pub(crate) fn search_along<'a, Q: Search<'a>>(
    (tree, mesh): (&'a WideTree, &'a TriangleMesh<Q::Coordinate>),
    ray: &Ray<3>,
    instructions: InstructionSet,
    answer: &mut Q::Answer,
) -> Result<(), NoAim> {
    let hint = Hint::NONE;
    Stack::of_thread(|stack| {
        instructions.run(Single::<Q, false> { tree, mesh, ray, hint, stack, answer })
    })
}

/// Searches along `ray`, beginning with what lies near `hint`; sets `answer` if something is found.
#[inline(always)]
pub(crate) fn search_near<'a, Q: Search<'a>>(
    (tree, mesh): (&'a WideTree, &'a TriangleMesh<Q::Coordinate>),
    ray: &Ray<3>,
    hint: Hint,
    instructions: InstructionSet,
    answer: &mut Q::Answer,
) -> Result<(), NoAim> {
    Stack::of_thread(|stack| {
        instructions.run(Single::<Q, true> { tree, mesh, ray, hint, stack, answer })
    })
}

impl<'a, Q: Search<'a>, const NEAR: bool> Kernel for Single<'a, '_, Q, NEAR> {
    type Output = Result<(), NoAim>;

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) -> Self::Output {
        let Self { tree, mesh, ray, hint, stack, answer } = self;
        let mut aim = Aim::NONE;
        aim.set::<S, Q::Coordinate>(simd, tree, ray)?;
        let mut slabs = Slabs::new(simd, &aim);
        let mut search = Q::new(ray, mesh, answer);
        stack.clear();
        let mut next =
            if NEAR { climb::<S, Q>(simd, tree, hint, &aim, &slabs, stack) } else { Link::ROOT };
        loop {
            if !next.is_leaf() {
                // A branch that is foretold rightly lets the next node be loaded before this one's
                // boxes are tested.
                next = match slabs.meeting(simd, tree.node(next)) {
                    Meeting::None => stack.pop::<Q>(aim.t_far),
                    Meeting::One(child) => child,
                    Meeting::Several(met) => {
                        stack.push_but_nearest::<S, Q>(&met);
                        met.nearest
                    }
                };
                continue;
            }
            if next == Link::END {
                break;
            }
            for index in 0..next.block_count() {
                if search.visit(simd, tree.block(next, index), &mut aim) {
                    search.answer(answer);
                    return Ok(());
                }
            }
            slabs.end(simd, aim.t_far);
            next = stack.pop::<Q>(aim.t_far);
        }
        search.answer(answer);
        Ok(())
    }
}
