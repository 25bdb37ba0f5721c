//! All figures of a run, and the forms in which they are told.

mod file;
mod packets;
mod plot;
mod record;
mod summary;
mod table;

use crate::args::Compare;
use crate::error::BenchError;
use crate::machine::{Machine, records_folder};
use crate::reference::Wrong;
use file::Output;
use serde::Serialize;
use std::path::{Path, PathBuf};

pub(crate) use table::columns;

/// How a contender did on one set of rays.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct RayRow {
    pub(crate) scene: String,
    pub(crate) set: String,
    pub(crate) contender: String,
    /// Which other one it is, if it is the best of several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) best: Option<String>,
    /// How many rays were traced: all of the set, or a sample.
    pub(crate) rays: usize,
    /// Million rays a second of the thread's processor time, the median of the rounds.
    pub(crate) mrays: f64,
    /// The same by wall time.
    pub(crate) mrays_wall: f64,
    /// To Embree MEDIUM with single rays: the median of the rounds' ratios.
    pub(crate) ratio: Option<f64>,
    /// Wrong answers among `rays`.
    #[serde(flatten)]
    pub(crate) wrong: Wrong,
}

/// How kdray's packets did on one set of rays: medians of the rounds' ratios.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct PacketRow {
    pub(crate) scene: String,
    pub(crate) set: String,
    /// Which kernel of Embree was the best.
    pub(crate) best: Option<String>,
    /// Rays a second in those of that kernel.
    pub(crate) to_best: Option<f64>,
    /// Rays a second in those of kdray's single rays.
    pub(crate) to_single: Option<f64>,
}

/// How a contender built.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct BuildRow {
    pub(crate) scene: String,
    pub(crate) contender: String,
    pub(crate) threads: usize,
    /// Wall time.
    pub(crate) build_s: f64,
    /// Processor time of all threads.
    pub(crate) build_cpu_s: f64,
    /// Everything that must be kept, triangles included.
    pub(crate) bytes_per_triangle: f64,
    #[serde(flatten)]
    pub(crate) trees: TreesPerTriangle,
}

/// Bytes a triangle of trees alone; only kdray tells of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct TreesPerTriangle {
    /// Nodes and references, without the triangles.
    #[serde(rename = "canonical_tree_bytes_per_triangle", skip_serializing_if = "Option::is_none")]
    pub(crate) canonical: Option<f64>,
    /// With the triangles in its blocks.
    #[serde(rename = "wide_tree_bytes_per_triangle", skip_serializing_if = "Option::is_none")]
    pub(crate) wide: Option<f64>,
}

/// All figures.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Report {
    pub(crate) machine: Machine,
    /// Pixels across and down of the primary rays.
    pub(crate) resolution: u32,
    pub(crate) rounds: u32,
    /// How long the run took.
    pub(crate) seconds: f64,
    /// Names and numbers of triangles.
    pub(crate) scenes: Vec<(String, usize)>,
    pub(crate) rays: Vec<RayRow>,
    pub(crate) packets: Vec<PacketRow>,
    pub(crate) builds: Vec<BuildRow>,
}

impl Report {
    /// Without figures yet.
    pub(crate) fn new(machine: Machine, resolution: u32, rounds: u32) -> Self {
        let (scenes, rays, packets, builds) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { machine, resolution, rounds, seconds: 0.0, scenes, rays, packets, builds }
    }

    /// Values in the order in which they were first told.
    fn distinct<'a>(&'a self, key: impl Fn(&'a RayRow) -> &'a str) -> Vec<&'a str> {
        let mut list = Vec::new();
        for value in self.rays.iter().map(key) {
            if !list.contains(&value) {
                list.push(value);
            }
        }
        list
    }

    /// Names of sets, in order.
    fn sets(&self) -> Vec<&str> {
        self.distinct(|row| &row.set)
    }

    /// Names of contenders, in order.
    fn contenders(&self) -> Vec<&str> {
        self.distinct(|row| &row.contender)
    }

    /// Names of contenders that built, in order.
    fn builders(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for row in &self.builds {
            if !names.contains(&row.contender.as_str()) {
                names.push(&row.contender);
            }
        }
        names
    }

    /// The numbers of threads that were built on, rising.
    fn build_threads(&self) -> Vec<usize> {
        let mut counts: Vec<usize> = self.builds.iter().map(|row| row.threads).collect();
        counts.sort_unstable();
        counts.dedup();
        counts
    }

    /// How a contender's build of a scene went on so many threads.
    fn build(&self, contender: &str, scene: &str, threads: usize) -> Option<&BuildRow> {
        let is_it = |row: &&BuildRow| {
            row.contender == contender && row.scene == scene && row.threads == threads
        };
        self.builds.iter().find(is_it)
    }

    /// Whether there was Embree to compare with.
    fn has_ratios(&self) -> bool {
        self.rays.iter().any(|row| row.ratio.is_some())
    }

    /// The geometric mean over the scenes of a contender's ratios in a set; of its rates if there
    /// are no ratios.
    fn mean(&self, set: &str, contender: &str) -> Option<f64> {
        let rows = self.rays.iter().filter(|row| row.set == set && row.contender == contender);
        match self.has_ratios() {
            true => geometric_mean(rows.map(|row| row.ratio)),
            false => geometric_mean(rows.map(|row| Some(row.mrays))),
        }
    }
}

/// The geometric mean; none if there are no values or one is missing.
fn geometric_mean(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let logs: Option<Vec<f64>> = values.map(|value| value.map(f64::ln)).collect();
    let logs = logs.filter(|logs| !logs.is_empty())?;
    Some((logs.iter().sum::<f64>() / logs.len() as f64).exp())
}

/// The files that a run writes, which are opened before it begins.
pub(crate) struct Outputs {
    json: Option<Output>,
    plots: Vec<Output>,
    record: Option<PathBuf>,
}

impl Outputs {
    /// Makes sure that all files can be written.
    pub(crate) fn create(options: &Compare) -> Result<Self, BenchError> {
        let plots: Vec<PathBuf> = match (&options.plot, &options.json) {
            (Some(plot), _) => vec![plot.clone()],
            (None, Some(json)) => vec![json.with_extension("svg"), json.with_extension("png")],
            (None, None) => Vec::new(),
        };
        if let Some(plot) = plots.iter().find(|plot| !plot::is_drawable(plot)) {
            let reason = "plots are written as .svg or .png";
            return Err(BenchError::Usage(format!("{}: {reason}", plot.display())));
        }
        Ok(Self {
            json: options.json.as_deref().map(Output::create).transpose()?,
            plots: plots.iter().map(|path| Output::create(path)).collect::<Result<_, _>>()?,
            record: options.record.then(records_folder),
        })
    }

    /// Prints the tables and writes the files.
    pub(crate) fn write(self, report: &Report) -> Result<(), BenchError> {
        print(&table::text(report));
        if let Some(json) = self.json {
            json.write(&to_json(report))?;
        }
        for plot in self.plots {
            let picture = plot::picture(report, plot.path())?;
            plot.write(&picture)?;
        }
        if let Some(folder) = &self.record {
            record::write(folder, report)?;
        }
        Ok(())
    }
}

/// Writes figures as JSON.
pub(crate) fn write_json(path: &Path, figures: &impl Serialize) -> Result<(), BenchError> {
    Output::create(path)?.write(&to_json(figures))
}

fn to_json(figures: &impl Serialize) -> Vec<u8> {
    // Maps have names as keys, and numbers that are not finite become null: nothing can fail.
    let mut text = serde_json::to_vec_pretty(figures).unwrap_or_default();
    text.push(b'\n');
    text
}

/// A result, to standard output.
#[expect(clippy::print_stdout, reason = "tables are what the bench is run for")]
pub(crate) fn print(text: &str) {
    print!("{text}");
}

/// What is being done, to standard error.
#[expect(clippy::print_stderr, reason = "progress belongs on standard error")]
pub(crate) fn say(line: &str) {
    eprintln!("{line}");
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Two contenders on two scenes.
    pub(crate) fn report() -> Report {
        let mut report = Report::new(Machine::here(None), 64, 3);
        for (scene, ratio) in [("bunny", 0.5), ("dragon", 2.0)] {
            report.scenes.push((scene.to_owned(), 10));
            for (contender, ratio, lost) in [("a", 1.0, 0), ("b & c", ratio, 7)] {
                let wrong = Wrong { lost, phantom: 0, far: 0 };
                let (scene, contender) = (scene.to_owned(), contender.to_owned());
                report.rays.push(RayRow {
                    scene: scene.clone(),
                    set: "primary".to_owned(),
                    contender: contender.clone(),
                    best: None,
                    rays: 4096,
                    mrays: 3.0 * ratio,
                    mrays_wall: 2.0 * ratio,
                    ratio: Some(ratio),
                    wrong,
                });
                report.builds.push(BuildRow {
                    scene,
                    contender,
                    threads: 1,
                    build_s: 1.5,
                    build_cpu_s: 1.4,
                    bytes_per_triangle: 60.0,
                    trees: TreesPerTriangle::default(),
                });
            }
        }
        report
    }

    #[test]
    fn means_are_geometric() {
        let mean = report().mean("primary", "b & c").unwrap();
        assert!((mean - 1.0).abs() < 1e-12, "{mean}");
        assert_eq!(report().mean("ao", "a"), None);
        let mut report = report();
        report.rays.iter_mut().for_each(|row| row.ratio = None);
        assert!((report.mean("primary", "b & c").unwrap() - 3.0).abs() < 1e-12);
    }

    #[test]
    fn json_has_the_rows() {
        let json: serde_json::Value = serde_json::from_slice(&to_json(&report())).unwrap();
        let row = &json["rays"][1];
        assert_eq!((row["scene"].as_str(), row["lost"].as_u64()), (Some("bunny"), Some(7)));
        let keys = ["scene", "set", "contender", "mrays", "ratio", "lost", "phantom", "far"];
        assert!(keys.iter().all(|key| row.get(key).is_some()), "{row}");
        let row = &json["builds"][0];
        assert_eq!(row["bytes_per_triangle"], 60.0);
        let keys = ["scene", "contender", "threads", "build_s"];
        assert!(keys.iter().all(|key| row.get(key).is_some()), "{row}");
        assert!(json["machine"]["cpu"].is_string());
    }

    #[test]
    fn files_are_written_beside_the_json() {
        let folder = tempfile::tempdir().unwrap();
        let json = Some(folder.path().join("out.json"));
        let options = Compare { json, ..Compare::default() };
        Outputs::create(&options).unwrap().write(&report()).unwrap();
        for name in ["out.json", "out.svg", "out.png"] {
            assert!(folder.path().join(name).metadata().unwrap().len() > 500, "{name}");
        }
        let options = Compare { plot: Some("out.jpg".into()), ..Compare::default() };
        assert!(Outputs::create(&options).is_err());
    }
}
