//! Small meshes through any build options, and rays at them: every kernel against testing every triangle, and that
//! against the truth.

use super::draw::Draw;
use crate::OwnedPacket;
use crate::attack::answers::{Answers, Walked};
use crate::attack::verdict::Judge;
use crate::attack::{Extent, Volley};
use crate::flat::Flat;
use kdray::geometry::Common;
use kdray::layout::Hint;
use kdray::primitives::{HitArrays, HitRule};
use kdray::{Arithmetic, BuildError, Hit, InstructionSet, Precision, Ray, Scene, TriangleMesh};

/// Of f32 vertices.
pub fn f32(data: &[u8]) {
    run::<f32>(data);
}

/// Of f64 vertices.
pub fn f64(data: &[u8]) {
    run::<f64>(data);
}

fn run<T: Precision>(data: &[u8]) {
    let mut draw = Draw::new(data);
    let mesh = draw.mesh::<T>();
    if let Some(scene) = built(mesh, &mut draw) {
        ask(&scene, &mut draw);
    }
}

/// The scene, if the options are such that there is one.
///
/// # Panics
/// If the tree is wrong, or is refused without a reason.
pub fn built<T: Precision>(mesh: TriangleMesh<T>, draw: &mut Draw<'_>) -> Option<Scene<T>> {
    let options = draw.options();
    let scene = match Scene::build(mesh, &options) {
        Ok(scene) => scene,
        Err(BuildError::CostModel(error)) => {
            assert_eq!(options.cost.check(), Err(error));
            return None;
        }
        Err(BuildError::Memory { needed, limit }) => {
            assert!(Some(limit) == options.memory_limit && needed > limit, "{options:?}");
            return None;
        }
        Err(error) => panic!("{error}: {options:?}"),
    };
    let right = scene.verify();
    assert!(right.is_ok(), "{right:?} by {options:?}");
    Some(scene)
}

/// Asks about rays as long as there are bytes, by one instruction set.
fn ask<T: Precision>(scene: &Scene<T>, draw: &mut Draw<'_>) {
    // The exact arithmetic of far numbers takes its time.
    const MOST: usize = 8;
    let sets = InstructionSet::available();
    let scene = scene.clone().with_instructions(draw.choose(&sets));
    let with_packet = draw.byte() % 4 == 3;
    let mut rays = Vec::new();
    while rays.len() < MOST && (rays.is_empty() || draw.has_more()) {
        let mut ray = draw.ray(scene.mesh());
        if draw.byte() % 4 == 3
            && let Some(hit) = scene.closest_hit(&ray)
        {
            let t_max = if draw.bit() { hit.t } else { ray.interval.t_max };
            ray = ray.with_interval(hit.t, t_max);
        }
        rays.push(ray);
    }
    let expected: Vec<_> = rays.iter().map(|ray| expected(&scene, ray)).collect();
    judge(scene.mesh(), &rays, &expected);
    rays.iter().zip(&expected).for_each(|(ray, expected)| check_alone(&scene, ray, expected));
    check_together(&scene, &rays, &expected);
    if with_packet {
        check_packets(&scene, &rays, draw);
    }
}

/// What a ray meets, by testing every triangle.
struct Expected {
    closest: Option<Hit>,
    crossed: Vec<Hit>,
    touched: Vec<Hit>,
}

fn expected<T: Precision>(scene: &Scene<T>, ray: &Ray) -> Expected {
    let naive = scene.shapes().naive();
    let [crossed, touched] =
        [HitRule::Crossing, HitRule::Touching].map(|rule| naive.all_hits(ray, rule));
    let closest = naive.closest_hit(ray);
    let in_interval = |hit: &Hit| (ray.interval.t_min..=ray.interval.t_max).contains(&hit.t);
    for hit in crossed.iter().chain(&touched) {
        assert!(hit.t.is_finite() && in_interval(hit), "{hit:?} of {ray:?}");
        assert!(hit.u.is_finite() && hit.v.is_finite(), "{hit:?} of {ray:?}");
    }
    assert_eq!(closest, touched.first().copied(), "{ray:?}");
    Expected { closest, crossed, touched }
}

/// What testing every triangle gives is judged by what kdray has no part in, or nothing would say that its test is
/// right.
///
/// # Panics
/// If a hit is lost, or is none, or a number is wrong.
fn judge<T: Precision>(mesh: &TriangleMesh<T>, rays: &[Ray], expected: &[Expected]) {
    let flat = Flat::new(mesh);
    // All hits are known, so that their parity tells no more; and next to the last f64 one of two may be beyond it.
    let judge = Judge { flat: &flat, extent: Extent::of(mesh), is_closed: false };
    let said = expected.iter().map(Expected::said).collect();
    let answers = Answers { rays: said, others: Vec::new(), by_packets: 0 };
    let tally = judge.tally(&Volley::of_rays(rays.to_vec()), &answers);
    assert_eq!(tally.errors(), 0, "{tally:?}");
}

impl Expected {
    /// The same, as the judge takes it.
    fn said(&self) -> Walked {
        Walked {
            closest: self.closest,
            any: self.closest.is_some(),
            crossed: self.crossed.clone(),
            touched: self.touched.clone(),
            count: self.crossed.len(),
        }
    }
}

/// One ray by every query.
fn check_alone<T: Precision>(scene: &Scene<T>, ray: &Ray, expected: &Expected) {
    let Expected { closest, crossed, touched } = expected;
    let shapes = scene.shapes();
    assert_eq!(shapes.closest_hit(ray), *closest, "leaf walk, {ray:?}");
    assert_eq!(shapes.any_hit(ray), closest.is_some(), "leaf walk, {ray:?}");
    assert_eq!(&shapes.all_hits(ray).collect::<Vec<_>>(), crossed, "leaf walk, {ray:?}");
    assert_eq!(&shapes.all_touched(ray).collect::<Vec<_>>(), touched, "leaf walk, {ray:?}");
    if let Some((first, rest)) = touched.split_first() {
        assert_eq!(shapes.all_touched_after(ray, first).collect::<Vec<_>>(), rest, "{ray:?}");
    }
    let which = name(scene);
    assert_eq!(scene.closest_hit(ray), *closest, "{which}, {ray:?}");
    assert_eq!(scene.any_hit(ray), closest.is_some(), "{which}, {ray:?}");
    let mut all = Vec::new();
    scene.all_hits_into(ray, &mut all);
    assert_eq!(&all, crossed, "{which}, {ray:?}");
    assert_eq!(scene.count(ray), crossed.len(), "{which}, {ray:?}");
    let float = scene.clone().with_arithmetic(Arithmetic::Float);
    if let Some(hit) = float.closest_hit(ray) {
        assert!((hit.primitive_id as usize) < scene.mesh().triangles().len(), "{hit:?}");
    }
    let _ = float.any_hit(ray);
}

/// What a failure is told with: the size of the mesh and whether there is a wide tree.
fn name<T: Precision>(scene: &Scene<T>) -> String {
    let wide = if scene.wide_tree().is_some() { "wide" } else { "no wide tree" };
    format!("{} triangles, {wide}", scene.mesh().triangles().len())
}

/// Rays in batches, and with hints of each other.
fn check_together<T: Precision>(scene: &Scene<T>, rays: &[Ray], expected: &[Expected]) {
    let alone: Vec<_> = expected.iter().map(|it| it.closest).collect();
    let is_hit: Vec<_> = alone.iter().map(Option::is_some).collect();
    // Fewer than eight are not taken together.
    let again = |count: usize| (0..count).cycle().take(count.max(8));
    let many: Vec<_> = again(rays.len()).map(|i| rays[i]).collect();
    let mut hits = vec![None; many.len()];
    scene.closest_hits(&many, &mut hits);
    assert_eq!(hits[..rays.len()], alone, "{rays:?}");
    let mut found = vec![false; many.len()];
    scene.any_hits(&many, &mut found);
    assert_eq!(found[..rays.len()], is_hit, "{rays:?}");
    let hinted: Vec<_> = rays.iter().map(|ray| scene.closest_hit_with_hint(ray)).collect();
    let hint = |i: usize| hinted[(i + 1) % rays.len()].map_or(Hint::NONE, |it| it.1);
    let hints: Vec<_> = again(rays.len()).map(hint).collect();
    scene.any_hits_near(&many, &hints, &mut found);
    assert_eq!(found[..rays.len()], is_hit, "{rays:?}");
    for (i, ray) in rays.iter().enumerate() {
        assert_eq!(hinted[i].map(|(hit, _)| hit), alone[i], "{ray:?}");
        assert_eq!(scene.any_hit_near(ray, hints[i]), is_hit[i], "{ray:?}");
    }
    let mut counts = vec![0; many.len()];
    scene.counts(&many, &mut counts);
    let crossed = expected.iter().map(|it| it.crossed.len());
    assert!(counts.iter().copied().take(rays.len()).eq(crossed), "{counts:?} of {rays:?}");
    scene.each_all_hits(&many, |place, hits| {
        assert_eq!(hits, expected[place % rays.len()].crossed, "{:?}", many[place]);
    });
}

/// The same origins or directions, with something in common.
fn check_packets<T: Precision>(scene: &Scene<T>, rays: &[Ray], draw: &mut Draw<'_>) {
    let shared = rays[draw.below(rays.len())];
    let (common, each): (_, Vec<_>) = match draw.byte() % 3 {
        0 => (Common::Origin(shared.origin), rays.iter().map(|ray| ray.direction).collect()),
        1 => (Common::Direction(shared.direction), rays.iter().map(|ray| ray.origin).collect()),
        _ => (Common::Target(shared.origin), rays.iter().map(|ray| ray.origin).collect()),
    };
    // Fewer are not taken together.
    let each: Vec<_> = each.iter().copied().cycle().take(64).collect();
    let owned = OwnedPacket::new(common, &each);
    let packet = owned.packet();
    let (mut hits, mut found) = (HitArrays::default(), vec![false; packet.len()]);
    scene.packet_closest_hits(&packet, &mut hits);
    scene.packet_any_hits(&packet, &mut found);
    for (index, &is_hit) in found.iter().enumerate().take(rays.len()) {
        let ray = packet.ray(index);
        let alone = scene.shapes().closest_hit(&ray);
        assert_eq!(hits.get(index), alone, "packet, {ray:?}");
        assert_eq!(is_hit, alone.is_some(), "packet, {ray:?}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::torus;
    use crate::rays::Archer;
    use kdray::BuildOptions;

    /// Rays that hit a torus, the first few in all ways, judged once their hits are spoilt.
    fn judged(spoil: impl Fn(&mut Expected)) {
        let scene = Scene::build(torus(7, 5), &BuildOptions::default()).unwrap();
        let mut rays = Archer::new(scene.mesh(), 3).all_kinds(4, 10.0);
        rays.retain(|ray| scene.count(ray) > 1);
        let mut said: Vec<_> = rays.iter().map(|ray| expected(&scene, ray)).collect();
        said.iter_mut().take(1).for_each(spoil);
        judge(scene.mesh(), &rays, &said);
    }

    #[test]
    fn right_hits_are_found_right() {
        judged(|_| {});
    }

    #[test]
    #[should_panic(expected = "is lost")]
    fn a_hit_that_no_test_finds_is_found() {
        judged(|said| {
            said.crossed.pop();
        });
    }

    #[test]
    #[should_panic(expected = "should be")]
    fn a_t_that_every_test_has_wrong_is_found() {
        judged(|said| said.touched.iter_mut().for_each(|hit| hit.t *= 1.0 + 1e-9));
    }

    #[test]
    #[should_panic(expected = "is none")]
    fn a_hit_that_is_none_is_found() {
        judged(|said| said.closest.iter_mut().for_each(|hit| hit.primitive_id = 70));
    }
}
