//! The figures of a scene.

use crate::surface;
use crate::tree::{Kind, Places, Tree};
use kdray::{CostModel, KdTree, TreeStats};
use pyo3::types::{PyDict, PyDictMethods};
use pyo3::{Bound, PyResult, Python, pyfunction};

/// The figures of a scene under the names that the command `kdray stats` gives them. Where there are instances,
/// those of the tree are of the tree over them.
#[pyfunction]
pub(crate) fn stats<'py>(py: Python<'py>, tree: &Tree) -> PyResult<Bound<'py, PyDict>> {
    let (figures, wide_bytes) = py.detach(|| measure(tree));
    let dict = PyDict::new(py);
    let (mut triangles, mut vertices) = (0, 0);
    for mesh in surface::meshes(tree) {
        triangles += mesh.triangles().len();
        vertices += mesh.vertex_count();
    }
    let (geometries, instances) = match (&tree.places, &tree.kind) {
        (Places::Many(firsts), _) => (firsts.len(), 0),
        (_, Kind::Instanced(scene)) => (scene.geometries().len(), scene.instances().len()),
        _ => (1, 0),
    };
    let bounds = py.detach(|| surface::bounds(tree)).map(|corners| corners.map(|it| it.to_vec()));
    let [low, high] = bounds.map_or([None, None], |corners| corners.map(Some));
    dict.set_item("triangles", triangles)?;
    dict.set_item("vertices", vertices)?;
    dict.set_item("geometries", geometries)?;
    dict.set_item("instances", instances)?;
    dict.set_item("bounds_min", low)?;
    dict.set_item("bounds_max", high)?;
    dict.set_item("nodes", figures.nodes)?;
    dict.set_item("leaves", figures.leaves)?;
    dict.set_item("empty_leaves", figures.empty_leaves)?;
    dict.set_item("max_depth", figures.max_depth)?;
    dict.set_item("largest_leaf", figures.largest_leaf)?;
    dict.set_item("references", figures.references)?;
    dict.set_item("references_per_triangle", figures.references_per_primitive)?;
    dict.set_item("sah_cost", figures.sah_cost)?;
    dict.set_item("bytes", figures.bytes)?;
    dict.set_item("wide_bytes", wide_bytes)?;
    dict.set_item("leaves_at_depth", figures.leaves_at_depth)?;
    Ok(dict)
}

/// The canonical tree's figures, and the bytes of the wide trees.
fn measure(tree: &Tree) -> (TreeStats, usize) {
    let of = |tree: &KdTree, count| tree.stats(count, &CostModel::default());
    match &tree.kind {
        Kind::F32(scene) => {
            let wide = scene.wide_tree().map_or(0, kdray::layout::WideTree::bytes);
            (of(scene.tree(), scene.mesh().triangles().len()), wide)
        }
        Kind::F64(scene) => {
            let wide = scene.wide_tree().map_or(0, kdray::layout::WideTree::bytes);
            (of(scene.tree(), scene.mesh().triangles().len()), wide)
        }
        Kind::Instanced(scene) => {
            let trees = scene.geometries().iter().filter_map(kdray::Scene::wide_tree);
            (
                of(scene.tree(), scene.instances().len()),
                trees.map(kdray::layout::WideTree::bytes).sum(),
            )
        }
    }
}
