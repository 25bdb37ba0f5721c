//! What the figures were taken with.

use serde::Serialize;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The lock file as it was compiled in.
const LOCK: &str = include_str!("../../Cargo.lock");

/// Crates whose versions matter.
const CRATES: [&str; 5] = ["bvh", "kdray", "kdtree-ray", "obvhs", "parry3d"];

/// Machine, date and versions.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Machine {
    pub(crate) cpu: String,
    pub(crate) processors: usize,
    pub(crate) system: String,
    pub(crate) date: String,
    /// The state of kdray; `+` if files were changed since.
    pub(crate) commit: String,
    pub(crate) rustc: String,
    pub(crate) versions: BTreeMap<String, String>,
}

impl Machine {
    /// This one, now, with Embree in that version.
    pub(crate) fn here(embree: Option<String>) -> Self {
        let crates = CRATES.map(|name| (name.to_owned(), version_of(name)));
        let embree = embree.map(|version| ("embree".to_owned(), version));
        Self {
            cpu: cpu().unwrap_or_else(|| "unknown processor".to_owned()),
            processors: std::thread::available_parallelism().map_or(1, usize::from),
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            date: time::OffsetDateTime::now_utc().date().to_string(),
            commit: commit().unwrap_or_else(|| "unknown".to_owned()),
            rustc: output("rustc", &["--version"]).unwrap_or_else(|| "unknown".to_owned()),
            versions: crates.into_iter().chain(embree).collect(),
        }
    }

    /// In two lines.
    pub(crate) fn text(&self) -> String {
        let versions: Vec<String> =
            self.versions.iter().map(|(name, version)| format!("{name} {version}")).collect();
        format!(
            "{}, {} processors, {}; {}\n{}; commit {}; {}",
            self.cpu,
            self.processors,
            self.system,
            self.date,
            versions.join(", "),
            self.commit,
            self.rustc
        )
    }
}

/// The folder for what is fetched and made: `bench` in cargo's target folder.
pub(crate) fn work_folder() -> PathBuf {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    target.unwrap_or_else(|| root().join("target")).join("bench")
}

/// The folder that records are kept in.
pub(crate) fn records_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("records")
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The processor's name.
fn cpu() -> Option<String> {
    let linux = fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|line| line.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    });
    linux.or_else(|| output("sysctl", &["-n", "machdep.cpu.brand_string"]))
}

fn commit() -> Option<String> {
    let root = root();
    let git = |arguments: &[&str]| {
        let all = [&["-C", root.to_str()?], arguments].concat();
        output("git", &all)
    };
    let head = git(&["rev-parse", "--short", "HEAD"])?;
    let changed = git(&["status", "--porcelain", "--untracked-files=no"]).is_some();
    Some(if changed { head + "+" } else { head })
}

/// What a program prints; `None` if it fails or prints nothing.
fn output(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    (output.status.success() && !text.is_empty()).then_some(text)
}

/// The version of a crate in the lock file.
fn version_of(name: &str) -> String {
    let entry = LOCK.split("[[package]]").find(|entry| {
        entry.lines().any(|line| line.strip_prefix("name = ") == Some(&format!("\"{name}\"")))
    });
    let line = entry.and_then(|entry| entry.lines().find_map(|it| it.strip_prefix("version = ")));
    line.map_or("unknown".to_owned(), |version| version.trim_matches('"').to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_versions_are_known() {
        let machine = Machine::here(Some("4.4.0".to_owned()));
        for (name, version) in &machine.versions {
            assert!(version.starts_with(|c: char| c.is_ascii_digit()), "{name} {version}");
        }
        assert_eq!(machine.date.len(), "2026-11-22".len());
        assert!(machine.text().contains("obvhs"));
    }
}
