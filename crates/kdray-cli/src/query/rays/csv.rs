//! Rays from lines of numbers with commas.

use super::{super::RaysError, ray_of};
use kdray::Ray;
use std::io::{BufRead, Read};

/// No line of eight numbers needs more bytes; one without end would take memory without bound.
const MAX_LINE: usize = 1 << 16;

/// Rays from lines of 6 or 8 numbers. Empty lines, and those that begin with `#`, are passed over,
/// and so is a first line of names.
pub(crate) struct CsvRays {
    source: Box<dyn BufRead>,
    /// The line that was read last, from 1.
    line: u64,
    text: Vec<u8>,
    /// Numbers in a line, once that is known.
    columns: Option<usize>,
    may_be_heading: bool,
}

impl CsvRays {
    pub(super) fn new(source: Box<dyn BufRead>) -> Self {
        Self { source, line: 0, text: Vec::new(), columns: None, may_be_heading: true }
    }

    pub(super) fn read(&mut self, limit: usize, rays: &mut Vec<Ray>) -> Result<(), RaysError> {
        while rays.len() < limit && self.next_line()? {
            let line = self.line;
            let text = std::str::from_utf8(&self.text).map_err(|_| bad(line, "is not text"))?;
            let text = text.trim();
            if text.is_empty() || text.starts_with('#') {
                continue;
            }
            let is_heading = text.split(',').all(|field| field.trim().parse::<f64>().is_err());
            if !(std::mem::take(&mut self.may_be_heading) && is_heading) {
                rays.push(ray(line, text, &mut self.columns)?);
            }
        }
        Ok(())
    }

    /// Reads a line; false at the end.
    fn next_line(&mut self) -> Result<bool, RaysError> {
        self.text.clear();
        self.line += 1;
        let mut source = self.source.by_ref().take(MAX_LINE as u64);
        match source.read_until(b'\n', &mut self.text) {
            Ok(MAX_LINE) => Err(bad(self.line, format!("longer than {MAX_LINE} bytes; no ray is"))),
            Ok(length) => Ok(length > 0),
            Err(error) => Err(RaysError::Io(error)),
        }
    }
}

/// The ray of a line, which must have as many numbers as the lines before.
fn ray(line: u64, text: &str, columns: &mut Option<usize>) -> Result<Ray, RaysError> {
    let found = text.split(',').count();
    let expected = *columns.get_or_insert(found);
    if !matches!(expected, 6 | 8) {
        let wanted = "give 6 (origin, direction) or 8 (and t_min, t_max)";
        return Err(bad(line, format!("has {found} numbers; {wanted}")));
    }
    if found != expected {
        let reason = format!("has {found} numbers, but the lines before have {expected}");
        return Err(bad(line, reason));
    }
    let mut row = [0.0; 8];
    for (value, text) in row.iter_mut().zip(text.split(',').map(str::trim)) {
        *value = text.parse().map_err(|_| {
            let brief: String = text.chars().take(40).collect();
            bad(line, format!("`{brief}` is not a number"))
        })?;
    }
    Ok(ray_of(&row[..found]))
}

fn bad(line: u64, reason: impl Into<String>) -> RaysError {
    RaysError::Line { line, reason: reason.into() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io;

    #[test]
    fn a_line_without_end_is_refused() {
        let endless = Box::new(io::BufReader::new(io::repeat(b'1')));
        let error = CsvRays::new(endless).read(1, &mut Vec::new()).unwrap_err();
        assert_eq!(error.to_string(), "line 1: longer than 65536 bytes; no ray is");
    }
}
