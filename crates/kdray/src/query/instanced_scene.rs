//! Many copies of few meshes: a kd-tree over kd-trees.

use super::asked::Asked;
use super::instance::{Instance, InstanceError, InstanceHit, Place};
use super::{InstanceHits, Precision, Scene};
use crate::build::{BuildError, BuildOptions, BuildProgress, Strategy};
use crate::geometry::{Aabb, Ray, TreeSpace};
use crate::primitives::{Hit, HitRule, Primitives};
use crate::traverse::LeafWalk;
use crate::tree::KdTree;
use glam::{DAffine3, DVec3};
use std::ops::ControlFlow;
use std::sync::Arc;
use thiserror::Error;

/// Several meshes in one scene, each placed any number of times: a kd-tree over the boxes of the
/// instances, and below it the tree of each geometry, which is there once. Clones share all of it.
///
/// A ray is carried into the space of each instance it may meet, by the inverse of the matrix in f64, and
/// is answered there as by [`Scene`]: exactly, for the carried ray. An instance that is not moved is
/// met exactly; carrying rounds the ray by some 2^-52 of the distance between its origin and the instance, times
/// how unevenly the matrix stretches. So rays may come from up to 2^22 times the scene's size away, which is half the longest side of the box around all
/// instances, divided by that; from farther, whether a ray is told to meet the rim of an instance may depend on the tree.
///
/// An instance takes some 230 bytes, and is reckoned to take some 700 while it is built ([`peak_bytes`](Self::peak_bytes)).
///
/// It answers about rays: closest, any and all hits, counts, and many rays at once. For a condition take the first of
/// [`all_touched`](Self::all_touched) that it holds for. About points, by hints, and from tree files only a geometry's
/// [`Scene`] answers.
///
/// Geometries are all in f32, or all in f64. Instances of either may be anywhere in f64: the tree over them is in
/// coordinates of its own, as that over an f64 mesh is ([`tree_space`](Self::tree_space)).
///
/// The direction is carried as well. One that is beyond the range of f64 then, as one of 1e308 is in a copy at a tenth of
/// the size, or that vanishes, misses that instance. One with components below 2^-1022 there has lost digits.
///
/// ```
/// use kdray::{BuildOptions, Instance, InstancedScene, Ray, Scene, TriangleMesh};
/// let corners = vec![[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
/// let tile = Scene::build(TriangleMesh::new(corners, vec![[0, 1, 2]])?, &BuildOptions::default())?;
/// let row = (0..1000).map(|i| Instance::of(0).moved([f64::from(i), 0.0, 0.0])).collect();
/// let scene = InstancedScene::build(vec![tile], row)?;
/// let ray = Ray::new([700.25, 0.25, 0.0], [0.0, 0.0, 1.0]);
/// let found = scene.closest_hit(&ray).expect("a copy is there");
/// assert_eq!((found.instance_id, found.geometry_id, found.hit.t), (700, 0, 2.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct InstancedScene<T: 'static = f32> {
    parts: Arc<Parts<T>>,
    mask: u32,
}

impl<T: 'static> Clone for InstancedScene<T> {
    fn clone(&self) -> Self {
        Self { parts: Arc::clone(&self.parts), mask: self.mask }
    }
}

#[derive(Debug)]
struct Parts<T: 'static> {
    geometries: Vec<Scene<T>>,
    instances: Vec<Instance>,
    /// From the world into the space of each instance.
    to_object: Box<[DAffine3]>,
    tree: KdTree,
    space: TreeSpace,
}

/// The part of a build in which instances are placed; in the rest the tree over them is built.
const PLACING: f64 = 0.25;

/// How many instances are placed between reports.
const INSTANCES_PER_REPORT: usize = 1 << 12;

/// Why a scene of instances cannot be built.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum InstancedSceneError {
    /// An instance cannot be placed.
    #[error(transparent)]
    Instance(#[from] InstanceError),
    /// There is no tree over the instances.
    #[error(transparent)]
    Build(#[from] BuildError),
}

/// The boxes of instances, for the tree over them.
struct Boxes(Vec<Aabb<3>>);

impl Primitives<3> for Boxes {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn bounds(&self, id: u32) -> Aabb<3> {
        self.0[id as usize]
    }
}

impl<T: Precision> InstancedScene<T> {
    /// The instances below which a tree has to know them by 30 bits.
    const MOST_INSTANCES: usize = 1 << 30;

    /// Places `geometries`. An instance's id is its index, a geometry's likewise; geometries without an
    /// instance are never met. On which threads, [`Scene::build`] says; an instance counts as a triangle there.
    ///
    /// # Errors
    /// The first instance that cannot be placed, or why there is no tree.
    pub fn build(
        geometries: Vec<Scene<T>>,
        instances: Vec<Instance>,
    ) -> Result<Self, InstancedSceneError> {
        Self::build_with_progress(geometries, instances, None, &|_| ControlFlow::Continue(()))
    }

    /// Places `geometries`, if that takes at most `memory_limit` bytes by [`peak_bytes`](Self::peak_bytes); tells
    /// `progress` how far it is, and stops if that answers [`ControlFlow::Break`].
    ///
    /// # Errors
    /// Those of [`build`](Self::build), and [`BuildError::Memory`] and [`BuildError::Cancelled`].
    pub fn build_with_progress(
        geometries: Vec<Scene<T>>,
        instances: Vec<Instance>,
        memory_limit: Option<u64>,
        progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
    ) -> Result<Self, InstancedSceneError> {
        if instances.len() >= Self::MOST_INSTANCES {
            return Err(InstanceError::TooMany(instances.len()).into());
        }
        let options = BuildOptions { memory_limit, ..options() };
        options.check_memory(Self::peak_bytes(instances.len()))?;
        let mut places = placed(&geometries, &instances, progress)?;
        hide_empty(&mut places);
        let space = space_around(&places);
        let boxes = places.iter().map(|place| place.bounds(&space)).collect();
        let to_object = places.iter().map(|place| place.to_object).collect();
        drop(places);
        let tree = tree_over(boxes, &options, &|done| {
            progress(BuildProgress { fraction: PLACING + (1.0 - PLACING) * done.fraction })
        })?;
        let parts = Arc::new(Parts { geometries, instances, to_object, tree, space });
        Ok(Self { parts, mask: u32::MAX })
    }

    /// About how many bytes a build over so many instances takes at its peak, besides their geometries: what is held
    /// of each while it is placed, and what [`BuildOptions::peak_bytes`] says of the tree over them.
    pub fn peak_bytes(instances: usize) -> u64 {
        let held = size_of::<Instance>() + size_of::<Place>() + size_of::<Aabb<3>>();
        let held = (held as u64).saturating_mul(instances as u64);
        options().peak_bytes(instances).saturating_add(held)
    }

    /// The same scene, for rays that see only the instances whose mask shares a bit with `mask`.
    #[must_use]
    pub fn with_mask(self, mask: u32) -> Self {
        Self { mask, ..self }
    }

    /// The scenes that are placed.
    pub fn geometries(&self) -> &[Scene<T>] {
        &self.parts.geometries
    }

    /// Where they are placed.
    pub fn instances(&self) -> &[Instance] {
        &self.parts.instances
    }

    /// The tree over the instances.
    pub fn tree(&self) -> &KdTree {
        &self.parts.tree
    }

    /// The coordinates that the tree over the instances is in.
    pub fn tree_space(&self) -> &TreeSpace {
        &self.parts.space
    }

    /// The hit of least t; of several at the same t, the one of the smallest instance, then primitive.
    #[must_use]
    pub fn closest_hit(&self, ray: &Ray) -> Option<InstanceHit> {
        let mut walk = self.walk(ray);
        let (mut ray, mut closest, mut asked) = (*ray, None::<InstanceHit>, Asked::default());
        while let Some(leaf) = walk.next_leaf(ray.interval.t_max, &mut ()) {
            for &id in leaf.primitives {
                if !self.sees(id) || !asked.may_be_new(id) {
                    continue;
                }
                let (geometry, carried) = self.carry(id, &ray);
                let found = geometry.closest_hit(&carried).map(|hit| self.found(id, hit));
                if let Some(found) = found
                    && closest.is_none_or(|closest| found.precedes(&closest))
                {
                    // Hits at the same t still count: a smaller id wins.
                    ray.interval.t_max = found.hit.t;
                    closest = Some(found);
                }
            }
        }
        closest
    }

    /// Whether there is any hit: whether `ray.interval` is occluded.
    #[must_use]
    pub fn any_hit(&self, ray: &Ray) -> bool {
        let (mut walk, mut asked) = (self.walk(ray), Asked::default());
        while let Some(leaf) = walk.next_leaf(ray.interval.t_max, &mut ()) {
            let mut is_hit = |id: u32| {
                self.sees(id) && asked.may_be_new(id) && {
                    let (geometry, carried) = self.carry(id, ray);
                    geometry.any_hit(&carried)
                }
            };
            if leaf.primitives.iter().any(|&id| is_hit(id)) {
                return true;
            }
        }
        false
    }

    /// Every crossing of a surface, once, by rising t ([`HitRule::Crossing`]), found as they are asked
    /// for; at the same t by instance, then primitive.
    pub fn all_hits(&self, ray: &Ray) -> InstanceHits<'_, T> {
        InstanceHits::new(self, ray, HitRule::Crossing)
    }

    /// Every triangle that the ray touches, by rising t ([`HitRule::Touching`]). To take the closest that
    /// some condition holds for is to find it here.
    pub fn all_touched(&self, ray: &Ray) -> InstanceHits<'_, T> {
        InstanceHits::new(self, ray, HitRule::Touching)
    }

    /// The normal of what was hit, in the world, on the side that is the front: of twice the area of the
    /// placed triangle in length.
    ///
    /// # Panics
    /// If the hit is of another scene, and there is no such instance or triangle here.
    pub fn geometric_normal(&self, found: &InstanceHit) -> [f64; 3] {
        let mesh = self.parts.geometries[found.geometry_id as usize].mesh();
        let corners = mesh.corners(found.hit.primitive_id).map(|p| DVec3::from(p.map(T::to_f64)));
        self.parts.instances[found.instance_id as usize].normal(corners).into()
    }

    /// The leaves of the tree over the instances that a ray passes.
    pub(super) fn walk(&self, ray: &Ray) -> LeafWalk<'_, 3> {
        LeafWalk::seen_as(&self.parts.tree, ray, self.parts.space.ray(ray), &mut ())
    }

    /// Whether this scene's rays see an instance.
    pub(super) fn sees(&self, id: u32) -> bool {
        self.parts.instances[id as usize].mask & self.mask != 0
    }

    /// The geometry of an instance, and the ray in its space.
    pub(super) fn carry(&self, id: u32, ray: &Ray) -> (&Scene<T>, Ray) {
        let instance = &self.parts.instances[id as usize];
        let to_object = &self.parts.to_object[id as usize];
        let carried = Ray {
            origin: to_object.transform_point3(ray.origin.into()).into(),
            direction: to_object.transform_vector3(ray.direction.into()).into(),
            interval: ray.interval,
        };
        (&self.parts.geometries[instance.geometry_id as usize], carried)
    }

    pub(super) fn found(&self, instance_id: u32, hit: Hit) -> InstanceHit {
        let geometry_id = self.parts.instances[instance_id as usize].geometry_id;
        InstanceHit { hit, instance_id, geometry_id }
    }
}

/// Where the instances are.
fn placed<T: Precision>(
    geometries: &[Scene<T>],
    instances: &[Instance],
    progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
) -> Result<Vec<Place>, InstancedSceneError> {
    let mut places = Vec::with_capacity(instances.len());
    for (index, instance) in instances.iter().enumerate() {
        if index.is_multiple_of(INSTANCES_PER_REPORT) {
            let fraction = PLACING * index as f64 / instances.len() as f64;
            if progress(BuildProgress { fraction }).is_break() {
                return Err(BuildError::Cancelled.into());
            }
        }
        let geometry = geometry(geometries, index, instance)?;
        let bounds = Some(geometry.tree().bounds()).filter(|bounds| !bounds.is_empty());
        let space = geometry.mesh().tree_space();
        let corners = bounds.map(|bounds| space.corners_in_mesh(bounds));
        places.push(Place::of(index, instance, corners)?);
    }
    Ok(places)
}

/// Puts instances of nothing into a corner of another, so that they do not stretch the scene. Where all are of nothing,
/// they stay where their origins are.
fn hide_empty(places: &mut [Place]) {
    if let Some((corner, error)) =
        places.iter().find(|place| !place.is_empty).map(|it| (it.low, it.error))
    {
        for place in places.iter_mut().filter(|place| place.is_empty) {
            (place.low, place.high, place.error) = (corner, corner, error);
        }
    }
}

/// The coordinates of the tree over the instances.
fn space_around(places: &[Place]) -> TreeSpace {
    let around = |(low, high): (DVec3, DVec3), place: &Place| {
        (low.min(place.low - place.error), high.max(place.high + place.error))
    };
    let (min, max) = places.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), around);
    // In f64, whatever the geometries are: boxes must not be as wide as f32 is coarse where they are.
    TreeSpace::around::<f64>(min.into(), max.into())
}

/// Those of the tree over the boxes of the instances.
fn options() -> BuildOptions {
    BuildOptions::for_strategy(Strategy::Sah)
}

/// The tree over the boxes of the instances. Apart, so that it is compiled once.
fn tree_over(
    boxes: Vec<Aabb<3>>,
    options: &BuildOptions,
    progress: &(dyn Fn(BuildProgress) -> ControlFlow<()> + Sync),
) -> Result<KdTree, BuildError> {
    KdTree::build_with_progress(&Boxes(boxes), options, progress)
}

/// The geometry of the instance of that index.
fn geometry<'a, T>(
    geometries: &'a [Scene<T>],
    index: usize,
    instance: &Instance,
) -> Result<&'a Scene<T>, InstanceError> {
    let geometry_id = instance.geometry_id;
    geometries.get(geometry_id as usize).ok_or(InstanceError::NoSuchGeometry {
        instance: index,
        geometry_id,
        geometries: geometries.len(),
    })
}
