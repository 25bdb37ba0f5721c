//! Everyone who takes part. A new one is a file here and a line in [`all`].

mod bvh;
mod embree;
mod kdray;
mod kdtree_ray;
mod obvhs;
mod parry3d;
mod triangle;

use crate::contender::{Contender, full_name};
use crate::embree::Embree;
use crate::packets;

/// What ratios are to.
pub(crate) const BASELINE: &str = "embree medium single";

/// All contenders; those of Embree if it is there.
pub(crate) fn all(embree: Option<&Embree>) -> Vec<Box<dyn Contender>> {
    let mut list: Vec<Box<dyn Contender>> = Vec::new();
    if let Some(library) = embree {
        list.extend(embree::all(library));
    }
    list.extend(kdray::all());
    list.push(Box::new(obvhs::CwBvh));
    list.push(Box::new(obvhs::Bvh2));
    list.push(Box::new(bvh::Bvh));
    list.push(Box::new(parry3d::Parry));
    list.push(Box::new(kdtree_ray::KdTreeRay));
    list
}

/// Whether a kernel was asked for: by a part of its name, or because ratios are to it, or because it may
/// be the best of Embree, which was asked for.
pub(crate) fn wanted(contender: &dyn Contender, kernel: &str, names: &[String]) -> bool {
    let name = full_name(contender, kernel);
    let is_named = names.is_empty() || names.iter().any(|part| name.contains(part.as_str()));
    is_named || name == BASELINE || packets::is_needed(&name, names)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contender::{Answers, Job};
    use crate::rays::{self, SetKind};
    use crate::reference::Wrong;
    use crate::workers::Workers;

    /// All but Embree, which the bench itself checks: a test must not depend on a download.
    #[test]
    fn contenders_find_what_is_there() {
        let (scene, reference, sets) = rays::tests::terrain();
        let workers = Workers::new(1).unwrap();
        for contender in all(None) {
            let built = contender.build(&scene.mesh, &workers).unwrap();
            for kernel in contender.kernels() {
                for kind in SetKind::ALL {
                    let (set, primary) = (sets.set(kind), sets.set(SetKind::Primary));
                    let Some(mut trace) = built.prepare(kernel, &Job { set, primary }) else {
                        continue;
                    };
                    let mut answers = Answers::room(kind.question(), set.rays.len());
                    trace.trace(&mut answers);
                    let truth = reference.truth(set);
                    let wrong = truth.check(&answers, &set.rays, scene.diagonal);
                    let name = full_name(contender.as_ref(), kernel);
                    let few = set.rays.len() as u64 / 200;
                    assert!(wrong.sum() <= few, "{name} {}: {wrong:?}", kind.name());
                    if name.starts_with("kdray") {
                        assert_eq!(wrong, Wrong::default(), "{name} {}", kind.name());
                    }
                }
            }
        }
    }

    #[test]
    fn parts_of_names_choose_kernels() {
        let list = all(None);
        let chosen = |names: &[String]| {
            list.iter()
                .flat_map(|it| it.kernels().iter().map(move |kernel| (it, kernel)))
                .filter(|(it, kernel)| wanted(it.as_ref(), kernel, names))
                .count()
        };
        assert_eq!(chosen(&["obvhs".to_owned()]), 2);
        assert_eq!(chosen(&["cwbvh".to_owned(), "parry".to_owned()]), 2);
        assert_eq!(chosen(&["nobody".to_owned()]), 0);
    }
}
