//! Rays from lines of numbers with commas.

use super::{super::RaysError, ray_of, short_lines::ShortLines};
use csv::{ReaderBuilder, StringRecord, Trim};
use kdray::Ray;
use std::io::BufRead;

/// No line of eight numbers needs more bytes.
const MAX_LINE: usize = 1 << 16;

/// Rays from lines of 6 or 8 numbers. Empty lines, and those that begin with `#`, are passed over,
/// and so is a first line of names.
pub(crate) struct CsvRays {
    reader: csv::Reader<ShortLines<Box<dyn BufRead>>>,
    record: StringRecord,
    /// Numbers in a line, once that is known.
    columns: Option<usize>,
    at_start: bool,
}

impl CsvRays {
    pub(super) fn new(source: Box<dyn BufRead>) -> Result<Self, RaysError> {
        let reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .quoting(false)
            .comment(Some(b'#'))
            .trim(Trim::All)
            .from_reader(ShortLines::new(source, MAX_LINE));
        Ok(Self { reader, record: StringRecord::new(), columns: None, at_start: true })
    }

    pub(super) fn read(&mut self, limit: usize, rays: &mut Vec<Ray>) -> Result<(), RaysError> {
        while rays.len() < limit && self.next_record()? {
            let first = std::mem::take(&mut self.at_start);
            let line = self.record.position().map_or(0, csv::Position::line);
            if !(first && is_heading(&self.record)) {
                rays.push(self.ray(line)?);
            }
        }
        Ok(())
    }

    fn next_record(&mut self) -> Result<bool, RaysError> {
        self.reader.read_record(&mut self.record).map_err(|error| {
            let line = error.position().map_or(0, csv::Position::line);
            match error.into_kind() {
                csv::ErrorKind::Io(error) => RaysError::Io(error),
                csv::ErrorKind::Utf8 { .. } => RaysError::line(line, "is not text"),
                kind => RaysError::line(line, format!("{kind:?}")),
            }
        })
    }

    fn ray(&mut self, line: u64) -> Result<Ray, RaysError> {
        let found = self.record.len();
        let expected = *self.columns.get_or_insert(found);
        if !matches!(expected, 6 | 8) {
            let wanted = "give 6 (origin, direction) or 8 (and t_min, t_max)";
            return Err(RaysError::line(line, format!("has {found} numbers; {wanted}")));
        }
        if found != expected {
            let reason = format!("has {found} numbers, but the lines before have {expected}");
            return Err(RaysError::line(line, reason));
        }
        let mut row = [0.0; 8];
        for (value, text) in row.iter_mut().zip(&self.record) {
            let bad = |_| RaysError::line(line, format!("`{}` is not a number", brief(text)));
            *value = text.parse().map_err(bad)?;
        }
        Ok(ray_of(&row[..found]))
    }
}

/// Whether the line holds names: none of its fields is a number.
fn is_heading(record: &StringRecord) -> bool {
    record.iter().all(|field| field.parse::<f64>().is_err())
}

/// As much of a text as a message needs.
fn brief(text: &str) -> String {
    text.chars().take(40).collect()
}
