//! Answering rays and points by the stream: rows in, answers, arrays out. Memory does not grow with
//! their number.

mod answer;
mod error;
mod hits;
mod points;
mod rows;
mod summary;

pub(crate) use answer::{Answer, Answerer, Mode};
pub(crate) use error::RowsError;
pub(crate) use hits::{HitWriter, HitsFormat};
pub(crate) use points::answer_points;
pub(crate) use rows::{Row, RowReader};
pub(crate) use summary::Summary;

/// The precision of the rays or points, and so of the floats that answer them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Precision {
    /// 32 bits.
    F32,
    /// 64 bits.
    F64,
}

impl Precision {
    /// Bytes of a number.
    pub(crate) fn bytes(self) -> usize {
        match self {
            Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}
