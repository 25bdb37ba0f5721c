//! Rays of a caller.

use crate::error::ArgumentError;
use crate::rows::{Floats, Rows};
use kdray::{Ray, RayError};
use pyo3::{PyErr, PyResult};
use std::ops::Range;

/// The arrays of a call: origins, directions, and the bounds of t, all of as many rows.
pub(crate) type RayArguments<'py> = (Floats<'py>, Floats<'py>, Floats<'py>, Floats<'py>);

/// The rays that they describe.
#[derive(Debug)]
pub(crate) struct Rays<'a> {
    origins: Rows<'a, 3>,
    directions: Rows<'a, 3>,
    t_min: Rows<'a, 1>,
    t_max: Rows<'a, 1>,
    /// Whether rays that cannot be traced hit nothing, instead of being refused.
    lenient: bool,
}

/// Room to read rays into.
#[derive(Debug, Default)]
pub(crate) struct RayBlock {
    pub(crate) rays: Vec<Ray>,
    origins: Vec<[f64; 3]>,
    directions: Vec<[f64; 3]>,
    t_min: Vec<[f64; 1]>,
    t_max: Vec<[f64; 1]>,
}

impl<'a> Rays<'a> {
    pub(crate) fn new(arguments: &'a RayArguments<'_>, lenient: bool) -> PyResult<Self> {
        let (origins, directions, t_min, t_max) = arguments;
        let origins = origins.rows("origins")?;
        let directions = directions.rows("directions")?;
        let (t_min, t_max) = (t_min.rows("t_min")?, t_max.rows("t_max")?);
        let lengths = [directions.len(), t_min.len(), t_max.len()];
        if lengths.iter().any(|&length| length != origins.len()) {
            let reason = "origins, directions, t_min and t_max are not of as many rays";
            return Err(ArgumentError::new_err(reason));
        }
        Ok(Self { origins, directions, t_min, t_max, lenient })
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.origins.len()
    }

    /// Replaces the block's rays by those of `range`.
    ///
    /// # Errors
    /// The first that cannot be traced.
    pub(crate) fn read(&self, range: Range<usize>, block: &mut RayBlock) -> PyResult<()> {
        let first = range.start;
        self.fill(range, block);
        if self.lenient {
            return Ok(());
        }
        let mut rays = block.rays.iter().enumerate();
        rays.try_for_each(|(i, ray)| ray.check().map_err(|error| refused(first + i, error)))
    }

    fn fill(&self, range: Range<usize>, block: &mut RayBlock) {
        self.origins.read(range.clone(), &mut block.origins);
        self.directions.read(range.clone(), &mut block.directions);
        self.t_min.read(range.clone(), &mut block.t_min);
        self.t_max.read(range, &mut block.t_max);
        block.rays.clear();
        let lines = block.origins.iter().zip(&block.directions);
        let bounds = block.t_min.iter().zip(&block.t_max);
        block.rays.extend(lines.zip(bounds).map(
            |((&origin, &direction), (&[t_min], &[t_max]))| {
                Ray::new(origin, direction).with_interval(t_min, t_max)
            },
        ));
    }
}

/// That a ray cannot be traced, by the name of the argument that is to blame.
fn refused(index: usize, error: RayError) -> PyErr {
    let reason = match error {
        RayError::Origin => "origins: that of ray {} is not finite",
        RayError::Direction => "directions: that of ray {} is not finite",
        RayError::ZeroDirection => "directions: that of ray {} is zero",
        _ => "t_min, t_max: a bound of ray {} is NaN; use infinity for an open end",
    };
    ArgumentError::new_err(reason.replace("{}", &index.to_string()))
}
