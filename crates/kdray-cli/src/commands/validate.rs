//! `kdray validate`: is the tree what it must be?.

use crate::{
    args::{BuildArgs, SceneArgs, TableArgs},
    build,
    cli::Globals,
    error::CliError,
    load,
};

/// Check every invariant of the tree
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    build: BuildArgs,
    #[command(flatten)]
    table: TableArgs,
}

/// Builds the tree.
pub(crate) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    let model = load::model(&args.scene, globals)?;
    let mesh = kdray::TriangleMesh::new(model.vertices, model.triangles)?;
    build::scene(mesh, &args.build, globals)?;
    Ok(())
}
