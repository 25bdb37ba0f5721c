//! Two steps of `cargo xtask attack --peers`: with `--write FOLDER` it makes meshes and rays, with `--judge
//! FOLDER` it reads what kdray and others answered to them and tells what is wrong. Ends with failure if
//! kdray is wrong.

#![forbid(unsafe_code)]

use kdray_tests::command_line::Arguments;
use kdray_tests::peers::cases::{self, Case};
use kdray_tests::peers::judge::{judge, truths};
use kdray_tests::peers::table::{self, Judged};
use kdray_tests::peers::{files, judge::Wrong};
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

/// How many rays a case has if nothing else is said.
const RAYS: usize = 10_000;

fn main() -> io::Result<ExitCode> {
    let arguments = Arguments::of_this_program();
    let number = |option: &str| arguments.value(option).and_then(|value| value.parse::<u64>().ok());
    let rays = number("--rays").map_or(RAYS, |rays| rays as usize);
    let cases = cases::all(rays, number("--seed").unwrap_or(1));
    match (arguments.value("--write"), arguments.value("--judge")) {
        (Some(folder), _) => files::write(Path::new(folder), &cases).map(|()| ExitCode::SUCCESS),
        (_, Some(folder)) => tell(cases, Path::new(folder)),
        _ => Err(io::Error::new(io::ErrorKind::InvalidInput, "give --write or --judge")),
    }
}

fn tell(cases: Vec<Case>, folder: &Path) -> io::Result<ExitCode> {
    let judged = |(number, case): (usize, Case)| {
        let answers = files::read(folder, number, &case)?;
        Ok(Judged { truths: truths(&case), answers, case })
    };
    let judged = cases.into_iter().enumerate().map(judged).collect::<io::Result<Vec<_>>>()?;
    write!(io::stdout(), "{}", table::text(&judged))?;
    let of_kdray = judged.iter().flat_map(|it| {
        let own = it.answers.iter().filter(|answers| answers.about.name.starts_with("kdray"));
        own.map(|answers| judge(&it.truths, answers, None))
    });
    let is_right = |it: Wrong| {
        let others = [it.passed, it.miscounted, it.disordered].into_iter().flatten().sum::<u64>();
        it.lost + it.phantom + others == 0
    };
    let mut of_kdray = of_kdray.peekable();
    let is_right = of_kdray.peek().is_some() && of_kdray.all(is_right);
    Ok(if is_right { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
