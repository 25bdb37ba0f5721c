//! Skinned meshes, in the pose in which their joints stand in the file.

use super::accessors::Accessors;
use super::graph::Graph;
use crate::LoadError;
use ::gltf::json;
use glam::DMat4;
use std::collections::HashMap;
use std::rc::Rc;

/// The skins of a document, each made once, however many nodes have it.
pub(super) struct Skins<'a> {
    accessors: &'a Accessors<'a>,
    graph: &'a Graph,
    known: HashMap<usize, Rc<Skin>>,
}

impl<'a> Skins<'a> {
    pub(super) fn new(accessors: &'a Accessors<'a>, graph: &'a Graph) -> Self {
        Self { accessors, graph, known: HashMap::new() }
    }

    /// The skin of a node, if it has one.
    pub(super) fn of_node(&mut self, node: usize) -> Result<Option<Rc<Skin>>, LoadError> {
        let root = self.accessors.document.root;
        let Some(index) = root.nodes[node].skin else { return Ok(None) };
        if let Some(known) = self.known.get(&index.value()) {
            return Ok(Some(Rc::clone(known)));
        }
        let Some(json) = root.get(index) else { return Ok(None) };
        // A joint is a few bytes of JSON, but a matrix in memory.
        let numbers = 16 * json.joints.len() as u64;
        self.accessors.charge(numbers, &format!("skins[{}]", index.value()))?;
        let skin = Rc::new(self.read(json)?);
        self.known.insert(index.value(), Rc::clone(&skin));
        Ok(Some(skin))
    }

    fn read(&self, json: &json::Skin) -> Result<Skin, LoadError> {
        let inverse_bind = match json.inverse_bind_matrices {
            Some(index) => self.accessors.vectors::<16>(index, 16..=16)?,
            None => Vec::new(),
        };
        let joints = json.joints.iter().enumerate().map(|(i, joint)| {
            let placed = self.graph.transforms.get(joint.value()).copied().flatten();
            let inverse = inverse_bind.get(i).map_or(DMat4::IDENTITY, DMat4::from_cols_array);
            placed.unwrap_or(DMat4::IDENTITY) * inverse
        });
        Ok(Skin { joints: joints.collect() })
    }
}

/// Where each joint of a skin takes vertices, from the mesh to the world.
pub(super) struct Skin {
    joints: Vec<DMat4>,
}

impl Skin {
    /// The weighted mean of the transforms of a vertex's joints (linear blend skinning). Weights
    /// are scaled to a sum of 1; joints that are not there do not count.
    pub(super) fn transform(&self, joints: [f64; 4], weights: [f64; 4]) -> Option<DMat4> {
        let mut sum = DMat4::ZERO;
        let mut total = 0.0;
        for (joint, weight) in joints.into_iter().zip(weights) {
            if let Some(transform) = self.joints.get(joint as usize).filter(|_| weight > 0.0) {
                sum += *transform * weight;
                total += weight;
            }
        }
        (total > 0.0).then(|| sum * (1.0 / total))
    }
}
