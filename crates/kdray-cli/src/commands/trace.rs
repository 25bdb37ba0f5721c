//! `kdray trace`.

use crate::{args::SceneArgs, cli::Globals, error::CliError, load};

/// Show each step that one ray takes through the tree
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
}

/// Loads the scene.
pub(crate) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    load::model(&args.scene, globals)?;
    Ok(())
}
