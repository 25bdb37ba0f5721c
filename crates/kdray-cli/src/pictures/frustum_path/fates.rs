//! The steps of a packet, sorted by what became of cells.

use super::super::cells::cells_on_the_way;
use kdray::traverse::{Frustum, PacketDecision, PacketStep};
use kdray::{ShapeScene, tree::Cell};
use std::collections::BTreeSet;

/// What became of the cells that a packet met.
#[derive(Default)]
pub(in crate::pictures) struct Fates {
    /// The sub-frusta.
    pub(in crate::pictures) frusta: Vec<Frustum>,
    /// The depth up to which they are drawn: of the farthest hit, or else where they leave the box.
    pub(in crate::pictures) end: f64,
    /// Inner nodes with the axis and the place of their planes.
    pub(in crate::pictures) splits: Vec<(Cell<3>, usize, f32)>,
    /// Children that one decision left out.
    pub(in crate::pictures) left_out: Vec<Cell<3>>,
    /// Leaves in which no ray was tested: they are empty, or the frusta culled all they list.
    pub(in crate::pictures) passed: Vec<Cell<3>>,
    /// Leaves in which rays were tested.
    pub(in crate::pictures) tested: Vec<Cell<3>>,
    /// Nodes that waited behind the hits.
    pub(in crate::pictures) dropped: Vec<Cell<3>>,
    /// The triangles that rays were tested against.
    pub(in crate::pictures) triangles: BTreeSet<u32>,
}

impl Fates {
    pub(in crate::pictures) fn new(
        scene: &ShapeScene,
        steps: &[PacketStep],
        hit_points: &[[f64; 3]],
    ) -> Self {
        let visited = steps.iter().filter_map(|step| match step {
            PacketStep::Split(step) => Some(step.node),
            _ => None,
        });
        let cells = cells_on_the_way(scene.tree(), visited);
        let cell = |node: u32| cells.get(&node).copied();
        let mut fates = Self::default();
        let mut leaf = 0;
        for step in steps {
            match *step {
                PacketStep::Frustum(frustum) => fates.frusta.push(frustum),
                PacketStep::Split(step) => {
                    fates.splits.extend(cell(step.node).map(|cell| (cell, step.axis, step.split)));
                    let left_out = match step.decision() {
                        PacketDecision::Both => &[][..],
                        PacketDecision::Near => &[step.far_child],
                        PacketDecision::Far => &[step.near_child],
                        PacketDecision::Neither => &[step.near_child, step.far_child],
                    };
                    fates.left_out.extend(left_out.iter().filter_map(|&node| cell(node)));
                }
                PacketStep::Leaf(step) => {
                    leaf = step.node;
                    fates.passed.extend(cell(leaf));
                }
                PacketStep::SetUp(id) => {
                    fates.triangles.insert(id);
                    // The first one of its leaf.
                    fates.tested.extend(fates.passed.pop_if(|cell| cell.node == leaf));
                }
                PacketStep::Dropped(node) => fates.dropped.extend(cell(node)),
                _ => {}
            }
        }
        fates.end = end(&fates.frusta, hit_points);
        fates
    }
}

/// The depth of the farthest hit; without any, where the frusta leave the tree's box.
fn end(frusta: &[Frustum], hit_points: &[[f64; 3]]) -> f64 {
    let depths = frusta.first().into_iter().flat_map(|frustum| {
        let axis = frustum.axis();
        let base = frustum.corner_rays()[0].origin[axis];
        hit_points.iter().map(move |p| (p[axis] - base).abs())
    });
    let box_end = || frusta.iter().map(|frustum| frustum.depths().t_max).fold(0.0, f64::max);
    depths.reduce(f64::max).unwrap_or_else(box_end)
}
