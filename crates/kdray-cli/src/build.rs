//! Building a tree with progress and Ctrl-C.

use crate::{cli::Globals, error::CliError, interrupt, progress::Progress, wording::counted};
use kdray::{BuildOptions, BuildProgress, Scene, ShapeScene, TriangleMesh};
use kdray_render::World;
use kdray_scene::Model;
use std::ops::ControlFlow;

/// Builds the canonical tree over `mesh`, and says how long it took.
pub(crate) fn shapes(
    mesh: TriangleMesh,
    options: &BuildOptions,
    globals: &Globals,
) -> Result<ShapeScene, CliError> {
    let progress = start(mesh.triangles().len(), globals);
    let _watch = interrupt::watch();
    let step = |done| step(&progress, done);
    let shapes = ShapeScene::build_with_progress(mesh, options, &step)?;
    finish(progress, &shapes);
    Ok(shapes)
}

/// Builds the trees over `mesh`, and says how long it took.
pub(crate) fn scene(
    mesh: TriangleMesh,
    options: &BuildOptions,
    globals: &Globals,
) -> Result<Scene, CliError> {
    let progress = start(mesh.triangles().len(), globals);
    let _watch = interrupt::watch();
    let scene = Scene::build_with_progress(mesh, options, &|done| step(&progress, done))?;
    finish(progress, scene.shapes());
    Ok(scene)
}

/// Builds a tree over the triangles of `model`, and says how long it took.
pub(crate) fn world(
    model: Model,
    options: &BuildOptions,
    globals: &Globals,
) -> Result<World, CliError> {
    let progress = start(model.triangles.len(), globals);
    let _watch = interrupt::watch();
    let world = World::new_with_progress(model, options, &|done| step(&progress, done))?;
    finish(progress, world.scene().shapes());
    Ok(world)
}

fn start(triangles: usize, globals: &Globals) -> Progress {
    Progress::start("building the tree", triangles as u64, "triangles", globals)
}

fn step(progress: &Progress, done: BuildProgress) -> ControlFlow<()> {
    progress.set_fraction(done.fraction);
    interrupt::flow()
}

fn finish(progress: Progress, shapes: &ShapeScene) {
    let took = progress.elapsed();
    let nodes = counted(shapes.tree().nodes().len(), "node", "nodes");
    progress.finish(&format!("built a tree of {nodes} in {took:.2?}"));
}
