//! Skinned meshes, in the pose in which their joints stand in the file.

use super::accessors::Accessors;
use super::graph::Graph;
use crate::LoadError;
use glam::DMat4;

/// Where each joint of a node's skin takes vertices, from the mesh to the world.
pub(super) struct Skin {
    joints: Vec<DMat4>,
}

impl Skin {
    /// The skin of a node, if it has one.
    pub(super) fn of_node(
        accessors: &Accessors<'_>,
        graph: &Graph,
        node: usize,
    ) -> Result<Option<Self>, LoadError> {
        let root = accessors.document.root;
        let Some(skin) = root.nodes[node].skin.and_then(|skin| root.get(skin)) else {
            return Ok(None);
        };
        let inverse_bind = match skin.inverse_bind_matrices {
            Some(index) => accessors.vectors::<16>(index, 16..=16)?,
            None => Vec::new(),
        };
        let joints = skin.joints.iter().enumerate().map(|(i, joint)| {
            let placed = graph.transforms.get(joint.value()).copied().flatten();
            let inverse = inverse_bind.get(i).map_or(DMat4::IDENTITY, DMat4::from_cols_array);
            placed.unwrap_or(DMat4::IDENTITY) * inverse
        });
        Ok(Some(Self { joints: joints.collect() }))
    }

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
