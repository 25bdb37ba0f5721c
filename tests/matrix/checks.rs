//! What is compared.

use crate::cases::{Aimed, Case};
use kdray::geometry::BoundingSphere;
use kdray::traverse::Naive;
use kdray::{
    BuildOptions, CostModel, Hint, Hit, InstructionSet, KdTree, Precision, Ray, Scene, ShapeScene,
    Side, TriangleMesh,
};
use kdray_tests::bits::Bits;
use kdray_tests::oracle::{agrees_on_all, agrees_on_closest};
use kdray_tests::rays::{Archer, random};
use kdray_tests::{Subject, meshes, sets};
use rand::{Rng, RngExt};
use rayon::prelude::*;
use std::sync::LazyLock;

/// So many rays at the least, so that batches take turns: fewer are answered one by one.
const TURNS: usize = 256;

/// Of so many rays the kernels are asked about one where all triangles are in one leaf: it takes long, and of the way
/// through a tree there is nothing to test.
const ONE_LEAF: usize = 3;

/// How many rays are aimed along the split planes of each tree.
const IN_SPLIT_PLANES: usize = 60;

/// Builds a tree over each case and checks the answer to each of its rays, and to rays in the
/// tree's split planes.
pub(crate) fn on_each<S: Subject<K> + Clone + Send + Sync, const K: usize>(
    options: &BuildOptions,
    cases: &[Case<S, K>],
    check: impl Fn(&ShapeScene<S, K>, &Aimed<K>) -> Result<(), String> + Sync,
) {
    for case in cases {
        let scene = ShapeScene::build(case.subject.clone(), options).expect("cases are valid");
        on_rays(case, scene.tree(), |aimed| check(&scene, aimed));
    }
}

/// The same for the kernels of an instruction set, if this processor has it.
pub(crate) fn on_each_mesh<T: Precision>(
    options: &BuildOptions,
    cases: &[Case<TriangleMesh<T>, 3>],
    instructions: &str,
    check: impl Fn(&Scene<T>, &[&Aimed<3>]) -> Result<(), String> + Sync,
) {
    let Some(set) = sets::named(instructions) else { return };
    for case in cases {
        let scene = scene_with(options, case, set);
        let in_planes = in_split_planes(case, scene.tree());
        let step = if options.leaf_size == usize::MAX { ONE_LEAF } else { 1 };
        let aimed: Vec<_> = case.aimed.iter().step_by(step).chain(&in_planes).collect();
        let count = aimed.len().max(TURNS);
        let aimed: Vec<_> = aimed.into_iter().cycle().take(count).collect();
        if let Err(error) = check(&scene, &aimed) {
            panic!("case {:?}, {error}", case.name);
        }
    }
}

/// The scene of a case, to be searched by the kernels of an instruction set.
pub(crate) fn scene_with<T: Precision>(
    options: &BuildOptions,
    case: &Case<TriangleMesh<T>, 3>,
    instructions: InstructionSet,
) -> Scene<T> {
    let options = BuildOptions { cost: CostModel { block: 8, ..options.cost }, ..*options };
    let scene = Scene::build(case.subject.clone(), &options).expect("cases are valid");
    scene.with_instructions(instructions)
}

/// Checks the answers to the rays of a case, and to rays in the split planes of its tree.
fn on_rays<S: Subject<K> + Send + Sync, const K: usize>(
    case: &Case<S, K>,
    tree: &KdTree<K>,
    check: impl Fn(&Aimed<K>) -> Result<(), String> + Sync,
) {
    let in_planes = in_split_planes(case, tree);
    let aimed: Vec<_> = case.aimed.iter().chain(&in_planes).collect();
    let wrong = |(index, aimed): (usize, &&Aimed<K>)| {
        let error = check(aimed).err()?;
        Some(format!("case {:?}, ray {index}, {:?}: {error}", case.name, aimed.ray))
    };
    let wrong: Vec<_> = aimed.par_iter().enumerate().filter_map(wrong).collect();
    if let Some(first) = wrong.first() {
        panic!("{} of {} rays: {first}", wrong.len(), aimed.len());
    }
}

/// Rays in the split planes of a case's tree.
pub(crate) fn in_split_planes<S: Subject<K>, const K: usize>(
    case: &Case<S, K>,
    tree: &KdTree<K>,
) -> Vec<Aimed<K>> {
    let rays = Archer::new(&case.subject, case.seed).in_split_planes(tree, IN_SPLIT_PLANES);
    rays.into_iter().map(|ray| Aimed::new(&case.subject, ray)).collect()
}

/// Builds a tree over each case and validates it.
pub(crate) fn trees_are_valid<S: Subject<K>, const K: usize>(
    options: &BuildOptions,
    cases: &[Case<S, K>],
) {
    for case in cases {
        let tree = KdTree::build(&case.subject, options).expect("cases are valid");
        let valid = tree.validate(&case.subject);
        assert_eq!(valid, Ok(()), "case {:?}", case.name);
    }
}

/// The nearest primitive touched, the same as without the tree to the last bit.
pub(crate) fn closest_hit<S: Subject<K>, const K: usize>(
    scene: &ShapeScene<S, K>,
    aimed: &Aimed<K>,
) -> Result<(), String> {
    let found = scene.closest_hit(&aimed.ray);
    same(&found, &aimed.touched.naive.first().copied())?;
    same(&found, &scene.naive().closest_hit(&aimed.ray))?;
    same(&found, &in_sphere(scene).closest_hit(&aimed.ray))?;
    match &aimed.touched.exact {
        Some(exact) => agrees_on_closest(exact, found.as_ref(), &aimed.ray),
        None => Ok(()),
    }
}

/// Whether anything is touched.
pub(crate) fn any_hit<S: Subject<K>, const K: usize>(
    scene: &ShapeScene<S, K>,
    aimed: &Aimed<K>,
) -> Result<(), String> {
    let found = scene.any_hit(&aimed.ray);
    same(&found, &!aimed.touched.naive.is_empty())?;
    same(&found, &scene.naive().any_hit(&aimed.ray))?;
    same(&found, &scene.occluder(&aimed.ray).is_some())
}

/// Every crossing, in order.
pub(crate) fn all_hits<S: Subject<K>, const K: usize>(
    scene: &ShapeScene<S, K>,
    aimed: &Aimed<K>,
) -> Result<(), String> {
    let found: Vec<Hit> = scene.all_hits(&aimed.ray).collect();
    same(&found, &aimed.crossed.naive)?;
    match &aimed.crossed.exact {
        Some(exact) => agrees_on_all(exact, &found, &aimed.ray),
        None => Ok(()),
    }
}

/// Every primitive touched, in order.
pub(crate) fn all_touched<S: Subject<K>, const K: usize>(
    scene: &ShapeScene<S, K>,
    aimed: &Aimed<K>,
) -> Result<(), String> {
    let found: Vec<Hit> = scene.all_touched(&aimed.ray).collect();
    same(&found, &aimed.touched.naive)?;
    match &aimed.touched.exact {
        Some(exact) => agrees_on_all(exact, &found, &aimed.ray),
        None => Ok(()),
    }
}

/// The number of crossings.
pub(crate) fn count<S: Subject<K>, const K: usize>(
    scene: &ShapeScene<S, K>,
    aimed: &Aimed<K>,
) -> Result<(), String> {
    same(&scene.count(&aimed.ray), &aimed.crossed.naive.len())
}

/// The kernels' closest hits, the same as without a tree to the last bit: of one ray after the
/// other, and of all in a batch.
pub(crate) fn kernel_closest_hit<T: Precision>(
    scene: &Scene<T>,
    aimed: &[&Aimed<3>],
) -> Result<(), String> {
    let rays: Vec<_> = aimed.iter().map(|aimed| aimed.ray).collect();
    let mut batch = vec![None; rays.len()];
    scene.closest_hits(&rays, &mut batch);
    for ((aimed, ray), in_batch) in aimed.iter().zip(&rays).zip(batch) {
        let naive = aimed.touched.naive.first().copied();
        same(&scene.closest_hit(ray), &naive).map_err(|error| format!("{ray:?}: {error}"))?;
        same(&in_batch, &naive).map_err(|error| format!("{ray:?} in a batch: {error}"))?;
    }
    Ok(())
}

/// The kernels' crossings, in order: of one ray after the other, and of all in a batch.
pub(crate) fn kernel_all_hits<T: Precision>(
    scene: &Scene<T>,
    aimed: &[&Aimed<3>],
) -> Result<(), String> {
    let rays: Vec<_> = aimed.iter().map(|aimed| aimed.ray).collect();
    let mut batch = vec![Vec::new(); rays.len()];
    scene.each_all_hits(&rays, |index, hits| batch[index] = hits.to_vec());
    let mut counts = vec![usize::MAX; rays.len()];
    scene.counts(&rays, &mut counts);
    let mut hits = vec![Hit { t: 0.0, primitive_id: 0, u: 0.0, v: 0.0, side: Side::Front }];
    for (((aimed, ray), in_batch), count) in aimed.iter().zip(&rays).zip(batch).zip(counts) {
        let naive = &aimed.crossed.naive;
        scene.all_hits_into(ray, &mut hits);
        same(&hits, naive).map_err(|error| format!("{ray:?}: {error}"))?;
        same(&in_batch, naive).map_err(|error| format!("{ray:?} in a batch: {error}"))?;
        same(&scene.count(ray), &naive.len())?;
        same(&count, &naive.len())?;
    }
    Ok(())
}

/// Whether the kernels find anything, one ray after the other and all in a batch.
pub(crate) fn kernel_any_hit<T: Precision>(
    scene: &Scene<T>,
    aimed: &[&Aimed<3>],
) -> Result<(), String> {
    let rays: Vec<_> = aimed.iter().map(|aimed| aimed.ray).collect();
    let mut batch = vec![false; rays.len()];
    scene.any_hits(&rays, &mut batch);
    for ((aimed, ray), in_batch) in aimed.iter().zip(&rays).zip(batch) {
        let naive = !aimed.touched.naive.is_empty();
        same(&scene.any_hit(ray), &naive).map_err(|error| format!("{ray:?}: {error}"))?;
        same(&in_batch, &naive).map_err(|error| format!("{ray:?} in a batch: {error}"))?;
    }
    Ok(())
}

/// Hints of another scene, with a larger tree than those of the cases.
static HINTS: LazyLock<Vec<Hint>> = LazyLock::new(|| {
    let mesh: TriangleMesh = meshes::mesh(meshes::soup(5000, [0.0; 3], 1.0, 91));
    let rays = Archer::new(&mesh, 92).all_kinds(40, 10.0);
    let scene = Scene::build(mesh, &BuildOptions::default()).expect("a small mesh");
    let hints = rays.iter().filter_map(|ray| Some(scene.closest_hit_with_hint(ray)?.1));
    hints.filter(|hint| *hint != Hint::NONE).collect()
});

/// Whether the kernels find anything if they begin at hints: of the ray's own hit, of another's, of another scene, and
/// any numbers; for the rays, and for rays of any length off their hits.
pub(crate) fn kernel_any_hit_near<T: Precision>(
    scene: &Scene<T>,
    aimed: &[&Aimed<3>],
) -> Result<(), String> {
    let mut random = random(aimed.len() as u64);
    let (mut rays, mut hints, mut naive) = (Vec::new(), Vec::new(), Vec::new());
    let mut add = |ray: Ray, hint: Hint, is_hit: bool| {
        rays.push(ray);
        hints.push(hint);
        naive.push(is_hit);
    };
    let mut other = Hint::NONE;
    for aimed in aimed {
        let hinted = scene.closest_hit_with_hint(&aimed.ray);
        same(&hinted.map(|(hit, _)| hit), &aimed.touched.naive.first().copied())?;
        let is_hit = !aimed.touched.naive.is_empty();
        let numbers = [random.random_range(0..200), random.random()].map(Hint::from_bits);
        let foreign = HINTS[random.random_range(0..HINTS.len())];
        for hint in [other, Hint::NONE, foreign].into_iter().chain(numbers) {
            add(aimed.ray, hint, is_hit);
        }
        if let Some((hit, hint)) = hinted {
            add(aimed.ray, hint, is_hit);
            let off = off(&aimed.ray, hit.t, &mut random);
            add(off, hint, scene.shapes().naive().any_hit(&off));
            other = hint;
        }
    }
    let mut batch = vec![false; rays.len()];
    scene.any_hits_near(&rays, &hints, &mut batch);
    for (((ray, hint), naive), in_batch) in rays.iter().zip(hints).zip(naive).zip(batch) {
        let told = |error| format!("{ray:?} near {hint:?}: {error}");
        same(&scene.any_hit_near(ray, hint), &naive).map_err(told)?;
        same(&in_batch, &naive).map_err(told)?;
    }
    Ok(())
}

/// A ray off the hit of another, in any direction, from very short to long: half of them from the hit itself, as nearly
/// as that is a number, which touch what they begin at or not.
fn off(ray: &Ray, t: f64, random: &mut impl Rng) -> Ray {
    let origin = std::array::from_fn(|k| ray.origin[k] + t * ray.direction[k]);
    let direction = [0; 3].map(|_| random.random_range(-1.0..1.0));
    let length = t.abs() * 10.0_f64.powi(random.random_range(-6..6));
    let t_min = random.random_range(0.0..2.0) * 1e-3 * length;
    let t_min = if random.random() { 0.0 } else { t_min };
    Ray::new(origin, direction).with_interval(t_min, length)
}

/// The naive answer, with a sphere for the bounding volume that is tested first.
fn in_sphere<S: Subject<K>, const K: usize>(
    scene: &ShapeScene<S, K>,
) -> Naive<'_, S, BoundingSphere<K>> {
    Naive::new(scene.primitives(), BoundingSphere::of_aabb(scene.tree().bounds()))
}

/// Whether two answers are the same to the last bit.
pub(crate) fn same<T: Bits + std::fmt::Debug>(found: &T, naive: &T) -> Result<(), String> {
    match found.is_same(naive) {
        true => Ok(()),
        false => Err(format!("found {found:?}, without a tree {naive:?}")),
    }
}
