//! The comparison as bar charts.

use super::report::{PickSet, RayEntry, Report, TreeEntry};
use crate::pictures::{Bars, Canvas, Series, draw_bars};

/// Draws a chart for each figure that matters.
pub(super) fn draw(report: &Report, scene: &str) -> Canvas {
    let names: Vec<&str> = report.contenders.iter().map(|entry| entry.name).collect();
    let [width, height] = report.primary_grid;
    let title = format!("{scene}: {} triangles, four ways to split", report.triangles);
    let subtitle = format!(
        "{width} x {height} camera rays; builds and rates on {} thread{}, rates the median of {} \
         rounds; all answers are identical",
        report.threads,
        if report.threads == 1 { "" } else { "s" },
        report.rounds,
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
