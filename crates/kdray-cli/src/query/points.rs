//! From a point to what is asked of it.

use super::{Answer, Mode, answer::unit_normal};
use kdray::Scene;

/// Answers each point, in their order. Modes of rays have no answers here.
pub(crate) fn answer_points(scene: &Scene, mode: Mode, points: &[[f64; 3]]) -> Vec<Answer> {
    let answer: fn(&Scene, [f64; 3]) -> Answer = match mode {
        Mode::ClosestPoint => closest_point,
        Mode::Contains => |scene, point| Answer::Contains(scene.contains(point)),
        Mode::SignedDistance => |scene, point| Answer::SignedDistance(scene.signed_distance(point)),
        Mode::WindingNumber => |scene, point| Answer::WindingNumber(scene.winding_number(point)),
        Mode::Closest | Mode::Any | Mode::All | Mode::Count => return Vec::new(),
    };
    points.iter().map(|&point| answer(scene, point)).collect()
}

fn closest_point(scene: &Scene, point: [f64; 3]) -> Answer {
    let nearest = scene.closest_point(point);
    let normal = |id| unit_normal(scene.mesh(), id);
    Answer::ClosestPoint(nearest.map(|nearest| (nearest, normal(nearest.primitive_id))))
}
