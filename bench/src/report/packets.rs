//! Packets in one table: kdray's beside the best of Embree, and beside its own single rays.

use super::{PacketRow, Report, geometric_mean};

/// What stands above the table.
pub(super) const TITLE: &str = "
Packets: how many times as fast kdray packets are as embree best packet, which is the best of single,
8 and 8 coherent by MEDIUM and HIGH, and as kdray single; geometric means over the scenes
";

/// One of the ratios.
type Ratio = fn(&PacketRow) -> Option<f64>;

/// What packets are compared with.
const OTHERS: [(&str, Ratio); 2] =
    [("to embree best packet", |row| row.to_best), ("to kdray single", |row| row.to_single)];

/// The table; empty if there were no packets.
pub(super) fn table(report: &Report) -> Vec<Vec<String>> {
    if report.packets.is_empty() {
        return Vec::new();
    }
    let scenes = report.scenes.iter().map(|(name, _)| name.clone());
    let head = std::iter::once(String::new()).chain(scenes).chain(["mean".to_owned()]).collect();
    let mut rows: Vec<Vec<String>> = vec![head];
    for (name, ratio) in OTHERS {
        let sets = report.sets();
        let there = sets.into_iter().filter(|set| report.packets.iter().any(|row| row.set == *set));
        let there: Vec<&str> = there.collect();
        rows.extend(there.iter().map(|set| row(report, set, (name, ratio))));
        let all = geometric_mean(there.iter().map(|set| mean(report, set, ratio)));
        let nothing = report.scenes.iter().map(|_| String::new());
        let title = std::iter::once(format!("all {name}"));
        rows.push(title.chain(nothing).chain([cell(all)]).collect());
    }
    rows
}

fn row(report: &Report, set: &str, (name, ratio): (&str, Ratio)) -> Vec<String> {
    let is_to_best = name == OTHERS[0].0;
    let told = |scene: &str| {
        let row = find(report, set, scene);
        let best = row.and_then(|row| row.best.as_deref()).filter(|_| is_to_best);
        let best = best.and_then(|best| best.strip_prefix("embree "));
        let which = best.map_or(String::new(), |best| format!(" ({best})"));
        format!("{}{which}", cell(row.and_then(ratio)))
    };
    let cells = report.scenes.iter().map(|(scene, _)| told(scene));
    let title = std::iter::once(format!("{set} {name}"));
    title.chain(cells).chain([cell(mean(report, set, ratio))]).collect()
}

fn find<'a>(report: &'a Report, set: &str, scene: &str) -> Option<&'a PacketRow> {
    report.packets.iter().find(|row| row.set == set && row.scene == scene)
}

/// The geometric mean over the scenes; none if a scene lacks its value.
fn mean(report: &Report, set: &str, ratio: Ratio) -> Option<f64> {
    geometric_mean(report.scenes.iter().map(|(scene, _)| ratio(find(report, set, scene)?)))
}

fn cell(ratio: Option<f64>) -> String {
    ratio.map_or("–".to_owned(), |ratio| format!("{ratio:.2}"))
}

#[cfg(test)]
mod tests {
    use super::super::tests::report;
    use super::*;

    #[test]
    fn ratios_of_sets_and_their_means() {
        let mut report = report();
        assert!(table(&report).is_empty());
        for (scene, to_best) in [("bunny", 2.0), ("dragon", 0.5)] {
            report.packets.push(PacketRow {
                scene: scene.to_owned(),
                set: "primary".to_owned(),
                best: Some("embree high 8".to_owned()),
                to_best: Some(to_best),
                to_single: None,
            });
        }
        let rows = table(&report);
        assert_eq!(rows[0], ["", "bunny", "dragon", "mean"]);
        let first = ["primary to embree best packet", "2.00 (high 8)", "0.50 (high 8)", "1.00"];
        assert_eq!(rows[1], first);
        assert_eq!(rows[2], ["all to embree best packet", "", "", "1.00"]);
        assert_eq!(rows[3], ["primary to kdray single", "–", "–", "–"]);
    }
}
