//! The commands with which one sees the tree: `trace`, `draw` and `compare`.

mod support;

use serde_json::Value;
use std::{
    fs,
    process::{Command, Stdio},
};
use support::seen::{count_class, json, number, png_size};
use support::{Folder, INPUT, OUTPUT, USAGE, binary, bumpy_ball};

/// The triangle of the lecture's worked example (S4): its box is (−2, −2, 4) to (2, 2, 9).
const LECTURE: &str = "v -2 2 4\nv 2 2 4\nv 2 -2 9\nf 1 2 3\n";
const LECTURE_RAY: [&str; 2] = ["--ray", "0,0,0,0.4,0.1,1"];

fn folder() -> Folder {
    let folder = Folder::new();
    folder.file("lecture.obj", LECTURE);
    folder.file("eight.off", support::OCTAHEDRON);
    folder.file("ball.off", bumpy_ball(12, 16));
    folder.file("empty.off", "OFF\n0 0 0\n");
    folder
}

fn near(value: &Value, expected: f64) -> bool {
    (number(value) - expected).abs() < 1e-9
}

fn steps<'a>(trace: &'a Value, kind: &str) -> Vec<&'a Value> {
    let all = trace["steps"].as_array().expect("steps");
    all.iter().filter(|step| step["step"] == kind).collect()
}

#[test]
fn trace_shows_the_worked_example_of_the_lecture() {
    let folder = folder();
    let arguments = [&["trace", "lecture.obj"], &LECTURE_RAY[..]].concat();
    let trace = json(&folder, &arguments);
    let (root, leaf) = (steps(&trace, "root")[0], steps(&trace, "leaf")[0]);
    assert!(near(&root["t_near"], 4.0) && near(&root["t_far"], 5.0), "{root}");
    assert!(near(&leaf["t_near"], 4.0) && near(&leaf["t_far"], 5.0), "{leaf}");
    assert_eq!(trace["bounds"]["min"], serde_json::json!([-2.0, -2.0, 4.0]));
    assert_eq!((leaf["triangles"].as_u64(), &trace["hit"]), (Some(1), &Value::Null));
    let text = folder.kdray(&arguments).succeeds().stdout;
    for part in ["t_near = 4 ≤ t_far = 5: the ray meets the box", "leaf, 1 triangle", "no hit"] {
        assert!(text.contains(part), "no `{part}` in {text}");
    }
}

#[test]
fn each_traced_step_is_the_case_that_it_says() {
    let folder = folder();
    for split in ["sah", "middle", "median", "round-robin"] {
        let trace = json(&folder, &["trace", "ball.off", "--pixel", "470,330", "--split", split]);
        let splits = steps(&trace, "split");
        assert!(splits.len() > 3, "{split}");
        for step in splits {
            let [t_near, t_split, t_far] =
                ["t_near", "t_split", "t_far"].map(|name| number(&step[name]));
            let case = match () {
                () if t_split > t_far => "near_only",
                () if t_split < t_near => "far_only",
                () => "near_then_far",
            };
            assert_eq!(step["case"], case, "{step}");
        }
        let tests = steps(&trace, "triangle");
        let hits = tests.iter().filter_map(|test| test["t"].as_f64());
        let nearest = hits.fold(f64::INFINITY, f64::min);
        assert_eq!(number(&trace["hit"]["t"]), nearest, "{split}");
    }
}

#[test]
fn trace_draws_every_leaf_that_was_visited() {
    let folder = folder();
    let trace = json(&folder, &["trace", "ball.off", "--pixel", "470,330", "-o", "ray.svg"]);
    let leaves = steps(&trace, "leaf").len();
    let drawn = count_class(&folder.path("ray.svg"), "visited");
    // Once in the whole tree, and once where the search ends if that is drawn apart.
    assert!(leaves > 0 && (drawn == leaves || drawn == 2 * leaves), "{drawn} of {leaves}");
    folder.kdray(&["trace", "ball.off", "--pixel", "470,330", "-o", "ray.png"]).succeeds();
    assert!(png_size(&folder.path("ray.png")).0 > 1000);
}

#[test]
fn rays_that_cannot_be_traced_are_refused_or_miss() {
    let folder = folder();
    let fails = |arguments: &[&str], parts: &[&str]| {
        folder.kdray(&[&["trace", "ball.off"], arguments].concat()).fails(USAGE, parts);
    };
    fails(&["--size", "960x540", "--pixel", "960,0"], &["--pixel 960,0", "959,539"]);
    fails(&["--ray", "0,0,0,0,0,0"], &["direction is zero"]);
    fails(&["--ray", "0,0,0,1,0"], &["6 numbers"]);
    fails(&["--ray", "0,0,0,nan,0,1"], &["finite"]);
    fails(&[], &["--ray", "--pixel"]);
    fails(&["--ray", "0,0,0,1,0,0", "--pixel", "1,1"], &["cannot be used with"]);
    fails(&["--pixel", "1,1", "-o", "ray.jpg"], &["ray.jpg", ".svg"]);

    let beside = ["--ray", "0,9,0,1,0,0", "-o", "beside.svg"];
    let ran = folder.kdray(&[&["trace", "ball.off"], &beside[..]].concat()).succeeds();
    assert!(ran.stdout.contains("misses the box") && ran.stderr.contains("not drawn"));
    let ran = folder.kdray(&["trace", "empty.off", "--ray", "0,0,0,1,0,0"]).succeeds();
    assert!(ran.stdout.contains("no triangles") && ran.stdout.contains("no hit"));
    assert_eq!(folder.names(), ["ball.off", "eight.off", "empty.off", "lecture.obj"]);
}

#[test]
fn pictures_are_drawn_even_if_nobody_reads_the_text() {
    let folder = folder();
    let commands: [&[&str]; 3] = [
        &["trace", "ball.off", "--pixel", "470,330", "-o", "drawn.svg"],
        &["trace", "ball.off", "--tile", "470,330", "-o", "drawn.svg"],
        &["compare", "ball.off", "--rays", "9", "--rounds", "1", "--plot", "drawn.svg"],
    ];
    for arguments in commands {
        let mut command = Command::new(binary());
        command.args(arguments).arg("--quiet").current_dir(folder.path(""));
        let mut child = command.stdout(Stdio::piped()).spawn().expect("the command runs");
        drop(child.stdout.take());
        assert!(child.wait().expect("an end").success(), "{arguments:?}");
        fs::remove_file(folder.path("drawn.svg")).expect("the picture");
    }
}

#[test]
fn a_short_direction_is_drawn_as_a_long_one() {
    let folder = folder();
    let ray = ["--ray", "0.1,0.2,5,0,1e-17,-1e-16"];
    folder.kdray(&[&["trace", "ball.off", "-o", "ray.svg"], &ray[..]].concat()).succeeds();
    let svg = fs::read_to_string(folder.path("ray.svg")).expect("the picture");
    assert!(!svg.contains("NaN") && svg.contains("hit, t = "), "{svg}");
}

#[test]
fn any_file_name_makes_a_well_formed_picture() {
    let folder = folder();
    let name = "a\u{1}b & <c>.off";
    folder.file(name, support::OCTAHEDRON);
    folder.kdray(&["draw", name, "-o", "slice.svg", "--slice", "z=0.1"]).succeeds();
    assert!(count_class(&folder.path("slice.svg"), "cell") > 0);
}

#[test]
fn options_without_a_meaning_are_refused() {
    let folder = folder();
    let cases: [(&[&str], &str); 7] = [
        (&["stats", "--drop-bad"], "<SCENE>"),
        (&["stats", "--format", "ply"], "<SCENE>"),
        (&["stats", "--max-bytes", "3"], "<SCENE>"),
        (&["trace", "eight.off", "--ray", "0,0,5,0,0,-1", "--camera", "no"], "--camera"),
        (&["trace", "eight.off", "--ray", "0,0,5,0,0,-1", "--fov", "50"], "--fov"),
        (&["trace", "eight.off", "--pixel", "1,1", "--light", "0,9,0"], "--light"),
        (&["compare", "eight.off", "--packets", "--light", "0,9,0"], "--light"),
    ];
    for (arguments, part) in cases {
        folder.kdray(arguments).fails(USAGE, &[part]);
    }
}

#[test]
fn a_slice_has_a_rectangle_for_each_cell() {
    let folder = folder();
    // Round robin cuts the octahedron's box at x = 0, y = 0 and z = 0.
    for (depth, cells, drawn) in
        [("0", 1, "1 cell"), ("1", 2, "2 cells"), ("2", 4, "4 cells"), ("3", 4, "4 cells")]
    {
        let common = ["draw", "eight.off", "-o", "slice.svg", "--slice", "z=0.1"];
        let tree = ["--split", "round-robin", "--leaf-size", "1", "--max-depth", depth];
        let ran = folder.kdray(&[&common[..], &tree].concat()).succeeds();
        assert!(ran.stderr.contains(&format!("drew {drawn} and 4 cut triangles")));
        assert_eq!(count_class(&folder.path("slice.svg"), "cell"), cells, "{}", ran.stderr);
    }
    let arguments = ["draw", "ball.off", "-o", "slice.svg", "--slice", "y=0.2"];
    folder.kdray(&arguments).succeeds();
    let all = count_class(&folder.path("slice.svg"), "cell");
    folder.kdray(&[&arguments[..], &["--depth", "4"]].concat()).succeeds();
    let some = count_class(&folder.path("slice.svg"), "cell");
    assert!(1 < some && some <= 16 && some < all, "{some} of {all}");
    folder.kdray(&[&arguments[..], &["--window", "0,0.5,-0.5,0.5"]].concat()).succeeds();
    let seen = count_class(&folder.path("slice.svg"), "cell");
    assert!(1 < seen && seen < all, "{seen} of {all}");
}

#[test]
fn cells_are_drawn_over_a_render_the_same_every_time() {
    let folder = folder();
    let draw = |out: &str, more: &[&str]| {
        let common = ["draw", "ball.off", "-o", out, "--size", "160x100", "--samples", "1"];
        folder.kdray(&[&common[..], more].concat()).succeeds();
        fs::read(folder.path(out)).expect("the picture")
    };
    let one = draw("one.png", &["--threads", "1"]);
    assert_eq!(draw("two.png", &["--threads", "2"]), one);
    let (width, height) = png_size(&folder.path("one.png"));
    assert!(width == 160 && height > 140, "{width} x {height}");
    assert_ne!(draw("deep.png", &["--depth", "9"]), one);
    assert_ne!(draw("color.png", &["--color", "depth"]), one);
    draw("cells.svg", &[]);
    assert_eq!(count_class(&folder.path("cells.svg"), "none"), 0, "well-formed");
}

#[test]
fn pictures_that_cannot_be_drawn_are_refused() {
    let folder = folder();
    let fails = |arguments: &[&str], code: i32, parts: &[&str]| {
        folder.kdray(&[&["draw"], arguments].concat()).fails(code, parts);
    };
    let beside = ["eight.off", "-o", "a.svg", "--slice", "z=1.5"];
    fails(&beside, USAGE, &["z=1.5", "(-1, -1, -1) to (1, 1, 1)"]);
    fails(&["eight.off", "-o", "a.svg", "--slice", "w=1"], USAGE, &["such as z=0.5"]);
    let far = ["eight.off", "-o", "a.svg", "--slice", "z=0", "--window", "5,6,0,1"];
    fails(&far, USAGE, &["--window"]);
    fails(&["eight.off", "-o", "a.svg", "--window", "0,1,0,1"], USAGE, &["--slice"]);
    fails(&["eight.off", "-o", "a.png", "--depth", "13"], USAGE, &["--depth 13", "12", "--slice"]);
    for option in ["--eye=1,2,3", "--light=1,2,3", "--samples=9", "--camera=0", "--color=depth"] {
        let arguments = ["eight.off", "-o", "a.svg", "--slice", "z=0", option];
        fails(&arguments, USAGE, &["--slice", "cannot be used with", &option[..5]]);
    }
    fails(&["eight.off", "-o", "a.gif"], USAGE, &["a.gif", ".png"]);
    fails(&["eight.off"], USAGE, &["--out"]);
    fails(&["empty.off", "-o", "a.png"], INPUT, &["empty.off", "no triangles"]);
    fails(&["eight.off", "-o", "no/such/a.svg", "--slice", "z=0"], OUTPUT, &["a.svg"]);
    assert_eq!(folder.names(), ["ball.off", "eight.off", "empty.off", "lecture.obj"]);
}

#[test]
fn compare_measures_four_strategies_that_agree() {
    let folder = folder();
    let arguments = ["compare", "ball.off", "--size", "30x20", "--rays", "600", "--rounds", "2"];
    let report = json(&folder, &[&arguments[..], &["--plot", "bars.svg"]].concat());
    assert_eq!(report["answers_identical"], true);
    assert_eq!((report["triangles"].as_u64(), report["threads"].as_u64()), (Some(384), Some(1)));
    assert_eq!(report["primary_grid"], serde_json::json!([30, 20]));
    let contenders = report["contenders"].as_array().expect("contenders");
    let names: Vec<&str> = contenders.iter().filter_map(|it| it["name"].as_str()).collect();
    assert_eq!(names, ["naive", "middle", "median", "round-robin", "sah"]);

    let naive = &contenders[0];
    assert!(naive["tree"].is_null());
    // Some primary rays miss the box, and then nothing is tested; the others start within it.
    let tested = number(&naive["primary"]["triangles_per_ray"]);
    assert!(50.0 < tested && tested < 380.0, "{tested}");
    assert!(near(&naive["shadow"]["triangles_per_ray"], 384.0), "{naive}");
    assert!(near(&naive["bounce"]["triangles_per_ray"], 384.0), "{naive}");
    for it in &contenders[1..] {
        let tree = &it["tree"];
        let [nodes, leaves] = ["nodes", "leaves"].map(|name| tree[name].as_u64().expect("a count"));
        assert_eq!(nodes, 2 * leaves - 1, "{it}");
        assert!(number(&tree["build_seconds"]) > 0.0);
        for set in ["primary", "shadow", "bounce"] {
            let rays = &it[set];
            assert!(rays["rays"].as_u64() > Some(50), "{it}");
            assert!(number(&rays["nodes_per_ray"]) > 0.0);
            assert!(number(&rays["triangles_per_ray"]) < number(&naive[set]["triangles_per_ray"]));
            assert!(number(&rays["mrays_per_second"]) > 0.0);
        }
    }
    let cost = |it: &Value| number(&it["tree"]["sah_cost"]);
    assert!(contenders[1..4].iter().all(|it| cost(&contenders[4]) < cost(it)), "{report}");

    // A bar for each contender in two charts of one series and two of three.
    assert_eq!(count_class(&folder.path("bars.svg"), "bar"), 5 * (1 + 1 + 3 + 3));
    let again = json(&folder, &arguments);
    for (set, figure) in [("primary", "nodes_per_ray"), ("bounce", "triangles_per_ray")] {
        assert_eq!(again["contenders"][4][set][figure], contenders[4][set][figure]);
    }
}

#[test]
fn the_naive_answer_tests_what_a_tree_of_one_leaf_does() {
    let arguments = ["compare", "ball.off", "--rays", "600", "--rounds", "1", "--max-depth", "0"];
    let report = json(&folder(), &arguments);
    let contenders = report["contenders"].as_array().expect("contenders");
    for it in &contenders[1..] {
        assert_eq!(it["tree"]["nodes"], 1);
        for set in ["primary", "bounce"] {
            let tested = &it[set]["triangles_per_ray"];
            assert_eq!(tested, &contenders[0][set]["triangles_per_ray"], "{set}");
        }
    }
}

#[test]
fn compare_prints_a_table_and_draws_a_png() {
    let folder = folder();
    let arguments = ["compare", "ball.off", "--rays", "100", "--rounds", "1", "--no-naive"];
    let text = folder.kdray(&[&arguments[..], &["--plot", "bars.png"]].concat()).succeeds().stdout;
    for part in ["round-robin", "SAH cost", "bounce: Mrays/s", "All answers are identical."] {
        assert!(text.contains(part), "no `{part}` in {text}");
    }
    assert!(text.contains("\nBuilds and rates: on 1 thread. Rates: median of 1 round"), "{text}");
    assert!(!text.contains("naive"), "{text}");
    let help = folder.kdray(&["compare", "--help"]).succeeds().stdout;
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(help.contains("Builds and rates are measured on one thread unless"), "{help}");
    assert!(png_size(&folder.path("bars.png")).0 > 1000);
}

#[test]
fn compare_of_nothing_is_a_table_without_rays_that_hit() {
    let folder = folder();
    let report = json(&folder, &["compare", "empty.off", "--rays", "9", "--rounds", "1"]);
    for it in report["contenders"].as_array().expect("contenders") {
        assert_eq!(it["bounce"]["rays"], 0);
        assert_eq!(it["bounce"]["mrays_per_second"], Value::Null);
    }
    for [option, bad] in [["--rounds", "0"], ["--rounds", "4294967295"], ["--rays", "4294967295"]] {
        folder.kdray(&["compare", "ball.off", option, bad]).fails(USAGE, &[option, bad]);
    }
    folder.kdray(&["compare", "ball.off", "--plot", "a.txt"]).fails(USAGE, &["a.txt", ".svg"]);
}
