//! The header of an npy file: what the numbers are and how many.
//!
//! The format is NEP 1's: six magic bytes, two of version, the header's length (two bytes in
//! version 1, four since), and a Python dictionary with three keys in any order.

use super::{
    super::{Precision, RowsError},
    Row,
};
use std::io::Read;

/// How every npy file begins.
pub(super) const MAGIC: [u8; 6] = *b"\x93NUMPY";

/// Headers of plain arrays have 118 bytes; longer ones are of structured arrays.
const MAX_LENGTH: u32 = 1 << 16;

/// What an npy file of rows holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct NpyHeader {
    pub(super) precision: Precision,
    pub(super) big_endian: bool,
    pub(super) fortran_order: bool,
    pub(super) rows: u64,
    /// As many as a row has numbers.
    pub(super) columns: usize,
    /// Bytes before the first number.
    pub(super) length: u64,
}

/// Whether a file that begins with these bytes is an npy file.
pub(super) fn is_magic(start: &[u8]) -> bool {
    start.starts_with(&MAGIC)
}

impl NpyHeader {
    /// Reads the header and nothing behind it.
    pub(super) fn read<R: Row>(source: &mut impl Read) -> Result<Self, RowsError> {
        let mut prefix = [0; 8];
        source.read_exact(&mut prefix)?;
        let (length, start) = match prefix[6] {
            1 => (u32::from(u16::from_le_bytes(array(source)?)), 10),
            2 | 3 => (u32::from_le_bytes(array(source)?), 12),
            version => return Err(bad(format!("version {version} is not 1, 2 or 3"))),
        };
        if length > MAX_LENGTH {
            return Err(bad(format!("{length} bytes long, more than {MAX_LENGTH}")));
        }
        let mut text = vec![0; length as usize];
        source.read_exact(&mut text)?;
        let text = String::from_utf8(text).map_err(|_| bad("is not text"))?;
        Self::parse::<R>(&text, start + u64::from(length))
    }

    fn parse<R: Row>(text: &str, length: u64) -> Result<Self, RowsError> {
        let (big_endian, precision) = dtype::<R>(value(text, "descr")?)?;
        let fortran_order = match value(text, "fortran_order")? {
            rest if rest.starts_with("True") => true,
            rest if rest.starts_with("False") => false,
            _ => return Err(bad("fortran_order is neither True nor False")),
        };
        let (rows, columns) = shape::<R>(value(text, "shape")?)?;
        Ok(Self { precision, big_endian, fortran_order, rows, columns, length })
    }
}

fn array<const N: usize>(source: &mut impl Read) -> Result<[u8; N], RowsError> {
    let mut bytes = [0; N];
    source.read_exact(&mut bytes)?;
    Ok(bytes)
}

fn bad(reason: impl Into<String>) -> RowsError {
    RowsError::Header(reason.into())
}

/// What stands behind `'key':`.
fn value<'a>(text: &'a str, key: &str) -> Result<&'a str, RowsError> {
    let quoted = [format!("'{key}'"), format!("\"{key}\"")];
    let found = quoted.iter().find_map(|quoted| text.split_once(quoted.as_str()));
    let rest = found.and_then(|(_, rest)| rest.trim_start().strip_prefix(':'));
    rest.map(str::trim_start).ok_or_else(|| bad(format!("has no '{key}'")))
}

/// The byte order and precision that a text such as `'<f4', …` begins with.
fn dtype<R: Row>(text: &str) -> Result<(bool, Precision), RowsError> {
    let name = text.strip_prefix(['\'', '"']).and_then(|rest| rest.split(['\'', '"']).next());
    match name {
        Some("<f4") => Ok((false, Precision::F32)),
        Some(">f4") => Ok((true, Precision::F32)),
        Some("<f8") => Ok((false, Precision::F64)),
        Some(">f8") => Ok((true, Precision::F64)),
        Some(other) => Err(bad_dtype::<R>(format!("'{other}'"))),
        None => Err(bad_dtype::<R>("of several fields".to_owned())),
    }
}

fn bad_dtype<R: Row>(dtype: String) -> RowsError {
    RowsError::DType { dtype, what: R::MANY }
}

/// The rows and columns that a text such as `(5, 6), …` begins with.
fn shape<R: Row>(text: &str) -> Result<(u64, usize), RowsError> {
    let inside = text.strip_prefix('(').and_then(|rest| rest.split_once(')'));
    let (inside, _) = inside.ok_or_else(|| bad("shape is not a tuple"))?;
    let refused = || {
        let shape = format!("({})", inside.trim());
        RowsError::Shape { shape, what: R::MANY, wanted: R::SHAPES }
    };
    let sizes = inside.split(',').map(str::trim).filter(|size| !size.is_empty());
    let sizes: Vec<u64> = sizes.map(str::parse).collect::<Result<_, _>>().map_err(|_| refused())?;
    match sizes[..] {
        // So that no count of bytes overflows.
        [rows, columns] if rows < 1 << 56 => {
            let width = R::WIDTHS.iter().find(|&&width| width as u64 == columns);
            width.map(|&width| (rows, width)).ok_or_else(refused)
        }
        _ => Err(refused()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kdray::Ray;

    #[test]
    fn keys_may_come_in_any_order() {
        let text = "{'shape': (5, 8), 'descr': '>f8', 'fortran_order': True, }  \n";
        let header = NpyHeader::parse::<Ray>(text, 128).unwrap();
        let expected = NpyHeader {
            precision: Precision::F64,
            big_endian: true,
            fortran_order: true,
            rows: 5,
            columns: 8,
            length: 128,
        };
        assert_eq!(header, expected);
    }

    #[test]
    fn what_is_no_list_of_rays_is_refused_by_name() {
        let header = |descr: &str, shape: &str| {
            let text = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}}}");
            NpyHeader::parse::<Ray>(&text, 0).unwrap_err().to_string()
        };
        assert!(header("'<i4'", "(5, 6)").contains("dtype '<i4'"));
        assert!(header("[('x', '<f4')]", "(5, 6)").contains("several fields"));
        for shape in ["(5, 7)", "(6,)", "()", "(2, 3, 6)", "(-1, 6)", "(72057594037927936, 6)"] {
            assert!(header("'<f4'", shape).contains(&format!("shape {shape}")), "{shape}");
        }
        assert!(header("'<f4'", "5").contains("tuple"));
        assert!(NpyHeader::parse::<Ray>("{}", 0).unwrap_err().to_string().contains("'descr'"));
        let long = [&MAGIC[..], &[2, 0, 255, 255, 255, 255]].concat();
        let error = NpyHeader::read::<Ray>(&mut &long[..]).unwrap_err();
        assert!(error.to_string().contains("4294967295 bytes"));
    }
}
