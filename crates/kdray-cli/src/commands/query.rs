//! `kdray query`: answers for a file of rays or points.

use crate::{
    args::{FastBuildArgs, SceneArgs, TreeFileArgs},
    build,
    cli::Globals,
    error::CliError,
    load,
    output::check_is_no_input,
    progress::{self, Progress},
    query::{
        Answer, Answerer, HitWriter, HitsFormat, Mode, Row, RowReader, Summary, answer_points,
    },
    tree_file::{self, Trust},
    wording::counted,
};
use clap::ValueEnum;
use kdray::Scene;
use rayon::prelude::*;
use std::{
    io::{self, IsTerminal},
    path::{Path, PathBuf},
};

/// Rays or points in memory at a time.
const CHUNK: usize = 1 << 16;

/// The same where each ray may have many hits.
const CHUNK_OF_ALL: usize = 1 << 12;

/// Rays or points that a thread takes at a time.
const RUN: usize = 256;

/// Answer a file of rays or points
///
/// The rays are an N x 6 (origin, direction) or N x 8 (and t_min, t_max) array of 32- or 64-bit
/// floats. The answers are arrays named as Open3D names them; a miss has t_hit infinity and ids
/// 4294967295. Rays that are not finite or have a zero direction count as misses; how many there
/// were is said at the end. Points are an N x 3 array. Memory does not grow with their number.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example: the first hit of every ray
  kdray query bunny.ply --rays rays.npy --out hits.npz

Example: the same from a tree that was saved by `build`
  kdray query bunny.kdray --trusted --rays rays.npy --out hits.npz

Example: is the mesh closed? Rays from outside cross it an even number of times
  kdray query bunny.ply --rays rays.csv --mode count --out - | tail -n +2 | sort | uniq -c

Example: which points are inside
  kdray query bunny.ply --points points.npy --mode contains --out inside.npz")]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The rays: npy, or CSV with or without a line of names; `-` reads standard input
    #[arg(long, value_name = "RAYS.npy|csv", required_unless_present = "points")]
    rays: Option<PathBuf>,
    /// Points in place of rays, in the same formats
    #[arg(long, value_name = "POINTS.npy|csv", conflicts_with_all = ["rays", "naive"])]
    points: Option<PathBuf>,
    /// What is asked of each ray or point; without it closest, or closest-point
    #[arg(long)]
    mode: Option<Mode>,
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

/// Reads, answers and writes.
pub(crate) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    let inputs = [&args.scene.scene, &args.rays, &args.points].into_iter().flatten();
    check_is_no_input(&args.out, inputs.map(PathBuf::as_path))?;
    if let Some(path) = &args.points {
        let mode = args.mode(Mode::ClosestPoint)?;
        return answer_file(args, path, mode, globals, || {
            let scene = scene(args, globals)?;
            Ok(move |points: &[[f64; 3]]| answer_points(&scene, mode, points))
        });
    }
    let path = args.rays.as_deref().unwrap_or(Path::new("-"));
    let mode = args.mode(Mode::Closest)?;
    answer_file(args, path, mode, globals, || {
        let answerer = answerer(args, globals)?;
        Ok(move |rays: &[kdray::Ray]| answerer.answers(mode, rays))
    })
}

impl Args {
    /// What is asked, which must be of the kind that `default` is of.
    fn mode(&self, default: Mode) -> Result<Mode, CliError> {
        let mode = self.mode.unwrap_or(default);
        match (mode.is_of_points(), default.is_of_points()) {
            (true, false) => Err("is asked of points; give them with --points"),
            (false, true) => Err("is asked of rays; give them with --rays"),
            _ => Ok(mode),
        }
        .map_err(|reason| {
            let name = mode.to_possible_value().map_or_else(String::new, |it| it.get_name().into());
            CliError::Usage(format!("--mode {name} {reason}"))
        })
    }
}

/// Answers the rows of a file, a chunk at a time, by what `prepare` makes once it is sure that the
/// file can be read and the output written.
fn answer_file<R: Row, A: Fn(&[R]) -> Vec<Answer> + Sync>(
    args: &Args,
    path: &Path,
    mode: Mode,
    globals: &Globals,
    prepare: impl FnOnce() -> Result<A, CliError>,
) -> Result<(), CliError> {
    let standard_input = Path::new("-");
    if args.scene.scene.as_deref() == Some(standard_input) && path == standard_input {
        let what = R::MANY;
        return Err(CliError::Usage(format!("standard input cannot be both scene and {what}")));
    }
    HitsFormat::of(&args.out)?;
    let input = |error: &dyn std::fmt::Display| CliError::input(path, error.to_string());
    let mut rows = RowReader::<R>::open(path).map_err(|error| input(&error))?;
    let mut hits = HitWriter::create(&args.out, mode, rows.precision())?;
    let answers = prepare()?;

    let progress = match rows.total() {
        // A bar among the answers would spoil both.
        _ if args.out == Path::new("-") && io::stdout().is_terminal() => Progress::unseen(globals),
        Some(total) => Progress::start("answering", total, R::MANY, globals),
        None => Progress::spin("answering", globals),
    };
    let limit = if mode == Mode::All { CHUNK_OF_ALL } else { CHUNK };
    let (mut chunk, mut summary) = (Vec::new(), Summary::default());
    loop {
        rows.read(limit, &mut chunk).map_err(|error| input(&error))?;
        if chunk.is_empty() {
            break;
        }
        let answers = in_runs(&answers, &chunk, &progress);
        for (row, answer) in chunk.iter().zip(answers.iter().flatten()) {
            hits.write(summary.rows, answer)?;
            summary.add(row, answer);
        }
    }
    hits.finish()?;
    finish::<R>(args, globals, &summary, progress);
    Ok(())
}

fn answerer(args: &Args, globals: &Globals) -> Result<Answerer, CliError> {
    if args.naive && tree_file::path(&args.scene).is_none() {
        return load::mesh(&args.scene, globals).map(Answerer::naive);
    }
    let scene = scene(args, globals)?;
    Ok(if args.naive { Answerer::naive(scene.into_mesh()) } else { Answerer::Tree(scene) })
}

/// The scene of the tree file, or built over the mesh.
fn scene(args: &Args, globals: &Globals) -> Result<Scene, CliError> {
    let trust = Trust::of(args.tree_file.trusted);
    let (given, limits) = (args.build.given(), &args.build.limits);
    if let Some(scene) = tree_file::scene(&args.scene, trust, given, limits, globals)? {
        return Ok(scene);
    }
    let mesh = load::mesh(&args.scene, globals)?;
    build::scene(mesh, &args.build.options(), globals)
}

/// The answers in the order of the rows, in runs.
fn in_runs<R: Row>(
    answers: &(impl Fn(&[R]) -> Vec<Answer> + Sync),
    rows: &[R],
    progress: &Progress,
) -> Vec<Vec<Answer>> {
    let runs = rows.par_chunks(RUN).map(|run| {
        let answers = answers(run);
        progress.advance(run.len() as u64);
        answers
    });
    runs.collect()
}

fn finish<R: Row>(args: &Args, globals: &Globals, summary: &Summary, progress: Progress) {
    let took = progress.elapsed();
    let Summary { rows, hitting, .. } = *summary;
    let rate = rows as f64 / took.as_secs_f64().max(1e-9) / 1e6;
    let (out, many, hit) = (args.out.display(), R::MANY, R::HIT);
    let rows = counted(rows, R::ONE, many);
    progress.finish(&format!(
        "answered {rows}, {hitting} of which {hit}, in {took:.2?} ({rate:.3} M{many}/s): {out}"
    ));
    if let Some(warning) = summary.warning::<R>() {
        progress::say(globals, &format!("warning: {warning}"));
    }
}
