//! `kdray validate`: is the tree what it must be?

use crate::{
    args::{BuildArgs, SceneArgs, TableArgs},
    build,
    cli::Globals,
    error::CliError,
    load, output,
    progress::Progress,
    table::print_json,
    tree_file::{self, Trust},
    wording::counted,
};
use kdray::{Scene, ShapeScene};
use serde::Serialize;

/// Build the tree and check every invariant
///
/// Children partition their parents; each point of a triangle lies in the closed cell of some leaf
/// that lists the triangle; no leaf lists a triangle that has no part in its cell; no node is
/// deeper than 64. The first broken invariant is named, and the exit code is 1.
///
/// A tree file is verified: its checksum, its canonical tree, and that the wide tree is that of the
/// canonical one and the triangles.
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
    let limits = &args.build.limits;
    let split = args.build.split.map(|_| "--split");
    let given = split.into_iter().chain(limits.given());
    if let Some(scene) = tree_file::scene(&args.scene, Trust::Yes, given, limits, globals)? {
        let checked = verify(&scene, args, globals);
        return tell(checked, scene.shapes(), args);
    }
    let mesh = load::mesh(&args.scene, globals)?;
    let scene = build::shapes(mesh, &args.build.options(), globals)?;
    let checked = scene.tree().validate(scene.primitives());
    tell(checked.map_err(CliError::Tree), &scene, args)
}

/// Verifies the scene of a tree file.
fn verify(scene: &Scene, args: &Args, globals: &Globals) -> Result<(), CliError> {
    let progress = Progress::spin("verifying", globals);
    let verified = scene.verify();
    let took = progress.elapsed();
    progress.finish(&format!("verified in {took:.2?}"));
    let path = args.scene.scene.clone().unwrap_or_default();
    verified.map_err(|reason| CliError::BrokenFile { path, reason })
}

/// Prints what was found.
fn tell(checked: Result<(), CliError>, scene: &ShapeScene, args: &Args) -> Result<(), CliError> {
    let (triangles, nodes) = (scene.primitives().triangles().len(), scene.tree().nodes().len());
    if args.table.json {
        let error = checked.as_ref().err().map(reason);
        print_json(&Finding { valid: checked.is_ok(), error, triangles, nodes })?;
    } else if checked.is_ok() {
        let of = counted(nodes, "node", "nodes");
        let over = counted(triangles, "triangle", "triangles");
        let line = format!("the tree is valid: {of} over {over}\n");
        output::print(line.as_bytes())?;
    }
    checked
}

/// What is broken, without where.
fn reason(error: &CliError) -> String {
    match error {
        CliError::Tree(error) => error.to_string(),
        CliError::BrokenFile { reason, .. } => reason.to_string(),
        error => error.to_string(),
    }
}
