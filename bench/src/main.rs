//! kdray beside Embree 4, obvhs, bvh, parry3d and kdtree-ray, on the same rays in the same run.
//!
//! The way of a run: scenes are loaded or made ([`scene`], [`synthetic`]), rays are made once and
//! kept in files ([`rays`]), every contender builds its structure ([`contenders`]), the contenders
//! take turns at tracing ([`measure`]) and their answers are held against an exact reference
//! ([`mod@reference`]); then all is told as a table, JSON and a plot ([`report`]).

mod args;
mod compare;
mod contender;
mod contenders;
mod embree;
mod error;
mod machine;
mod measure;
mod memory;
mod packets;
mod peers;
mod rays;
mod reference;
mod report;
mod scaling;
mod scene;
mod synthetic;
mod workers;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = args::Arguments::parse();
    let outcome = match &arguments.task {
        Some(args::Task::Scaling(options)) => scaling::run(options),
        Some(args::Task::Peers(options)) => peers::run(options),
        None => compare::run(&arguments.compare),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            report::say(&format!("bench: {error}"));
            ExitCode::FAILURE
        }
    }
}
