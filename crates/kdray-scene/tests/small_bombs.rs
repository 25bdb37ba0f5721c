//! Small files that ask for much memory or time: refused, or read without.

#![expect(clippy::unwrap_used, reason = "a test may panic in its helpers, too")]

use kdray_scene::{Format, LoadError, LoadOptions, Model, read};
use std::time::{Duration, Instant};

/// `count` times the same, with commas between.
fn list(what: &str, count: usize) -> String {
    vec![what; count].join(",")
}

/// 0 to `count`, with commas between.
fn indices(count: usize) -> String {
    (0..count).map(|i| i.to_string()).collect::<Vec<_>>().join(",")
}

/// Reads a document; more time than any small file needs fails the test.
fn gltf(members: &str) -> Result<Model, LoadError> {
    let text = format!("{{\"asset\":{{\"version\":\"2.0\"}},{members}}}");
    let start = Instant::now();
    let result = read(text.as_bytes(), Format::Gltf, "small", &LoadOptions::default());
    assert!(start.elapsed() < Duration::from_secs(5), "takes {:?}", start.elapsed());
    result
}

/// So many nodes with a mesh and a skin of so many joints, which no buffer backs.
fn skinned(nodes: usize, joints: usize) -> Result<Model, LoadError> {
    gltf(&format!(
        r#""scenes":[{{"nodes":[{}]}}],"nodes":[{}],"skins":[{{"joints":[{}]}}],
        "meshes":[{{"primitives":[{{"attributes":{{}},"mode":0}}]}}]"#,
        indices(nodes),
        list(r#"{"mesh":0,"skin":0}"#, nodes),
        list("0", joints),
    ))
}

#[test]
fn a_skin_takes_memory_once_for_all_nodes() {
    assert!(skinned(100, 20_000).unwrap().triangles.is_empty());
}

#[test]
fn skins_of_more_joints_than_bytes_are_refused() {
    let message = skinned(1, 300_000).unwrap_err().to_string();
    assert!(message.contains("skins[0]: there are many more numbers"), "{message}");
}
