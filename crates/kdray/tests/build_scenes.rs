//! Trees of every strategy over real and awkward scenes.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod build_common;

use kdray::{BuildOptions, KdTree, Strategy, TriangleMesh};
use std::path::PathBuf;

/// The uncompressed meshes of the scenes folder, if there is one.
#[expect(clippy::print_stdout, reason = "a test says that it was skipped")]
fn scenes() -> Vec<PathBuf> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/scenes");
    let Ok(entries) = std::fs::read_dir(folder) else {
        assert!(std::env::var_os("CI").is_none(), "{folder} is missing");
        println!("skipped: {folder} is missing");
        return Vec::new();
    };
    let paths = entries.map(|entry| entry.unwrap().path());
    let mut scenes: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|extension| extension == "ply")).collect();
    scenes.sort();
    scenes
}

/// Reads what all these files are: vertices of three floats, faces of a byte 3 and three indices.
/// Triangles that are not finite are dropped.
fn read(path: &PathBuf) -> TriangleMesh {
    let bytes = std::fs::read(path).unwrap();
    let marker = b"end_header\n";
    let end = bytes.windows(marker.len()).position(|w| w == marker).unwrap() + marker.len();
    let header = std::str::from_utf8(&bytes[..end]).unwrap();
    let count = |name: &str| -> usize {
        let line = header.lines().find_map(|line| line.strip_prefix(name)).unwrap();
        line.trim().parse().unwrap()
    };
    let (vertices, faces) = bytes[end..].split_at(12 * count("element vertex"));
    let words = |bytes: &[u8]| -> Vec<[u8; 4]> { bytes.as_chunks().0.to_vec() };
    let vertices: Vec<f32> = words(vertices).into_iter().map(f32::from_le_bytes).collect();
    let faces = faces.as_chunks::<13>().0.iter().map(|face| {
        assert_eq!(face[0], 3);
        let corners: Vec<u32> = words(&face[1..]).into_iter().map(u32::from_le_bytes).collect();
        [corners[0], corners[1], corners[2]]
    });
    let faces: Vec<_> = faces.collect();
    assert_eq!(faces.len(), count("element face"));
    TriangleMesh::new_dropping_bad(vertices.as_chunks().0.to_vec(), faces).unwrap().0
}

#[test]
fn scenes_have_valid_trees_below_the_quota() {
    for path in scenes() {
        let name = path.file_stem().unwrap().to_str().unwrap();
        let mesh = read(&path);
        let count = mesh.triangles().len();
        for options in Strategy::ALL.map(BuildOptions::for_strategy) {
            let tree = KdTree::build(&mesh, &options).unwrap();
            tree.validate(&mesh).unwrap_or_else(|error| panic!("{name}, {options:?}: {error}"));
            let stats = tree.stats(count, &options.cost);
            let quota = BuildOptions::reference_quota(count) as usize;
            assert!(stats.references <= quota, "{name}, {options:?}: {}", stats.references);
        }
    }
}
