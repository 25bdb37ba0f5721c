//! Small meshes placed by any matrices.

use super::build_and_query::built;
use super::draw::Draw;
use kdray::{Instance, InstanceHit, InstancedScene, Precision, Ray};

/// Runs an input.
pub fn run(data: &[u8]) {
    let mut draw = Draw::new(data);
    if draw.bit() { ask::<f64>(&mut draw) } else { ask::<f32>(&mut draw) }
}

fn ask<T: Precision>(draw: &mut Draw<'_>) {
    let mut geometries = Vec::new();
    for _ in 0..=draw.below(2) {
        let mesh = draw.mesh::<T>();
        geometries.extend(built(mesh, draw));
    }
    let instances: Vec<_> = (0..draw.below(12)).map(|_| instance(draw)).collect();
    // A matrix may be refused, and a geometry may not be there.
    let Ok(scene) = InstancedScene::build(geometries, instances) else { return };
    let scene = if draw.bit() { scene.with_mask(draw.byte().into()) } else { scene };
    for _ in 0..16 {
        let ray = match scene.geometries().first() {
            Some(geometry) => draw.ray(geometry.mesh()),
            None => Ray::new(draw.point(), draw.point()),
        };
        check(&scene, &ray);
        if !draw.has_more() {
            break;
        }
    }
}

fn instance(draw: &mut Draw<'_>) -> Instance {
    let instance = Instance::of(draw.below(3) as u32);
    let instance = if draw.bit() { instance.masked(draw.byte().into()) } else { instance };
    match draw.byte() % 4 {
        0 => instance,
        1 => instance.moved(draw.point()),
        2 => {
            let turn = draw.below(3);
            let rows = [0, 1, 2].map(|row| {
                let mut numbers = [0.0; 4];
                numbers[(row + turn) % 3] = draw.number(0);
                numbers[3] = draw.number(row);
                numbers
            });
            instance.placed(rows)
        }
        _ => instance.placed([(); 3].map(|()| [(); 4].map(|()| draw.wild()))),
    }
}

fn check<T: Precision>(scene: &InstancedScene<T>, ray: &Ray) {
    let closest = scene.closest_hit(ray);
    assert_eq!(scene.any_hit(ray), closest.is_some(), "{ray:?}");
    let touched: Vec<_> = scene.all_touched(ray).collect();
    let crossed: Vec<_> = scene.all_hits(ray).collect();
    assert_eq!(scene.count(ray), crossed.len(), "{ray:?}");
    for hits in [&touched, &crossed] {
        assert!(hits.is_sorted_by(|a, b| a.order(b).is_lt()), "{hits:?} of {ray:?}");
        hits.iter().for_each(|found| check_hit(scene, ray, found));
    }
    assert_eq!(closest, touched.first().copied(), "{ray:?}");
}

fn check_hit<T: Precision>(scene: &InstancedScene<T>, ray: &Ray, found: &InstanceHit) {
    let InstanceHit { hit, instance_id, geometry_id } = found;
    let in_interval = (ray.interval.t_min..=ray.interval.t_max).contains(&hit.t);
    assert!(hit.t.is_finite() && in_interval, "{hit:?} of {ray:?}");
    assert_eq!(scene.instances()[*instance_id as usize].geometry_id, *geometry_id);
    let mesh = scene.geometries()[*geometry_id as usize].mesh();
    assert!((hit.primitive_id as usize) < mesh.triangles().len(), "{hit:?}");
    let _ = scene.geometric_normal(found);
}
