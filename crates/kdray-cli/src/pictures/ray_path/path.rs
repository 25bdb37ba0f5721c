//! The steps of a ray, sorted by what they say about cells.

use super::super::cells::cells_on_the_way;
use super::super::t_diagram::{Bar, Fate};
use crate::wording::{counted, readable};
use kdray::tree::Cell;
use kdray::{
    Hit, ShapeScene,
    traverse::{Step, TraversalCase},
};
use std::collections::HashSet;

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
        let visited = steps.iter().filter_map(|step| match step {
            Step::Split(step) => Some(step.node),
            _ => None,
        });
        let cells = cells_on_the_way(scene.tree(), visited);
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
