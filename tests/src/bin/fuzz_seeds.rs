//! Writes the inputs that fuzzing begins with, and tells the targets: `fuzz_seeds FOLDER`. Called by
//! `cargo xtask fuzz`.
//!
//! Prints a line a target: its name, and how many bytes its inputs have at most.

#![forbid(unsafe_code)]

use kdray_tests::fuzz::TARGETS;
use std::path::PathBuf;
use std::{fs, io, process::ExitCode};

#[expect(clippy::print_stdout, clippy::print_stderr, reason = "that is what it is for")]
fn main() -> ExitCode {
    let Some(folder) = std::env::args_os().nth(1).map(PathBuf::from) else {
        eprintln!("fuzz_seeds: name the folder to write to");
        return ExitCode::FAILURE;
    };
    for target in TARGETS {
        if let Err(error) = write(&folder.join(target.name), &(target.seeds)()) {
            eprintln!("fuzz_seeds: {}: {error}", folder.display());
            return ExitCode::FAILURE;
        }
        println!("{} {}", target.name, target.max_len);
    }
    ExitCode::SUCCESS
}

fn write(folder: &std::path::Path, seeds: &[Vec<u8>]) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    for (index, seed) in seeds.iter().enumerate() {
        fs::write(folder.join(format!("seed-{index}")), seed)?;
    }
    Ok(())
}
