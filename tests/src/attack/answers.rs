//! What kdray says of a volley: every query of the leaf walk, and closest, any and all hits by every kernel.

use super::{Attacked, FEW, Volley};
use crate::flat::Flat;
use kdray::primitives::{HitArrays, HitRule};
use kdray::{Hint, Hit, InstructionSet, Interval, Precision, Ray, Scene};

/// All that was said.
#[derive(Clone, Debug)]
pub struct Answers {
    /// Of each ray what the leaf walk says.
    pub rays: Vec<Walked>,
    /// What everybody else says, to be the same.
    pub others: Vec<Other>,
    /// How many of those answers were found by packets, not left to other kernels.
    pub by_packets: u64,
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
        let rays: Vec<Walked> = volley.rays.iter().map(|ray| Walked::of(scene, ray)).collect();
        let (mut others, mut by_packets) = (Vec::new(), 0);
        let mut add = |name: &str, said| others.push(Other { name: name.to_owned(), said });
        add(
            "first touched",
            Said::Closest(rays.iter().map(|it| it.touched.first().copied()).collect()),
        );
        add("leaf walk, any hit", Said::Any(rays.iter().map(|it| it.any).collect()));
        on_whole_lines(scene, &volley.rays, &mut add);
        for set in InstructionSet::available() {
            let scene = scene.clone().with_instructions(set);
            let mut add = |kernel: &str, said| {
                others.push(Other { name: format!("{set} {kernel}"), said });
            };
            one_by_one(&scene, &volley.rays, &mut add);
            in_batches(&scene, &volley.rays, &mut add);
            by_packets += in_packets(&scene, volley, &mut add);
        }
        let mut add = |name: &str, said| others.push(Other { name: name.to_owned(), said });
        if volley.to_the_slow {
            without_tree(flat, &volley.rays, &mut add);
        }
        if volley.to_the_slow && scene.mesh().triangles().len() <= FEW {
            T::in_watched_packets(scene, &volley.rays, &mut add);
        }
        Self { rays, others, by_packets: by_packets as u64 }
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

/// t does not depend on the interval: so the hits in it are those of the whole line that it holds, exactly, at its
/// ends as well. And those behind a hit are the rest.
fn on_whole_lines<T: Precision>(scene: &Scene<T>, rays: &[Ray], add: &mut impl FnMut(&str, Said)) {
    let shapes = scene.shapes();
    let line = |ray: &Ray| Ray { interval: Interval::LINE, ..*ray };
    let within = |ray: &Ray, hits: &mut dyn Iterator<Item = Hit>| -> Vec<Hit> {
        let Interval { t_min, t_max } = ray.interval;
        hits.filter(|hit| t_min <= hit.t && hit.t <= t_max).collect()
    };
    let touched = rays.iter().map(|ray| within(ray, &mut shapes.all_touched(&line(ray)))).collect();
    add("whole line, all touched", Said::All(HitRule::Touching, touched));
    let crossed = rays.iter().map(|ray| within(ray, &mut shapes.all_hits(&line(ray)))).collect();
    add("whole line, all hits", Said::All(HitRule::Crossing, crossed));
    let resumed = rays.iter().map(|ray| {
        let mut hits: Vec<Hit> = scene.all_hits(ray).take(1).collect();
        hits.extend(hits.first().copied().iter().flat_map(|last| scene.all_hits_after(ray, last)));
        hits
    });
    add("resumed, all hits", Said::All(HitRule::Crossing, resumed.collect()));
    // As if the first were not there, and then it is.
    let kept = rays.iter().map(|ray| {
        let mut first = None;
        let next = scene.closest_hit_where(ray, |hit| *first.get_or_insert(*hit) != *hit);
        let others = next.map(|next| scene.all_touched_after(ray, &next));
        first.into_iter().chain(next).chain(others.into_iter().flatten()).collect()
    });
    add("first, second, and others behind it", Said::All(HitRule::Touching, kept.collect()));
}

/// All rays at once, and by fours: a packet of many that are hard is too much work, and leaves them to other kernels.
/// How many answers it did not leave.
fn in_packets<T: Precision>(
    scene: &Scene<T>,
    volley: &Volley,
    add: &mut impl FnMut(&str, Said),
) -> usize {
    let Some(all) = &volley.packet else { return 0 };
    let mut answered = 0;
    for (name, size) in [("packet", all.len().max(1)), ("packets of four", 4)] {
        let (mut closest, mut any) = (Vec::new(), Vec::new());
        for indices in (0..all.len()).collect::<Vec<_>>().chunks(size) {
            let owned = all.only(indices);
            let packet = owned.packet();
            let (mut hits, mut found) = (HitArrays::default(), vec![false; packet.len()]);
            let work = scene.packet_closest_hits(&packet, &mut hits);
            answered += packet.len() - work.left;
            closest.extend((0..packet.len()).map(|index| hits.get(index)));
            answered += packet.len() - scene.packet_any_hits(&packet, &mut found).left;
            any.extend(found);
        }
        add(&format!("{name}, closest hit"), Said::Closest(closest));
        add(&format!("{name}, any hit"), Said::Any(any));
    }
    answered
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
