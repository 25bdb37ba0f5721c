//! Decompression, chosen by the magic numbers of gzip (RFC 1952) and Zstandard (RFC 8878).

use flate2::read::MultiGzDecoder;
use ruzstd::decoding::errors::{FrameDecoderError, ReadFrameHeaderError};
use ruzstd::decoding::{FrameDecoder, StreamingDecoder};
use std::io::{self, BufRead, BufReader, Cursor, ErrorKind, Read};

const GZIP: [u8; 2] = [0x1f, 0x8b];
const ZSTD: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];

/// The first bytes (`count`, or all if fewer), and a reader of everything including them.
pub(crate) fn peek<'a>(
    mut bytes: Box<dyn Read + 'a>,
    count: usize,
) -> io::Result<(Vec<u8>, Box<dyn Read + 'a>)> {
    let mut start = Vec::new();
    bytes.by_ref().take(count as u64).read_to_end(&mut start)?;
    let whole = Box::new(Cursor::new(start.clone()).chain(bytes));
    Ok((start, whole))
}

/// The bytes decompressed if they are compressed, else as they are.
pub(crate) fn decompressed<'a>(bytes: Box<dyn Read + 'a>) -> io::Result<Box<dyn Read + 'a>> {
    let (start, bytes) = peek(bytes, ZSTD.len())?;
    if start.starts_with(&ZSTD) {
        Ok(Box::new(ZstdFrames { next: Some(BufReader::new(bytes)), frame: None }))
    } else if start.starts_with(&GZIP) {
        Ok(Box::new(MultiGzDecoder::new(bytes)))
    } else {
        Ok(bytes)
    }
}

/// All frames of a Zstandard file, one after the other, as the format allows and as parallel
/// compressors write; the library's decoder reads one.
struct ZstdFrames<R: Read> {
    /// The input between frames.
    next: Option<BufReader<R>>,
    /// The frame being read.
    frame: Option<StreamingDecoder<BufReader<R>, FrameDecoder>>,
}

impl<R: Read> ZstdFrames<R> {
    /// Opens the next frame; false at the end of the input.
    fn open_frame(&mut self) -> io::Result<bool> {
        let Some(mut input) = self.next.take() else { return Ok(false) };
        if input.fill_buf()?.is_empty() {
            return Ok(false);
        }
        if let Some(length) = skippable_frame(&mut input)? {
            io::copy(&mut input.by_ref().take(length), &mut io::sink())?;
            self.next = Some(input);
            return Ok(true);
        }
        self.frame = Some(StreamingDecoder::new(input).map_err(describe)?);
        Ok(true)
    }
}

/// Passes over the header of a skippable frame, if one is next, and tells its length.
fn skippable_frame<R: Read>(input: &mut BufReader<R>) -> io::Result<Option<u64>> {
    // The magic numbers of skippable frames are 0x184d2a50 to 0x184d2a5f in little endian.
    if input.fill_buf()?.first().is_none_or(|byte| byte & 0xf0 != 0x50) {
        return Ok(None);
    }
    let mut header = [0; 8];
    input.read_exact(&mut header)?;
    if header[1..4] != [0x2a, 0x4d, 0x18] {
        return Err(io::Error::new(ErrorKind::InvalidData, "not a Zstandard frame"));
    }
    Ok(Some(u64::from(u32::from_le_bytes([header[4], header[5], header[6], header[7]]))))
}

fn describe(error: FrameDecoderError) -> io::Error {
    let kind = match error {
        FrameDecoderError::ReadFrameHeaderError(ReadFrameHeaderError::MagicNumberReadError(_)) => {
            ErrorKind::UnexpectedEof
        }
        _ => ErrorKind::InvalidData,
    };
    io::Error::new(kind, format!("Zstandard: {error}"))
}

impl<R: Read> Read for ZstdFrames<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if buffer.is_empty() {
            return Ok(0);
        }
        loop {
            if let Some(frame) = &mut self.frame {
                let got = frame.read(buffer)?;
                if got > 0 {
                    return Ok(got);
                }
            }
            if let Some(finished) = self.frame.take() {
                let (input, decoder) = finished.into_parts();
                let stated = decoder.get_checksum_from_data();
                if stated.is_some() && stated != decoder.get_calculated_checksum() {
                    return Err(io::Error::new(
                        ErrorKind::InvalidData,
                        "Zstandard: wrong checksum",
                    ));
                }
                self.next = Some(input);
            }
            if !self.open_frame()? {
                return Ok(0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    fn all(bytes: &[u8]) -> io::Result<Vec<u8>> {
        let mut out = Vec::new();
        decompressed(Box::new(bytes))?.read_to_end(&mut out)?;
        Ok(out)
    }

    fn zstd(bytes: &[u8]) -> Vec<u8> {
        ruzstd::encoding::compress_to_vec(bytes, ruzstd::encoding::CompressionLevel::Fastest)
    }

    #[test]
    fn plain_gzip_and_zstandard_read_alike() {
        let text = b"one two three ".repeat(1000);
        let mut gzip = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
        gzip.write_all(&text).unwrap();
        let gzip = gzip.finish().unwrap();
        assert_eq!(all(&text).unwrap(), text);
        assert_eq!(all(&gzip).unwrap(), text);
        assert_eq!(all(&zstd(&text)).unwrap(), text);
        assert_eq!(all(b"").unwrap(), b"");
    }

    #[test]
    fn frames_follow_each_other() {
        let skippable = [0x5a, 0x2a, 0x4d, 0x18, 3, 0, 0, 0, 9, 9, 9];
        let joined = [zstd(b"first "), skippable.to_vec(), zstd(b"second")].concat();
        assert_eq!(all(&joined).unwrap(), b"first second");
        assert!(all(&joined[..joined.len() - 4]).is_err(), "the last frame is cut");
    }
}
