//! Text in UTF-16 as UTF-8.

use std::collections::VecDeque;
use std::io::{self, ErrorKind, Read};

/// The text as UTF-8 without a byte order mark, by which UTF-16 is known. `start` are its first
/// bytes.
pub(crate) fn utf8<'a>(
    mut bytes: Box<dyn Read + 'a>,
    start: &[u8],
) -> io::Result<Box<dyn Read + 'a>> {
    let big_endian = match start {
        [0xef, 0xbb, 0xbf, ..] => {
            bytes.read_exact(&mut [0; 3])?;
            return Ok(bytes);
        }
        [0xfe, 0xff, ..] => true,
        [0xff, 0xfe, ..] => false,
        _ => return Ok(bytes),
    };
    bytes.read_exact(&mut [0; 2])?;
    let bytes = io::BufReader::new(bytes);
    Ok(Box::new(Utf16 { bytes, big_endian, ahead: None, ready: VecDeque::new() }))
}

struct Utf16<R> {
    bytes: R,
    big_endian: bool,
    /// A unit read ahead, because the one before it was half a pair without the other half.
    ahead: Option<u16>,
    /// UTF-8 that the reader has not taken yet.
    ready: VecDeque<u8>,
}

impl<R: Read> Utf16<R> {
    /// The next unit; half a unit at the end becomes the replacement character.
    fn unit(&mut self) -> io::Result<Option<u16>> {
        if let Some(unit) = self.ahead.take() {
            return Ok(Some(unit));
        }
        let mut pair = [0; 2];
        match self.bytes.read_exact(&mut pair) {
            Ok(()) if self.big_endian => Ok(Some(u16::from_be_bytes(pair))),
            Ok(()) => Ok(Some(u16::from_le_bytes(pair))),
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => Ok(None),
            Err(error) => Err(error),
        }
    }

    fn character(&mut self) -> io::Result<Option<char>> {
        let Some(first) = self.unit()? else { return Ok(None) };
        if !(0xd800..0xe000).contains(&first) {
            return Ok(char::from_u32(u32::from(first)));
        }
        let second = self.unit()?;
        let pair = char::decode_utf16([first].into_iter().chain(second)).next();
        if let Some(Ok(character)) = pair {
            return Ok(Some(character));
        }
        self.ahead = second;
        Ok(Some(char::REPLACEMENT_CHARACTER))
    }
}

impl<R: Read> Read for Utf16<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        while self.ready.len() < buffer.len().min(4096) {
            let Some(character) = self.character()? else { break };
            self.ready.extend(character.encode_utf8(&mut [0; 4]).as_bytes());
        }
        self.ready.read(buffer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(bytes: &[u8]) -> String {
        let mut out = String::new();
        utf8(Box::new(bytes), bytes).unwrap().read_to_string(&mut out).unwrap();
        out
    }

    #[test]
    fn byte_order_marks_tell_the_encoding() {
        let original = "v 1 2\r\näöü 𝄞 end".repeat(1000);
        let units = || [0xfeff].into_iter().chain(original.encode_utf16());
        assert_eq!(text(&units().flat_map(u16::to_be_bytes).collect::<Vec<_>>()), original);
        assert_eq!(text(&units().flat_map(u16::to_le_bytes).collect::<Vec<_>>()), original);
        assert_eq!(text(format!("\u{feff}{original}").as_bytes()), original);
        assert_eq!(text(original.as_bytes()), original);
    }

    #[test]
    fn broken_pairs_are_replaced() {
        assert_eq!(text(&[0xfe, 0xff, 0xd8, 0x34, 0, b'x', 0]), "\u{fffd}x");
    }
}
