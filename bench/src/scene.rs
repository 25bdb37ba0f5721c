//! What rays are traced through: triangles, a camera and a point light.

use crate::args::ViewArgs;
use crate::error::BenchError;
use crate::synthetic;
use glam::DVec3;
use kdray::{Aabb, TriangleMesh};
use kdray_render::{Y_UP, frame};
use kdray_scene::{Camera, LoadOptions, Projection, load};
use serde::Deserialize;
use std::fs;
use std::path::{Path, PathBuf};

/// The scenes of a run without `--scenes` if those beside the checkout are there.
const SHARED: [&str; 7] =
    ["bunny", "kitchen", "sponza", "conference", "dragon", "city_san_francisco", "terrain-2m"];

/// And if they are not.
const MADE: [&str; 3] = ["hall", "hair", "terrain-2m"];

/// The same for a quick run.
const SHARED_QUICK: [&str; 3] = ["bunny", "sponza", "dragon"];
const MADE_QUICK: [&str; 3] = ["hall", "hair", "terrain-300k"];

/// A scene to measure.
pub(crate) struct BenchScene {
    /// What it is called in tables.
    pub(crate) name: String,
    /// Its triangles.
    pub(crate) mesh: TriangleMesh,
    /// Where primary rays come from.
    pub(crate) camera: Camera,
    /// Where shadow rays go to.
    pub(crate) light: [f64; 3],
    /// The length of the diagonal of the triangles' box.
    pub(crate) diagonal: f64,
}

impl BenchScene {
    /// A scene of these parts.
    pub(crate) fn new(name: &str, mesh: TriangleMesh, camera: Camera, light: [f64; 3]) -> Self {
        let diagonal = bounds(&mesh).diagonal();
        Self { name: name.to_owned(), mesh, camera, light, diagonal }
    }

    /// The scene that is called so in scenes.json, or made by code, or the file of that name.
    pub(crate) fn find(name: &str, view: &ViewArgs) -> Result<Self, BenchError> {
        if let Some(listed) = Listing::read()?.find(name) {
            return listed.scene();
        }
        if let Some(made) = synthetic::scene(name) {
            return made;
        }
        let path = Path::new(name);
        if !path.exists() {
            return Err(BenchError::Usage(format!(
                "{name}: neither a mesh file, nor listed in ../shared/scenes/scenes.json, nor one \
                 of {}",
                synthetic::NAMES
            )));
        }
        from_file(path, view)
    }

    /// The names of the scenes of a run without `--scenes`.
    pub(crate) fn default_names(quick: bool) -> Vec<String> {
        let names: &[&str] = match (folder().join("scenes.json").exists(), quick) {
            (true, false) => &SHARED,
            (true, true) => &SHARED_QUICK,
            (false, false) => &MADE,
            (false, true) => &MADE_QUICK,
        };
        names.iter().map(|name| (*name).to_owned()).collect()
    }

    /// Whether scenes lie beside the checkout.
    pub(crate) fn has_shared() -> bool {
        folder().join("scenes.json").exists()
    }
}

/// The folder of scenes beside the checkout.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/scenes")
}

fn bounds(mesh: &TriangleMesh) -> Aabb<3> {
    let corners = mesh.triangles().iter().flatten().map(|&i| mesh.vertices()[i as usize]);
    Aabb::of_points(corners)
}

/// The content of scenes.json.
#[derive(Default, Deserialize)]
struct Listing {
    scenes: Vec<Listed>,
}

/// One of its scenes.
#[derive(Deserialize)]
struct Listed {
    name: String,
    file: String,
    camera: ListedCamera,
    point_light: [f64; 3],
}

#[derive(Deserialize)]
struct ListedCamera {
    eye: [f64; 3],
    look_at: [f64; 3],
    up: [f64; 3],
    vfov_deg: f64,
}

impl Listing {
    /// The listing beside the checkout; empty if there is none.
    fn read() -> Result<Self, BenchError> {
        let path = folder().join("scenes.json");
        if !path.exists() {
            return Ok(Self::default());
        }
        let text = fs::read(&path).map_err(|error| BenchError::io(&path, error))?;
        serde_json::from_slice(&text).map_err(|error| BenchError::io(&path, error))
    }

    fn find(self, name: &str) -> Option<Listed> {
        self.scenes.into_iter().find(|scene| scene.name == name)
    }
}

impl Listed {
    fn scene(self) -> Result<BenchScene, BenchError> {
        let mesh = read_mesh(&folder().join(&self.file))?;
        let camera = Camera {
            name: self.name.clone(),
            eye: self.camera.eye,
            look_at: self.camera.look_at,
            up: self.camera.up,
            projection: Projection::Perspective { vfov_degrees: self.camera.vfov_deg },
        };
        Ok(BenchScene::new(&self.name, mesh, camera, self.point_light))
    }
}

/// The triangles of a file; those that are not usable are left out.
fn read_mesh(path: &Path) -> Result<TriangleMesh, BenchError> {
    let model = load(path, &LoadOptions { drop_bad: true, ..LoadOptions::default() })?;
    Ok(TriangleMesh::new(model.vertices, model.triangles)?)
}

/// Any mesh file, seen as the arguments say, or else by its own first camera, or else framed.
fn from_file(path: &Path, view: &ViewArgs) -> Result<BenchScene, BenchError> {
    let model = load(path, &LoadOptions { drop_bad: true, ..LoadOptions::default() })?;
    let cameras = model.cameras;
    let mesh = TriangleMesh::new(model.vertices, model.triangles)?;
    let bounds = bounds(&mesh);
    let mut camera =
        cameras.into_iter().next().unwrap_or_else(|| frame(&bounds, view.up.unwrap_or(Y_UP), 1.0));
    camera.eye = view.eye.unwrap_or(camera.eye);
    camera.look_at = view.look_at.unwrap_or(camera.look_at);
    camera.up = view.up.unwrap_or(camera.up);
    if let Some(vfov_degrees) = view.fov {
        camera.projection = Projection::Perspective { vfov_degrees };
    }
    let light = view.light.unwrap_or_else(|| over_the_shoulder(&camera));
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    Ok(BenchScene::new(&name, mesh, camera, light))
}

/// A place above and to the left of the observer, half as far as what is looked at.
fn over_the_shoulder(camera: &Camera) -> [f64; 3] {
    let (eye, look_at) = (DVec3::from(camera.eye), DVec3::from(camera.look_at));
    let forward = look_at - eye;
    let right = forward.cross(camera.up.into()).normalize_or_zero();
    let up = right.cross(forward).normalize_or_zero();
    (eye + 0.5 * forward.length() * (up - right)).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_nothing_has_are_refused_with_those_that_there_are() {
        let error = BenchScene::find("nowhere.ply", &ViewArgs::default()).err().unwrap();
        assert!(error.to_string().contains("terrain-2m"), "{error}");
    }

    #[test]
    fn any_file_can_be_a_scene() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("one.obj");
        fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
        let view = ViewArgs { eye: Some([0.2, 0.2, 3.0]), ..ViewArgs::default() };
        let scene = BenchScene::find(path.to_str().unwrap(), &view).unwrap();
        assert_eq!((scene.name.as_str(), scene.mesh.triangles().len()), ("one.obj", 1));
        assert_eq!(scene.camera.eye, [0.2, 0.2, 3.0]);
        assert!((scene.diagonal - f64::sqrt(2.0)).abs() < 1e-12);
        assert!(scene.light[2] > 0.0);
    }
}
