//! Placed copies of scenes.

use crate::geometry::{Aabb, TreeSpace, inverse_power_of_two};
use crate::primitives::Hit;
use glam::{DAffine3, DMat3, DVec3};
use std::cmp::Ordering;
use thiserror::Error;

/// A copy of a geometry, placed in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// The index of the geometry among those of the scene.
    pub geometry_id: u32,
    /// From the geometry's space to the world: three rows of a 3 x 4 matrix. The world's point is the
    /// sum of the first three columns times the geometry's coordinates, and the fourth.
    pub to_world: [[f64; 4]; 3],
    /// Who sees it: rays whose mask shares a bit with it.
    pub mask: u32,
}

impl Instance {
    /// The matrix that moves nothing.
    pub const IDENTITY: [[f64; 4]; 3] =
        [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

    /// A copy of a geometry where it is, seen by all rays.
    pub fn of(geometry_id: u32) -> Self {
        Self { geometry_id, to_world: Self::IDENTITY, mask: u32::MAX }
    }

    /// The same copy, placed by a matrix (see [`to_world`](Self::to_world)).
    #[must_use]
    pub fn placed(self, to_world: [[f64; 4]; 3]) -> Self {
        Self { to_world, ..self }
    }

    /// The same copy, moved by `offset` from where the geometry is.
    #[must_use]
    pub fn moved(self, offset: impl Into<[f64; 3]>) -> Self {
        let mut to_world = Self::IDENTITY;
        to_world.iter_mut().zip(offset.into()).for_each(|(row, offset)| row[3] = offset);
        self.placed(to_world)
    }

    /// The same copy, seen by rays whose mask shares a bit with `mask`.
    #[must_use]
    pub fn masked(self, mask: u32) -> Self {
        Self { mask, ..self }
    }
}

/// Why scenes cannot be placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum InstanceError {
    /// An instance names a geometry that is not there.
    #[error(
        "instance {instance} is of geometry {geometry_id}, but there are only {geometries}; add the missing ones, or choose another"
    )]
    NoSuchGeometry {
        /// The index of the instance.
        instance: usize,
        /// The geometry it names.
        geometry_id: u32,
        /// How many there are.
        geometries: usize,
    },
    /// A matrix is not finite, or so nearly flat that f64 cannot turn it back: its inverse, times the matrix, is
    /// not the identity to 2^-26.
    #[error("the matrix of instance {0} cannot be inverted; give one that flattens nothing")]
    Singular(usize),
    /// A copy, or what rounding may make of its place, lies beyond the largest f64.
    #[error("instance {0} lies beyond the range of f64; place it nearer to the origin")]
    OutOfRange(usize),
    /// There are 2^30 instances or more.
    #[error("there are {0} instances, but at most 1073741823 fit one tree; make fewer")]
    TooMany(usize),
}

/// A hit on an instance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InstanceHit {
    /// The hit as on the geometry alone. Its t is that of the world's ray; its side is that of the
    /// geometry, so that a mirrored copy of a closed mesh has its front outside as well.
    pub hit: Hit,
    /// The index of the instance.
    pub instance_id: u32,
    /// The index of its geometry.
    pub geometry_id: u32,
}

impl InstanceHit {
    /// The order of hits along a ray: by t, then by instance, then by primitive.
    pub fn order(&self, other: &Self) -> Ordering {
        // Adding zero makes -0 and 0 one.
        let by_t = (self.hit.t + 0.0).total_cmp(&(other.hit.t + 0.0));
        by_t.then(self.instance_id.cmp(&other.instance_id)).then(self.hit.order(&other.hit))
    }

    pub(super) fn precedes(&self, other: &Self) -> bool {
        self.order(other) == Ordering::Less
    }
}

/// By how much of the scene's size the box of an instance is widened, for what carrying rounds of rays that come
/// from far away, see [`InstancedScene`].
///
/// [`InstancedScene`]: super::InstancedScene
const WIDENED: f64 = 1.0 / (1 << 28) as f64;

/// By how much the matrix times its inverse may differ from the identity.
const INVERSE_ERROR: f64 = 1.0 / (1 << 26) as f64;

/// A bound for what carrying a point there and back rounds, in units of its coordinates times how unevenly the
/// matrix stretches: some ten roundings.
const CARRYING_ERROR: f64 = 32.0 * f64::EPSILON;

/// Where an instance is.
pub(super) struct Place {
    /// The way back from the world into its space.
    pub(super) to_object: DAffine3,
    /// The corners of a box in the world that holds it.
    pub(super) low: DVec3,
    pub(super) high: DVec3,
    /// Whether nothing is placed there.
    pub(super) is_empty: bool,
    /// How far from there it may be for rays, which are carried by an inverse that is rounded.
    pub(super) error: f64,
}

impl Place {
    /// That of the instance of that index; `corners` are those of the box of its geometry, if there is
    /// anything in it. A geometry without triangles is a point.
    pub(super) fn of(
        index: usize,
        instance: &Instance,
        corners: Option<[[f64; 3]; 2]>,
    ) -> Result<Self, InstanceError> {
        let to_world = affine(&instance.to_world);
        let (scaled, unit) = scaled(&to_world.matrix3);
        let scaled_inverse = scaled.try_inverse().ok_or(InstanceError::Singular(index))?;
        let inverse = scaled_inverse * unit;
        let to_object =
            DAffine3 { matrix3: inverse, translation: -(inverse * to_world.translation) };
        let inverse_error = norm(&(to_world.matrix3 * to_object.matrix3 - DMat3::IDENTITY));
        // A NaN is refused as well.
        if !(inverse_error <= INVERSE_ERROR && to_world.is_finite() && to_object.is_finite()) {
            return Err(InstanceError::Singular(index));
        }
        let is_empty = corners.is_none();
        let corners = corners.unwrap_or_default();
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for corner in 0..8 {
            let corner = DVec3::from([0, 1, 2].map(|axis| corners[corner >> axis & 1][axis]));
            let corner = to_world.transform_point3(corner);
            (low, high) = (low.min(corner), high.max(corner));
        }
        let uneven = norm(&scaled) * norm(&scaled_inverse);
        let farthest = low.abs().max(high.abs()) + to_world.translation.abs();
        let error = (inverse_error + CARRYING_ERROR * uneven) * farthest.element_sum();
        if (low - error).is_finite() && (high + error).is_finite() {
            Ok(Self { to_object, low, high, is_empty, error })
        } else {
            Err(InstanceError::OutOfRange(index))
        }
    }

    /// A box in the tree over all instances that rays pass through which hit this one.
    pub(super) fn bounds(&self, space: &TreeSpace) -> Aabb<3> {
        let [low, high] = [self.low, self.high].map(|p| DVec3::from(space.point(p.into())));
        let wider = WIDENED * f64::from(TreeSpace::FARTHEST) + self.error * space.scale();
        let min = (low - wider).to_array().map(|x| (x as f32).next_down());
        let max = (high + wider).to_array().map(|x| (x as f32).next_up());
        Aabb { min, max }
    }
}

impl Instance {
    /// The normal of a placed triangle on the side that is the front of the geometry's, of twice its area in length.
    pub(super) fn normal(&self, [a, b, c]: [DVec3; 3]) -> DVec3 {
        let matrix = affine(&self.to_world).matrix3;
        let normal = (matrix * (b - a)).cross(matrix * (c - a));
        // Mirrored, the triangle runs the other way around.
        if self.is_mirrored() { -normal } else { normal }
    }

    /// Whether the matrix, one that can be placed, turns left to right. The front of a triangle is its front all the same.
    pub fn is_mirrored(&self) -> bool {
        scaled(&affine(&self.to_world).matrix3).0.determinant() < 0.0
    }
}

/// The matrix times a power of two, which changes no digit, and that: determinants of very large and very small ones
/// are out of range.
fn scaled(matrix: &DMat3) -> (DMat3, f64) {
    let largest = matrix.to_cols_array().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let unit = inverse_power_of_two(largest);
    (*matrix * unit, unit)
}

/// The same matrix, by columns.
fn affine(rows: &[[f64; 4]; 3]) -> DAffine3 {
    let column = |k: usize| DVec3::new(rows[0][k], rows[1][k], rows[2][k]);
    DAffine3::from_cols(column(0), column(1), column(2), column(3))
}

/// At least the most that a matrix stretches any direction: Frobenius' norm.
fn norm(matrix: &DMat3) -> f64 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(DVec3::length_squared);
    (x + y + z).sqrt()
}
