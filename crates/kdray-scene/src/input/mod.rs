//! Bytes on their way in: decompression, limits, words and lines.

mod decompress;
mod limit;
mod scanner;
mod siblings;
mod utf16;

pub(crate) use decompress::{decompressed, peek};
pub(crate) use limit::Limited;
pub(crate) use scanner::Scanner;
pub(crate) use siblings::{Siblings, read_file};
pub(crate) use utf16::utf8;
