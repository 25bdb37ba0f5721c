//! Where the pixels' values are kept until the picture is done.

use crate::options::RenderOptions;
use crate::part::Part;
use crate::picture::{Channel, Layer, Picture, Plan, Samples, plans};

/// The most memory that a picture's layers may take: 4 GiB, 16384 x 16384 in colour.
pub(crate) const MAX_PICTURE_BYTES: u128 = 1 << 32;

/// The values of one pixel; those that were not asked for are zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PixelValues {
    pub(crate) color: [f32; 4],
    pub(crate) depth: f32,
    pub(crate) normal: [f32; 3],
    pub(crate) primitive_id: u32,
    pub(crate) occlusion: f32,
    pub(crate) nodes: f32,
    pub(crate) primitives: f32,
    pub(crate) packet_cost: f32,
    pub(crate) packet_size: f32,
}

/// The layers of a picture in the making.
pub(crate) struct Film {
    picture: Picture,
}

impl Film {
    /// How many bytes the layers take.
    pub(crate) fn bytes(options: &RenderOptions) -> u128 {
        let channels = plans(options.picture, options.all_layers);
        let channels: usize = channels.iter().map(|plan| plan.channels.len()).sum();
        let window = options.window();
        let pixels = (window.width as u128).saturating_mul(window.height as u128);
        pixels.saturating_mul(4 * channels as u128)
    }

    /// An empty film for a picture of what `scene` is the hash of; `None` if there is not the memory
    /// for it.
    pub(crate) fn new(options: &RenderOptions, scene: u64) -> Option<Self> {
        if Self::bytes(options) > MAX_PICTURE_BYTES {
            return None;
        }
        let window = options.window();
        let pixels = window.width * window.height;
        let layer = |Plan { name, channels }: Plan| {
            let channel = |&name| Some(Channel { name, samples: nothing(name, pixels)? });
            Some(Layer { name, channels: channels.iter().map(channel).collect::<Option<_>>()? })
        };
        let plans = plans(options.picture, options.all_layers);
        let layers = plans.into_iter().map(layer).collect::<Option<_>>()?;
        let part = Part {
            full_width: options.width,
            full_height: options.height,
            x: window.x,
            y: window.y,
            samples: options.samples,
            sample_range: options.strata(),
            seed: options.seed,
            scene,
        };
        Some(Self {
            picture: Picture {
                width: window.width,
                height: window.height,
                kind: options.picture,
                complete: false,
                rendered: filled(false, pixels)?,
                exposure: options.exposure,
                heat_max: options.heat_max,
                part,
                layers,
            },
        })
    }

    /// Keeps the values of the pixel of this index.
    pub(crate) fn set(&mut self, index: usize, values: &PixelValues) {
        self.picture.rendered[index] = true;
        for layer in &mut self.picture.layers {
            let floats: &[f32] = match layer.name {
                "color" => &values.color,
                "depth" => &[values.depth],
                "normal" => &values.normal,
                "occlusion" => &[values.occlusion],
                "cost" => &[values.nodes, values.primitives],
                "packet" => &[values.packet_cost, values.packet_size],
                _ => &[],
            };
            for (i, channel) in layer.channels.iter_mut().enumerate() {
                match &mut channel.samples {
                    Samples::F32(samples) => samples[index] = floats[i],
                    Samples::U32(samples) => samples[index] = values.primitive_id,
                }
            }
        }
    }

    /// The picture.
    pub(crate) fn develop(mut self, complete: bool) -> Picture {
        self.picture.complete = complete;
        self.picture
    }
}

/// What a channel holds before anything is rendered.
pub(crate) fn nothing(name: &str, count: usize) -> Option<Samples> {
    Some(match name {
        "id" => Samples::U32(filled(u32::MAX, count)?),
        _ => Samples::F32(filled(0.0, count)?),
    })
}

pub(crate) fn filled<T: Clone>(value: T, count: usize) -> Option<Vec<T>> {
    let mut samples = Vec::new();
    samples.try_reserve_exact(count).ok()?;
    samples.resize(count, value);
    Some(samples)
}
