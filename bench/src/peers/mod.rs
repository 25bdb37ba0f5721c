//! What others answer to the rays of an attack (`cargo xtask attack --peers`): closest, any and all hits, and
//! how long that takes. Right and wrong is told by whoever made the rays.
//!
//! A folder has a folder for each case, which has a mesh and rays; the answers go to a folder for each peer
//! in that. All are arrays of numpy.

mod answers;
mod case;
mod collect;

use crate::args::Peers;
use crate::contender::{Contender, full_name};
use crate::contenders;
use crate::embree::{Embree, Quality};
use crate::error::BenchError;
use crate::machine::{Machine, work_folder};
use crate::report::say;
use answers::Written;
use case::Case;

/// How often everything is traced; the median counts.
const ROUNDS: usize = 3;

/// Who takes part: the name that the bench knows, that of its package, and what tables call it.
const PEERS: [(&str, &str, &str); 7] = [
    ("kdray single", "kdray", "kdray"),
    ("kdray batch", "kdray", "kdray, batch"),
    ("embree medium single", "embree", "Embree"),
    ("embree robust single", "embree", "Embree, ROBUST"),
    ("obvhs cwbvh", "obvhs", "obvhs, CwBVH"),
    ("obvhs bvh2", "obvhs", "obvhs, BVH2"),
    ("parry3d", "parry3d", "parry3d"),
];

/// Answers all cases of a folder.
pub(crate) fn run(options: &Peers) -> Result<(), BenchError> {
    let is_asked =
        |name: &str| options.peers.is_empty() || options.peers.iter().any(|it| it == name);
    let asked: Vec<_> = PEERS.into_iter().filter(|(name, ..)| is_asked(name)).collect();
    let embree = asked.iter().any(|(_, package, _)| *package == "embree").then(fetch).flatten();
    let version = embree.as_ref().map(Embree::version).transpose()?;
    let machine = Machine::here(version);
    let list = contenders::all(embree.as_ref());
    for case in Case::all(&options.folder)? {
        say(&format!("{}: {} rays", case.name, case.rays.len()));
        for &(name, package, label) in &asked {
            let chosen =
                list.iter().flat_map(|it| it.kernels().iter().map(move |kernel| (it, kernel)));
            let mut chosen = chosen.filter(|(it, kernel)| full_name(it.as_ref(), kernel) == name);
            let Some((contender, kernel)) = chosen.next() else { continue };
            let version = machine.versions.get(package).map_or("", String::as_str);
            let written = Written::create(&case.folder, label, version)?;
            answer(&case, contender.as_ref(), kernel, embree.as_ref(), written)?;
        }
    }
    Ok(())
}

fn fetch() -> Option<Embree> {
    let embree = Embree::fetch(&work_folder());
    embree.inspect_err(|error| say(&format!("{error}\ngoing on without Embree"))).ok()
}

/// All that a peer can answer.
fn answer(
    case: &Case,
    contender: &dyn Contender,
    kernel: &str,
    embree: Option<&Embree>,
    mut written: Written,
) -> Result<(), BenchError> {
    written.by_kernel(case, contender, kernel)?;
    match (full_name(contender, kernel).as_str(), embree) {
        ("kdray single", _) => written.all(&collect::kdray(&case.mesh, &case.rays)?)?,
        ("kdray batch", _) => written.all(&collect::kdray_batch(&case.mesh, &case.rays)?)?,
        ("embree medium single", Some(embree)) => {
            written.all(&collect::embree(embree, Quality::Medium, &case.mesh, &case.rays)?)?;
        }
        ("embree robust single", Some(embree)) => {
            written.all(&collect::embree(embree, Quality::Robust, &case.mesh, &case.rays)?)?;
        }
        _ => {}
    }
    written.finish()
}
