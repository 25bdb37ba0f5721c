//! Packets of rays (S12), as `compare --packets` counts them and `trace --tile` shows them.

mod support;

use serde_json::Value;
use std::fs;
use support::seen::{count_class, json, number, png_size};
use support::{Folder, OCTAHEDRON, USAGE, bumpy_ball};

fn folder() -> Folder {
    let folder = Folder::new();
    folder.file("ball.off", bumpy_ball(12, 16));
    folder.file("eight.off", OCTAHEDRON);
    folder.file("empty.off", "OFF\n0 0 0\n");
    folder
}

fn count(value: &Value) -> u64 {
    value.as_u64().unwrap_or_else(|| panic!("{value} is no count"))
}

/// The steps of a kind.
fn steps<'a>(trace: &'a Value, kind: &str) -> Vec<&'a Value> {
    let all = trace["steps"].as_array().expect("steps");
    all.iter().filter(|step| step["step"] == kind).collect()
}

#[test]
fn compare_counts_what_each_kind_and_size_asks() {
    let folder = folder();
    let arguments = ["compare", "ball.off", "--packets", "--rays", "4000", "--size", "300x200"];
    let report = json(&folder, &arguments);
    assert_eq!(report["primary_grid"], serde_json::json!([80, 48]), "whole tiles");
    assert_eq!(report["answers_identical"], true);
    let contenders = report["contenders"].as_array().expect("contenders");
    let name = |it: &Value| (it["name"].as_str().map(str::to_owned), it["rays_a_packet"].as_u64());
    let names: Vec<_> = contenders.iter().filter_map(|it| name(it).0.zip(name(it).1)).collect();
    let expected = [
        ("single", 1),
        ("masked", 8),
        ("interval", 8),
        ("interval", 64),
        ("interval", 256),
        ("frustum", 8),
        ("frustum", 64),
        ("frustum", 256),
    ];
    assert_eq!(names, expected.map(|(name, size)| (name.to_owned(), size)));
    let [single, masked, .., frustum] = contenders.as_slice() else { panic!("{report}") };
    let figure = |it: &Value, name: &str| number(&it[name]);
    // Eight rays ask once where each asked itself, and test the same triangles.
    assert!(figure(masked, "node_decisions_per_ray") < figure(single, "node_decisions_per_ray"));
    assert_eq!(masked["ray_tests_per_ray"], single["ray_tests_per_ray"]);
    assert!(figure(frustum, "triangle_set_ups_per_ray") < figure(frustum, "ray_tests_per_ray"));
    assert_eq!(frustum["rays_left"], 0, "all camera rays share their origin");
    let again = json(&folder, &[&arguments[..], &["--threads", "1"]].concat());
    assert_eq!(again, report);
}

#[test]
fn compare_of_packets_prints_a_table() {
    let folder = folder();
    let arguments = ["compare", "eight.off", "--packets", "--rays", "1"];
    let text = folder.kdray(&arguments).succeeds().stdout;
    for part in ["256 primary rays (16 x 16 pixels)", "node decisions", "frustum", "identical."] {
        assert!(text.contains(part), "no `{part}` in {text}");
    }
    folder.kdray(&["compare", "empty.off", "--packets"]).succeeds();
    for option in [&["--rounds", "2"][..], &["--no-naive"], &["--plot", "a.svg"]] {
        let arguments = [&["compare", "eight.off", "--packets"], option].concat();
        folder.kdray(&arguments).fails(USAGE, &["cannot be used with", option[0]]);
    }
}

#[test]
fn a_tile_is_traced_as_one_packet() {
    let folder = folder();
    let tile = ["trace", "ball.off", "--size", "300x200", "--tile", "150,100"];
    let trace = json(&folder, &tile);
    assert_eq!(trace["tile"], serde_json::json!({ "at": [144, 96], "size": [16, 16] }));
    assert_eq!((count(&trace["rays"]), count(&trace["hits"])), (256, 256));
    assert_eq!(trace["frusta"].as_array().map(Vec::len), Some(8));
    let together = &trace["together"];
    for (name, kind) in [
        ("node_decisions", "split"),
        ("leaves", "leaf"),
        ("culled", "cull"),
        ("triangle_set_ups", "set_up"),
        ("ray_tests", "test"),
    ] {
        assert_eq!(count(&together[name]), steps(&trace, kind).len() as u64, "{name}");
    }
    assert!(together["node_decisions"].as_u64() < trace["one_by_one"]["node_decisions"].as_u64());
    for step in steps(&trace, "split") {
        let lanes = |name: &str| step[name].as_array().map_or(0, Vec::len);
        let decision = match (lanes("near_frusta"), lanes("far_frusta")) {
            (0, 0) => "neither",
            (_, 0) => "near",
            (0, _) => "far",
            _ => "both",
        };
        assert_eq!(step["decision"], decision, "{step}");
        assert!(lanes("frusta") >= lanes("near_frusta").max(lanes("far_frusta")), "{step}");
    }
    let text = folder.kdray(&tile).succeeds().stdout;
    for part in ["pixels 144,96 to 159,111: 256 rays", "8 sub-frusta along", "256 of 256 hit"] {
        assert!(text.contains(part), "no `{part}` in {text}");
    }
}

#[test]
fn tiles_end_at_the_edge_of_the_picture() {
    let folder = folder();
    let common = ["trace", "ball.off", "--size", "30x20", "--tile", "29,19"];
    let trace = json(&folder, &common);
    assert_eq!(trace["tile"], serde_json::json!({ "at": [16, 16], "size": [14, 4] }));
    assert_eq!(count(&trace["rays"]), 56);
    let trace = json(&folder, &[&common[..], &["--tile-size", "1"]].concat());
    assert_eq!((count(&trace["rays"]), trace["frusta"].as_array().map(Vec::len)), (1, Some(0)));
    let trace = json(&folder, &[&common[..4], &["--tile", "14,9", "--tile-size", "5"]].concat());
    assert_eq!(count(&trace["rays"]), 25);
}

#[test]
fn the_way_of_a_frustum_is_drawn_in_a_section_and_in_space() {
    let folder = folder();
    let tile = ["trace", "ball.off", "--size", "300x200", "--tile", "150,100"];
    let pictures = ["-o", "path.svg", "--out-3d", "view.png", "--samples", "1"];
    let trace = json(&folder, &[&tile[..], &pictures].concat());
    let path = folder.path("path.svg");
    let drawn = |class| count_class(&path, class);
    let leaves = steps(&trace, "leaf").len();
    // The section cuts some of the leaves; each is drawn in one panel or in two.
    let shown = drawn("tested") + drawn("passed");
    assert!(0 < drawn("tested") && 0 < drawn("passed") && shown <= 2 * leaves, "{shown}");
    assert!(0 < drawn("left-out"));
    assert!((1..=16).contains(&drawn("frustum")), "{}", drawn("frustum"));
    assert_eq!(png_size(&folder.path("view.png")).0, 960);
    let seen_from = |from: &str| {
        let arguments = ["--out-3d", "view.svg", "--samples", "1", "--from", from];
        folder.kdray(&[&tile[..], &arguments].concat()).succeeds();
        fs::read(folder.path("view.svg")).expect("the picture")
    };
    assert_ne!(seen_from("5,1,0"), seen_from("-5,1,0"));
}

#[test]
fn tiles_that_cannot_be_traced_are_refused_or_miss() {
    let folder = folder();
    let fails = |arguments: &[&str], parts: &[&str]| {
        folder.kdray(&[&["trace", "ball.off"], arguments].concat()).fails(USAGE, parts);
    };
    fails(&["--tile", "960,0"], &["--tile 960,0", "959,539"]);
    fails(&["--tile", "1,1", "--pixel", "1,1"], &["cannot be used with"]);
    fails(&["--tile", "1,1", "--tile-size", "17"], &["--tile-size", "17"]);
    fails(&["--pixel", "1,1", "--out-3d", "a.svg"], &["cannot be used with", "--out-3d"]);
    fails(&["--pixel", "1,1", "--tile-size", "8"], &["cannot be used with", "--tile-size"]);
    fails(&["--tile", "1,1", "--from", "1,2,3"], &["--out-3d"]);
    fails(&["--tile", "1,1", "--out-3d", "a.gif"], &["a.gif", ".png"]);
    let ran = folder.kdray(&["trace", "ball.off", "--tile", "0,0", "-o", "a.svg"]).succeeds();
    assert!(
        ran.stdout.contains("the rays miss the box") && ran.stderr.contains("nothing is drawn")
    );
    let ran = folder.kdray(&["trace", "empty.off", "--tile", "0,0"]).succeeds();
    assert!(ran.stdout.contains("no triangles") && ran.stdout.contains("no hit"));
    assert_eq!(folder.names(), ["ball.off", "eight.off", "empty.off"]);
}
