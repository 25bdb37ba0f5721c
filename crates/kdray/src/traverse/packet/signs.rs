//! The signs of a direction, which say for every plane which child is near.

use crate::geometry::Ray;

/// On which axes a ray goes backward. Zero goes forward, whatever its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Signs {
    backward: [bool; 3],
}

impl Signs {
    pub(super) fn of(ray: &Ray<3>) -> Self {
        Self { backward: ray.direction.map(|d| d < 0.0) }
    }

    pub(super) fn is_forward(self, axis: usize) -> bool {
        !self.backward[axis]
    }

    /// `distance` as the rays go: positive for a plane ahead.
    pub(super) fn ahead(self, axis: usize, distance: f64) -> f64 {
        if self.backward[axis] { -distance } else { distance }
    }
}
