//! The header of a PLY file.

use super::Encoding;
use crate::cut::cut;
use crate::input::Scanner;
use crate::{LoadError, Place};

/// What a file says that it holds.
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    pub(super) textures: Textures,
}

/// The images that texture coordinates belong to, from comments that MeshLab writes.
#[derive(Default)]
pub(super) struct Textures {
    pub(super) first: Option<String>,
    /// The names of some others, as messages have them.
    pub(super) others: Vec<String>,
    /// How many comments there are besides.
    pub(super) more: u64,
}

/// A list of like things, such as the vertices.
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

/// A value, or a list of them, that each thing of an element has.
pub(super) struct Property {
    pub(super) name: String,
    /// The type of a list's length; none for a single value.
    pub(super) length: Option<Scalar>,
    pub(super) scalar: Scalar,
}

/// The types of values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// More textures than this are counted, and not named.
const MAX_OTHER_TEXTURES: usize = 16;

/// More properties or elements than this make no sense.
const MAX_DECLARATIONS: usize = 4096;

impl Header {
    pub(super) fn read(scanner: &mut Scanner<'_>) -> Result<Self, LoadError> {
        let mut draft = Draft::default();
        let mut bytes = Vec::new();
        for number in 0..=MAX_DECLARATIONS {
            if !scanner.line(&mut bytes)? {
                return Err(scanner.error_in_line("the file ends within its header"));
            }
            let fail = |reason: &str| scanner.error_in_previous_line(reason);
            let line = String::from_utf8_lossy(&bytes);
            let words: Vec<&str> = line.split_ascii_whitespace().collect();
            match words.as_slice() {
                ["ply"] if number == 0 => {}
                _ if number == 0 => {
                    return Err(fail("not a PLY file: it does not begin with the line `ply`"));
                }
                ["end_header"] => return draft.finish().map_err(fail),
                words => draft.add(words, &line).map_err(fail)?,
            }
        }
        Err(scanner.error_in_previous_line("a header of too many lines"))
    }
}

/// What the lines so far say.
#[derive(Default)]
struct Draft {
    encoding: Option<Encoding>,
    elements: Vec<Element>,
    textures: Textures,
}

impl Draft {
    /// Adds a line, or says what is wrong with it.
    fn add(&mut self, words: &[&str], line: &str) -> Result<(), &'static str> {
        match words {
            ["comment", "TextureFile", ..] => {
                let name = line.split_once("TextureFile").map_or("", |(_, name)| name.trim());
                self.textures.add(name);
            }
            [] | ["comment" | "obj_info", ..] => {}
            ["format", name, _version] => {
                let named = Encoding::from_name(name);
                self.encoding =
                    Some(named.ok_or("an unknown format; known are ascii and binary ones")?);
            }
            ["element", name, count] => {
                let count = count.parse().map_err(|_| "the count of an element is no number")?;
                let properties = Vec::new();
                self.elements.push(Element { name: (*name).to_owned(), count, properties });
            }
            ["property", rest @ ..] => {
                let property = Property::from_words(rest).ok_or("a property of an unknown type")?;
                let element = self.elements.last_mut().ok_or("a property before any element")?;
                element.properties.push(property);
            }
            _ => return Err("not a header line"),
        }
        Ok(())
    }

    fn finish(self) -> Result<Header, &'static str> {
        let encoding = self.encoding.ok_or("the header has no format line")?;
        Ok(Header { encoding, elements: self.elements, textures: self.textures })
    }
}

impl Textures {
    fn add(&mut self, name: &str) {
        let Some(first) = &self.first else {
            self.first = Some(name.to_owned());
            return;
        };
        let other = cut(name);
        if name == first || self.others.iter().any(|known| *known == other) {
            return;
        }
        if self.others.len() < MAX_OTHER_TEXTURES {
            self.others.push(other.into_owned());
        } else {
            self.more += 1;
        }
    }
}

impl Property {
    fn from_words(words: &[&str]) -> Option<Self> {
        let (length, scalar, name) = match words {
            ["list", length, scalar, name] => (Some(Scalar::from_name(length)?), scalar, name),
            [scalar, name] => (None, scalar, name),
            _ => return None,
        };
        Some(Self { name: (*name).to_owned(), length, scalar: Scalar::from_name(scalar)? })
    }
}

impl Scalar {
    fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// What stands for 1 where a value from 0 to 1 is stored in this type.
    fn unit(self) -> f32 {
        match self {
            Self::I8 => 127.0,
            Self::U8 => 255.0,
            Self::I16 => 32_767.0,
            Self::U16 => 65_535.0,
            Self::I32 | Self::U32 => 255.0,
            Self::F32 | Self::F64 => 1.0,
        }
    }
}

impl Element {
    /// One of its things, for messages.
    pub(super) fn place(&self, index: u64) -> Place {
        Place::Element { name: self.name.clone(), index }
    }

    /// Where the single values of these names are among the element's single values.
    pub(super) fn scalars<const N: usize>(&self, names: &[&str; N]) -> Option<[usize; N]> {
        let scalars = || self.properties.iter().filter(|property| property.length.is_none());
        let mut found = [0; N];
        for (slot, name) in found.iter_mut().zip(names) {
            *slot = scalars().position(|property| property.name == *name)?;
        }
        Some(found)
    }

    /// Where the list of one of these names is among the element's lists.
    pub(super) fn list(&self, names: &[&str]) -> Option<usize> {
        let mut lists = self.properties.iter().filter(|property| property.length.is_some());
        lists.position(|property| names.contains(&property.name.as_str()))
    }

    /// Where the colour is, and the value of a full channel.
    pub(super) fn color(&self) -> Option<([usize; 3], f32)> {
        let names = [
            ["red", "green", "blue"],
            ["diffuse_red", "diffuse_green", "diffuse_blue"],
            ["r", "g", "b"],
        ];
        let names = names.iter().find(|names| self.scalars(names).is_some())?;
        let red = self.properties.iter().find(|property| property.name == names[0])?;
        Some((self.scalars(names)?, red.scalar.unit()))
    }
}
