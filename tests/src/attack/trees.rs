//! Whether trees and hits are the same to the last byte, however many threads there are and however often.

use super::{saved, settings};
use crate::bits::bits;
use kdray::{BuildOptions, Hit, InstructionSet, Precision, Ray, Scene, TriangleMesh};
use rayon::ThreadPoolBuilder;
use std::hash::{DefaultHasher, Hash, Hasher};

/// How many threads are tried, each with a build of its own; one of them twice.
const THREADS: [usize; 4] = [1, 2, 3, 1];

/// Trees of more triangles take too long to be built so often.
const MOST: usize = 20_000;

/// With how many of the settings trees of so many triangles are built again and again.
pub fn settings_tried(triangles: usize) -> u64 {
    if triangles <= MOST { settings::names(triangles).len() as u64 } else { 2 }
}

/// Builds and traces with all numbers of threads and all instruction sets; how many did not give what the
/// first gave, and how many there were.
///
/// # Panics
/// If a build is refused, or threads cannot be started.
pub fn differing<T: Precision>(
    mesh: &TriangleMesh<T>,
    options: &BuildOptions,
    rays: &[Ray],
) -> (u64, u64) {
    let build = || Scene::build(mesh.clone(), options).expect("targets are valid");
    differing_among(&build, rays)
}

/// The same of what `build` gives.
fn differing_among<T: Precision>(
    build: &(dyn Fn() -> Scene<T> + Sync),
    rays: &[Ray],
) -> (u64, u64) {
    let mut prints = Vec::new();
    for threads in THREADS {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads can be started").install(|| {
            let scene = build();
            let tree = fingerprint_of_tree(&scene);
            for set in InstructionSet::available() {
                let scene = scene.clone().with_instructions(set);
                prints.push((tree, fingerprint_of_hits(&scene, rays)));
            }
        });
    }
    let differ = prints.iter().filter(|&print| *print != prints[0]).count();
    (differ as u64, prints.len() as u64)
}

/// A hash of all bytes of the tree file: of both trees and the mesh.
fn fingerprint_of_tree<T: Precision>(scene: &Scene<T>) -> u64 {
    let mut hasher = DefaultHasher::new();
    hasher.write(&saved::saved(scene));
    hasher.finish()
}

fn fingerprint_of_hits<T: Precision>(scene: &Scene<T>, rays: &[Ray]) -> u64 {
    let (mut closest, mut any) = (vec![None; rays.len()], vec![false; rays.len()]);
    scene.par_closest_hits(rays, &mut closest);
    scene.par_any_hits(rays, &mut any);
    let mut hasher = DefaultHasher::new();
    closest
        .iter()
        .map(|hit: &Option<Hit>| hit.as_ref().map(bits))
        .for_each(|it| it.hash(&mut hasher));
    any.hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes;

    #[test]
    fn other_trees_have_other_fingerprints() {
        let print = |mesh: TriangleMesh| {
            fingerprint_of_tree(&Scene::build(mesh, &BuildOptions::default()).unwrap())
        };
        let mut soup = meshes::soup(200, [0.0; 3], 1.0, 1);
        let first = print(meshes::mesh(soup.clone()));
        assert_eq!(print(meshes::mesh(soup.clone())), first);
        soup[7][0][1] = soup[7][0][1].next_up();
        assert_ne!(print(meshes::mesh(soup)), first);
    }

    #[test]
    fn what_depends_on_the_number_of_threads_is_counted() {
        let scene = |size: f32| {
            let soup = meshes::soup(50, [0.0; 3], size, 1);
            Scene::build(meshes::mesh(soup), &BuildOptions::default()).unwrap()
        };
        let sets = InstructionSet::available().len() as u64;
        let all = sets * THREADS.len() as u64;
        assert_eq!(differing_among(&|| scene(1.0), &[]), (0, all));
        let on_two = || scene(if rayon::current_num_threads() == 2 { 1.5 } else { 1.0 });
        assert_eq!(differing_among(&on_two, &[]), (sets, all));
    }
}
