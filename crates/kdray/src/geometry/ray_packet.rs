//! Rays that share an origin, a direction or a target (S12).

use super::{Interval, Ray};

/// Any number of rays that share a point or a direction, side by side: one slice of numbers for each
/// axis.
///
/// What they share is said once, because the cheap tests of packets come from it. Rays that lie next to
/// each other in the slices should lie next to each other in space: see
/// [`tile_order`](super::tile_order()).
#[derive(Clone, Copy, Debug)]
pub struct RayPacket<'a> {
    common: Common,
    each: [&'a [f64]; 3],
    intervals: Intervals<'a>,
}

/// What the rays of a packet share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Common {
    /// All start at this point: a pinhole camera, a point light that looks for what it lights. They
    /// differ in direction.
    Origin([f64; 3]),
    /// All go in this direction: the sun, an orthographic camera, ambient occlusion with one direction
    /// a tile. They differ in origin.
    Direction([f64; 3]),
    /// All go to this point, where t = 1: shadow rays to a point light. They differ in origin; their
    /// directions are target − origin, rounded to f64.
    Target([f64; 3]),
}

/// The t that count.
#[derive(Clone, Copy, Debug)]
enum Intervals<'a> {
    Same(Interval),
    Each { t_min: &'a [f64], t_max: &'a [f64] },
}

impl<'a> RayPacket<'a> {
    /// Rays from `origin` in each of `directions`, for t from 0 to infinity.
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn from(origin: impl Into<[f64; 3]>, directions: [&'a [f64]; 3]) -> Self {
        Self::new(Common::Origin(origin.into()), directions)
    }

    /// Rays along `direction` from each of `origins`, for t from 0 to infinity.
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn along(direction: impl Into<[f64; 3]>, origins: [&'a [f64]; 3]) -> Self {
        Self::new(Common::Direction(direction.into()), origins)
    }

    /// Rays to `target` from each of `origins`, for t from 0 to 1.
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn towards(target: impl Into<[f64; 3]>, origins: [&'a [f64]; 3]) -> Self {
        let rays = Self::new(Common::Target(target.into()), origins);
        rays.with_interval(0.0, 1.0)
    }

    /// Rays that share `common` and differ in `each`: their directions if the origin is common,
    /// otherwise their origins. For t from 0 to infinity.
    ///
    /// # Panics
    /// If the slices differ in length, or there are 2^32 rays or more.
    pub fn new(common: Common, each: [&'a [f64]; 3]) -> Self {
        let [x, y, z] = each;
        assert!(x.len() == y.len() && y.len() == z.len(), "as many numbers on each axis");
        assert!(u32::try_from(x.len()).is_ok(), "fewer than 2^32 rays");
        Self { common, each, intervals: Intervals::Same(Interval::FORWARD) }
    }

    /// The same rays with only t in `[t_min, t_max]` counted.
    #[must_use]
    pub fn with_interval(self, t_min: f64, t_max: f64) -> Self {
        Self { intervals: Intervals::Same(Interval { t_min, t_max }), ..self }
    }

    /// The same rays with only t in `[t_min[i], t_max[i]]` counted of ray i.
    ///
    /// # Panics
    /// If there are not as many as rays.
    #[must_use]
    pub fn with_intervals(self, t_min: &'a [f64], t_max: &'a [f64]) -> Self {
        assert!(t_min.len() == self.len() && t_max.len() == self.len(), "as many bounds as rays");
        Self { intervals: Intervals::Each { t_min, t_max }, ..self }
    }

    /// How many rays there are.
    pub fn len(&self) -> usize {
        self.each[0].len()
    }

    /// Whether there are no rays.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// What the rays share.
    pub fn common(&self) -> Common {
        self.common
    }

    /// In what they differ: the directions if the origin is common, otherwise the origins. A slice
    /// for each axis.
    pub fn each(&self) -> [&'a [f64]; 3] {
        self.each
    }

    /// A ray as one that is alone.
    ///
    /// # Panics
    /// If there are not so many.
    #[inline]
    pub fn ray(&self, index: usize) -> Ray {
        let own = self.each.map(|numbers| numbers[index]);
        let ray = match self.common {
            Common::Origin(origin) => Ray::new(origin, own),
            Common::Direction(direction) => Ray::new(own, direction),
            Common::Target(target) => Ray::through(own, target),
        };
        Ray { interval: self.interval(index), ..ray }
    }

    /// The t that count of every ray, if they are the same.
    #[inline]
    pub(crate) fn same_interval(&self) -> Option<Interval> {
        match self.intervals {
            Intervals::Same(interval) => Some(interval),
            Intervals::Each { .. } => None,
        }
    }

    /// The t that count of a ray.
    #[inline]
    pub fn interval(&self, index: usize) -> Interval {
        match self.intervals {
            Intervals::Same(interval) => interval,
            Intervals::Each { t_min, t_max } => {
                Interval { t_min: t_min[index], t_max: t_max[index] }
            }
        }
    }
}
