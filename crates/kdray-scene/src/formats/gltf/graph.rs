//! The nodes of a scene and where they stand.

use super::Document;
use super::accessors::Accessors;
use crate::LoadError;
use ::gltf::json::{Index, Node};
use glam::{DMat4, DQuat, DVec3, Mat4};

/// A node that belongs to the scene.
pub(super) struct PlacedNode {
    pub(super) index: usize,
    /// From the node to the world.
    pub(super) transform: DMat4,
}

/// The nodes of the default scene, or of the first one, or all if there is none.
pub(super) struct Graph {
    /// Parents before children, in the order of the file.
    pub(super) visited: Vec<PlacedNode>,
    /// By index; none for nodes outside the scene.
    pub(super) transforms: Vec<Option<DMat4>>,
}

impl Graph {
    pub(super) fn new(document: Document<'_>) -> Result<Self, LoadError> {
        let nodes = &document.root.nodes;
        let mut graph = Self { visited: Vec::new(), transforms: vec![None; nodes.len()] };
        let mut stack: Vec<(usize, DMat4)> =
            roots(document).into_iter().rev().map(|node| (node, DMat4::IDENTITY)).collect();
        while let Some((index, parent)) = stack.pop() {
            let path = format!("nodes[{index}]");
            let node = nodes.get(index).ok_or_else(|| document.invalid(&path, "missing"))?;
            if graph.transforms[index].is_some() {
                let reason = "is reached twice: it has two parents, or is its own ancestor";
                return Err(document.invalid(&path, reason));
            }
            let transform = parent * local_transform(node);
            graph.transforms[index] = Some(transform);
            graph.visited.push(PlacedNode { index, transform });
            let children = node.children.iter().flatten().rev();
            stack.extend(children.map(|child| (child.value(), transform)));
        }
        Ok(graph)
    }
}

fn roots(document: Document<'_>) -> Vec<usize> {
    let root = document.root;
    let scene = root.scene.map_or(0, |scene| scene.value());
    if let Some(scene) = root.scenes.get(scene) {
        return scene.nodes.iter().map(Index::value).collect();
    }
    let mut is_child = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|node| node.children.iter().flatten()) {
        if let Some(slot) = is_child.get_mut(child.value()) {
            *slot = true;
        }
    }
    (0..root.nodes.len()).filter(|&node| !is_child[node]).collect()
}

fn local_transform(node: &Node) -> DMat4 {
    if let Some(columns) = node.matrix {
        return Mat4::from_cols_array(&columns).as_dmat4();
    }
    let vector = |value: Option<[f32; 3]>, missing: DVec3| {
        value.map_or(missing, |value| DVec3::from(value.map(f64::from)))
    };
    let rotation = node.rotation.map_or(DQuat::IDENTITY, |q| rotation(q.0.map(f64::from)));
    DMat4::from_scale_rotation_translation(
        vector(node.scale, DVec3::ONE),
        rotation,
        vector(node.translation, DVec3::ZERO),
    )
}

/// The rotation by a quaternion x, y, z, w of any length; none by one of no length.
fn rotation(quaternion: [f64; 4]) -> DQuat {
    let length = quaternion.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 && length.is_finite() {
        DQuat::from_array(quaternion.map(|x| x / length))
    } else {
        DQuat::IDENTITY
    }
}

/// Where the copies of a node's mesh stand: one, or many with `EXT_mesh_gpu_instancing`.
pub(super) fn instances(
    accessors: &Accessors<'_>,
    node: &PlacedNode,
) -> Result<Vec<DMat4>, LoadError> {
    const EXTENSION: &str = "EXT_mesh_gpu_instancing";
    let document = accessors.document;
    let extensions = document.root.nodes[node.index].extensions.as_ref();
    let Some(instancing) = extensions.and_then(|known| known.others.get(EXTENSION)) else {
        return Ok(vec![node.transform]);
    };
    let path = format!("nodes[{}].extensions.{EXTENSION}", node.index);
    let accessor = |name: &str| {
        let index = instancing.get("attributes").and_then(|attributes| attributes.get(name));
        let Some(index) = index else { return Ok(None) };
        match index.as_u64().and_then(|index| u32::try_from(index).ok()) {
            Some(index) => Ok(Some(Index::new(index))),
            None => Err(document.invalid(&path, "an attribute is no index")),
        }
    };
    let vectors =
        |name: &str| accessor(name)?.map(|index| accessors.vectors::<3>(index, 3..=3)).transpose();
    let (translations, scales) = (vectors("TRANSLATION")?, vectors("SCALE")?);
    let rotations = accessor("ROTATION")?.map(|index| accessors.vectors::<4>(index, 4..=4));
    let rotations = rotations.transpose()?;
    let lengths = [
        translations.as_ref().map(Vec::len),
        rotations.as_ref().map(Vec::len),
        scales.as_ref().map(Vec::len),
    ];
    let count = lengths.into_iter().flatten().min().unwrap_or(0);
    if lengths.into_iter().flatten().any(|length| length != count) {
        return Err(document.invalid(&path, "attributes of different lengths"));
    }
    let at = |list: &Option<Vec<[f64; 3]>>, i: usize, missing: DVec3| {
        list.as_ref().map_or(missing, |list| DVec3::from(list[i]))
    };
    Ok((0..count)
        .map(|i| {
            let turned = rotations.as_ref().map_or(DQuat::IDENTITY, |list| rotation(list[i]));
            let (scale, place) = (at(&scales, i, DVec3::ONE), at(&translations, i, DVec3::ZERO));
            node.transform * DMat4::from_scale_rotation_translation(scale, turned, place)
        })
        .collect())
}
