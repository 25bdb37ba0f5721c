//! Inside or outside.

use super::{Precision, Scene, points};
use crate::exact::is_on_triangle;
use crate::geometry::Ray;
use crate::primitives::Closure;
use crate::traverse::CellWalk;
use crate::traverse::wide::{Crossed, Inside, NoAim, search_along, way_out};

impl<T: Precision> Scene<T> {
    /// Whether `point` is inside the mesh or on its surface. Never so for a point that is not
    /// finite.
    ///
    /// In a closed mesh ([`closure`](Self::closure)) a point is inside if a ray from there crosses
    /// the surface an odd number of times. That is exact, one unit in the last place beside a face,
    /// an edge or a vertex too. Which way triangles face does not matter; a closed part within
    /// another is a hollow, and where two parts overlap is outside: the
    /// [`winding_number`](Self::winding_number) tells such places from others.
    ///
    /// In an open mesh, whose triangles must face outward, a point is inside if the
    /// [`winding_number`](Self::winding_number) is 1/2 or more. It is off by the error said there;
    /// close to the surface, where it leaps by one, the side is told exactly.
    ///
    /// On the surface is exact in all meshes: the point belongs to a triangle, or to the segment or
    /// point that one without area is.
    ///
    /// ```
    /// # use kdray::{BuildOptions, Scene, TriangleMesh};
    /// let corners = vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
    /// let faces = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    /// let scene = Scene::build(TriangleMesh::new(corners, faces)?, &Default::default())?;
    /// assert!(scene.contains([1.0, 1.0, 1.0]));
    /// assert!(scene.contains([1.0, 1.0, 2.0])); // on the slanted face
    /// assert!(!scene.contains([1.0, 1.0, 2.0_f64.next_up()]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn contains(&self, point: [f64; 3]) -> bool {
        T::contains(self, point)
    }

    /// [`contains`](Self::contains) of each point, on this thread: `inside[i]` is that of
    /// `points[i]`. Faster than one after the other in a closed mesh.
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn contains_each(&self, points: &[[f64; 3]], inside: &mut [bool]) {
        assert_eq!(points.len(), inside.len(), "as many answers as points");
        T::contains_each(self, points, inside);
    }

    /// [`contains_each`](Self::contains_each) on all threads of the current rayon pool.
    ///
    /// # Panics
    /// If the slices differ in length.
    #[cfg(feature = "rayon")]
    pub fn par_contains_each(&self, points: &[[f64; 3]], inside: &mut [bool]) {
        points::par_chunks(points, inside, |points, inside| self.contains_each(points, inside));
    }

    /// Whether the mesh is closed, and whether it faces one way. Found out when it is first asked
    /// for, by sorting the edges; clones of the scene share the answer.
    pub fn closure(&self) -> Closure {
        *self.trees.for_points.closure.get_or_init(|| T::closure(self.mesh()))
    }

    /// What [`Precision`] compiles.
    pub(super) fn finds_inside(&self, point: [f64; 3]) -> bool {
        if !point.iter().all(|x| x.is_finite()) {
            return false;
        }
        match self.wide_and_mesh().filter(|_| self.closure().is_closed()) {
            None => self.is_on_surface(point) || self.contains_off_surface(point),
            Some(tree) => self.way_out(point).is_some_and(|ray| {
                let mut crossed = Crossed::default();
                let set = self.instructions;
                match search_along::<Inside<'_, T>>(tree, &ray, set, &mut crossed) {
                    Ok(()) | Err(NoAim::Missed) => crossed.is_inside(),
                    Err(NoAim::OutOfRange) => self.begins_inside(&ray),
                }
            }),
        }
    }

    /// What [`Precision`] compiles: the ways out of a closed mesh in turns.
    pub(super) fn find_inside_each(&self, points: &[[f64; 3]], inside: &mut [bool]) {
        const PORTION: usize = 1024;
        if !self.closure().is_closed() {
            return points::each(points, inside, |point| self.finds_inside(point));
        }
        let mut ways = Vec::with_capacity(PORTION.min(points.len()));
        for (points, inside) in points.chunks(PORTION).zip(inside.chunks_mut(PORTION)) {
            inside.fill(false);
            ways.clear();
            let finite = |point: &[f64; 3]| point.iter().all(|x| x.is_finite());
            let numbered = points.iter().enumerate().filter(|(_, point)| finite(point));
            ways.extend(numbered.filter_map(|(i, &point)| Some((i, self.way_out(point)?))));
            let one = |ray: &Ray| Crossed::of(self.finds_inside(ray.origin));
            let rays = ways.iter().map(|(_, ray)| ray);
            self.each::<Inside<'_, T>>(rays, one, |way, crossed| {
                inside[ways[way].0] = crossed.is_inside();
            });
        }
    }

    /// Whether a closed mesh holds the origin of a ray, by the scalar traversal.
    fn begins_inside(&self, ray: &Ray) -> bool {
        self.is_on_surface(ray.origin) || self.shapes().count(ray) % 2 == 1
    }

    /// Whether a point with finite coordinates lies on a triangle. Exact: a point of a triangle is, in the
    /// tree, in the cell of a leaf that lists it, whatever was rounded on the way there.
    pub(super) fn is_on_surface(&self, point: [f64; 3]) -> bool {
        let mesh = self.mesh();
        let mut cells = CellWalk::new(self.tree(), mesh.tree_space().point(point));
        std::iter::from_fn(|| cells.next_leaf(0.0)).flatten().any(|&id| {
            let corners = mesh.corners(id).map(|p| p.map(T::to_f64));
            is_on_triangle(point, corners)
        })
    }

    /// [`contains`](Self::contains) for a point with finite coordinates that is not on the surface.
    pub(super) fn contains_off_surface(&self, point: [f64; 3]) -> bool {
        if self.closure().is_closed() {
            self.way_out(point).is_some_and(|ray| self.count(&ray) % 2 == 1)
        } else {
            self.winding_number(point) >= 0.5
        }
    }

    /// A ray from the point to the nearest face of the box around the mesh, and on ([`way_out`]); `None` if the
    /// point is outside of it. Its t are some units of the tree.
    pub(super) fn way_out(&self, point: [f64; 3]) -> Option<Ray> {
        let (bounds, space) = (self.tree().bounds(), self.mesh().tree_space());
        let in_tree = space.point(point);
        if !bounds.contains(in_tree) {
            return None;
        }
        let ways = (0..3).flat_map(|axis| {
            let (min, max) = (f64::from(bounds.min[axis]), f64::from(bounds.max[axis]));
            [(axis, -1.0, in_tree[axis] - min), (axis, 1.0, max - in_tree[axis])]
        });
        let (axis, sign, _) = ways.min_by(|a, b| a.2.total_cmp(&b.2))?;
        Some(Ray::new(point, way_out(axis, sign).map(|d| d / space.scale())))
    }
}
