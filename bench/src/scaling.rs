//! How build time and rays a second change with the number of triangles.

use crate::args::Scaling;
use crate::compare::{LONGEST_TRACE, ROUNDS, chosen, embree};
use crate::contender::Threads;
use crate::embree::Embree;
use crate::error::BenchError;
use crate::machine::{Machine, work_folder};
use crate::measure::{self, Terms, spoken};
use crate::rays::{RaySets, SetKind};
use crate::reference::Reference;
use crate::report::{BuildRow, RayRow, columns, print, say, write_json};
use crate::scene::BenchScene;
use crate::workers::Workers;
use serde::Serialize;
use std::time::Instant;

/// The terrains, by their names.
const SIZES: [&str; 7] = ["10k", "30k", "100k", "300k", "1m", "3m", "10m"];
const SIZES_QUICK: usize = 5;

/// Rays through so many pixels across and down.
const RESOLUTION: u32 = 512;

/// Builds are repeated until they took so many seconds in all.
const BUILDS: f64 = 5.0;

/// Who takes part if nobody is named.
const CONTENDERS: [&str; 3] = ["kdray", "embree medium single", "embree high single"];

/// The fitted build time of a contender: t ∝ x^exponent. By processor time, which on one thread is
/// that of a quiet machine.
#[derive(Debug, Serialize)]
struct Fit {
    contender: String,
    /// For x = N.
    exponent_n: f64,
    /// For x = N log N: one for a build of that complexity.
    exponent_n_log_n: f64,
}

/// All figures of a run.
#[derive(Debug, Serialize)]
struct Figures {
    machine: Machine,
    fits: Vec<Fit>,
    builds: Vec<BuildRow>,
    rays: Vec<RayRow>,
}

/// Builds and traces terrains of growing size and tells the figures.
pub(crate) fn run(options: &Scaling) -> Result<(), BenchError> {
    let start = Instant::now();
    let embree = embree();
    let version = embree.as_ref().map(Embree::version).transpose()?;
    let names: Vec<String> = match options.contenders.as_slice() {
        [] => CONTENDERS.map(str::to_owned).to_vec(),
        names => names.to_vec(),
    };
    let rounds = options.rounds.unwrap_or(ROUNDS);
    let mut figures = Figures {
        machine: Machine::here(version),
        fits: Vec::new(),
        builds: Vec::new(),
        rays: Vec::new(),
    };
    let mut sizes = Vec::new();
    let count = if options.quick { SIZES_QUICK } else { SIZES.len() };
    for size in &SIZES[..count] {
        let scene = BenchScene::find(&format!("terrain-{size}"), &Default::default())?;
        sizes.push((scene.name.clone(), scene.mesh.triangles().len()));
        terrain(&scene, embree.as_ref(), (&names, rounds), &mut figures)?;
    }
    figures.fits = fits(&figures.builds, &sizes);
    print(&text(&figures, &sizes));
    if let Some(json) = &options.json {
        write_json(json, &figures)?;
    }
    say(&format!("done in {}", spoken(start.elapsed())));
    Ok(())
}

fn terrain(
    scene: &BenchScene,
    embree: Option<&Embree>,
    (names, rounds): (&[String], u32),
    figures: &mut Figures,
) -> Result<(), BenchError> {
    let start = Instant::now();
    let reference = Reference::build(&scene.mesh)?;
    let rays = RaySets::get(scene, &reference, RESOLUTION, &work_folder().join("rays"))?;
    let kinds = [SetKind::Primary, SetKind::Diffuse];
    let truths = kinds.map(|kind| (kind, reference.truth(rays.set(kind))));
    drop(reference);
    let contenders = chosen(embree, names)?;
    let one = Workers::new(1)?;
    let two = Workers::new(2)?;
    let mut ready = Vec::new();
    for contender in &contenders {
        let (built, row) = measure::build(contender.as_ref(), scene, &one, (rounds, BUILDS))?;
        ready.push(built);
        figures.builds.push(row);
        if contender.builds_on() == Threads::Chosen {
            figures
                .builds
                .push(measure::build(contender.as_ref(), scene, &two, (rounds, BUILDS))?.1);
        }
    }
    for (kind, truth) in &truths {
        let terms = Terms { names, rounds, longest_trace: LONGEST_TRACE };
        let traced = measure::trace(&ready, scene, &rays, (*kind, truth), terms);
        figures.rays.extend(traced.into_iter().map(|it| it.row));
    }
    say(&format!("{}: {}", scene.name, spoken(start.elapsed())));
    Ok(())
}

/// The fits of all contenders' builds on one thread.
fn fits(builds: &[BuildRow], sizes: &[(String, usize)]) -> Vec<Fit> {
    let mut names: Vec<&str> = Vec::new();
    for row in builds {
        if !names.contains(&row.contender.as_str()) {
            names.push(&row.contender);
        }
    }
    let fit = |name: &str| {
        let points = sizes.iter().filter_map(|(scene, size)| {
            let mut rows = builds.iter().filter(|it| it.contender == name && it.scene == *scene);
            Some((*size as f64, rows.next()?.build_cpu_s))
        });
        let points: Vec<(f64, f64)> = points.collect();
        let by = |x: fn(f64) -> f64| exponent(points.iter().map(|&(n, t)| (x(n), t)));
        Fit {
            contender: name.to_owned(),
            exponent_n: by(|n| n),
            exponent_n_log_n: by(|n| n * n.ln()),
        }
    };
    names.into_iter().map(fit).collect()
}

/// The slope of log y over log x, by least squares.
fn exponent(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let logs: Vec<(f64, f64)> = points.map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logs.len() as f64;
    let mean_x = logs.iter().map(|(x, _)| x).sum::<f64>() / count;
    let mean_y = logs.iter().map(|(_, y)| y).sum::<f64>() / count;
    let covariance: f64 = logs.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = logs.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    covariance / variance
}

fn text(figures: &Figures, sizes: &[(String, usize)]) -> String {
    let mut text = format!("{}\n\n", figures.machine.text());
    let names = figures.fits.iter().map(|fit| fit.contender.clone());
    text += "Build on one thread: seconds of processor time, and microseconds a triangle\n";
    let mut rows: Vec<Vec<String>> =
        vec![std::iter::once("triangles".to_owned()).chain(names).collect()];
    for (scene, size) in sizes {
        let cell = |fit: &Fit| {
            let mut builds = figures.builds.iter();
            let row = builds.find(|it| it.contender == fit.contender && it.scene == *scene);
            row.map_or("–".to_owned(), |row| {
                let seconds = row.build_cpu_s;
                format!("{seconds:.4} {:6.3}", seconds * 1e6 / *size as f64)
            })
        };
        let cells = figures.fits.iter().map(cell);
        rows.push(std::iter::once(size.to_string()).chain(cells).collect());
    }
    let exponents = |title: &str, exponent: fn(&Fit) -> f64| {
        let cells = figures.fits.iter().map(|fit| format!("{:.3}", exponent(fit)));
        std::iter::once(title.to_owned()).chain(cells).collect()
    };
    rows.push(exponents("exponent of N", |fit| fit.exponent_n));
    rows.push(exponents("exponent of N log N", |fit| fit.exponent_n_log_n));
    text += &columns(&rows);
    for set in ["primary", "diffuse"] {
        text += &format!("\n{set}: million rays a second of processor time, wrong answers\n");
        text += &columns(&rates(figures, sizes, set));
    }
    text
}

fn rates(figures: &Figures, sizes: &[(String, usize)], set: &str) -> Vec<Vec<String>> {
    let mut names: Vec<&str> = Vec::new();
    for row in &figures.rays {
        if !names.contains(&row.contender.as_str()) {
            names.push(&row.contender);
        }
    }
    let head = names.iter().map(|name| (*name).to_owned());
    let mut rows: Vec<Vec<String>> =
        vec![std::iter::once("triangles".to_owned()).chain(head).collect()];
    for (scene, size) in sizes {
        let cell = |name: &&str| {
            let mut of_set = figures.rays.iter().filter(|it| it.set == set);
            let row = of_set.find(|it| it.contender == **name && it.scene == *scene);
            row.map_or("–".to_owned(), |row| format!("{:.2} {:>4}", row.mrays, row.wrong.sum()))
        };
        rows.push(std::iter::once(size.to_string()).chain(names.iter().map(cell)).collect());
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::TreesPerTriangle;

    #[test]
    fn exponents_are_slopes() {
        let sizes = [1e4, 1e5, 1e6];
        assert!((exponent(sizes.iter().map(|&n| (n, 3e-7 * n))) - 1.0).abs() < 1e-12);
        assert!((exponent(sizes.iter().map(|&n| (n, n * n))) - 2.0).abs() < 1e-12);
        let n_log_n = sizes.iter().map(|&n: &f64| (n * n.ln(), 1e-7 * n * n.ln()));
        assert!((exponent(n_log_n) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn only_builds_on_one_thread_count() {
        let row = |scene: &str, threads, build_s| BuildRow {
            scene: scene.to_owned(),
            contender: "x".to_owned(),
            threads,
            build_s,
            build_cpu_s: build_s,
            bytes_per_triangle: 1.0,
            trees: TreesPerTriangle::default(),
        };
        let builds = [row("a", 1, 1.0), row("a", 2, 9.0), row("b", 1, 10.0), row("b", 2, 9.0)];
        let fits = fits(&builds, &[("a".to_owned(), 10), ("b".to_owned(), 100)]);
        assert_eq!(fits.len(), 1);
        assert!((fits[0].exponent_n - 1.0).abs() < 1e-12);
    }
}
