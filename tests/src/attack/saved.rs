//! Tree files: whole ones answer as the scene does, damaged ones are refused.

use super::answers::{Answers, Other, Said, Walked};
use super::verdict::compare;
use super::{Attacked, Tally, Volley};
use crate::flat::Flat;
use kdray::memory::AlignedBytes;
use kdray::primitives::HitRule;
use kdray::{FileError, InstructionSet, Precision, Scene};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use std::convert::Infallible;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

/// A way to read a file.
type Read<T> = fn(&[u8]) -> Result<Scene<T>, FileError>;

/// Saves a scene, reads it in both ways, and puts a volley to what comes back.
pub fn attack<T: Attacked>(scene: &Scene<T>, flat: &Flat<T>, volley: &Volley) -> Tally {
    attack_by(&[("loaded", load), ("opened", open)], scene, flat, volley)
}

/// The same with these ways to read a file.
fn attack_by<T: Attacked>(
    ways: &[(&str, Read<T>)],
    scene: &Scene<T>,
    flat: &Flat<T>,
    volley: &Volley,
) -> Tally {
    let mut tally = Tally::default();
    let bytes = saved(scene);
    let walked: Vec<Walked> = volley.rays.iter().map(|ray| Walked::of(scene, ray)).collect();
    for &(name, read) in ways {
        tally.files += 1;
        match read(&bytes) {
            Ok(again) => {
                if saved(&again) != bytes {
                    misread(&mut tally, || format!("{name}, and saved once more, it differs"));
                }
                let Answers { rays, others, .. } = Answers::of(&again, flat, volley);
                for Other { name: what, said } in told(&rays).into_iter().chain(others) {
                    compare(&mut tally, volley, &walked, &format!("{name}, {what}"), &said);
                }
            }
            Err(error) => misread(&mut tally, || format!("{name}: {error}")),
        }
    }
    tally
}

/// Damages a file as often, and counts how often that is not an error.
pub fn damage<T: Precision>(
    scene: &Scene<T>,
    volley: &Volley,
    count: u64,
    random: &mut Pcg64Mcg,
) -> Tally {
    damage_for([load, open], scene, volley, count, random)
}

/// The same for who reads with care, and who trusts the file.
fn damage_for<T: Precision>(
    [load, open]: [Read<T>; 2],
    scene: &Scene<T>,
    volley: &Volley,
    count: u64,
    random: &mut Pcg64Mcg,
) -> Tally {
    let sets = InstructionSet::available();
    let mut tally = Tally::default();
    let whole = saved(scene);
    for _ in 0..count {
        let mut bytes = whole.clone();
        let place = random.random_range(0..bytes.len());
        match random.random_range(0..8) {
            0 => bytes.truncate(place),
            1 => bytes.extend_from_slice(&whole[..random.random_range(1..100)]),
            2 => bytes[place..].fill(random.random()),
            _ => bytes[place] ^= random.random_range(1..=255_u8),
        }
        if bytes == whole {
            continue;
        }
        tally.files += 1;
        let loaded = catch_unwind(|| load(&bytes).map(|_| ()));
        if !matches!(loaded, Ok(Err(_))) {
            misread(&mut tally, || format!("damaged at {place}, loaded: {loaded:?}"));
        }
        // Not all damage is seen by whoever trusts the file; but nothing may panic.
        let set = sets[random.random_range(0..sets.len())];
        let asked = AssertUnwindSafe(|| {
            if let Ok(scene) = open(&bytes) {
                let scene = scene.with_instructions(set);
                for ray in &volley.rays {
                    let _ = (scene.closest_hit(ray), scene.any_hit(ray), scene.count(ray));
                }
            }
        });
        if catch_unwind(asked).is_err() {
            misread(&mut tally, || format!("damaged at {place}, opened: it panics"));
        }
    }
    tally
}

fn misread(tally: &mut Tally, what: impl FnOnce() -> String) {
    tally.misread += 1;
    tally.tell(&"a tree file", what);
}

/// What the leaf walk says, as a kernel says it.
fn told(rays: &[Walked]) -> Vec<Other> {
    let other = |name: &str, said| Other { name: name.to_owned(), said };
    let crossed = rays.iter().map(|ray| ray.crossed.clone()).collect();
    let touched = rays.iter().map(|ray| ray.touched.clone()).collect();
    vec![
        other("closest hit", Said::Closest(rays.iter().map(|ray| ray.closest).collect())),
        other("any hit", Said::Any(rays.iter().map(|ray| ray.any).collect())),
        other("all hits", Said::All(HitRule::Crossing, crossed)),
        other("all touched", Said::All(HitRule::Touching, touched)),
    ]
}

/// The bytes of a scene's file.
pub fn saved<T: Precision>(scene: &Scene<T>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let write = |part: &[u8]| {
        bytes.extend_from_slice(part);
        Ok::<(), Infallible>(())
    };
    match scene.save(write) {
        Ok(()) => bytes,
        Err(never) => match never {},
    }
}

fn load<T: Precision>(bytes: &[u8]) -> Result<Scene<T>, FileError> {
    Scene::load(Arc::new(AlignedBytes::from(bytes)))
}

fn open<T: Precision>(bytes: &[u8]) -> Result<Scene<T>, FileError> {
    Scene::open(Arc::new(AlignedBytes::from(bytes)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::{soup, torus};
    use crate::rays::{Archer, random};
    use kdray::{BuildOptions, TriangleMesh};

    fn scene(mesh: TriangleMesh) -> Scene {
        Scene::build(mesh, &BuildOptions::default()).unwrap()
    }

    /// A scene that no file holds.
    fn other(_: &[u8]) -> Result<Scene, FileError> {
        Ok(scene(crate::meshes::mesh(soup(20, [0.0; 3], 1.0, 3))))
    }

    fn panics(_: &[u8]) -> Result<Scene, FileError> {
        panic!("a test of panics")
    }

    fn volley(scene: &Scene) -> Volley {
        Volley::of_rays(Archer::new(scene.mesh(), 1).all_kinds(1, 10.0))
    }

    #[test]
    fn damaged_files_that_are_read_are_counted() {
        let scene = scene(torus(10, 7));
        let volley = volley(&scene);
        let misread = |readers: [Read<f32>; 2]| {
            let tally = damage_for(readers, &scene, &volley, 40, &mut random(5));
            assert!(tally.files > 30, "{tally:?}");
            (tally.misread, tally.files)
        };
        assert_eq!(misread([load, open]).0, 0);
        for readers in [[other, open], [load, panics], [panics, open]] {
            let (misread, files) = misread(readers);
            assert_eq!(misread, files);
        }
        // Who trusts a file sees not all damage.
        assert!(misread([open, open]).0 > 5);
    }

    #[test]
    fn whole_files_that_answer_otherwise_are_counted() {
        let scene = scene(torus(10, 7));
        let (flat, volley) = (Flat::new(scene.mesh()), volley(&scene));
        let errors = |read: Read<f32>| {
            let tally = attack_by(&[("read", read)], &scene, &flat, &volley);
            [tally.misread, tally.differing]
        };
        assert_eq!(errors(load), [0; 2]);
        assert_eq!(errors(|_| Err(FileError::NotATreeFile)), [1, 0]);
        let [misread, differing] = errors(other);
        assert!(misread == 1 && differing > 0, "{differing}");
    }
}
