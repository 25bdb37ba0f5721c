//! The table that an attack ends with.

use super::Tally;
use super::campaign::Outcome;

/// What stands above the columns.
const HEAD: [&str; 20] = [
    "target",
    "triangles",
    "rays",
    "crossing",
    "close",
    "oracle",
    "packets",
    "copied",
    "points",
    "files",
    "lost",
    "phantom",
    "miscounted",
    "disordered",
    "duplicate",
    "numbers",
    "kernels",
    "misjudged",
    "misread",
    "trees",
];

/// One line a target, and their sum.
pub fn table(outcomes: &[Outcome]) -> String {
    let head = HEAD.map(str::to_owned).to_vec();
    let shot_at =
        || outcomes.iter().filter(|outcome| outcome.tally.rays > 0 || outcome.errors() > 0);
    let rows = shot_at().map(|outcome| {
        let mark = if outcome.is_closed { "" } else { " (open)" };
        row(format!("{}{mark}", outcome.name), outcome.triangles, &outcome.tally, outcome.trees)
    });
    let all = outcomes.iter().fold(Tally::default(), |sum, it| sum.and(it.tally.clone()));
    let triangles = shot_at().map(|outcome| outcome.triangles).sum();
    let trees = outcomes.iter().fold((0, 0), |sum, it| (sum.0 + it.trees.0, sum.1 + it.trees.1));
    let sum = row("all".to_owned(), triangles, &all, trees);
    columns(&std::iter::once(head).chain(rows).chain([sum]).collect::<Vec<_>>())
}

fn row(name: String, triangles: usize, tally: &Tally, trees: (u64, u64)) -> Vec<String> {
    let Tally { rays, crossing, close, oracle, packets, copied, points, files, .. } = *tally;
    let counts = [triangles as u64, rays, crossing, close, oracle, packets, copied, points, files];
    let cells = counts.into_iter().chain(tally.by_kind()).map(|count| count.to_string());
    std::iter::once(name).chain(cells).chain([format!("{} of {}", trees.0, trees.1)]).collect()
}

/// What the columns mean, for whoever reads the table.
pub const LEGEND: &str = "\
crossing: rays that cross the target; close: rays that meet an edge or a vertex, or so nearly that rational
arithmetic decided; oracle: rays of which t, u, v and side of all hits were compared with rational arithmetic;
packets: answers that packets of rays gave and did not leave to the kernels of single rays; copied: rays at copies;
points: points that were asked about; files: tree files that were read, nearly all of them damaged.
lost, phantom: hits or rays that hit; miscounted: rays whose count, or its parity, is wrong; disordered: hits
before nearer ones; duplicate: hits reported twice; numbers: hits with a wrong t, u, v or side; kernels: answers
that are not those of the leaf walk to the last bit, or copies that were refused; misjudged: wrong answers about points; misread: damaged
files that were not refused, and whole ones that answer otherwise; trees: builds and traces on other numbers of threads, or by
other instruction sets, that differ in a byte, of so many.";

/// Lays out rows of cells in columns, the first one to the left and the others to the right.
pub fn columns(rows: &[Vec<String>]) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..count).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).enumerate();
        let cells = cells.map(|(column, (cell, &width))| {
            if column == 0 { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
        });
        cells.collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n"
    };
    rows.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_count_has_its_column() {
        let tally = Tally { rays: 64, lost: 3, differing: 5, ..Tally::default() };
        let outcome =
            Outcome { name: "ball".to_owned(), tally, trees: (1, 8), ..Outcome::default() };
        let table = table(&[outcome.clone(), outcome]);
        let lines: Vec<Vec<&str>> =
            table.lines().map(|line| line.split_whitespace().collect()).collect();
        assert_eq!(lines[0].len(), HEAD.len());
        assert_eq!(lines[3].join(" "), "all 0 128 0 0 0 0 0 0 0 6 0 0 0 0 0 10 0 0 2 of 16");
    }
}
