//! `cargo xtask pixels`: the command `kdray render` with each strategy, from the cameras of
//! scenes.json; all must give the same file, byte for byte. Ends with failure on any difference.

#![forbid(unsafe_code)]

use kdray::Strategy;
use kdray_tests::command_line::{Arguments, refuse};
use kdray_tests::shared::{SceneInfo, scenes};
use std::error::Error;
use std::io::{self, Write};
use std::path::Path;
use std::process::{Command, ExitCode};
use std::time::Instant;

/// What is rendered if `--scenes` does not say.
const SCENES: [&str; 5] = ["sponza", "conference", "dragon", "black_forest", "candela_city"];

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let arguments = Arguments::of_this_program();
    let Some(scenes) = scenes() else { return Ok(ExitCode::FAILURE) };
    let names = scenes.iter().map(|scene| scene.name.as_str());
    if let Err(unknown) = arguments.check_names("--scenes", names, |asked, name| asked == name) {
        return Ok(refuse(&unknown)?);
    }
    let asked = arguments.value("--scenes").is_some();
    let chosen = |scene: &&SceneInfo| match asked {
        true => arguments.chosen("--scenes", &scene.name),
        false => SCENES.contains(&scene.name.as_str()),
    };
    // The command is built beside this program.
    let kdray = std::env::current_exe()?.with_file_name("kdray");
    let mut all_same = true;
    for scene in scenes.iter().filter(chosen) {
        all_same &= renders_are_same(scene, &kdray)?;
    }
    Ok(if all_same { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Renders a scene four times and writes its line; false if the pictures differ.
fn renders_are_same(scene: &SceneInfo, kdray: &Path) -> Result<bool, Box<dyn Error>> {
    let mut out = io::stdout();
    write!(out, "{:20}", scene.name)?;
    let folder = tempfile::tempdir()?;
    let mut first: Option<Vec<u8>> = None;
    let mut same = true;
    for strategy in Strategy::ALL {
        let picture = folder.path().join(format!("{strategy}.png"));
        let started = Instant::now();
        let mut command = Command::new(kdray);
        command.args(["-q", "render", "--size", "480x320", "--split", strategy.name()]);
        command.args(view(scene)).arg("--out").arg(&picture).arg(scene.path());
        if !command.status()?.success() {
            return Err(format!("{command:?} failed").into());
        }
        let picture = std::fs::read(&picture)?;
        same &= *first.get_or_insert_with(|| picture.clone()) == picture;
        write!(out, " {strategy} ({:.1} s)", started.elapsed().as_secs_f64())?;
        out.flush()?;
    }
    writeln!(out, ": {}", if same { "the same" } else { "DIFFERENT" })?;
    Ok(same)
}

/// The options for its camera and lamp.
fn view(scene: &SceneInfo) -> Vec<String> {
    let list = |[x, y, z]: [f64; 3]| format!("{x},{y},{z}");
    let camera = scene.camera.iter().flat_map(|camera| {
        [
            format!("--eye={}", list(camera.eye)),
            format!("--look-at={}", list(camera.look_at)),
            format!("--up={}", list(camera.up)),
            format!("--fov={}", camera.vfov_deg),
        ]
    });
    camera.chain(scene.point_light.map(|at| format!("--light={}", list(at)))).collect()
}
