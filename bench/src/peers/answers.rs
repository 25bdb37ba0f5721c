//! A peer's answers, into files.

use super::ROUNDS;
use super::case::Case;
use super::collect::Lists;
use crate::contender::{Answers, Contender, Job};
use crate::error::BenchError;
use crate::measure::{median, timed_here};
use crate::rays::{RaySet, SetKind};
use crate::workers::Workers;
use npyz::{AutoSerialize, WriterBuilder};
use serde::Serialize;
use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

/// The folder of a peer, and what is said of it when all answers are there.
pub(super) struct Written {
    folder: PathBuf,
    about: About,
}

/// Name, version, and the seconds of processor time that each query took.
#[derive(Serialize)]
struct About {
    name: String,
    version: String,
    closest: Option<f64>,
    any: Option<f64>,
    all: Option<f64>,
}

impl Written {
    /// Makes the folder.
    pub(super) fn create(case: &Path, name: &str, version: &str) -> Result<Self, BenchError> {
        let folder = case.join(name);
        fs::create_dir_all(&folder).map_err(|error| BenchError::io(&folder, error))?;
        let (name, version) = (name.to_owned(), version.to_owned());
        Ok(Self { folder, about: About { name, version, closest: None, any: None, all: None } })
    }

    /// Closest and any hits by a kernel of the bench.
    pub(super) fn by_kernel(
        &mut self,
        case: &Case,
        contender: &dyn Contender,
        kernel: &str,
    ) -> Result<(), BenchError> {
        let built = contender.build(&case.mesh, &Workers::new(1)?)?;
        for kind in [SetKind::Diffuse, SetKind::Ao] {
            if kind == SetKind::Ao && !contender.has_any_hit() {
                continue;
            }
            let set = RaySet { kind, rays: case.rays.clone(), parents: Vec::new() };
            let Some(mut trace) = built.prepare(kernel, &Job { set: &set, primary: &set }) else {
                continue;
            };
            let mut answers = Answers::room(kind.question(), set.rays.len());
            let round = |_| timed_here(|| trace.trace(&mut answers)).1.cpu;
            let seconds = median((0..ROUNDS).map(round).collect());
            match answers {
                Answers::Closest(found) => {
                    self.about.closest = Some(seconds);
                    let t = |it: &crate::contender::Found| {
                        if it.is_hit() { it.t } else { f32::INFINITY }
                    };
                    self.write("closest.npy", &found.iter().map(t).collect::<Vec<_>>())?;
                }
                Answers::Any(found) => {
                    self.about.any = Some(seconds);
                    self.write(
                        "any.npy",
                        &found.iter().map(|&it| u8::from(it)).collect::<Vec<_>>(),
                    )?;
                }
            }
        }
        Ok(())
    }

    /// All hits.
    pub(super) fn all(&mut self, lists: &Lists) -> Result<(), BenchError> {
        self.about.all = Some(lists.seconds);
        self.write("splits.npy", &lists.splits)?;
        self.write("t.npy", &lists.t)
    }

    /// Says that it is complete.
    pub(super) fn finish(self) -> Result<(), BenchError> {
        crate::report::write_json(&self.folder.join("about.json"), &self.about)
    }

    fn write<T: AutoSerialize>(&self, name: &str, numbers: &[T]) -> Result<(), BenchError> {
        let path = self.folder.join(name);
        let write = || -> io::Result<()> {
            let file = BufWriter::new(File::create(&path)?);
            let options = npyz::WriteOptions::new().default_dtype().shape(&[numbers.len() as u64]);
            let mut writer = options.writer(file).begin_nd()?;
            writer.extend(numbers)?;
            writer.finish()
        };
        write().map_err(|error| BenchError::io(&path, error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contenders;
    use crate::peers::case::numbers;
    use crate::peers::collect;
    use crate::rays::Ray;
    use kdray::TriangleMesh;

    #[test]
    fn answers_are_written_ray_by_ray() {
        let folder = tempfile::tempdir().unwrap();
        let corners = vec![[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
        let mesh = TriangleMesh::new(corners, vec![[0, 1, 2], [0, 2, 1]]).unwrap();
        let t_max = f32::INFINITY;
        let ray = |x| Ray { origin: [x, 0.25, 0.0], direction: [0.0, 0.0, 1.0], t_max };
        let name = "two triangles".to_owned();
        let home = folder.path().to_owned();
        let case = Case { name, folder: home, mesh, rays: vec![ray(0.25), ray(7.0), ray(0.5)] };
        let mut written = Written::create(&case.folder, "kdray", "1").unwrap();
        let list = contenders::all(None);
        let kdray = list.iter().find(|it| it.name() == "kdray").unwrap();
        written.by_kernel(&case, kdray.as_ref(), "single").unwrap();
        written.all(&collect::kdray(&case.mesh, &case.rays).unwrap()).unwrap();
        written.finish().unwrap();
        let peer = folder.path().join("kdray");
        let of = |name: &str| numbers::<f32>(&peer.join(name)).unwrap();
        assert_eq!((of("closest.npy"), of("t.npy")), (vec![2.0, t_max, 2.0], vec![2.0; 4]));
        assert_eq!(numbers::<u8>(&peer.join("any.npy")).unwrap(), [1, 0, 1]);
        assert_eq!(numbers::<u64>(&peer.join("splits.npy")).unwrap(), [0, 2, 2, 4]);
        let about = fs::read_to_string(peer.join("about.json")).unwrap();
        assert!(about.contains("\"kdray\"") && !about.contains("null"), "{about}");
    }
}
