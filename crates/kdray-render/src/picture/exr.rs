//! OpenEXR: every layer as it was computed.

use super::label::{self, Label};
use super::plan::name_in_file;
use super::{COUNT, Picture, Samples, WriteError};
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, FlatSamples, Image, IntegerBounds, Layer,
    LayerAttributes, SmallVec, Text, Vec2, WritableImage,
};
use std::io::{Cursor, Write};

/// The longest side of an OpenEXR picture: its window must end before half of what an i32 holds.
pub(super) const MAX_SIDE: u32 = (i32::MAX / 2) as u32 - 1;

impl Picture {
    /// Writes all layers as one OpenEXR picture, without loss. The colour's channels are `R`, `G`,
    /// `B`, `A`; those of other layers are called `layer.channel`, such as `depth.Z`, which is how
    /// OpenEXR names layers. The id is a whole number, all others are 32-bit floats.
    ///
    /// The display window is the whole picture, the data window the part that is there. The
    /// attribute `kdray` says which part of which picture that is. A picture that is not
    /// [`complete`](Self::complete) has a channel `samples.count` more, the number of samples in each
    /// pixel. All of that is for [`read_exr`](Self::read_exr) and [`Merge`](crate::Merge).
    ///
    /// The file is made in memory before its first byte is written, as an OpenEXR file is not
    /// written from front to back. Besides the picture that takes up to four times as much memory
    /// as its layers.
    ///
    /// # Errors
    /// See [`WriteError`].
    pub fn write_exr(&self, mut writer: impl Write) -> Result<(), WriteError> {
        self.checked_size(MAX_SIDE)?;
        let whole = self.checked_part(MAX_SIDE)?;
        let mut channels = SmallVec::new();
        for layer in &self.layers {
            for channel in &layer.channels {
                let samples = match &channel.samples {
                    Samples::F32(samples) => FlatSamples::F32(samples.clone()),
                    Samples::U32(samples) => FlatSamples::U32(samples.clone()),
                };
                let name = name_in_file(layer.name, channel.name);
                channels.push(AnyChannel::new(text(&name)?, samples));
            }
        }
        if !self.complete && self.channel(COUNT.name, COUNT.channels[0]).is_none() {
            let name = name_in_file(COUNT.name, COUNT.channels[0]);
            channels.push(AnyChannel::new(text(&name)?, FlatSamples::U32(self.counts())));
        }
        let mut attributes = LayerAttributes {
            // Both fit, as the whole picture's sides do.
            layer_position: Vec2(self.part.x as i32, self.part.y as i32),
            ..LayerAttributes::default()
        };
        let said = AttributeValue::Text(text(&Label::of(self).text())?);
        attributes.other.insert(text(label::NAME)?, said);
        let mut image = Image::from_layer(Layer::new(
            (self.width, self.height),
            attributes,
            Encoding::SMALL_LOSSLESS,
            AnyChannels::sort(channels),
        ));
        image.attributes.display_window = IntegerBounds::from_dimensions(whole);
        let mut file = Cursor::new(Vec::new());
        image.write().to_buffered(&mut file).map_err(|error| WriteError::Encode(error.into()))?;
        writer.write_all(file.get_ref()).map_err(WriteError::Io)
    }

    /// How many samples each pixel has, if all that were rendered have those of the part.
    fn counts(&self) -> Vec<u32> {
        let count = self.part.sample_range.len() as u32;
        self.rendered.iter().map(|&rendered| if rendered { count } else { 0 }).collect()
    }
}

fn text(name: &str) -> Result<Text, WriteError> {
    let error = || format!("the name `{name}` has letters that OpenEXR does not know");
    Text::new_or_none(name).ok_or_else(|| WriteError::Encode(error().into()))
}
