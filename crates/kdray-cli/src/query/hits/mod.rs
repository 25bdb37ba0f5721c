//! Hits, and answers about points, out to npz or CSV, in arrays that are named as Open3D names them.

mod array;
mod csv;
mod npz;

use self::{csv::CsvHits, npz::NpzHits};
use super::{Answer, Mode, Precision};
use crate::{error::CliError, output::Output};
use std::{io, path::Path};

/// What a miss has for ids.
const MISS_ID: u32 = u32::MAX;

/// The formats of hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HitsFormat {
    /// A zip archive of numpy arrays.
    Npz,
    /// Lines of numbers with commas.
    Csv,
}

/// Writes answers as they come. Nothing is at the path before [`finish`](Self::finish).
pub(crate) enum HitWriter {
    Npz(Box<NpzHits>, Output),
    Csv(CsvHits, Output),
    Stdout(CsvHits),
}

impl HitsFormat {
    /// The format that a path's ending names; standard output, `-`, takes CSV.
    pub(crate) fn of(path: &Path) -> Result<Self, CliError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        match ending.as_str() {
            "npz" => Ok(Self::Npz),
            "csv" => Ok(Self::Csv),
            _ if path == Path::new("-") => Ok(Self::Csv),
            _ => Err(CliError::Usage(format!(
                "--out {}: give a name that ends in .npz or .csv, or `-` for CSV on standard output",
                path.display()
            ))),
        }
    }
}

impl HitWriter {
    /// Makes sure that `path` can be written, and begins.
    pub(crate) fn create(path: &Path, mode: Mode, precision: Precision) -> Result<Self, CliError> {
        let format = HitsFormat::of(path)?;
        if path == Path::new("-") {
            let csv = CsvHits::new(io::stdout(), mode, precision).map_err(CliError::Stdout)?;
            return Ok(Self::Stdout(csv));
        }
        let mut output = Output::create(path)?;
        let begun = match format {
            HitsFormat::Npz => {
                NpzHits::new(&output, mode, precision).map(|npz| Self::Npz(Box::new(npz), output))
            }
            HitsFormat::Csv => {
                let file = output.file().try_clone();
                let csv = file.and_then(|file| CsvHits::new(file, mode, precision));
                csv.map(|csv| Self::Csv(csv, output))
            }
        };
        begun.map_err(|error| CliError::output(path, error))
    }

    /// Appends the answer of the ray or point with this number.
    pub(crate) fn write(&mut self, ray: u64, answer: &Answer) -> Result<(), CliError> {
        match self {
            Self::Npz(npz, output) => {
                npz.write(ray, answer).map_err(|error| CliError::output(output.path(), error))
            }
            Self::Csv(csv, output) => {
                csv.write(ray, answer).map_err(|error| CliError::output(output.path(), error))
            }
            Self::Stdout(csv) => csv.write(ray, answer).map_err(CliError::Stdout),
        }
    }

    /// Completes the output.
    pub(crate) fn finish(self) -> Result<(), CliError> {
        let (written, output) = match self {
            Self::Npz(npz, mut output) => (npz.finish(&mut output), output),
            Self::Csv(mut csv, output) => (csv.flush(), output),
            Self::Stdout(mut csv) => return csv.flush().map_err(CliError::Stdout),
        };
        written.map_err(|error| CliError::output(output.path(), error))?;
        output.commit()
    }
}
