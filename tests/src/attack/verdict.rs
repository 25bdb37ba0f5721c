//! What is wrong of kdray's answers.

use super::answers::{Answers, Said, Walked};
use super::truth::{Place, TrueHit, can_hit};
use super::{Extent, Tally, Target, Truth, Volley};
use crate::bits::Bits;
use crate::flat::Flat;
use crate::oracle::{agrees_on_all, agrees_on_closest, exact_triangle_hit};
use kdray::primitives::HitRule;
use kdray::{Hit, Interval, Precision, Ray};

/// Of so many rays the oracle is asked about one: t, u, v and the side must be right as well.
const ORACLE: usize = 64;

/// What is known of a target, to judge by.
#[derive(Clone, Copy)]
pub struct Judge<'a, T = f32> {
    /// Its triangles.
    pub flat: &'a Flat<T>,
    /// Where they are.
    pub extent: Extent,
    /// Whether it is closed.
    pub is_closed: bool,
}

impl<'a, T: Precision> Judge<'a, T> {
    /// The judge of answers about a target.
    pub fn of(target: &Target<T>, flat: &'a Flat<T>) -> Self {
        Self { flat, extent: target.extent, is_closed: target.is_closed }
    }

    /// Counts what is wrong of the answers to a volley.
    pub fn tally(&self, volley: &Volley, answers: &Answers) -> Tally {
        let mut tally = Tally { packets: answers.by_packets, ..Tally::default() };
        let asked_about = place_of_oracle(volley);
        for (index, (ray, walked)) in volley.rays.iter().zip(&answers.rays).enumerate() {
            let truth = Truth::of(self.flat, ray);
            judge_hits(&mut tally, ray, &truth, walked);
            self.judge_count(&mut tally, ray, &truth, walked, volley.from_inside);
            if index % ORACLE == asked_about {
                tally.oracle += 1;
                self.ask_oracle(&mut tally, ray, &truth, walked);
            }
        }
        for other in &answers.others {
            compare(&mut tally, volley, &answers.rays, &other.name, &other.said);
        }
        tally
    }

    /// `count` must be the number of crossings, and of a ray without end even from outside of a closed
    /// mesh and odd from inside, whatever that number is.
    fn judge_count(
        &self,
        tally: &mut Tally,
        ray: &Ray,
        truth: &Truth,
        walked: &Walked,
        from_inside: bool,
    ) {
        let (least, most) = truth.count(ray.interval);
        let in_range = (least..=most).contains(&walked.count);
        let is_endless = self.is_closed
            && ray.interval == Interval::FORWARD
            && can_hit(ray)
            && !truth.reaches_beyond
            && !truth.crossed.iter().any(TrueHit::is_at_last);
        let parity = match is_endless {
            true if from_inside => Some(1),
            true if !self.extent.contains(ray.origin) => Some(0),
            _ => None,
        };
        let is_consistent = walked.count == walked.crossed.len();
        if !in_range || !is_consistent || parity.is_some_and(|parity| walked.count % 2 != parity) {
            tally.miscounted += 1;
            tally.tell(ray, || {
                let parity =
                    parity.map_or("", |p| if p == 0 { ", an even one" } else { ", an odd one" });
                format!("count is {}, where {least} to {most} are right{parity}", walked.count)
            });
        }
    }

    /// All numbers of all hits, in rational arithmetic. Which triangles are hit is known by now.
    fn ask_oracle(&self, tally: &mut Tally, ray: &Ray, truth: &Truth, walked: &Walked) {
        let exact = |hits: &[TrueHit], rule| {
            let mut exact = Vec::new();
            self.flat.each_candidate(ray, |corners, id| {
                if hits.binary_search_by_key(&id, |hit| hit.id).is_ok() {
                    exact.extend(exact_triangle_hit(corners, id, ray, rule));
                }
            });
            exact
        };
        let touched = exact(&truth.touched, HitRule::Touching);
        let crossed = exact(&truth.crossed, HitRule::Crossing);
        // The oracle does not know that a hit beyond f64 is none.
        if truth.touched.iter().any(TrueHit::is_at_last) {
            return;
        }
        let agreed = agrees_on_closest(&touched, walked.closest.as_ref(), ray)
            .and_then(|()| agrees_on_all(&crossed, &walked.crossed, ray))
            .and_then(|()| agrees_on_all(&touched, &walked.touched, ray));
        if let Err(error) = agreed {
            tally.numbers += 1;
            tally.tell(ray, || error);
        }
    }
}

/// Which of each [`ORACLE`] rays the oracle is asked about: any, for in many volleys each place has its kind of ray.
fn place_of_oracle(volley: &Volley) -> usize {
    let numbers = volley.rays.iter().flat_map(|ray| ray.origin.into_iter().chain(ray.direction));
    let mixed =
        numbers.fold(0_u64, |mixed, x| (mixed ^ x.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    (mixed >> 32) as usize % ORACLE.min(volley.rays.len().max(1))
}

/// All hits of a ray, but not their number.
pub(super) fn judge_hits(tally: &mut Tally, ray: &Ray, truth: &Truth, walked: &Walked) {
    tally.rays += 1;
    tally.crossing += u64::from(truth.count(ray.interval).1 > 0);
    tally.close += u64::from(truth.is_close);
    tally.deepest = tally.deepest.max(truth.touched.len() as u64);
    judge_list(tally, ray, &truth.crossed, &walked.crossed);
    judge_list(tally, ray, &truth.touched, &walked.touched);
    judge_closest(tally, ray, &truth.touched, walked);
}

/// A list of hits, against those on the ray's line by rising id.
fn judge_list(tally: &mut Tally, ray: &Ray, truth: &[TrueHit], found: &[Hit]) {
    let known = |hit: &Hit| truth.binary_search_by_key(&hit.primitive_id, |it| it.id).ok();
    let mut times = vec![0; truth.len()];
    for hit in found {
        match known(hit) {
            Some(place) if truth[place].place(ray.interval) != Place::Outside => {
                times[place] += 1;
                if !truth[place].is_at(hit.t) || truth[place].side != hit.side {
                    tally.numbers += 1;
                    tally.tell(ray, || format!("{hit:?} should be {:?}", truth[place]));
                }
            }
            _ => {
                tally.phantom += 1;
                tally.tell(ray, || format!("{hit:?} is no hit"));
            }
        }
    }
    for (hit, times) in truth.iter().zip(times) {
        if times == 0 && hit.place(ray.interval) == Place::Inside {
            tally.lost += 1;
            tally.tell(ray, || format!("{hit:?} is lost"));
        }
        if times > 1 {
            tally.duplicate += 1;
            tally.tell(ray, || format!("{hit:?} is found {times} times"));
        }
    }
    for pair in found.windows(2) {
        let nearer = |a: &Hit, b: &Hit| Some(truth[known(a)?].precedes(&truth[known(b)?]));
        let is_same = pair[0].primitive_id == pair[1].primitive_id;
        let [first, second] = [pair[0], pair[1]].map(|hit| (hit.t, hit.primitive_id));
        let rises = is_same || first < second;
        if !rises || nearer(&pair[1], &pair[0]) == Some(true) {
            tally.disordered += 1;
            tally.tell(ray, || format!("{:?} stands before {:?}", pair[0], pair[1]));
        }
    }
}

/// The closest hit and whether there is any, against all that is touched.
fn judge_closest(tally: &mut Tally, ray: &Ray, truth: &[TrueHit], walked: &Walked) {
    let surely = || truth.iter().filter(|hit| hit.place(ray.interval) == Place::Inside);
    let maybe = |id: u32| {
        let hit = truth[truth.binary_search_by_key(&id, |hit| hit.id).ok()?];
        (hit.place(ray.interval) != Place::Outside).then_some(hit)
    };
    let possible = truth.iter().any(|hit| hit.place(ray.interval) != Place::Outside);
    match walked.closest {
        None if surely().next().is_some() => {
            tally.lost += 1;
            tally.tell(ray, || "closest_hit finds nothing".to_owned());
        }
        None => {}
        Some(hit) => match maybe(hit.primitive_id) {
            None => {
                tally.phantom += 1;
                tally.tell(ray, || format!("the closest hit {hit:?} is none"));
            }
            Some(true_hit) if surely().any(|other| other.precedes(&true_hit)) => {
                tally.disordered += 1;
                tally.tell(ray, || format!("the closest hit {hit:?} is not the closest"));
            }
            Some(_) => {}
        },
    }
    if walked.any && !possible {
        tally.phantom += 1;
        tally.tell(ray, || "any_hit finds something where nothing is".to_owned());
    }
    if !walked.any && surely().next().is_some() {
        tally.lost += 1;
        tally.tell(ray, || "any_hit finds nothing".to_owned());
    }
}

/// What another kernel said, against the leaf walk, to the last bit.
pub(super) fn compare(
    tally: &mut Tally,
    volley: &Volley,
    walked: &[Walked],
    name: &str,
    said: &Said,
) {
    for (index, (ray, walked)) in volley.rays.iter().zip(walked).enumerate() {
        let same = match said {
            Said::Closest(hits) => hits[index].is_same(&walked.closest),
            Said::Any(found) => found[index] == walked.closest.is_some(),
            Said::All(HitRule::Touching, hits) => hits[index].is_same(&walked.touched),
            Said::All(HitRule::Crossing, hits) => hits[index].is_same(&walked.crossed),
            Said::Count(counts) => counts[index] == walked.count,
        };
        if !same {
            tally.differing += 1;
            tally.tell(ray, || match said {
                Said::Closest(hits) => {
                    format!("{name}: {:?}, but the leaf walk {:?}", hits[index], walked.closest)
                }
                Said::Any(found) => {
                    format!("{name}: {}, but the leaf walk {:?}", found[index], walked.closest)
                }
                Said::All(_, hits) => {
                    format!("{name}: {:?}, but the leaf walk {walked:?}", hits[index])
                }
                Said::Count(counts) => {
                    format!("{name}: {}, but the leaf walk {}", counts[index], walked.count)
                }
            });
        }
    }
}
