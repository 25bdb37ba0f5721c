//! `cargo xtask parity`: rays at the vertices and edges of closed meshes cross them an even number
//! of times. Ends with failure on any odd count.

#![forbid(unsafe_code)]

use kdray::{BuildOptions, Scene};
use kdray_tests::closed::closed_part;
use kdray_tests::command_line::{Arguments, refuse};
use kdray_tests::parity::from_outside;
use kdray_tests::shared::{load_mesh, scenes};
use std::io::{self, Write};
use std::process::ExitCode;
use std::time::Instant;

/// Without `--full` one of this many rays is traced.
const STEP: usize = 101;

fn main() -> io::Result<ExitCode> {
    let arguments = Arguments::of_this_program();
    let step = if arguments.has("--full") { 1 } else { STEP };
    let Some(scenes) = scenes() else { return Ok(ExitCode::FAILURE) };
    let names = scenes.iter().map(|scene| scene.name.as_str());
    if let Err(unknown) = arguments.check_names("--scenes", names, |asked, name| asked == name) {
        return refuse(&unknown);
    }
    let mut out = io::stdout();
    writeln!(
        out,
        "{:22} {:>9} {:>9} {:>10} {:>10} {:>5} {:>8}",
        "scene", "triangles", "in closed", "rays", "crossing", "odd", "time"
    )?;
    let mut good = true;
    for scene in scenes.iter().filter(|scene| arguments.chosen("--scenes", &scene.name)) {
        let mesh = load_mesh(scene).map_err(io::Error::other)?;
        let closed = closed_part(&mesh);
        let (triangles, kept) = (mesh.triangles().len(), closed.triangles().len());
        write!(out, "{:22} {triangles:9} {kept:9}", scene.name)?;
        if kept > 0 {
            let started = Instant::now();
            let scene = Scene::build(closed, &BuildOptions::default()).map_err(io::Error::other)?;
            let found = from_outside(&scene, step);
            let seconds = started.elapsed().as_secs_f64();
            write!(out, " {:10} {:10} {:5}", found.rays, found.crossing, found.odd)?;
            write!(out, " {seconds:6.1} s")?;
            if let Some(example) = found.example {
                write!(out, "\n    {example}")?;
            }
            good &= found.odd == 0;
        }
        writeln!(out)?;
    }
    Ok(if good { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
