//! `kdray validate`: is the tree what it must be?

use crate::{
    args::{BuildArgs, SceneArgs, TableArgs},
    build,
    cli::Globals,
    error::CliError,
    load, output,
    table::print_json,
};
use serde::Serialize;

/// Build the tree and check every invariant
///
/// Children partition their parents; each point of a triangle lies in the closed cell of some leaf
/// that lists the triangle; no leaf lists a triangle that has no part in its cell; no node is
/// deeper than 64. The first broken invariant is named, and the exit code is 1.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example: check the tree of a mesh that is cut in the middle
  kdray validate bunny.ply --split middle")]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    build: BuildArgs,
    #[command(flatten)]
    table: TableArgs,
}

/// The finding under the names that it has in JSON.
#[derive(Debug, Serialize)]
struct Finding {
    valid: bool,
    /// What is broken.
    error: Option<String>,
    triangles: usize,
    nodes: usize,
}

/// Builds and checks.
pub(crate) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    let mesh = load::mesh(&args.scene, globals)?;
    let scene = build::shapes(mesh, &args.build.options(), globals)?;
    let checked = scene.tree().validate(scene.primitives());
    let (triangles, nodes) = (scene.primitives().triangles().len(), scene.tree().nodes().len());
    if args.table.json {
        let error = checked.err().map(|error| error.to_string());
        print_json(&Finding { valid: checked.is_ok(), error, triangles, nodes })?;
    } else if checked.is_ok() {
        let line = format!("the tree is valid: {nodes} nodes over {triangles} triangles\n");
        output::print(line.as_bytes())?;
    }
    Ok(checked?)
}
