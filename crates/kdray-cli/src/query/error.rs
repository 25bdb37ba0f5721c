//! Why rays could not be read.

use std::io;
use thiserror::Error;

/// Why rays could not be read, and where.
#[derive(Debug, Error)]
pub(crate) enum RaysError {
    /// The system's error.
    #[error("cannot be read: {0}")]
    Io(#[from] io::Error),
    /// The first bytes of an npy file are wrong.
    #[error("npy header: {0}; write the file with numpy.save")]
    Header(String),
    /// Numbers that are not 32- or 64-bit floats.
    #[error("npy header: dtype {0}: rays must be 32- or 64-bit floats, '<f4' or '<f8'")]
    DType(String),
    /// Not a list of rays.
    #[error(
        "npy header: shape {0}: rays must be N x 6 (origin, direction) or N x 8 (and t_min, t_max)"
    )]
    Shape(String),
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
         name, or save numpy.ascontiguousarray(rays)"
    )]
    FortranStream,
    /// A line that is no ray.
    #[error("line {line}: {reason}")]
    Line {
        /// The line, from 1.
        line: u64,
        /// What is wrong with it.
        reason: String,
    },
}
