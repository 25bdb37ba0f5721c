//! Points and small meshes: the queries about points against testing every triangle, and against the oracle.

use super::build_and_query::built;
use super::draw::Draw;
use super::{exact_points, instructions};
use crate::points::{corners, naive_closest_point};
use kdray::exact::{is_on_triangle, segment_crosses};
use kdray::primitives::HitRule;
use kdray::{Closure, InstructionSet, Precision, Ray, Scene, Side};

/// How many points of an input are put to the oracle: numbers from all of f64 are long ones.
const JUDGED: usize = 2;

/// Runs an input.
pub fn run(data: &[u8]) {
    let mut draw = Draw::new(data);
    let set = instructions(data);
    if draw.bit() { ask::<f64>(&mut draw, set) } else { ask::<f32>(&mut draw, set) }
}

fn ask<T: Precision>(draw: &mut Draw<'_>, set: InstructionSet) {
    let mesh = draw.mesh::<T>();
    let Some(scene) = built(mesh, draw) else { return };
    let scene = scene.with_instructions(set);
    let mut last = [0.0; 3];
    for index in 0..8 {
        let point = draw.aim(scene.mesh());
        if index < JUDGED {
            exact_points::check(&scene, last, point);
        }
        check_nearest(&scene, point);
        check_inside(&scene, point);
        check_visible(&scene, last, point);
        check_thickness(&scene, draw);
        last = point;
        if !draw.has_more() {
            break;
        }
    }
}

fn check_nearest<T: Precision>(scene: &Scene<T>, point: [f64; 3]) {
    let nearest = scene.closest_point(point);
    assert_eq!(nearest, naive_closest_point(scene.mesh(), point), "{point:?}");
    let distance = nearest.map(|nearest| nearest.distance);
    assert_eq!(scene.signed_distance(point).map(f64::abs), distance, "{point:?}");
    if let Some(nearest) = nearest {
        assert!(nearest.distance.is_finite(), "{nearest:?}");
        assert!(nearest.point.iter().all(|x| x.is_finite()), "{nearest:?}");
        assert_eq!(nearest.distance == 0.0, is_on_surface(scene, point), "{point:?} {nearest:?}");
    }
}

fn is_on_surface<T: Precision>(scene: &Scene<T>, point: [f64; 3]) -> bool {
    let mut ids = 0..scene.mesh().triangles().len() as u32;
    ids.any(|id| is_on_triangle(point, corners(scene.mesh(), id)))
}

fn check_inside<T: Precision>(scene: &Scene<T>, point: [f64; 3]) {
    let inside = scene.contains(point);
    let winding = scene.winding_number(point);
    assert!(winding.is_finite(), "{winding} at {point:?}");
    let on_surface = is_on_surface(scene, point);
    if on_surface {
        assert!(inside, "{point:?} is on the surface");
        return;
    }
    let is_negative = scene.signed_distance(point).is_some_and(|distance| distance < 0.0);
    assert_eq!(is_negative, inside, "{point:?}");
    if scene.closure().is_closed() {
        let ray = Ray::new(point, [0.3, -0.7, 0.65]);
        let crossed = scene.shapes().naive().all_hits(&ray, HitRule::Crossing);
        assert_eq!(inside, crossed.len() % 2 == 1, "{point:?}: {crossed:?}");
        if scene.closure() == Closure::Oriented {
            let parts = crossed.iter().map(|hit| if hit.side == Side::Back { 1.0 } else { -1.0 });
            assert_eq!(winding, parts.sum::<f64>() + 0.0, "{point:?}: {crossed:?}");
        }
    }
}

fn check_visible<T: Precision>(scene: &Scene<T>, from: [f64; 3], to: [f64; 3]) {
    let visible = scene.visible(from, to);
    assert_eq!(scene.visible(to, from), visible, "{from:?} {to:?}");
    if (0..3).all(|k| (to[k] - from[k]).is_finite()) {
        let mut ids = 0..scene.mesh().triangles().len() as u32;
        let is_barred = ids.any(|id| segment_crosses(from, to, corners(scene.mesh(), id)));
        assert_eq!(visible, !is_barred, "{from:?} {to:?}");
    } else {
        assert!(!visible, "{from:?} {to:?}");
    }
}

fn check_thickness<T: Precision>(scene: &Scene<T>, draw: &mut Draw<'_>) {
    let id = draw.below(64) as u32;
    let [u, v] = [(); 2].map(|()| draw.wild());
    for side in [Side::Front, Side::Back] {
        let thickness = scene.thickness(id, u, v, side);
        assert!(thickness.is_none_or(|t| t.is_finite() && t >= 0.0), "{id} {u} {v} {thickness:?}");
    }
}
