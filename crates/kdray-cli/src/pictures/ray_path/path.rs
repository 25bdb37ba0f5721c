//! The steps of a ray, sorted by what they say about cells.

use super::super::t_diagram::{Bar, Fate};
use super::super::{counted, readable};
use kdray::tree::{Cell, NodeKind};
use kdray::{
    Hit, ShapeScene,
    traverse::{Step, TraversalCase},
};
use std::collections::{HashMap, HashSet};

/// The steps sorted by what they say about cells.
pub(super) struct Path {
    pub(super) splits: Vec<PathSplit>,
    pub(super) visited: Vec<(Cell<3>, [f64; 2])>,
    pub(super) dropped: Vec<(Cell<3>, [f64; 2])>,
    pub(super) tested: HashSet<u32>,
}

pub(super) struct PathSplit {
    pub(super) cell: Cell<3>,
    pub(super) axis: usize,
    pub(super) split: f32,
    pub(super) t: [f64; 2],
    pub(super) t_split: f64,
}

impl Path {
    pub(super) fn new(scene: &ShapeScene, steps: &[Step]) -> Self {
        let cells = cells_of(scene, steps);
        let mut path = Self {
            splits: Vec::new(),
            visited: Vec::new(),
            dropped: Vec::new(),
            tested: HashSet::new(),
        };
        // The stack is followed to know which nodes the search left on it.
        let mut waiting: Vec<(u32, [f64; 2])> = Vec::new();
        for step in steps {
            match *step {
                Step::Split(step) => {
                    let Some(&cell) = cells.get(&step.node) else { continue };
                    let (t, t_split) = ([step.t_near, step.t_far], step.t_split);
                    let (axis, split) = (step.axis, step.split);
                    path.splits.push(PathSplit { cell, axis, split, t, t_split });
                    if step.case == TraversalCase::NearThenFar {
                        let t_near = t_split.clamp(step.t_near, step.t_far);
                        waiting.push((step.far_child, [t_near, step.t_far]));
                    }
                }
                Step::Leaf(step) => {
                    if let Some(&cell) = cells.get(&step.node) {
                        path.visited.push((cell, [step.t_near, step.t_far]));
                    }
                }
                Step::Pop { node, .. } => waiting.retain(|&(other, _)| other != node),
                Step::Primitive { id, .. } => {
                    path.tested.insert(id);
                }
                Step::Root(_) | Step::FinishEarly { .. } => {}
            }
        }
        let dropped = waiting.iter().filter_map(|(node, t)| Some((*cells.get(node)?, *t)));
        path.dropped = dropped.collect();
        path
    }

    pub(super) fn bars(&self) -> Vec<Bar> {
        let split = |it: &PathSplit| Bar {
            depth: it.cell.depth,
            t: it.t,
            fate: Fate::Split { axis: it.axis, t_split: it.t_split },
        };
        let leaf = |fate| move |&(cell, t): &(Cell<3>, _)| Bar { depth: cell.depth, t, fate };
        let visited = self.visited.iter().map(leaf(Fate::Visited));
        let dropped = self.dropped.iter().map(leaf(Fate::Dropped));
        self.splits.iter().map(split).chain(dropped).chain(visited).collect()
    }

    pub(super) fn summary(&self, hit: Option<Hit>) -> String {
        let end = match hit {
            Some(hit) => format!("hit triangle {} at t = {}", hit.primitive_id, readable(hit.t)),
            None => "no hit".to_owned(),
        };
        format!(
            "{} and {} visited, {} dropped from the stack, {} tested: {end}",
            counted(self.splits.len(), "inner node", "inner nodes"),
            counted(self.visited.len(), "leaf", "leaves"),
            counted(self.dropped.len(), "node", "nodes"),
            counted(self.tested.len(), "triangle", "triangles"),
        )
    }
}

/// The cells of the nodes that the steps name, and of their children.
fn cells_of(scene: &ShapeScene, steps: &[Step]) -> HashMap<u32, Cell<3>> {
    let tree = scene.tree();
    let mut cells = HashMap::new();
    cells.insert(0, Cell { node: 0, depth: 0, bounds: *tree.bounds() });
    for step in steps {
        let Step::Split(step) = step else { continue };
        let Some(cell) = cells.get(&step.node).copied() else { continue };
        if let NodeKind::Inner { axis, split, above } = tree.nodes()[step.node as usize].kind() {
            let (below_bounds, above_bounds) = cell.bounds.split(axis, split);
            let depth = cell.depth + 1;
            let below = step.node + 1;
            cells.insert(below, Cell { node: below, depth, bounds: below_bounds });
            cells.insert(above, Cell { node: above, depth, bounds: above_bounds });
        }
    }
    cells
}
