//! The values of a PLY file.

use super::header::{Element, Scalar};
use crate::LoadError;
use crate::input::Scanner;

/// How values are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

impl Encoding {
    pub(super) fn from_name(name: &str) -> Option<Self> {
        match name {
            "ascii" => Some(Self::Ascii),
            "binary_little_endian" => Some(Self::LittleEndian),
            "binary_big_endian" => Some(Self::BigEndian),
            _ => None,
        }
    }
}

/// One thing of an element: its single values, and its lists, each in the order of the header.
/// f64 holds every value of every type exactly.
pub(super) struct Row {
    scalars: Vec<f64>,
    pub(super) lists: Vec<Vec<f64>>,
}

impl Row {
    pub(super) fn new(element: &Element) -> Self {
        let lists = element.properties.iter().filter(|property| property.length.is_some()).count();
        Self {
            scalars: vec![0.0; element.properties.len() - lists],
            lists: vec![Vec::new(); lists],
        }
    }

    /// The single values at these places.
    pub(super) fn pick<const N: usize>(&self, places: [usize; N]) -> [f32; N] {
        places.map(|place| self.scalars[place] as f32)
    }
}

/// The longest list that is read.
const MAX_LIST: f64 = (1 << 26) as f64;

/// Reads rows.
pub(super) struct Values<'a> {
    scanner: Scanner<'a>,
    encoding: Encoding,
    word: Vec<u8>,
}

impl<'a> Values<'a> {
    pub(super) fn new(scanner: Scanner<'a>, encoding: Encoding) -> Self {
        Self { scanner, encoding, word: Vec::new() }
    }

    /// An error in one thing of an element.
    pub(super) fn error(&self, element: &Element, index: u64, reason: &str) -> LoadError {
        self.scanner.error_at(element.place(index), reason)
    }

    /// Passes over all things of an element.
    pub(super) fn skip(&mut self, element: &Element) -> Result<(), LoadError> {
        if element.properties.is_empty() {
            // They take no room in the file, so their count may be anything.
            return Ok(());
        }
        let mut row = Row::new(element);
        (0..element.count).try_for_each(|index| self.read(element, index, &mut row))
    }

    /// The next thing of an element.
    pub(super) fn read(
        &mut self,
        element: &Element,
        index: u64,
        row: &mut Row,
    ) -> Result<(), LoadError> {
        let (mut scalar, mut list) = (0, 0);
        for property in &element.properties {
            let Some(length) = property.length else {
                row.scalars[scalar] = self.value(property.scalar, element, index)?;
                scalar += 1;
                continue;
            };
            let length = self.value(length, element, index)?;
            if length < 0.0 || length.fract() != 0.0 || length > MAX_LIST {
                let reason = format!("the list {} has length {length}", property.name);
                return Err(self.error(element, index, &reason));
            }
            // The list grows as values come, so that a false length takes no memory.
            row.lists[list].clear();
            for _ in 0..length as u64 {
                let value = self.value(property.scalar, element, index)?;
                row.lists[list].push(value);
            }
            list += 1;
        }
        // Some programs write more values than they declare; the next thing has its own line.
        if self.encoding == Encoding::Ascii && !element.properties.is_empty() {
            self.scanner.line(&mut self.word)?;
        }
        Ok(())
    }

    #[inline]
    fn value(&mut self, scalar: Scalar, element: &Element, index: u64) -> Result<f64, LoadError> {
        let value = match self.encoding {
            Encoding::Ascii => return self.word(element, index),
            Encoding::LittleEndian => self.binary::<true>(scalar),
            Encoding::BigEndian => self.binary::<false>(scalar),
        };
        value.map_err(|error| match error {
            LoadError::Invalid { reason, .. } => self.error(element, index, &reason),
            other => other,
        })
    }

    #[inline]
    fn binary<const LITTLE: bool>(&mut self, scalar: Scalar) -> Result<f64, LoadError> {
        macro_rules! number {
            ($type:ty) => {{
                let bytes = self.scanner.array()?;
                if LITTLE { <$type>::from_le_bytes(bytes) } else { <$type>::from_be_bytes(bytes) }
            }};
        }
        Ok(match scalar {
            Scalar::I8 => f64::from(number!(i8)),
            Scalar::U8 => f64::from(number!(u8)),
            Scalar::I16 => f64::from(number!(i16)),
            Scalar::U16 => f64::from(number!(u16)),
            Scalar::I32 => f64::from(number!(i32)),
            Scalar::U32 => f64::from(number!(u32)),
            Scalar::F32 => f64::from(number!(f32)),
            Scalar::F64 => number!(f64),
        })
    }

    fn word(&mut self, element: &Element, index: u64) -> Result<f64, LoadError> {
        if !self.scanner.word(&mut self.word)? {
            return Err(self.error(element, index, "the file ends too early"));
        }
        crate::number::parse(&self.word).ok_or_else(|| {
            let word = String::from_utf8_lossy(&self.word);
            let line = self.scanner.line_number();
            self.error(element, index, &format!("{word:?} in line {line} is no number"))
        })
    }
}
