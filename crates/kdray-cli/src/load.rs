//! Reading a scene with progress.

use crate::{args::SceneArgs, cli::Globals, error::CliError};
use kdray_scene::Model;

/// Reads the scene that `args` name; the built-in one if they name none.
pub(crate) fn model(_args: &SceneArgs, _globals: &Globals) -> Result<Model, CliError> {
    Ok(Model::default())
}
