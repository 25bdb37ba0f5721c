//! What came of it, in tables.

use super::cases::{Aim, Case};
use super::files::{About, Answers};
use super::judge::{Known, Wrong, judge};
use crate::attack::report::columns;

/// A case with the truth about it and all answers to it.
pub struct Judged {
    /// The case.
    pub case: Case,
    /// The truth.
    pub truths: Vec<Known>,
    /// The answers, in the order of the peers' names.
    pub answers: Vec<Answers>,
}

/// One table of wrong answers and rates over all cases, one of wrong answers for each aim, and one of rates
/// for each case.
pub fn text(judged: &[Judged]) -> String {
    let mut text = String::new();
    for Judged { case, .. } in judged {
        let (name, triangles) = (&case.name, case.target.mesh.triangles().len());
        text += &format!("{name}: {triangles} triangles, {} rays\n", case.shots.len());
    }
    text += "\nAll cases; millions of ordinary rays a second, geometric means\n";
    text += &table(judged, None);
    for aim in Aim::ALL {
        text += &format!("\nRays {}\n", aim.name());
        text += &table(judged, Some(aim));
    }
    text += "\nAll hits, millions of rays a second, case by case\n";
    text + &rates(judged)
}

/// The names of those who answered.
fn peers(judged: &[Judged]) -> Vec<&About> {
    judged.first().map_or(Vec::new(), |first| first.answers.iter().map(|it| &it.about).collect())
}

fn answers<'a>(judged: &'a Judged, about: &About) -> Option<&'a Answers> {
    judged.answers.iter().find(|answers| answers.about.name == about.name)
}

fn table(judged: &[Judged], aim: Option<Aim>) -> String {
    let mut head =
        ["", "version", "rays", "lost", "passed", "phantom", "miscounted", "out of order"].to_vec();
    if aim.is_none() {
        head.extend(["closest", "any", "all"]);
    }
    let mut rows = vec![head.into_iter().map(str::to_owned).collect()];
    for about in peers(judged) {
        let of = |it: &Judged| Some(judge(&it.truths, answers(it, about)?, aim));
        let Some(wrong) = judged.iter().filter_map(of).reduce(Wrong::and) else { continue };
        let maybe = |n: Option<u64>| n.map_or("n/a".to_owned(), |n| n.to_string());
        let mut row = vec![about.name.clone(), about.version.clone()];
        row.extend([wrong.rays, wrong.lost].map(|n| n.to_string()));
        row.extend([maybe(wrong.passed), wrong.phantom.to_string()]);
        row.extend([wrong.miscounted, wrong.disordered].map(maybe));
        if aim.is_none() {
            let seconds: [fn(&About) -> Option<f64>; 3] =
                [|it| it.closest, |it| it.any, |it| it.all];
            row.extend(seconds.map(|seconds| mean(judged, about, seconds)));
        }
        rows.push(row);
    }
    columns(&rows)
}

/// Millions of rays a second.
fn rate(judged: &Judged, about: &About, seconds: fn(&About) -> Option<f64>) -> Option<f64> {
    let seconds = seconds(&answers(judged, about)?.about)?;
    Some(judged.case.shots.len() as f64 / seconds / 1e6)
}

fn mean(judged: &[Judged], about: &About, seconds: fn(&About) -> Option<f64>) -> String {
    let ordinary = judged.iter().filter(|it| !it.case.is_hard);
    let rates: Option<Vec<f64>> = ordinary.map(|it| rate(it, about, seconds)).collect();
    rates.map_or("n/a".to_owned(), |rates| {
        let logs: f64 = rates.iter().map(|rate| rate.ln()).sum();
        format!("{:.3}", (logs / rates.len() as f64).exp())
    })
}

fn rates(judged: &[Judged]) -> String {
    let peers = || peers(judged).into_iter().filter(|about| about.all.is_some());
    let names = peers().map(|about| about.name.clone());
    let mut rows = vec![std::iter::once(String::new()).chain(names).collect::<Vec<_>>()];
    for it in judged {
        let cells = peers().map(|about| rate(it, about, |it| it.all));
        let cells = cells.map(|rate| rate.map_or("n/a".to_owned(), |rate| format!("{rate:.3}")));
        rows.push(std::iter::once(it.case.name.clone()).chain(cells).collect());
    }
    columns(&rows)
}
