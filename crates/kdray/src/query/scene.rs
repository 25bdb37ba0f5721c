//! Triangles with their trees.

use super::points::ForPoints;
use super::{Arithmetic, Precision, ShapeScene};
use crate::build::{BuildError, BuildOptions, BuildProgress};
use crate::geometry::Ray;
use crate::layout::{TriangleBlock, WideTree};
use crate::memory::{SharedBytes, Source};
use crate::primitives::{Hit, TriangleMesh};
use crate::simd::InstructionSet;
use crate::traverse::AllHits;
use crate::traverse::wide::{Any, Closest, NoAim, search_along};
use crate::tree::KdTree;
use std::ops::ControlFlow;
use std::sync::Arc;

/// How much of a build the canonical tree is, about, if it is made wide as well.
const CANONICAL_PART: f64 = 0.75;

/// A triangle mesh with a kd-tree over it, ready for queries from any thread. Clones share both.
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
///
/// Vertices are f32 or f64. Those in f64 may lie anywhere: the tree is in coordinates of its own
/// ([`TriangleMesh::tree_space`]), and hits are decided on the vertices as they are.
///
/// ```
/// use kdray::{BuildOptions, Ray, Scene, TriangleMesh};
/// // A millimetre high, in a national grid: f32 would round it away.
/// let (x, y) = (500_000.0, 5_400_000.0);
/// let corners = vec![[x, y, 0.001_f64], [x + 1.0, y, 0.002], [x, y + 1.0, 0.001]];
/// let scene = Scene::build(TriangleMesh::new(corners, vec![[0, 1, 2]])?, &Default::default())?;
/// let hit = scene.closest_hit(&Ray::new([x + 0.5, y + 0.25, 0.0], [0.0, 0.0, 1.0]));
/// assert_eq!(hit.map(|hit| (hit.t * 1e6).round()), Some(1500.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Scene<T: 'static = f32> {
    pub(super) trees: Arc<Trees<T>>,
    pub(super) arithmetic: Arithmetic,
    pub(super) instructions: InstructionSet,
}

#[derive(Debug)]
pub(super) struct Trees<T: 'static> {
    pub(super) shapes: ShapeScene<TriangleMesh<T>>,
    pub(super) wide: Option<WideTree>,
    /// The file that they lie in, if any.
    source: Option<Source>,
    /// What queries about points need besides.
    pub(super) for_points: ForPoints,
}

impl<T: 'static> Clone for Scene<T> {
    fn clone(&self) -> Self {
        Self { trees: Arc::clone(&self.trees), ..*self }
    }
}

impl<T: Precision> Scene<T> {
    /// Builds the trees over `mesh`.
    ///
    /// A tree whose cost was weighed for blocks of eight triangles, as by every
    /// [`Preset`](crate::build::Preset), is made wide; others are for the scalar traversal.
    ///
    /// With the feature `rayon` meshes of a thousand triangles and more, and smaller ones whose trees have thousands of
    /// nodes, are built on the current pool; others on the calling thread alone. A thread of the pool that waits for
    /// others may begin another of its tasks meanwhile: so do not build large meshes in such tasks under a lock, or in a
    /// `OnceLock`, that other tasks wait for.
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build(mesh: TriangleMesh<T>, options: &BuildOptions) -> Result<Self, BuildError> {
        Self::build_with_progress(mesh, options, &|_| ControlFlow::Continue(()))
    }

    /// Builds the trees over `mesh`, tells `progress` how far it is, and stops if that answers
    /// [`ControlFlow::Break`].
    ///
    /// # Errors
    /// See [`BuildError`].
    pub fn build_with_progress(
        mesh: TriangleMesh<T>,
        options: &BuildOptions,
        progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
    ) -> Result<Self, BuildError> {
        T::build(mesh, options, progress)
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
    pub fn mesh(&self) -> &TriangleMesh<T> {
        self.trees.shapes.primitives()
    }

    /// Gives the mesh back; a copy if other clones of the scene are in use.
    pub fn into_mesh(self) -> TriangleMesh<T> {
        match Arc::try_unwrap(self.trees) {
            Ok(trees) => trees.shapes.into_primitives(),
            Err(shared) => shared.shapes.primitives().clone(),
        }
    }

    /// The canonical tree.
    pub fn tree(&self) -> &KdTree {
        self.trees.shapes.tree()
    }

    /// The wide tree; `None` if the options did not ask for it, or the mesh is out of the range of
    /// its f32: larger than 2^32 or smaller than 2^-32, or the tree larger than 16 GiB or
    /// deeper than the kernels' stacks.
    pub fn wide_tree(&self) -> Option<&WideTree> {
        self.trees.wide.as_ref()
    }

    /// The same mesh and canonical tree with the scalar traversal, which can be watched.
    pub fn shapes(&self) -> &ShapeScene<TriangleMesh<T>> {
        &self.trees.shapes
    }

    /// The hit of least t; of several at the same t, the one of the smallest primitive id. What the ray touches
    /// counts ([`HitRule::Touching`](crate::primitives::HitRule::Touching)), edges and vertices, too.
    #[must_use]
    pub fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        T::closest_hit(self, ray)
    }

    /// Whether there is any hit: whether `ray.interval` is occluded. What the ray touches counts, so that there may be
    /// one where [`count`](Self::count) is 0.
    #[must_use]
    pub fn any_hit(&self, ray: &Ray) -> bool {
        T::any_hit(self, ray)
    }

    /// Every crossing of a surface, once, by rising t
    /// ([`HitRule::Crossing`](crate::primitives::HitRule::Crossing)), found as they are asked for.
    /// By the scalar traversal: [`all_hits_into`](Self::all_hits_into) is faster.
    pub fn all_hits(&self, ray: &Ray) -> AllHits<'_, TriangleMesh<T>, 3> {
        self.trees.shapes.all_hits(ray)
    }

    /// Every triangle that the ray touches, by rising t
    /// ([`HitRule::Touching`](crate::primitives::HitRule::Touching)): on a shared edge each of its
    /// triangles.
    pub fn all_touched(&self, ray: &Ray) -> AllHits<'_, TriangleMesh<T>, 3> {
        self.trees.shapes.all_touched(ray)
    }
}

/// Scenes of tree files.
impl<T: Precision> Scene<T> {
    /// Trees over `mesh` as they are, which lie in the bytes of `source` if it is given.
    pub(crate) fn of_trees(
        mesh: TriangleMesh<T>,
        tree: KdTree,
        wide: Option<WideTree>,
        source: Option<SharedBytes>,
    ) -> Self {
        let shapes = ShapeScene::of_tree(mesh, tree);
        Self::of_parts(shapes, wide, source.map(Source))
    }

    /// The bytes that the trees lie in, if they came with the scene.
    pub(crate) fn source(&self) -> Option<&[u8]> {
        self.trees.source.as_ref().map(|Source(bytes)| (**bytes).as_ref())
    }
}

/// What [`Precision`] compiles.
impl<T: Precision> Scene<T> {
    pub(super) fn of_mesh(
        mesh: TriangleMesh<T>,
        options: &BuildOptions,
        progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
    ) -> Result<Self, BuildError> {
        let (shapes, wide) = if options.cost.block == TriangleBlock::WIDTH {
            let tell = |fraction| progress(BuildProgress { fraction });
            let (tree, boxes) = KdTree::build_with_boxes(&mesh, options, &|done| {
                tell(CANONICAL_PART * done.fraction)
            })?;
            let wide = WideTree::new(&tree, &boxes, &mesh, options, &|done| {
                tell(CANONICAL_PART + (1.0 - CANONICAL_PART) * done.fraction)
            })?;
            (ShapeScene::of_tree(mesh, tree), wide)
        } else {
            (ShapeScene::build_with_progress(mesh, options, progress)?, None)
        };
        Ok(Self::of_parts(shapes, wide, None))
    }

    fn of_parts(
        shapes: ShapeScene<TriangleMesh<T>>,
        wide: Option<WideTree>,
        source: Option<Source>,
    ) -> Self {
        let for_points = ForPoints::default();
        Self {
            trees: Arc::new(Trees { shapes, wide, source, for_points }),
            arithmetic: Arithmetic::default(),
            instructions: InstructionSet::best(),
        }
    }

    /// What the kernels search.
    #[inline(always)]
    pub(super) fn wide_and_mesh(&self) -> Option<(&WideTree, &TriangleMesh<T>)> {
        Some((self.trees.wide.as_ref()?, self.trees.shapes.primitives()))
    }

    pub(super) fn find_closest_hit(&self, ray: &Ray) -> Option<Hit> {
        let Some(tree) = self.wide_and_mesh() else { return self.trees.shapes.closest_hit(ray) };
        let mut hit = None;
        let set = self.instructions;
        let found = match self.arithmetic {
            Arithmetic::Float if T::FITS_TREE => {
                search_along::<Closest<'_, T, false>>(tree, ray, set, &mut hit)
            }
            _ => search_along::<Closest<'_, T, true>>(tree, ray, set, &mut hit),
        };
        match found {
            Ok(()) | Err(NoAim::Missed) => hit,
            Err(NoAim::OutOfRange) => self.trees.shapes.closest_hit(ray),
        }
    }

    pub(super) fn find_any_hit(&self, ray: &Ray) -> bool {
        let Some(tree) = self.wide_and_mesh() else { return self.trees.shapes.any_hit(ray) };
        let mut is_hit = false;
        let set = self.instructions;
        let found = match self.arithmetic {
            Arithmetic::Float if T::FITS_TREE => {
                search_along::<Any<'_, T, false>>(tree, ray, set, &mut is_hit)
            }
            _ => search_along::<Any<'_, T, true>>(tree, ray, set, &mut is_hit),
        };
        match found {
            Ok(()) | Err(NoAim::Missed) => is_hit,
            Err(NoAim::OutOfRange) => self.trees.shapes.any_hit(ray),
        }
    }
}
