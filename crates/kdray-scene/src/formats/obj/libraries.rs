//! The material libraries that a file names.

use super::Request;
use super::mtl::{self, Statements};
use crate::LoadError;
use crate::cut::cut;
use crate::input::{Limited, Scanner, peek, utf8};
use crate::mesh::MeshBuilder;
use std::collections::HashSet;
use std::fs::File;
use std::path::{Path, PathBuf};

/// Reads libraries, each once, however often and by whatever names it is asked for.
pub(super) struct Libraries<'a> {
    request: &'a Request<'a>,
    /// The names that were asked for, found or not, and the whole `mtllib` statements: looking for
    /// a file takes as long as thousands of bytes of a line.
    asked: HashSet<&'a str>,
    found: HashSet<PathBuf>,
}

impl<'a> Libraries<'a> {
    pub(super) fn new(request: &'a Request<'a>) -> Self {
        Self { request, asked: HashSet::new(), found: HashSet::new() }
    }

    /// The materials of the library of this name, or of several libraries with spaces between
    /// their names; none of those that were read before. What cannot be read becomes a warning.
    pub(super) fn read(
        &mut self,
        line: u64,
        names: &'a str,
        builder: &mut MeshBuilder<'_>,
    ) -> Vec<Statements> {
        let mut materials = Vec::new();
        if self.asked.contains(names) {
            return materials;
        }
        let one = self.request.siblings.find(names).is_ok();
        let several = names.split_whitespace().filter(|_| !one);
        for name in one.then_some(names).into_iter().chain(several) {
            if !self.asked.insert(name) {
                continue;
            }
            if let Err(error) = self.read_one(name, &mut materials) {
                let warning = format!("line {line}: material library left out: {error}");
                builder.warn_often("material libraries left out", warning);
            }
        }
        self.asked.insert(names);
        materials
    }

    fn read_one(&mut self, name: &str, materials: &mut Vec<Statements>) -> Result<(), LoadError> {
        let found = self.request.siblings.find(name);
        let path = found.map_err(|error| LoadError::Io { file: cut(name).into_owned(), error })?;
        if self.found.insert(path.clone()) {
            read_file(name, &path, self.request, materials)?;
        }
        Ok(())
    }
}

fn read_file(
    name: &str,
    path: &Path,
    request: &Request<'_>,
    materials: &mut Vec<Statements>,
) -> Result<(), LoadError> {
    let library = Request { file: name, ..*request };
    let fail = |error| library.read_error(error);
    let file = Limited::new(File::open(path).map_err(fail)?, request.options.max_bytes);
    let (start, bytes) = peek(Box::new(file), 4).map_err(fail)?;
    let bytes = utf8(bytes, &start).map_err(fail)?;
    let mut scanner = Scanner::new(bytes, &library);
    let mut line = Vec::new();
    while scanner.line(&mut line)? {
        mtl::add_line(&String::from_utf8_lossy(&line), materials);
    }
    Ok(())
}
