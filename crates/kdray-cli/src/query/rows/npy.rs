//! Rows from an npy file.

use super::{
    super::{Precision, RowsError},
    Row, Source,
    npy_header::NpyHeader,
};
use std::{
    fs::File,
    io::{self, BufReader, Read, Seek, SeekFrom},
    marker::PhantomData,
};

/// The rows of an array.
pub(crate) struct NpyRows<R> {
    header: NpyHeader,
    source: Source,
    /// Rows read so far.
    done: u64,
    /// The numbers of the rows being read.
    values: Vec<f64>,
    bytes: Vec<u8>,
    row: PhantomData<R>,
}

impl<R: Row> NpyRows<R> {
    pub(super) fn new(mut source: Source) -> Result<Self, RowsError> {
        let header = NpyHeader::read::<R>(&mut source).map_err(|error| match error {
            RowsError::Io(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                RowsError::Header("the file ends within it".to_owned())
            }
            error => error,
        })?;
        match &source {
            Source::Stream(_) if header.fortran_order => {
                return Err(RowsError::FortranStream(R::MANY));
            }
            Source::Stream(_) => {}
            Source::File(file) => check_length(file.get_ref(), &header)?,
        }
        let (values, bytes) = (Vec::new(), Vec::new());
        Ok(Self { header, source, done: 0, values, bytes, row: PhantomData })
    }

    pub(super) fn precision(&self) -> Precision {
        self.header.precision
    }

    pub(super) fn total(&self) -> u64 {
        self.header.rows
    }

    pub(super) fn read(&mut self, limit: usize, into: &mut Vec<R>) -> Result<(), RowsError> {
        let NpyHeader { rows, columns, fortran_order, .. } = self.header;
        let count = (rows - self.done).min(limit as u64) as usize;
        self.values.clear();
        let whole = if fortran_order { self.read_columns(count) } else { self.read_rows(count) };
        whole.map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => {
                let row = self.done + (self.values.len() / columns) as u64;
                RowsError::Truncated { row, rows }
            }
            _ => RowsError::Io(error),
        })?;
        self.done += count as u64;
        if fortran_order {
            into.extend((0..count).map(|row| {
                let mut values = [0.0; 8];
                for (column, value) in values[..columns].iter_mut().enumerate() {
                    *value = self.values[column * count + row];
                }
                R::of(&values[..columns])
            }));
        } else {
            into.extend(self.values.chunks_exact(columns).map(R::of));
        }
        Ok(())
    }

    fn read_rows(&mut self, count: usize) -> io::Result<()> {
        self.read_values(count * self.header.columns)
    }

    /// Reads the rows' numbers column by column, each column being in one piece in the file.
    fn read_columns(&mut self, count: usize) -> io::Result<()> {
        let NpyHeader { rows, length, precision, columns, .. } = self.header;
        for column in 0..columns as u64 {
            let Source::File(file) = &mut self.source else { return Ok(()) };
            let place = column * rows + self.done;
            file.seek(SeekFrom::Start(length + place * precision.bytes() as u64))?;
            self.read_values(count)?;
        }
        Ok(())
    }

    /// Reads so many numbers, or as many as there are and an error.
    fn read_values(&mut self, count: usize) -> io::Result<()> {
        let size = self.header.precision.bytes();
        self.bytes.clear();
        let wanted = count * size;
        self.source.by_ref().take(wanted as u64).read_to_end(&mut self.bytes)?;
        let decode = decoder(&self.header);
        self.values.extend(self.bytes.chunks_exact(size).map(decode));
        if self.bytes.len() < wanted {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        Ok(())
    }
}

/// A file that is too short is refused before the work.
fn check_length(file: &File, header: &NpyHeader) -> Result<(), RowsError> {
    let row_bytes = (header.columns * header.precision.bytes()) as u64;
    let present = file.metadata()?.len().saturating_sub(header.length);
    if present / row_bytes < header.rows {
        return Err(RowsError::Truncated { row: present / row_bytes, rows: header.rows });
    }
    Ok(())
}

/// From the bytes of a number to the number.
fn decoder(header: &NpyHeader) -> impl Fn(&[u8]) -> f64 + use<> {
    let (precision, big_endian) = (header.precision, header.big_endian);
    move |bytes| {
        let mut little = [0; 8];
        let used = &mut little[..bytes.len()];
        used.copy_from_slice(bytes);
        if big_endian {
            used.reverse();
        }
        let bits = u64::from_le_bytes(little);
        match precision {
            Precision::F32 => f32::from_bits(bits as u32).into(),
            Precision::F64 => f64::from_bits(bits),
        }
    }
}

impl Read for Source {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::File(file) => BufReader::read(file, buffer),
            Self::Stream(stream) => stream.read(buffer),
        }
    }
}
