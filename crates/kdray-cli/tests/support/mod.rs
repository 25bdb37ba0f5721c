//! What the tests of the command share: running it, and files for it to read.
#![allow(dead_code, reason = "no test file uses all of it")]

pub(crate) mod hits;
pub(crate) mod rays;
pub(crate) mod seen;

use assert_cmd::Command;
use std::{
    fs,
    path::{Path, PathBuf},
};
use tempfile::TempDir;

/// The exit codes that `kdray --help` lists.
pub(crate) const USAGE: i32 = 2;
pub(crate) const INPUT: i32 = 3;
pub(crate) const OUTPUT: i32 = 4;
pub(crate) const INTERRUPTED: i32 = 130;

/// A folder of its own for a test, gone at its end.
pub(crate) struct Folder(TempDir);

/// How a run of the command ended.
pub(crate) struct Ran {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Folder {
    pub(crate) fn new() -> Self {
        Self(TempDir::new().expect("a temporary folder"))
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file.
    pub(crate) fn file(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, bytes).expect("a file in a temporary folder");
        path
    }

    /// The names of all files here, in order.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("a temporary folder");
        let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
        let mut names: Vec<String> = entries.map(|entry| name(entry.expect("a file"))).collect();
        names.sort();
        names
    }

    /// Runs `kdray` with this folder as the current one.
    pub(crate) fn kdray(&self, arguments: &[&str]) -> Ran {
        self.kdray_reading(arguments, Vec::new())
    }

    /// The same with this on standard input.
    pub(crate) fn kdray_reading(&self, arguments: &[&str], stdin: impl Into<Vec<u8>>) -> Ran {
        let mut command = Command::new(binary());
        let output = command.current_dir(self.0.path()).args(arguments).write_stdin(stdin.into());
        let output = output.output().expect("the command runs");
        Ran {
            code: output.status.code(),
            stdout: String::from_utf8(output.stdout).expect("text"),
            stderr: String::from_utf8(output.stderr).expect("text"),
        }
    }
}

impl Ran {
    /// Panics unless the command succeeded.
    pub(crate) fn succeeds(self) -> Self {
        assert_eq!(self.code, Some(0), "{}", self.stderr);
        self
    }

    /// Panics unless the command failed with `code` and a message that has all `parts`.
    pub(crate) fn fails(self, code: i32, parts: &[&str]) -> Self {
        assert_eq!(self.code, Some(code), "{}", self.stderr);
        for part in parts {
            assert!(self.stderr.contains(part), "no `{part}` in: {}", self.stderr);
        }
        assert!(!self.stderr.contains("panicked"), "{}", self.stderr);
        self
    }
}

/// The command that is tested.
pub(crate) fn binary() -> &'static Path {
    Path::new(env!("CARGO_BIN_EXE_kdray"))
}

/// The octahedron with vertices at distance 1 on the axes, as OFF: closed, eight triangles.
pub(crate) const OCTAHEDRON: &str = "\
OFF
6 8 0
1 0 0
-1 0 0
0 1 0
0 -1 0
0 0 1
0 0 -1
3 0 2 4
3 2 1 4
3 1 3 4
3 3 0 4
3 2 0 5
3 1 2 5
3 3 1 5
3 0 3 5
";

/// A bumpy ball of `2 · rings · segments` triangles as OFF.
pub(crate) fn bumpy_ball(rings: usize, segments: usize) -> String {
    let mut vertices = String::new();
    for ring in 0..=rings {
        for segment in 0..segments {
            let polar = std::f64::consts::PI * ring as f64 / rings as f64;
            let around = std::f64::consts::TAU * segment as f64 / segments as f64;
            let radius = 1.0 + 0.1 * (5.0 * polar).sin() * (7.0 * around).cos();
            let (x, z) = (polar.sin() * around.cos(), polar.sin() * around.sin());
            vertices += &format!("{} {} {}\n", radius * x, radius * polar.cos(), radius * z);
        }
    }
    let mut faces = String::new();
    for ring in 0..rings {
        for segment in 0..segments {
            let next = (segment + 1) % segments;
            let (upper, lower) = (ring * segments, (ring + 1) * segments);
            faces += &format!("3 {} {} {}\n", upper + segment, upper + next, lower + segment);
            faces += &format!("3 {} {} {}\n", upper + next, lower + next, lower + segment);
        }
    }
    let counts = format!("{} {} 0", (rings + 1) * segments, 2 * rings * segments);
    format!("OFF\n{counts}\n{vertices}{faces}")
}
