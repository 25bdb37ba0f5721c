//! Queries about points: at vertices, edges and faces, one unit in the last place beside them, around the mesh and far
//! away.

use super::points_truth::PointTruth;
use super::{Tally, Target};
use crate::flat::Flat;
use crate::oracle::{exact_distance_squared, is_distance};
use crate::points::beside;
use crate::rays::Archer;
use crate::sets::by_each_set;
use kdray::primitives::Closure;
use kdray::{ClosestPoint, Coordinate, InstructionSet, Precision, Scene, Side};
use num_traits::Zero;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

/// What a distance may be off by, over the distance to the farthest corner: as it is documented.
const DISTANCE_ERROR: f64 = 1.0 / (1_u64 << 46) as f64;

/// What a winding number may be off by, more than is documented.
const WINDING_ERROR: f64 = 0.01;

/// How far away most of the farthest points are, in diagonals; some are wherever f64 goes.
const FAR: f64 = 1e6;

/// How many points are asked about at once at the least, and how many now and then.
const SHORT_BATCH: usize = 40;
const LONG_BATCH: usize = 2055;

/// A point, and what is asked about it.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// The point.
    pub point: [f64; 3],
    /// Another one, that may be seen from it.
    pub other: [f64; 3],
    /// A triangle, a point of it, and whether the way leads off its back.
    pub through: (u32, [f64; 2], Side),
}

/// What kdray says.
#[derive(Clone, Copy, Debug)]
pub struct Said {
    /// `closest_point`.
    pub closest: Option<ClosestPoint>,
    /// `contains`.
    pub inside: bool,
    /// `signed_distance`.
    pub signed: Option<f64>,
    /// `winding_number`.
    pub winding: f64,
    /// Whether that is to be a whole number.
    pub is_whole: bool,
    /// `visible`, both ways.
    pub visible: [bool; 2],
    /// `thickness`.
    pub thickness: Option<f64>,
}

impl Question {
    /// A question about a target.
    pub fn new<T: Coordinate>(target: &Target<T>, random: &mut Pcg64Mcg) -> Self {
        let mut archer = Archer::within(&target.mesh, target.extent.ends(), random.random());
        let on_edge = |(a, b): ([f64; 3], [f64; 3]), s: f64| {
            std::array::from_fn(|k| a[k] + s * (b[k] - a[k]))
        };
        let mut point = match random.random_range(0..8) {
            0 | 1 => archer.corner(),
            2 => on_edge(archer.edge(), 0.5),
            3 => on_edge(archer.edge(), random.random()),
            4 | 5 => {
                let corners = archer.corners();
                on_edge((on_edge((corners[0], corners[1]), 0.5), corners[2]), random.random())
            }
            6 => archer.around(0.3),
            _ => archer.point_afar(match random.random_range(0..4) {
                0 => target.extent.most(),
                _ => FAR.min(target.extent.most()),
            }),
        };
        // One of the point and its six neighbours.
        let neighbour = random.random_range(0..7);
        if neighbour > 0 {
            point = beside(&point)[neighbour - 1];
        }
        // Half of the time such that the way between them is not rounded.
        let other = if random.random() { archer.corner() } else { archer.around(0.5) };
        let other = if random.random() { other } else { other.map(|x| target.rounded(x)) };
        let id = random.random_range(0..target.mesh.triangles().len() as u32);
        let (u, v) = (random.random_range(0.05..0.5), random.random_range(0.05..0.45));
        let side = if random.random() { Side::Front } else { Side::Back };
        Self { point, other, through: (id, [u, v], side) }
    }
}

impl Said {
    /// The answers of a scene.
    pub fn by<T: Precision>(scene: &Scene<T>, question: &Question) -> Self {
        let Question { point, other, through: (id, [u, v], side) } = *question;
        Self {
            closest: scene.closest_point(point),
            inside: scene.contains(point),
            signed: scene.signed_distance(point),
            winding: scene.winding_number(point),
            is_whole: scene.closure() == Closure::Oriented,
            visible: [scene.visible(point, other), scene.visible(other, point)],
            thickness: scene.thickness(id, u, v, side),
        }
    }
}

/// Asks as many questions, and counts what is wrong.
pub fn attack<T: Precision>(
    scene: &Scene<T>,
    target: &Target<T>,
    flat: &Flat<T>,
    count: u64,
    random: &mut Pcg64Mcg,
) -> Tally {
    let mut tally = Tally::default();
    let truth = PointTruth::new(target, flat);
    let (mut points, mut alone) = (Vec::new(), Vec::new());
    for _ in 0..count {
        let question = Question::new(target, random);
        let said = Said::by(scene, &question);
        judge(&mut tally, target, &truth, &question, &said);
        compare_sets(&mut tally, scene, &question, &said);
        points.push(question.point);
        alone.push(said.inside);
    }
    compare_batches(&mut tally, scene, &points, &alone, random);
    tally
}

/// Every other instruction set says the same, to the last bit: those are what is printed.
fn compare_sets<T: Precision>(
    tally: &mut Tally,
    scene: &Scene<T>,
    question: &Question,
    said: &Said,
) {
    let others =
        InstructionSet::available().into_iter().filter(|&set| set != InstructionSet::best());
    for set in others {
        let other = Said::by(&scene.clone().with_instructions(set), question);
        if format!("{other:?}") != format!("{said:?}") {
            tally.misjudged += 1;
            tally.tell(question, || format!("{set}: {other:?}, but the best set {said:?}"));
        }
    }
}

/// What is said of each of many points is what is said of it alone. Of fewer than so many each is asked about alone;
/// and now and then they are more than are taken at once.
fn compare_batches<T: Precision>(
    tally: &mut Tally,
    scene: &Scene<T>,
    points: &[[f64; 3]],
    alone: &[bool],
    random: &mut Pcg64Mcg,
) {
    let is_long = random.random_range(0..16) == 0;
    let count = if is_long { LONG_BATCH } else { points.len().max(SHORT_BATCH) };
    let points: Vec<_> = points.iter().copied().cycle().take(count).collect();
    let alone: Vec<_> = alone.iter().copied().cycle().take(count).collect();
    for scene in by_each_set(scene) {
        compare_batch(tally, &scene, &points, &alone);
    }
}

fn compare_batch<T: Precision>(
    tally: &mut Tally,
    scene: &Scene<T>,
    points: &[[f64; 3]],
    alone: &[bool],
) {
    let mut inside = vec![false; points.len()];
    scene.contains_each(points, &mut inside);
    for (point, (inside, alone)) in points.iter().zip(inside.iter().zip(alone)) {
        if inside != alone {
            tally.misjudged += 1;
            tally.tell(point, || format!("in a batch {inside}, alone {alone}"));
        }
    }
}

/// Counts what is wrong of the answers to a question.
pub fn judge<T: Coordinate>(
    tally: &mut Tally,
    target: &Target<T>,
    truth: &PointTruth<'_, T>,
    question: &Question,
    said: &Said,
) {
    tally.points += 1;
    let mut check = |is_right: bool, what: &dyn Fn() -> String| {
        if !is_right {
            tally.misjudged += 1;
            tally.tell(question, || format!("{}: {said:?}", what()));
        }
    };
    let Some(squared) = truth.distance_squared(question.point) else { return };
    let Some(closest) = said.closest else {
        return check(false, &|| "no closest point".to_owned());
    };
    let corners = target.mesh.corners(closest.primitive_id);
    let smallest = f64::from_bits(1);
    let error = DISTANCE_ERROR * farthest(question.point, &corners) + smallest;
    let is_on_surface = squared.is_zero();
    check(is_distance(closest.distance, error, &squared), &|| format!("squared: {squared}"));
    check((closest.distance == 0.0) == is_on_surface, &|| format!("on it: {is_on_surface}"));
    // The place is that triangle's, and as far away as is said: rounded to f64, all of them.
    let largest = target.extent.largest();
    let place_error = error + 8.0 * f64::EPSILON * largest + 8.0 * smallest;
    let off = exact_distance_squared(closest.point, &corners);
    check(is_distance(0.0, place_error, &off), &|| "the place is off the triangle".to_owned());
    let way = (0..3).map(|k| closest.point[k] - question.point[k]).fold(0.0, f64::hypot);
    let is_as_far = (way - closest.distance).abs() <= 2.0 * place_error + 1e-15 * way;
    check(is_as_far, &|| format!("the place is {way:e} away"));

    let off_surface = truth.contains_off_surface(question.point);
    if let Some(is_inside) = if is_on_surface { Some(true) } else { off_surface } {
        check(said.inside == is_inside, &|| format!("inside: {is_inside}"));
    }
    let is_negative = said.inside && closest.distance > 0.0;
    let signed = if is_negative { -closest.distance } else { closest.distance };
    check(said.signed == Some(signed), &|| format!("signed distance: {signed:e}"));
    if said.is_whole && !is_on_surface {
        let winding = truth.winding_counted(question.point);
        check(said.winding == winding as f64, &|| format!("winding number, counted: {winding}"));
    }
    if let Some(winding) = truth.winding_number(question.point).filter(|_| !is_on_surface) {
        let is_right = (said.winding - winding).abs() < WINDING_ERROR;
        check(is_right, &|| format!("winding number: {winding}"));
    }
    let is_visible = truth.is_visible(question.point, question.other);
    check(said.visible == [is_visible; 2], &|| format!("visible: {is_visible}"));
    let (id, weights, side) = question.through;
    let along_normal = if side == Side::Front { -1.0 } else { 1.0 };
    if let Some(thickness) = truth.thickness(id, weights, along_normal) {
        let is_right = match (thickness, said.thickness) {
            (Some(a), Some(b)) => (a - b).abs() <= 1e-9 * a + target.extent.doubt(),
            (a, b) => a.is_none() && b.is_none(),
        };
        check(is_right, &|| format!("thickness: {thickness:?}"));
    }
}

fn farthest<T: Coordinate>(point: [f64; 3], corners: &[[T; 3]; 3]) -> f64 {
    let away = |p: &[T; 3]| (0..3).map(|k| p[k].to_f64() - point[k]).fold(0.0, f64::hypot);
    corners.iter().map(away).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::{moved, torus};
    use crate::rays::random;
    use kdray::{BuildOptions, TriangleMesh};

    /// How many answers are wrong once they are spoilt.
    fn wrong<T: Precision>(mesh: TriangleMesh<T>, spoil: impl Fn(&mut Said)) -> u64 {
        let target = Target::new("torus", mesh);
        let flat = Flat::new(&target.mesh);
        let scene = Scene::build(target.mesh.clone(), &BuildOptions::default()).unwrap();
        let truth = PointTruth::new(&target, &flat);
        let (mut tally, mut random) = (Tally::default(), random(3));
        for _ in 0..150 {
            let question = Question::new(&target, &mut random);
            let mut said = Said::by(&scene, &question);
            spoil(&mut said);
            judge(&mut tally, &target, &truth, &question, &said);
        }
        tally.misjudged
    }

    fn wrong_in_both(spoil: impl Fn(&mut Said)) -> [u64; 2] {
        let tiny = |p: [f64; 3]| p.map(|x| 1e-300 * x);
        [wrong(torus(10, 7), &spoil), wrong(moved::<f64>(&torus(10, 7), tiny), &spoil)]
    }

    #[test]
    fn every_wrong_answer_is_found() {
        assert_eq!(wrong_in_both(|_| {}), [0; 2]);
        type Spoil = fn(&mut Said);
        let spoils: [Spoil; 9] = [
            |said| said.closest = None,
            |said| said.closest.iter_mut().for_each(|it| it.distance *= 1.0 + 1e-12),
            |said| said.closest.iter_mut().for_each(|it| it.primitive_id ^= 1),
            |said| said.closest.iter_mut().for_each(|it| it.point[0] += 1e-12 * it.point[1]),
            |said| said.inside = !said.inside,
            |said| said.signed = said.signed.map(f64::abs),
            |said| said.winding += 1e-9,
            |said| said.visible[1] = !said.visible[1],
            |said| said.thickness = said.thickness.map(|t| 1.001 * t),
        ];
        for (index, spoil) in spoils.into_iter().enumerate() {
            let found = wrong_in_both(spoil);
            assert!(found.iter().all(|&found| found > 20), "{index}: {found:?}");
        }
    }
}
