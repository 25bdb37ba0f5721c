//! Where a picture is seen from.

/// A camera in world space.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Its name in the file, if any.
    pub name: String,
    /// The observer E.
    pub eye: [f64; 3],
    /// A point in the middle of the picture; differs from `eye`.
    pub look_at: [f64; 3],
    /// What points up in the picture; not parallel to the view.
    pub up: [f64; 3],
    /// How the view is mapped to the picture.
    pub projection: Projection,
}

/// How a view is mapped to a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// All rays start at the eye.
    Perspective {
        /// The angle between the lower and the upper edge of the picture, in degrees.
        vfov_degrees: f64,
    },
    /// All rays are parallel.
    Orthographic {
        /// The height of the picture in world units.
        height: f64,
    },
}
