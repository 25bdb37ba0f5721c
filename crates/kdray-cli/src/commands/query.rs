//! `kdray query`: answers for a file of rays.

use crate::{
    args::{FastBuildArgs, SceneArgs, TreeFileArgs},
    build,
    cli::Globals,
    error::CliError,
    load,
    progress::{self, Progress},
    query::{Answer, Answerer, HitWriter, HitsFormat, Mode, RayReader, Summary},
    tree_file::{self, Trust},
};
use kdray::Ray;
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Rays in memory at a time.
const CHUNK: usize = 1 << 16;

/// The same where each ray may have many hits.
const CHUNK_OF_ALL: usize = 1 << 12;

/// Rays that a thread takes at a time.
const RUN: usize = 256;

/// Answer a file of rays
///
/// The rays are an N x 6 (origin, direction) or N x 8 (and t_min, t_max) array of 32- or 64-bit
/// floats. The answers are arrays named as Open3D names them; a miss has t_hit infinity and ids
/// 4294967295. Rays that are not finite or have a zero direction count as misses; how many there
/// were is said at the end. Memory does not grow with the number of rays.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example: the first hit of every ray
  kdray query bunny.ply --rays rays.npy --out hits.npz

Example: the same from a tree that was saved by `build`
  kdray query bunny.kdray --trusted --rays rays.npy --out hits.npz

Example: is the mesh closed? Rays from outside cross it an even number of times
  kdray query bunny.ply --rays rays.csv --mode count --out - | sort | uniq -c")]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The rays: npy, or CSV with or without a line of names; `-` reads standard input
    #[arg(long, value_name = "RAYS.npy|csv")]
    rays: PathBuf,
    /// What is asked of each ray
    #[arg(long, default_value = "closest")]
    mode: Mode,
    /// Where the answers go, .npz or .csv; `-` writes CSV to standard output
    #[arg(long, short, value_name = "HITS.npz|csv")]
    out: PathBuf,
    /// Test every triangle, without a tree: slow, and what other answers can be compared with
    #[arg(long)]
    naive: bool,
    #[command(flatten)]
    build: FastBuildArgs,
    #[command(flatten)]
    tree_file: TreeFileArgs,
}

/// Reads, answers and writes, a chunk at a time.
pub(crate) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    let standard_input = Some(Path::new("-"));
    if args.scene.scene.as_deref() == standard_input && Some(&*args.rays) == standard_input {
        return Err(CliError::Usage("standard input cannot be both scene and rays".to_owned()));
    }
    HitsFormat::of(&args.out)?;
    let input = |error: &dyn std::fmt::Display| CliError::input(&args.rays, error.to_string());
    let mut rays = RayReader::open(&args.rays).map_err(|error| input(&error))?;
    let mut hits = HitWriter::create(&args.out, args.mode, rays.precision())?;
    let answerer = answerer(args, globals)?;

    let progress = match rays.total() {
        Some(total) => Progress::start("answering", total, "rays", globals),
        None => Progress::spin("answering", globals),
    };
    let limit = if args.mode == Mode::All { CHUNK_OF_ALL } else { CHUNK };
    let (mut chunk, mut summary) = (Vec::new(), Summary::default());
    loop {
        rays.read(limit, &mut chunk).map_err(|error| input(&error))?;
        if chunk.is_empty() {
            break;
        }
        let answers = answer(&answerer, args.mode, &chunk, &progress);
        for (ray, answer) in chunk.iter().zip(answers.iter().flatten()) {
            hits.write(summary.rays, answer)?;
            summary.add(ray, answer);
        }
    }
    hits.finish()?;
    finish(args, globals, &summary, progress);
    Ok(())
}

fn answerer(args: &Args, globals: &Globals) -> Result<Answerer, CliError> {
    let trust = Trust::of(args.tree_file.trusted);
    let (given, limits) = (args.build.given(), &args.build.limits);
    if let Some(scene) = tree_file::scene(&args.scene, trust, given, limits, globals)? {
        return Ok(if args.naive {
            Answerer::naive(scene.into_mesh())
        } else {
            Answerer::Tree(scene)
        });
    }
    let mesh = load::mesh(&args.scene, globals)?;
    if args.naive {
        return Ok(Answerer::naive(mesh));
    }
    build::scene(mesh, &args.build.options(), globals).map(Answerer::Tree)
}

/// The answers in the order of the rays, in runs.
fn answer(answerer: &Answerer, mode: Mode, rays: &[Ray], progress: &Progress) -> Vec<Vec<Answer>> {
    let runs = rays.par_chunks(RUN).map(|run| {
        let answers = answerer.answers(mode, run);
        progress.advance(run.len() as u64);
        answers
    });
    runs.collect()
}

fn finish(args: &Args, globals: &Globals, summary: &Summary, progress: Progress) {
    let took = progress.elapsed();
    let Summary { rays, hitting, .. } = *summary;
    let rate = rays as f64 / took.as_secs_f64().max(1e-9) / 1e6;
    let out = args.out.display();
    progress.finish(&format!(
        "answered {rays} rays, {hitting} of which hit, in {took:.2?} ({rate:.3} Mrays/s): {out}"
    ));
    if let Some(warning) = summary.warning() {
        progress::say(globals, &format!("warning: {warning}"));
    }
}
