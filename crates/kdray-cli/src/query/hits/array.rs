//! One array of an npz file, while its length is not known yet.

use super::super::Precision;
use std::{
    fs::File,
    io::{self, BufWriter, Seek, SeekFrom, Write},
};

/// The type of an array's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    /// A float in the precision of the rays.
    Float,
    U32,
    I32,
    I64,
    Bool,
}

/// An array whose numbers are kept in a file without a name till their count is known.
pub(crate) struct Array {
    name: &'static str,
    number: Number,
    precision: Precision,
    /// Numbers in a row; 1 for arrays of one dimension.
    columns: u64,
    file: BufWriter<File>,
    count: u64,
}

impl Array {
    pub(super) fn new(
        name: &'static str,
        number: Number,
        columns: u64,
        precision: Precision,
        file: File,
    ) -> Self {
        Self { name, number, precision, columns, file: BufWriter::new(file), count: 0 }
    }

    pub(super) fn name(&self) -> &'static str {
        self.name
    }

    /// Appends floats, rounded to the precision.
    pub(super) fn push_floats(&mut self, values: &[f64]) -> io::Result<()> {
        for &value in values {
            match self.precision {
                Precision::F32 => self.push(&(value as f32).to_le_bytes())?,
                Precision::F64 => self.push(&value.to_le_bytes())?,
            }
        }
        Ok(())
    }

    /// Appends the bytes, least significant first, of one number.
    pub(super) fn push(&mut self, little_endian: &[u8]) -> io::Result<()> {
        self.count += 1;
        self.file.write_all(little_endian)
    }

    /// Writes the array as an npy file.
    pub(super) fn copy_to(self, target: &mut impl Write) -> io::Result<()> {
        target.write_all(&self.header())?;
        let mut file = self.file.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.seek(SeekFrom::Start(0))?;
        io::copy(&mut file, target)?;
        Ok(())
    }

    /// The header of version 1.0 (numpy's NEP 1): its length is a multiple of 64.
    fn header(&self) -> Vec<u8> {
        let descr = match (self.number, self.precision) {
            (Number::Float, Precision::F32) => "<f4",
            (Number::Float, Precision::F64) => "<f8",
            (Number::U32, _) => "<u4",
            (Number::I32, _) => "<i4",
            (Number::I64, _) => "<i8",
            (Number::Bool, _) => "|b1",
        };
        let shape = match self.columns {
            1 => format!("({},)", self.count),
            columns => format!("({}, {columns})", self.count / columns),
        };
        let mut text =
            format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}");
        while (10 + text.len() + 1) % 64 != 0 {
            text.push(' ');
        }
        text.push('\n');
        [b"\x93NUMPY\x01\x00", &(text.len() as u16).to_le_bytes()[..], text.as_bytes()].concat()
    }
}
