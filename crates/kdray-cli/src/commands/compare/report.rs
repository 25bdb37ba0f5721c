//! The figures of the comparison, as a table and as JSON.

use super::Args;
use super::contender::{Contender, Kind};
use super::measure::Figures;
use super::rays::RaySets;
use crate::{
    table::columns,
    wording::{counted, three_digits},
};
use kdray::TriangleMesh;
use serde::Serialize;

/// All figures, under the names that they have in JSON.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    pub(super) triangles: usize,
    /// How many pixels across and down the primary rays go through.
    pub(super) primary_grid: [usize; 2],
    pub(super) rounds: u32,
    pub(super) threads: usize,
    /// Always true: if answers differ there is no report.
    pub(super) answers_identical: bool,
    pub(super) contenders: Vec<Entry>,
}

/// One contender.
#[derive(Debug, Serialize)]
pub(super) struct Entry {
    pub(super) name: &'static str,
    /// Null for the naive answer.
    pub(super) tree: Option<TreeEntry>,
    pub(super) primary: RayEntry,
    pub(super) shadow: RayEntry,
    pub(super) bounce: RayEntry,
}

/// One set of rays of a contender.
pub(super) type PickSet = fn(&Entry) -> &RayEntry;

/// What a tree is like.
#[derive(Debug, Serialize)]
pub(super) struct TreeEntry {
    pub(super) build_seconds: f64,
    pub(super) nodes: usize,
    pub(super) leaves: usize,
    pub(super) empty_leaves: usize,
    pub(super) max_depth: usize,
    pub(super) largest_leaf: usize,
    pub(super) references_per_triangle: f64,
    pub(super) sah_cost: f64,
    pub(super) bytes: usize,
    pub(super) bytes_per_triangle: f64,
}

/// What a set of rays cost. Per ray everything is null if there are no rays.
#[derive(Debug, Serialize)]
pub(super) struct RayEntry {
    pub(super) rays: usize,
    pub(super) nodes_per_ray: Option<f64>,
    pub(super) triangles_per_ray: Option<f64>,
    pub(super) mrays_per_second: Option<f64>,
}

impl Report {
    pub(super) fn new(
        contenders: &[Contender<'_>],
        rays: &RaySets,
        mesh: &TriangleMesh,
        args: &Args,
        threads: usize,
    ) -> Self {
        let triangles = mesh.triangles().len();
        let contenders = contenders.iter().filter_map(|it| Entry::new(it, triangles)).collect();
        Self {
            triangles,
            primary_grid: rays.grid,
            rounds: args.rounds,
            threads,
            answers_identical: true,
            contenders,
        }
    }

    /// The table, and what its rows mean.
    pub(super) fn text(&self, scene: &str) -> String {
        let [width, height] = self.primary_grid;
        let (threads, rounds) = (self.threads, self.rounds);
        let counts: Vec<String> = self.contenders.last().map_or(Vec::new(), |entry| {
            let sets =
                [("primary", &entry.primary), ("shadow", &entry.shadow), ("bounce", &entry.bounce)];
            sets.iter().map(|(name, set)| format!("{} {name}", set.rays)).collect()
        });
        let mut text = format!(
            "{scene}: {}; {} rays ({width} x {height} pixels)\n\n",
            counted(self.triangles, "triangle", "triangles"),
            counts.join(", ")
        );
        text += &columns(&self.rows());
        text += "\n\
            depth: most splits above a leaf. references: entries in leaves. SAH cost: expected cost of a\n\
            ray that meets the box, one visit of an inner node being 1. primary: rays through pixels;\n\
            shadow: from their hits to the light, any hit; bounce: from their hits in a random direction.\n";
        text += &format!(
            "Builds and rates: on {}. Rates: median of {}, contenders in turn.",
            counted(threads, "thread", "threads"),
            counted(rounds, "round", "rounds"),
        );
        text += &self.naive_note();
        text + "\nAll answers are identical.\n"
    }

    fn naive_note(&self) -> String {
        let all = self.contenders.last().map_or(0, |entry| entry.primary.rays);
        let naive = self.contenders.iter().find(|entry| entry.tree.is_none());
        match naive {
            Some(entry) if entry.primary.rays < all => {
                format!("\nnaive was asked {} of the {all} primary rays.", entry.primary.rays)
            }
            _ => String::new(),
        }
    }

    fn rows(&self) -> Vec<Vec<String>> {
        let names = self.contenders.iter().map(|entry| entry.name.to_owned());
        let mut rows: Vec<Vec<String>> =
            vec![std::iter::once(String::new()).chain(names).collect()];
        let mut row = |name: &str, cell: &dyn Fn(&Entry) -> Option<String>| {
            let cells = self.contenders.iter().map(|it| cell(it).unwrap_or("–".to_owned()));
            rows.push(std::iter::once(name.to_owned()).chain(cells).collect());
        };
        let tree =
            |show: fn(&TreeEntry) -> String| move |entry: &Entry| entry.tree.as_ref().map(show);
        row("build, s", &tree(|it| three_digits(it.build_seconds)));
        row("nodes", &tree(|it| it.nodes.to_string()));
        row("leaves", &tree(|it| it.leaves.to_string()));
        row("empty leaves", &tree(|it| it.empty_leaves.to_string()));
        row("depth", &tree(|it| it.max_depth.to_string()));
        row("largest leaf", &tree(|it| it.largest_leaf.to_string()));
        row("references per triangle", &tree(|it| format!("{:.2}", it.references_per_triangle)));
        row("SAH cost", &tree(|it| format!("{:.2}", it.sah_cost)));
        row("bytes per triangle", &tree(|it| format!("{:.1}", it.bytes_per_triangle)));
        let sets: [(&str, PickSet); 3] = [
            ("primary", |entry| &entry.primary),
            ("shadow", |entry| &entry.shadow),
            ("bounce", |entry| &entry.bounce),
        ];
        for (name, set) in sets {
            let one = |value: f64| format!("{value:.1}");
            row(&format!("{name}: nodes visited per ray"), &|it| set(it).nodes_per_ray.map(one));
            row(&format!("{name}: triangles tested per ray"), &|it| {
                set(it).triangles_per_ray.map(one)
            });
            row(&format!("{name}: Mrays/s"), &|it| set(it).mrays_per_second.map(three_digits));
        }
        rows
    }
}

impl Entry {
    fn new(contender: &Contender<'_>, triangles: usize) -> Option<Self> {
        let [primary, shadow, bounce] = contender.figures.as_slice() else { return None };
        let tree = match &contender.kind {
            Kind::Naive { .. } => None,
            Kind::Tree { stats, build_seconds, .. } => Some(TreeEntry {
                build_seconds: *build_seconds,
                nodes: stats.nodes,
                leaves: stats.leaves,
                empty_leaves: stats.empty_leaves,
                max_depth: stats.max_depth,
                largest_leaf: stats.largest_leaf,
                references_per_triangle: stats.references_per_primitive,
                sah_cost: stats.sah_cost,
                bytes: stats.bytes,
                bytes_per_triangle: stats.bytes as f64 / triangles.max(1) as f64,
            }),
        };
        let [primary, shadow, bounce] = [primary, shadow, bounce].map(RayEntry::new);
        Some(Self { name: contender.name, tree, primary, shadow, bounce })
    }
}

impl RayEntry {
    fn new(figures: &Figures) -> Self {
        let per_ray = |count: u64| (figures.rays > 0).then(|| count as f64 / figures.rays as f64);
        let rate = figures.rays as f64 / figures.seconds / 1e6;
        Self {
            rays: figures.rays,
            nodes_per_ray: per_ray(figures.counters.nodes()),
            triangles_per_ray: per_ray(figures.counters.primitives),
            mrays_per_second: (figures.rays > 0 && rate.is_finite()).then_some(rate),
        }
    }
}
