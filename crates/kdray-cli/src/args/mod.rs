//! Arguments that several commands share.

mod build_args;
mod memory;
mod scene_args;
mod tree_file_args;
mod values;
mod view_args;

pub(crate) use build_args::{BuildArgs, FastBuildArgs, LimitArgs};
pub(crate) use memory::MemoryLimit;
pub(crate) use scene_args::{SceneArgs, SceneFormat};
pub(crate) use tree_file_args::TreeFileArgs;
pub(crate) use values::{
    Size, bits, bytes, color, crop, field_of_view, numbers, positive, positive_f32, sample_range,
};
pub(crate) use view_args::ViewArgs;

/// How a table is printed.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct TableArgs {
    /// Print JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,
}
