//! Saved trees: a [`Scene`] to a file, and back by reading it or by mapping it into memory.
//!
//! The format, and what is checked when, is described in [`kdray::file`].
//!
//! | | takes | promises |
//! |---|---|---|
//! | [`load`] | about as long as a build | right answers, whoever made the file |
//! | [`map`] | some 20 ms for a million triangles | right answers if the file is as kdray wrote it; else perhaps wrong ones, but no panic and no endless loop |
//! | `map`, then [`Scene::verify`] | as `load` | as `load`, for as long as nobody changes the file |
//!
//! Vertices in f32 and in f64 are saved as they are. Who does not know what a file has takes [`load_any`] or
//! [`map_any`].
//!
//! ```
//! # use kdray::{BuildOptions, Ray, Scene, TriangleMesh};
//! # let corners = vec![[0.0_f32, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
//! # let scene = Scene::build(TriangleMesh::new(corners, vec![[0, 1, 2]])?, &BuildOptions::default())?;
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("scene.kdray");
//! kdray_file::save(&scene, &path)?;
//! let mapped = kdray_file::map::<f32>(&path)?;
//! let ray = Ray::new([0.25, 0.25, 0.0], [0.0, 0.0, 1.0]);
//! assert_eq!(mapped.closest_hit(&ray), scene.closest_hit(&ray));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]

mod error;
mod output;
mod read;
mod save;

pub use error::TreeFileError;
pub use output::Output;
pub use read::{is_tree_file, load, load_any, map, map_any};
pub use save::save;

#[cfg(doc)]
use kdray::Scene;
