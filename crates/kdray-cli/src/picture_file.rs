//! Renders as files.

use crate::{error::CliError, output::Output};
use kdray_render::{Picture, PngDepth};
use std::path::Path;

/// The formats of renders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Png,
    Exr,
}

impl Format {
    /// The format that a path's ending names.
    pub(crate) fn of(path: &Path) -> Result<Self, CliError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        match ending.as_str() {
            "png" => Ok(Self::Png),
            "exr" => Ok(Self::Exr),
            _ => Err(CliError::Usage(format!(
                "--out {}: give a name that ends in .png or .exr",
                path.display()
            ))),
        }
    }

    /// Refuses bits a channel where there is no choice.
    pub(crate) fn check_bits(self, bits: Option<PngDepth>) -> Result<(), CliError> {
        if self == Self::Exr && bits.is_some() {
            let refused = "--bits needs an output that ends in .png: OpenEXR keeps 32 bits";
            return Err(CliError::Usage(refused.to_owned()));
        }
        Ok(())
    }
}

/// Writes a picture to `output`, which will be called `path`.
pub(crate) fn write(
    picture: &Picture,
    format: Format,
    bits: Option<PngDepth>,
    output: &mut Output,
    path: &Path,
) -> Result<(), CliError> {
    let written = match format {
        Format::Png => picture.write_png(output.file(), bits.unwrap_or_default()),
        Format::Exr => picture.write_exr(output.file()),
    };
    written.map_err(|error| CliError::picture(path, error))
}
