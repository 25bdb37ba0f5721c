//! Rows from lines of numbers with commas.

use super::{super::RowsError, Row};
use std::{
    io::{BufRead, Read},
    marker::PhantomData,
};

/// No line of eight numbers needs more bytes; one without end would take memory without bound.
const MAX_LINE: usize = 1 << 16;

/// Rows from lines of numbers. Empty lines, and those that begin with `#`, are passed over,
/// and so is a first line of as many names, with the mark of UTF-8 before it or without.
pub(crate) struct CsvRows<R> {
    source: Box<dyn BufRead>,
    /// The line that was read last, from 1.
    line: u64,
    text: Vec<u8>,
    /// Numbers in a line, once that is known.
    columns: Option<usize>,
    may_be_heading: bool,
    row: PhantomData<R>,
}

impl<R: Row> CsvRows<R> {
    pub(super) fn new(source: Box<dyn BufRead>) -> Self {
        let text = Vec::new();
        Self { source, line: 0, text, columns: None, may_be_heading: true, row: PhantomData }
    }

    pub(super) fn read(&mut self, limit: usize, rows: &mut Vec<R>) -> Result<(), RowsError> {
        while rows.len() < limit && self.next_line()? {
            let line = self.line;
            let text = std::str::from_utf8(&self.text).map_err(|_| bad(line, "is not text"))?;
            let text = if line == 1 { text.trim_start_matches('\u{feff}') } else { text }.trim();
            if text.is_empty() || text.starts_with('#') {
                continue;
            }
            let found = check_columns::<R>(line, text, &mut self.columns)?;
            if !(std::mem::take(&mut self.may_be_heading) && is_heading(text)) {
                rows.push(row(line, text, found)?);
            }
        }
        Ok(())
    }

    /// Reads a line; false at the end.
    fn next_line(&mut self) -> Result<bool, RowsError> {
        self.text.clear();
        self.line += 1;
        let mut source = self.source.by_ref().take(MAX_LINE as u64);
        match source.read_until(b'\n', &mut self.text) {
            Ok(MAX_LINE) => {
                let what = R::ONE;
                Err(bad(self.line, format!("longer than {MAX_LINE} bytes; no {what} is")))
            }
            Ok(length) => Ok(length > 0),
            Err(error) => Err(RowsError::Io(error)),
        }
    }
}

fn is_heading(text: &str) -> bool {
    text.split(',').all(|field| field.trim().parse::<f64>().is_err())
}

/// How many fields the line has, which must be as many as the lines before have.
fn check_columns<R: Row>(
    line: u64,
    text: &str,
    columns: &mut Option<usize>,
) -> Result<usize, RowsError> {
    let found = text.split(',').count();
    let expected = *columns.get_or_insert(found);
    if !R::WIDTHS.contains(&expected) {
        let wanted = R::NUMBERS;
        let reason = format!("has {found} numbers; give {wanted}, with commas between");
        return Err(bad(line, reason));
    }
    if found != expected {
        let reason = format!("has {found} numbers, but the lines before have {expected}");
        return Err(bad(line, reason));
    }
    Ok(found)
}

/// The row of a line of so many numbers.
fn row<R: Row>(line: u64, text: &str, found: usize) -> Result<R, RowsError> {
    let mut row = [0.0; 8];
    for (value, text) in row.iter_mut().zip(text.split(',').map(str::trim)) {
        *value = text.parse().map_err(|_| {
            let brief: String = text.chars().take(40).collect();
            bad(line, format!("`{brief}` is not a number"))
        })?;
    }
    Ok(R::of(&row[..found]))
}

fn bad(line: u64, reason: impl Into<String>) -> RowsError {
    RowsError::Line { line, reason: reason.into() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kdray::Ray;
    use std::io;

    fn rays_of(text: &'static str) -> Result<Vec<Ray>, String> {
        let mut rays = Vec::new();
        let mut csv = CsvRows::new(Box::new(text.as_bytes()));
        csv.read(9, &mut rays).map(|()| rays).map_err(|error| error.to_string())
    }

    #[test]
    fn a_heading_has_as_many_names_as_rays_have_numbers() {
        let ray = Ray::new([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]);
        assert_eq!(rays_of("ox,oy,oz,dx,dy,dz\n1,2,3,4,5,6\n"), Ok(vec![ray]));
        for no_rays in ["{\n}\n", "hello\n", "a,b,c,d,e,f,g\n1,2,3,4,5,6\n"] {
            let error = rays_of(no_rays).unwrap_err();
            assert!(error.starts_with("line 1: has ") && error.contains("give 6"), "{error}");
        }
        let error = rays_of("a,b,c,d,e,f\n1,2,3,4,5,6,7,8\n").unwrap_err();
        assert!(error.contains("line 2: has 8 numbers, but"), "{error}");
    }

    #[test]
    fn the_mark_of_utf_8_is_passed_over() {
        for text in ["\u{feff}1,2,3,4,5,6\n", "\u{feff}ox,oy,oz,dx,dy,dz\r\n1,2,3,4,5,6\r\n"] {
            assert_eq!(rays_of(text).map(|rays| rays.len()), Ok(1), "{text}");
        }
    }

    #[test]
    fn a_line_without_end_is_refused() {
        let endless = Box::new(io::BufReader::new(io::repeat(b'1')));
        let error = CsvRows::<Ray>::new(endless).read(1, &mut Vec::new()).unwrap_err();
        assert_eq!(error.to_string(), "line 1: longer than 65536 bytes; no ray is");
    }
}
