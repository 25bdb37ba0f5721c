//! Scenes that are saved and loaded.

mod saved_common;

use kdray::memory::AlignedBytes;
use kdray::{BuildOptions, FileError, Preset, Scene, Strategy, TriangleMesh};
use saved_common::{saved, shared, soup};
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

#[test]
fn what_is_loaded_is_what_was_saved() {
    for scene in scenes() {
        let bytes = saved(&scene);
        assert_eq!(scene.verify(), Ok(()));
        for loaded in [Scene::load(shared(&bytes)), Scene::open(shared(&bytes))] {
            let loaded = loaded.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(loaded.mesh(), scene.mesh());
            assert!(loaded.tree() == scene.tree());
            assert_eq!(loaded.wide_tree().is_some(), scene.wide_tree().is_some());
            assert!(saved(&loaded) == bytes, "byte for byte");
            assert_eq!(loaded.verify(), Ok(()));
        }
    }
}

#[test]
fn every_truncation_is_an_error() {
    let bytes = saved(&Scene::build(soup(12), &BuildOptions::default()).expect("a small mesh"));
    for length in 0..bytes.len() {
        let cut = shared(&bytes[..length]);
        let expected = |error: FileError| match error {
            FileError::NotATreeFile => length < 8,
            FileError::Length { found, .. } => found == length as u64,
            _ => false,
        };
        assert!(Scene::open(cut.clone()).is_err_and(expected), "{length}");
        assert!(Scene::load(cut).is_err_and(expected), "{length}");
    }
    let longer = shared(&[&bytes[..], &[0]].concat());
    assert!(matches!(Scene::load(longer), Err(FileError::Length { .. })));
}

#[test]
fn every_flipped_bit_is_an_error() {
    let bytes = saved(&Scene::build(soup(12), &BuildOptions::default()).expect("a small mesh"));
    let mut flipped = bytes.clone();
    for place in 0..8 * bytes.len() {
        flipped[place / 8] ^= 1 << (place % 8);
        let error = Scene::load(shared(&flipped)).err();
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
    let loaded = Scene::load(Arc::new(shifted)).expect("the same bytes");
    assert!(saved(&loaded) == bytes);
}
