//! The comparison as bar charts.

use super::report::{PickSet, RayEntry, Report, TreeEntry};
use crate::{
    pictures::{Bars, Canvas, Series, draw_bars},
    wording::counted,
};

/// Draws a chart for each figure that matters.
pub(super) fn draw(report: &Report, scene: &str) -> Canvas {
    let names: Vec<&str> = report.contenders.iter().map(|entry| entry.name).collect();
    let [width, height] = report.primary_grid;
    let title = format!(
        "{scene}: {}, four ways to split",
        counted(report.triangles, "triangle", "triangles")
    );
    let subtitle = format!(
        "{width} x {height} camera rays; builds and rates on {}, rates the median of {}; all answers are \
         identical",
        counted(report.threads, "thread", "threads"),
        counted(report.rounds, "round", "rounds"),
    );
    let tree = |title: &str, note, value: fn(&TreeEntry) -> f64| {
        let values = report.contenders.iter().map(|entry| entry.tree.as_ref().map(value)).collect();
        Bars { title: title.to_owned(), note, series: vec![Series { name: "", values }] }
    };
    let rays = |title: &str, note, value: fn(&RayEntry) -> Option<f64>| {
        let sets: [(&'static str, PickSet); 3] = [
            ("primary rays", |entry| &entry.primary),
            ("shadow rays", |entry| &entry.shadow),
            ("bounce rays", |entry| &entry.bounce),
        ];
        let series = sets.map(|(name, set)| Series {
            name,
            values: report.contenders.iter().map(|entry| value(set(entry))).collect(),
        });
        Bars { title: title.to_owned(), note, series: series.into() }
    };
    let charts = [
        tree("SAH cost", "expected cost of a ray; less is better", |tree| tree.sah_cost),
        tree("build time, s", "less is better", |tree| tree.build_seconds),
        rays("nodes visited per ray", "less is better", |set| set.nodes_per_ray),
        rays("million rays per second", "more is better", |set| set.mrays_per_second),
    ];
    draw_bars(&title, &subtitle, &names, &charts)
}
