//! A hit as a place from which rays start.

use super::offset::BoundedPoint;
use glam::DVec3;
use kdray::{Hit, Ray, Side, TriangleMesh};

/// The point at which a ray has hit a triangle, for rays that go on from there.
///
/// Such rays do not meet the triangle that they leave, and miss nothing behind it: their origin is
/// moved just beyond what the rounding of the point can be, to the side that they point to. Only a
/// sliver so thin that f64 cannot tell its normal may be met again. The method and its limit are in
/// the guide, `docs/guide/rendering.md`.
#[derive(Clone, Copy, Debug)]
pub struct HitPoint {
    pub(crate) point: BoundedPoint,
    /// The unit geometric normal on the side that the ray came from.
    pub(crate) facing: DVec3,
}

impl HitPoint {
    /// Where `ray` hit a triangle of `mesh`; `hit` is one of its hits.
    pub fn new(mesh: &TriangleMesh, ray: &Ray, hit: &Hit) -> Self {
        let corners = mesh.corners(hit.primitive_id).map(|p| DVec3::from(p.map(f64::from)));
        let facing = match (geometric_normal(corners), hit.side) {
            (Some(normal), Side::Front) => normal,
            (Some(normal), Side::Back) => -normal,
            // The triangle is a line as far as f64 can tell.
            (None, _) => -unit(ray.direction.into()),
        };
        Self { point: BoundedPoint::on_triangle(corners, hit.u, hit.v), facing }
    }

    /// The point as computed, within rounding of the triangle.
    pub fn position(&self) -> [f64; 3] {
        self.point.position().into()
    }

    /// The unit geometric normal on the side that the ray came from.
    pub fn facing(&self) -> [f64; 3] {
        self.facing.into()
    }

    /// The ray from here along `direction`.
    pub fn ray_along(&self, direction: impl Into<[f64; 3]>) -> Ray {
        let direction = direction.into();
        Ray::new(self.point.leave(self.facing, direction.into()), direction)
    }

    /// The ray from here that is at `target` for t = 1.
    pub fn ray_to(&self, target: impl Into<[f64; 3]>) -> Ray {
        let target = target.into();
        let direction = DVec3::from(target) - self.point.position();
        Ray::through(self.point.leave(self.facing, direction), target)
    }
}

/// The direction in unit length. Scaled first, so that neither tiny nor huge ones leave the range
/// of f64.
fn unit(direction: DVec3) -> DVec3 {
    (direction / direction.abs().max_element()).normalize()
}

fn geometric_normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let (e1, e2) = (b - a, c - a);
    // Scaled first, so that neither tiny nor huge triangles leave the range of f64.
    let scale = e1.abs().max(e2.abs()).max_element();
    (e1 / scale).cross(e2 / scale).try_normalize()
}
