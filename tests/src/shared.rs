//! The meshes and cameras that lie beside the checkout, in `../shared/scenes`.

use kdray::TriangleMesh;
use kdray_scene::{LoadOptions, load};
use serde::Deserialize;
use std::path::PathBuf;

/// What `scenes.json` says of a scene.
#[derive(Clone, Debug, Deserialize)]
pub struct SceneInfo {
    /// Its name.
    pub name: String,
    /// The file in the same folder.
    pub file: String,
    /// How many triangles it has.
    pub triangles: usize,
    /// Where it is best seen from; some scenes have none.
    pub camera: Option<CameraInfo>,
    /// Where a lamp lights it well.
    pub point_light: Option<[f64; 3]>,
}

/// A camera of `scenes.json`.
#[derive(Clone, Copy, Debug, Deserialize)]
pub struct CameraInfo {
    /// The observer.
    pub eye: [f64; 3],
    /// The middle of the picture.
    pub look_at: [f64; 3],
    /// What points up.
    pub up: [f64; 3],
    /// The vertical field of view in degrees.
    pub vfov_deg: f64,
}

impl SceneInfo {
    /// Where its file lies.
    pub fn path(&self) -> PathBuf {
        folder().join(&self.file)
    }
}

/// All scenes, or `None` if the folder is not there. Then this says so, or panics if the
/// environment variable `CI` is set, for there nothing may be left out in silence.
///
/// # Panics
/// As said, or if `scenes.json` cannot be understood.
pub fn scenes() -> Option<Vec<SceneInfo>> {
    #[derive(Deserialize)]
    struct Listing {
        scenes: Vec<SceneInfo>,
    }
    let path = folder().join("scenes.json");
    let Ok(text) = std::fs::read_to_string(&path) else {
        missing(&format!("{} is not there", path.display()));
        return None;
    };
    let listing: Listing = serde_json::from_str(&text).expect("scenes.json is as documented");
    Some(listing.scenes)
}

/// The mesh of a scene, without the triangles that have bad vertices.
///
/// # Errors
/// A sentence that names the file.
pub fn load_mesh(scene: &SceneInfo) -> Result<TriangleMesh, String> {
    let options = LoadOptions { drop_bad: true, ..LoadOptions::default() };
    let path = scene.path();
    let model = load(&path, &options).map_err(|error| error.to_string())?;
    TriangleMesh::new(model.vertices, model.triangles).map_err(|error| error.to_string())
}

/// Says that something is left out because a file is not there, or panics if the environment variable `CI` is set.
///
/// # Panics
/// As said.
pub fn missing(what: &str) {
    assert!(std::env::var_os("CI").is_none(), "{what}");
    skipped(what);
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../shared/scenes")
}

#[expect(clippy::print_stderr, reason = "a test that was not run must say so")]
fn skipped(reason: &str) {
    eprintln!("skipped: {reason}");
}
