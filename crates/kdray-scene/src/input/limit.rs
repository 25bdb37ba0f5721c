//! A reader that ends with an error where its input is too long.

use std::io::{self, ErrorKind, Read};

/// Passes on at most so many bytes; input that goes on is an error of kind `FileTooLarge`.
pub(crate) struct Limited<R> {
    inner: R,
    left: u64,
}

impl<R: Read> Limited<R> {
    pub(crate) fn new(inner: R, limit: u64) -> Self {
        Self { inner, left: limit }
    }
}

impl<R: Read> Read for Limited<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.left == 0 {
            let mut one_more = [0];
            return match self.inner.read(&mut one_more)? {
                0 => Ok(0),
                _ => Err(ErrorKind::FileTooLarge.into()),
            };
        }
        let room = usize::try_from(self.left).unwrap_or(usize::MAX).min(buffer.len());
        let got = self.inner.read(&mut buffer[..room])?;
        self.left -= got as u64;
        Ok(got)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_long_as_the_limit_is_not_too_long() {
        let mut out = Vec::new();
        assert_eq!(Limited::new(&b"12345"[..], 5).read_to_end(&mut out).unwrap(), 5);
        let error = Limited::new(&b"12345"[..], 4).read_to_end(&mut out).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::FileTooLarge);
        let endless = Limited::new(io::repeat(0), 1000).read_to_end(&mut out).unwrap_err();
        assert_eq!(endless.kind(), ErrorKind::FileTooLarge);
    }
}
