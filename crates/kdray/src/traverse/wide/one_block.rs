//! For tests: a tree of one block, and what the block test says of it.

use super::aim::Aim;
use super::block::BlockTest;
use crate::Strategy;
use crate::build::{BuildOptions, Preset};
use crate::geometry::{Coordinate, Ray};
use crate::layout::{Link, TriangleBlock, WideTree};
use crate::primitives::TriangleMesh;
use crate::simd::{InstructionSet, Kernel, Lanes};
use crate::tree::KdTree;
use fearless_simd::prelude::*;
use std::marker::PhantomData;
use std::ops::ControlFlow;

/// A wide tree over at most eight triangles.
pub(super) struct OneBlock<T> {
    pub(super) tree: WideTree,
    precision: PhantomData<T>,
}

impl<T: Coordinate> OneBlock<T> {
    pub(super) fn of(mesh: &TriangleMesh<T>) -> Self {
        let one_leaf = BuildOptions { leaf_size: 8, ..BuildOptions::preset(Preset::Best) };
        let one_leaf = BuildOptions { strategy: Strategy::Middle, ..one_leaf };
        let go_on = |_| ControlFlow::Continue(());
        let (tree, boxes) = KdTree::build_with_boxes(mesh, &one_leaf, &go_on).unwrap();
        let tree = WideTree::new(&tree, &boxes, mesh, &one_leaf, &go_on).unwrap().unwrap();
        Self { tree, precision: PhantomData }
    }

    pub(super) fn block(&self) -> &TriangleBlock {
        self.tree.block(Link::from_bits(self.tree.node(Link::ROOT).links()[0]), 0)
    }

    /// The lanes that are candidates, and those that are sure; none for a ray that misses all of the tree.
    pub(super) fn filter(&self, set: InstructionSet, ray: &Ray<3>) -> [u64; 2] {
        set.run(Filter(self, ray))
    }
}

struct Filter<'a, T>(&'a OneBlock<T>, &'a Ray<3>);

impl<T: Coordinate> Kernel for Filter<'_, T> {
    type Output = [u64; 2];

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) -> [u64; 2] {
        let Self(one, ray) = self;
        let mut aim = Aim::NONE;
        if aim.set::<S, T>(simd, &one.tree, ray).is_err() {
            return [0; 2];
        }
        let test = BlockTest::new::<T, true>(simd, one.block(), &aim);
        [test.candidates(&aim).to_bitmask(), test.sure(&aim).to_bitmask()]
    }
}
