//! `kdray build`, and tree files in the place of scenes.

mod support;

use std::fs;
use support::{
    Folder, INPUT, OCTAHEDRON, OUTPUT, USAGE, bumpy_ball,
    rays::{npy, rays},
};

/// The exit code of a broken tree.
const BROKEN: i32 = 1;

/// A folder with a mesh of 600 triangles, its tree, and rays.
fn folder() -> Folder {
    let folder = Folder::new();
    folder.file("ball.off", bumpy_ball(15, 20));
    folder.file("rays.npy", npy(&rays(500, 6), npyz::Order::C, |x| x));
    let ran = folder.kdray(&["build", "ball.off", "-o", "ball.kdray"]).succeeds();
    assert!(ran.stderr.contains("a triangle"), "{}", ran.stderr);
    folder
}

/// The bytes of the answers to the rays.
fn answers(folder: &Folder, scene: &str, mode: &str, more: &[&str]) -> Vec<u8> {
    let arguments = ["query", scene, "--rays", "rays.npy", "--mode", mode, "--out", "hits.npz"];
    folder.kdray(&[&arguments, more].concat()).succeeds();
    fs::read(folder.path("hits.npz")).expect("it was written")
}

/// The tree file with other bytes.
fn change(folder: &Folder, name: &str, change: impl FnOnce(&mut Vec<u8>)) {
    let mut bytes = fs::read(folder.path("ball.kdray")).expect("it was built");
    change(&mut bytes);
    folder.file(name, bytes);
}

#[test]
fn a_tree_file_answers_as_its_scene() {
    let folder = folder();
    for mode in ["closest", "any", "all", "count"] {
        let expected = answers(&folder, "ball.off", mode, &[]);
        for more in [&[][..], &["--trusted"], &["--naive"]] {
            assert!(answers(&folder, "ball.kdray", mode, more) == expected, "{mode} {more:?}");
        }
    }
}

#[test]
fn the_file_is_the_same_on_any_number_of_threads() {
    let folder = folder();
    folder.kdray(&["build", "ball.off", "-o", "one.kdray", "--threads", "1"]).succeeds();
    let bytes = ["ball.kdray", "one.kdray"].map(|name| fs::read(folder.path(name)).unwrap());
    assert!(bytes[0] == bytes[1]);
}

#[test]
fn figures_are_those_of_the_tree_in_the_file() {
    let folder = folder();
    folder.kdray(&["build", "ball.off", "--split", "middle", "-o", "middle.kdray"]).succeeds();
    let json = |arguments: &[&str]| {
        let text = folder.kdray(&[&["stats"], arguments, &["--json"]].concat()).succeeds().stdout;
        let mut json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        (json["split"].take(), json["sah_cost"].take(), json)
    };
    let (split, _, expected) = json(&["ball.off", "--split", "middle"]);
    assert_eq!(split, "middle");
    for more in [&["middle.kdray"][..], &["middle.kdray", "--trusted"]] {
        let (split, _, found) = json(more);
        assert!(split.is_null());
        assert_eq!(found, expected);
    }
}

#[test]
fn a_tree_file_is_verified() {
    let folder = folder();
    let ran = folder.kdray(&["validate", "ball.kdray"]).succeeds();
    assert!(ran.stdout.contains("valid") && ran.stdout.contains("600 triangles"));
    // A coordinate becomes another.
    change(&folder, "bad.kdray", |bytes| bytes[260] ^= 1);
    folder.kdray(&["validate", "bad.kdray"]).fails(BROKEN, &["bad.kdray", "damaged"]);
    let ran = folder.kdray(&["validate", "bad.kdray", "--json"]);
    assert!(ran.stdout.contains("\"valid\": false") && ran.code == Some(BROKEN), "{}", ran.stdout);
}

#[test]
fn tree_files_of_f64_are_for_others() {
    let folder = folder();
    let corners = [[0.1, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0_f64]];
    let mesh = kdray::TriangleMesh::from_soup([corners]).expect("it is finite");
    let scene = kdray::Scene::build(mesh, &kdray::BuildOptions::default()).expect("it is small");
    kdray_file::save(&scene, &folder.path("double.kdray")).expect("it can be written");
    for trusted in [&[][..], &["--trusted"]] {
        let ran = folder.kdray(&[&["stats", "double.kdray"], trusted].concat());
        ran.fails(INPUT, &["double.kdray", "of 64 bits", "the command takes f32 only"]);
    }
}

#[test]
fn bad_tree_files_are_refused() {
    let folder = folder();
    change(&folder, "flipped.kdray", |bytes| bytes[260] ^= 1);
    change(&folder, "cut.kdray", |bytes| bytes.truncate(1000));
    change(&folder, "short.kdray", |bytes| bytes.truncate(20));
    change(&folder, "new.kdray", |bytes| bytes[8] = 9);
    change(&folder, "header.kdray", |bytes| bytes[30] ^= 4);
    let cases = [
        ("flipped.kdray", "damaged: its checksum is wrong; save it anew", false),
        ("cut.kdray", "has 1000 bytes where", true),
        ("short.kdray", "has 20 bytes where", true),
        ("new.kdray", "version 9", true),
        ("header.kdray", "the header of the tree file is damaged", true),
    ];
    for (name, reason, even_if_trusted) in cases {
        let query = ["query", name, "--rays", "rays.npy", "--out", "-"];
        folder.kdray(&query).fails(INPUT, &[name, reason]);
        folder.kdray(&["stats", name]).fails(INPUT, &[name, reason]);
        if even_if_trusted {
            folder.kdray(&["stats", name, "--trusted"]).fails(INPUT, &[name, reason]);
            folder.kdray(&["validate", name]).fails(INPUT, &[name, reason]);
        }
    }
    let little = ["stats", "ball.kdray", "--memory-limit", "1000"];
    folder.kdray(&little).fails(INPUT, &["ball.kdray", "1000 are allowed", "--memory-limit"]);
}

#[test]
fn what_needs_more_than_triangles_refuses_a_tree_file() {
    let folder = folder();
    for command in [&["render"][..], &["compare"], &["draw", "-o", "x.png"], &["build", "-o", "x"]]
    {
        let ran = folder.kdray(&[command, &["ball.kdray"]].concat());
        ran.fails(INPUT, &["ball.kdray", "this is a tree file"]);
    }
    let ray = ["trace", "ball.kdray", "--ray", "0,0,5,0,0,-1"];
    folder.kdray(&ray).fails(INPUT, &["this is a tree file"]);
}

#[test]
fn how_to_build_is_not_asked_of_a_tree_that_is_there() {
    let folder = folder();
    for option in [["--preset", "best"], ["--split", "sah"], ["--leaf-size", "3"]] {
        let query = ["query", "ball.kdray", "--rays", "rays.npy", "--out", "-"];
        folder.kdray(&[&query[..], &option].concat()).fails(USAGE, &["leave out", option[0]]);
    }
    folder.kdray(&["stats", "ball.kdray", "--max-depth", "3"]).fails(USAGE, &["--max-depth"]);
    folder.kdray(&["validate", "ball.kdray", "--split", "sah"]).fails(USAGE, &["--split"]);
}

#[test]
fn an_output_does_not_replace_an_input() {
    let folder = Folder::new();
    let scene = folder.file("ball.off", OCTAHEDRON);
    let whole = scene.display().to_string();
    for out in ["ball.off", "./ball.off", &whole] {
        let refused = folder.kdray(&["build", "ball.off", "-o", out]);
        refused.fails(USAGE, &[out, "read by the same command"]);
    }
    folder.kdray(&["build", "ball.off", "-o", "-"]).fails(USAGE, &["standard output"]);
    folder.file("rays.csv", "0,0,3,0,0,-1\n");
    for input in ["--rays", "--points"] {
        let refused = folder.kdray(&["query", "ball.off", input, "rays.csv", "-o", "rays.csv"]);
        refused.fails(USAGE, &["rays.csv", "read by the same command"]);
    }
    assert_eq!(fs::read_to_string(scene).unwrap(), OCTAHEDRON);
    assert_eq!(folder.names(), ["ball.off", "rays.csv"]);
}

#[test]
fn a_file_that_cannot_be_written_is_refused_before_the_scene_is_read() {
    let folder = Folder::new();
    let ran = folder.kdray(&["build", "gone.ply", "-o", "gone/tree.kdray"]);
    ran.fails(OUTPUT, &["gone/tree.kdray", "cannot be written"]);
    folder.file("bad.ply", "ply\n");
    folder.kdray(&["build", "bad.ply", "-o", "tree.kdray"]).fails(INPUT, &["bad.ply"]);
    assert_eq!(folder.names(), ["bad.ply"], "no part of an output is left");
}
