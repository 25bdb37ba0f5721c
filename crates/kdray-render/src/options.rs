//! What to render, and how well.

use crate::camera::{Y_UP, direction};
use crate::part::Crop;
use glam::{DVec3, Vec3};
use std::ops::Range;

/// The most camera rays that a pixel may have.
pub(crate) const MAX_SAMPLES: u32 = 65_536;

/// What a render computes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PictureKind {
    /// Light: materials, lights, shadows, mirrors and glass.
    #[default]
    Shaded,
    /// The distance from the ray's start to the hit, in world units; infinite for a miss.
    Depth,
    /// The shading normal, turned to the viewer, in world space; zero for a miss.
    Normal,
    /// The id of the triangle; `u32::MAX` for a miss.
    PrimitiveId,
    /// The share of the sky that the surface sees, 1 where nothing is near.
    AmbientOcclusion,
    /// What the tree costs a ray: nodes visited plus primitives tested.
    Cost,
    /// Inner nodes and leaves visited by a ray.
    CostNodes,
    /// Primitives tested against a ray.
    CostPrimitives,
    /// What camera rays cost in packets: node decisions, triangles set up and tests of eight rays, by
    /// the number of rays. Of rays that are traced one by one only what was done for them in vain.
    PacketCost,
    /// How many camera rays go together: rays by the number of packets, of which a ray that is traced
    /// alone is one.
    PacketSize,
}

/// What rays see that hit nothing. Colours are linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// One colour everywhere.
    Color([f32; 3]),
    /// A sky: `horizon` below and at the horizon, blending to `zenith` overhead.
    Gradient {
        /// The colour of directions at or below the horizon.
        horizon: [f32; 3],
        /// The colour of `up`.
        zenith: [f32; 3],
        /// The direction overhead, such as [`Y_UP`], of any length but zero.
        up: [f64; 3],
    },
}

/// What to render, and how well.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderOptions {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Camera rays per pixel, stratified over it; a single one goes through the pixel's middle.
    /// Depth, normal and primitive id always take one.
    pub samples: u32,
    /// The pixels to render; `None` for all. A pixel is the same bit for bit in every crop.
    pub crop: Option<Crop>,
    /// Which of each pixel's `samples` rays to trace; `None` for all. Each ray is the same as when all
    /// are traced, and a layer has the mean of those that were.
    pub sample_range: Option<Range<u32>>,
    /// How many times a ray may be mirrored or refracted; then it brings the ambient light.
    pub max_bounces: u32,
    /// What to compute, and what a PNG shows.
    pub picture: PictureKind,
    /// Traces rays in packets that share an origin, a direction or a target: those from the camera,
    /// those to lamps without size. The picture is the same, only time differs.
    pub packets: bool,
    /// Computes every [`PictureKind`]'s layers, for OpenEXR.
    pub all_layers: bool,
    /// Chooses the random numbers: the same seed gives the same picture.
    pub seed: u64,
    /// What rays see that hit nothing.
    pub background: Background,
    /// Radiance that reaches every surface from all around, Whitted's ambient light.
    pub ambient: [f32; 3],
    /// Rays per camera ray by which the surroundings may block ambient light; 0 leaves it as it is.
    pub ambient_rays: u32,
    /// How far blocking surfaces count, in world units, for `ambient_rays` and
    /// [`PictureKind::AmbientOcclusion`]; `None` is a tenth of the scene's diagonal.
    pub occlusion_distance: Option<f64>,
    /// Shadow rays per camera ray and rectangular light, spread over the light.
    pub light_samples: u32,
    /// What a PNG multiplies colours by. OpenEXR keeps them as they are.
    pub exposure: f32,
    /// The cost that has the last colour of a heat map's scale; `None` is the 99.5th percentile.
    pub heat_max: Option<f32>,
}

impl Default for RenderOptions {
    fn default() -> Self {
        Self {
            width: 960,
            height: 540,
            samples: 16,
            crop: None,
            sample_range: None,
            max_bounces: 8,
            picture: PictureKind::Shaded,
            packets: true,
            all_layers: false,
            seed: 0,
            background: Background::default(),
            ambient: [0.16, 0.18, 0.215],
            ambient_rays: 1,
            occlusion_distance: None,
            light_samples: 2,
            exposure: 1.0,
            heat_max: None,
        }
    }
}

impl RenderOptions {
    /// The pixels to render.
    pub(crate) fn window(&self) -> Crop {
        self.crop.unwrap_or(Crop { x: 0, y: 0, width: self.width, height: self.height })
    }

    /// Which of each pixel's rays to trace.
    pub(crate) fn strata(&self) -> Range<u32> {
        self.sample_range.clone().unwrap_or(0..self.samples)
    }
}

impl Default for Background {
    fn default() -> Self {
        Self::sky(Y_UP)
    }
}

impl Background {
    /// A blue sky, which is deepest where `up` points.
    pub fn sky(up: [f64; 3]) -> Self {
        Self::Gradient { horizon: [0.82, 0.88, 0.95], zenith: [0.14, 0.3, 0.68], up }
    }

    /// The same, with an `up` of length one; `None` if it has no direction.
    pub(crate) fn upright(self) -> Option<Self> {
        match self {
            Self::Color(_) => Some(self),
            Self::Gradient { horizon, zenith, up } => {
                Some(Self::Gradient { horizon, zenith, up: direction(up)?.into() })
            }
        }
    }

    /// The radiance that arrives against the unit vector `direction`, if `up` is one, too.
    pub(crate) fn radiance(&self, direction: DVec3) -> Vec3 {
        match *self {
            Self::Color(color) => color.into(),
            Self::Gradient { horizon, zenith, up } => {
                let height = direction.dot(up.into()).clamp(0.0, 1.0).sqrt() as f32;
                Vec3::from(horizon).lerp(zenith.into(), height)
            }
        }
    }
}

impl PictureKind {
    /// Every kind once.
    pub const ALL: [Self; 10] = [
        Self::Shaded,
        Self::Depth,
        Self::Normal,
        Self::PrimitiveId,
        Self::AmbientOcclusion,
        Self::Cost,
        Self::CostNodes,
        Self::CostPrimitives,
        Self::PacketCost,
        Self::PacketSize,
    ];

    /// Its name in words: `shaded`, `primitive-id`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Shaded => "shaded",
            Self::Depth => "depth",
            Self::Normal => "normal",
            Self::PrimitiveId => "primitive-id",
            Self::AmbientOcclusion => "ambient-occlusion",
            Self::Cost => "cost",
            Self::CostNodes => "cost-nodes",
            Self::CostPrimitives => "cost-primitives",
            Self::PacketCost => "packet-cost",
            Self::PacketSize => "packet-size",
        }
    }
}
