//! The edges of a frustum, and where a section cuts it.

use super::super::Section;
use glam::DVec3;
use kdray::traverse::Frustum;

/// The twelve edges of a frustum, from where its corner rays begin to a depth.
pub(in crate::pictures) fn frustum_edges(frustum: &Frustum, end: f64) -> [[DVec3; 2]; 12] {
    let rays = frustum.corner_rays();
    let near = rays.map(|ray| DVec3::from(ray.at(0.0)));
    let far = rays.map(|ray| DVec3::from(ray.at(end)));
    std::array::from_fn(|i| {
        let (corner, next) = (i % 4, (i + 1) % 4);
        match i / 4 {
            0 => [near[corner], far[corner]],
            1 => [near[corner], near[next]],
            _ => [far[corner], far[next]],
        }
    })
}

/// The corners of the polygon in which a section cuts a frustum, in order; none if it does not.
pub(super) fn cut(section: &Section, frustum: &Frustum, end: f64) -> Vec<[f64; 2]> {
    let mut corners: Vec<[f64; 2]> = Vec::new();
    for [p, q] in frustum_edges(frustum, end) {
        let [at_p, at_q] = [p, q].map(|p| section.side(p.into()));
        if at_p != at_q && (at_p <= 0.0) == (at_q >= 0.0) {
            corners.push(section.place(p.lerp(q, at_p / (at_p - at_q)).into()));
        }
    }
    let count = corners.len().max(1) as f64;
    let middle = [0, 1].map(|k| corners.iter().map(|corner| corner[k]).sum::<f64>() / count);
    let angle = |p: &[f64; 2]| (p[1] - middle[1]).atan2(p[0] - middle[0]);
    corners.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    corners
}
