//! Why rays or points could not be read.

use std::io;
use thiserror::Error;

/// Why rays or points could not be read, and where.
#[derive(Debug, Error)]
pub(crate) enum RowsError {
    /// The system's error.
    #[error("cannot be read: {0}")]
    Io(#[from] io::Error),
    /// The first bytes of an npy file are wrong.
    #[error("npy header: {0}; write the file with numpy.save")]
    Header(String),
    /// Numbers that are not 32- or 64-bit floats.
    #[error("npy header: dtype {dtype}: {what} must be 32- or 64-bit floats, '<f4' or '<f8'")]
    DType {
        /// What the header says.
        dtype: String,
        /// What was to be read.
        what: &'static str,
    },
    /// Not a list of rays, or of points.
    #[error("npy header: shape {shape}: {what} must be {wanted}")]
    Shape {
        /// What the header says.
        shape: String,
        /// What was to be read.
        what: &'static str,
        /// The shapes that it may have.
        wanted: &'static str,
    },
    /// Fewer bytes than the header says.
    #[error("row {row}: the file ends here, but its header says {rows} rows; it is truncated")]
    Truncated {
        /// The first row that is not whole, from 0.
        row: u64,
        /// How many the header says.
        rows: u64,
    },
    /// Columns that do not stand one behind the other.
    #[error(
        "npy header: Fortran order can be read from a file, but not from a stream; give the file's \
         name, or save numpy.ascontiguousarray({0})"
    )]
    FortranStream(&'static str),
    /// A line that is no ray, or no point.
    #[error("line {line}: {reason}")]
    Line {
        /// The line, from 1.
        line: u64,
        /// What is wrong with it.
        reason: String,
    },
}
