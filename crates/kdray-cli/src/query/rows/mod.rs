//! Rows of numbers in, from npy or CSV: rays or points.

mod csv;
mod npy;
mod npy_header;
mod row;

pub(crate) use self::row::Row;
use self::{csv::CsvRows, npy::NpyRows};
use super::{Precision, RowsError};
use std::{
    fs::File,
    io::{self, BufRead, BufReader, Cursor, Read},
    path::Path,
};

/// Reads rays or points a chunk at a time.
pub(crate) enum RowReader<R> {
    Npy(NpyRows<R>),
    Csv(CsvRows<R>),
}

/// Where rows come from: a file, in which one can jump, or a stream.
pub(in crate::query) enum Source {
    File(BufReader<File>),
    Stream(Box<dyn BufRead>),
}

impl<R: Row> RowReader<R> {
    /// Opens a file, or standard input for `-`. The content tells npy from CSV.
    pub(crate) fn open(path: &Path) -> Result<Self, RowsError> {
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
            return NpyRows::new(Source::File(file)).map(Self::Npy);
        }
        Ok(Self::Csv(CsvRows::new(Box::new(file))))
    }

    fn from_stream(mut stream: impl Read + 'static) -> Result<Self, RowsError> {
        // A pipe may give a few bytes at a time, too few to know the format by.
        let mut start = Vec::new();
        stream.by_ref().take(npy_header::MAGIC.len() as u64).read_to_end(&mut start)?;
        let npy = npy_header::is_magic(&start);
        let whole = Box::new(BufReader::new(Cursor::new(start).chain(stream)));
        if npy {
            return NpyRows::new(Source::Stream(whole)).map(Self::Npy);
        }
        Ok(Self::Csv(CsvRows::new(whole)))
    }

    /// The precision of the numbers; those of a CSV file are taken for 64-bit.
    pub(crate) fn precision(&self) -> Precision {
        match self {
            Self::Npy(rows) => rows.precision(),
            Self::Csv(_) => Precision::F64,
        }
    }

    /// How many there are, if that is known beforehand.
    pub(crate) fn total(&self) -> Option<u64> {
        match self {
            Self::Npy(rows) => Some(rows.total()),
            Self::Csv(_) => None,
        }
    }

    /// Puts the next ones, `limit` at most, in place of those in `rows`; none at the end.
    pub(crate) fn read(&mut self, limit: usize, rows: &mut Vec<R>) -> Result<(), RowsError> {
        rows.clear();
        match self {
            Self::Npy(reader) => reader.read(limit, rows),
            Self::Csv(reader) => reader.read(limit, rows),
        }
    }
}
