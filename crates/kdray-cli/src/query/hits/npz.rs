//! Hits as numpy arrays in a zip archive.

use super::{
    super::{Answer, Mode, Precision},
    MISS_ID,
    array::{Array, Number},
};
use crate::output::Output;
use kdray::{ClosestPoint, Hit};
use std::{
    fs::File,
    io::{self, BufWriter, Seek, Write},
};
use zip::{CompressionMethod, ZipWriter, write::SimpleFileOptions};

/// The arrays of a mode, growing.
pub(crate) enum NpzHits {
    Closest { hits: HitArrays, primitive_normals: Array },
    Any { occluded: Array },
    All { hits: HitArrays, ray_ids: Array, ray_splits: Array, count: i64 },
    Count { intersection_counts: Array },
    ClosestPoint { nearest: NearestArrays, primitive_normals: Array },
    Contains { inside: Array },
    SignedDistance { signed_distances: Array },
    WindingNumber { winding_numbers: Array },
}

/// What is said of a hit.
pub(crate) struct HitArrays {
    t_hit: Array,
    geometry_ids: Array,
    primitive_ids: Array,
    primitive_uvs: Array,
}

/// What is said of a nearest point.
pub(crate) struct NearestArrays {
    points: Array,
    distances: Array,
    geometry_ids: Array,
    primitive_ids: Array,
    primitive_uvs: Array,
}

impl NpzHits {
    /// Arrays in files without names beside `output`.
    pub(super) fn new(output: &Output, mode: Mode, precision: Precision) -> io::Result<Self> {
        let array = |name, number, columns| {
            Ok::<_, io::Error>(Array::new(name, number, columns, precision, output.scratch()?))
        };
        let hits = || {
            Ok::<_, io::Error>(HitArrays {
                t_hit: array("t_hit", Number::Float, 1)?,
                geometry_ids: array("geometry_ids", Number::U32, 1)?,
                primitive_ids: array("primitive_ids", Number::U32, 1)?,
                primitive_uvs: array("primitive_uvs", Number::Float, 2)?,
            })
        };
        Ok(match mode {
            Mode::Closest => Self::Closest {
                hits: hits()?,
                primitive_normals: array("primitive_normals", Number::Float, 3)?,
            },
            Mode::Any => Self::Any { occluded: array("occluded", Number::Bool, 1)? },
            Mode::All => {
                let mut ray_splits = array("ray_splits", Number::I64, 1)?;
                ray_splits.push(&0_i64.to_le_bytes())?;
                let ray_ids = array("ray_ids", Number::I64, 1)?;
                Self::All { hits: hits()?, ray_ids, ray_splits, count: 0 }
            }
            Mode::Count => {
                let intersection_counts = array("intersection_counts", Number::I32, 1)?;
                Self::Count { intersection_counts }
            }
            Mode::ClosestPoint => Self::ClosestPoint {
                nearest: NearestArrays {
                    points: array("points", Number::Float, 3)?,
                    distances: array("distances", Number::Float, 1)?,
                    geometry_ids: array("geometry_ids", Number::U32, 1)?,
                    primitive_ids: array("primitive_ids", Number::U32, 1)?,
                    primitive_uvs: array("primitive_uvs", Number::Float, 2)?,
                },
                primitive_normals: array("primitive_normals", Number::Float, 3)?,
            },
            Mode::Contains => Self::Contains { inside: array("inside", Number::Bool, 1)? },
            Mode::SignedDistance => {
                let signed_distances = array("signed_distances", Number::Float, 1)?;
                Self::SignedDistance { signed_distances }
            }
            Mode::WindingNumber => {
                let winding_numbers = array("winding_numbers", Number::Float, 1)?;
                Self::WindingNumber { winding_numbers }
            }
        })
    }

    /// Appends the answer of the ray or point with this number.
    pub(super) fn write(&mut self, ray: u64, answer: &Answer) -> io::Result<()> {
        match (self, answer) {
            (Self::Closest { hits, primitive_normals }, Answer::Closest(found)) => {
                hits.push(found.map(|(hit, _)| hit))?;
                primitive_normals.push_floats(&found.map_or([0.0; 3], |(_, normal)| normal))
            }
            (Self::Any { occluded }, Answer::Any(any)) => occluded.push(&[u8::from(*any)]),
            (Self::All { hits, ray_ids, ray_splits, count }, Answer::All(all)) => {
                for &hit in all {
                    hits.push(Some(hit))?;
                    ray_ids.push(&ray.to_le_bytes())?;
                }
                *count += all.len() as i64;
                ray_splits.push(&count.to_le_bytes())
            }
            (Self::Count { intersection_counts }, Answer::Count(count)) => {
                intersection_counts.push(&(*count as i32).to_le_bytes())
            }
            (Self::ClosestPoint { nearest, primitive_normals }, Answer::ClosestPoint(found)) => {
                nearest.push(found.map(|(nearest, _)| nearest))?;
                primitive_normals.push_floats(&found.map_or([0.0; 3], |(_, normal)| normal))
            }
            (Self::Contains { inside }, Answer::Contains(is_so)) => {
                inside.push(&[u8::from(*is_so)])
            }
            (Self::SignedDistance { signed_distances }, Answer::SignedDistance(distance)) => {
                signed_distances.push_floats(&[distance.unwrap_or(f64::INFINITY)])
            }
            (Self::WindingNumber { winding_numbers }, Answer::WindingNumber(number)) => {
                winding_numbers.push_floats(&[*number])
            }
            _ => Err(io::Error::other("the answer is not of the mode that was asked for")),
        }
    }

    /// Gathers the arrays in an archive.
    pub(super) fn finish(self, output: &mut Output) -> io::Result<()> {
        if output.file().stream_position().is_ok() {
            return self.gather(output.file());
        }
        // The sizes at the front of an archive are known last; a pipe does not go back to them.
        let mut whole = output.scratch()?;
        self.gather(&mut whole)?;
        whole.rewind()?;
        io::copy(&mut whole, output.file()).map(drop)
    }

    fn gather(self, file: &mut File) -> io::Result<()> {
        let mut archive = ZipWriter::new(BufWriter::new(file));
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .large_file(true);
        for array in self.into_arrays() {
            archive.start_file(format!("{}.npy", array.name()), options)?;
            array.copy_to(&mut archive)?;
        }
        archive.finish()?.flush()
    }

    fn into_arrays(self) -> Vec<Array> {
        match self {
            Self::Closest { hits, primitive_normals } => {
                hits.into_iter().chain([primitive_normals]).collect()
            }
            Self::Any { occluded } => vec![occluded],
            Self::All { hits, ray_ids, ray_splits, .. } => {
                hits.into_iter().chain([ray_ids, ray_splits]).collect()
            }
            Self::Count { intersection_counts } => vec![intersection_counts],
            Self::ClosestPoint { nearest, primitive_normals } => {
                nearest.into_iter().chain([primitive_normals]).collect()
            }
            Self::Contains { inside } => vec![inside],
            Self::SignedDistance { signed_distances } => vec![signed_distances],
            Self::WindingNumber { winding_numbers } => vec![winding_numbers],
        }
    }
}

impl HitArrays {
    fn push(&mut self, hit: Option<Hit>) -> io::Result<()> {
        let geometry_id = hit.map_or(MISS_ID, |_| 0);
        let primitive_id = hit.map_or(MISS_ID, |hit| hit.primitive_id);
        self.t_hit.push_floats(&[hit.map_or(f64::INFINITY, |hit| hit.t)])?;
        self.geometry_ids.push(&geometry_id.to_le_bytes())?;
        self.primitive_ids.push(&primitive_id.to_le_bytes())?;
        self.primitive_uvs.push_floats(&hit.map_or([0.0; 2], |hit| [hit.u, hit.v]))
    }
}

impl IntoIterator for HitArrays {
    type Item = Array;
    type IntoIter = std::array::IntoIter<Array, 4>;

    fn into_iter(self) -> Self::IntoIter {
        [self.t_hit, self.geometry_ids, self.primitive_ids, self.primitive_uvs].into_iter()
    }
}

impl NearestArrays {
    fn push(&mut self, nearest: Option<ClosestPoint>) -> io::Result<()> {
        let geometry_id = nearest.map_or(MISS_ID, |_| 0);
        let primitive_id = nearest.map_or(MISS_ID, |nearest| nearest.primitive_id);
        let distance = nearest.map_or(f64::INFINITY, |nearest| nearest.distance);
        self.points.push_floats(&nearest.map_or([0.0; 3], |nearest| nearest.point))?;
        self.distances.push_floats(&[distance])?;
        self.geometry_ids.push(&geometry_id.to_le_bytes())?;
        self.primitive_ids.push(&primitive_id.to_le_bytes())?;
        self.primitive_uvs.push_floats(&nearest.map_or([0.0; 2], |nearest| [nearest.u, nearest.v]))
    }
}

impl IntoIterator for NearestArrays {
    type Item = Array;
    type IntoIter = std::array::IntoIter<Array, 5>;

    fn into_iter(self) -> Self::IntoIter {
        let Self { points, distances, geometry_ids, primitive_ids, primitive_uvs } = self;
        [points, distances, geometry_ids, primitive_ids, primitive_uvs].into_iter()
    }
}
