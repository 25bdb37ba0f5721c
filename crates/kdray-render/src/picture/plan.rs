//! Which layers a picture has.

use crate::options::PictureKind;

/// A layer's name and its channels' names. Whole numbers are kept in the channel called `id`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Plan {
    pub(crate) name: &'static str,
    pub(crate) channels: &'static [&'static str],
}

const COLOR: Plan = Plan { name: "color", channels: &["R", "G", "B", "A"] };
const DEPTH: Plan = Plan { name: "depth", channels: &["Z"] };
const NORMAL: Plan = Plan { name: "normal", channels: &["X", "Y", "Z"] };
const PRIMITIVE: Plan = Plan { name: "primitive", channels: &["id"] };
const OCCLUSION: Plan = Plan { name: "occlusion", channels: &["V"] };
const COST: Plan = Plan { name: "cost", channels: &["nodes", "primitives"] };
const PACKET: Plan = Plan { name: "packet", channels: &["cost", "size"] };

/// How many samples each pixel has, in files of pictures that are not complete.
pub(crate) const COUNT: Plan = Plan { name: "samples", channels: &["count"] };

/// The layers of a picture.
pub(crate) fn plans(kind: PictureKind, all_layers: bool) -> Vec<Plan> {
    if all_layers {
        return vec![COLOR, DEPTH, NORMAL, PRIMITIVE, OCCLUSION, COST, PACKET];
    }
    vec![match kind {
        PictureKind::Shaded => COLOR,
        PictureKind::Depth => DEPTH,
        PictureKind::Normal => NORMAL,
        PictureKind::PrimitiveId => PRIMITIVE,
        PictureKind::AmbientOcclusion => OCCLUSION,
        PictureKind::Cost | PictureKind::CostNodes | PictureKind::CostPrimitives => COST,
        PictureKind::PacketCost | PictureKind::PacketSize => PACKET,
    }]
}

/// Whether a layer is of the pixel's middle: it is the same whichever samples are traced.
pub(crate) fn is_of_middle(layer: &str) -> bool {
    [DEPTH, NORMAL, PRIMITIVE].iter().any(|plan| plan.name == layer)
}

/// Whether a channel has whole numbers.
pub(crate) fn is_whole(channel: &str) -> bool {
    ["id", "count"].contains(&channel)
}

/// The channel's name in an OpenEXR file.
pub(crate) fn name_in_file(layer: &str, channel: &str) -> String {
    match layer {
        "color" => channel.to_owned(),
        layer => format!("{layer}.{channel}"),
    }
}
