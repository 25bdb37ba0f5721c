//! `cargo xtask attack`: rays that are aimed to break kdray, at meshes made by code and, if it is there, at
//! those of the folder `../shared/scenes`. Ends with a table, and with failure on any wrong answer; then
//! the smallest case found is printed as a test for `tests/repro`. Ctrl-C ends it earlier, with the table
//! so far.

#![forbid(unsafe_code)]

use indicatif::{HumanCount, ProgressBar, ProgressStyle};
use kdray_tests::attack::campaign::Outcome;
use kdray_tests::attack::{AnyTarget, Campaign, Limits, report, targets};
use kdray_tests::command_line::{Arguments, refuse};
use std::io::{self, Write};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// How many rays are shot if nothing else is said.
const RAYS: u64 = 200_000;
const RAYS_QUICK: u64 = 20_000;

/// How long each failing case is made smaller.
const SHRINK: Duration = Duration::from_secs(30);

/// Whether Ctrl-C was pressed.
static STOPPED: AtomicBool = AtomicBool::new(false);

fn main() -> io::Result<ExitCode> {
    let arguments = Arguments::of_this_program();
    let is_quick = arguments.has("--quick");
    let seed = number(&arguments, "--seed").unwrap_or(1);
    let minutes: Option<f64> = number(&arguments, "--minutes");
    let usual = if is_quick { RAYS_QUICK } else { RAYS };
    let endless = minutes.map_or(usual, |_| u64::MAX);
    let rays = number(&arguments, "--rays").unwrap_or(endless);
    let mut out = io::stdout();
    let targets = match chosen(&arguments, if is_quick { 0 } else { usize::MAX }) {
        Ok(targets) => targets,
        Err(unknown) => return refuse(&unknown),
    };
    let triangles: usize = targets.iter().map(AnyTarget::triangles).sum();
    writeln!(
        out,
        "seed {seed}: {} targets, {} triangles",
        targets.len(),
        HumanCount(triangles as u64)
    )?;
    // A second Ctrl-C ends the process at once.
    let stop = || {
        if STOPPED.swap(true, Ordering::SeqCst) {
            std::process::exit(130)
        }
    };
    ctrlc::set_handler(stop).map_err(io::Error::other)?;

    let started = Instant::now();
    let bar = bar(rays);
    let campaign = Campaign {
        targets,
        seed,
        rays_only: arguments.has("--rays-only"),
        limits: Limits {
            rays,
            until: minutes.map(|m| started + Duration::from_secs_f64(60.0 * m)),
        },
        is_stopped: &|| STOPPED.load(Ordering::SeqCst),
        progress: &|rays, target| {
            bar.set_position(rays);
            bar.set_message(target.to_owned());
        },
        shrink: SHRINK,
        tamper: None,
    };
    let outcomes = campaign.run();
    bar.finish_and_clear();
    tell(&outcomes, started.elapsed(), &mut out)?;
    let is_right = outcomes.iter().all(|outcome| outcome.errors() == 0);
    Ok(if is_right { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn number<T: std::str::FromStr>(arguments: &Arguments, option: &str) -> Option<T> {
    arguments.value(option).and_then(|value| value.parse().ok())
}

/// The targets of the precisions that are given, whose names contain one of those given; scenes of at most so many
/// triangles.
fn chosen(arguments: &Arguments, most: usize) -> Result<Vec<AnyTarget>, String> {
    let scenes = if most > 0 { targets::of_scenes(most) } else { Vec::new() };
    let mut targets = [targets::made(), scenes].concat();
    arguments.check_names("--precision", ["f32", "f64"], |asked, name| asked == name)?;
    targets.retain(|target| arguments.chosen("--precision", target.precision()));
    let is_meant = |asked: &str, name: &str| name.contains(asked);
    arguments.check_names("--targets", targets.iter().map(AnyTarget::name), is_meant)?;
    if let Some(names) = arguments.value("--targets") {
        targets.retain(|target| names.split(',').any(|name| target.name().contains(name)));
    }
    Ok(targets)
}

/// On a terminal how many rays of how many there were; elsewhere nothing.
fn bar(rays: u64) -> ProgressBar {
    let bar = if rays == u64::MAX { ProgressBar::new_spinner() } else { ProgressBar::new(rays) };
    let template = "[{bar:30}] {human_pos} rays, {per_sec}, {eta} left: {msg}";
    let template =
        if rays == u64::MAX { "{spinner} {elapsed} {human_pos} rays: {msg}" } else { template };
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style.progress_chars("=> ")),
        Err(_) => bar,
    }
}

fn tell(outcomes: &[Outcome], took: Duration, out: &mut impl Write) -> io::Result<()> {
    write!(out, "{}", report::table(outcomes))?;
    writeln!(out, "{}", report::LEGEND)?;
    let rays: u64 = outcomes.iter().map(|outcome| outcome.tally.rays).sum();
    writeln!(out, "{} rays in {:.0} s", HumanCount(rays), took.as_secs_f64())?;
    for outcome in outcomes.iter().filter(|outcome| outcome.errors() > 0) {
        let example = outcome.example.as_deref().unwrap_or("trees or hits differ between threads");
        writeln!(out, "\n{}: {example}", outcome.name)?;
        if let Some(case) = &outcome.case {
            writeln!(out, "The smallest case found, as a file for tests/repro:\n\n{}", case.text)?;
        }
    }
    Ok(())
}
