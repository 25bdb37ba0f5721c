//! The architecture holds: crates and modules depend on each other in one direction.

use cargo_metadata::{DependencyKind, Metadata, MetadataCommand, Package};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The modules of `kdray` in the order of the pipeline; each may use those before it. `build`
/// makes trees, so it comes behind `tree`, though a build comes before its tree in time.
const MODULES: [&str; 11] = [
    "memory",
    "geometry",
    "exact",
    "primitives",
    "tree",
    "build",
    "simd",
    "layout",
    "traverse",
    "query",
    "file",
];

/// What the library `kdray` may need: containers, casts, vectors, threads, error messages, checksums,
/// arrays that somebody else owns. Nothing that reads, writes or prints.
const LIBRARY_MAY_USE: [&str; 8] =
    ["arrayvec", "bytemuck", "fearless_simd", "glam", "rayon", "thiserror", "twox-hash", "yoke"];

fn metadata() -> Metadata {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.toml");
    MetadataCommand::new().manifest_path(manifest).no_deps().exec().expect("cargo metadata runs")
}

/// The names of the packages that `package` depends on, other than for its own tests.
fn needs(package: &Package) -> BTreeSet<String> {
    let dependencies = package.dependencies.iter();
    let used = dependencies.filter(|dependency| dependency.kind != DependencyKind::Development);
    used.map(|dependency| dependency.name.clone()).collect()
}

#[test]
fn crates_depend_downwards_only() {
    let metadata = metadata();
    let ours: BTreeSet<String> = metadata.packages.iter().map(|p| p.name.to_string()).collect();
    for package in &metadata.packages {
        let allowed: &[&str] = match package.name.as_str() {
            "kdray" | "kdray-map" | "kdray-scene" | "xtask" => &[],
            "kdray-file" => &["kdray", "kdray-map"],
            "kdray-render" => &["kdray", "kdray-scene"],
            "kdray-cli" => &["kdray", "kdray-file", "kdray-scene", "kdray-render"],
            "kdray-python" => &["kdray", "kdray-file", "kdray-scene", "kdray-render"],
            "kdray-bench" => &["kdray", "kdray-scene", "kdray-render"],
            "kdray-tests" => &["kdray", "kdray-file", "kdray-scene"],
            other => panic!("say in this test what {other} may depend on"),
        };
        for name in needs(package).intersection(&ours) {
            let (from, may) = (&package.name, allowed.contains(&name.as_str()));
            assert!(may, "{from} depends on {name}, against the directions of ARCHITECTURE.md");
        }
    }
}

#[test]
fn nothing_depends_on_the_command_the_tests_or_the_chores() {
    for package in &metadata().packages {
        for dependency in &package.dependencies {
            let leaves = ["kdray-bench", "kdray-cli", "kdray-python", "kdray-tests", "xtask"];
            let leaf = leaves.contains(&dependency.name.as_str());
            assert!(!leaf, "{} depends on {}", package.name, dependency.name);
        }
    }
}

#[test]
fn the_library_needs_nothing_that_reads_writes_or_prints() {
    let metadata = metadata();
    let library = metadata.packages.iter().find(|p| p.name.as_str() == "kdray");
    for name in needs(library.expect("the library is there")) {
        let may = LIBRARY_MAY_USE.contains(&name.as_str());
        assert!(may, "kdray depends on {name}, which is not in the list of this test");
    }
    for (file, line, text) in library_lines() {
        let banned = ["std::fs", "std::io", "std::net", "std::process", "std::env", "std::time"];
        for module in banned {
            assert!(!text.contains(module), "{}:{line} uses {module}", file.display());
        }
    }
}

#[test]
fn modules_of_the_library_use_only_those_before_them() {
    let homes = homes();
    let mut edges = BTreeSet::new();
    for (file, line, text) in library_lines() {
        let Some(from) = module_of(&file) else { continue };
        for to in modules_used(&text, &homes) {
            let may = position(to) <= position(&from);
            assert!(may, "{}:{line}: {from} uses {to}, which comes later", file.display());
            edges.insert((from.clone(), to));
        }
    }
    assert!(edges.contains(&("query".to_owned(), "traverse")), "no edges were found at all");
}

/// Where the names at the root of the crate come from, as lib.rs tells, and the modules themselves.
fn homes() -> BTreeMap<String, &'static str> {
    let mut homes = BTreeMap::from(MODULES.map(|module| (module.to_owned(), module)));
    for (file, _, text) in library_lines() {
        let Some((module, names)) = text.strip_prefix("pub use ").and_then(|u| u.split_once("::"))
        else {
            continue;
        };
        if file != Path::new("lib.rs") {
            continue;
        }
        let module = MODULES[position(module)];
        let names = names.trim_matches(['{', '}', ';']).split(',').map(str::trim);
        homes.extend(names.map(|name| (name.to_owned(), module)));
    }
    homes
}

/// The modules that a line names by a path from the root of the crate.
fn modules_used(line: &str, homes: &BTreeMap<String, &'static str>) -> Vec<&'static str> {
    let code = line.trim_start();
    if code.starts_with("//") {
        return Vec::new();
    }
    let paths = code.split("crate::").skip(1);
    let names = paths.flat_map(|path| match path.strip_prefix('{') {
        Some(list) => list.split(',').map(first_name).collect(),
        None => vec![first_name(path)],
    });
    names.filter_map(|name| homes.get(name).copied()).collect()
}

/// The identifier that `path` begins with.
fn first_name(path: &str) -> &str {
    let path = path.trim_start();
    let end = path.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(path.len());
    &path[..end]
}

fn position(module: &str) -> usize {
    MODULES.iter().position(|m| *m == module).expect("a module of the list")
}

/// The top module that a source file belongs to; none for lib.rs.
fn module_of(file: &Path) -> Option<String> {
    let first = file.components().next()?.as_os_str().to_str()?;
    MODULES.contains(&first).then(|| first.to_owned())
}

/// Every logical line of the library outside of its tests: the file, relative to `src`, the
/// number of the line, and the text. A `use` in several lines is joined to one.
fn library_lines() -> Vec<(PathBuf, usize, String)> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/kdray/src");
    let mut lines = Vec::new();
    for file in rust_files(&source) {
        let text = fs::read_to_string(&file).expect("source files are readable");
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let name = file.strip_prefix(&source).expect("it was found there").to_owned();
        let mut open = String::new();
        for (index, line) in code.lines().enumerate() {
            open.push_str(line);
            let inside_use = open.trim_start().starts_with("use ") && !open.contains(';');
            if !inside_use {
                lines.push((name.clone(), index + 1, std::mem::take(&mut open)));
            }
        }
    }
    lines
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder of the library's source is there");
    let mut files = Vec::new();
    for entry in entries {
        let path = entry.expect("its entries are readable").path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// Only the bench calls a C library, and only `kdray-map` maps files. The workspace denies `unsafe` to
/// everyone, and what all others compile to forbids it, so that no permission can be given below.
#[test]
fn unsafe_code_is_forbidden_to_all_but_the_bench_and_the_map() {
    let metadata = metadata();
    let permitted = ["kdray-bench", "kdray-map"];
    let others = metadata.packages.iter().filter(|p| !permitted.contains(&p.name.as_str()));
    let roots = others
        .flat_map(|package| &package.targets)
        .filter(|it| it.is_lib() || it.is_cdylib() || it.is_bin());
    let mut seen = 0;
    for root in roots {
        let text = fs::read_to_string(&root.src_path).expect("source files are readable");
        let forbids = text.lines().any(|line| line == "#![forbid(unsafe_code)]");
        assert!(forbids, "{} does not say #![forbid(unsafe_code)]", root.src_path);
        seen += 1;
    }
    assert!(seen >= 10, "only {seen} crates were found");
}

#[test]
fn only_two_places_permit_unsafe_code() {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut permits = BTreeSet::new();
    for folder in ["bench", "crates", "tests", "xtask"] {
        for file in rust_files(&workspace.join(folder)) {
            let text = fs::read_to_string(&file).expect("source files are readable");
            let attributes = text.lines().filter(|line| line.trim_start().starts_with('#'));
            let permit =
                |line: &str| ["allow(", "expect(", "warn("].iter().any(|it| line.contains(it));
            if attributes.into_iter().any(|line| line.contains("unsafe_code") && permit(line)) {
                let name = file.strip_prefix(&workspace).expect("it was found there");
                permits.insert(name.to_owned());
            }
        }
    }
    let expected = ["bench/src/embree/mod.rs", "crates/kdray-map/src/lib.rs"];
    assert_eq!(permits, BTreeSet::from(expected.map(PathBuf::from)));
}

#[test]
fn what_ships_has_one_unsafe_block() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    let mut blocks = 0;
    for file in rust_files(&crates) {
        let text = fs::read_to_string(&file).expect("source files are readable");
        let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        blocks += code.map(|line| line.matches("unsafe {").count()).sum::<usize>();
    }
    assert_eq!(blocks, 1, "that of kdray-map");
}

#[test]
fn the_reader_of_uses_reads_all_forms() {
    let homes = homes();
    assert_eq!(homes.get("Scene"), Some(&"query"), "lib.rs was read");
    let used = |line| modules_used(line, &homes);
    assert_eq!(used("use crate::geometry::{Ray, t_above};"), ["geometry"]);
    assert_eq!(used("use crate::{Aabb, tree::{KdTree, Node}};"), ["geometry", "tree"]);
    assert_eq!(used("let x = crate::exact::sign(crate::build::a());"), ["exact", "build"]);
    assert_eq!(used("/// See [`crate::exact`]."), [""; 0]);
}
