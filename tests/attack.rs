//! A short form of `cargo xtask attack`, and that the attack finds what is wrong: answers are spoilt on
//! purpose.

use kdray::{Hit, TriangleMesh};
use kdray_tests::attack::answers::{Answers, Said};
use kdray_tests::attack::campaign::Outcome;
use kdray_tests::attack::case::Tamper;
use kdray_tests::attack::{AnyTarget, Campaign, Limits, Tally, Target, targets};
use kdray_tests::meshes;
use kdray_tests::shared::scenes;
use std::time::Duration;

/// How many rays are shot at meshes made by code, and how many at small scenes: each is asked about in some
/// forty ways.
const RAYS: u64 = 3_000;
const RAYS_AT_SCENES: u64 = 1_500;

/// Scenes of at most so many triangles are shot at.
const SMALL: usize = 2_000;

fn outcomes(
    targets: Vec<AnyTarget>,
    rays: u64,
    tamper: Option<Tamper<'_>>,
    shrink: Duration,
) -> Vec<Outcome> {
    let limits = Limits { rays, until: None };
    let (is_stopped, progress) = (&|| false, &|_, _: &str| {});
    Campaign { targets, seed: 7, rays_only: false, limits, is_stopped, progress, shrink, tamper }
        .run()
}

fn assert_right(targets: Vec<AnyTarget>, rays: u64) {
    let outcomes = outcomes(targets, rays, None, Duration::from_secs(10));
    for outcome in &outcomes {
        let Outcome { name, tally, example, case, .. } = outcome;
        let case = case.as_ref().map_or("", |case| &case.text);
        assert_eq!(outcome.errors(), 0, "{name}: {tally:?} {example:?}\n{case}");
        let was_hard = tally.crossing > 0 && tally.close > 0 && tally.oracle > 0;
        assert!(was_hard, "{name} was hardly attacked: {tally:?}");
    }
    let all = outcomes.iter().fold(Tally::default(), |sum, it| sum.and(it.tally.clone()));
    let were_asked = [all.packets, all.copied, all.points, all.files].iter().all(|&n| n > 0);
    assert!(were_asked && outcomes.iter().any(|it| it.trees.1 > 0), "not all was asked: {all:?}");
}

#[test]
fn meshes_made_by_code_withstand() {
    assert_right(targets::made(), RAYS);
}

#[test]
fn small_scenes_withstand() {
    let targets = targets::of_scenes(SMALL);
    if targets.is_empty() {
        assert!(scenes().is_none(), "no scene is small");
        return;
    }
    assert_right(targets, RAYS_AT_SCENES);
}

/// Attacks a torus with answers that `tamper` spoils: the kind of error that was found first, and the case.
fn found(tamper: impl Fn(&mut Answers) + Sync, shrink: u64) -> Outcome {
    let torus = vec![Target::new("torus", meshes::torus(10, 7)).into()];
    outcomes(torus, 2000, Some(&tamper), Duration::from_secs(shrink)).remove(0)
}

/// Spoils all lists of crossings, of rays that cross twice or more.
fn spoil(answers: &mut Answers, how: impl Fn(&mut Vec<Hit>)) {
    for ray in answers.rays.iter_mut().filter(|ray| ray.crossed.len() > 1) {
        how(&mut ray.crossed);
        ray.count = ray.crossed.len();
    }
}

#[test]
fn every_kind_of_error_is_found() {
    type Spoil = fn(&mut Answers);
    type Count = fn(&Tally) -> u64;
    let kinds: [(Spoil, Count); 10] = [
        (
            |it| spoil(it, |hits| hits.truncate(hits.len() - 1)),
            |tally| tally.lost.min(tally.miscounted),
        ),
        (|it| spoil(it, |hits| hits[0].primitive_id ^= 1), |tally| tally.phantom),
        (|it| it.rays.iter_mut().for_each(|ray| ray.count += 2), |tally| tally.miscounted),
        (|it| spoil(it, |hits| hits.swap(0, 1)), |tally| tally.disordered),
        (|it| spoil(it, |hits| hits.push(hits[0])), |tally| tally.duplicate.min(tally.disordered)),
        (|it| spoil(it, |hits| hits[0].t *= 1.0 + 1e-9), |tally| tally.numbers),
        (|it| it.rays.iter_mut().for_each(|ray| ray.closest = None), |tally| tally.lost),
        (|it| it.rays.iter_mut().for_each(|ray| ray.any = true), |tally| tally.phantom),
        (
            |it| it.rays.iter_mut().for_each(|ray| ray.closest = ray.touched.last().copied()),
            |tally| tally.disordered,
        ),
        (spoil_a_bit, |tally| tally.differing),
    ];
    for (index, (spoil, count)) in kinds.into_iter().enumerate() {
        let outcome = found(spoil, 0);
        assert!(count(&outcome.tally) > 0, "{index}: {:?}", outcome.tally);
        assert!(outcome.example.is_some(), "{index}");
    }
}

/// Turns the last bit of u in what kernels say.
fn spoil_a_bit(answers: &mut Answers) {
    for other in &mut answers.others {
        if let Said::Closest(hits) = &mut other.said {
            for hit in hits.iter_mut().flatten() {
                hit.u = hit.u.next_up();
            }
        }
    }
}

#[test]
fn parity_alone_finds_odd_counts() {
    // A torus with a hole, told to be closed: all hits are right, and rays through the hole cross it an odd number of
    // times.
    let closed = meshes::torus(10, 7);
    let rest = closed.triangles()[1..].to_vec();
    let open = TriangleMesh::new(closed.vertices().to_vec(), rest).expect("a part of a mesh");
    let target = Target { is_closed: true, ..Target::new("torus with a hole", open) };
    let tally = outcomes(vec![target.into()], 2000, None, Duration::ZERO).remove(0).tally;
    let others = tally.lost + tally.phantom + tally.numbers + tally.differing;
    assert!(tally.miscounted > 0 && others == 0, "{tally:?}");
}

#[test]
fn one_wrong_answer_among_many_becomes_a_small_case() {
    // Of rays that touch four triangles or more the second is lost.
    let outcome = found(
        |answers| {
            for ray in answers.rays.iter_mut().filter(|ray| ray.touched.len() >= 4) {
                ray.touched.remove(1);
            }
        },
        60,
    );
    let case = outcome.case.expect("there is one");
    let text = &case.text;
    assert!(case.rays == 1 && case.triangles == 4, "{text}");
    assert!(text.contains("assert_right(\"sah\", triangles, volley);"), "{text}");
}
