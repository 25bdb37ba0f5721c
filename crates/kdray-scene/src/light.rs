//! What lights a scene.

/// A light in world space. Colours are linear RGB of any brightness.
#[derive(Clone, Debug, PartialEq)]
pub enum Light {
    /// Light from a point.
    Point {
        /// Where it is.
        position: [f64; 3],
        /// Radiant intensity (W/sr): what arrives at distance r is `intensity / r²`.
        intensity: [f32; 3],
        /// A spot light's cone; `None` shines everywhere.
        cone: Option<Cone>,
    },
    /// Parallel light, such as the sun's.
    Directional {
        /// Which way the light travels; any length but zero.
        direction: [f64; 3],
        /// Irradiance (W/m²) on a surface that faces it.
        irradiance: [f32; 3],
    },
    /// A parallelogram that shines on the side that `edge_u x edge_v` points to. Casts soft shadows.
    Rectangle {
        /// One corner.
        corner: [f64; 3],
        /// From the corner along one side.
        edge_u: [f64; 3],
        /// From the corner along the other side.
        edge_v: [f64; 3],
        /// Emitted radiance (W/m²/sr).
        radiance: [f32; 3],
    },
}

/// The cone of a spot light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Which way the light travels in the middle; any length but zero.
    pub direction: [f64; 3],
    /// Full brightness within this angle from the middle, in radians.
    pub inner_angle: f32,
    /// Dark beyond this angle, in radians.
    pub outer_angle: f32,
}
