//! The first 256 bytes of a file.

use super::sections::{COUNT, Sections};
use super::{FileError, checksum};
use crate::geometry::{Aabb, Coordinate};

/// How long the header is.
pub const HEADER_BYTES: usize = 256;

/// How a file begins. As PNG's: what treats bytes as text, or cuts their highest bit, destroys it.
const MAGIC: [u8; 8] = *b"\x89KDRAY\r\n";

const VERSION: u32 = 1;

/// Where the header's own checksum stands.
const CHECKSUM: usize = HEADER_BYTES - 8;

/// Whether bytes, of which the first eight are enough, begin as a tree file does.
pub fn is_tree_file(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC)
}

/// How many bytes a tree file has in all, by its header, the first [`HEADER_BYTES`] of them. To be asked
/// before memory is taken for all of it.
///
/// # Errors
/// See [`FileError`]: those of a header.
pub fn file_bytes(header: &[u8]) -> Result<u64, FileError> {
    Header::read_start(header).map(|(_, sections)| sections.file_bytes())
}

/// How many bits the coordinates in a tree file have, by its header, the first [`HEADER_BYTES`] of it: 32,
/// for a `Scene<f32>`, or 64, for a `Scene<f64>`.
///
/// # Errors
/// See [`FileError`]: those of a header.
pub fn coordinate_bits(header: &[u8]) -> Result<u32, FileError> {
    Header::read_start(header).map(|(header, _)| header.coordinate_bits)
}

/// Whether the coordinates in a tree file are T, by its header, the first [`HEADER_BYTES`] of it.
///
/// # Errors
/// [`FileError::Precision`] if they are not; those of a header.
pub fn check_precision<T: Coordinate>(header: &[u8]) -> Result<(), FileError> {
    Header::read_start(header)?.0.check_precision::<T>()
}

/// The bits of a coordinate.
pub(super) fn bits_of<T: Coordinate>() -> u32 {
    8 * size_of::<T>() as u32
}

/// What the header says besides what it is: its numbers in the order in which they stand there.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Header {
    /// How many a vertex's coordinates have: 32 or 64.
    pub(super) coordinate_bits: u32,
    /// That of all bytes behind the header.
    pub(super) body_checksum: u64,
    /// How long each array is.
    pub(super) counts: [u64; COUNT],
    /// The root's box.
    pub(super) bounds: Aabb<3>,
    /// Whether there is a wide tree.
    pub(super) has_wide: bool,
}

impl Header {
    pub(super) fn to_bytes(&self) -> [u8; HEADER_BYTES] {
        let mut bytes = [0; HEADER_BYTES];
        let mut rest = &mut bytes[..CHECKSUM];
        let mut put = |field: &[u8]| {
            let (place, others) = std::mem::take(&mut rest).split_at_mut(field.len());
            place.copy_from_slice(field);
            rest = others;
        };
        put(&MAGIC);
        put(&VERSION.to_le_bytes());
        put(&self.coordinate_bits.to_le_bytes());
        put(&self.body_checksum.to_le_bytes());
        self.counts.iter().for_each(|count| put(&count.to_le_bytes()));
        let corners = self.bounds.min.iter().chain(&self.bounds.max);
        corners.for_each(|x| put(&x.to_le_bytes()));
        put(&u32::from(self.has_wide).to_le_bytes());
        let sum = checksum(&bytes[..CHECKSUM]).to_le_bytes();
        bytes[CHECKSUM..].copy_from_slice(&sum);
        bytes
    }

    /// Reads the header of a file, all of whose bytes are given, and checks that it is one of that
    /// precision, and that the arrays fill the file.
    pub(super) fn read<T: Coordinate>(file: &[u8]) -> Result<(Self, Sections), FileError> {
        let (header, sections) = Self::read_start(file)?;
        header.check_precision::<T>()?;
        let (expected, found) = (sections.file_bytes(), file.len() as u64);
        if found == expected {
            Ok((header, sections))
        } else {
            Err(FileError::Length { expected, found })
        }
    }

    /// Reads the header of a file, of which no more need be given, and checks that it is one.
    fn read_start(file: &[u8]) -> Result<(Self, Sections), FileError> {
        if !is_tree_file(file) {
            return Err(FileError::NotATreeFile);
        }
        let Some(bytes) = file.first_chunk::<HEADER_BYTES>() else {
            let found = file.len() as u64;
            return Err(FileError::Length { expected: HEADER_BYTES as u64, found });
        };
        let mut fields = Fields(&bytes[MAGIC.len()..]);
        let version = fields.u32();
        if version != VERSION {
            return Err(FileError::Version(version));
        }
        if checksum(&bytes[..CHECKSUM]).to_le_bytes() != bytes[CHECKSUM..] {
            return Err(FileError::DamagedHeader);
        }
        let header = Self::of_fields(&mut fields)?;
        if header.to_bytes() != *bytes {
            return Err(FileError::BadHeader("what means nothing is not zero"));
        }
        let too_long = FileError::BadHeader("no file could be as long");
        let sections = Sections::new(header.coordinate_bits, &header.counts).ok_or(too_long)?;
        Ok((header, sections))
    }

    fn check_precision<T: Coordinate>(&self) -> Result<(), FileError> {
        let (found, expected) = (self.coordinate_bits, bits_of::<T>());
        if found == expected { Ok(()) } else { Err(FileError::Precision { found, expected }) }
    }

    fn of_fields(fields: &mut Fields<'_>) -> Result<Self, FileError> {
        let coordinate_bits = fields.u32();
        if ![bits_of::<f32>(), bits_of::<f64>()].contains(&coordinate_bits) {
            return Err(FileError::BadHeader("coordinates have 32 or 64 bits"));
        }
        let body_checksum = fields.u64();
        let counts = [(); COUNT].map(|()| fields.u64());
        let corner = |fields: &mut Fields<'_>| [(); 3].map(|()| f32::from_bits(fields.u32()));
        let bounds = Aabb { min: corner(fields), max: corner(fields) };
        let has_wide = match fields.u32() {
            0 => false,
            1 => true,
            _ => return Err(FileError::BadHeader("there is or is not a wide tree")),
        };
        Ok(Self { coordinate_bits, body_checksum, counts, bounds, has_wide })
    }
}

/// The numbers of a header, one after the other; zeros behind its end.
struct Fields<'a>(&'a [u8]);

impl Fields<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let Some((field, rest)) = self.0.split_first_chunk() else { return [0; N] };
        self.0 = rest;
        *field
    }

    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }

    fn u64(&mut self) -> u64 {
        u64::from_le_bytes(self.take())
    }
}
