//! Scenes from tree files.

use crate::{
    args::{LimitArgs, SceneArgs},
    cli::Globals,
    error::CliError,
    progress::Progress,
    wording::counted,
};
use kdray::Scene;
use std::path::Path;

/// How a tree file is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Trust {
    /// It is read, and all of it verified.
    No,
    /// It is mapped; header and structure are checked.
    Yes,
}

impl Trust {
    /// Whether the user says so.
    pub(crate) fn of(trusted: bool) -> Self {
        if trusted { Self::Yes } else { Self::No }
    }
}

/// The path of the scene that `args` name, if it is a tree file.
pub(crate) fn path(args: &SceneArgs) -> Option<&Path> {
    let path = args.scene.as_deref().filter(|path| *path != Path::new("-"))?;
    if args.format.is_some() {
        return None;
    }
    // What cannot be looked into is no tree file; whoever reads it says why.
    kdray_file::is_tree_file(path).unwrap_or(false).then_some(path)
}

/// The scene of the tree file that `args` name, if it is one. It was built with options of its own, so
/// that none may be `given`.
pub(crate) fn scene(
    args: &SceneArgs,
    trust: Trust,
    mut given: impl Iterator<Item = &'static str>,
    limits: &LimitArgs,
    globals: &Globals,
) -> Result<Option<Scene>, CliError> {
    let Some(path) = path(args) else { return Ok(None) };
    if let Some(option) = given.next() {
        let built = "is a tree file, which is built already; leave out";
        return Err(CliError::Usage(format!("{} {built} {option}", path.display())));
    }
    open(path, trust, limits, globals).map(Some)
}

fn open(
    path: &Path,
    trust: Trust,
    limits: &LimitArgs,
    globals: &Globals,
) -> Result<Scene, CliError> {
    let name = path.display();
    let (doing, done) = match trust {
        Trust::Yes => ("mapping", "mapped"),
        Trust::No => ("reading and verifying", "read and verified"),
    };
    let progress = Progress::spin(&format!("{doing} {name}"), globals);
    let scene = match trust {
        Trust::Yes => kdray_file::map(path)?,
        Trust::No => kdray_file::load(path, limits.memory_limit.unwrap_or_default().bytes())?,
    };
    let took = progress.elapsed();
    let nodes = counted(scene.tree().nodes().len(), "node", "nodes");
    let triangles = counted(scene.mesh().triangles().len(), "triangle", "triangles");
    progress.finish(&format!("{done} a tree of {nodes} over {triangles}, {name}, in {took:.2?}"));
    Ok(scene)
}

/// Refuses a tree file where a scene is needed that has more than triangles.
pub(crate) fn refuse(args: &SceneArgs) -> Result<(), CliError> {
    match path(args) {
        None => Ok(()),
        Some(path) => Err(CliError::input(
            path,
            "this is a tree file, which `query`, `stats` and `validate` take; give the scene it was built of",
        )),
    }
}
