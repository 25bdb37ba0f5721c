//! A guard against lines without end.

use std::io::{self, Read};

/// Passes bytes on, but not a line longer than `limit`: who collects a line to parse it would take
/// memory without bound.
pub(super) struct ShortLines<R> {
    inner: R,
    limit: usize,
    /// Bytes since the last line feed.
    length: usize,
}

impl<R: Read> ShortLines<R> {
    pub(super) fn new(inner: R, limit: usize) -> Self {
        Self { inner, limit, length: 0 }
    }
}

impl<R: Read> Read for ShortLines<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        // No read spans more than one limit, so that none hides a long line.
        let room = buffer.len().min(self.limit);
        let count = self.inner.read(&mut buffer[..room])?;
        self.length = match buffer[..count].iter().rposition(|&byte| byte == b'\n') {
            Some(place) => count - place - 1,
            None => self.length + count,
        };
        if self.length > self.limit {
            let reason = format!("a line of more than {} bytes is no ray", self.limit);
            return Err(io::Error::new(io::ErrorKind::InvalidData, reason));
        }
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_lines_without_end_are_refused() {
        let lines = "12345\n".repeat(1000);
        let mut text = String::new();
        assert_eq!(ShortLines::new(lines.as_bytes(), 10).read_to_string(&mut text).unwrap(), 6000);
        let error = ShortLines::new(io::repeat(b'1'), 10).read_to_string(&mut text).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::InvalidData);
    }
}
