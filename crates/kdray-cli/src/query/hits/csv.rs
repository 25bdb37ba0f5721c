//! Hits as lines of numbers.

use super::{
    super::{Answer, Mode, Precision},
    MISS_ID,
};
use kdray::Hit;
use std::{
    fmt,
    io::{self, Write},
};

const HIT: &str = "t_hit,geometry_ids,primitive_ids,primitive_uvs_u,primitive_uvs_v";
const NORMAL: &str = "primitive_normals_x,primitive_normals_y,primitive_normals_z";

/// A line of names, then a line for each ray, or for mode `all` each hit.
pub(crate) struct CsvHits {
    target: Box<dyn Write>,
    precision: Precision,
}

impl CsvHits {
    pub(super) fn new(
        target: impl Write + 'static,
        mode: Mode,
        precision: Precision,
    ) -> io::Result<Self> {
        let mut target: Box<dyn Write> = Box::new(io::BufWriter::new(target));
        match mode {
            Mode::Closest => writeln!(target, "{HIT},{NORMAL}")?,
            Mode::Any => writeln!(target, "occluded")?,
            Mode::All => writeln!(target, "ray_ids,{HIT}")?,
            Mode::Count => writeln!(target, "intersection_counts")?,
        }
        Ok(Self { target, precision })
    }

    /// Appends the answer of the ray with this number.
    pub(super) fn write(&mut self, ray: u64, answer: &Answer) -> io::Result<()> {
        match answer {
            Answer::Closest(found) => {
                self.write_hit(found.map(|(hit, _)| hit))?;
                let [x, y, z] = found.map_or([0.0; 3], |(_, normal)| normal);
                let [x, y, z] = [x, y, z].map(|value| self.float(value));
                writeln!(self.target, ",{x},{y},{z}")
            }
            Answer::Any(occluded) => writeln!(self.target, "{occluded}"),
            Answer::All(hits) => hits.iter().try_for_each(|&hit| {
                write!(self.target, "{ray},")?;
                self.write_hit(Some(hit))?;
                writeln!(self.target)
            }),
            Answer::Count(count) => writeln!(self.target, "{count}"),
        }
    }

    fn write_hit(&mut self, hit: Option<Hit>) -> io::Result<()> {
        let Some(hit) = hit else {
            let [t, u, v] = [f64::INFINITY, 0.0, 0.0].map(|value| self.float(value));
            return write!(self.target, "{t},{MISS_ID},{MISS_ID},{u},{v}");
        };
        let [t, u, v] = [hit.t, hit.u, hit.v].map(|value| self.float(value));
        write!(self.target, "{t},0,{},{u},{v}", hit.primitive_id)
    }

    /// As few digits as tell the number apart in its precision.
    fn float(&self, value: f64) -> Float {
        Float { value, precision: self.precision }
    }

    pub(super) fn flush(&mut self) -> io::Result<()> {
        self.target.flush()
    }
}

struct Float {
    value: f64,
    precision: Precision,
}

impl fmt::Display for Float {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.precision {
            // Debug writes very large and small numbers with an exponent.
            Precision::F32 => write!(f, "{:?}", self.value as f32),
            Precision::F64 => write!(f, "{:?}", self.value),
        }
    }
}
