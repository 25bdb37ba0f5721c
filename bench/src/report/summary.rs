//! Builds in one line a contender: geometric means over the scenes.

use super::{BuildRow, Report, geometric_mean};

/// What stands above the table.
pub(super) const TITLE: &str = "
Builds, geometric means over the scenes: time on the fewest threads in those of Embree MEDIUM and HIGH;
how many times as fast on more; bytes a triangle, all told, of the wide tree, of the canonical tree
";

/// Whose times are the unit.
const BASELINES: [&str; 2] = ["embree medium", "embree high"];

/// The table.
pub(super) fn builds(report: &Report) -> Vec<Vec<String>> {
    let threads = report.build_threads();
    let Some((&fewest, more)) = threads.split_first() else { return Vec::new() };
    let more_threads = more.iter().map(|count| format!("{count} threads"));
    let owned = |heads: &[&str]| heads.iter().map(|&head| head.to_owned()).collect::<Vec<_>>();
    let heads = owned(&["", "MEDIUM", "HIGH"]).into_iter().chain(more_threads);
    let heads = heads.chain(owned(&["bytes", "wide", "canonical"])).collect();
    let row = |contender| row(report, contender, fewest, more);
    std::iter::once(heads).chain(report.builders().into_iter().map(row)).collect()
}

fn row(report: &Report, contender: &str, fewest: usize, more: &[usize]) -> Vec<String> {
    let on_fewest = (contender, fewest);
    let to_baselines = BASELINES.map(|baseline| ratio(report, on_fewest, (baseline, fewest)));
    let speed_ups = more.iter().map(|&count| ratio(report, on_fewest, (contender, count)));
    let bytes = [
        bytes(report, contender, |row| Some(row.bytes_per_triangle)),
        bytes(report, contender, |row| row.trees.wide),
        bytes(report, contender, |row| row.trees.canonical),
    ];
    let factors = to_baselines.into_iter().chain(speed_ups).map(|factor| cell(factor, 2));
    let cells = factors.chain(bytes.map(|count| cell(count, 0)));
    std::iter::once(contender.to_owned()).chain(cells).collect()
}

/// The mean of the time that one contender takes on some threads in that of another.
fn ratio(report: &Report, above: (&str, usize), below: (&str, usize)) -> Option<f64> {
    let time = |(name, threads), scene: &str| Some(report.build(name, scene, threads)?.build_s);
    mean(report, |scene| Some(time(above, scene)? / time(below, scene)?))
}

/// The mean of some bytes a triangle, which are the same for any number of threads.
fn bytes(report: &Report, contender: &str, of: fn(&BuildRow) -> Option<f64>) -> Option<f64> {
    let is_it = |row: &&BuildRow, scene: &str| row.contender == contender && row.scene == scene;
    mean(report, |scene| of(report.builds.iter().find(|row| is_it(row, scene))?))
}

/// The geometric mean over the scenes; none if a scene lacks its value.
fn mean(report: &Report, value: impl Fn(&str) -> Option<f64>) -> Option<f64> {
    geometric_mean(report.scenes.iter().map(|(scene, _)| value(scene)))
}

fn cell(value: Option<f64>, decimals: usize) -> String {
    value.map_or("–".to_owned(), |value| format!("{value:.decimals$}"))
}

#[cfg(test)]
mod tests {
    use super::super::TreesPerTriangle;
    use super::super::tests::report;
    use super::*;

    /// A contender that builds as the test report's do, in other times and with trees.
    fn with_baselines() -> Report {
        let mut report = report();
        let ours = TreesPerTriangle { canonical: Some(20.0), wide: Some(40.0) };
        let builders = [("embree medium", [0.5, 2.0], None), ("kdray", [3.0, 3.0], Some(ours))];
        for (contender, times, trees) in builders {
            for (build_s, scene) in times.into_iter().zip(["bunny", "dragon"]) {
                let mut row = report.builds[0].clone();
                (row.contender, row.scene) = (contender.to_owned(), scene.to_owned());
                (row.build_s, row.trees) = (build_s, trees.unwrap_or_default());
                report.builds.push(row.clone());
                (row.threads, row.build_s) = (2, build_s / 1.5);
                report.builds.push(row);
            }
        }
        report
    }

    #[test]
    fn a_line_sums_up_a_contender() {
        let rows = builds(&with_baselines());
        let line = |name: &str| rows.iter().find(|row| row[0] == name).map(|row| row[1..].to_vec());
        // The root of 3 / 0.5 times 3 / 2.
        let ours = ["3.00", "–", "1.50", "60", "40", "20"].map(str::to_owned);
        assert_eq!(line("kdray"), Some(ours.to_vec()));
        let other = ["1.50", "–", "–", "60", "–", "–"].map(str::to_owned);
        assert_eq!(line("a"), Some(other.to_vec()), "of one thread only");
    }

    #[test]
    fn columns_are_the_numbers_of_threads() {
        let mut report = with_baselines();
        report.builds.retain(|row| row.threads == 2);
        let rows = builds(&report);
        assert_eq!(rows[0], ["", "MEDIUM", "HIGH", "bytes", "wide", "canonical"]);
        assert_eq!(rows[2], ["kdray", "3.00", "–", "60", "40", "20"]);
        assert!(builds(&Report { builds: Vec::new(), ..report }).is_empty());
    }

    #[test]
    fn a_scene_without_a_build_leaves_no_mean() {
        let mut report = with_baselines();
        report.builds.retain(|row| row.scene != "dragon" || row.contender != "embree medium");
        assert_eq!(builds(&report)[1][1], "–");
    }
}
