//! One ray through the wide tree.

use super::aim::{Aim, NoAim};
use super::lanes::RayLanes;
use super::search::Search;
use super::slab::nearest_child;
use super::stack::Stack;
use crate::geometry::Ray;
use crate::layout::{Link, WideTree};
use crate::simd::{Kernel, Lanes};
use std::marker::PhantomData;

/// A search along one ray.
pub(crate) struct Single<'a, Q> {
    tree: &'a WideTree,
    ray: &'a Ray<3>,
    search: PhantomData<Q>,
}

impl<'a, Q: Search> Single<'a, Q> {
    #[inline(always)]
    pub(crate) fn new(tree: &'a WideTree, ray: &'a Ray<3>) -> Self {
        Self { tree, ray, search: PhantomData }
    }
}

impl<Q: Search> Kernel for Single<'_, Q> {
    type Output = Result<Q::Answer, NoAim>;

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) -> Self::Output {
        let Self { tree, ray, .. } = self;
        let mut aim = Aim::NONE;
        aim.set(tree, ray)?;
        let aim = &aim;
        let mut lanes = RayLanes::new(simd, aim, aim.t_far);
        let mut search = Q::new(ray, aim);
        let mut stack = Stack::new();
        let mut next = Some(Link::ROOT);
        while let Some(link) = next {
            if link.is_leaf() {
                for index in 0..link.block_count() {
                    if search.visit(simd, tree.block(link, index), aim, &mut lanes) {
                        return Ok(search.answer());
                    }
                }
                next = stack.pop(search.t_far());
            } else {
                next = nearest_child(simd, tree.node(link), aim, &lanes, &mut stack)
                    .or_else(|| stack.pop(search.t_far()));
            }
        }
        Ok(search.answer())
    }
}
