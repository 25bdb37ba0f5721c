//! Scenes that are saved and loaded.

mod saved_common;

use kdray::file::{AnyScene, coordinate_bits};
use kdray::memory::AlignedBytes;
use kdray::{BuildOptions, FileError, Precision, Preset, Scene, Strategy, TriangleMesh};
use saved_common::{saved, shared, soup, soup_in_f64};
use std::sync::Arc;

/// Scenes of all kinds: without triangles, of one, with and without a wide tree, of a size that no
/// kernel takes, and with leaves that are too large for one link.
fn scenes() -> Vec<Scene> {
    let large_leaves =
        BuildOptions { leaf_size: usize::MAX, ..BuildOptions::preset(Preset::Balanced) };
    let mut all = Vec::new();
    for options in Preset::ALL.map(BuildOptions::preset) {
        all.extend([0, 1, 5, 300, 6000].map(|count| (soup(count), options)));
    }
    all.extend([60, 3000].map(|count| (soup(count), large_leaves)));
    all.push((soup(300), BuildOptions::for_strategy(Strategy::Middle)));
    let huge = soup(300).vertices().iter().map(|p| p.map(|x| x * 1e30)).collect();
    let triangles = soup(300).triangles().to_vec();
    let huge = TriangleMesh::new(huge, triangles).expect("finite corners");
    all.push((huge, BuildOptions::default()));
    let built = all.into_iter().map(|(mesh, options)| Scene::build(mesh, &options));
    built.map(|scene| scene.expect("small meshes")).collect()
}

/// The same for vertices in f64, of all sizes.
fn scenes_in_f64() -> Vec<Scene<f64>> {
    let (balanced, by_middle) =
        (BuildOptions::default(), BuildOptions::for_strategy(Strategy::Middle));
    let large_leaves = BuildOptions { leaf_size: usize::MAX, ..balanced };
    let all = [
        (soup_in_f64(0, |x| x), balanced),
        (soup_in_f64(1, |x| x / 3.0), balanced),
        (soup_in_f64(300, |x| x / 3.0), balanced),
        (soup_in_f64(300, |x| 5e6 + x), by_middle),
        (soup_in_f64(500, |x| 5e6 + x), large_leaves),
        (soup_in_f64(60, |x| 1e300 * x), balanced),
        (soup_in_f64(60, |x| 1e-310 * x), balanced),
    ];
    let built = all.into_iter().map(|(mesh, options)| Scene::build(mesh, &options));
    built.map(|scene| scene.expect("small meshes")).collect()
}

#[test]
fn what_is_loaded_is_what_was_saved() {
    check_loaded(scenes());
    check_loaded(scenes_in_f64());
}

fn check_loaded<T: Precision>(scenes: Vec<Scene<T>>) {
    for scene in scenes {
        let bytes = saved(&scene);
        assert_eq!(scene.verify(), Ok(()));
        for loaded in [Scene::<T>::load(shared(&bytes)), Scene::open(shared(&bytes))] {
            let loaded = loaded.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(loaded.mesh(), scene.mesh());
            assert_eq!(loaded.mesh().tree_space(), scene.mesh().tree_space());
            assert!(loaded.tree() == scene.tree());
            assert_eq!(loaded.wide_tree().is_some(), scene.wide_tree().is_some());
            assert!(saved(&loaded) == bytes, "byte for byte");
            assert_eq!(loaded.verify(), Ok(()));
        }
    }
}

#[test]
fn the_other_precision_is_named() {
    let one = Scene::build(soup(12), &BuildOptions::default()).expect("a small mesh");
    let in_f64 = soup_in_f64(12, |x| x / 3.0);
    let other = Scene::build(in_f64, &BuildOptions::default()).expect("a small mesh");
    let (one, other) = (shared(&saved(&one)), shared(&saved(&other)));
    for (bytes, found) in [(&one, 32), (&other, 64)] {
        assert_eq!(coordinate_bits((**bytes).as_ref()), Ok(found));
        for any in [AnyScene::load(bytes.clone()), AnyScene::open(bytes.clone())] {
            let any = any.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(matches!(any, AnyScene::F64(_)), found == 64);
            assert_eq!(any.verify(), Ok(()));
        }
    }
    let error = FileError::Precision { found: 64, expected: 32 };
    assert_eq!(Scene::<f32>::load(other.clone()).err(), Some(error));
    assert_eq!(Scene::<f32>::open(other).err(), Some(error));
    let error = FileError::Precision { found: 32, expected: 64 };
    assert_eq!(Scene::<f64>::load(one.clone()).err(), Some(error));
    assert_eq!(Scene::<f64>::open(one).err(), Some(error));
    assert!(error.to_string().contains("Scene<f32>"), "{error}");
}

#[test]
fn every_truncation_is_an_error() {
    check_truncations(soup(12));
    check_truncations(soup_in_f64(12, |x| x / 3.0));
}

fn check_truncations<T: Precision>(mesh: TriangleMesh<T>) {
    let bytes = saved(&Scene::build(mesh, &BuildOptions::default()).expect("a small mesh"));
    for length in 0..bytes.len() {
        let cut = shared(&bytes[..length]);
        let expected = |error: FileError| match error {
            FileError::NotATreeFile => length < 8,
            FileError::Length { found, .. } => found == length as u64,
            _ => false,
        };
        assert!(Scene::<T>::open(cut.clone()).is_err_and(expected), "{length}");
        assert!(Scene::<T>::load(cut).is_err_and(expected), "{length}");
    }
    let longer = shared(&[&bytes[..], &[0]].concat());
    assert!(matches!(Scene::<T>::load(longer), Err(FileError::Length { .. })));
}

#[test]
fn every_flipped_bit_is_an_error() {
    check_flips(soup(12));
    check_flips(soup_in_f64(12, |x| x / 3.0));
}

fn check_flips<T: Precision>(mesh: TriangleMesh<T>) {
    let bytes = saved(&Scene::build(mesh, &BuildOptions::default()).expect("a small mesh"));
    let mut flipped = bytes.clone();
    for place in 0..8 * bytes.len() {
        flipped[place / 8] ^= 1 << (place % 8);
        let error = Scene::<T>::load(shared(&flipped)).err();
        let expected = match error {
            Some(FileError::NotATreeFile) => place < 64,
            Some(FileError::Version(_)) => (64..96).contains(&place),
            Some(FileError::DamagedHeader) => (96..2048).contains(&place),
            Some(FileError::Damaged) => place >= 2048,
            _ => false,
        };
        assert!(expected, "bit {place}: {error:?}");
        flipped[place / 8] ^= 1 << (place % 8);
    }
}

#[cfg(feature = "rayon")]
#[test]
fn the_bytes_are_the_same_on_any_number_of_threads() {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let built = pool.install(|| Scene::build(soup(30_000), &BuildOptions::default()));
        saved(&built.expect("a small mesh"))
    };
    assert!(on(1) == on(3));
}

#[test]
fn bytes_that_are_not_aligned_are_copied() {
    let scene = Scene::build(soup(300), &BuildOptions::default()).expect("a small mesh");
    let bytes = saved(&scene);

    struct Shifted(AlignedBytes);
    impl AsRef<[u8]> for Shifted {
        fn as_ref(&self) -> &[u8] {
            &self.0.as_ref()[1..]
        }
    }
    let shifted = Shifted(AlignedBytes::from(&[&[0], &bytes[..]].concat()[..]));
    let loaded = Scene::<f32>::load(Arc::new(shifted)).expect("the same bytes");
    assert!(saved(&loaded) == bytes);
}
