//! Hits as lines of numbers.

use super::{
    super::{Answer, Mode, Precision},
    MISS_ID,
};
use kdray::{ClosestPoint, Hit};
use std::{
    fmt,
    io::{self, Write},
};

const HIT: &str = "t_hit,geometry_ids,primitive_ids,primitive_uvs_u,primitive_uvs_v";
const NORMAL: &str = "primitive_normals_x,primitive_normals_y,primitive_normals_z";
const NEAREST: &str = "points_x,points_y,points_z,distances,geometry_ids,primitive_ids,\
                       primitive_uvs_u,primitive_uvs_v";

/// A line of names, then a line for each ray or point, or for mode `all` each hit.
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
            Mode::ClosestPoint => writeln!(target, "{NEAREST},{NORMAL}")?,
            Mode::Contains => writeln!(target, "inside")?,
            Mode::SignedDistance => writeln!(target, "signed_distances")?,
            Mode::WindingNumber => writeln!(target, "winding_numbers")?,
        }
        Ok(Self { target, precision })
    }

    /// Appends the answer of the ray with this number.
    pub(super) fn write(&mut self, ray: u64, answer: &Answer) -> io::Result<()> {
        match answer {
            Answer::Closest(found) => {
                self.write_hit(found.map(|(hit, _)| hit))?;
                self.write_normal(found.map(|(_, normal)| normal))
            }
            Answer::Any(is_so) | Answer::Contains(is_so) => writeln!(self.target, "{is_so}"),
            Answer::All(hits) => hits.iter().try_for_each(|&hit| {
                write!(self.target, "{ray},")?;
                self.write_hit(Some(hit))?;
                writeln!(self.target)
            }),
            Answer::Count(count) => writeln!(self.target, "{count}"),
            Answer::ClosestPoint(found) => {
                self.write_nearest(found.map(|(nearest, _)| nearest))?;
                self.write_normal(found.map(|(_, normal)| normal))
            }
            Answer::SignedDistance(distance) => {
                let distance = self.float(distance.unwrap_or(f64::INFINITY));
                writeln!(self.target, "{distance}")
            }
            Answer::WindingNumber(number) => {
                let number = self.float(*number);
                writeln!(self.target, "{number}")
            }
        }
    }

    /// The end of a line.
    fn write_normal(&mut self, normal: Option<[f64; 3]>) -> io::Result<()> {
        let [x, y, z] = normal.unwrap_or_default().map(|value| self.float(value));
        writeln!(self.target, ",{x},{y},{z}")
    }

    fn write_nearest(&mut self, nearest: Option<ClosestPoint>) -> io::Result<()> {
        let point = nearest.map_or([0.0; 3], |nearest| nearest.point);
        let [x, y, z] = point.map(|value| self.float(value));
        let distance = self.float(nearest.map_or(f64::INFINITY, |nearest| nearest.distance));
        let geometry_id = nearest.map_or(MISS_ID, |_| 0);
        let primitive_id = nearest.map_or(MISS_ID, |nearest| nearest.primitive_id);
        let uv = nearest.map_or([0.0; 2], |nearest| [nearest.u, nearest.v]);
        let [u, v] = uv.map(|value| self.float(value));
        write!(self.target, "{x},{y},{z},{distance},{geometry_id},{primitive_id},{u},{v}")
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
