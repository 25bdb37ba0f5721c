//! Rays in, from npy or CSV.

mod csv;
mod npy;
mod npy_header;

use self::{csv::CsvRays, npy::NpyRays};
use super::{Precision, RaysError};
use kdray::Ray;
use std::{
    fs::File,
    io::{self, BufRead, BufReader, Cursor, Read},
    path::Path,
};

/// Reads rays a chunk at a time.
pub(crate) enum RayReader {
    Npy(NpyRays),
    Csv(CsvRays),
}

/// Where rays come from: a file, in which one can jump, or a stream.
pub(in crate::query) enum Source {
    File(BufReader<File>),
    Stream(Box<dyn BufRead>),
}

impl RayReader {
    /// Opens a file, or standard input for `-`. The content tells npy from CSV.
    pub(crate) fn open(path: &Path) -> Result<Self, RaysError> {
        if path == Path::new("-") {
            return Self::from_stream(io::stdin());
        }
        let file = File::open(path)?;
        let is_file = file.metadata()?.is_file();
        if !is_file {
            return Self::from_stream(file);
        }
        let mut file = BufReader::new(file);
        if npy_header::is_magic(file.fill_buf()?) {
            return NpyRays::new(Source::File(file)).map(Self::Npy);
        }
        Ok(Self::Csv(CsvRays::new(Box::new(file))))
    }

    fn from_stream(mut stream: impl Read + 'static) -> Result<Self, RaysError> {
        // A pipe may give a few bytes at a time, too few to know the format by.
        let mut start = Vec::new();
        stream.by_ref().take(npy_header::MAGIC.len() as u64).read_to_end(&mut start)?;
        let npy = npy_header::is_magic(&start);
        let whole = Box::new(BufReader::new(Cursor::new(start).chain(stream)));
        if npy {
            return NpyRays::new(Source::Stream(whole)).map(Self::Npy);
        }
        Ok(Self::Csv(CsvRays::new(whole)))
    }

    /// The precision of the numbers; those of a CSV file are taken for 64-bit.
    pub(crate) fn precision(&self) -> Precision {
        match self {
            Self::Npy(rays) => rays.precision(),
            Self::Csv(_) => Precision::F64,
        }
    }

    /// How many rays there are, if that is known beforehand.
    pub(crate) fn total(&self) -> Option<u64> {
        match self {
            Self::Npy(rays) => Some(rays.total()),
            Self::Csv(_) => None,
        }
    }

    /// Puts the next rays, `limit` at most, in place of those in `rays`; none at the end.
    pub(crate) fn read(&mut self, limit: usize, rays: &mut Vec<Ray>) -> Result<(), RaysError> {
        rays.clear();
        match self {
            Self::Npy(reader) => reader.read(limit, rays),
            Self::Csv(reader) => reader.read(limit, rays),
        }
    }
}

/// A ray from the 6 or 8 numbers of a row.
fn ray_of(row: &[f64]) -> Ray {
    let ray = Ray::new([row[0], row[1], row[2]], [row[3], row[4], row[5]]);
    match row {
        [.., t_min, t_max] if row.len() == 8 => ray.with_interval(*t_min, *t_max),
        _ => ray,
    }
}
