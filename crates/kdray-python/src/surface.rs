//! What the triangles of a scene are: vertices, faces, normals, points.

use crate::block::BLOCK;
use crate::job::{Control, each_part};
use crate::mesh::rows;
use crate::tree::{Kind, Places, Tree};
use glam::DVec3;
use kdray::geometry::TreeSpace;
use kdray::{Coordinate, Instance, KdTree, TriangleMesh};
use numpy::ndarray::ArrayView1;
use pyo3::{Bound, PyAny, PyResult, Python};

/// Which triangles: those of geometries, and the instances that place them.
type Ids<'a> = [ArrayView1<'a, i32>; 3];

/// A geometry's mesh.
#[derive(Clone, Copy, Debug)]
pub(crate) enum AMesh<'a> {
    F32(&'a TriangleMesh<f32>),
    F64(&'a TriangleMesh<f64>),
}

impl AMesh<'_> {
    pub(crate) fn triangles(&self) -> &[[u32; 3]] {
        match self {
            Self::F32(mesh) => mesh.triangles(),
            Self::F64(mesh) => mesh.triangles(),
        }
    }

    pub(crate) fn vertex_count(&self) -> usize {
        match self {
            Self::F32(mesh) => mesh.vertices().len(),
            Self::F64(mesh) => mesh.vertices().len(),
        }
    }

    fn corners(&self, id: u32) -> [[f64; 3]; 3] {
        match self {
            Self::F32(mesh) => mesh.corners(id).map(|p| p.map(f64::from)),
            Self::F64(mesh) => mesh.corners(id),
        }
    }
}

/// The meshes that the trees are over: those of each geometry where there are instances, else one of all.
pub(crate) fn meshes(tree: &Tree) -> Vec<AMesh<'_>> {
    match &tree.kind {
        Kind::F32(scene) => vec![AMesh::F32(scene.mesh())],
        Kind::F64(scene) => vec![AMesh::F64(scene.mesh())],
        Kind::Copies32(scene) => {
            scene.geometries().iter().map(|it| AMesh::F32(it.mesh())).collect()
        }
        Kind::Copies64(scene) => {
            scene.geometries().iter().map(|it| AMesh::F64(it.mesh())).collect()
        }
    }
}

/// Where copies are; none where there are no instances.
pub(crate) fn instances(tree: &Tree) -> &[Instance] {
    match &tree.kind {
        Kind::F32(_) | Kind::F64(_) => &[],
        Kind::Copies32(scene) => scene.instances(),
        Kind::Copies64(scene) => scene.instances(),
    }
}

/// The corners of the box around all triangles.
pub(crate) fn bounds(tree: &Tree) -> Option<[[f64; 3]; 2]> {
    match &tree.kind {
        Kind::F32(scene) => bounds_of(scene.mesh()),
        Kind::F64(scene) => bounds_of(scene.mesh()),
        Kind::Copies32(_) | Kind::Copies64(_) if !has_triangles(tree) => None,
        Kind::Copies32(scene) => bounds_of_tree(scene.tree(), scene.tree_space()),
        Kind::Copies64(scene) => bounds_of_tree(scene.tree(), scene.tree_space()),
    }
}

/// Whether any geometry has a triangle.
fn has_triangles(tree: &Tree) -> bool {
    meshes(tree).iter().any(|mesh| !mesh.triangles().is_empty())
}

/// Those of the tree over instances, which is in coordinates of its own.
fn bounds_of_tree(tree: &KdTree, space: &TreeSpace) -> Option<[[f64; 3]; 2]> {
    let bounds = tree.bounds();
    let in_world = |corner: [f32; 3]| {
        let center = space.center();
        [0, 1, 2].map(|k| f64::from(corner[k]) / space.scale() + center[k])
    };
    (!bounds.is_empty()).then(|| [bounds.min, bounds.max].map(in_world))
}

fn bounds_of<T: Coordinate>(mesh: &TriangleMesh<T>) -> Option<[[f64; 3]; 2]> {
    let (mut min, mut max) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for &vertex in mesh.triangles().as_flattened() {
        let position = mesh.vertices()[vertex as usize].map(T::to_f64);
        for (k, x) in position.into_iter().enumerate() {
            (min[k], max[k]) = (min[k].min(x), max[k].max(x));
        }
    }
    (!mesh.triangles().is_empty()).then_some([min, max])
}

/// The vertices of all geometries as one array.
pub(crate) fn vertices<'py>(tree: &Tree, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
    match &tree.kind {
        Kind::F32(scene) => rows(py, scene.mesh().vertices()),
        Kind::F64(scene) => rows(py, scene.mesh().vertices()),
        Kind::Copies32(scene) => {
            let lists: Vec<_> = scene.geometries().iter().map(|it| it.mesh().vertices()).collect();
            rows(py, &lists.concat())
        }
        Kind::Copies64(scene) => {
            let lists: Vec<_> = scene.geometries().iter().map(|it| it.mesh().vertices()).collect();
            rows(py, &lists.concat())
        }
    }
}

/// The faces of all geometries, by the indices of all vertices.
pub(crate) fn faces(tree: &Tree) -> Vec<[u32; 3]> {
    let (mut faces, mut before) = (Vec::new(), 0);
    for mesh in meshes(tree) {
        faces.extend(mesh.triangles().iter().map(|face| face.map(|vertex| vertex + before)));
        before += mesh.vertex_count() as u32;
    }
    faces
}

/// Unit normals; NaN where there is no such triangle, or it has no area.
pub(crate) fn normals(tree: &Tree, ids: Ids<'_>, control: &Control) -> PyResult<Vec<[f64; 3]>> {
    each(tree, ids, control, |_, placed| {
        let [a, b, c] = placed.corners.map(DVec3::from);
        let [ab, ac] = [b - a, c - a].map(|edge| placed.turned(edge));
        // Scaled, so that neither squares nor products leave the range of f64.
        let scale = ab.abs().max(ac.abs()).max_element();
        let normal = (ab / scale).cross(ac / scale).try_normalize()?;
        Some(if placed.instance.is_mirrored() { -normal } else { normal }.into())
    })
}

/// The points with the weights u and v; NaN where there is no such triangle.
pub(crate) fn positions(
    tree: &Tree,
    ids: Ids<'_>,
    [u, v]: [ArrayView1<'_, f64>; 2],
    control: &Control,
) -> PyResult<Vec<[f64; 3]>> {
    each(tree, ids, control, |index, placed| {
        let [a, b, c] = placed.corners.map(|corner| placed.moved(corner));
        let (u, v) = (*u.get(index)?, *v.get(index)?);
        Some([0, 1, 2].map(|k| (1.0 - u - v) * a[k] + u * b[k] + v * c[k]))
    })
}

/// A triangle, and where its instance puts it.
struct Placed {
    corners: [[f64; 3]; 3],
    /// As it is if there is none.
    instance: Instance,
}

impl Placed {
    /// The world's point for one of the geometry.
    fn moved(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        self.instance.to_world.map(|[a, b, c, offset]| a * x + b * y + c * z + offset)
    }

    /// The world's direction for one of the geometry. Edges are turned, and not corners moved: far away their digits
    /// would be lost.
    fn turned(&self, DVec3 { x, y, z }: DVec3) -> DVec3 {
        self.instance.to_world.map(|[a, b, c, _]| a * x + b * y + c * z).into()
    }
}

/// What `find` makes of each triangle, and of its index.
fn each(
    tree: &Tree,
    [primitives, geometries, instances]: Ids<'_>,
    control: &Control,
    find: impl Fn(usize, Placed) -> Option<[f64; 3]> + Send + Sync,
) -> PyResult<Vec<[f64; 3]>> {
    let meshes = meshes(tree);
    let one = |index: usize| {
        let ids = (*primitives.get(index)?, *geometries.get(index)?, *instances.get(index)?);
        find(index, place(tree, &meshes, ids)?)
    };
    let mut vectors = vec![[f64::NAN; 3]; primitives.len()];
    let parts = vectors.chunks_mut(BLOCK).enumerate().collect();
    each_part(
        control,
        parts,
        || (),
        |(), (index, vectors): (usize, &mut [[f64; 3]])| {
            let places = vectors.iter_mut().enumerate();
            places.for_each(|(i, place)| *place = one(index * BLOCK + i).unwrap_or([f64::NAN; 3]));
            Ok(())
        },
    )?;
    Ok(vectors)
}

/// The triangle where its instance puts it; none if there is no such triangle.
fn place(
    tree: &Tree,
    meshes: &[AMesh<'_>],
    (primitive, geometry, instance): (i32, i32, i32),
) -> Option<Placed> {
    let (primitive, geometry) = (u32::try_from(primitive).ok()?, usize::try_from(geometry).ok()?);
    let (mesh, id) = match &tree.places {
        Places::One => (meshes.first()?, primitive),
        Places::Many(firsts) => (meshes.first()?, firsts.get(geometry)?.checked_add(primitive)?),
        Places::Instances(_) => (meshes.get(geometry)?, primitive),
    };
    if id as usize >= mesh.triangles().len() {
        return None;
    }
    let corners = mesh.corners(id);
    let instances = instances(tree);
    if instances.is_empty() || instance < 0 {
        return Some(Placed { corners, instance: Instance::of(geometry as u32) });
    }
    Some(Placed { corners, instance: *instances.get(instance as usize)? })
}
