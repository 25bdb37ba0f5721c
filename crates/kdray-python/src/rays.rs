//! Rays of a caller.

use crate::error::{ArgumentError, LENIENT};
use crate::rows::{Floats, Rows};
use kdray::{Interval, Ray, RayError};
use pyo3::{PyErr, PyResult};
use std::ops::Range;

/// The arrays of a call: origins and directions, or both in one, and the bounds of t, all of as many rows.
pub(crate) type RayArguments<'py> = (Floats<'py>, Option<Floats<'py>>, Floats<'py>, Floats<'py>);

/// The rays that they describe.
#[derive(Debug)]
pub(crate) struct Rays<'a> {
    lines: Lines<'a>,
    t_min: Rows<'a, 1>,
    t_max: Rows<'a, 1>,
    /// Whether rays that cannot be traced hit nothing, instead of being refused.
    lenient: bool,
}

/// Origins and directions.
#[derive(Debug)]
enum Lines<'a> {
    Together(Rows<'a, 6>),
    Apart(Rows<'a, 3>, Rows<'a, 3>),
}

impl<'a> Rays<'a> {
    pub(crate) fn new(arguments: &'a RayArguments<'_>, lenient: bool) -> PyResult<Self> {
        let (origins, directions, t_min, t_max) = arguments;
        let lines = Lines::new(origins, directions.as_ref())?;
        let (t_min, t_max) = (t_min.rows("t_min")?, t_max.rows("t_max")?);
        let lengths = [lines.lengths(), [t_min.len(), t_max.len()]];
        if lengths.as_flattened().iter().any(|&length| length != t_min.len()) {
            let reason = "are not of as many rays";
            return Err(ArgumentError::new_err(format!(
                "{}, t_min, t_max: {reason}",
                lines.name()
            )));
        }
        Ok(Self { lines, t_min, t_max, lenient })
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.t_min.len()
    }

    /// Replaces `rays` by those of `range`.
    ///
    /// # Errors
    /// The first that cannot be traced.
    pub(crate) fn read(&self, range: Range<usize>, rays: &mut Vec<Ray>) -> PyResult<()> {
        let first = range.start;
        self.fill(range, rays);
        match rays.iter().position(is_suspect).filter(|_| !self.lenient) {
            Some(suspect) => self.check(&rays[suspect..], first + suspect),
            None => Ok(()),
        }
    }

    /// Refuses the first that cannot be traced; `first` is the index of the first of the rays.
    #[cold]
    fn check(&self, rays: &[Ray], first: usize) -> PyResult<()> {
        let refused = |i, error| self.lines.refused(first + i, error);
        let mut rays = rays.iter().enumerate();
        rays.try_for_each(|(i, ray)| ray.check().map_err(|error| refused(i, error)))
    }

    /// Room for rays that is there already is not cleared.
    fn fill(&self, range: Range<usize>, rays: &mut Vec<Ray>) {
        rays.resize(range.len(), Ray::new([0.0; 3], [0.0; 3]));
        let same = self.t_min.same().zip(self.t_max.same());
        let ([t_min], [t_max]) = same.unwrap_or_default();
        let interval = Interval { t_min, t_max };
        self.lines.read(range.clone(), interval, rays);
        if same.is_none() {
            each(&self.t_min, range.clone(), rays, |ray, [t_min]| ray.interval.t_min = t_min);
            each(&self.t_max, range, rays, |ray, [t_max]| ray.interval.t_max = t_max);
        }
    }
}

impl<'a> Lines<'a> {
    fn new(origins: &'a Floats<'_>, directions: Option<&'a Floats<'_>>) -> PyResult<Self> {
        Ok(match directions {
            None => Self::Together(origins.rows("rays")?),
            Some(directions) => {
                Self::Apart(origins.rows("origins")?, directions.rows("directions")?)
            }
        })
    }

    /// The arguments that they are.
    fn name(&self) -> &'static str {
        match self {
            Self::Together(_) => "rays",
            Self::Apart(..) => "origins, directions",
        }
    }

    /// How many origins and directions there are.
    fn lengths(&self) -> [usize; 2] {
        match self {
            Self::Together(rows) => [rows.len(); 2],
            Self::Apart(origins, directions) => [origins.len(), directions.len()],
        }
    }

    fn read(&self, range: Range<usize>, interval: Interval, rays: &mut [Ray]) {
        match self {
            Self::Together(rows) => each(rows, range, rays, |ray, [a, b, c, x, y, z]| {
                *ray = Ray { origin: [a, b, c], direction: [x, y, z], interval };
            }),
            Self::Apart(origins, directions) => {
                each(origins, range.clone(), rays, |ray, origin| ray.origin = origin);
                each(directions, range, rays, |ray, direction| {
                    (ray.direction, ray.interval) = (direction, interval);
                });
            }
        }
    }

    /// That a ray cannot be traced, by the name of the argument that is to blame.
    fn refused(&self, index: usize, error: RayError) -> PyErr {
        let [origin, direction] = match self {
            Self::Together(_) => ["rays: the origin", "rays: the direction"],
            Self::Apart(..) => ["origins: that", "directions: that"],
        };
        let reason = match error {
            RayError::Origin => format!("{origin} of ray {index} is not finite"),
            RayError::Direction => format!("{direction} of ray {index} is not finite"),
            RayError::ZeroDirection => format!("{direction} of ray {index} is zero"),
            _ => {
                format!("t_min, t_max: a bound of ray {index} is NaN; use infinity for an open end")
            }
        };
        ArgumentError::new_err(format!("{reason}; with {LENIENT} such rays hit nothing"))
    }
}

/// Gives each ray with its row to `set`.
#[inline]
fn each<const N: usize>(
    rows: &Rows<'_, N>,
    range: Range<usize>,
    rays: &mut [Ray],
    set: impl Fn(&mut Ray, [f64; N]),
) {
    let mut rays = rays.iter_mut();
    rows.each(range, |row| {
        if let Some(ray) = rays.next() {
            set(ray, row);
        }
    });
}

/// Whether a ray may be one that cannot be traced: by sums, which are not finite if a number is not, and may be
/// without that.
fn is_suspect(ray: &Ray) -> bool {
    let sum = |[x, y, z]: [f64; 3]| x.abs() + y.abs() + z.abs();
    let (origin, direction) = (sum(ray.origin), sum(ray.direction));
    let is_plain = origin + direction < f64::INFINITY && direction > 0.0;
    !is_plain || ray.interval.t_min.is_nan() || ray.interval.t_max.is_nan()
}
