//! What kdray says of a volley: every query of the leaf walk, and closest, any and all hits by every kernel.

use super::{Attacked, Volley};
use crate::flat::Flat;
use kdray::primitives::{HitArrays, HitRule};
use kdray::{Hint, Hit, InstructionSet, Precision, Ray, Scene};

/// Meshes of more triangles are too many to test each, and to be watched.
const FEW: usize = 2000;

/// All that was said.
#[derive(Clone, Debug)]
pub struct Answers {
    /// Of each ray what the leaf walk says.
    pub rays: Vec<Walked>,
    /// What everybody else says, to be the same.
    pub others: Vec<Other>,
}

/// The leaf walk's answers to a ray.
#[derive(Clone, Debug, PartialEq)]
pub struct Walked {
    /// `closest_hit`.
    pub closest: Option<Hit>,
    /// `any_hit`.
    pub any: bool,
    /// `all_hits`.
    pub crossed: Vec<Hit>,
    /// `all_touched`.
    pub touched: Vec<Hit>,
    /// `count`.
    pub count: usize,
}

/// The answers of a kernel to one query, in the order of the rays.
#[derive(Clone, Debug)]
pub struct Other {
    /// Which it is, such as `avx2 batch`.
    pub name: String,
    /// What it says.
    pub said: Said,
}

/// Answers to a query about several rays.
#[derive(Clone, Debug)]
pub enum Said {
    /// Closest hits.
    Closest(Vec<Option<Hit>>),
    /// Whether there is any hit.
    Any(Vec<bool>),
    /// All hits by a rule.
    All(HitRule, Vec<Vec<Hit>>),
    /// How many hits there are.
    Count(Vec<usize>),
}

impl Answers {
    /// Asks for everything.
    pub fn of<T: Attacked>(scene: &Scene<T>, flat: &Flat<T>, volley: &Volley) -> Self {
        let rays = volley.rays.iter().map(|ray| Walked::of(scene, ray)).collect();
        let mut others = Vec::new();
        for set in InstructionSet::available() {
            let scene = scene.clone().with_instructions(set);
            let mut add = |kernel: &str, said| {
                others.push(Other { name: format!("{set} {kernel}"), said });
            };
            one_by_one(&scene, &volley.rays, &mut add);
            in_batches(&scene, &volley.rays, &mut add);
            in_packets(&scene, volley, &mut add);
        }
        let mut add = |name: &str, said| others.push(Other { name: name.to_owned(), said });
        if volley.to_the_slow {
            without_tree(flat, &volley.rays, &mut add);
        }
        if volley.to_the_slow && scene.mesh().triangles().len() <= FEW {
            T::in_watched_packets(scene, &volley.rays, &mut add);
        }
        Self { rays, others }
    }
}

impl Walked {
    pub(super) fn of<T: Precision>(scene: &Scene<T>, ray: &Ray) -> Self {
        let shapes = scene.shapes();
        Self {
            closest: shapes.closest_hit(ray),
            any: shapes.any_hit(ray),
            crossed: shapes.all_hits(ray).collect(),
            touched: shapes.all_touched(ray).collect(),
            count: shapes.count(ray),
        }
    }
}

fn one_by_one<T: Precision>(scene: &Scene<T>, rays: &[Ray], add: &mut impl FnMut(&str, Said)) {
    let closest = rays.iter().map(|ray| scene.closest_hit(ray)).collect();
    add("single, closest hit", Said::Closest(closest));
    add("single, any hit", Said::Any(rays.iter().map(|ray| scene.any_hit(ray)).collect()));
    let all = |ray| {
        let mut hits = Vec::new();
        scene.all_hits_into(ray, &mut hits);
        hits
    };
    add("single, all hits", Said::All(HitRule::Crossing, rays.iter().map(all).collect()));
    add("single, count", Said::Count(rays.iter().map(|ray| scene.count(ray)).collect()));
    let hinted: Vec<_> = rays.iter().map(|ray| scene.closest_hit_with_hint(ray)).collect();
    let closest = hinted.iter().map(|found| found.map(|(hit, _)| hit)).collect();
    add("single, closest hit with a hint", Said::Closest(closest));
    // Each ray by the hint of another one, which is as good as any, and the rays in a batch as well.
    let hints: Vec<Hint> =
        hinted.iter().rev().map(|found| found.map_or(Hint::NONE, |(_, hint)| hint)).collect();
    let near = rays.iter().zip(&hints).map(|(ray, &hint)| scene.any_hit_near(ray, hint)).collect();
    add("single, any hit near", Said::Any(near));
    let mut near = vec![false; rays.len()];
    scene.any_hits_near(rays, &hints, &mut near);
    add("batch, any hit near", Said::Any(near));
}

fn in_batches<T: Precision>(scene: &Scene<T>, rays: &[Ray], add: &mut impl FnMut(&str, Said)) {
    let (mut closest, mut any) = (vec![None; rays.len()], vec![false; rays.len()]);
    scene.closest_hits(rays, &mut closest);
    scene.any_hits(rays, &mut any);
    add("batch, closest hit", Said::Closest(closest));
    add("batch, any hit", Said::Any(any));
    let mut all = vec![Vec::new(); rays.len()];
    scene.each_all_hits(rays, |index, hits| all[index] = hits.to_vec());
    add("batch, all hits", Said::All(HitRule::Crossing, all));
    let mut counts = vec![0; rays.len()];
    scene.counts(rays, &mut counts);
    add("batch, count", Said::Count(counts));
}

fn in_packets<T: Precision>(scene: &Scene<T>, volley: &Volley, add: &mut impl FnMut(&str, Said)) {
    let Some(packet) = &volley.packet else { return };
    let packet = packet.packet();
    let (mut hits, mut any) = (HitArrays::default(), vec![false; packet.len()]);
    scene.packet_closest_hits(&packet, &mut hits);
    scene.packet_any_hits(&packet, &mut any);
    let closest = (0..packet.len()).map(|index| hits.get(index)).collect();
    add("packet, closest hit", Said::Closest(closest));
    add("packet, any hit", Said::Any(any));
}

fn without_tree<T: Precision>(flat: &Flat<T>, rays: &[Ray], add: &mut impl FnMut(&str, Said)) {
    let all = |rule| Said::All(rule, rays.iter().map(|ray| checked(flat, ray, rule)).collect());
    add("no tree, all touched", all(HitRule::Touching));
    add("no tree, all hits", all(HitRule::Crossing));
}

/// Nothing hits a ray that cannot be traced: whoever tests triangles must look.
fn checked<T: Precision>(flat: &Flat<T>, ray: &Ray, rule: HitRule) -> Vec<Hit> {
    if ray.check().is_ok() { flat.all_hits(ray, rule) } else { Vec::new() }
}
