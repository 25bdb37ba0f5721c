//! Pictures that are rendered in parts, and put together.

mod support;

use std::fs;
use support::{Folder, INPUT, OCTAHEDRON, OUTPUT, Ran, USAGE};

/// The built-in scene, small.
const SMALL: [&str; 6] = ["--size", "64x36", "--samples", "2", "--seed", "5"];

/// A mesh that is rendered at once.
const BALL: [&str; 5] = ["ball.off", "--size", "24x16", "--samples", "4"];

fn folder() -> Folder {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    folder
}

fn ball(folder: &Folder, out: &str, arguments: &[&str]) {
    folder.kdray(&[&["render", "-o", out], &BALL[..], arguments].concat()).succeeds();
}

fn merge(folder: &Folder, arguments: &[&str]) -> Ran {
    folder.kdray(&[&["merge"], arguments].concat())
}

fn bytes(folder: &Folder, name: &str) -> Vec<u8> {
    fs::read(folder.path(name)).expect("a file")
}

#[test]
fn four_crops_of_the_built_in_scene_are_the_whole_byte_for_byte() {
    let folder = Folder::new();
    let render = |arguments: &[&str]| {
        folder.kdray(&[&["render"], &SMALL[..], arguments].concat()).succeeds();
    };
    render(&["-o", "whole.exr"]);
    render(&["-o", "whole.png"]);
    let crops = ["0,0,30x20", "30,0,34x20", "0,20,30x16", "30,20,34x16"];
    let names = ["a.exr", "b.exr", "c.exr", "d.exr"];
    for (crop, name) in crops.into_iter().zip(names) {
        render(&["-o", name, "--crop", crop, "--threads", "1"]);
    }
    let ran = merge(&folder, &[&names[..], &["-o", "merged.exr"]].concat()).succeeds();
    assert!(ran.stderr.contains("merged 4 parts into 64 x 36 pixels in "), "{}", ran.stderr);
    assert_eq!(ran.stdout, "");
    assert!(bytes(&folder, "merged.exr") == bytes(&folder, "whole.exr"));
    // A part may be replaced by the merge.
    merge(&folder, &[&names[..], &["-o", "a.exr", "-q"]].concat()).succeeds();
    assert!(bytes(&folder, "a.exr") == bytes(&folder, "whole.exr"));
    merge(&folder, &["a.exr", "-o", "merged.png"]).succeeds();
    assert!(bytes(&folder, "merged.png") == bytes(&folder, "whole.png"));
}

#[test]
fn a_crop_as_png_is_that_part_of_the_picture() {
    let folder = folder();
    ball(&folder, "whole.png", &[]);
    ball(&folder, "part.png", &["--crop", "3,2,20x9"]);
    let open = |name| image::open(folder.path(name)).expect("a picture").to_rgba8();
    let expected = image::imageops::crop_imm(&open("whole.png"), 3, 2, 20, 9).to_image();
    assert_eq!(open("part.png"), expected);
}

#[test]
fn ranges_of_samples_and_pictures_of_cost_are_merged() {
    let folder = folder();
    for kind in ["cost", "packet-size", "depth"] {
        ball(&folder, "whole.png", &["--picture", kind]);
        let parts = [("one.exr", "0..3"), ("two.exr", "3..4")];
        for (name, range) in parts {
            ball(&folder, name, &["--picture", kind, "--sample-range", range]);
        }
        merge(&folder, &["two.exr", "one.exr", "-o", "merged.png"]).succeeds();
        let open = |name| image::open(folder.path(name)).expect("a picture").to_rgba8();
        let (whole, merged) = (open("whole.png"), open("merged.png"));
        let pairs = whole.as_raw().iter().zip(merged.as_raw());
        assert!(pairs.into_iter().all(|(a, b)| a.abs_diff(*b) <= 1), "{kind}");
    }
}

#[test]
fn missing_parts_are_named_unless_they_are_allowed() {
    let folder = folder();
    ball(&folder, "left.exr", &["--crop", "0,0,12x16"]);
    let missing =
        "192 of 384 pixels lack samples, the first of them (12, 0), which has no sample 0";
    let ran = merge(&folder, &["left.exr", "-o", "merged.png"]);
    ran.fails(INPUT, &[missing, "--allow-missing"]);
    assert!(!folder.path("merged.png").exists());
    let ran = merge(&folder, &["left.exr", "-o", "merged.png", "--allow-missing"]).succeeds();
    assert!(ran.stderr.contains("merged 1 part into 50.0 % of 24 x 16 pixels"), "{}", ran.stderr);
    let picture = image::open(folder.path("merged.png")).expect("a picture").to_rgba8();
    assert_eq!((picture.get_pixel(11, 9)[3], picture.get_pixel(12, 9)[3]), (255, 0));
}

#[test]
fn parts_that_do_not_go_together_are_named() {
    let folder = folder();
    ball(&folder, "left.exr", &["--crop", "0,0,12x16"]);
    ball(&folder, "middle.exr", &["--crop", "11,0,12x16"]);
    let refused = |other: &str, parts: &[&str]| {
        merge(&folder, &["left.exr", other, "-o", "merged.exr"]).fails(INPUT, parts);
    };
    refused("middle.exr", &["left.exr and middle.exr both have sample 0 of pixel (11, 0)"]);
    for (options, what) in [
        (&["--seed", "1"][..], "their seed is 0 and 1"),
        (&["--eye=3,2,1"], "their scenes, cameras, lights or options are not the same"),
        (&["--background=1,0,0"], "their scenes, cameras, lights or options are not the same"),
        (&["--picture", "depth"], "their picture is shaded and depth"),
    ] {
        ball(&folder, "other.exr", &[&["--crop", "12,0,12x16"], options].concat());
        refused("other.exr", &["left.exr and other.exr are parts of different pictures", what]);
    }
    folder.file("text.exr", "no picture");
    refused("text.exr", &["text.exr: no OpenEXR file that can be read"]);
    refused("nowhere.exr", &["nowhere.exr: "]);
    ball(&folder, "whole.png", &[]);
    refused("whole.png", &["whole.png: no OpenEXR file"]);
    assert!(!folder.path("merged.exr").exists());
    assert!(!folder.names().iter().any(|name| name.starts_with(".kdray-")));
}

#[test]
fn what_the_command_line_gets_wrong_is_named() {
    let folder = folder();
    for (options, parts) in [
        (["--crop", "0,0,25x16"], &["--crop 0,0,25x16", "24 x 16"][..]),
        (["--crop", "24,0,1x1"], &["--crop 24,0,1x1"]),
        (["--crop", "1,2,3"], &["--crop", "give width and height"]),
        (["--crop", "1,2"], &["--crop", "such as 0,270,480x270"]),
        (["--crop", "0,0,0x9"], &["--crop", "at least one pixel"]),
        (["--sample-range", "2..5"], &["--sample-range 2..5", "samples 0..4"]),
        (["--sample-range", "2..2"], &["--sample-range", "such as 0..8"]),
        (["--sample-range", "all"], &["--sample-range", "such as 0..8"]),
    ] {
        folder.kdray(&[&["render"], &BALL[..], &options].concat()).fails(USAGE, parts);
    }
    for (arguments, parts) in [
        (&["-o", "out.exr"][..], &["PART.exr"][..]),
        (&["a.exr"], &["--out"]),
        (&["a.exr", "-o", "out.jpg"], &["--out out.jpg", ".png or .exr"]),
        (&["a.exr", "-o", "out.exr", "--bits", "16"], &["--bits needs an output"]),
    ] {
        merge(&folder, arguments).fails(USAGE, parts);
    }
    merge(&folder, &["a.exr", "-o", "nowhere/out.exr"]).fails(OUTPUT, &["nowhere/out.exr"]);
    assert_eq!(folder.names(), ["ball.off"]);
}
