//! Wavefront OBJ (Advanced Visualizer manual, appendix B1) with MTL materials.
//!
//! Read by hand: `tobj` gives each combination of position, normal and texture coordinate a vertex
//! of its own or keeps lists a group, knows no places for its messages, and stops at UTF-16.

mod faces;
mod libraries;
mod maps;
mod material;
mod materials;
mod mtl;

use super::Request;
use crate::input::{Scanner, utf8};
use crate::mesh::MeshBuilder;
use crate::{LoadError, Model, Place, number};
use faces::Faces;
use materials::Materials;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::Read;

pub(super) fn read(
    bytes: Box<dyn Read + '_>,
    start: &[u8],
    request: &Request<'_>,
) -> Result<Model, LoadError> {
    let bytes = utf8(bytes, start).map_err(|error| request.read_error(error))?;
    let mut lines =
        Lines { scanner: Scanner::new(bytes, request), line: Vec::new(), more: Vec::new() };
    let mut reader = Reader {
        request,
        builder: MeshBuilder::new(request),
        faces: Faces::default(),
        materials: Materials::default(),
        ignored: BTreeMap::new(),
        odd_numbers: 0,
    };
    reader.builder.first_index = 1;
    while let Some((line, text)) = lines.next()? {
        reader.statement(line, &text)?;
    }
    reader.finish()
}

/// Lines, joined where they end in a backslash.
struct Lines<'a> {
    scanner: Scanner<'a>,
    line: Vec<u8>,
    /// The line to be joined.
    more: Vec<u8>,
}

/// The longest line after joining.
const MAX_JOINED: usize = 64 << 20;

impl Lines<'_> {
    /// The next line and its number.
    fn next(&mut self) -> Result<Option<(u64, Cow<'_, str>)>, LoadError> {
        let number = self.scanner.line_number();
        if !self.scanner.line(&mut self.line)? {
            return Ok(None);
        }
        let mut last = 0;
        while goes_on(&self.line[last..]) {
            self.line.pop();
            self.line.push(b' ');
            if self.line.len() > MAX_JOINED {
                return Err(self.scanner.error_in_line("lines joined without end"));
            }
            if !self.scanner.line(&mut self.more)? {
                break;
            }
            last = self.line.len();
            self.line.append(&mut self.more);
        }
        Ok(Some((number, String::from_utf8_lossy(&self.line))))
    }
}

/// A backslash joins the next line, but not one in a comment, such as `# made in C:\models\`.
fn goes_on(line: &[u8]) -> bool {
    line.last() == Some(&b'\\') && !line.contains(&b'#')
}

/// Points, lines, free-form curves and surfaces, and settings of old programs.
const IGNORED: &str = "p l vp deg bmat step cstype curv curv2 surf parm trim hole scrv sp end con \
    mg bevel c_interp d_interp lod usemap maplib shadow_obj trace_obj ctech stech bsp bzp cdc cdp \
    res call csh scmp matlib vcn vc";

struct Reader<'a> {
    request: &'a Request<'a>,
    builder: MeshBuilder<'a>,
    faces: Faces,
    materials: Materials,
    /// How often each statement that is passed over was met.
    ignored: BTreeMap<String, u64>,
    odd_numbers: u64,
}

impl Reader<'_> {
    fn statement(&mut self, line: u64, text: &str) -> Result<(), LoadError> {
        let text = text.trim_matches(|c: char| c.is_whitespace() || c == '\0');
        let (keyword, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
        match keyword {
            "v" => self.vertex(line, rest)?,
            "vn" => {
                let normal = self.numbers::<3>(line, without_comment(rest))?.0;
                self.faces.normals.push(normal);
            }
            "vt" => {
                let words = without_comment(rest);
                // A second coordinate may be missing, and a third one is for volumes.
                let [u, v] = match words.split_whitespace().nth(1) {
                    Some(_) => self.numbers::<2>(line, words)?.0,
                    None => [self.numbers::<1>(line, words)?.0[0], 0.0],
                };
                self.faces.uvs.push([u, 1.0 - v]);
            }
            "f" | "fo" => {
                self.faces.add(line, without_comment(rest), &mut self.builder, self.request)?;
            }
            "usemtl" => self.builder.material = Some(self.materials.id(rest.trim())),
            "mtllib" => self.materials.libraries.push((line, rest.trim().to_owned())),
            "" | "o" | "g" | "s" => {}
            _ if keyword.starts_with('#') => {}
            _ if IGNORED.split(' ').any(|ignored| ignored == keyword) => {
                *self.ignored.entry(keyword.to_owned()).or_default() += 1;
            }
            _ => {
                let keyword: String = keyword.chars().take(40).collect();
                let reason = format!("{keyword:?} is no statement of OBJ");
                return Err(self.request.invalid(Place::Line(line), reason));
            }
        }
        Ok(())
    }

    /// A position, with or without a weight (not used), with or without a colour.
    fn vertex(&mut self, line: u64, rest: &str) -> Result<(), LoadError> {
        let words = without_comment(rest);
        let (position, count) = self.numbers::<3>(line, words)?;
        if count >= 6 {
            let color = self.numbers::<6>(line, words)?.0;
            let color = [color[3], color[4], color[5]].map(crate::srgb::to_linear);
            // Vertices before the first coloured one are white.
            self.faces.colors.resize(self.builder.model.vertices.len(), [1.0; 3]);
            self.faces.colors.push(color);
        }
        self.builder.vertex(position, || Place::Line(line))?;
        Ok(())
    }

    /// The first N numbers, and how many words there are.
    fn numbers<const N: usize>(
        &mut self,
        line: u64,
        text: &str,
    ) -> Result<([f32; N], usize), LoadError> {
        let mut words = text.split_whitespace();
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            let word = words.next().unwrap_or_default();
            *number = match number::parse(word.as_bytes()) {
                Some(value) => value as f32,
                None => self.odd_number(line, word)?,
            };
        }
        Ok((numbers, N + words.count()))
    }

    /// The number that a word begins with, as C programs read it.
    fn odd_number(&mut self, line: u64, word: &str) -> Result<f32, LoadError> {
        self.odd_numbers += 1;
        number::parse_start(word).map(|value| value as f32).ok_or_else(|| {
            let word: String = word.chars().take(40).collect();
            let reason = match word.as_str() {
                "" => "a number is missing".to_owned(),
                word => format!("{word:?} is no number"),
            };
            self.request.invalid(Place::Line(line), reason)
        })
    }

    fn finish(mut self) -> Result<Model, LoadError> {
        self.faces.finish(&mut self.builder)?;
        self.materials.finish(&mut self.builder, self.request);
        if self.odd_numbers > 0 {
            let count = self.odd_numbers;
            self.builder.warn(format!("{count} numbers read only up to their first odd letter"));
        }
        if !self.ignored.is_empty() {
            let list: Vec<String> =
                self.ignored.iter().map(|(keyword, count)| format!("{count} {keyword}")).collect();
            self.builder.warn(format!("statements passed over: {}", list.join(", ")));
        }
        Ok(self.builder.finish())
    }
}

fn without_comment(text: &str) -> &str {
    text.split('#').next().unwrap_or_default()
}
