//! What can go wrong, and the exit code that says so.

use crate::interrupt;
use kdray::{BuildError, FileError, MeshError, tree::TreeError};
use kdray_file::TreeFileError;
use kdray_render::{RenderError, WorldError, WriteError};
use kdray_scene::LoadError;
use std::{
    error::Error,
    io::{self, Write},
    path::{Path, PathBuf},
    process::ExitCode,
};

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CliError {
    /// A tree that is not what it must be.
    #[error("the tree is broken: {0}")]
    Tree(#[from] TreeError),
    /// A tree file whose header and structure are right, and whose content is not.
    #[error("{}: {reason}", path.display())]
    BrokenFile {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: FileError,
    },
    /// A tree file that could not be read, or was refused.
    #[error("{0}{advice}", advice = file_advice(.0))]
    TreeFile(#[from] TreeFileError),
    /// Two ways to answer a ray gave different answers.
    #[error("{0}; this is a fault of kdray, please report it with the scene")]
    Disagreement(String),
    /// Arguments that do not go together, or name what is not there.
    #[error("{0}")]
    Usage(String),
    /// An input that could not be read, or was refused.
    #[error("{}: {reason}", path.display())]
    Input {
        /// The file, `-` for standard input.
        path: PathBuf,
        /// What is wrong with it, and where.
        reason: String,
    },
    /// Parts of a picture that do not go together.
    #[error("{0}")]
    Merge(String),
    /// A scene that could not be read, or was refused.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// A scene that contradicts itself.
    #[error(transparent)]
    World(WorldError),
    /// A camera, light or option that nothing can be rendered with.
    #[error("{0}{advice}", advice = render_advice(.0))]
    Render(#[from] RenderError),
    /// Triangles that no tree can be built over.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The build of the tree failed or was stopped.
    #[error("{0}{advice}", advice = advice(.0))]
    Build(#[from] BuildError),
    /// An output file that could not be written.
    #[error("{}: cannot be written: {source}", path.display())]
    Output {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Standard output could not be written.
    #[error("standard output: {0}")]
    Stdout(#[source] io::Error),
    /// Ctrl-C.
    #[error("interrupted")]
    Interrupted,
}

impl CliError {
    /// An input that could not be read, or was refused.
    pub(crate) fn input(path: &Path, reason: impl ToString) -> Self {
        Self::Input { path: path.to_owned(), reason: reason.to_string() }
    }

    /// An output file that could not be written.
    pub(crate) fn output(path: &Path, source: io::Error) -> Self {
        Self::Output { path: path.to_owned(), source }
    }

    /// A picture that could not be written to `path`.
    pub(crate) fn picture(path: &Path, error: WriteError) -> Self {
        let source = match error {
            WriteError::Io(source) => source,
            error => {
                let cause = error.source().map_or(String::new(), |cause| format!(": {cause}"));
                io::Error::other(format!("{error}{cause}"))
            }
        };
        Self::output(path, source)
    }

    /// The exit code, as `kdray --help` lists them.
    fn exit_code(&self) -> u8 {
        match self {
            Self::Stdout(error) if error.kind() == io::ErrorKind::BrokenPipe => 0,
            Self::Tree(_) | Self::BrokenFile { .. } | Self::Disagreement(_) => 1,
            Self::Usage(_) | Self::Render(_) => 2,
            Self::Interrupted | Self::Build(BuildError::Cancelled) => interrupt::EXIT_CODE,
            Self::Merge(_) | Self::Input { .. } | Self::Load(_) | Self::TreeFile(_) => 3,
            Self::World(_) | Self::Mesh(_) | Self::Build(_) => 3,
            Self::Output { .. } | Self::Stdout(_) => 4,
        }
    }

    /// Says on standard error what went wrong. Who reads standard output may stop reading, as
    /// `head` does; that is no error.
    pub(crate) fn report(&self) -> ExitCode {
        let code = self.exit_code();
        if code != 0 {
            // Nothing can be done if standard error is closed too.
            let _ = writeln!(io::stderr().lock(), "error: {self}");
        }
        ExitCode::from(code)
    }
}

/// What the library cannot say: by which option.
fn advice(error: &BuildError) -> &'static str {
    if matches!(error, BuildError::Memory { .. }) { " with --memory-limit" } else { "" }
}

/// The same for a picture.
fn render_advice(error: &RenderError) -> &'static str {
    if matches!(error, RenderError::TooLarge { .. }) {
        " (options --size and --layers)"
    } else {
        ""
    }
}

/// The same for a tree file.
fn file_advice(error: &TreeFileError) -> &'static str {
    match error {
        TreeFileError::Memory { .. } => " (options --trusted and --memory-limit)",
        TreeFileError::File { source: FileError::Precision { .. }, .. } => {
            " (the command takes f32 only; those of f64 are for Rust and Python)"
        }
        _ => "",
    }
}

impl From<WorldError> for CliError {
    fn from(error: WorldError) -> Self {
        match error {
            WorldError::Mesh(error) => Self::Mesh(error),
            WorldError::Build(error) => Self::Build(error),
            error => Self::World(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exit_codes_are_those_of_the_help() {
        let code = |error: CliError| error.exit_code();
        let system = |kind: io::ErrorKind| io::Error::from(kind);
        assert_eq!(code(TreeError::NoRoot.into()), 1);
        assert_eq!(code(CliError::Usage(String::new())), 2);
        assert_eq!(code(MeshError::TooManyTriangles(0).into()), 3);
        assert_eq!(code(CliError::Stdout(system(io::ErrorKind::StorageFull))), 4);
        assert_eq!(code(CliError::Stdout(system(io::ErrorKind::BrokenPipe))), 0);
        let too_large = WriteError::Size { width: 1, height: 1 << 32, limit: 9 };
        assert_eq!(code(CliError::picture(Path::new("large.png"), too_large)), 4);
        assert_eq!(code(WorldError::Build(BuildError::Cancelled).into()), 130);
    }
}
