//! What is done with a tree file.

/// What is done with a tree file in the place of a scene.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct TreeFileArgs {
    /// Map a tree file into memory as it is, which takes milliseconds. Without it all of it is read and
    /// verified, which takes about as long as a build; then the answers are right whoever made the file
    #[arg(long)]
    pub(crate) trusted: bool,
}
