//! Triangles in clusters, each with what it looks like from afar (Barill et al. 2018).

use super::moments::Moments;
use crate::exact::has_area;
use crate::geometry::Coordinate;
use crate::primitives::{Primitives, TriangleMesh};
use glam::DVec3;

/// Triangles in a cluster that is not cut.
const LEAF: usize = 8;

/// The triangles of a mesh in nested clusters, for sums over all of them that need not look at
/// each.
#[derive(Clone, Debug, Default)]
pub struct Clusters {
    space: ClusterSpace,
    clusters: Vec<Cluster>,
    ids: Vec<u32>,
}

/// The coordinates of clusters: those of the mesh, times a power of two, so that nothing overflows. They are
/// the same for f32 and f64 but for that.
#[derive(Clone, Copy, Debug, Default)]
struct ClusterSpace {
    /// The power of two.
    scale: f64,
    /// What is taken away first: on an axis where the mesh is flat, and so far from zero that products would
    /// overflow, its place; elsewhere zero.
    flat: DVec3,
}

impl ClusterSpace {
    fn of<T: Coordinate>(mesh: &TriangleMesh<T>) -> Self {
        /// In units of the mesh's size. What lies farther away, by a unit in the last place or more, is flat; f32
        /// numbers never do.
        const FAR: f64 = 1e150;
        let (scale, center) = (mesh.tree_space().scale(), DVec3::from(mesh.tree_space().center()));
        let is_near = (center * scale).abs().cmple(DVec3::splat(FAR));
        Self { scale, flat: DVec3::select(is_near, DVec3::ZERO, center) }
    }

    fn point(&self, point: [f64; 3]) -> DVec3 {
        // From beyond the largest f64 all looks as from there.
        ((DVec3::from(point) - self.flat) * self.scale).clamp(DVec3::MIN, DVec3::MAX)
    }

    /// The corners of a triangle.
    fn corners<T: Coordinate>(&self, mesh: &TriangleMesh<T>, id: u32) -> [DVec3; 3] {
        mesh.corners(id).map(|p| self.point(p.map(T::to_f64)))
    }
}

/// A part of a mesh, and what it looks like from afar.
#[derive(Clone, Debug)]
pub struct Cluster {
    /// The middle of its surface.
    pub(crate) center: DVec3,
    /// No corner is farther from there.
    pub(crate) radius: f64,
    /// Those of its triangles around the middle.
    pub(crate) moments: Moments,
    /// Where its triangles begin and end in the list of ids.
    first: u32,
    last: u32,
    /// The first cluster behind those within this one; the next one if it is not cut.
    pub(crate) next: u32,
}

/// What clusters are made of.
struct Piece {
    id: u32,
    middle: DVec3,
    normal: DVec3,
}

impl Clusters {
    /// Puts the triangles of a mesh in clusters; those without area, which cover nothing, are left
    /// out. O(N log N); takes 56 bytes a triangle more while it works.
    pub fn of<T: Coordinate>(mesh: &TriangleMesh<T>) -> Self {
        let ids = 0..mesh.count() as u32;
        let space = ClusterSpace::of(mesh);
        let corners = |id: u32| space.corners(mesh, id);
        let mut pieces = Vec::with_capacity(mesh.count());
        pieces.extend(ids.filter_map(|id| Piece::of(id, corners(id), || has_tiny_area(mesh, id))));
        let mut clusters = Vec::with_capacity(pieces.len() / 2);
        if !pieces.is_empty() {
            let last = pieces.len();
            push_cluster(&corners, &mut pieces, (0, last), &mut clusters);
        }
        clusters.shrink_to_fit();
        Self { space, clusters, ids: pieces.iter().map(|piece| piece.id).collect() }
    }

    /// Where a point of the mesh is among the clusters.
    pub(crate) fn place(&self, point: [f64; 3]) -> DVec3 {
        self.space.point(point)
    }

    /// The clusters in depth-first order: those within one stand behind it.
    pub(crate) fn clusters(&self) -> &[Cluster] {
        &self.clusters
    }

    /// The triangles of a cluster.
    pub(crate) fn triangles(&self, cluster: &Cluster) -> &[u32] {
        &self.ids[cluster.first as usize..cluster.last as usize]
    }
}

impl Cluster {
    /// Whether there are smaller clusters within.
    pub(crate) fn is_cut(&self) -> bool {
        (self.last - self.first) as usize > LEAF
    }
}

impl Piece {
    /// `None` for a triangle without area; of one whose area is computed as zero it is asked whether it is only
    /// tiny.
    fn of(id: u32, [a, b, c]: [DVec3; 3], is_tiny: impl FnOnce() -> bool) -> Option<Self> {
        let normal = 0.5 * (b - a).cross(c - a);
        let counts = normal != DVec3::ZERO || is_tiny();
        counts.then_some(Self { id, middle: (a + b + c) / 3.0, normal })
    }
}

/// Whether an area that is computed as zero is one all the same.
fn has_tiny_area<T: Coordinate>(mesh: &TriangleMesh<T>, id: u32) -> bool {
    has_area(mesh.corners(id).map(|p| p.map(T::to_f64)))
}

/// Appends the cluster of `pieces`, which stand from `first` to `last` in the list of all, and those
/// within it: halves by the number of triangles, across the longest side of the box of their middles.
fn push_cluster(
    corners: &impl Fn(u32) -> [DVec3; 3],
    pieces: &mut [Piece],
    (first, last): (usize, usize),
    clusters: &mut Vec<Cluster>,
) {
    let place = clusters.len();
    clusters.push(cluster(corners, pieces, (first, last)));
    if clusters[place].is_cut() {
        let axis = longest_axis(pieces);
        let half = pieces.len() / 2;
        // Ids tell pieces at the same place apart, so that the order is the same on every run.
        pieces.select_nth_unstable_by(half, |p, q| {
            p.middle[axis].total_cmp(&q.middle[axis]).then(p.id.cmp(&q.id))
        });
        let (low, high) = pieces.split_at_mut(half);
        push_cluster(corners, low, (first, first + half), clusters);
        push_cluster(corners, high, (first + half, last), clusters);
    }
    clusters[place].next = clusters.len() as u32;
}

fn cluster(
    corners: &impl Fn(u32) -> [DVec3; 3],
    pieces: &[Piece],
    (first, last): (usize, usize),
) -> Cluster {
    let center = middle_of(pieces);
    let (mut moments, mut radius) = (Moments::default(), 0.0_f64);
    for piece in pieces {
        let offsets = corners(piece.id).map(|p| p - center);
        moments.add(piece.normal, offsets);
        radius = offsets.iter().fold(radius, |most, offset| most.max(offset.length()));
    }
    Cluster { center, radius, moments, first: first as u32, last: last as u32, next: 0 }
}

/// The middle of the surface; where the triangles are so small that their areas vanish, that of their middles.
fn middle_of(pieces: &[Piece]) -> DVec3 {
    let area: f64 = pieces.iter().map(|piece| piece.normal.length()).sum();
    if area > 0.0 {
        let weighted = pieces.iter().map(|piece| piece.normal.length() * piece.middle);
        return weighted.sum::<DVec3>() / area;
    }
    pieces.iter().map(|piece| piece.middle).sum::<DVec3>() / pieces.len() as f64
}

fn longest_axis(pieces: &[Piece]) -> usize {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for piece in pieces {
        (low, high) = (low.min(piece.middle), high.max(piece.middle));
    }
    (high - low).max_position()
}
