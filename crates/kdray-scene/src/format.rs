//! Telling formats apart.

/// A format of mesh files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ, with its MTL materials.
    Obj,
    /// The Stanford polygon format, ASCII or binary.
    Ply,
    /// Stereolithography, ASCII or binary.
    Stl,
    /// The object file format of Geomview.
    Off,
    /// glTF 2.0, as JSON or as GLB; the content tells which.
    Gltf,
}

impl Format {
    /// The format that a file name's ending tells, in any case, after `.gz` or `.zst` is taken off.
    pub fn from_name(name: &str) -> Option<Self> {
        let name = name.to_ascii_lowercase();
        let plain = name.strip_suffix(".gz").or_else(|| name.strip_suffix(".zst")).unwrap_or(&name);
        match plain.rsplit_once('.')?.1 {
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "stl" => Some(Self::Stl),
            "off" => Some(Self::Off),
            "gltf" | "glb" => Some(Self::Gltf),
            _ => None,
        }
    }

    /// The format that the first bytes of a decompressed file look like. A few hundred are enough.
    pub fn from_content(start: &[u8]) -> Option<Self> {
        let text = start.trim_ascii_start();
        let begins = |word: &str| {
            text.get(..word.len()).is_some_and(|bytes| bytes.eq_ignore_ascii_case(word.as_bytes()))
        };
        if start.starts_with(b"ply") && text.get(3).is_some_and(u8::is_ascii_whitespace) {
            Some(Self::Ply)
        } else if start.starts_with(b"glTF") || text.starts_with(b"{") {
            Some(Self::Gltf)
        } else if begins("solid") {
            Some(Self::Stl)
        } else if looks_like_off(text) {
            Some(Self::Off)
        } else if looks_like_obj(start) {
            Some(Self::Obj)
        } else if start.len() >= 84 && start.contains(&0) {
            Some(Self::Stl)
        } else {
            None
        }
    }
}

/// The first word is OFF with the prefixes that say what a vertex has.
fn looks_like_off(text: &[u8]) -> bool {
    let word = text.split(u8::is_ascii_whitespace).next().unwrap_or_default();
    let prefix = word.strip_suffix(b"OFF").map(|p| p.strip_prefix(b"ST").unwrap_or(p));
    prefix.is_some_and(|letters| letters.iter().all(|c| b"CN4n".contains(c)))
}

/// Text, in UTF-8 or UTF-16, some line of which begins with an OBJ keyword.
fn looks_like_obj(start: &[u8]) -> bool {
    const KEYWORDS: [&[u8]; 10] =
        [b"v", b"vn", b"vt", b"f", b"g", b"o", b"s", b"mtllib", b"usemtl", b"l"];
    let utf16 = start.starts_with(&[0xfe, 0xff]) || start.starts_with(&[0xff, 0xfe]);
    let start = if utf16 { &start[2..] } else { start };
    let text: Vec<u8> = start.iter().copied().filter(|&byte| !utf16 || byte != 0).collect();
    !text.contains(&0)
        && text.split(|&byte| byte == b'\n' || byte == b'\r').any(|line| {
            let line = line.trim_ascii_start();
            KEYWORDS.iter().any(|keyword| {
                line.strip_prefix(*keyword).is_some_and(|rest| {
                    rest.first().is_some_and(|byte| *byte == b' ' || *byte == b'\t')
                })
            })
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_the_format() {
        assert_eq!(Format::from_name("a/b.PLY.zst"), Some(Format::Ply));
        assert_eq!(Format::from_name("b.stl.gz"), Some(Format::Stl));
        assert_eq!(Format::from_name("x.y.GLB"), Some(Format::Gltf));
        assert_eq!(Format::from_name("noise.zst"), None);
        assert_eq!(Format::from_name("-"), None);
    }

    #[test]
    fn content_tells_the_format() {
        let cases: [(&[u8], Option<Format>); 10] = [
            (b"ply\r\nformat ascii 1.0", Some(Format::Ply)),
            (b"glTF\x02\0\0\0", Some(Format::Gltf)),
            (b" {\"asset\":{}}", Some(Format::Gltf)),
            (b"SOLID x\nfacet", Some(Format::Stl)),
            (b"COFF\n3 1 0", Some(Format::Off)),
            (b"# a comment\nmtllib x.mtl\n", Some(Format::Obj)),
            (b"\xff\xfev\0 \x001\0", Some(Format::Obj)),
            (&[0; 84], Some(Format::Stl)),
            (b"", None),
            (b"hello, world", None),
        ];
        for (start, format) in cases {
            assert_eq!(Format::from_content(start), format, "{start:?}");
        }
    }
}
