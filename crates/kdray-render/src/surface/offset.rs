//! Where rays start that leave a surface.
//!
//! A computed hit point is not quite on its triangle, so a ray from it could hit the triangle it
//! leaves (acne) or miss what it should pass into (a leak). The usual cure, a distance chosen for
//! the scene, is too large here and too small there. kdray decides hits exactly, also on which side
//! of a triangle a ray's f64 origin lies. So it is enough to know how far the computed point can be
//! from the plane, and to move it just over that (Pharr, Jakob and Humphreys, *Physically Based
//! Rendering*, section 6.8, there for f32):
//!
//! - The point is p = a + u·(b−a) + v·(c−a), evaluated in f64. Whatever the errors of u and v, the
//!   exact value of this formula lies in the triangle's plane. Each coordinate is rounded in the
//!   difference, the product and the two sums, which are at most four roundings of 2^-53 on terms
//!   that sum to |a| + |u·(b−a)| + |v·(c−a)|.
//! - The distance of p from the plane is then at most |n|·error. The origin is moved along the
//!   geometric normal by twice that, for the errors in n itself, to the side that the new ray's
//!   direction points to; then each coordinate is rounded away from the surface.
//!
//! For a scene of any size that is a few 1e-15 of the coordinates.
//!
//! The limit: n is computed from f64 differences of the corners. Of a sliver whose height is less
//! than 1e-12 of its length, little more than rounding may be left in n, and the origin may come to
//! lie on the other side.

use glam::DVec3;

/// A point of a triangle and the bound of its rounding error per coordinate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoundedPoint {
    position: DVec3,
    error: DVec3,
}

impl BoundedPoint {
    /// The point a + u·(b−a) + v·(c−a).
    pub(crate) fn on_triangle([a, b, c]: [DVec3; 3], u: f64, v: f64) -> Self {
        let (along_b, along_c) = (u * (b - a), v * (c - a));
        let magnitude = a.abs() + along_b.abs() + along_c.abs();
        // Four roundings, and as many again for those in `magnitude`.
        let error = magnitude * (4.0 * f64::EPSILON) + f64::MIN_POSITIVE;
        Self { position: a + (along_b + along_c), error }
    }

    /// The computed point.
    pub(crate) fn position(&self) -> DVec3 {
        self.position
    }

    /// The origin for a ray along `direction`, on the side of the plane with the unit normal
    /// `normal` that the direction points to.
    pub(crate) fn leave(&self, normal: DVec3, direction: DVec3) -> DVec3 {
        let outward = if direction.dot(normal) < 0.0 { -normal } else { normal };
        let distance = 2.0 * outward.abs().dot(self.error);
        let away = |p: f64, n: f64| match n {
            n if n > 0.0 => (p + n * distance).next_up(),
            n if n < 0.0 => (p + n * distance).next_down(),
            _ => p,
        };
        let p = self.position;
        DVec3::new(away(p.x, outward.x), away(p.y, outward.y), away(p.z, outward.z))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kdray::exact::volume;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;
    use std::cmp::Ordering;

    /// Whether the origins to both sides of a random point of the triangle are on their sides.
    fn both_sides_are_right([a, b, c]: [DVec3; 3], random: &mut Pcg64Mcg) -> bool {
        let Some(normal) = (b - a).cross(c - a).try_normalize() else { return true };
        let u = random.random_range(0.0..1.0);
        let point =
            BoundedPoint::on_triangle([a, b, c], u, (1.0 - u) * random.random_range(0.0..1.0));
        let size = [a, b, c].map(|p| p.abs().max_element()).into_iter().fold(0.0, f64::max);
        let corners = [a, b, c].map(|p| p.to_array());
        [(normal, Ordering::Greater), (-normal, Ordering::Less)].into_iter().all(
            |(direction, side)| {
                let origin = point.leave(normal, direction);
                assert!(origin.distance(point.position()) <= 1e-14 * size);
                volume(origin.into(), corners).sign() == side
            },
        )
    }

    /// A point of the cube from −1 to 1.
    fn in_cube(random: &mut Pcg64Mcg) -> DVec3 {
        DVec3::from([(); 3].map(|()| random.random_range(-1.0..1.0)))
    }

    #[test]
    fn the_origin_is_exactly_on_the_side_the_direction_points_to() {
        let mut random = Pcg64Mcg::seed_from_u64(1);
        for center in [0.0, 1.0, 1e6, -1e12] {
            for size in [1e-3, 1.0, 1e4] {
                for _ in 0..500 {
                    let mut corner = || DVec3::splat(center) + size * in_cube(&mut random);
                    let corners = [corner(), corner(), corner()].map(|p| p.as_vec3().as_dvec3());
                    assert!(both_sides_are_right(corners, &mut random), "{corners:?}");
                }
            }
        }
    }

    #[test]
    fn slivers_keep_their_sides_down_to_the_stated_limit() {
        let mut random = Pcg64Mcg::seed_from_u64(2);
        for stretch in [[1.0, 1.0, 1.0], [1e6, 1.0, 1e-4], [1e-4, 1e6, 1.0]].map(DVec3::from) {
            for height in [1e-3, 1e-6, 1e-9, 1e-12] {
                for _ in 0..1000 {
                    // An edge that leads by the origin, its middle, and a corner next to that.
                    let mut corner = |size: f64| (stretch * size * in_cube(&mut random)).as_vec3();
                    let (near, far) = (corner(height), corner(1.0));
                    let corners = [near, far, far / 2.0].map(glam::Vec3::as_dvec3);
                    assert!(both_sides_are_right(corners, &mut random), "{corners:?}");
                }
            }
        }
    }
}
