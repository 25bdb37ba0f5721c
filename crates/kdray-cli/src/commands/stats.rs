//! `kdray stats`: figures of a scene and of its tree.

use crate::{
    args::{BuildArgs, SceneArgs, TableArgs, TreeFileArgs},
    build,
    cli::Globals,
    error::CliError,
    load, output,
    table::{columns, print_json},
    tree_file::{self, Trust},
};
use kdray::{CostModel, Scene, ShapeScene, TreeStats};
use serde::Serialize;

/// Characters of the longest bar of the histogram.
const BAR: usize = 40;

/// Print figures of the scene and of its tree
///
/// Of a tree file the figures are those of the tree in it. What it is expected to cost is reckoned by
/// the costs of --split.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example: how much smaller is a tree with larger leaves?
  kdray stats bunny.ply --leaf-size 8")]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    build: BuildArgs,
    #[command(flatten)]
    tree_file: TreeFileArgs,
    #[command(flatten)]
    table: TableArgs,
}

/// The figures under the names that they have in JSON. Bounds are null for a scene without
/// triangles, and the split for a tree file, which does not say.
#[derive(Debug, Serialize)]
struct Figures {
    triangles: usize,
    vertices: usize,
    bounds_min: Option<[f32; 3]>,
    bounds_max: Option<[f32; 3]>,
    split: Option<&'static str>,
    nodes: usize,
    leaves: usize,
    empty_leaves: usize,
    max_depth: usize,
    largest_leaf: usize,
    references: usize,
    references_per_triangle: f64,
    sah_cost: f64,
    bytes: usize,
    bytes_per_triangle: f64,
    leaves_at_depth: Vec<usize>,
}

/// Builds the tree and measures it.
pub(crate) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    let cost = args.build.options().cost;
    let figures = match from_file(args, globals)? {
        Some(scene) => Figures::of(scene.shapes(), None, &cost),
        None => {
            let mesh = load::mesh(&args.scene, globals)?;
            let scene = build::shapes(mesh, &args.build.options(), globals)?;
            Figures::of(&scene, Some(args.build.strategy().name()), &cost)
        }
    };
    if args.table.json {
        return print_json(&figures);
    }
    let table = columns(&figures.rows());
    output::print(format!("{table}\nleaves at each depth\n{}", figures.histogram()).as_bytes())
}

/// The scene of a tree file, if it is one.
fn from_file(args: &Args, globals: &Globals) -> Result<Option<Scene>, CliError> {
    let (trust, limits) = (Trust::of(args.tree_file.trusted), &args.build.limits);
    tree_file::scene(&args.scene, trust, limits.given(), limits, globals)
}

impl Figures {
    fn of(scene: &ShapeScene, split: Option<&'static str>, cost: &CostModel) -> Self {
        let (mesh, bounds) = (scene.primitives(), scene.tree().bounds());
        let triangles = mesh.triangles().len();
        let stats: TreeStats = scene.tree().stats(triangles, cost);
        Self {
            triangles,
            vertices: mesh.vertices().len(),
            bounds_min: (!bounds.is_empty()).then_some(bounds.min),
            bounds_max: (!bounds.is_empty()).then_some(bounds.max),
            split,
            nodes: stats.nodes,
            leaves: stats.leaves,
            empty_leaves: stats.empty_leaves,
            max_depth: stats.max_depth,
            largest_leaf: stats.largest_leaf,
            references: stats.references,
            references_per_triangle: stats.references_per_primitive,
            sah_cost: stats.sah_cost,
            bytes: stats.bytes,
            bytes_per_triangle: stats.bytes as f64 / triangles.max(1) as f64,
            leaves_at_depth: stats.leaves_at_depth,
        }
    }

    fn rows(&self) -> Vec<Vec<String>> {
        let corner = |corner: Option<[f32; 3]>| match corner {
            Some([x, y, z]) => format!("{x}, {y}, {z}"),
            None => "none".to_owned(),
        };
        let rows = [
            ("triangles", self.triangles.to_string()),
            ("vertices", self.vertices.to_string()),
            ("bounds, lower corner", corner(self.bounds_min)),
            ("bounds, upper corner", corner(self.bounds_max)),
            ("split", self.split.unwrap_or("as in the file").to_owned()),
            ("nodes", self.nodes.to_string()),
            ("leaves", self.leaves.to_string()),
            ("empty leaves", self.empty_leaves.to_string()),
            ("depth", self.max_depth.to_string()),
            ("largest leaf", self.largest_leaf.to_string()),
            ("references", self.references.to_string()),
            ("references per triangle", format!("{:.3}", self.references_per_triangle)),
            ("SAH cost", format!("{:.3}", self.sah_cost)),
            ("bytes", self.bytes.to_string()),
            ("bytes per triangle", format!("{:.1}", self.bytes_per_triangle)),
        ];
        rows.into_iter().map(|(name, value)| vec![name.to_owned(), value]).collect()
    }

    /// A line for each depth that has leaves, as long as there are many.
    fn histogram(&self) -> String {
        let most = self.leaves_at_depth.iter().copied().max().unwrap_or(0).max(1);
        let depths = self.leaves_at_depth.iter().enumerate().filter(|&(_, &leaves)| leaves > 0);
        let line = |(depth, &leaves): (usize, &usize)| {
            let bar = "#".repeat((leaves * BAR).div_ceil(most));
            format!("{depth:>5}  {leaves:>10}  {bar}\n")
        };
        depths.map(line).collect()
    }
}
