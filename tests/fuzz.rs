//! What fuzzing found worth keeping is run on every test, and so are the inputs that it begins with.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use kdray_tests::fuzz::TARGETS;
use kdray_tests::fuzz::tree_file::wide_nodes;
use std::fs;
use std::path::{Path, PathBuf};

/// The corpus of a target in the repository.
fn corpus(name: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus").join(name);
    let entries = fs::read_dir(&folder).unwrap_or_else(|error| {
        panic!("{}: {error}; make it by `cargo xtask fuzz --keep`", folder.display())
    });
    let mut files: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

#[test]
fn corpora_do_no_harm() {
    for target in TARGETS {
        let files = corpus(target.name);
        assert!(!files.is_empty(), "there is nothing in the corpus of {}", target.name);
        for file in files {
            let data = fs::read(&file).unwrap();
            let outcome = std::panic::catch_unwind(|| (target.body)(&data));
            assert!(outcome.is_ok(), "{} fails at {}", target.name, file.display());
        }
    }
}

/// A whole file in f64 is kept, and one whose wide tree has more than one node: links between nodes, and homes that are
/// not the root's, are in no other. Should `--keep` leave none, there are seeds of both kinds.
#[test]
fn whole_files_of_f64_and_of_inner_nodes_are_kept() {
    let files: Vec<_> = corpus("tree_file").iter().map(|file| fs::read(file).unwrap()).collect();
    let single = files.iter().filter_map(|file| wide_nodes::<f32>(file)).max();
    let double = files.iter().filter_map(|file| wide_nodes::<f64>(file)).max();
    assert!(double.is_some(), "none is in f64");
    assert!(single.max(double) >= Some(2), "{single:?} and {double:?} nodes");
}

/// How many bytes are tried, as the target's options say.
fn max_len(name: &str) -> usize {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/options");
    let text = fs::read_to_string(folder.join(name).with_extension("options")).unwrap();
    let value = text.lines().find_map(|line| line.strip_prefix("max_len = "));
    value.unwrap().parse().unwrap()
}

#[test]
fn seeds_do_no_harm() {
    for target in TARGETS {
        let seeds = (target.seeds)();
        assert!(!seeds.is_empty(), "{} begins with nothing", target.name);
        for seed in seeds {
            let most = max_len(target.name);
            assert!(seed.len() <= most, "{}: {} bytes", target.name, seed.len());
            (target.body)(&seed);
        }
    }
}

/// Each target has a program, and each program a target.
#[test]
fn programs_are_those_of_the_targets() {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/Cargo.toml");
    let text = fs::read_to_string(manifest).unwrap();
    let paths = text.lines().filter_map(|line| line.strip_prefix("path = \"fuzz_targets/"));
    let mut programs: Vec<_> = paths.filter_map(|path| path.strip_suffix(".rs\"")).collect();
    let mut targets = TARGETS.map(|target| target.name);
    programs.sort_unstable();
    targets.sort_unstable();
    assert_eq!(programs, targets);
}
