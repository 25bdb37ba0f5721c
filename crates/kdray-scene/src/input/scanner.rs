//! Words, lines and binary numbers from a stream, with the place for messages.

use crate::formats::Request;
use crate::{LoadError, Place};
use std::io::Read;

/// A buffered reader that knows where it is.
pub(crate) struct Scanner<'a> {
    source: Box<dyn Read + 'a>,
    request: &'a Request<'a>,
    buffer: Box<[u8]>,
    /// What is buffered and not taken yet.
    start: usize,
    end: usize,
    /// Where `buffer[0]` is in the file.
    base: u64,
    line: u64,
}

/// The longest line that is taken for one.
const MAX_LINE: usize = 16 << 20;
/// The longest word that is taken for one.
const MAX_WORD: usize = 4096;

impl<'a> Scanner<'a> {
    pub(crate) fn new(source: Box<dyn Read + 'a>, request: &'a Request<'a>) -> Self {
        let buffer = vec![0; 1 << 16].into_boxed_slice();
        Self { source, request, buffer, start: 0, end: 0, base: 0, line: 1 }
    }

    /// The line that the next byte is in.
    pub(crate) fn line_number(&self) -> u64 {
        self.line
    }

    /// The place of the next byte.
    pub(crate) fn byte(&self) -> u64 {
        self.base + self.start as u64
    }

    /// An error in the present line.
    pub(crate) fn error_in_line(&self, reason: impl Into<String>) -> LoadError {
        LoadError::invalid(self.request.file, Place::Line(self.line), reason)
    }

    /// An error in the line that `line` has read.
    pub(crate) fn error_in_previous_line(&self, reason: impl Into<String>) -> LoadError {
        self.error_at(Place::Line(self.line.saturating_sub(1)), reason)
    }

    /// An error at a place of the caller's own.
    pub(crate) fn error_at(&self, place: Place, reason: impl Into<String>) -> LoadError {
        LoadError::invalid(self.request.file, place, reason)
    }

    /// An error at the next byte.
    pub(crate) fn error_at_byte(&self, reason: impl Into<String>) -> LoadError {
        LoadError::invalid(self.request.file, Place::Byte(self.byte()), reason)
    }

    /// Moves what is left to the front of the buffer and adds to it; false at the end of the file.
    fn fill(&mut self) -> Result<bool, LoadError> {
        self.buffer.copy_within(self.start..self.end, 0);
        self.base += self.start as u64;
        (self.start, self.end) = (0, self.end - self.start);
        loop {
            match self.source.read(&mut self.buffer[self.end..]) {
                Ok(got) => {
                    self.end += got;
                    return Ok(got > 0);
                }
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
                Err(error) => return Err(self.request.read_error(error)),
            }
        }
    }

    /// The next byte, left in place; none at the end of the file.
    #[inline]
    pub(crate) fn peek(&mut self) -> Result<Option<u8>, LoadError> {
        if self.start == self.end && !self.fill()? {
            return Ok(None);
        }
        Ok(Some(self.buffer[self.start]))
    }

    /// Takes the byte that `peek` showed.
    #[inline]
    fn bump(&mut self, byte: u8) {
        self.start += 1;
        self.line += u64::from(byte == b'\n');
    }

    /// The next N bytes.
    #[inline]
    pub(crate) fn array<const N: usize>(&mut self) -> Result<[u8; N], LoadError> {
        while self.end - self.start < N {
            if !self.fill()? {
                self.start = self.end;
                return Err(self.error_at_byte("the file ends too early"));
            }
        }
        let mut array = [0; N];
        array.copy_from_slice(&self.buffer[self.start..self.start + N]);
        self.start += N;
        Ok(array)
    }

    /// Takes blanks and line ends.
    pub(crate) fn skip_whitespace(&mut self) -> Result<(), LoadError> {
        while let Some(byte) = self.peek()? {
            if !byte.is_ascii_whitespace() && byte != 0x0b {
                break;
            }
            self.bump(byte);
        }
        Ok(())
    }

    /// The next word between blanks or line ends into `word`; false at the end of the file.
    pub(crate) fn word(&mut self, word: &mut Vec<u8>) -> Result<bool, LoadError> {
        word.clear();
        self.skip_whitespace()?;
        while let Some(byte) = self.peek()? {
            if byte.is_ascii_whitespace() || byte == 0x0b {
                break;
            }
            if word.len() == MAX_WORD {
                return Err(self.error_in_line("a word without end"));
            }
            word.push(byte);
            self.bump(byte);
        }
        Ok(!word.is_empty())
    }

    /// The rest of the line into `line`, without its end (LF, CR LF, or CR); false at the end of
    /// the file.
    pub(crate) fn line(&mut self, line: &mut Vec<u8>) -> Result<bool, LoadError> {
        line.clear();
        let mut any = false;
        while let Some(byte) = self.peek()? {
            any = true;
            if byte == b'\n' {
                self.bump(byte);
                break;
            }
            if byte == b'\r' {
                self.start += 1;
                if self.peek()? == Some(b'\n') {
                    self.start += 1;
                }
                self.line += 1;
                break;
            }
            if line.len() > MAX_LINE {
                return Err(self.error_in_line("a line without end"));
            }
            let rest = &self.buffer[self.start..self.end];
            let end = rest.iter().position(|&byte| byte == b'\n' || byte == b'\r');
            let end = end.unwrap_or(rest.len());
            line.extend_from_slice(&rest[..end]);
            self.start += end;
        }
        Ok(any)
    }
}
