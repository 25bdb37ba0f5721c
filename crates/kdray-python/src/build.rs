//! From meshes to a tree.

use crate::error::{ArgumentError, BuildError, argument};
use crate::job::{Control, Job};
use crate::mesh::{AnyMesh, Mesh, refused};
use crate::tree::{Kind, Places, Tree};
use kdray::query::InstancedSceneError;
use kdray::query::Precision;
use kdray::tree::MAX_DEPTH;
use kdray::{BuildOptions, BuildProgress, Coordinate, Instance, InstancedScene, Preset, Scene};
use kdray::{Strategy, TriangleMesh};
use pyo3::{PyResult, Python};
use std::collections::HashSet;
use std::ops::{ControlFlow, Range};

/// What the library is asked for, by the words of the command line.
pub(crate) fn options(
    preset: Option<&str>,
    split: Option<&str>,
    leaf_size: Option<i64>,
    max_depth: Option<i64>,
    memory_limit: Option<i64>,
) -> PyResult<BuildOptions> {
    let options = match (preset, split) {
        (Some(_), Some(_)) => {
            return Err(ArgumentError::new_err("preset, split: give one of them, not both"));
        }
        (None, None) => BuildOptions::default(),
        (Some(preset), None) => {
            let preset: Preset = preset.parse().map_err(|error| argument("preset", error))?;
            BuildOptions::preset(preset)
        }
        (None, Some(split)) => {
            let strategy: Strategy = split.parse().map_err(|error| argument("split", error))?;
            BuildOptions::for_strategy(strategy)
        }
    };
    let whole = |name, number: i64, most: usize| {
        let number = usize::try_from(number).ok().filter(|&number| number <= most);
        number.ok_or_else(|| argument(name, format!("give a whole number from 0 to {most}")))
    };
    let leaf_size = leaf_size.map(|size| whole("leaf_size", size, 1 << 30)).transpose()?;
    let max_depth = max_depth.map(|depth| whole("max_depth", depth, MAX_DEPTH)).transpose()?;
    let leaf_size = leaf_size.unwrap_or(options.leaf_size);
    let bytes =
        |limit: i64| u64::try_from(limit).map_err(|_| argument("memory_limit", "give bytes"));
    let memory_limit = memory_limit.map(bytes).transpose()?;
    Ok(BuildOptions { leaf_size, max_depth, memory_limit, ..options })
}

/// The tree over all triangles of `meshes`.
pub(crate) fn build(
    py: Python<'_>,
    meshes: &[&Mesh],
    is_double: bool,
    options: &BuildOptions,
    job: &Job,
) -> PyResult<Tree> {
    let total = count(meshes);
    job.run(py, total as u64, |control| {
        let kind = if is_double {
            Kind::F64(scene(joined(meshes)?, options, control, 0..total)?)
        } else {
            Kind::F32(scene(joined(meshes)?, options, control, 0..total)?)
        };
        Ok(Tree { places: places(meshes), ..Tree::from(kind) })
    })
}

/// Where copies of the geometries are: each a geometry, a matrix, and who sees it.
pub(crate) type Copies = Vec<(u32, [[f64; 4]; 3], u32)>;

/// The tree over placed copies of `meshes`. Those that have none are where they are.
pub(crate) fn build_instanced(
    py: Python<'_>,
    meshes: &[&Mesh],
    copies: Copies,
    is_double: bool,
    options: &BuildOptions,
    job: &Job,
) -> PyResult<Tree> {
    let placed = copies.len() as u32;
    let needed = options.peak_bytes(count(meshes))
        + InstancedScene::<f32>::peak_bytes(copies.len() + meshes.len())
        + size_of_val(&*copies) as u64;
    if let Some(limit) = options.memory_limit.filter(|&limit| needed > limit) {
        let error = kdray::BuildError::Memory { needed, limit };
        return Err(BuildError::new_err(error.to_string()));
    }
    job.run(py, count(meshes) as u64, |control| {
        let kind = if is_double {
            Kind::Copies64(placed_copies(meshes, &copies, options, control)?)
        } else {
            Kind::Copies32(placed_copies(meshes, &copies, options, control)?)
        };
        Ok(Tree { places: Places::Instances(placed), ..Tree::from(kind) })
    })
}

fn placed_copies<T: Precision>(
    meshes: &[&Mesh],
    copies: &Copies,
    options: &BuildOptions,
    control: &Control,
) -> PyResult<InstancedScene<T>> {
    let (mut geometries, mut before) = (Vec::with_capacity(meshes.len()), 0);
    for mesh in meshes {
        let triangles = before..before + mesh.0.len();
        before = triangles.end;
        geometries.push(scene(joined(&[mesh])?, options, control, triangles)?);
    }
    let has_copy: HashSet<u32> = copies.iter().map(|&(geometry_id, ..)| geometry_id).collect();
    let ids = 0..geometries.len() as u32;
    let as_they_are = ids.filter(|id| !has_copy.contains(id)).map(Instance::of);
    let placed = |&(geometry_id, to_world, mask)| Instance { geometry_id, to_world, mask };
    let instances = copies.iter().map(placed).chain(as_they_are).collect();
    let go_on =
        |_| if control.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    InstancedScene::build_with_progress(geometries, instances, None, &go_on).map_err(|error| {
        match error {
            InstancedSceneError::Build(error) => BuildError::new_err(error.to_string()),
            error => argument("transform", error),
        }
    })
}

/// How many triangles there are.
fn count(meshes: &[&Mesh]) -> usize {
    meshes.iter().map(|mesh| mesh.0.len()).sum()
}

/// The tree over a mesh, whose triangles have these numbers among all that are built over.
fn scene<T: Precision>(
    mesh: TriangleMesh<T>,
    options: &BuildOptions,
    control: &Control,
    triangles: Range<usize>,
) -> PyResult<Scene<T>> {
    let progress = |done: BuildProgress| {
        let of_these = (done.fraction * triangles.len() as f64) as u64;
        control.set(triangles.start as u64 + of_these);
        if control.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let scene = Scene::build_with_progress(mesh, options, &progress);
    scene.map_err(|error| BuildError::new_err(error.to_string()))
}

/// Where the triangles of each mesh are among those of all.
fn places(meshes: &[&Mesh]) -> Places {
    if meshes.len() == 1 {
        return Places::One;
    }
    let mut next = 0;
    let first = |mesh: &&Mesh| {
        let first = next;
        next += mesh.0.len() as u32;
        first
    };
    Places::Many(meshes.iter().map(first).collect())
}

/// All meshes in one, with vertices of one precision.
fn joined<T: Coordinate>(meshes: &[&Mesh]) -> PyResult<TriangleMesh<T>> {
    let (mut vertices, mut triangles) = (Vec::<[T; 3]>::new(), Vec::new());
    for mesh in meshes {
        let (before, faces) = (vertices.len(), mesh.0.triangles());
        match &mesh.0 {
            AnyMesh::F32(mesh) => {
                let positions = mesh.vertices().iter();
                vertices.extend(positions.map(|p| p.map(|x| T::from_f64(x.into()))));
            }
            AnyMesh::F64(mesh) => {
                vertices.extend(mesh.vertices().iter().map(|p| p.map(T::from_f64)));
            }
        }
        let too_many =
            || argument("vertices", "all geometries together have 2^32 or more; add fewer");
        u32::try_from(vertices.len()).map_err(|_| too_many())?;
        triangles.extend(faces.iter().map(|face| face.map(|vertex| vertex + before as u32)));
    }
    TriangleMesh::new(vertices, triangles).map_err(refused)
}
