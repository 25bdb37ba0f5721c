//! Hits out, to npz or CSV, in arrays that are named as Open3D names them.

mod array;
mod csv;
mod npz;

use super::{Answer, Mode, Precision};
use crate::{error::CliError, output::Output};
use std::{
    io,
    path::Path,
};

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
pub(crate) struct HitWriter {
    encoder: Encoder,
    /// None for standard output.
    output: Option<Output>,
}

enum Encoder {
    Npz(npz::NpzHits),
    Csv(csv::CsvHits),
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
            let csv = csv::CsvHits::new(io::stdout(), mode, precision).map_err(CliError::Stdout)?;
            return Ok(Self { encoder: Encoder::Csv(csv), output: None });
        }
        let mut output = Output::create(path)?;
        let encoder = match format {
            HitsFormat::Npz => npz::NpzHits::new(&output, mode, precision).map(Encoder::Npz),
            HitsFormat::Csv => output
                .file()
                .try_clone()
                .and_then(|file| csv::CsvHits::new(file, mode, precision))
                .map(Encoder::Csv),
        };
        let encoder = encoder.map_err(|error| CliError::output(path, error))?;
        Ok(Self { encoder, output: Some(output) })
    }

    /// Appends the answer of the ray with this number.
    pub(crate) fn write(&mut self, ray: u64, answer: &Answer) -> Result<(), CliError> {
        let written = match &mut self.encoder {
            Encoder::Npz(npz) => npz.write(ray, answer),
            Encoder::Csv(csv) => csv.write(ray, answer),
        };
        written.map_err(|error| self.error(error))
    }

    /// Completes the output.
    pub(crate) fn finish(self) -> Result<(), CliError> {
        match (self.encoder, self.output) {
            (Encoder::Npz(npz), Some(mut output)) => {
                let gathered = npz.finish(output.file());
                gathered.map_err(|error| CliError::output(output.path(), error))?;
                output.commit()
            }
            (Encoder::Csv(mut csv), Some(output)) => {
                csv.flush().map_err(|error| CliError::output(output.path(), error))?;
                output.commit()
            }
            (Encoder::Csv(mut csv), None) => csv.flush().map_err(CliError::Stdout),
            (Encoder::Npz(_), None) => Ok(()),
        }
    }

    fn error(&self, error: io::Error) -> CliError {
        match &self.output {
            Some(output) => CliError::output(output.path(), error),
            None => CliError::Stdout(error),
        }
    }
}
