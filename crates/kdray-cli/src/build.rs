//! Building a tree with progress and Ctrl-C.

use crate::{args::BuildArgs, cli::Globals, error::CliError, interrupt, progress::Progress};
use kdray::{Scene, TriangleMesh};

/// Builds a tree over `mesh`, and says how long it took.
pub(crate) fn scene(
    mesh: TriangleMesh,
    args: &BuildArgs,
    globals: &Globals,
) -> Result<Scene, CliError> {
    let triangles = mesh.triangles().len();
    let progress = Progress::start("building the tree", triangles as u64, "triangles", globals);
    let _watch = interrupt::watch();
    let scene = Scene::build_with_progress(mesh, &args.options(), &|done| {
        progress.set_fraction(done.fraction);
        interrupt::flow()
    })?;
    let (nodes, took) = (scene.tree().nodes().len(), progress.elapsed());
    progress
        .finish(&format!("built a tree of {nodes} nodes over {triangles} triangles in {took:.2?}"));
    Ok(scene)
}
