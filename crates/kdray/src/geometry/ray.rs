//! The ray P = E + D·t of the founding lecture (S2).

use super::Interval;
use thiserror::Error;

/// A ray in K dimensions: origin, direction, and the interval of t that counts.
///
/// A point of the ray is `origin + t · direction`, so t is in units of the direction's length,
/// which may be any finite length but zero. Coordinates are f64; f32 values convert without loss.
///
/// Queries treat a ray that [`check`](Self::check) refuses as one that hits nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<const K: usize = 3> {
    /// E, the observer: the point at t = 0.
    pub origin: [f64; K],
    /// D: how far the ray moves while t grows by one.
    pub direction: [f64; K],
    /// The t that counts; hits outside are not reported.
    pub interval: Interval,
}

/// Why a ray cannot be traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum RayError {
    /// A coordinate of the origin is infinite or NaN.
    #[error("the ray's origin is not finite; give finite coordinates")]
    Origin,
    /// A component of the direction is infinite or NaN.
    #[error("the ray's direction is not finite; give finite components")]
    Direction,
    /// All components of the direction are zero.
    #[error("the ray's direction is zero; give a direction of any other length")]
    ZeroDirection,
    /// A bound of the interval is NaN.
    #[error("a bound of the ray's interval is NaN; use infinity for an open end")]
    Interval,
}

impl<const K: usize> Ray<K> {
    /// The ray from `origin` along `direction`, for t in `[0, +inf]`.
    pub fn new(origin: impl Into<[f64; K]>, direction: impl Into<[f64; K]>) -> Self {
        Self { origin: origin.into(), direction: direction.into(), interval: Interval::FORWARD }
    }

    /// The same from f32 values, such as those of glam's `Vec3`.
    pub fn from_f32(origin: impl Into<[f32; K]>, direction: impl Into<[f32; K]>) -> Self {
        Self::new(origin.into().map(f64::from), direction.into().map(f64::from))
    }

    /// The lecture's ray from the observer through a pixel: D = Pix − E, so t = 1 at the pixel.
    pub fn through(observer: impl Into<[f64; K]>, pixel: impl Into<[f64; K]>) -> Self {
        let (observer, pixel) = (observer.into(), pixel.into());
        Self::new(observer, std::array::from_fn(|axis| pixel[axis] - observer[axis]))
    }

    /// The same ray with only t in `[t_min, t_max]` counted.
    #[must_use]
    pub fn with_interval(mut self, t_min: f64, t_max: f64) -> Self {
        self.interval = Interval { t_min, t_max };
        self
    }

    /// The point at `t`.
    pub fn at(&self, t: f64) -> [f64; K] {
        std::array::from_fn(|axis| self.origin[axis] + t * self.direction[axis])
    }

    /// Says what, if anything, makes the ray untraceable. An empty interval is no error: such a
    /// ray hits nothing.
    pub fn check(&self) -> Result<(), RayError> {
        if !self.origin.iter().all(|x| x.is_finite()) {
            return Err(RayError::Origin);
        }
        if !self.direction.iter().all(|x| x.is_finite()) {
            return Err(RayError::Direction);
        }
        if self.direction.iter().all(|&x| x == 0.0) {
            return Err(RayError::ZeroDirection);
        }
        if self.interval.t_min.is_nan() || self.interval.t_max.is_nan() {
            return Err(RayError::Interval);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_through_a_pixel_reaches_it_at_one() {
        let ray = Ray::through([1.0, 2.0], [4.0, 6.0]);
        assert_eq!(ray.direction, [3.0, 4.0]);
        assert_eq!(ray.at(1.0), [4.0, 6.0]);
    }

    #[test]
    fn untraceable_rays_say_why() {
        let x = [1.0, 0.0, 0.0];
        assert_eq!(Ray::new([f64::NAN; 3], x).check(), Err(RayError::Origin));
        assert_eq!(Ray::new(x, [f64::INFINITY, 0.0, 0.0]).check(), Err(RayError::Direction));
        assert_eq!(Ray::new(x, [0.0, -0.0, 0.0]).check(), Err(RayError::ZeroDirection));
        assert_eq!(Ray::new(x, x).with_interval(f64::NAN, 1.0).check(), Err(RayError::Interval));
        assert_eq!(Ray::new(x, [5e-324, 0.0, 0.0]).check(), Ok(()));
    }
}
