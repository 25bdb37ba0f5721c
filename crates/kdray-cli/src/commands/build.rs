//! `kdray build`: a tree file, to be used instead of the scene.

use crate::{
    args::{FastBuildArgs, SceneArgs},
    build,
    cli::Globals,
    error::CliError,
    interrupt, load,
    output::{Output, check_is_no_input},
    progress::Progress,
};
use kdray::Scene;
use std::{
    io::{self, Write},
    path::{Path, PathBuf},
};

/// Build the tree and save it to a file
///
/// `query`, `stats` and `validate` take the file in the place of the scene. It holds the triangles and
/// their trees, as they lie in memory; materials, lights and cameras are not in it. The same scene and
/// options give the same bytes.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example: build once, ask often
  kdray build bunny.ply -o bunny.kdray
  kdray query bunny.kdray --trusted --rays rays.npy --out hits.npz")]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The file to write; by custom its name ends in .kdray
    #[arg(long, short, value_name = "TREE.kdray")]
    out: PathBuf,
    #[command(flatten)]
    build: FastBuildArgs,
}

/// Builds and saves.
pub(crate) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    check_out(args)?;
    // Before the work whose result it is to hold.
    let output = Output::create(&args.out)?;
    let mesh = load::mesh(&args.scene, globals)?;
    let scene = build::scene(mesh, &args.build.options(), globals)?;
    write(&scene, output, &args.out, globals)
}

/// Refuses the scene's own file, and standard output.
fn check_out(args: &Args) -> Result<(), CliError> {
    if args.out == Path::new("-") {
        let refused = "a tree file does not go to standard output; give a name, such as tree.kdray";
        return Err(CliError::Usage(format!("--out -: {refused}")));
    }
    check_is_no_input(&args.out, args.scene.scene.as_deref())
}

fn write(
    scene: &Scene,
    mut output: Output,
    path: &Path,
    globals: &Globals,
) -> Result<(), CliError> {
    let bytes = scene.saved_bytes();
    let progress = Progress::start("saving", bytes, "bytes", globals);
    let _watch = interrupt::watch();
    let file = output.file();
    let saved = scene.save(|piece| {
        progress.advance(piece.len() as u64);
        if interrupt::flow().is_break() {
            return Err(CliError::Interrupted);
        }
        file.write_all(piece).map_err(|error: io::Error| CliError::output(path, error))
    });
    saved?;
    output.commit()?;
    let per_triangle = bytes as f64 / scene.mesh().triangles().len().max(1) as f64;
    let took = progress.elapsed();
    progress.finish(&format!(
        "saved {bytes} bytes, {per_triangle:.1} a triangle, in {took:.2?}: {}",
        path.display()
    ));
    Ok(())
}
