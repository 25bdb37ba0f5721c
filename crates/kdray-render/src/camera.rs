//! From a pixel to a ray, and a camera for scenes without one.

use glam::{DQuat, DVec3};
use kdray::geometry::Common;
use kdray::{Aabb, Ray};
use kdray_scene::{Camera, Projection};
use thiserror::Error;

/// The y axis, which is up where nothing else is said.
pub const Y_UP: [f64; 3] = [0.0, 1.0, 0.0];

/// The angle between the lower and the upper edge of a framed picture, in degrees.
const FRAME_VFOV_DEGREES: f64 = 40.0;

/// How much of the picture a framed scene may fill.
const FRAME_FILL: f64 = 0.92;

/// Why a camera cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CameraError {
    /// A coordinate is infinite or NaN.
    #[error(
        "the camera's eye, look-at point and up vector must be finite; mend the number that is not"
    )]
    NotFinite,
    /// The camera looks nowhere.
    #[error("the camera's eye and look-at point are the same; move one of them")]
    NoDirection,
    /// The camera's up vector says nothing about how it is turned.
    #[error("the camera's up vector is zero or parallel to the view; give another")]
    NoUp,
    /// The field of view is not an angle that a picture can show.
    #[error("the camera's vertical field of view is {0} degrees; give one between 0 and 180")]
    FieldOfView(f64),
    /// The height of an orthographic picture is not positive.
    #[error("the camera's orthographic height is {0}; give a positive one")]
    Height(f64),
}

/// A camera with a picture in front of it: from a point of the picture to the ray through it.
#[derive(Clone, Copy, Debug)]
pub struct View {
    eye: DVec3,
    /// The unit vector into the scene.
    forward: DVec3,
    /// From the middle of the picture to its right edge: for a perspective camera at distance 1.
    right: DVec3,
    /// From the middle of the picture to its upper edge, likewise.
    up: DVec3,
    orthographic: bool,
}

impl View {
    /// The view of `camera` for a picture that is `aspect` times as wide as high.
    ///
    /// # Errors
    /// What makes the camera unusable.
    pub fn new(camera: &Camera, aspect: f64) -> Result<Self, CameraError> {
        let [eye, look_at, up] = [camera.eye, camera.look_at, camera.up].map(DVec3::from);
        if !(eye.is_finite() && look_at.is_finite() && up.is_finite()) {
            return Err(CameraError::NotFinite);
        }
        let forward = (look_at - eye).try_normalize().ok_or(CameraError::NoDirection)?;
        let unit_up = direction(camera.up).ok_or(CameraError::NoUp)?;
        let across = forward.cross(unit_up);
        let right = if across.length() > 1e-9 { across.normalize() } else { DVec3::ZERO };
        if right == DVec3::ZERO {
            return Err(CameraError::NoUp);
        }
        let half_height = half_height(camera.projection)?;
        Ok(Self {
            eye,
            forward,
            right: right * half_height * aspect,
            up: right.cross(forward) * half_height,
            orthographic: matches!(camera.projection, Projection::Orthographic { .. }),
        })
    }

    /// The ray through the point (x, y) of the picture: (0, 0) is its upper left corner, (1, 1)
    /// its lower right one. The direction has unit length, so t is a distance.
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let offset = self.right * (2.0 * x - 1.0) + self.up * (1.0 - 2.0 * y);
        if self.orthographic {
            return Ray::new(self.eye + offset, self.forward);
        }
        Ray::new(self.eye, (self.forward + offset).normalize())
    }

    /// What all rays share: the eye, or the direction of an orthographic camera.
    pub fn common(&self) -> Common {
        match self.orthographic {
            true => Common::Direction(self.forward.into()),
            false => Common::Origin(self.eye.into()),
        }
    }
}

/// Half the height of the picture at distance 1 (perspective), or in world units.
fn half_height(projection: Projection) -> Result<f64, CameraError> {
    match projection {
        Projection::Perspective { vfov_degrees } if 0.0 < vfov_degrees && vfov_degrees < 180.0 => {
            Ok((vfov_degrees.to_radians() / 2.0).tan())
        }
        Projection::Perspective { vfov_degrees } => Err(CameraError::FieldOfView(vfov_degrees)),
        Projection::Orthographic { height } if 0.0 < height && height.is_finite() => {
            Ok(height / 2.0)
        }
        Projection::Orthographic { height } => Err(CameraError::Height(height)),
    }
}

/// A camera that shows everything in `bounds`: from the front, right and above, just far enough that the
/// box's corners are in a picture `aspect` times as wide as high. An empty box is taken for the unit cube
/// around the origin.
///
/// Above is where `up` points, of any length. With [`Y_UP`], +x is to the right and +z in front; another `up`
/// turns both as it takes the shortest way from there: with z up, -y is in front. An `up` that has no direction gives
/// a camera that cannot be used ([`CameraError::NoUp`], [`CameraError::NotFinite`]).
pub fn frame(bounds: &Aabb<3>, up: [f64; 3], aspect: f64) -> Camera {
    let (center, half) = if bounds.is_empty() {
        (DVec3::ZERO, DVec3::splat(0.5))
    } else {
        (DVec3::from(bounds.center()), DVec3::from(bounds.extent()) / 2.0)
    };
    let turn = turn_from_y(up);
    let backward = DVec3::new(0.55, 0.42, 1.0).normalize();
    let right = DVec3::Y.cross(backward).normalize();
    let [backward, right, upward] = [backward, right, backward.cross(right)].map(|it| turn * it);
    let tan_y = (FRAME_VFOV_DEGREES.to_radians() / 2.0).tan() * FRAME_FILL;
    let tan_x = tan_y * if aspect.is_finite() && aspect > 0.0 { aspect } else { 1.0 };
    let mut distance = 0.0_f64;
    for corner in 0..8 {
        let sign = |bit: i32| if corner & bit == 0 { -1.0 } else { 1.0 };
        let corner = half * DVec3::new(sign(1), sign(2), sign(4));
        let reach = (corner.dot(right).abs() / tan_x).max(corner.dot(upward).abs() / tan_y);
        distance = distance.max(corner.dot(backward) + reach);
    }
    // A single point has no size: look at it from the nearest distance that f64 can tell apart.
    let distance = if distance > 0.0 { distance } else { center.abs().max_element().max(1.0) };
    Camera {
        name: "frame".into(),
        eye: (center + backward * distance).into(),
        look_at: center.into(),
        up,
        projection: Projection::Perspective { vfov_degrees: FRAME_VFOV_DEGREES },
    }
}

/// The unit vector in the direction of one of any length; `None` if it has none.
pub(crate) fn direction(vector: [f64; 3]) -> Option<DVec3> {
    // Squares of very long ones overflow, and of very short ones vanish.
    let vector = DVec3::from(vector);
    (vector / vector.abs().max_element()).try_normalize()
}

/// The rotation that takes the y axis to `up` the shortest way; the identity if that has no direction.
fn turn_from_y(up: [f64; 3]) -> DQuat {
    direction(up).map_or(DQuat::IDENTITY, |up| DQuat::from_rotation_arc(DVec3::Y, up))
}
