//! Which scene.

use super::bytes;
use clap::ValueEnum;
use kdray_scene::Format;
use std::path::PathBuf;

/// Which scene to read, and how.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct SceneArgs {
    /// The scene: an OBJ, PLY, STL, OFF, glTF or GLB file, also with .gz or .zst behind; `-` reads
    /// standard input and needs --format. Without it, the built-in scene. Only `query`, `stats` and
    /// `validate` take a tree file of `build`, too
    #[arg(value_name = "SCENE")]
    pub(crate) scene: Option<PathBuf>,
    /// The format, whatever the file's name and content tell; without it they decide
    #[arg(long, value_name = "FORMAT", requires = "scene")]
    pub(crate) format: Option<SceneFormat>,
    /// Refuse a file that is longer than this after decompression, or glTF buffers that together
    /// are, such as 16GiB or 500MB; without it 8 GiB, and 1 GiB from standard input
    #[arg(long, value_name = "SIZE", value_parser = bytes, requires = "scene")]
    pub(crate) max_bytes: Option<u64>,
    /// Drop triangles with indices out of range or vertices that are not finite, and count them;
    /// without it they are an error
    #[arg(long, requires = "scene")]
    pub(crate) drop_bad: bool,
}

/// The formats by their names on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SceneFormat {
    /// Wavefront OBJ
    Obj,
    /// Stanford PLY
    Ply,
    /// Stereolithography
    Stl,
    /// Object file format
    Off,
    /// glTF 2.0, JSON or binary
    Gltf,
    /// The same as gltf
    Glb,
}

impl SceneFormat {
    /// The library's name for it.
    pub(crate) fn format(self) -> Format {
        match self {
            Self::Obj => Format::Obj,
            Self::Ply => Format::Ply,
            Self::Stl => Format::Stl,
            Self::Off => Format::Off,
            Self::Gltf | Self::Glb => Format::Gltf,
        }
    }
}
