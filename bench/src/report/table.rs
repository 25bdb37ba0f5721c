//! The figures as text.

use super::{BuildRow, RayRow, Report, geometric_mean, packets, summary};
use crate::reference::Wrong;

/// All tables.
pub(super) fn text(report: &Report) -> String {
    let mut text = format!("{}\n", report.machine.text());
    let scenes: Vec<String> =
        report.scenes.iter().map(|(name, count)| format!("{name} {count}")).collect();
    let (side, rounds) = (report.resolution, report.rounds);
    text += &format!("Triangles: {}.\n", scenes.join(", "));
    text +=
        &format!("{side} x {side} primary rays, medians of {rounds} rounds in turn, one thread.\n");
    for set in report.sets() {
        text += &format!("\n{set}: ratio to Embree MEDIUM with single rays; ");
        text += "million rays a second by processor time; by wall time\n";
        text += &columns(&rates(report, set));
    }
    let values = if report.has_ratios() { "ratios" } else { "rates" };
    text += &format!("\nGeometric means of the {values}\n");
    text += &columns(&means(report));
    let packets = packets::table(report);
    if !packets.is_empty() {
        text += packets::TITLE;
        text += &columns(&packets);
    }
    text += "\nWrong answers in all scenes: lost / phantom / far of so many rays\n";
    text += &columns(&wrong(report));
    let threads: Vec<String> = report.build_threads().iter().map(usize::to_string).collect();
    let threads = threads.join(" | ");
    text += &format!("\nBuild: seconds of wall time on {threads} threads | bytes a triangle\n");
    text += &columns(&builds(report));
    text += summary::TITLE;
    text += &columns(&summary::builds(report));
    text
}

/// Lays out rows of cells in columns, the first one to the left and the others to the right.
pub(crate) fn columns(rows: &[Vec<String>]) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..count).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (column, (cell, &width)) in row.iter().zip(&widths).enumerate() {
            line +=
                &if column == 0 { format!("{cell:<width$}") } else { format!("  {cell:>width$}") };
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

/// A table whose first row is `head` and whose others begin with a contender's name.
fn rows(head: Vec<String>, body: impl Iterator<Item = Vec<String>>) -> Vec<Vec<String>> {
    std::iter::once(head).chain(body).collect()
}

fn rates(report: &Report, set: &str) -> Vec<Vec<String>> {
    let head = std::iter::once(String::new());
    let head = head.chain(report.scenes.iter().map(|(name, _)| name.clone()));
    let head = head.chain(["mean".to_owned()]).collect();
    let of_set = |contender: &str, scene: &str| {
        report
            .rays
            .iter()
            .find(|it| it.set == set && it.contender == contender && it.scene == scene)
    };
    let row = |contender: &str| {
        let cells = report.scenes.iter().map(|(scene, _)| rate(of_set(contender, scene)));
        let mean = ratio(report.mean(set, contender));
        std::iter::once(contender.to_owned()).chain(cells).chain([mean]).collect()
    };
    let contenders = report.contenders();
    let there = contenders
        .iter()
        .filter(|name| report.rays.iter().any(|it| it.set == set && it.contender == **name));
    rows(head, there.map(|contender| row(contender)))
}

/// Ratio and both rates; a dash if nothing was traced.
fn rate(row: Option<&RayRow>) -> String {
    row.map_or("–".to_owned(), |row| {
        let rates = format!("{:5.2} {:5.2}", row.mrays, row.mrays_wall);
        format!("{} {rates}", ratio(row.ratio))
    })
}

fn ratio(ratio: Option<f64>) -> String {
    ratio.map_or("–".to_owned(), |ratio| format!("{ratio:.2}"))
}

fn means(report: &Report) -> Vec<Vec<String>> {
    let sets = report.sets();
    let names = sets.iter().map(|set| (*set).to_owned());
    let head = std::iter::once(String::new()).chain(names).chain(["all".to_owned()]).collect();
    let row = |contender: &str| {
        let means: Vec<Option<f64>> = sets.iter().map(|set| report.mean(set, contender)).collect();
        let all = geometric_mean(means.iter().copied());
        let cells = means.into_iter().chain([all]).map(ratio);
        std::iter::once(contender.to_owned()).chain(cells).collect()
    };
    rows(head, report.contenders().into_iter().map(row))
}

fn wrong(report: &Report) -> Vec<Vec<String>> {
    let sets = report.sets();
    let names = sets.iter().map(|set| (*set).to_owned());
    let head = std::iter::once(String::new()).chain(names).collect();
    let cell = |contender: &str, set: &str| {
        let rows = || report.rays.iter().filter(|it| it.contender == contender && it.set == set);
        let mut sum = Wrong::default();
        for Wrong { lost, phantom, far } in rows().map(|row| row.wrong) {
            sum =
                Wrong { lost: sum.lost + lost, phantom: sum.phantom + phantom, far: sum.far + far };
        }
        let rays: usize = rows().map(|row| row.rays).sum();
        match rays {
            0 => "–".to_owned(),
            _ => format!("{} / {} / {} of {rays}", sum.lost, sum.phantom, sum.far),
        }
    };
    let row = |contender: &str| {
        let cells = sets.iter().map(|set| cell(contender, set));
        std::iter::once(contender.to_owned()).chain(cells).collect()
    };
    rows(head, report.contenders().into_iter().map(row))
}

fn builds(report: &Report) -> Vec<Vec<String>> {
    let head = std::iter::once(String::new());
    let head = head.chain(report.scenes.iter().map(|(name, _)| name.clone())).collect();
    let threads = report.build_threads();
    let cell = |contender: &str, scene: &str| {
        let rows = threads.iter().map(|&count| report.build(contender, scene, count));
        let rows: Vec<Option<&BuildRow>> = rows.collect();
        let time = |row: &Option<&BuildRow>| row.map_or("–".to_owned(), |it| seconds(it.build_s));
        let bytes = rows
            .iter()
            .flatten()
            .next()
            .map_or("–".to_owned(), |row| format!("{:.0}", row.bytes_per_triangle));
        let times: Vec<String> = rows.iter().map(time).collect();
        format!("{} | {bytes}", times.join(" | "))
    };
    let row = |contender: &str| {
        let cells = report.scenes.iter().map(|(scene, _)| cell(contender, scene));
        std::iter::once(contender.to_owned()).chain(cells).collect()
    };
    rows(head, report.builders().into_iter().map(row))
}

/// Seconds in two or three digits.
fn seconds(value: f64) -> String {
    let decimals = if value < 0.1 {
        3
    } else if value < 10.0 {
        2
    } else {
        1
    };
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::super::tests::report;
    use super::*;

    #[test]
    fn tables_hold_ratios_rates_and_wrong_answers() {
        let text = text(&report());
        for part in ["0.50  1.50  1.00", "2.00  6.00  4.00", "14 / 0 / 0 of 8192", "1.50 | 60"] {
            assert!(text.contains(part), "{part} in:\n{text}");
        }
    }

    #[test]
    fn without_a_baseline_rates_remain() {
        let mut report = report();
        report.rays.iter_mut().for_each(|row| row.ratio = None);
        let text = text(&report);
        assert!(text.contains("–  1.50  1.00"), "{text}");
    }
}
