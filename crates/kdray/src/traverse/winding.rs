//! How often a mesh winds around a point (Jacobson et al. 2013), fast (Barill et al. 2018).

use crate::geometry::Coordinate;
use crate::layout::{Cluster, Clusters};
use crate::primitives::{TriangleMesh, solid_angle};
use glam::DVec3;
use std::f64::consts::PI;

/// A cluster is far from points at this many radii from its middle.
const FAR: f64 = 2.0;

/// Nothing is far that is nearer than this, in units of the mesh's size: products of four such lengths, which
/// moments are, underflow.
const LEAST: f64 = 1e-60;

/// The generalised winding number of `mesh` around `point`: the sum of the solid angles of its
/// triangles, as a share of the sphere. Clusters that are more than two radii away count by the
/// first three terms of what they look like from afar.
pub fn winding_number<T: Coordinate>(
    clusters: &Clusters,
    mesh: &TriangleMesh<T>,
    point: [f64; 3],
) -> f64 {
    let (all, place_of_point) = (clusters.clusters(), clusters.place(point));
    let (mut sum, mut place) = (0.0, 0);
    while let Some(cluster) = all.get(place) {
        if let Some(share) = share_from_afar(cluster, place_of_point) {
            sum += share;
            place = cluster.next as usize;
        } else if cluster.is_cut() {
            place += 1;
        } else {
            let corners = |&id: &u32| mesh.corners(id).map(|p| p.map(T::to_f64));
            let triangles = clusters.triangles(cluster).iter();
            sum += triangles.map(|id| solid_angle(point, corners(id))).sum::<f64>();
            place = cluster.next as usize;
        }
    }
    sum
}

/// The share of the sphere that a cluster covers, if it is far.
fn share_from_afar(cluster: &Cluster, point: DVec3) -> Option<f64> {
    let way = cluster.center - point;
    let distance = way.length();
    if distance <= LEAST.max(FAR * cluster.radius) {
        return None;
    }
    Some(cluster.moments.seen(way / distance, distance) / (4.0 * PI))
}
