//! Pictures as files: SVG as drawn, or PNG.

use super::Canvas;
use crate::{args::Size, error::CliError, output::Output};
use resvg::{tiny_skia, usvg};
use std::{
    io::Write,
    path::{Path, PathBuf},
};

/// The most pixels of a PNG, 1 GiB of memory.
const MAX_PIXELS: f64 = (1 << 28) as f64;

/// A picture to be, checked before the work whose result it is to show.
pub(crate) struct PictureFile {
    path: PathBuf,
    output: Output,
    format: Format,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Svg,
    Png,
}

impl PictureFile {
    /// Makes sure that `path` ends in `.svg` or `.png` and can be written.
    pub(crate) fn create(path: &Path) -> Result<Self, CliError> {
        let format = Format::of(path)?;
        Ok(Self { path: path.to_owned(), output: Output::create(path)?, format })
    }

    /// Refuses a `--size` that is too large for a PNG with at least `around` more pixels down,
    /// before the work.
    pub(crate) fn check_size(&self, size: Size, around: f64) -> Result<(), CliError> {
        let Size { width, height } = size;
        if self.format == Format::Svg || width as f64 * (height as f64 + around) <= MAX_PIXELS {
            return Ok(());
        }
        Err(CliError::Usage(format!(
            "--size {width}x{height}: with title and key these are more pixels than a PNG may have, \
             {MAX_PIXELS}; choose a smaller size, or a name that ends in .svg"
        )))
    }

    /// The path that it will have.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the picture. A PNG has `scale` pixels for each one of the canvas, across and down.
    pub(crate) fn write(mut self, canvas: Canvas, scale: f64) -> Result<(), CliError> {
        let size = canvas.size();
        let svg = canvas.into_svg();
        let bytes = match self.format {
            Format::Svg => svg.into_bytes(),
            Format::Png => rasterise(&svg, size.map(|side| side * scale), scale)
                .map_err(|error| CliError::output(&self.path, std::io::Error::other(error)))?,
        };
        let written = self.output.file().write_all(&bytes);
        written.map_err(|error| CliError::output(&self.path, error))?;
        self.output.commit()
    }
}

impl Format {
    fn of(path: &Path) -> Result<Self, CliError> {
        let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        match ending.as_deref() {
            Some("svg") => Ok(Self::Svg),
            Some("png") => Ok(Self::Png),
            _ => Err(CliError::Usage(format!(
                "{}: pictures are written as .svg or .png; choose one of these endings",
                path.display()
            ))),
        }
    }
}

/// The SVG as a PNG, its text in the embedded font whatever the machine has.
fn rasterise(svg: &str, [width, height]: [f64; 2], scale: f64) -> Result<Vec<u8>, String> {
    let mut options = usvg::Options { font_family: "DejaVu Sans".into(), ..Default::default() };
    options.fontdb_mut().load_font_data(dejavu::sans::regular().to_vec());
    let tree = usvg::Tree::from_str(svg, &options).map_err(|error| error.to_string())?;
    let too_large = || format!("a picture of {width:.0} x {height:.0} pixels is too large");
    if width * height > MAX_PIXELS {
        return Err(too_large());
    }
    let mut pixels =
        tiny_skia::Pixmap::new(width.ceil() as u32, height.ceil() as u32).ok_or_else(too_large)?;
    let scale = tiny_skia::Transform::from_scale(scale as f32, scale as f32);
    resvg::render(&tree, scale, &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pictures::canvas::Anchor;

    #[test]
    fn other_endings_are_refused_by_name() {
        assert_eq!(Format::of(Path::new("a/b.SVG")).unwrap(), Format::Svg);
        for bad in ["picture", "picture.jpg", "svg"] {
            let error = Format::of(Path::new(bad)).unwrap_err().to_string();
            assert!(error.contains(bad) && error.contains(".png"), "{error}");
        }
    }

    #[test]
    fn sizes_that_fit_are_not_refused() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name| PictureFile::create(&folder.path().join(name)).unwrap();
        let size = Size { width: 16384, height: 16128 };
        assert!(file("a.png").check_size(size, 256.0).is_ok());
        assert!(file("a.png").check_size(size, 257.0).is_err());
        assert!(file("a.svg").check_size(size, 257.0).is_ok());
    }

    #[test]
    fn text_needs_no_font_of_the_machine() {
        let mut canvas = Canvas::new(60.0, 20.0, "text");
        canvas.text([30.0, 15.0], Anchor::Middle, 14.0, "t ≤ 4");
        let png = rasterise(&canvas.into_svg(), [120.0, 40.0], 2.0).unwrap();
        let pixels = tiny_skia::Pixmap::decode_png(&png).unwrap();
        let dark = pixels.pixels().iter().filter(|pixel| pixel.red() < 128).count();
        assert!(dark > 50, "{dark} dark pixels");
    }
}
