//! OpenEXR files of kdray, read again.

use super::exr::MAX_SIDE;
use super::label::{self, Label};
use super::plan::{is_whole, name_in_file};
use super::{COUNT, Channel, Layer, Picture, Plan, Samples, plans};
use crate::film::MAX_PICTURE_BYTES;
use crate::part::Part;
use exr::block::reader::Reader;
use exr::meta::attribute::{AttributeValue, SampleType};
use exr::meta::header::Header;
use exr::prelude::{AnyChannel, FlatSamples, ReadChannels, ReadLayers, Text, Vec2};
use std::io::{Read, Seek};
use thiserror::Error;

/// Why a file cannot be read as a picture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file cannot be read, or is no OpenEXR file, or a broken one.
    #[error("no OpenEXR file that can be read: {0}; render it again")]
    Exr(#[source] exr::error::Error),
    /// The file was not written by kdray.
    #[error("not a part: {0}; give OpenEXR files that kdray has rendered")]
    NotPart(&'static str),
    /// The picture takes too much memory.
    #[error("its layers take {bytes} bytes, more than {MAX_PICTURE_BYTES}; render smaller parts")]
    TooLarge {
        /// What the layers would take.
        bytes: u128,
    },
}

impl Picture {
    /// Reads what [`write_exr`](Self::write_exr) has written, which is the same picture again. The file
    /// may be anything: what it says is checked, before memory is taken by it.
    ///
    /// # Errors
    /// See [`ReadError`].
    pub fn read_exr(reader: impl Read + Seek) -> Result<Self, ReadError> {
        let file = Reader::read_from_buffered(reader, true).map_err(ReadError::Exr)?;
        let [header] = file.headers() else {
            return Err(ReadError::NotPart("it has several layers, each for itself"));
        };
        let label = label(header)?;
        let part = part(header, &label)?;
        let plans = layout(header, &label)?;
        let Vec2(width, height) = header.layer_size;
        let channels = exr::prelude::read().no_deep_data().largest_resolution_level();
        let read = channels.all_channels().first_valid_layer().all_attributes().pedantic();
        let image = read.from_chunks(file).map_err(ReadError::Exr)?;
        let mut found = image.layer_data.channel_data.list.into_vec();

        let layer = |plan: Plan| {
            let channel = |&name| Ok(Channel { name, samples: take(&mut found, plan, name)? });
            let channels = plan.channels.iter().map(channel).collect::<Result<_, ReadError>>()?;
            Ok(Layer { name: plan.name, channels })
        };
        let mut layers = plans.into_iter().map(layer).collect::<Result<Vec<_>, ReadError>>()?;
        let mut rendered = vec![true; width * height];
        if !label.complete {
            let counts = layers.pop().ok_or(MISSING)?;
            let [Channel { samples: Samples::U32(numbers), .. }] = &counts.channels[..] else {
                return Err(MISSING);
            };
            rendered = numbers.iter().map(|&count| count > 0).collect();
            // Where all that was rendered has the samples of the part, that says it all.
            let all = label.range.len() as u32;
            if numbers.iter().any(|&count| count != 0 && count != all) {
                layers.push(counts);
            }
        }
        let Label { kind, exposure, heat_max, complete, .. } = label;
        Ok(Self { width, height, kind, complete, rendered, exposure, heat_max, part, layers })
    }
}

/// The error of a file without the channels that it must have.
const MISSING: ReadError = ReadError::NotPart("its channels are not those of its kind of picture");

fn label(header: &Header) -> Result<Label, ReadError> {
    let said = header.own_attributes.other.get(&Text::from(label::NAME));
    let Some(AttributeValue::Text(said)) = said else {
        return Err(ReadError::NotPart("it has no attribute `kdray`"));
    };
    let label = Label::read(&said.to_string());
    label.ok_or(ReadError::NotPart("its attribute `kdray` does not say which part it is"))
}

fn part(header: &Header, label: &Label) -> Result<Part, ReadError> {
    const OUTSIDE: ReadError = ReadError::NotPart("its pixels lie outside of the picture");
    let whole = header.shared_attributes.display_window;
    let [x, y] = [header.own_attributes.layer_position.0, header.own_attributes.layer_position.1];
    let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) else { return Err(OUTSIDE) };
    let fits = whole.size.0.max(whole.size.1) <= MAX_SIDE as usize;
    let part = Part {
        full_width: whole.size.0,
        full_height: whole.size.1,
        x,
        y,
        samples: label.samples,
        sample_range: label.range.clone(),
        seed: label.seed,
        scene: label.scene,
    };
    let Vec2(width, height) = header.layer_size;
    let inside = part.crop(width, height).is_within(part.full_width, part.full_height);
    if fits && whole.position == Vec2(0, 0) && inside { Ok(part) } else { Err(OUTSIDE) }
}

/// The layers of the file, if its channels are exactly those of one kind of picture, or of all. The
/// last is that of counts, if the picture is not complete.
fn layout(header: &Header, label: &Label) -> Result<Vec<Plan>, ReadError> {
    let channels = &header.channels.list;
    let Vec2(width, height) = header.layer_size;
    let bytes = width as u128 * height as u128 * 4 * channels.len() as u128;
    // One for counts is allowed on top.
    if bytes > MAX_PICTURE_BYTES + MAX_PICTURE_BYTES / 4 {
        return Err(ReadError::TooLarge { bytes });
    }
    let found = |name: &str, kind| {
        let is_it = |it: &&exr::meta::attribute::ChannelDescription| it.name.eq(name);
        let channel = channels.iter().find(is_it);
        channel.is_some_and(|it| it.sample_type == kind && it.sampling == Vec2(1, 1))
    };
    for all_layers in [false, true] {
        let mut plans = plans(label.kind, all_layers);
        if !label.complete {
            plans.push(COUNT);
        }
        let mut names =
            plans.iter().flat_map(|plan| plan.channels.iter().map(|it| (plan.name, it)));
        let count = names.clone().count();
        let all_there = names.all(|(layer, &channel)| {
            let kind = if is_whole(channel) { SampleType::U32 } else { SampleType::F32 };
            found(&name_in_file(layer, channel), kind)
        });
        if all_there && count == channels.len() {
            return Ok(plans);
        }
    }
    Err(MISSING)
}

/// Takes a channel out of those that were read.
fn take(
    found: &mut Vec<AnyChannel<FlatSamples>>,
    layer: Plan,
    channel: &str,
) -> Result<Samples, ReadError> {
    let name = name_in_file(layer.name, channel);
    let place = found.iter().position(|it| it.name.eq(&name)).ok_or(MISSING)?;
    match found.swap_remove(place).sample_data {
        FlatSamples::F32(samples) => Ok(Samples::F32(samples)),
        FlatSamples::U32(samples) => Ok(Samples::U32(samples)),
        FlatSamples::F16(_) => Err(MISSING),
    }
}
