//! The command line.

use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

/// kdray beside Embree and others, on the same rays in the same run.
///
/// Without arguments: seven scenes if a folder ../shared/scenes is beside the checkout, otherwise
/// scenes made by code; five sets of rays, all contenders, one thread. Rates are by the process's
/// CPU time. See bench/README.md.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask bench", bin_name = "cargo xtask bench")]
#[command(args_conflicts_with_subcommands = true)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) task: Option<Task>,
    #[command(flatten)]
    pub(crate) compare: Compare,
}

/// What else the bench can do.
#[derive(Debug, Subcommand)]
pub(crate) enum Task {
    /// Build time and rays a second on the fractal terrain, from ten thousand triangles to ten
    /// million, with the exponent of the build time.
    Scaling(Scaling),
    /// Answers to the rays of `cargo xtask attack --peers`, which calls this.
    #[command(hide = true)]
    Peers(Peers),
}

/// What is compared.
#[derive(Debug, Default, Args)]
pub(crate) struct Compare {
    /// Scenes, separated by commas: names of ../shared/scenes/scenes.json, mesh files, or
    /// terrain-2m, terrain-10m (any terrain-N), hall, hair
    #[arg(long, value_delimiter = ',', value_name = "SCENE")]
    pub(crate) scenes: Vec<String>,
    /// Sets of rays, separated by commas: primary, diffuse, shadow, ao, ao-shared
    #[arg(long, value_delimiter = ',', value_name = "SET")]
    pub(crate) sets: Vec<String>,
    /// Only contenders whose names contain one of these, and the one that ratios are to; `embree best
    /// packet` is the best of Embree's single rays and packets, which then all run
    #[arg(long, value_delimiter = ',', value_name = "TEXT")]
    pub(crate) contenders: Vec<String>,
    /// Three scenes, 512 x 512 rays, three rounds, smaller samples
    #[arg(long)]
    pub(crate) quick: bool,
    /// How many threads to build on, one number after the other; the first structure is traced
    #[arg(long, value_delimiter = ',', value_name = "N", default_value = "1,2", value_parser = threads)]
    pub(crate) build_threads: Vec<usize>,
    /// How often everything is measured; 5 if not given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(crate) rounds: Option<u32>,
    /// Pixels across and down of the primary rays, a multiple of 16; 1024 if not given
    #[arg(long, value_name = "N", value_parser = resolution)]
    pub(crate) resolution: Option<u32>,
    /// Write all figures to this file
    #[arg(long, value_name = "OUT.json")]
    pub(crate) json: Option<PathBuf>,
    /// Draw the ratios: a name that ends in .svg or .png; without it both beside the JSON
    #[arg(long, value_name = "OUT.svg|png")]
    pub(crate) plot: Option<PathBuf>,
    /// Keep the figures of this run in bench/records
    #[arg(long)]
    pub(crate) record: bool,
    #[command(flatten)]
    pub(crate) view: ViewArgs,
}

impl Compare {
    /// The numbers of threads to build on, each once.
    pub(crate) fn thread_counts(&self) -> Vec<usize> {
        let mut counts = Vec::new();
        for &count in &self.build_threads {
            if !counts.contains(&count) {
                counts.push(count);
            }
        }
        counts
    }
}

/// From where mesh files are seen; scenes that have a view of their own keep it.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct ViewArgs {
    /// The observer; without it one that frames the scene
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = numbers)]
    pub(crate) eye: Option<[f64; 3]>,
    /// The point in the middle of the picture
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = numbers)]
    pub(crate) look_at: Option<[f64; 3]>,
    /// What points up in the picture; without it what the camera says. A file without a camera is seen
    /// from above accordingly, or as if +y were up
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = numbers)]
    pub(crate) up: Option<[f64; 3]>,
    /// The angle between the lower and the upper edge of the picture, below 180
    #[arg(long, value_name = "DEGREES")]
    pub(crate) fov: Option<f64>,
    /// The point light; without it one over the camera's left shoulder
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = numbers)]
    pub(crate) light: Option<[f64; 3]>,
}

/// How far the terrain grows.
#[derive(Debug, Args)]
pub(crate) struct Scaling {
    /// Only up to a million triangles
    #[arg(long)]
    pub(crate) quick: bool,
    /// Only contenders whose names contain one of these
    #[arg(long, value_delimiter = ',', value_name = "TEXT")]
    pub(crate) contenders: Vec<String>,
    /// How often rates are measured; 5 if not given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(crate) rounds: Option<u32>,
    /// Write all figures to this file
    #[arg(long, value_name = "OUT.json")]
    pub(crate) json: Option<PathBuf>,
}

/// Where the rays are.
#[derive(Debug, Args)]
pub(crate) struct Peers {
    /// The folder of the cases, each a folder of its own.
    pub(crate) folder: PathBuf,
    /// Only these, by their names in the bench, separated by commas; all without it.
    #[arg(long, value_delimiter = ',', value_name = "NAME")]
    pub(crate) peers: Vec<String>,
}

fn numbers(text: &str) -> Result<[f64; 3], String> {
    let parts: Vec<f64> = text
        .split(',')
        .map(|part| part.trim().parse().map_err(|_| format!("`{part}` is not a number")))
        .collect::<Result<_, String>>()?;
    match <[f64; 3]>::try_from(parts) {
        Ok(values) if values.iter().all(|value| value.is_finite()) => Ok(values),
        _ => Err("give three finite numbers with commas between them".to_owned()),
    }
}

fn threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(count) if (1..=1024).contains(&count) => Ok(count),
        _ => Err("give numbers from 1 to 1024".to_owned()),
    }
}

fn resolution(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(side) if side % 16 == 0 && (16..=4096).contains(&side) => Ok(side),
        _ => Err("give a multiple of 16 from 16 to 4096".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_checked() {
        assert_eq!(numbers("1, -2,3e1"), Ok([1.0, -2.0, 30.0]));
        assert!(numbers("1,2").is_err() && numbers("1,2,nan").is_err());
        assert_eq!(resolution("512"), Ok(512));
        assert!(threads("0").is_err() && threads("2") == Ok(2));
        assert!(resolution("500").is_err() && resolution("0").is_err());
    }

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory;
        Arguments::command().debug_assert();
        let parsed = Arguments::parse_from(["bench", "--scenes", "a,b", "--quick"]);
        assert_eq!(parsed.compare.scenes, ["a", "b"]);
        assert_eq!(parsed.compare.thread_counts(), [1, 2]);
        let parsed = Arguments::parse_from(["bench", "--build-threads", "2,1,2"]);
        assert_eq!(parsed.compare.thread_counts(), [2, 1]);
        let parsed = Arguments::parse_from(["bench", "scaling", "--quick"]);
        assert!(matches!(parsed.task, Some(Task::Scaling(Scaling { quick: true, .. }))));
    }
}
