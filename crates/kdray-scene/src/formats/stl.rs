//! STL (3D Systems, 1988), ASCII and binary. Equal corners become one vertex.
//!
//! Read by hand: `stl_io` takes a binary file whose header says `solid` for text, and needs a
//! source that can seek.

use super::Request;
use crate::input::Scanner;
use crate::mesh::{Corner, MeshBuilder, Welder};
use crate::{LoadError, Model, Place};
use std::io::Read;

pub(super) fn read(
    bytes: Box<dyn Read + '_>,
    start: &[u8],
    request: &Request<'_>,
) -> Result<Model, LoadError> {
    let scanner = Scanner::new(bytes, request);
    let builder = MeshBuilder::new(request);
    let mut reader = Reader { scanner, builder, welder: Welder::default() };
    if is_text(start) {
        reader.text()?;
    } else {
        reader.binary()?;
    }
    Ok(reader.builder.finish())
}

/// Text begins with `solid`, but so do some binary files; these have a zero byte soon, at the
/// latest in the attributes of their first triangles.
fn is_text(start: &[u8]) -> bool {
    let text = start.trim_ascii_start();
    text.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) && !start.contains(&0)
}

struct Reader<'a> {
    scanner: Scanner<'a>,
    builder: MeshBuilder<'a>,
    welder: Welder,
}

impl Reader<'_> {
    fn corner(
        &mut self,
        position: [f32; 3],
        place: impl Fn() -> Place,
    ) -> Result<Corner, LoadError> {
        let vertex = self.welder.index(position, &mut self.builder, place)?;
        Ok(Corner { vertex: i64::from(vertex), ..Corner::default() })
    }

    /// 80 bytes of anything, a count, and for each triangle a normal, three corners and two bytes.
    fn binary(&mut self) -> Result<(), LoadError> {
        self.scanner.array::<80>()?;
        let count = u32::from_le_bytes(self.scanner.array()?);
        for index in 0..count {
            let Ok(record) = self.scanner.array::<50>() else {
                let reason =
                    format!("the file ends here, but as binary STL it has {count} triangles");
                return Err(self.scanner.error_at(triangle(index), reason));
            };
            let number = |at: usize| {
                let bytes = [record[at], record[at + 1], record[at + 2], record[at + 3]];
                f32::from_le_bytes(bytes)
            };
            let place = || triangle(index);
            let mut corners = [Corner::default(); 3];
            for (corner, at) in corners.iter_mut().zip([12, 24, 36]) {
                *corner = self.corner([0, 4, 8].map(|i| number(at + i)), place)?;
            }
            self.builder.polygon(&corners, place)?;
        }
        if self.scanner.peek()?.is_some() {
            if count == 0 {
                return Err(self.scanner.error_at_byte("goes on, but says it has no triangles"));
            }
            let byte = self.scanner.byte();
            self.builder.warn(format!("byte {byte}: what follows the last triangle passed over"));
        }
        Ok(())
    }

    /// Solids of facets of loops of vertices, in words.
    fn text(&mut self) -> Result<(), LoadError> {
        let mut word = Vec::new();
        let mut open_solid = false;
        let mut corners: Option<Vec<Corner>> = None;
        while self.scanner.word(&mut word)? {
            word.make_ascii_lowercase();
            match (word.as_slice(), &mut corners) {
                (b"solid", None) => {
                    open_solid = true;
                    self.scanner.line(&mut word)?;
                }
                (b"endsolid", None) => {
                    open_solid = false;
                    self.scanner.line(&mut word)?;
                }
                // The normal follows from the corners, and many files have it wrong.
                (b"facet", None) => {
                    self.expect(&mut word, b"normal")?;
                    self.numbers(&mut word)?;
                }
                (b"outer", None) => {
                    self.expect(&mut word, b"loop")?;
                    corners = Some(Vec::new());
                }
                (b"vertex", Some(corners)) => {
                    let position = self.numbers(&mut word)?;
                    let place = Place::Line(self.scanner.line_number());
                    corners.push(self.corner(position, || place.clone())?);
                }
                (b"endloop", Some(_)) => {
                    let place = Place::Line(self.scanner.line_number());
                    let corners = corners.take().unwrap_or_default();
                    self.builder.polygon(&corners, || place.clone())?;
                }
                (b"endfacet", None) => {}
                _ => {
                    let word = String::from_utf8_lossy(&word).into_owned();
                    return Err(self
                        .scanner
                        .error_in_line(format!("{word:?} does not belong here")));
                }
            }
        }
        if open_solid || corners.is_some() {
            return Err(self.scanner.error_in_line("the file ends within a solid"));
        }
        Ok(())
    }

    fn expect(&mut self, word: &mut Vec<u8>, expected: &[u8]) -> Result<(), LoadError> {
        if !self.scanner.word(word)? || !word.eq_ignore_ascii_case(expected) {
            let expected = String::from_utf8_lossy(expected);
            return Err(self.scanner.error_in_line(format!("the word {expected:?} is missing")));
        }
        Ok(())
    }

    fn numbers(&mut self, word: &mut Vec<u8>) -> Result<[f32; 3], LoadError> {
        let mut numbers = [0.0; 3];
        for number in &mut numbers {
            self.scanner.word(word)?;
            let Some(value) = crate::number::parse(word) else {
                let word = String::from_utf8_lossy(word);
                return Err(self.scanner.error_in_line(format!("{word:?} is no number")));
            };
            *number = value as f32;
        }
        Ok(numbers)
    }
}

fn triangle(index: u32) -> Place {
    Place::Element { name: "triangle".to_owned(), index: u64::from(index) }
}
