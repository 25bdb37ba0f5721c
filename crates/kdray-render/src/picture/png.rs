//! PNG: what a picture shows, to look at.

use super::false_color::{self, HeatScale};
use super::legend;
use super::{Picture, WriteError};
use crate::options::PictureKind;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use std::io::Write;

/// The longest side of a PNG, by its specification.
const MAX_SIDE: u32 = i32::MAX as u32;

/// How finely a PNG tells colours apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PngDepth {
    /// 8 bits a channel.
    #[default]
    Eight,
    /// 16 bits a channel.
    Sixteen,
}

/// A picture of display values, RGBA from 0 to 65535.
pub(crate) struct Canvas {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) pixels: Vec<[u16; 4]>,
}

impl Picture {
    /// Writes what [`kind`](Self::kind) names as a PNG with alpha, which is zero where nothing was
    /// [`rendered`](Self::rendered), but for the key of a heat map.
    ///
    /// Light and ambient occlusion are encoded as sRGB, light after multiplication by
    /// [`exposure`](Self::exposure). Depth goes from white for the nearest to dark for the farthest
    /// surface, a normal's components from −1 to 1 become 0 to 255, ids get colours of their own,
    /// and costs the colours of a heat scale that is drawn into the picture with its numbers.
    ///
    /// The file is made in memory before its first byte is written. Besides the picture that takes
    /// up to 24 bytes a pixel with 8 bits a channel, and up to 56 with 16.
    ///
    /// # Errors
    /// See [`WriteError`].
    pub fn write_png(&self, mut writer: impl Write, depth: PngDepth) -> Result<(), WriteError> {
        let [across, down] = self.checked_size(MAX_SIDE)?;
        let canvas = self.canvas()?;
        let (bytes, color): (Vec<u8>, _) = match depth {
            PngDepth::Eight => (canvas.into_bytes(eight_bits), ExtendedColorType::Rgba8),
            // The encoder takes native byte order.
            PngDepth::Sixteen => (canvas.into_bytes(u16::to_ne_bytes), ExtendedColorType::Rgba16),
        };
        let mut file = Vec::new();
        PngEncoder::new_with_quality(&mut file, CompressionType::Default, FilterType::Adaptive)
            .write_image(&bytes, across, down, color)
            .map_err(|error| WriteError::Encode(error.into()))?;
        writer.write_all(&file).map_err(WriteError::Io)
    }

    /// What a PNG of 8 bits a channel shows: red, green, blue and alpha of each pixel, the upper row first.
    ///
    /// # Errors
    /// See [`WriteError`].
    pub fn rgba8(&self) -> Result<Vec<u8>, WriteError> {
        self.checked_size(MAX_SIDE)?;
        Ok(self.canvas()?.into_bytes(eight_bits))
    }

    /// What `kind` names, drawn.
    fn canvas(&self) -> Result<Canvas, WriteError> {
        let mut canvas = Canvas {
            width: self.width,
            height: self.height,
            pixels: vec![[0; 4]; self.width * self.height],
        };
        match self.kind {
            PictureKind::Shaded => self.draw_color(&mut canvas),
            PictureKind::Depth => self.draw_depth(&mut canvas),
            PictureKind::Normal => self.draw_normal(&mut canvas),
            PictureKind::PrimitiveId => self.draw_ids(&mut canvas),
            PictureKind::AmbientOcclusion => self.draw_occlusion(&mut canvas),
            PictureKind::Cost => self.draw_sum(&mut canvas, "nodes + triangles"),
            PictureKind::CostNodes => self.draw_heat(&mut canvas, "nodes visited", "cost", "nodes"),
            PictureKind::CostPrimitives => {
                self.draw_heat(&mut canvas, "triangles tested", "cost", "primitives")
            }
            PictureKind::PacketCost => {
                self.draw_heat(&mut canvas, "packet work per ray", "packet", "cost")
            }
            PictureKind::PacketSize => {
                self.draw_heat(&mut canvas, "rays per packet", "packet", "size")
            }
        }
        .ok_or(WriteError::NotThere(self.kind))?;
        Ok(canvas)
    }

    /// The channels of a layer, none if one of them is not there.
    fn channels<const N: usize>(&self, layer: &str, names: [&str; N]) -> Option<[&[f32]; N]> {
        let channels = names.map(|name| self.floats(layer, name));
        channels.iter().all(Option::is_some).then(|| channels.map(Option::unwrap_or_default))
    }

    fn draw_color(&self, canvas: &mut Canvas) -> Option<()> {
        let [r, g, b, a] = self.channels("color", ["R", "G", "B", "A"])?;
        self.fill(canvas, |i| {
            let [r, g, b] = [r[i], g[i], b[i]].map(|x| srgb(x * self.exposure));
            [r, g, b, a[i]]
        });
        Some(())
    }

    fn draw_depth(&self, canvas: &mut Canvas) -> Option<()> {
        const FARTHEST: f32 = 0.1;
        let [depth] = self.channels("depth", ["Z"])?;
        let surfaces = self.indices().map(|i| depth[i]).filter(|z| z.is_finite());
        let (near, far) =
            surfaces.fold((f32::INFINITY, 0.0_f32), |(near, far), z| (near.min(z), far.max(z)));
        self.fill(canvas, |i| {
            let z = depth[i];
            let share = if far > near { (z - near) / (far - near) } else { 0.0 };
            opaque([if z.is_finite() { 1.0 - share * (1.0 - FARTHEST) } else { 0.0 }; 3])
        });
        Some(())
    }

    fn draw_normal(&self, canvas: &mut Canvas) -> Option<()> {
        let [x, y, z] = self.channels("normal", ["X", "Y", "Z"])?;
        self.fill(canvas, |i| match [x[i], y[i], z[i]] {
            [0.0, 0.0, 0.0] => opaque([0.0; 3]),
            n => opaque(n.map(|n| 0.5 + 0.5 * n)),
        });
        Some(())
    }

    fn draw_ids(&self, canvas: &mut Canvas) -> Option<()> {
        let ids = self.ids("primitive", "id")?;
        self.fill(canvas, |i| opaque(false_color::of_id(ids[i])));
        Some(())
    }

    fn draw_occlusion(&self, canvas: &mut Canvas) -> Option<()> {
        let [open] = self.channels("occlusion", ["V"])?;
        self.fill(canvas, |i| opaque([srgb(open[i]); 3]));
        Some(())
    }

    fn draw_sum(&self, canvas: &mut Canvas, title: &str) -> Option<()> {
        let [nodes, primitives] = self.channels("cost", ["nodes", "primitives"])?;
        self.draw_scaled(canvas, title, |i| nodes[i] + primitives[i]);
        Some(())
    }

    fn draw_heat(&self, canvas: &mut Canvas, title: &str, layer: &str, name: &str) -> Option<()> {
        let [values] = self.channels(layer, [name])?;
        self.draw_scaled(canvas, title, |i| values[i]);
        Some(())
    }

    fn draw_scaled(&self, canvas: &mut Canvas, title: &str, value: impl Fn(usize) -> f32) {
        let scale = HeatScale::new(self.indices().map(&value), self.heat_max);
        self.fill(canvas, |i| opaque(scale.color(value(i))));
        legend::draw(canvas, title, &scale);
    }

    /// The pixels that were rendered.
    fn indices(&self) -> impl Iterator<Item = usize> {
        self.rendered.iter().enumerate().filter(|&(_, &rendered)| rendered).map(|(i, _)| i)
    }

    /// Sets each pixel that was rendered to `color` of its index, RGBA from 0 to 1.
    fn fill(&self, canvas: &mut Canvas, color: impl Fn(usize) -> [f32; 4]) {
        for i in self.indices() {
            canvas.pixels[i] = color(i).map(|x| (x.clamp(0.0, 1.0) * 65535.0).round() as u16);
        }
    }
}

fn opaque([r, g, b]: [f32; 3]) -> [f32; 4] {
    [r, g, b, 1.0]
}

impl Canvas {
    /// The canvas is gone then: the encoder wants the memory.
    fn into_bytes<const N: usize>(self, bytes: impl Fn(u16) -> [u8; N]) -> Vec<u8> {
        self.pixels.iter().flatten().flat_map(|&value| bytes(value)).collect()
    }
}

/// The nearest of 256 levels.
fn eight_bits(value: u16) -> [u8; 1] {
    [((u32::from(value) + 128) / 257) as u8]
}

/// The display value of linear light, from 0 to 1 (IEC 61966-2-1).
fn srgb(linear: f32) -> f32 {
    let linear = if linear.is_nan() { 0.0 } else { linear.clamp(0.0, 1.0) };
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn display_values_follow_the_standard() {
        assert_eq!((srgb(0.0), srgb(f32::NAN)), (0.0, 0.0));
        assert!((srgb(2.0) - 1.0).abs() < 1e-6);
        assert!((srgb(0.214_041) - 0.5).abs() < 1e-5);
        assert!((srgb(0.002) - 0.02584).abs() < 1e-7);
    }

    #[test]
    fn levels_round_to_the_nearest() {
        assert_eq!([0, 128, 129, 65535].map(|v| eight_bits(v)[0]), [0, 0, 1, 255]);
        for level in 0..=255_u16 {
            assert_eq!(u16::from(eight_bits(level * 257)[0]), level);
        }
    }
}
