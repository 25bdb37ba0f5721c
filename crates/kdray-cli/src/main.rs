//! The command `kdray`: render, measure, draw and query kd-trees over meshes.

#![forbid(unsafe_code)]

mod args;
mod backdrop;
mod build;
mod cli;
mod commands;
mod error;
mod interrupt;
mod load;
mod output;
mod picture_file;
mod pictures;
mod progress;
mod query;
mod table;
mod tree_file;
mod wording;

use std::process::ExitCode;

fn main() -> ExitCode {
    match cli::run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => error.report(),
    }
}
