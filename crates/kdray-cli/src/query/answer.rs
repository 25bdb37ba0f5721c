//! From a ray to what is asked of it, and all that can be asked.

use clap::ValueEnum;
use kdray::{
    Aabb, ClosestPoint, Hit, Ray, Scene, TriangleMesh, primitives::HitRule, traverse::Naive,
};

/// What is asked of each ray, or of each point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Mode {
    /// The first hit: t_hit, geometry_ids, primitive_ids, primitive_uvs, primitive_normals
    Closest,
    /// Whether there is a hit: occluded
    Any,
    /// Every crossing of a surface, by rising t: ray_ids, ray_splits (not in CSV), t_hit,
    /// geometry_ids, primitive_ids, primitive_uvs
    All,
    /// How many surfaces are crossed: intersection_counts
    Count,
    /// Of points, the nearest one of the mesh: points, distances, geometry_ids, primitive_ids,
    /// primitive_uvs, primitive_normals
    ClosestPoint,
    /// Of points, whether they are inside or on the surface: inside
    Contains,
    /// Of points, the distance from the mesh, negative inside: signed_distances
    SignedDistance,
    /// Of points, how often the mesh winds around them: winding_numbers
    WindingNumber,
}

impl Mode {
    /// Whether it is asked of points, not of rays.
    pub(crate) fn is_of_points(self) -> bool {
        match self {
            Self::Closest | Self::Any | Self::All | Self::Count => false,
            Self::ClosestPoint | Self::Contains | Self::SignedDistance | Self::WindingNumber => {
                true
            }
        }
    }
}

/// The answer for one ray or point.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Answer {
    /// The first hit, with the unit normal of the triangle.
    Closest(Option<(Hit, [f64; 3])>),
    /// Whether there is a hit.
    Any(bool),
    /// All hits by rising t.
    All(Vec<Hit>),
    /// How many hits there are.
    Count(usize),
    /// The nearest point, with the unit normal of the triangle.
    ClosestPoint(Option<(ClosestPoint, [f64; 3])>),
    /// Whether the point is inside.
    Contains(bool),
    /// The distance, negative inside.
    SignedDistance(Option<f64>),
    /// How often the mesh winds around the point.
    WindingNumber(f64),
}

impl Answer {
    /// Whether a ray hits, or a point is inside.
    pub(crate) fn is_hit(&self) -> bool {
        match self {
            Self::Closest(hit) => hit.is_some(),
            Self::Any(is_so) | Self::Contains(is_so) => *is_so,
            Self::All(hits) => !hits.is_empty(),
            Self::Count(count) => *count > 0,
            Self::ClosestPoint(nearest) => {
                nearest.is_some_and(|(nearest, _)| nearest.distance == 0.0)
            }
            Self::SignedDistance(distance) => distance.is_some_and(|distance| distance <= 0.0),
            Self::WindingNumber(number) => *number >= 0.5,
        }
    }
}

/// The unit normal of a triangle; zero if it has no area.
pub(super) fn unit_normal(mesh: &TriangleMesh, id: u32) -> [f64; 3] {
    glam::DVec3::from(mesh.geometric_normal(id)).normalize_or_zero().into()
}

/// Who answers.
pub(crate) enum Answerer {
    /// The kd-tree.
    Tree(Scene),
    /// Every triangle is tested, after the box around all of them.
    Naive(TriangleMesh, Aabb<3>),
}

impl Answerer {
    /// Without a tree.
    pub(crate) fn naive(mesh: TriangleMesh) -> Self {
        let used = mesh.triangles().iter().flatten().map(|&id| mesh.vertices()[id as usize]);
        let bounds = Aabb::of_points(used);
        Self::Naive(mesh, bounds)
    }

    /// Answers each ray, in their order; one that cannot be traced hits nothing. Modes of points have
    /// no answers here.
    pub(crate) fn answers(&self, mode: Mode, rays: &[Ray]) -> Vec<Answer> {
        match mode {
            Mode::Closest => {
                let mut hits = vec![None; rays.len()];
                self.closest_hits(rays, &mut hits);
                hits.into_iter().map(|hit| Answer::Closest(self.with_normal(hit))).collect()
            }
            Mode::Any => {
                let mut found = vec![false; rays.len()];
                self.any_hits(rays, &mut found);
                found.into_iter().map(Answer::Any).collect()
            }
            Mode::All => rays.iter().map(|ray| Answer::All(self.all_hits(ray))).collect(),
            Mode::Count => rays.iter().map(|ray| Answer::Count(self.count(ray))).collect(),
            Mode::ClosestPoint | Mode::Contains | Mode::SignedDistance | Mode::WindingNumber => {
                Vec::new()
            }
        }
    }

    fn with_normal(&self, hit: Option<Hit>) -> Option<(Hit, [f64; 3])> {
        let hit = hit?;
        Some((hit, unit_normal(self.mesh(), hit.primitive_id)))
    }

    fn mesh(&self) -> &TriangleMesh {
        match self {
            Self::Tree(scene) => scene.mesh(),
            Self::Naive(mesh, _) => mesh,
        }
    }

    fn closest_hits(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        match self {
            Self::Tree(scene) => scene.closest_hits(rays, hits),
            Self::Naive(mesh, bounds) => {
                let naive = Naive::new(mesh, *bounds);
                rays.iter().zip(hits).for_each(|(ray, hit)| *hit = naive.closest_hit(ray));
            }
        }
    }

    fn any_hits(&self, rays: &[Ray], found: &mut [bool]) {
        match self {
            Self::Tree(scene) => scene.any_hits(rays, found),
            Self::Naive(mesh, bounds) => {
                let naive = Naive::new(mesh, *bounds);
                rays.iter().zip(found).for_each(|(ray, found)| *found = naive.any_hit(ray));
            }
        }
    }

    fn all_hits(&self, ray: &Ray) -> Vec<Hit> {
        match self {
            Self::Tree(scene) => {
                let mut hits = Vec::new();
                scene.all_hits_into(ray, &mut hits);
                hits
            }
            Self::Naive(mesh, bounds) => Naive::new(mesh, *bounds).all_hits(ray, HitRule::Crossing),
        }
    }

    fn count(&self, ray: &Ray) -> usize {
        match self {
            Self::Tree(scene) => scene.count(ray),
            Self::Naive(..) => self.all_hits(ray).len(),
        }
    }
}
