//! The box of a target, in f64.

use crate::Subject;
use kdray::{Coordinate, TriangleMesh};

/// Coordinates of more are none that a ray should begin at.
const LARGEST: f64 = 1e306;

/// The least and the greatest coordinates of triangles; of none, the origin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extent {
    /// The least.
    pub min: [f64; 3],
    /// The greatest.
    pub max: [f64; 3],
}

impl Extent {
    /// That of a mesh.
    pub fn of<T: Coordinate>(mesh: &TriangleMesh<T>) -> Self {
        let (min, max) = mesh.extent();
        if min[0] > max[0] { Self::default() } else { Self { min, max } }
    }

    /// As [`Archer`](crate::rays::Archer) takes it.
    pub fn ends(&self) -> ([f64; 3], [f64; 3]) {
        (self.min, self.max)
    }

    /// The middle.
    pub fn center(&self) -> [f64; 3] {
        std::array::from_fn(|k| 0.5 * self.min[k] + 0.5 * self.max[k])
    }

    /// How long it is on each axis.
    pub fn size(&self) -> [f64; 3] {
        std::array::from_fn(|k| self.max[k] - self.min[k])
    }

    /// How long its diagonal is.
    pub fn diagonal(&self) -> f64 {
        self.size().into_iter().fold(0.0, f64::hypot)
    }

    /// The largest coordinate.
    pub fn largest(&self) -> f64 {
        self.min.iter().chain(&self.max).fold(0.0, |most, x| most.max(x.abs()))
    }

    /// How many diagonals away f64 ends.
    pub fn most(&self) -> f64 {
        (LARGEST / self.diagonal().max(self.largest()).max(1.0)).max(1.0)
    }

    /// How near to a surface the last digits of a point, or of a normal, may decide.
    pub fn doubt(&self) -> f64 {
        // Of denormals the last digit is one of these.
        let smallest = f64::from_bits(1);
        1e-9 * self.diagonal() + 1e4 * (f64::EPSILON * self.largest()).max(smallest)
    }

    /// Whether a point is in it.
    pub fn contains(&self, point: [f64; 3]) -> bool {
        (0..3).all(|k| self.min[k] <= point[k] && point[k] <= self.max[k])
    }
}
