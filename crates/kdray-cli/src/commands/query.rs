//! `kdray query`.

use crate::{args::SceneArgs, cli::Globals, error::CliError, load};

/// Answer a file of rays
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
