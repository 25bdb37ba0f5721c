//! Which scene.

use std::path::PathBuf;

/// Which scene to read, and how.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct SceneArgs {
    /// The scene: an OBJ, PLY, STL, OFF, glTF or GLB file, also with .gz or .zst behind; `-` reads
    /// standard input and needs --format. Without it, the built-in scene
    #[arg(value_name = "SCENE")]
    pub(crate) scene: Option<PathBuf>,
    /// Drop triangles with indices out of range or vertices that are not finite, and count them;
    /// without it they are an error
    #[arg(long)]
    pub(crate) drop_bad: bool,
}
