//! Who takes part: a tree for each strategy, and no tree at all.

use super::Args;
use super::measure::Figures;
use crate::{cli::Globals, error::CliError, interrupt, progress};
use kdray::{Aabb, ShapeScene, Strategy, TreeStats, TriangleMesh};
use std::time::{Duration, Instant};

/// Builds that took less than this are repeated, so that their time can be trusted.
const SHORT_BUILD: Duration = Duration::from_millis(500);

/// One that answers rays.
pub(super) struct Contender<'a> {
    /// What it is called in tables.
    pub(super) name: &'static str,
    /// How it answers.
    pub(super) kind: Kind<'a>,
    /// What it did with each set of rays.
    pub(super) figures: Vec<Figures>,
}

/// How a contender answers rays.
pub(super) enum Kind<'a> {
    /// Through a tree.
    Tree {
        /// The triangles and the tree.
        scene: Box<ShapeScene>,
        /// The tree's figures.
        stats: TreeStats,
        /// The median time of a build, in seconds.
        build_seconds: f64,
    },
    /// By testing every triangle with each ray that meets the box around them all (S1).
    Naive {
        /// The triangles.
        mesh: &'a TriangleMesh,
        /// The box.
        bounds: Aabb<3>,
    },
}

/// All that take part.
pub(super) struct Contenders<'a> {
    pub(super) list: Vec<Contender<'a>>,
}

/// Builds a tree with each strategy, on the threads of the current pool.
pub(super) fn build_all<'a>(
    mesh: &TriangleMesh,
    args: &Args,
    globals: &Globals,
) -> Result<Contenders<'a>, CliError> {
    let list: Result<Vec<_>, CliError> =
        Strategy::ALL.into_iter().map(|it| build(mesh, it, args, globals)).collect();
    Ok(Contenders { list: list? })
}

fn build<'a>(
    mesh: &TriangleMesh,
    strategy: Strategy,
    args: &Args,
    globals: &Globals,
) -> Result<Contender<'a>, CliError> {
    let options = args.limits.options(strategy);
    let _watch = interrupt::watch();
    let mut seconds = Vec::new();
    let (mut scene, mut took);
    loop {
        let copy = mesh.clone();
        let start = Instant::now();
        scene = ShapeScene::build_with_progress(copy, &options, &|_| interrupt::flow())?;
        took = start.elapsed();
        seconds.push(took.as_secs_f64());
        if took >= SHORT_BUILD || seconds.len() >= args.rounds as usize {
            break;
        }
    }
    progress::say(globals, &format!("built {strategy} in {took:.2?}"));
    let stats = scene.tree().stats(mesh.triangles().len(), &options.cost);
    let build_seconds = super::measure::median(&mut seconds);
    let kind = Kind::Tree { scene: Box::new(scene), stats, build_seconds };
    Ok(Contender { name: strategy.name(), kind, figures: Vec::new() })
}

impl<'a> Contenders<'a> {
    /// The scene with the SAH tree, which finds where secondary rays start.
    pub(super) fn best(&self) -> Option<&ShapeScene> {
        self.list.iter().rev().find_map(|contender| match &contender.kind {
            Kind::Tree { scene, .. } => Some(&**scene),
            Kind::Naive { .. } => None,
        })
    }

    /// Adds the one without a tree.
    pub(super) fn add_naive(&mut self, mesh: &'a TriangleMesh) {
        let bounds = self.best().map_or(Aabb::EMPTY, |scene| *scene.tree().bounds());
        let kind = Kind::Naive { mesh, bounds };
        self.list.insert(0, Contender { name: "naive", kind, figures: Vec::new() });
    }
}
