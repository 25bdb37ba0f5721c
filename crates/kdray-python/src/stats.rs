//! The figures of a scene.

use crate::surface;
use crate::tree::{Kind, Places, Tree};
use kdray::layout::WideTree;
use kdray::{CostModel, InstancedScene, Precision, Scene, TreeStats};
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
    let geometries = match &tree.places {
        Places::One => 1,
        Places::Many(firsts) => firsts.len(),
        Places::Instances(_) => surface::meshes(tree).len(),
    };
    let instances = surface::instances(tree).len();
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
    match &tree.kind {
        Kind::F32(scene) => measure_scene(scene),
        Kind::F64(scene) => measure_scene(scene),
        Kind::Copies32(scene) => measure_copies(scene),
        Kind::Copies64(scene) => measure_copies(scene),
    }
}

fn measure_scene<T: Precision>(scene: &Scene<T>) -> (TreeStats, usize) {
    let triangles = scene.mesh().triangles().len();
    let wide = scene.wide_tree().map_or(0, WideTree::bytes);
    (scene.tree().stats(triangles, &CostModel::default()), wide)
}

fn measure_copies<T: Precision>(scene: &InstancedScene<T>) -> (TreeStats, usize) {
    let trees = scene.geometries().iter().filter_map(Scene::wide_tree);
    let figures = scene.tree().stats(scene.instances().len(), &CostModel::default());
    (figures, trees.map(WideTree::bytes).sum())
}
