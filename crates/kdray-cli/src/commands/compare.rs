//! `kdray compare`.

use crate::{args::SceneArgs, cli::Globals, error::CliError, load};

/// Compare the four ways to choose the splitting plane
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
