//! OpenEXR: every layer as it was computed.

use super::{Picture, Samples, WriteError};
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, SmallVec, Text,
    WritableImage,
};
use std::io::{Cursor, Write};

/// The longest side of an OpenEXR picture: its window must end before half of what an i32 holds.
const MAX_SIDE: u32 = (i32::MAX / 2) as u32 - 1;

impl Picture {
    /// Writes all layers as one OpenEXR picture, without loss. The colour's channels are `R`, `G`,
    /// `B`, `A`; those of other layers are called `layer.channel`, such as `depth.Z`, which is how
    /// OpenEXR names layers. The id is a whole number, all others are 32-bit floats.
    ///
    /// The file is made in memory before its first byte is written, as an OpenEXR file is not
    /// written from front to back. Besides the picture that takes up to four times as much memory
    /// as its layers.
    ///
    /// # Errors
    /// See [`WriteError`].
    pub fn write_exr(&self, mut writer: impl Write) -> Result<(), WriteError> {
        self.checked_size(MAX_SIDE)?;
        let mut channels = SmallVec::new();
        for layer in &self.layers {
            for channel in &layer.channels {
                let name = match layer.name {
                    "color" => channel.name.to_owned(),
                    layer => format!("{layer}.{}", channel.name),
                };
                let samples = match &channel.samples {
                    Samples::F32(samples) => FlatSamples::F32(samples.clone()),
                    Samples::U32(samples) => FlatSamples::U32(samples.clone()),
                };
                channels.push(AnyChannel::new(text(&name)?, samples));
            }
        }
        let image = Image::from_layer(Layer::new(
            (self.width, self.height),
            LayerAttributes::default(),
            Encoding::SMALL_LOSSLESS,
            AnyChannels::sort(channels),
        ));
        let mut file = Cursor::new(Vec::new());
        image.write().to_buffered(&mut file).map_err(|error| WriteError::Encode(error.into()))?;
        writer.write_all(file.get_ref()).map_err(WriteError::Io)
    }
}

fn text(name: &str) -> Result<Text, WriteError> {
    let error = || format!("the name `{name}` has letters that OpenEXR does not know");
    Text::new_or_none(name).ok_or_else(|| WriteError::Encode(error().into()))
}
