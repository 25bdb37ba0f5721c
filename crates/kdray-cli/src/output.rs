//! Output files, complete or not there at all; and standard output.

use crate::{error::CliError, interrupt};
use std::{
    fs::File,
    io::{self, Write},
    path::Path,
};

/// Writes bytes to standard output.
pub(crate) fn print(bytes: &[u8]) -> Result<(), CliError> {
    let mut stdout = io::stdout().lock();
    stdout.write_all(bytes).and_then(|()| stdout.flush()).map_err(CliError::Stdout)
}

/// Refuses to write over a file that is read.
pub(crate) fn check_is_no_input<'a>(
    out: &Path,
    inputs: impl IntoIterator<Item = &'a Path>,
) -> Result<(), CliError> {
    // A terminal may well be both.
    let file = |path: &Path| path.canonicalize().ok().filter(|path| path.is_file());
    let is_input =
        file(out).is_some_and(|out| inputs.into_iter().any(|it| file(it) == Some(out.clone())));
    if is_input {
        let out = out.display();
        return Err(CliError::Usage(format!(
            "--out {out}: this file is read by the same command; give another name"
        )));
    }
    Ok(())
}

/// A file to be, of which Ctrl-C leaves nothing.
pub(crate) struct Output(kdray_file::Output);

impl Output {
    /// Makes sure that `path` can be written, before the work whose result it is to hold.
    pub(crate) fn create(path: &Path) -> Result<Self, CliError> {
        let output = kdray_file::Output::create(path);
        let output = output.map_err(|error| CliError::output(path, error))?;
        if let Some(path) = output.temporary_path() {
            interrupt::remove_at_exit(path.to_owned());
        }
        Ok(Self(output))
    }

    /// Writes a whole file.
    pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
        let mut output = Self::create(path)?;
        output.file().write_all(bytes).map_err(|error| CliError::output(path, error))?;
        output.commit()
    }

    /// The path that the file will have.
    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }

    /// Where to write.
    pub(crate) fn file(&mut self) -> &mut File {
        self.0.file()
    }

    /// An unnamed file in the same folder, for parts of the result; gone when closed.
    pub(crate) fn scratch(&self) -> io::Result<File> {
        self.0.scratch()
    }

    /// Gives the file its name.
    pub(crate) fn commit(self) -> Result<(), CliError> {
        let path = self.path().to_owned();
        self.0.commit().map_err(|error| CliError::output(&path, error))
    }
}
