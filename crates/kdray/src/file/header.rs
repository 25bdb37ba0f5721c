//! The first 256 bytes of a file.

use super::sections::{COUNT, Sections};
use super::{FileError, checksum};
use crate::geometry::Aabb;

/// How long the header is.
pub const HEADER_BYTES: usize = 256;

/// How a file begins. As PNG's: what treats bytes as text, or cuts their highest bit, destroys it.
const MAGIC: [u8; 8] = *b"\x89KDRAY\r\n";

const VERSION: u32 = 1;

/// The bits of a coordinate.
const PRECISION: u32 = 32;

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

/// What the header says besides what it is: its numbers in the order in which they stand there.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Header {
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
        put(&PRECISION.to_le_bytes());
        put(&self.body_checksum.to_le_bytes());
        self.counts.iter().for_each(|count| put(&count.to_le_bytes()));
        let corners = self.bounds.min.iter().chain(&self.bounds.max);
        corners.for_each(|x| put(&x.to_le_bytes()));
        put(&u32::from(self.has_wide).to_le_bytes());
        let sum = checksum(&bytes[..CHECKSUM]).to_le_bytes();
        bytes[CHECKSUM..].copy_from_slice(&sum);
        bytes
    }

    /// Reads the header of a file, all of whose bytes are given, and checks that it is one, and that
    /// the arrays fill the file.
    pub(super) fn read(file: &[u8]) -> Result<(Self, Sections), FileError> {
        let (header, sections) = Self::read_start(file)?;
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
        let (version, precision) = (fields.u32(), fields.u32());
        if version != VERSION {
            return Err(FileError::Version(version));
        }
        if checksum(&bytes[..CHECKSUM]).to_le_bytes() != bytes[CHECKSUM..] {
            return Err(FileError::DamagedHeader);
        }
        if precision != PRECISION {
            return Err(FileError::Precision(precision));
        }
        let header = Self::of_fields(&mut fields)?;
        if header.to_bytes() != *bytes {
            return Err(FileError::BadHeader("what means nothing is not zero"));
        }
        let too_long = FileError::BadHeader("no file could be as long");
        let sections = Sections::new(&header.counts).ok_or(too_long)?;
        Ok((header, sections))
    }

    fn of_fields(fields: &mut Fields<'_>) -> Result<Self, FileError> {
        let body_checksum = fields.u64();
        let counts = [(); COUNT].map(|()| fields.u64());
        let corner = |fields: &mut Fields<'_>| [(); 3].map(|()| f32::from_bits(fields.u32()));
        let bounds = Aabb { min: corner(fields), max: corner(fields) };
        let has_wide = match fields.u32() {
            0 => false,
            1 => true,
            _ => return Err(FileError::BadHeader("there is or is not a wide tree")),
        };
        Ok(Self { body_checksum, counts, bounds, has_wide })
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
