//! `cargo xtask agree`: closest hits on the scenes of scenes.json, with every strategy, against
//! testing every triangle; and all queries for some rays of each against rational arithmetic.
//! Ends with failure on any difference.

#![forbid(unsafe_code)]

use kdray::{BuildOptions, Ray, Scene, Strategy, TriangleMesh};
use kdray_tests::agree;
use kdray_tests::command_line::{Arguments, refuse};
use kdray_tests::rays::Archer;
use kdray_tests::shared::{SceneInfo, load_mesh, scenes};
use std::io::{self, Write};
use std::process::ExitCode;
use std::time::Instant;

/// Scenes with fewer triangles are looked at with every ray of a picture.
const SMALL: usize = 100_000;

/// Width and height of that picture.
const VIEW: usize = 512;

/// How many of a scene's rays, and about as many aimed ones, rational arithmetic is asked about.
const ORACLE: usize = 110;

/// How many random rays larger scenes are looked at with.
const RANDOM: usize = 100_000;

fn main() -> io::Result<ExitCode> {
    let arguments = Arguments::of_this_program();
    let rays = arguments.value("--rays").and_then(|n| n.parse().ok());
    let Some(scenes) = scenes() else { return Ok(ExitCode::FAILURE) };
    let names = scenes.iter().map(|scene| scene.name.as_str());
    if let Err(unknown) = arguments.check_names("--scenes", names, |asked, name| asked == name) {
        return refuse(&unknown);
    }
    let strategies = Strategy::ALL.map(Strategy::name);
    if let Err(unknown) =
        arguments.check_names("--strategies", strategies, |asked, name| asked == name)
    {
        return refuse(&unknown);
    }
    let mut out = io::stdout();
    writeln!(
        out,
        "{:22} {:>9} {:>7} {:>7} {:>7}  differences in hit or miss / primitive / rest",
        "scene", "triangles", "rays", "hits", "time"
    )?;
    let mut good = true;
    for scene in scenes.iter().filter(|scene| arguments.chosen("--scenes", &scene.name)) {
        good &= look_at(scene, rays, &arguments, &mut out)?;
    }
    Ok(if good { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Compares one scene and writes its line; false if there are differences.
fn look_at(
    scene: &SceneInfo,
    rays: Option<usize>,
    arguments: &Arguments,
    out: &mut impl Write,
) -> io::Result<bool> {
    let mesh = match load_mesh(scene) {
        Ok(mesh) => mesh,
        Err(error) => {
            writeln!(out, "{:22} cannot be loaded: {error}", scene.name)?;
            return Ok(false);
        }
    };
    let started = Instant::now();
    let rays = match (rays, &scene.camera) {
        (Some(count), _) => agree::random_rays(&mesh, count, 1),
        (None, Some(camera)) if mesh.triangles().len() < SMALL => agree::view(camera, VIEW),
        _ => agree::random_rays(&mesh, RANDOM, 1),
    };
    let answers = agree::flat_answers(&mesh, &rays);
    let (hits, seconds) = (answers.iter().flatten().count(), started.elapsed().as_secs_f64());
    let (name, triangles, rays_count) = (&scene.name, mesh.triangles().len(), rays.len());
    write!(out, "{name:22} {triangles:9} {rays_count:7} {hits:7} {seconds:5.1} s ")?;
    let mut good = true;
    for strategy in Strategy::ALL {
        if !arguments.chosen("--strategies", strategy.name()) {
            continue;
        }
        let started = Instant::now();
        let found = agree::compare(&mesh, strategy, &rays, &answers);
        let seconds = started.elapsed().as_secs_f64();
        let (a, b, c) = (found.hit_or_miss, found.primitive, found.other);
        write!(out, " {strategy} {a}/{b}/{c} ({seconds:.1} s)")?;
        if let Some(example) = &found.example {
            write!(out, "\n    {example}\n   ")?;
        }
        out.flush()?;
        good &= found.none();
    }
    good &= ask_oracle(mesh, &rays, out)?;
    Ok(good)
}

/// Compares a sample of the rays, and rays aimed at vertices, edges and faces, with the oracle.
fn ask_oracle(mesh: TriangleMesh, rays: &[Ray], out: &mut impl Write) -> io::Result<bool> {
    let mut sample = Archer::new(&mesh, 5).all_kinds(ORACLE / 11, 1e3);
    sample.extend(rays.iter().step_by(rays.len().div_ceil(ORACLE).max(1)));
    let started = Instant::now();
    let scene = Scene::build(mesh, &BuildOptions::default()).map_err(io::Error::other)?;
    let agrees = agree::agrees_with_the_oracle(&scene, &sample);
    let seconds = started.elapsed().as_secs_f64();
    match &agrees {
        Ok(()) => writeln!(out, " oracle {} rays ({seconds:.1} s)", sample.len())?,
        Err(error) => writeln!(out, "\n    the oracle says otherwise: {error}")?,
    }
    Ok(agrees.is_ok())
}
