//! Where the pixels' values are kept until the picture is done.

use crate::options::{PictureKind, RenderOptions};
use crate::picture::{Channel, Layer, Picture, Samples};

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

/// A layer's name and its channels' names. Whole numbers are kept in the channel called `id`.
type Plan = (&'static str, &'static [&'static str]);

const COLOR: Plan = ("color", &["R", "G", "B", "A"]);
const DEPTH: Plan = ("depth", &["Z"]);
const NORMAL: Plan = ("normal", &["X", "Y", "Z"]);
const PRIMITIVE: Plan = ("primitive", &["id"]);
const OCCLUSION: Plan = ("occlusion", &["V"]);
const COST: Plan = ("cost", &["nodes", "primitives"]);
const PACKET: Plan = ("packet", &["cost", "size"]);

fn plans(options: &RenderOptions) -> Vec<Plan> {
    if options.all_layers {
        return vec![COLOR, DEPTH, NORMAL, PRIMITIVE, OCCLUSION, COST, PACKET];
    }
    vec![match options.picture {
        PictureKind::Shaded => COLOR,
        PictureKind::Depth => DEPTH,
        PictureKind::Normal => NORMAL,
        PictureKind::PrimitiveId => PRIMITIVE,
        PictureKind::AmbientOcclusion => OCCLUSION,
        PictureKind::Cost | PictureKind::CostNodes | PictureKind::CostPrimitives => COST,
        PictureKind::PacketCost | PictureKind::PacketSize => PACKET,
    }]
}

impl Film {
    /// How many bytes the layers take.
    pub(crate) fn bytes(options: &RenderOptions) -> u128 {
        let channels: usize = plans(options).iter().map(|(_, channels)| channels.len()).sum();
        let pixels = (options.width as u128).saturating_mul(options.height as u128);
        pixels.saturating_mul(4 * channels as u128)
    }

    /// An empty film; `None` if there is not the memory for it.
    pub(crate) fn new(options: &RenderOptions) -> Option<Self> {
        if Self::bytes(options) > MAX_PICTURE_BYTES {
            return None;
        }
        let pixels = options.width * options.height;
        let layer = |(name, names): Plan| {
            let channel = |&name| Some(Channel { name, samples: nothing(name, pixels)? });
            Some(Layer { name, channels: names.iter().map(channel).collect::<Option<_>>()? })
        };
        let layers = plans(options).into_iter().map(layer).collect::<Option<_>>()?;
        Some(Self {
            picture: Picture {
                width: options.width,
                height: options.height,
                kind: options.picture,
                complete: false,
                rendered: filled(false, pixels)?,
                exposure: options.exposure,
                heat_max: options.heat_max,
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
fn nothing(name: &str, count: usize) -> Option<Samples> {
    Some(match name {
        "id" => Samples::U32(filled(u32::MAX, count)?),
        _ => Samples::F32(filled(0.0, count)?),
    })
}

fn filled<T: Clone>(value: T, count: usize) -> Option<Vec<T>> {
    let mut samples = Vec::new();
    samples.try_reserve_exact(count).ok()?;
    samples.resize(count, value);
    Some(samples)
}
