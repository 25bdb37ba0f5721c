//! Each command does what its help says.

mod support;

use image::{GenericImageView, ImageReader};
use std::{
    fs,
    path::Path,
    process::{Child, Command, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};
use support::{Folder, INTERRUPTED, OCTAHEDRON, USAGE, binary, bumpy_ball};

const SMALL: [&str; 4] = ["--size", "24x16", "--samples", "1"];

fn render(folder: &Folder, arguments: &[&str]) {
    folder.kdray(&[&["render", "ball.off"], &SMALL[..], arguments].concat()).succeeds();
}

fn folder() -> Folder {
    let folder = Folder::new();
    folder.file("ball.off", OCTAHEDRON);
    folder
}

fn picture(path: &Path) -> image::DynamicImage {
    ImageReader::open(path).expect("the picture").decode().expect("a picture")
}

#[test]
fn render_writes_png_and_exr() {
    let folder = folder();
    let arguments = [&["render", "ball.off", "--light", "3,4,5"], &SMALL[..]].concat();
    let ran = folder.kdray(&arguments).succeeds();
    assert!(ran.stderr.contains("rendered 24 x 16 pixels"), "{}", ran.stderr);
    assert!(ran.stdout.is_empty());
    assert_eq!(picture(&folder.path("kdray.png")).dimensions(), (24, 16));
    render(&folder, &["-o", "fine.png", "--bits", "16"]);
    assert_eq!(picture(&folder.path("fine.png")).color(), image::ColorType::Rgba16);
    render(&folder, &["-o", "one.exr"]);
    render(&folder, &["-o", "all.exr", "--layers"]);
    let size = |name: &str| fs::metadata(folder.path(name)).expect("the picture").len();
    assert!(size("all.exr") > size("one.exr"));
    assert_eq!(folder.names(), ["all.exr", "ball.off", "fine.png", "kdray.png", "one.exr"]);
}

#[test]
fn options_of_the_other_format_are_refused() {
    let folder = folder();
    for (out, option, part) in [
        ("a.png", &["--layers"][..], "--layers needs an output that ends in .exr"),
        ("a.exr", &["--bits", "8"], "--bits needs an output that ends in .png"),
    ] {
        let arguments = [&["render", "ball.off", "-o", out], option].concat();
        folder.kdray(&arguments).fails(USAGE, &[part]);
    }
    assert_eq!(folder.names(), ["ball.off"]);
}

#[test]
#[cfg(unix)]
fn a_pipe_is_an_output_like_any_other() {
    let folder = folder();
    for (name, magic) in [("pipe.png", &b"\x89PNG"[..]), ("pipe.exr", b"\x76\x2f\x31\x01")] {
        let bytes = through_pipe(&folder, name, || render(&folder, &["-o", name]));
        assert!(bytes.starts_with(magic) && bytes.len() > 100, "{name}: {} bytes", bytes.len());
    }
    folder.file("rays.csv", "0.1,0.2,5,0,0,-1\n");
    let query = ["query", "ball.off", "--rays", "rays.csv", "--out"];
    let hits = through_pipe(&folder, "pipe.npz", || {
        folder.kdray(&[&query[..], &["pipe.npz"]].concat()).succeeds();
    });
    folder.kdray(&[&query[..], &["file.npz"]].concat()).succeeds();
    assert!(hits == fs::read(folder.path("file.npz")).expect("the hits"), "{} bytes", hits.len());
}

/// What `write` writes to a pipe of this name.
#[cfg(unix)]
fn through_pipe(folder: &Folder, name: &str, write: impl FnOnce()) -> Vec<u8> {
    let made = Command::new("mkfifo").arg(folder.path(name)).status().expect("mkfifo runs");
    assert!(made.success());
    let pipe = folder.path(name);
    let reader = std::thread::spawn(move || fs::read(pipe).expect("all of it"));
    write();
    reader.join().expect("the reader ends")
}

#[test]
#[cfg(unix)]
fn a_render_that_is_ended_at_once_leaves_nothing() {
    let folder = folder();
    let mut command = Command::new(binary());
    command.args(["render", "ball.off", "--size", "960x960", "--samples", "60000"]);
    command.current_dir(folder.path("")).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().expect("the command runs");
    let start = Instant::now();
    while !folder.names().iter().any(|name| name.starts_with(".kdray-")) {
        assert!(start.elapsed() < Duration::from_secs(60), "no file is begun");
        sleep(Duration::from_millis(10));
    }
    send(&child, "TERM");
    sleep(Duration::from_millis(100));
    send(&child, "TERM");
    assert_eq!(child.wait().expect("an end").code(), Some(INTERRUPTED));
    assert_eq!(folder.names(), ["ball.off"]);
}

#[test]
fn each_kind_of_picture_differs() {
    let folder = folder();
    let kinds = ["shaded", "depth", "normal", "primitive-id", "ambient-occlusion", "cost"];
    let mut seen: Vec<Vec<u8>> = Vec::new();
    for kind in kinds {
        render(&folder, &["--picture", kind]);
        let pixels = picture(&folder.path("kdray.png")).to_rgba8().into_raw();
        assert!(!seen.contains(&pixels), "{kind}");
        seen.push(pixels);
    }
}

#[test]
fn the_picture_depends_on_the_view_and_not_on_split_or_threads() {
    let folder = folder();
    let pixels = |arguments: &[&str]| {
        render(&folder, arguments);
        fs::read(folder.path("kdray.png")).expect("the picture")
    };
    let first = pixels(&[]);
    assert_eq!(pixels(&["--threads", "3", "--split", "median", "--leaf-size", "9"]), first);
    let views = [
        ["--eye=-3,1,0", "--up=0,0,1"],
        ["--fov", "70"],
        ["--light", "0,-4,0"],
        ["--background", "1,0,0"],
    ];
    for view in views {
        assert_ne!(pixels(&view), first, "{view:?}");
    }
}

#[test]
fn up_turns_frame_and_sky() {
    const VERTICES: [&str; 2] = [
        "0 0 0\n2 0 0\n2 1 0\n0 3 0\n0 0 1\n2 0 1\n",
        "0 0 0\n2 0 0\n2 0 1\n0 0 3\n0 -1 0\n2 -1 0\n",
    ];
    let [step, turned] =
        VERTICES.map(|it| format!("OFF\n6 4 0\n{it}3 0 1 2\n3 0 2 3\n3 0 1 5\n3 0 5 4\n"));
    let folder = Folder::new();
    let pixels = |text: &str, arguments: &[&str]| {
        folder.file("step.off", text);
        let render = ["render", "step.off", "--ambient-rays", "0"];
        folder.kdray(&[&render, &SMALL[..], arguments].concat()).succeeds();
        picture(&folder.path("kdray.png")).to_rgba8()
    };
    let upright = pixels(&step, &[]);
    let found = pixels(&turned, &["--up=0,0,1"]);
    let same = upright.pixels().zip(found.pixels()).filter(|(a, b)| a == b).count();
    assert!(same * 100 > 95 * 24 * 16, "{same} pixels are the same");
    assert_ne!(pixels(&turned, &[]), upright);

    let away = ["--eye=9,0,0", "--look-at=30,0,0", "--fov=90", "--up=0,0,1"];
    let sky = pixels(&step, &away);
    let red: Vec<u8> = (0..8).map(|y| sky.get_pixel(12, y)[0]).collect();
    assert!(red.is_sorted() && red[0] + 30 < red[7], "{red:?}");
}

#[test]
fn cameras_of_a_file_are_named() {
    let ran = folder().kdray(&["render", "ball.off", "--camera", "left"]);
    ran.fails(USAGE, &["no such camera; the scene has none"]);
    let ran = folder().kdray(&["render", "--camera", "99"]);
    ran.fails(USAGE, &["no such camera; the scene has 0 `"]);
}

#[test]
fn quiet_says_nothing() {
    let folder = folder();
    let ran = folder.kdray(&[&["render", "ball.off", "--quiet"], &SMALL[..]].concat()).succeeds();
    assert_eq!(ran.stderr, "");
}

#[test]
fn stats_and_validate_print_tables_and_json() {
    let folder = Folder::new();
    folder.file("ball.off", bumpy_ball(20, 30));
    let table = folder.kdray(&["stats", "ball.off"]).succeeds().stdout;
    assert!(
        table
            .lines()
            .next()
            .is_some_and(|line| { line.starts_with("triangles ") && line.ends_with(" 1200") })
    );
    let json = |arguments: &[&str]| -> serde_json::Value {
        let text = folder.kdray(arguments).succeeds().stdout;
        serde_json::from_str(&text).expect("JSON")
    };
    let fine = json(&["stats", "ball.off", "--json"]);
    let coarse = json(&["stats", "ball.off", "--json", "--max-depth", "3"]);
    assert_eq!(fine["triangles"], 1200);
    assert_eq!(fine["split"], "sah");
    assert_eq!(coarse["max_depth"], 3);
    assert!(fine["sah_cost"].as_f64() < coarse["sah_cost"].as_f64());
    let leaves: u64 = fine["leaves_at_depth"]
        .as_array()
        .map_or(0, |depths| depths.iter().filter_map(serde_json::Value::as_u64).sum());
    assert_eq!(fine["leaves"], leaves);

    for split in ["sah", "middle", "median", "round-robin"] {
        let found = json(&["validate", "ball.off", "--json", "--split", split]);
        assert_eq!(found["valid"], true, "{split}");
    }
    let line = folder.kdray(&["validate", "ball.off"]).succeeds().stdout;
    assert!(line.starts_with("the tree is valid: "), "{line}");
}

#[test]
fn a_scene_can_come_from_standard_input() {
    let arguments = ["stats", "-", "--format", "off", "--json"];
    let ran = folder().kdray_reading(&arguments, OCTAHEDRON).succeeds();
    assert!(ran.stdout.contains("\"triangles\": 8"), "{}", ran.stdout);
}

#[test]
fn every_command_has_help_with_an_example() {
    let folder = Folder::new();
    let help = folder.kdray(&["--help"]).succeeds().stdout;
    for part in ["Exit codes:", "130", "Example:"] {
        assert!(help.contains(part), "{part}");
    }
    // The lines between two headings: a name each, and what it does.
    let list = help.split_once("Commands:\n").expect("a list of commands").1;
    let list = list.lines().take_while(|line| line.starts_with("  "));
    let commands: Vec<&str> = list.filter_map(|line| line.split_whitespace().next()).collect();
    for command in ["render", "compare", "trace", "draw", "query"] {
        assert!(commands.contains(&command), "{command} is not in {commands:?}");
    }
    for command in commands.into_iter().filter(|&command| command != "help") {
        let help = folder.kdray(&[command, "--help"]).succeeds().stdout;
        assert!(help.contains("Example:"), "{command}: {help}");
    }
}

#[test]
fn completions_and_manual_pages_are_made() {
    let folder = Folder::new();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = folder.kdray(&["completions", shell]).succeeds().stdout;
        assert!(script.contains("max-depth"), "{shell}");
    }
    let page = folder.kdray(&["man"]).succeeds().stdout;
    assert!(page.contains(".TH kdray 1"), "{page}");
    folder.kdray(&["man", "--out", "pages"]).succeeds();
    let page = fs::read_to_string(folder.path("pages/kdray-query.1")).expect("the page");
    assert!(page.contains("\\-\\-rays"), "{page}");
    assert!(folder.path("pages/kdray.1").is_file());
}

/// Runs the command, sends it `signals` once it says `sign`, and returns its exit code.
#[cfg(unix)]
fn signalled(folder: &Folder, mut command: Command, sign: &str, signals: &[&str]) -> Option<i32> {
    let said = fs::File::create(folder.path("said")).expect("a file");
    command.current_dir(folder.path("")).stdin(Stdio::null()).stdout(Stdio::null()).stderr(said);
    let mut child = command.spawn().expect("the command runs");
    wait_for(folder, sign);
    for signal in signals {
        send(&child, signal);
        sleep(Duration::from_millis(100));
    }
    let code = child.wait().expect("an end").code();
    fs::remove_file(folder.path("said")).expect("the file");
    code
}

/// The command, told to ignore a signal, as `nohup` tells it.
#[cfg(target_os = "linux")]
fn ignoring(signal: &str) -> Command {
    let mut command = Command::new("sh");
    let script = format!("trap '' {signal}; exec \"$0\" \"$@\"");
    command.arg("-c").arg(script).arg(binary());
    command
}

/// Sends a signal. Tests end commands by TERM: whoever runs them may have them ignore INT and HUP.
#[cfg(unix)]
fn send(child: &Child, signal: &str) {
    let id = child.id().to_string();
    // Fails if the process has ended already.
    Command::new("kill").args(["-s", signal, &id]).output().expect("kill runs");
}

/// Waits until the command has said `sign`.
#[cfg(unix)]
fn wait_for(folder: &Folder, sign: &str) {
    let start = Instant::now();
    while !fs::read_to_string(folder.path("said")).expect("text").contains(sign) {
        assert!(start.elapsed() < Duration::from_secs(60), "it does not say {sign}");
        sleep(Duration::from_millis(10));
    }
    sleep(Duration::from_millis(100));
}

#[test]
#[cfg(target_os = "linux")]
fn a_signal_that_was_ignored_stays_ignored() {
    use std::io::Write;

    let folder = folder();
    for name in ["INT", "HUP"] {
        let mut command = ignoring(name);
        command.current_dir(folder.path(""));
        command.args(["query", "ball.off", "--rays", "-", "--mode", "any", "--out", "-"]);
        let said = fs::File::create(folder.path("said")).expect("a file");
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(said);
        let mut child = command.spawn().expect("the command runs");
        let mut stdin = child.stdin.take().expect("a pipe");
        let mut ask = || stdin.write_all(b"0.1,0.2,5,0,0,-1\n");
        ask().expect("it reads");
        wait_for(&folder, "built a tree");
        send(&child, name);
        sleep(Duration::from_millis(100));
        ask().unwrap_or_else(|_| panic!("ended by {name}"));
        drop(stdin);
        let output = child.wait_with_output().expect("an end");
        assert_eq!(output.status.code(), Some(0), "{name}");
        assert_eq!(output.stdout, b"occluded\ntrue\ntrue\n");
    }
}

/// A render that takes long.
#[cfg(unix)]
const LONG: [&str; 6] = ["render", "ball.off", "--size", "960x960", "--samples", "1000"];

#[cfg(unix)]
fn assert_partly_rendered(folder: &Folder) {
    let picture = picture(&folder.path("kdray.png")).to_rgba8();
    assert!(picture.pixels().any(|pixel| pixel.0 == [0; 4]), "nothing is left undone");
    assert_eq!(folder.names(), ["ball.off", "kdray.png"]);
}

#[test]
#[cfg(unix)]
fn an_interrupted_render_writes_what_is_done() {
    let folder = folder();
    let mut command = Command::new(binary());
    command.args(LONG);
    assert_eq!(signalled(&folder, command, "built a tree", &["TERM"]), Some(INTERRUPTED));
    assert_partly_rendered(&folder);
}

#[test]
#[cfg(target_os = "linux")]
fn where_a_signal_is_ignored_the_others_are_not() {
    for ignored in ["HUP", "INT"] {
        let folder = folder();
        let mut command = ignoring(ignored);
        command.args(LONG);
        let signals = [ignored, ignored, "TERM"];
        let code = signalled(&folder, command, "built a tree", &signals);
        assert_eq!(code, Some(INTERRUPTED), "{ignored}");
        assert_partly_rendered(&folder);
    }
}

#[test]
#[cfg(unix)]
fn an_interrupted_query_leaves_nothing() {
    let folder = Folder::new();
    folder.file("ball.off", bumpy_ball(200, 200));
    folder.file("rays.csv", "0.1,0.2,5,0,0,-1\n".repeat(100_000));
    let mut command = Command::new(binary());
    command.args(["query", "ball.off", "--rays", "rays.csv", "--naive", "--out", "hits.csv"]);
    assert_eq!(signalled(&folder, command, "read 80000 triangles", &["TERM"]), Some(INTERRUPTED));
    assert_eq!(folder.names(), ["ball.off", "rays.csv"]);
}
