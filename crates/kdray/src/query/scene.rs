//! Triangles with their trees.

use super::{Arithmetic, ShapeScene};
use crate::build::{BuildError, BuildOptions, BuildProgress};
use crate::geometry::Ray;
use crate::layout::WideTree;
use crate::primitives::{Hit, TriangleMesh};
use crate::simd::InstructionSet;
use crate::traverse::AllHits;
use crate::traverse::wide::{Any, Closest, NoAim, Single};
use crate::tree::KdTree;
use std::ops::ControlFlow;

/// A triangle mesh with a kd-tree over it, ready for queries from any thread.
///
/// A ray that [`Ray::check`] refuses hits nothing.
///
/// ```
/// use kdray::{BuildOptions, Ray, Scene, TriangleMesh};
/// let mesh = TriangleMesh::new(
///     vec![[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]],
///     vec![[0, 1, 2]],
/// )?;
/// let scene = Scene::build(mesh, &BuildOptions::default())?;
/// let ray = Ray::new([0.25, 0.25, 0.0], [0.0, 0.0, 1.0]);
/// let hit = scene.closest_hit(&ray).expect("the ray points at the triangle");
/// assert_eq!((hit.primitive_id, hit.t, hit.u, hit.v), (0, 2.0, 0.25, 0.25));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Scene {
    shapes: ShapeScene<TriangleMesh>,
    pub(super) wide: Option<WideTree>,
    pub(super) arithmetic: Arithmetic,
    pub(super) instructions: InstructionSet,
}

impl Scene {
    /// Builds the trees over `mesh`.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(mesh: TriangleMesh, options: &BuildOptions) -> Result<Self, BuildError> {
        Self::build_with_progress(mesh, options, &|_| ControlFlow::Continue(()))
    }

    /// Builds the trees over `mesh`, tells `progress` how far it is, and stops if that answers
    /// [`ControlFlow::Break`].
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build_with_progress(
        mesh: TriangleMesh,
        options: &BuildOptions,
        progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
    ) -> Result<Self, BuildError> {
        let shapes = ShapeScene::build_with_progress(mesh, options, progress)?;
        let wide = WideTree::new(shapes.tree(), shapes.primitives());
        let (arithmetic, instructions) = (Arithmetic::default(), InstructionSet::best());
        Ok(Self { shapes, wide, arithmetic, instructions })
    }

    /// The same scene, with hits decided by `arithmetic`.
    #[must_use]
    pub fn with_arithmetic(self, arithmetic: Arithmetic) -> Self {
        Self { arithmetic, ..self }
    }

    /// The same scene, with kernels of another instruction set than the best.
    #[must_use]
    pub fn with_instructions(self, instructions: InstructionSet) -> Self {
        Self { instructions, ..self }
    }

    /// What rays are tested against.
    pub fn mesh(&self) -> &TriangleMesh {
        self.shapes.primitives()
    }

    /// Gives the mesh back.
    pub fn into_mesh(self) -> TriangleMesh {
        self.shapes.into_primitives()
    }

    /// The canonical tree.
    pub fn tree(&self) -> &KdTree {
        self.shapes.tree()
    }

    /// The wide tree, unless the mesh is out of its range: see [`WideTree::new`].
    pub fn wide_tree(&self) -> Option<&WideTree> {
        self.wide.as_ref()
    }

    /// The same mesh and canonical tree with the scalar traversal, which can be watched.
    pub fn shapes(&self) -> &ShapeScene<TriangleMesh> {
        &self.shapes
    }

    /// The hit of least t; of several at the same t, the one of the smallest primitive id.
    #[must_use]
    pub fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        let Some(tree) = &self.wide else { return self.shapes.closest_hit(ray) };
        let found = match self.arithmetic {
            Arithmetic::Exact => self.instructions.run(Single::<Closest<true>>::new(tree, ray)),
            Arithmetic::Float => self.instructions.run(Single::<Closest<false>>::new(tree, ray)),
        };
        match found {
            Ok(hit) => hit,
            Err(NoAim::Missed) => None,
            Err(NoAim::OutOfRange) => self.shapes.closest_hit(ray),
        }
    }

    /// Whether there is any hit: whether `ray.interval` is occluded.
    #[must_use]
    pub fn any_hit(&self, ray: &Ray) -> bool {
        let Some(tree) = &self.wide else { return self.shapes.any_hit(ray) };
        let found = match self.arithmetic {
            Arithmetic::Exact => self.instructions.run(Single::<Any<true>>::new(tree, ray)),
            Arithmetic::Float => self.instructions.run(Single::<Any<false>>::new(tree, ray)),
        };
        match found {
            Ok(is_hit) => is_hit,
            Err(NoAim::Missed) => false,
            Err(NoAim::OutOfRange) => self.shapes.any_hit(ray),
        }
    }

    /// What [`any_hit`](Self::any_hit) found: some hit, not necessarily the first, but the same
    /// one on every run.
    #[must_use]
    pub fn occluder(&self, ray: &Ray) -> Option<Hit> {
        self.shapes.occluder(ray)
    }

    /// Every crossing of a surface, once, by rising t
    /// ([`HitRule::Crossing`](crate::primitives::HitRule::Crossing)), found as they are asked for.
    pub fn all_hits(&self, ray: &Ray) -> AllHits<'_, TriangleMesh, 3> {
        self.shapes.all_hits(ray)
    }

    /// Every triangle that the ray touches, by rising t
    /// ([`HitRule::Touching`](crate::primitives::HitRule::Touching)): on a shared edge each of its
    /// triangles.
    pub fn all_touched(&self, ray: &Ray) -> AllHits<'_, TriangleMesh, 3> {
        self.shapes.all_touched(ray)
    }

    /// How many surfaces the ray crosses: the number of [`all_hits`](Self::all_hits). On a closed
    /// mesh it is even for a ray from outside without end, and odd for one from inside.
    #[must_use]
    pub fn count(&self, ray: &Ray) -> usize {
        self.shapes.count(ray)
    }
}
