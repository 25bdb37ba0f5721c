//! Image files into textures.

use crate::{Texture, Wrap};
use image::{DynamicImage, ImageDecoder, ImageReader, Limits};
use std::io::Cursor;

/// How the numbers in an image are meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Encoding {
    /// Colours for display; alpha is linear.
    Srgb,
    /// Measures, such as roughness.
    Linear,
}

/// The pixels of all textures of a model together; 2 GiB of memory.
const MAX_PIXELS: u64 = 1 << 27;

/// Decodes images, and keeps what they take within bounds.
#[derive(Default)]
pub(crate) struct TextureDecoder {
    pixels: u64,
}

impl TextureDecoder {
    /// Decodes a PNG or JPEG file, or says why not.
    pub(crate) fn decode(
        &mut self,
        file: &[u8],
        encoding: Encoding,
        wrap: [Wrap; 2],
    ) -> Result<Texture, String> {
        let reader = ImageReader::new(Cursor::new(file)).with_guessed_format();
        let reader = reader.map_err(|error| error.to_string())?;
        let mut decoder = reader.into_decoder().map_err(|error| error.to_string())?;
        let (width, height) = decoder.dimensions();
        let pixels = u64::from(width) * u64::from(height);
        // A picture of one colour takes a byte for some hundred pixels. More pixels than this for
        // its size, and a small file could take all memory.
        if pixels > (1 << 20) + 1024 * file.len() as u64 {
            return Err(format!("{width} x {height} pixels in {} bytes", file.len()));
        }
        if self.pixels + pixels > MAX_PIXELS {
            let limit = MAX_PIXELS >> 20;
            return Err(format!("with it all textures would have more than {limit} Mi pixels"));
        }
        let mut limits = Limits::default();
        limits.max_alloc = Some(8 * pixels + (64 << 20));
        decoder.set_limits(limits).map_err(|error| error.to_string())?;
        // Broken images count, too, for they take as long: one file may be shown many times.
        self.pixels += pixels;
        let image = DynamicImage::from_decoder(decoder).map_err(|error| error.to_string())?;
        let pixels = linear_pixels(&image, encoding);
        Ok(Texture { width: width as usize, height: height as usize, pixels, wrap })
    }
}

fn linear_pixels(image: &DynamicImage, encoding: Encoding) -> Vec<[f32; 4]> {
    let linear = |channel: f32| match encoding {
        Encoding::Srgb => crate::srgb::to_linear(channel),
        Encoding::Linear => channel,
    };
    let is_deep = image.color().bytes_per_pixel() / image.color().channel_count() > 1;
    if is_deep {
        let wide = image.to_rgba16();
        let pixels = wide.pixels().map(|pixel| pixel.0.map(|x| f32::from(x) / 65_535.0));
        return pixels.map(|[r, g, b, a]| [linear(r), linear(g), linear(b), a]).collect();
    }
    let table: [f32; 256] = std::array::from_fn(|i| linear(i as f32 / 255.0));
    let pixels = image.to_rgba8();
    let color = |[r, g, b, a]: [u8; 4]| {
        let [r, g, b] = [r, g, b].map(|x| table[usize::from(x)]);
        [r, g, b, f32::from(a) / 255.0]
    };
    pixels.pixels().map(|pixel| color(pixel.0)).collect()
}
