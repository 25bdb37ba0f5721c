//! How thick the material behind a surface is.

use super::{Precision, Scene};
use crate::exact::has_area;
use crate::geometry::Ray;
use crate::primitives::{Side, in_range};

/// A weight this small counts as none: what u and v of hits may be off by.
const NO_WEIGHT: f64 = 1.0 / (1u64 << 30) as f64;

/// A sine for which rounding leaves digits of the normal.
const THIN: f64 = 1.0 / (1u64 << 40) as f64;

impl<T: Precision> Scene<T> {
    /// How far it is from a point of a triangle, straight through the material behind it, to the
    /// next surface. The point has the barycentric weights u and v, as hits and closest points have
    /// them; `side` is the side that is seen from outside, and the way leads off the other side, at
    /// a right angle, as far as the triangle's vertices tell it: those of a sliver may not. This is what trimesh calls thickness by the method `ray`.
    ///
    /// The triangle that the point lies on is not met again, and if the point lies on its edge or
    /// in its corner, nor are the others there: all triangles that have the same corners, of those
    /// whose weight is above 2^-30. Any other surface counts, however near; but the way begins at the
    /// point rounded to f64, so one that is nearer than some units in the last place of the point's
    /// coordinates may be behind it.
    ///
    /// `None` if there is no surface on the way, the triangle has no area, there is no such
    /// triangle, or the weights are not from 0 to 1, give or take 2^-30.
    ///
    /// ```
    /// # use kdray::{BuildOptions, Scene, Side, TriangleMesh};
    /// let corners = vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
    /// let faces = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    /// let scene = Scene::build(TriangleMesh::new(corners, faces)?, &Default::default())?;
    /// // From (1, 1, 0) up to the slanted face.
    /// assert_eq!(scene.thickness(0, 0.25, 0.25, Side::Front), Some(2.0));
    /// assert_eq!(scene.thickness(0, 0.25, 0.25, Side::Back), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn thickness(&self, primitive_id: u32, u: f64, v: f64, side: Side) -> Option<f64> {
        T::thickness(self, primitive_id, [u, v], side)
    }

    /// What [`Precision`] compiles.
    pub(super) fn find_thickness(
        &self,
        primitive_id: u32,
        [u, v]: [f64; 2],
        side: Side,
    ) -> Option<f64> {
        if primitive_id as usize >= self.mesh().triangles().len() {
            return None;
        }
        let weights = [1.0 - u - v, u, v];
        if !weights.iter().all(|weight| (-NO_WEIGHT..=1.0 + NO_WEIGHT).contains(weight)) {
            return None;
        }
        let ray = self.inward(primitive_id, [u, v], side)?;
        let corners = self.mesh().corners(primitive_id);
        let held = (0..3).filter(|&i| weights[i] > NO_WEIGHT).map(|i| corners[i]);
        let held: arrayvec::ArrayVec<_, 3> = held.collect();
        let starts_here = |id| {
            let others = self.mesh().corners(id);
            held.iter().all(|corner| others.contains(corner))
        };
        let behind = self.shapes().closest_hit_where(&ray, |hit| !starts_here(hit.primitive_id));
        behind.map(|hit| hit.t / self.mesh().tree_space().scale())
    }

    /// The ray from a point of a triangle away from `side`, with a direction as long as a unit of the
    /// tree; `None` if the triangle has no area.
    fn inward(&self, primitive_id: u32, [u, v]: [f64; 2], side: Side) -> Option<Ray> {
        let corners = self.mesh().corners(primitive_id).map(|p| p.map(T::to_f64));
        let ([a, b, c], scale) = in_range(corners);
        let normal = (b - a).cross(c - a);
        let is_thin = normal.length() <= THIN * (b - a).length() * (c - a).length();
        if is_thin && !has_area(corners) {
            return None;
        }
        let normal = normal.try_normalize()?;
        let unit = self.mesh().tree_space().scale();
        let direction = if side == Side::Front { -normal } else { normal } / unit;
        let origin = a + (u * (b - a) + v * (c - a));
        Some(Ray::new(scale.point_back(origin), direction))
    }
}
