//! What URIs stand for.

use super::Document;
use crate::input::read_file;
use data_url::DataUrl;
use percent_encoding::percent_decode_str;
use std::io::{self, ErrorKind};
use std::path::PathBuf;

/// Where the bytes of a URI are.
pub(super) enum Content<'a> {
    /// In the URI itself.
    Data(&'a str),
    /// In a file beside the document; its path is the same for all URIs of the file.
    File(PathBuf),
}

impl<'a> Content<'a> {
    pub(super) fn find(document: Document<'_>, uri: &'a str) -> io::Result<Self> {
        if uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:")) {
            return Ok(Self::Data(uri));
        }
        if uri.contains("://") {
            return Err(invalid("files on other machines are not fetched"));
        }
        let siblings = document.request.siblings;
        let decoded = percent_decode_str(uri).decode_utf8_lossy();
        // Some programs do not encode names, so that `%20` can also stand for itself.
        let found = siblings.find(&decoded).or_else(|error| {
            if decoded == uri { Err(error) } else { siblings.find(uri).or(Err(error)) }
        });
        found.map(Self::File)
    }

    /// The bytes, at most `limit`; more are an error of kind `FileTooLarge`.
    pub(super) fn read(&self, limit: u64) -> io::Result<Vec<u8>> {
        let uri = match self {
            Self::Data(uri) => uri,
            Self::File(path) => return read_file(path, limit),
        };
        let url = DataUrl::process(uri).map_err(|_| invalid("not a data URI"))?;
        let bytes = url.decode_to_vec().map_err(|_| invalid("not base64"))?.0;
        if bytes.len() as u64 > limit { Err(ErrorKind::FileTooLarge.into()) } else { Ok(bytes) }
    }
}

fn invalid(reason: &str) -> io::Error {
    io::Error::new(ErrorKind::InvalidInput, reason)
}
