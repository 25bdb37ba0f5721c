//! OFF (Geomview): also with colours, normals and texture coordinates of vertices (COFF, NOFF,
//! STOFF and their combinations), and colours of faces.

use super::Request;
use crate::input::Scanner;
use crate::mesh::{Corner, MeshBuilder};
use crate::{LoadError, Model, Place};
use std::io::Read;

pub(super) fn read(bytes: Box<dyn Read + '_>, request: &Request<'_>) -> Result<Model, LoadError> {
    let mut lines = Lines { scanner: Scanner::new(bytes, request), line: Vec::new(), number: 0 };
    let mut row = Vec::new();
    let kind = Kind::read(&mut lines, &mut row, request)?;
    let [vertices, faces] = kind.counts;
    let mut builder = MeshBuilder::new(request);
    let mut corners_of_vertices = Vec::new();
    for index in 0..vertices {
        let place = || element("vertex", index);
        lines.row(&mut row, 3, place)?;
        builder.vertex([row[0], row[1], row[2]].map(|number| number.value as f32), place)?;
        if kind.has_attributes() {
            corners_of_vertices.push(kind.corner(index, &row[3..]));
        }
    }
    let mut corners = Vec::new();
    for index in 0..faces {
        let place = || element("face", index);
        lines.row(&mut row, 1, place)?;
        let count = row[0].value;
        if count.fract() != 0.0 || !(0.0..=MAX_CORNERS).contains(&count) {
            return Err(request.invalid(place(), format!("a face of {count} corners")));
        }
        let count = count as usize;
        lines.complete(&mut row, count.saturating_add(1), place)?;
        let color = color(&row[count + 1..]);
        corners.clear();
        corners.extend(row[1..=count].iter().map(|number| {
            let vertex = if number.value.fract() == 0.0 { number.value as i64 } else { -1 };
            let known = usize::try_from(vertex).ok().and_then(|i| corners_of_vertices.get(i));
            let corner: Corner = known.copied().unwrap_or_default();
            Corner { vertex, color: corner.color.or(color), ..corner }
        }));
        builder.polygon(&corners, place)?;
    }
    Ok(builder.finish())
}

/// The most corners of a face.
const MAX_CORNERS: f64 = (1 << 26) as f64;

fn element(name: &str, index: u64) -> Place {
    Place::Element { name: name.to_owned(), index }
}

/// What the header says.
struct Kind {
    normals: bool,
    colors: bool,
    uvs: bool,
    counts: [u64; 2],
}

impl Kind {
    /// The keyword, which may be missing, and the counts of vertices, faces and (not used) edges.
    fn read(
        lines: &mut Lines<'_>,
        row: &mut Vec<Number>,
        request: &Request<'_>,
    ) -> Result<Self, LoadError> {
        if !lines.next()? {
            return Err(lines.scanner.error_in_line("an OFF file without content"));
        }
        let line = String::from_utf8_lossy(&lines.line).into_owned();
        let place = || Place::Line(lines.number);
        let (prefix, rest) = line.split_once("OFF").unwrap_or(("", &line));
        if !prefix.trim_start().chars().all(|letter| "STCN4n".contains(letter)) {
            return Err(request.invalid(place(), "not an OFF file"));
        }
        let unsupported = |what: &str| {
            let (file, what) = (request.file.to_owned(), what.to_owned());
            Err(LoadError::Unsupported { file, place: place(), what })
        };
        if rest.trim_start().starts_with("BINARY") {
            return unsupported("binary OFF");
        }
        if prefix.contains(['4', 'n']) {
            return unsupported("OFF of other than three dimensions");
        }
        lines.line = rest.as_bytes().to_vec();
        row.clear();
        lines.add_numbers(row)?;
        let header_at = Place::Line(lines.number);
        if row.is_empty() {
            lines.row(row, 2, || header_at.clone())?;
        }
        let count = |at: usize| {
            let whole = row.get(at).filter(|n| n.value.fract() == 0.0 && n.value >= 0.0);
            whole.map(|number| number.value as u64).ok_or_else(|| {
                request.invalid(Place::Line(lines.number), "not the counts of vertices and faces")
            })
        };
        let counts = [count(0)?, count(1)?];
        let has = |letters: &str| prefix.contains(letters);
        Ok(Self { normals: has("N"), colors: has("C"), uvs: has("ST"), counts })
    }

    fn has_attributes(&self) -> bool {
        self.normals || self.colors || self.uvs
    }

    /// What the numbers after a vertex's position say: normal, colour, texture coordinates.
    fn corner(&self, index: u64, mut rest: &[Number]) -> Corner {
        let mut corner = Corner { vertex: index as i64, ..Corner::default() };
        if self.normals && rest.len() >= 3 {
            corner.normal = Some([0, 1, 2].map(|i| rest[i].value as f32));
            rest = &rest[3..];
        }
        let uvs = if self.uvs { 2 } else { 0 };
        if self.uvs && rest.len() >= 2 {
            let uv = &rest[rest.len() - 2..];
            corner.uv = Some([uv[0].value as f32, 1.0 - uv[1].value as f32]);
        }
        if self.colors {
            corner.color = color(&rest[..rest.len().saturating_sub(uvs)]);
        }
        corner
    }
}

/// A colour of three or four channels, 0 to 255 if all are integers, else 0 to 1, in sRGB. One
/// number alone is an index into a table that is not in the file.
fn color(numbers: &[Number]) -> Option<[f32; 3]> {
    if !(3..=4).contains(&numbers.len()) {
        return None;
    }
    let unit = if numbers.iter().all(|number| number.is_integer) { 255.0 } else { 1.0 };
    Some([0, 1, 2].map(|i| crate::srgb::to_linear(numbers[i].value as f32 / unit)))
}

#[derive(Clone, Copy)]
struct Number {
    value: f64,
    /// It was written as one.
    is_integer: bool,
}

/// Lines that hold something besides comments.
struct Lines<'a> {
    scanner: Scanner<'a>,
    line: Vec<u8>,
    number: u64,
}

impl Lines<'_> {
    /// Goes to the next line; false at the end of the file.
    fn next(&mut self) -> Result<bool, LoadError> {
        loop {
            self.number = self.scanner.line_number();
            if !self.scanner.line(&mut self.line)? {
                return Ok(false);
            }
            let comment = self.line.iter().position(|&byte| byte == b'#');
            self.line.truncate(comment.unwrap_or(self.line.len()));
            if !self.line.trim_ascii().is_empty() {
                return Ok(true);
            }
        }
    }

    fn add_numbers(&mut self, row: &mut Vec<Number>) -> Result<(), LoadError> {
        for word in self.line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()) {
            let Some(value) = crate::number::parse(word) else {
                let word = String::from_utf8_lossy(word);
                let place = Place::Line(self.number);
                return Err(self.scanner.error_at(place, format!("{word:?} is no number")));
            };
            let is_integer = word.iter().all(u8::is_ascii_digit);
            row.push(Number { value, is_integer });
        }
        Ok(())
    }

    /// The numbers of the next line, and of more lines if they are fewer than `least`.
    fn row(
        &mut self,
        row: &mut Vec<Number>,
        least: usize,
        place: impl Fn() -> Place,
    ) -> Result<(), LoadError> {
        row.clear();
        self.complete(row, least, place)
    }

    fn complete(
        &mut self,
        row: &mut Vec<Number>,
        least: usize,
        place: impl Fn() -> Place,
    ) -> Result<(), LoadError> {
        while row.len() < least {
            if !self.next()? {
                return Err(self.scanner.error_at(place(), "the file ends too early"));
            }
            self.add_numbers(row)?;
        }
        Ok(())
    }
}
