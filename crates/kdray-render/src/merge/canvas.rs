//! What parts are added up in.

use super::MergeError;
use super::seen::Seen;
use crate::film::{MAX_PICTURE_BYTES, filled, nothing};
use crate::part::Crop;
use crate::picture::{COUNT, Channel, Layer, Picture, Samples, is_of_middle};
use std::ops::Range;

/// The most memory that a canvas may take: of one channel, the sum and the count have three times as
/// many bytes as the picture.
const MAX_BYTES: u128 = 3 * MAX_PICTURE_BYTES;

/// The whole picture in the making.
#[derive(Clone, Debug)]
pub(super) struct Canvas {
    /// The whole picture but for its pixels: its layers have channels without samples.
    blank: Picture,
    /// Samples of each pixel so far.
    counts: Vec<u32>,
    /// All layers' channels, one after the other.
    sums: Vec<Sum>,
}

/// What a channel is added up in.
#[derive(Clone, Debug)]
enum Sum {
    /// Means, each times the number of its samples.
    Weighted(Vec<f64>),
    /// What is the same in all parts.
    Same(Samples),
}

impl Canvas {
    /// An empty canvas for the picture that `part` is part of.
    pub(super) fn new(part: &Picture) -> Result<Self, MergeError> {
        let mut blank = Picture {
            width: part.part.full_width,
            height: part.part.full_height,
            kind: part.kind,
            complete: false,
            rendered: Vec::new(),
            exposure: part.exposure,
            heat_max: part.heat_max,
            part: part.part.clone(),
            layers: Vec::new(),
        };
        (blank.part.x, blank.part.y) = (0, 0);
        for layer in &part.layers {
            let blank_of = |it: &Channel| Channel { name: it.name, samples: it.samples.empty() };
            let channels = layer.channels.iter().map(blank_of).collect();
            blank.layers.push(Layer { name: layer.name, channels });
        }
        let (width, height) = (blank.width, blank.height);
        let pixels = (width as u128).saturating_mul(height as u128);
        let bytes_of = |layer: &Layer| {
            let each = if is_of_middle(layer.name) { size_of::<f32>() } else { size_of::<f64>() };
            layer.channels.len() * each
        };
        let each = size_of::<u32>() + part.layers.iter().map(bytes_of).sum::<usize>();
        let bytes = pixels.saturating_mul(each as u128);
        let too_large = MergeError::TooLarge { width, height, bytes, limit: MAX_BYTES };
        if bytes > MAX_BYTES {
            return Err(too_large);
        }
        Self::allocate(blank).ok_or(too_large)
    }

    fn allocate(blank: Picture) -> Option<Self> {
        let pixels = blank.width * blank.height;
        let mut sums = Vec::new();
        for layer in &blank.layers {
            for channel in &layer.channels {
                sums.push(match is_of_middle(layer.name) {
                    true => Sum::Same(nothing(channel.name, pixels)?),
                    // Adding to −0 changes nothing, not even the sign of −0.
                    false => Sum::Weighted(filled(-0.0, pixels)?),
                });
            }
        }
        Some(Self { counts: filled(0, pixels)?, blank, sums })
    }

    /// An error if `part`, which is called `name`, is of another picture than the part `first`, which
    /// the canvas was made for.
    pub(super) fn check_same_picture(
        &self,
        first: &str,
        name: &str,
        part: &Picture,
    ) -> Result<(), MergeError> {
        let (a, b) = (&self.blank, part);
        let size = |picture: &Picture| {
            format!("{} x {} pixels", picture.part.full_width, picture.part.full_height)
        };
        let layers = |picture: &Picture| {
            let name = |layer: &Layer| format!("{} of {}", layer.name, layer.channels.len());
            picture.layers.iter().map(name).collect::<Vec<_>>().join(", ")
        };
        let heat_max = |it: &Picture| it.heat_max.map_or("none".to_owned(), |max| max.to_string());
        let both = [
            ("size", size(a), size(b)),
            ("samples", a.part.samples.to_string(), b.part.samples.to_string()),
            ("seed", a.part.seed.to_string(), b.part.seed.to_string()),
            ("picture", a.kind.name().to_owned(), b.kind.name().to_owned()),
            ("layers", layers(a), layers(b)),
            ("exposure", a.exposure.to_string(), b.exposure.to_string()),
            ("heat_max", heat_max(a), heat_max(b)),
        ];
        let different = both.into_iter().find(|(_, a, b)| a != b);
        let what = match different {
            Some((what, a, b)) => format!("their {what} is {a} and {b}"),
            None if a.part.scene != b.part.scene => {
                "their scenes, cameras, lights or options are not the same".to_owned()
            }
            None => return Ok(()),
        };
        let (first, second) = (first.to_owned(), name.to_owned());
        Err(MergeError::DifferentPictures { first, second, what })
    }

    /// Adds a part of this picture. An error names the layer and the pixel that must be the same as
    /// before, and is not.
    pub(super) fn add(&mut self, part: &Picture) -> Result<(), (&'static str, [usize; 2])> {
        let crop = part.crop();
        let samples = part.part.sample_range.len() as u32;
        let channels = part.layers.iter().flat_map(|layer| {
            layer.channels.iter().map(move |channel| (layer.name, &channel.samples))
        });
        let whole = Crop { x: 0, y: 0, width: self.blank.width, height: self.blank.height };
        // What was rendered: places in the part, and pixels of the whole.
        let pixels = || crop.pixels().enumerate().filter(|&(place, _)| part.rendered[place]);
        for ((layer, values), sum) in channels.zip(&mut self.sums) {
            for (from, pixel) in pixels() {
                let to = whole.index(pixel);
                if !sum.add(to, values, from, samples, self.counts[to] == 0) {
                    return Err((layer, pixel));
                }
            }
        }
        for (_, pixel) in pixels() {
            self.counts[whole.index(pixel)] += samples;
        }
        Ok(())
    }

    /// An error if a pixel lacks samples.
    pub(super) fn check_all_there(&self, seen: &[Seen]) -> Result<(), MergeError> {
        let all = self.blank.part.samples;
        let lacking = || self.counts.iter().enumerate().filter(|&(_, &count)| count < all);
        let Some((first, _)) = lacking().next() else { return Ok(()) };
        let pixel = [first % self.blank.width, first / self.blank.width];
        let is_there = |sample: u32| seen.iter().any(|part| part.has_sample(pixel, sample));
        Err(MergeError::Missing {
            pixels: lacking().count(),
            all: self.counts.len(),
            x: pixel[0],
            y: pixel[1],
            sample: (0..all).find(|&sample| !is_there(sample)).unwrap_or_default(),
        })
    }

    /// The picture, of parts whose samples lie in this range.
    pub(super) fn develop(self, range: Range<u32>) -> Picture {
        let Self { blank: mut picture, counts, sums } = self;
        let mut sums = sums.into_iter();
        for channel in picture.layers.iter_mut().flat_map(|layer| &mut layer.channels) {
            if let Some(sum) = sums.next() {
                channel.samples = sum.develop(&counts);
            }
        }
        picture.rendered = counts.iter().map(|&count| count > 0).collect();
        // No sample was added twice, so a pixel with as many as the range has has all of it.
        let all = range.len() as u32;
        picture.complete = counts.iter().all(|&count| count == all);
        picture.part.sample_range = range;
        if counts.iter().any(|&count| count != 0 && count != all) {
            let channels = vec![Channel { name: COUNT.channels[0], samples: Samples::U32(counts) }];
            picture.layers.push(Layer { name: COUNT.name, channels });
        }
        picture
    }
}

impl Sum {
    /// Adds value `from` of `values`, which `samples` samples have, at place `to`, where none was if
    /// `first`. `false` if it must be the same as before, and is not.
    fn add(&mut self, to: usize, values: &Samples, from: usize, samples: u32, first: bool) -> bool {
        match (self, values) {
            // Exact: 24 bits times 17.
            (Self::Weighted(sums), Samples::F32(values)) => {
                sums[to] += f64::from(values[from]) * f64::from(samples);
                true
            }
            (Self::Same(Samples::F32(all)), Samples::F32(values)) => {
                if first {
                    all[to] = values[from];
                }
                all[to].to_bits() == values[from].to_bits()
            }
            (Self::Same(Samples::U32(all)), Samples::U32(values)) => {
                if first {
                    all[to] = values[from];
                }
                all[to] == values[from]
            }
            _ => false,
        }
    }

    fn develop(self, counts: &[u32]) -> Samples {
        match self {
            Self::Same(samples) => samples,
            Self::Weighted(sums) => {
                let mean = |(sum, &count): (f64, &u32)| match count {
                    0 => 0.0,
                    count => (sum / f64::from(count)) as f32,
                };
                Samples::F32(sums.into_iter().zip(counts).map(mean).collect())
            }
        }
    }
}
