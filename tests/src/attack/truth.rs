//! The hits of a ray, found without kdray: its trees, boxes, filters and exact arithmetic are not used.
//!
//! Spheres leave out what is far from the line ([`Flat`]). Of the other triangles, signs of plain edge
//! functions in f64 tell most, with a bound that is far wider than rounding; the rest are put to the oracle
//! in rational arithmetic, by both rules.

use crate::flat::Flat;
use crate::oracle::exact_triangle_hit;
use glam::{DVec3, Vec3Swizzles};
use kdray::primitives::HitRule;
use kdray::{Coordinate, Interval, Ray, Side};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};
use std::ops::Range;

/// An edge function, or a volume, of six products has fewer than ten roundings, each at most 2^-53 of the
/// sum of the absolute values of its terms.
const ROUNDINGS: f64 = 16.0 / (1_u64 << 53) as f64;

/// The relative error of t that is still good enough.
const T_ERROR: f64 = 1.0 / (1_u64 << 40) as f64;

/// What kdray's t may differ by: its documented 2^-39, and the error here.
const T_TOLERANCE: f64 = 1.0 / (1_u64 << 38) as f64;

/// Directions of such lengths are looked at as they are.
const ORDINARY: Range<f64> = 1e-60..1e60;

/// All hits on the whole line of a ray, by rising id.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Truth {
    /// By [`HitRule::Touching`].
    pub touched: Vec<TrueHit>,
    /// By [`HitRule::Crossing`].
    pub crossed: Vec<TrueHit>,
    /// Whether the line meets an edge or a vertex, or so nearly that the oracle was asked.
    pub is_close: bool,
    /// Whether it meets a triangle at a t beyond f64, which is no hit: then parity tells nothing.
    pub reaches_beyond: bool,
}

/// A hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrueHit {
    /// The triangle.
    pub id: u32,
    /// The ray's parameter, good to a relative 2^-40; its sign is right.
    pub t: f64,
    /// The side that the line comes from.
    pub side: Side,
}

/// How a hit lies to an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In it.
    Inside,
    /// So near to an end that kdray's t may be on either side.
    AtEnd,
    /// Not in it.
    Outside,
}

impl Truth {
    /// The truth about `ray` and the triangles of `flat`.
    pub fn of<T: Coordinate>(flat: &Flat<T>, ray: &Ray) -> Self {
        Self::of_those(flat, ray, |_| true)
    }

    /// The truth about `ray` and some of the triangles.
    pub fn of_those<T: Coordinate>(
        flat: &Flat<T>,
        ray: &Ray,
        is_asked_for: impl Fn(u32) -> bool,
    ) -> Self {
        let mut truth = Self::default();
        if !can_hit(ray) {
            return truth;
        }
        let view = View::of(ray, flat.scale());
        flat.each_candidate(ray, |corners, id| {
            if is_asked_for(id) {
                truth.look_at(corners, id, ray, &view);
            }
        });
        truth.touched.sort_by_key(|hit| hit.id);
        truth.crossed.sort_by_key(|hit| hit.id);
        truth
    }

    fn look_at<T: Coordinate>(&mut self, corners: &[[T; 3]; 3], id: u32, ray: &Ray, view: &View) {
        match view.glance(corners) {
            Glance::Missed => {}
            Glance::Hit(t, side) => {
                self.touched.push(TrueHit { id, t, side });
                self.crossed.push(TrueHit { id, t, side });
            }
            Glance::Unclear => {
                self.is_close = true;
                match exactly(corners, id, ray) {
                    Some((hit, _)) if hit.is_beyond() => self.reaches_beyond = true,
                    Some((hit, crosses)) => {
                        self.touched.push(hit);
                        self.crossed.extend(crosses.then_some(hit));
                    }
                    None => {}
                }
            }
        }
    }

    /// How many crossings surely lie in the interval, and how many may.
    pub fn count(&self, interval: Interval) -> (usize, usize) {
        let at = |place| self.crossed.iter().filter(|hit| hit.place(interval) == place).count();
        let surely = at(Place::Inside);
        (surely, surely + at(Place::AtEnd))
    }
}

impl TrueHit {
    /// Whether a t that kdray found is this hit's.
    pub fn is_at(&self, t: f64) -> bool {
        (t - self.t).abs() <= self.tolerance()
    }

    /// Whether this hit surely comes before another.
    pub fn precedes(&self, other: &Self) -> bool {
        self.t + self.tolerance() < other.t - other.tolerance()
    }

    /// How it lies to an interval. An end of zero leaves no doubt, for signs are exact.
    pub fn place(&self, interval: Interval) -> Place {
        let at = |end: f64| end != 0.0 && self.is_at(end);
        let Interval { t_min, t_max } = interval;
        // It is not if one is NaN.
        let is_ordered = t_min <= t_max;
        if !is_ordered {
            Place::Outside
        } else if self.is_at_last() || at(t_min) || at(t_max) {
            Place::AtEnd
        } else if t_min <= self.t && self.t <= t_max {
            Place::Inside
        } else {
            Place::Outside
        }
    }

    /// Whether its t is so near to the end of f64 that kdray's may be beyond, and so no hit.
    pub fn is_at_last(&self) -> bool {
        self.is_at(f64::MAX.copysign(self.t))
    }

    /// Whether not even kdray's t is in f64.
    fn is_beyond(&self) -> bool {
        self.t.is_infinite()
    }

    fn tolerance(&self) -> f64 {
        T_TOLERANCE * self.t.abs() + f64::from_bits(4)
    }
}

/// Whether a ray can hit anything: its numbers are some, and it leads somewhere.
pub(super) fn can_hit(ray: &Ray) -> bool {
    let Interval { t_min, t_max } = ray.interval;
    let are_finite = ray.origin.iter().chain(&ray.direction).all(|x| x.is_finite());
    are_finite && ray.direction != [0.0; 3] && !t_min.is_nan() && !t_max.is_nan()
}

/// The oracle's answer, and whether it is by [`HitRule::Crossing`] as well.
fn exactly<T: Coordinate>(corners: &[[T; 3]; 3], id: u32, ray: &Ray) -> Option<(TrueHit, bool)> {
    let exact = exact_triangle_hit(corners, id, ray, HitRule::Touching)?;
    let t = to_f64_or_beyond(&exact.t);
    // What is nearer to zero than the smallest f64 keeps its sign.
    let smallest = f64::from_bits(1);
    let t = match (t == 0.0, exact.t.is_positive(), exact.t.is_negative()) {
        (true, true, _) => smallest,
        (true, _, true) => -smallest,
        _ => t,
    };
    Some((TrueHit { id, t, side: exact.side }, exact.crosses))
}

/// The nearest f64; infinite only if t is beyond f64 by more than kdray's may err.
fn to_f64_or_beyond(t: &BigRational) -> f64 {
    let quarter = (t / BigRational::from_integer(4.into())).to_f64().unwrap_or(f64::INFINITY);
    let last = f64::MAX / 4.0;
    if quarter.abs() > last * (1.0 + T_TOLERANCE) {
        f64::INFINITY.copysign(quarter)
    } else if quarter.abs() > last {
        f64::MAX.copysign(quarter)
    } else {
        t.to_f64().unwrap_or(f64::MAX.copysign(quarter))
    }
}

/// What f64 tells of a ray and a triangle.
enum Glance {
    Missed,
    Hit(f64, Side),
    Unclear,
}

/// A ray as f64 looks at it: times powers of two, if coordinates are out of the ordinary, so that products
/// neither over- nor underflow.
struct View {
    origin: DVec3,
    direction: DVec3,
    scale: f64,
    /// What t is multiplied by.
    t_scale: f64,
    /// Whether scaling has rounded nothing.
    is_exact: bool,
}

impl View {
    fn of(ray: &Ray, scale: f64) -> Self {
        let (origin, direction) = (DVec3::from(ray.origin), DVec3::from(ray.direction));
        let largest = direction.abs().max_element();
        if scale == 1.0 && ORDINARY.contains(&largest) {
            return Self { origin, direction, scale, t_scale: 1.0, is_exact: true };
        }
        // From 2^-1022 on the inverse of a power of two is one.
        let power = f64::from_bits(largest.to_bits() & (0x7ff << 52)).max(f64::MIN_POSITIVE);
        let shrink = power.recip();
        let seen = [origin * scale, direction * shrink];
        let is_exact = seen[0] / scale == origin && seen[1] / shrink == direction;
        let t_scale = shrink / scale;
        Self { origin: seen[0], direction: seen[1], scale, t_scale, is_exact }
    }

    /// The corner, scaled, if that is exact.
    fn corner<T: Coordinate>(&self, p: [T; 3]) -> Option<DVec3> {
        let p = DVec3::from(p.map(T::to_f64));
        let seen = p * self.scale;
        (self.scale == 1.0 || seen / self.scale == p).then_some(seen)
    }

    /// The edge function of (p, q) is d · ((p − o) x (q − p)); they sum to d · n with n = ab x ac.
    fn glance<T: Coordinate>(&self, &[a, b, c]: &[[T; 3]; 3]) -> Glance {
        use Glance::{Hit, Missed, Unclear};
        let corners = [self.corner(a), self.corner(b), self.corner(c)];
        let ([Some(a), Some(b), Some(c)], true) = (corners, self.is_exact) else {
            return Unclear;
        };
        let (o, d) = (self.origin, self.direction);
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut surely_below, mut surely_above) = (true, true);
        let (mut some_below, mut some_above) = (false, false);
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let Some((value, error)) = triple(p - o, q - p, d) else { return Unclear };
            (least, most) = (least.min(value), most.max(value));
            some_below |= value < -error;
            some_above |= value > error;
            surely_below &= value < -error;
            surely_above &= value > error;
        }
        if some_below && some_above {
            return Missed;
        }
        if !surely_below && !surely_above {
            return Unclear;
        }
        let (along, from_origin) = (triple(b - a, c - a, d), triple(b - a, c - a, a - o));
        let (Some((den, den_error)), Some((volume, error))) = (along, from_origin) else {
            return Unclear;
        };
        let good = den_error / den.abs() + error / volume.abs() < T_ERROR;
        let t = volume / den * self.t_scale;
        let side = if den < 0.0 { Side::Front } else { Side::Back };
        if good && (1e-290..1e290).contains(&t.abs()) { Hit(t, side) } else { Unclear }
    }
}

/// (x × y) · z and a bound of its error, or `None` where products may leave the range of f64.
fn triple(x: DVec3, y: DVec3, z: DVec3) -> Option<(f64, f64)> {
    let value = x.cross(y).dot(z);
    let (p, q, r) = (x.abs(), y.abs(), z.abs());
    let terms = (p.yzx() * q.zxy() + p.zxy() * q.yzx()).dot(r);
    let product = p.max_element() * q.max_element();
    let in_range = |x: f64| (1e-200..1e300).contains(&x);
    let is_sound = in_range(product) && in_range(product * r.max_element());
    // What underflow takes of smaller terms.
    let vanished = 1e-320 * (1.0 + r.max_element());
    is_sound.then_some((value, ROUNDINGS * terms + vanished))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::{boxes, mesh, placed, soup, sphere};
    use crate::rays::Archer;

    #[test]
    fn a_glance_agrees_with_the_oracle_where_it_tells() {
        for mesh in [sphere(6), mesh(boxes(2))] {
            for ray in Archer::new(&mesh, 5).all_kinds(20, 1e6) {
                for id in 0..mesh.triangles().len() as u32 {
                    let corners = mesh.corners(id);
                    let exact = exactly(&corners, id, &ray).map(|(hit, _)| hit);
                    match View::of(&ray, 1.0).glance(&corners) {
                        Glance::Missed => assert_eq!(exact, None, "{ray:?} {id}"),
                        Glance::Hit(t, side) => {
                            let exact = exact.unwrap();
                            assert!(exact.is_at(t) && exact.side == side, "{ray:?} {id}");
                        }
                        Glance::Unclear => {}
                    }
                }
            }
        }
    }

    #[test]
    fn sizes_out_of_the_ordinary_are_seen_as_well() {
        let (mut told, mut all) = (0, 0);
        for size in [1e-300, 1e-100, 1e100, 1e300] {
            let mesh = mesh(placed(&soup(30, [0.0; 3], 1.0, 3), size, [0.0; 3]));
            let flat = Flat::new(&mesh);
            for ray in Archer::new(&mesh, 6).all_kinds(10, 1e3) {
                let view = View::of(&ray, flat.scale());
                for id in 0..30 {
                    let corners = mesh.corners(id);
                    let exact = exactly(&corners, id, &ray).map(|(hit, _)| hit);
                    match view.glance(&corners) {
                        Glance::Missed => assert_eq!(exact, None, "{ray:?} {id}"),
                        Glance::Hit(t, _) => assert!(exact.unwrap().is_at(t), "{ray:?} {id}"),
                        Glance::Unclear => told -= 1,
                    }
                    (told, all) = (told + 1, all + 1);
                }
            }
        }
        assert!(told > all / 2, "{told} of {all}");
    }

    #[test]
    fn what_is_beyond_f64_is_no_hit() {
        let flat = Flat::new(&mesh(boxes(1)));
        // Two faces, at t = 1.5 and 2.5 times 2^halvings.
        for (halvings, hits, reaches_beyond) in [(1022, 2, false), (1023, 1, true), (1024, 0, true)]
        {
            let tiny = f64::from_bits(1 << (1074 - halvings));
            let ray = Ray::new([0.25, 0.5, -1.5], [0.0, 0.0, tiny]);
            let truth = Truth::of(&flat, &ray);
            let found = (truth.crossed.len(), truth.reaches_beyond);
            assert_eq!(found, (hits, reaches_beyond), "{ray:?}");
        }
    }

    #[test]
    fn a_vertex_is_touched_by_all_and_crossed_by_one() {
        let flat = Flat::new(&mesh(boxes(1)));
        let truth = Truth::of(&flat, &Ray::new([-2.0; 3], [1.0; 3]));
        assert!(truth.touched.len() > truth.crossed.len() && truth.is_close);
        assert_eq!(truth.count(Interval::FORWARD), (2, 2));
        assert_eq!(truth.count(Interval { t_min: 0.0, t_max: 2.5 }), (1, 1));
        assert_eq!(truth.count(Interval { t_min: 2.0, t_max: 9.0 }), (1, 2));
    }
}
