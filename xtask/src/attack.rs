//! `cargo xtask attack`.

use crate::peers;
use crate::steps::{Steps, option};
use clap::Args;

/// What is shot; see `tests/src/bin/attack.rs`.
#[derive(Args)]
pub(crate) struct Options {
    /// About so many rays in all; 200,000 if neither this nor --minutes is given.
    #[arg(long)]
    rays: Option<u64>,
    /// So many minutes at most.
    #[arg(long)]
    minutes: Option<f64>,
    /// Where chance begins: the same rays on every run, others for another number.
    #[arg(long)]
    seed: Option<u64>,
    /// Only targets whose names contain one of these, separated by commas.
    #[arg(long)]
    targets: Option<String>,
    /// Only targets of f32 vertices, or only those of f64 ones.
    #[arg(long, value_parser = ["f32", "f64"])]
    precision: Option<String>,
    /// Only rays: no points, copies and files, and trees are not compared.
    #[arg(long)]
    rays_only: bool,
    /// Only targets that are made by code, and 20,000 rays.
    #[arg(long)]
    quick: bool,
    /// Instead ask Embree, Open3D, trimesh and other crates, too, about the same rays at closed meshes: 10,000
    /// hard ones and as many ordinary ones at each, or --rays. Fetches packages from PyPI.
    #[arg(long, conflicts_with_all = ["minutes", "targets", "precision", "rays_only", "quick"])]
    peers: bool,
}

/// Runs the attack.
pub(crate) fn run(options: &Options) -> Result<(), String> {
    let [rays, seed] = [options.rays, options.seed].map(|number| number.map(|n| n.to_string()));
    if options.peers {
        return peers::run(
            &[option("--rays", rays.as_ref()), option("--seed", seed.as_ref())].concat(),
        );
    }
    let minutes = options.minutes.map(|minutes| minutes.to_string());
    let mut given = [
        option("--rays", rays.as_ref()),
        option("--minutes", minutes.as_ref()),
        option("--seed", seed.as_ref()),
        option("--targets", options.targets.as_ref()),
        option("--precision", options.precision.as_ref()),
    ]
    .concat();
    given.extend(options.rays_only.then(|| "--rays-only".to_owned()));
    given.extend(options.quick.then(|| "--quick".to_owned()));
    Steps::new().check("attack", "attack", given)
}
