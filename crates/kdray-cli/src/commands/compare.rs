//! `kdray compare`: the four strategies and the naive answer, side by side; or packets and single
//! rays.

mod contender;
mod counted;
mod measure;
mod packets;
mod plot;
mod rays;
mod report;

use crate::{
    args::{LimitArgs, SceneArgs, TableArgs, ViewArgs},
    cli::Globals,
    error::CliError,
    load, output,
    pictures::{PictureFile, scene_name},
    progress,
    table::print_json,
};
use contender::Contender;
use kdray::TriangleMesh;
use kdray_scene::Model;
use rays::RaySets;
use report::Report;
use std::path::PathBuf;

/// The most camera rays: with all answers to them, and as many of each other kind, they take some
/// 4 GB.
const MAX_RAYS: i64 = 1 << 22;

/// Compare the four ways to choose the splitting plane, and the answer without a tree
///
/// All answer the same three sets of rays: `primary` rays through the pixels, `shadow` rays from
/// where those hit to a light (any hit): that of --light, or else the scene's first, or else one
/// over the camera's shoulder, and `bounce` rays from there in directions of diffuse reflection.
/// Their answers must be identical; if they are not, the command fails with exit code 1. Rates are
/// the median over the rounds, in which the contenders take turns. Builds and rates are measured
/// on one thread unless --threads says otherwise.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example: a table, and the same as bar charts
  kdray compare bunny.ply --plot bunny.svg

Example: packets of rays beside single ones
  kdray compare bunny.ply --packets

Example: a million camera rays
  kdray compare bunny.ply --size 1024x1024 --rays 1048576")]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// About so many camera rays, spread evenly over the picture; at most 4194304
    #[arg(long, value_name = "N", default_value_t = 20000, value_parser = clap::value_parser!(u32).range(1..=MAX_RAYS))]
    rays: u32,
    /// How often everything is measured, at most 1000 times
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
    /// Leave out the naive answer, which tests every triangle
    #[arg(long)]
    no_naive: bool,
    /// Also draw bar charts: a name that ends in .svg or .png
    #[arg(long, value_name = "OUT.svg|png")]
    plot: Option<PathBuf>,
    /// Compare packets of camera rays with single ones instead, on the tree of sah: how often a node
    /// is decided upon, a triangle set up and a ray tested. Rays fill tiles of 16 x 16 pixels
    #[arg(long, conflicts_with_all = ["rounds", "no_naive", "plot", "light"])]
    packets: bool,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    limits: LimitArgs,
    #[command(flatten)]
    table: TableArgs,
}

/// Builds all trees, asks all questions, and compares answers and times.
pub(crate) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    if args.packets {
        return packets::run(args, globals);
    }
    let plot = args.plot.as_deref().map(PictureFile::create).transpose()?;
    let mut model = load::model(&args.scene, globals)?;
    let mesh = take_mesh(&mut model)?;
    let threads = usize::from(globals.threads.unwrap_or(1));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| CliError::Usage(format!("--threads {threads}: {error}")))?;
    let mut contenders = pool.install(|| contender::build_all(&mesh, args, globals))?;
    let rays = RaySets::new(args, &model, contenders.best())?;
    if !args.no_naive {
        contenders.add_naive(&mesh);
    }
    measure::measure(&mut contenders.list, &rays, args.rounds, &pool, globals)?;
    measure::check_answers(&contenders.list)?;

    let report = Report::new(&contenders.list, &rays, &mesh, args, threads);
    // The charts first: whoever reads the table may stop, as `head` does.
    if let (Some(file), Some(out)) = (plot, &args.plot) {
        file.write(plot::draw(&report, &scene_name(&args.scene)), 1.5)?;
        progress::say(globals, &format!("drew the charts: {}", out.display()));
    }
    if args.table.json {
        print_json(&report)
    } else {
        output::print(report.text(&scene_name(&args.scene)).as_bytes())
    }
}

/// The triangles, taken out of the model, which keeps cameras and lights.
fn take_mesh(model: &mut Model) -> Result<TriangleMesh, CliError> {
    let vertices = std::mem::take(&mut model.vertices);
    Ok(TriangleMesh::new(vertices, std::mem::take(&mut model.triangles))?)
}
