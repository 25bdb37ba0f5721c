//! Reading a scene with progress.

use crate::{
    args::{SceneArgs, SceneFormat},
    cli::Globals,
    error::CliError,
    progress::{self, Progress},
    tree_file,
    wording::counted,
};
use kdray::TriangleMesh;
use kdray_scene::{LoadOptions, Model, built_in};
use std::{io, path::Path};

/// How many bytes standard input may have, which cannot be looked at beforehand.
const MAX_BYTES_OF_STDIN: u64 = 1 << 30;

/// Reads the scene that `args` name; the built-in one if they name none.
pub(crate) fn model(args: &SceneArgs, globals: &Globals) -> Result<Model, CliError> {
    tree_file::refuse(args)?;
    let name = args.scene.as_deref().unwrap_or(Path::new("the built-in scene")).display();
    let progress = Progress::spin(&format!("reading {name}"), globals);
    let model = match args.scene.as_deref() {
        None => built_in::showcase(),
        Some(path) if path == Path::new("-") => from_stdin(args)?,
        Some(path) => kdray_scene::load(path, &options(args, LoadOptions::default().max_bytes))?,
    };
    let took = progress.elapsed();
    let triangles = counted(model.triangles.len(), "triangle", "triangles");
    progress.finish(&format!("read {triangles} of {name} in {took:.2?}"));
    for warning in &model.warnings {
        progress::say(globals, &format!("warning: {warning}"));
    }
    Ok(model)
}

/// Reads the triangles of the scene that `args` name.
pub(crate) fn mesh(args: &SceneArgs, globals: &Globals) -> Result<TriangleMesh, CliError> {
    let model = model(args, globals)?;
    Ok(TriangleMesh::new(model.vertices, model.triangles)?)
}

fn from_stdin(args: &SceneArgs) -> Result<Model, CliError> {
    let Some(format) = args.format else {
        let missing =
            "a scene from standard input needs its format: give --format, for example ply";
        return Err(CliError::Usage(missing.to_owned()));
    };
    let options = options(args, MAX_BYTES_OF_STDIN);
    Ok(kdray_scene::read(io::stdin(), format.format(), "standard input", &options)?)
}

fn options(args: &SceneArgs, max_bytes: u64) -> LoadOptions {
    LoadOptions {
        format: args.format.map(SceneFormat::format),
        max_bytes: args.max_bytes.unwrap_or(max_bytes),
        drop_bad: args.drop_bad,
    }
}
