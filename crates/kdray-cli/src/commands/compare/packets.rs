//! `kdray compare --packets`: what packets of rays ask of the tree (S12), beside single rays.

use super::{Args, rays, take_mesh};
use crate::{
    build,
    cli::Globals,
    error::CliError,
    interrupt, load, output,
    pictures::scene_name,
    progress::Progress,
    table::{columns, print_json},
    wording::counted,
};
use kdray::{
    Hit, Ray, ShapeScene, Strategy,
    geometry::{TILE, tile_order},
    traverse::{Counters, PacketCounters, PacketKind},
};
use kdray_render::{RenderError, View};
use rayon::prelude::*;
use serde::Serialize;

/// All figures, under the names that they have in JSON.
#[derive(Debug, Serialize)]
struct Report {
    triangles: usize,
    /// How many pixels across and down the primary rays go through.
    primary_grid: [u32; 2],
    /// Always true: if answers differ there is no report.
    answers_identical: bool,
    contenders: Vec<Entry>,
}

/// What a kind of packet cost, and with it the rays that it left to the single traversal.
#[derive(Debug, Serialize)]
struct Entry {
    name: &'static str,
    rays_a_packet: usize,
    node_decisions_per_ray: f64,
    triangle_set_ups_per_ray: f64,
    ray_tests_per_ray: f64,
    rays_left: u64,
}

/// Answers the primary rays one by one and in packets of each kind and size.
pub(super) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    let mut model = load::model(&args.scene, globals)?;
    let mesh = take_mesh(&mut model)?;
    let scene = build::shapes(mesh, &args.limits.options(Strategy::Sah), globals)?;
    let camera = args.view.camera(&model, scene.tree().bounds())?;
    let view = View::new(&camera, args.view.aspect()).map_err(RenderError::from)?;
    let grid = rays::grid(args.rays, args.view.aspect()).map(whole_tiles);
    let rays = in_tiles(&view, grid);
    let report = Report {
        triangles: scene.primitives().triangles().len(),
        primary_grid: grid,
        answers_identical: true,
        contenders: contenders(&scene, &rays, globals)?,
    };
    if args.table.json {
        print_json(&report)
    } else {
        output::print(report.text(&scene_name(&args.scene)).as_bytes())
    }
}

/// The nearest number of pixels that tiles fill.
fn whole_tiles(pixels: usize) -> u32 {
    ((pixels as u32 + TILE / 2) / TILE).max(1) * TILE
}

/// Rays through the pixels of a picture, tile by tile.
fn in_tiles(view: &View, [width, height]: [u32; 2]) -> Vec<Ray> {
    let middle = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
    let pixels = tile_order(width, height);
    pixels.map(|[x, y]| view.ray(middle(x, width), middle(y, height))).collect()
}

/// The single traversal, and all kinds and sizes of packets.
fn contenders(scene: &ShapeScene, rays: &[Ray], globals: &Globals) -> Result<Vec<Entry>, CliError> {
    let kinds = PacketKind::ALL.into_iter();
    let kinds: Vec<_> =
        kinds.flat_map(|kind| kind.sizes().iter().map(move |&size| (kind, size))).collect();
    let progress = Progress::start("counting", kinds.len() as u64 + 1, "sets of rays", globals);
    let _watch = interrupt::watch();
    let (hits, counters) = one_by_one(scene, rays);
    let mut entries = vec![Entry::single(&counters, rays.len())];
    for (kind, size) in kinds {
        progress.advance(1);
        if interrupt::requested() {
            return Err(CliError::Interrupted);
        }
        let (found, counters) = in_packets(scene, rays, kind, size);
        check_answers(&hits, &found, kind, size)?;
        entries.push(Entry::packets(kind, size, &counters, rays.len()));
    }
    let took = progress.elapsed();
    progress
        .finish(&format!("counted what {} cost in {took:.2?}", counted(rays.len(), "ray", "rays")));
    Ok(entries)
}

fn one_by_one(scene: &ShapeScene, rays: &[Ray]) -> (Vec<Option<Hit>>, Counters) {
    let ask = |ray| {
        let mut counters = Counters::default();
        (scene.closest_hit_traced(ray, &mut counters), counters)
    };
    let (hits, counters): (Vec<_>, Vec<_>) = rays.par_iter().map(ask).unzip();
    (hits, counters.into_iter().sum())
}

fn in_packets(
    scene: &ShapeScene,
    rays: &[Ray],
    kind: PacketKind,
    size: usize,
) -> (Vec<Option<Hit>>, PacketCounters) {
    let packets = scene.packets(kind).with_size(size);
    let ask = |tile| {
        let mut counters = PacketCounters::default();
        (packets.closest_hits(tile, &mut counters), counters)
    };
    let tiles = rays.par_chunks((TILE * TILE) as usize);
    let (hits, counters): (Vec<_>, Vec<_>) = tiles.map(ask).unzip();
    (hits.concat(), counters.into_iter().sum())
}

/// Fails if a ray of a packet was answered otherwise than alone.
fn check_answers(
    single: &[Option<Hit>],
    found: &[Option<Hit>],
    kind: PacketKind,
    size: usize,
) -> Result<(), CliError> {
    let wrong = single.iter().zip(found).position(|(single, found)| single != found);
    wrong.map_or(Ok(()), |ray| {
        let (single, found, kind) = (single[ray], found[ray], kind.name());
        Err(CliError::Disagreement(format!(
            "{kind} packets of {size} and single rays disagree on ray {ray}: {found:?} and {single:?}"
        )))
    })
}

impl Entry {
    fn single(counters: &Counters, rays: usize) -> Self {
        let tests = counters.primitives as f64 / rays as f64;
        Self {
            name: "single",
            rays_a_packet: 1,
            node_decisions_per_ray: counters.splits as f64 / rays as f64,
            triangle_set_ups_per_ray: tests,
            ray_tests_per_ray: tests,
            rays_left: 0,
        }
    }

    fn packets(kind: PacketKind, size: usize, counters: &PacketCounters, rays: usize) -> Self {
        let per_ray = |together: u64, left: u64| (together + left) as f64 / rays as f64;
        let left = &counters.single;
        Self {
            name: kind.name(),
            rays_a_packet: size,
            node_decisions_per_ray: per_ray(counters.decisions, left.splits),
            triangle_set_ups_per_ray: per_ray(counters.set_ups, left.primitives),
            ray_tests_per_ray: per_ray(counters.tests, left.primitives),
            rays_left: counters.left,
        }
    }

    fn row(&self) -> Vec<String> {
        let one = |value: f64| format!("{value:.3}");
        vec![
            self.name.to_owned(),
            self.rays_a_packet.to_string(),
            one(self.node_decisions_per_ray),
            one(self.triangle_set_ups_per_ray),
            one(self.ray_tests_per_ray),
            self.rays_left.to_string(),
        ]
    }
}

impl Report {
    /// The table, and what its columns mean.
    fn text(&self, scene: &str) -> String {
        let [width, height] = self.primary_grid;
        let headings = [
            "per ray",
            "rays a packet",
            "node decisions",
            "triangle set-ups",
            "ray tests",
            "rays left",
        ];
        let headings = headings.map(str::to_owned).to_vec();
        let rows = self.contenders.iter().map(Entry::row);
        let rows: Vec<Vec<String>> = std::iter::once(headings).chain(rows).collect();
        format!(
            "{scene}: {}; {} ({width} x {height} pixels)\n\n{}\n\
             node decisions: at inner nodes, each for a whole packet. triangle set-ups: triangles that\n\
             got through the culling of a packet. ray tests: of one ray against one triangle. rays left:\n\
             how many in all fit no packet; what they cost alone is counted too. Rays come in tiles of\n\
             16 x 16 pixels, in these 8 x 8, in these 4 x 2.\n\
             All answers are identical.\n",
            counted(self.triangles, "triangle", "triangles"),
            counted(width * height, "primary ray", "primary rays"),
            columns(&rows)
        )
    }
}
