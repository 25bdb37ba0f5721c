//! Small meshes placed by any matrices.

use super::build_and_query::built;
use super::draw::Draw;
use super::{instructions, refusals};
use glam::{DAffine3, DVec3};
use kdray::{Instance, InstanceHit, InstancedScene, InstructionSet, Precision, Ray};

/// How far away rays may begin to be carried well, in sizes of the scene over how unevenly a matrix stretches: less
/// than the 2^22 that are documented.
const REACH: f64 = (1 << 20) as f64;

/// Runs an input.
pub fn run(data: &[u8]) {
    let mut draw = Draw::new(data);
    let set = instructions(data);
    if draw.bit() { ask::<f64>(&mut draw, set) } else { ask::<f32>(&mut draw, set) }
}

fn ask<T: Precision>(draw: &mut Draw<'_>, set: InstructionSet) {
    let mut geometries = Vec::new();
    for _ in 0..=draw.below(2) {
        let mesh = draw.mesh::<T>();
        geometries.extend(built(mesh, draw).map(|scene| scene.with_instructions(set)));
    }
    let instances: Vec<_> = (0..draw.below(12)).map(|_| instance(draw)).collect();
    // A matrix may be refused, and a geometry may not be there.
    let scene = match InstancedScene::build(geometries.clone(), instances.clone()) {
        Ok(scene) => scene,
        Err(error) => return refusals::check(&geometries, &instances, &error),
    };
    let mask = if draw.bit() { draw.byte().into() } else { u32::MAX };
    let scene = scene.with_mask(mask);
    for _ in 0..16 {
        let ray = match scene.geometries().first() {
            Some(geometry) => draw.ray(geometry.mesh()),
            None => Ray::new(draw.point(), draw.point()),
        };
        check(&scene, mask, &ray);
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

fn check<T: Precision>(scene: &InstancedScene<T>, mask: u32, ray: &Ray) {
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
    for (id, instance) in (0..).zip(scene.instances()) {
        check_instance(scene, id, instance.mask & mask != 0, ray, [&touched, &crossed]);
    }
}

/// On an instance there are the hits of its geometry, whatever box it has in the tree: all queries go by that, so that
/// what it loses they lose alike.
fn check_instance<T: Precision>(
    scene: &InstancedScene<T>,
    id: u32,
    is_seen: bool,
    ray: &Ray,
    found: [&[InstanceHit]; 2],
) {
    let instance = &scene.instances()[id as usize];
    let geometry = &scene.geometries()[instance.geometry_id as usize];
    let (carried, is_near) = carried(scene, instance, ray);
    if is_seen && !is_near {
        return;
    }
    let all = [geometry.all_touched(&carried).collect(), geometry.all_hits(&carried).collect()];
    for (all, found) in all.into_iter().zip(found) {
        let expected: Vec<_> = if is_seen { all } else { Vec::new() };
        let found = found.iter().filter(|it| it.instance_id == id).map(|it| it.hit);
        assert!(
            found.eq(expected.iter().copied()),
            "{expected:?} as {instance:?} is placed, {ray:?}"
        );
    }
}

/// The ray in the space of an instance, as the scene carries it, and whether that rounds it so little that the tree
/// must not matter.
fn carried<T: Precision>(scene: &InstancedScene<T>, instance: &Instance, ray: &Ray) -> (Ray, bool) {
    let column = |k: usize| DVec3::from(instance.to_world.map(|row| row[k]));
    let to_world = DAffine3::from_cols(column(0), column(1), column(2), column(3));
    let to_object = inverse(&to_world);
    let carried = Ray {
        origin: to_object.transform_point3(ray.origin.into()).into(),
        direction: to_object.transform_vector3(ray.direction.into()).into(),
        interval: ray.interval,
    };
    let reach = REACH * size(scene) / refusals::uneven(&to_world.matrix3);
    let begins = DVec3::from(scene.tree_space().point(ray.origin));
    let is_plain = |way: [f64; 3]| (1e-250..1e250).contains(&DVec3::from(way).abs().max_element());
    let is_near = begins.abs().max_element() <= reach;
    (carried, is_near && is_plain(ray.direction) && is_plain(carried.direction))
}

/// The inverse, by way of a matrix of ordinary size, whose determinant is in range.
fn inverse(to_world: &DAffine3) -> DAffine3 {
    let cells = to_world.matrix3.to_cols_array();
    let largest = cells.iter().fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
    let unit = 1.0 / f64::from_bits(largest.to_bits() & 0x7ff << 52);
    let matrix3 = (to_world.matrix3 * unit).inverse() * unit;
    DAffine3 { matrix3, translation: -(matrix3 * to_world.translation) }
}

/// The scene's size, as the tree over it sees it.
fn size<T: Precision>(scene: &InstancedScene<T>) -> f64 {
    let bounds = scene.tree().bounds();
    let all = bounds.min.into_iter().chain(bounds.max);
    all.fold(0.0, |most, x| most.max(f64::from(x).abs()))
}

fn check_hit<T: Precision>(scene: &InstancedScene<T>, ray: &Ray, found: &InstanceHit) {
    let InstanceHit { hit, instance_id, geometry_id } = found;
    let in_interval = (ray.interval.t_min..=ray.interval.t_max).contains(&hit.t);
    assert!(hit.t.is_finite() && in_interval, "{hit:?} of {ray:?}");
    assert_eq!(scene.instances()[*instance_id as usize].geometry_id, *geometry_id);
    let mesh = scene.geometries()[*geometry_id as usize].mesh();
    assert!((hit.primitive_id as usize) < mesh.triangles().len(), "{hit:?}");
    let normal = scene.geometric_normal(found);
    assert!(normal.iter().all(|x| !x.is_nan()), "{normal:?} of {found:?}");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::{moved, torus};
    use crate::rays::Archer;
    use kdray::{BuildOptions, Coordinate, Scene};

    /// How many hits are checked on copies, one of them turned, of rays at the mesh.
    fn checked<T: Precision>(spoil: impl Fn(&mut Vec<InstanceHit>)) -> usize {
        let mesh = moved(&torus(8, 6), |p| p.map(|x| <T as Coordinate>::from_f64(x / 3.0)));
        let rays = Archer::new(&mesh, 1).all_kinds(4, 100.0);
        let geometry = Scene::build(mesh, &BuildOptions::default()).unwrap();
        let turned = [[0.6, -0.8, 0.0, 0.1], [0.8, 0.6, 0.0, 0.2], [0.0, 0.0, 1.5, 0.3]];
        let copies = vec![Instance::of(0), Instance::of(0).placed(turned)];
        let scene = InstancedScene::build(vec![geometry], copies).unwrap();
        let mut hits = 0;
        for ray in &rays {
            let mut touched: Vec<_> = scene.all_touched(ray).collect();
            let crossed: Vec<_> = scene.all_hits(ray).collect();
            spoil(&mut touched);
            for (id, instance) in (0..).zip(scene.instances()) {
                let is_near = carried(&scene, instance, ray).1;
                hits += touched.iter().filter(|it| is_near && it.instance_id == id).count();
                check_instance(&scene, id, true, ray, [&touched, &crossed]);
            }
        }
        hits
    }

    #[test]
    fn rays_nearby_are_checked() {
        assert!(checked::<f32>(|_| {}) > 50 && checked::<f64>(|_| {}) > 50);
    }

    #[test]
    #[should_panic(expected = "placed")]
    fn a_lost_hit_is_found() {
        checked::<f32>(|touched| touched.retain(|it| it.instance_id == 0));
    }
}
