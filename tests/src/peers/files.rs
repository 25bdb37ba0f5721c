//! Cases and answers in files: arrays of numpy, which everyone can read.

use super::cases::Case;
use npyz::{AutoSerialize, Deserialize, NpyFile, WriteOptions, WriterBuilder};
use serde::Deserialize as FromJson;
use std::fs::{self, File};
use std::io::{self, BufReader, BufWriter};
use std::path::Path;

/// What a peer said about a case; nothing where it has no such query.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answers {
    /// Its name, version and times.
    pub about: About,
    /// The t of the closest hit, infinite for none.
    pub closest: Option<Vec<f32>>,
    /// 1 for rays that hit anything.
    pub any: Option<Vec<u8>>,
    /// The t of all hits, ray by ray, in the order in which they were given.
    pub all: Option<Lists>,
}

/// Lists of numbers, one behind the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lists {
    /// Where each begins, and where the last one ends.
    pub splits: Vec<u64>,
    /// The numbers.
    pub t: Vec<f32>,
}

/// Who answered, and how many seconds each query took.
#[derive(Clone, Debug, Default, PartialEq, FromJson)]
pub struct About {
    /// As tables call it.
    pub name: String,
    /// Of the program, or of the package that has it.
    pub version: String,
    /// Seconds for closest hits.
    pub closest: Option<f64>,
    /// Seconds for any hits.
    pub any: Option<f64>,
    /// Seconds for all hits.
    pub all: Option<f64>,
}

/// Writes the cases, each in a folder of its own; what was in `folder` before is gone.
///
/// # Errors
/// If a file cannot be written.
pub fn write(folder: &Path, cases: &[Case]) -> io::Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder)?;
    }
    for (number, Case { name, target, shots, .. }) in cases.iter().enumerate() {
        let folder = folder.join(format!("{number:02} {name}"));
        fs::create_dir_all(&folder)?;
        let numbers = shots.iter().flat_map(|shot| [shot.ray.origin, shot.ray.direction]);
        let rays: Vec<f32> = numbers.flatten().map(|x| x as f32).collect();
        array(&folder.join("vertices.npy"), target.mesh.vertices().as_flattened(), 3)?;
        array(&folder.join("triangles.npy"), target.mesh.triangles().as_flattened(), 3)?;
        array(&folder.join("rays.npy"), &rays, 6)?;
    }
    Ok(())
}

fn array<T: AutoSerialize>(path: &Path, numbers: &[T], columns: usize) -> io::Result<()> {
    let shape = [(numbers.len() / columns) as u64, columns as u64];
    let file = BufWriter::new(File::create(path)?);
    let mut writer = WriteOptions::new().default_dtype().shape(&shape).writer(file).begin_nd()?;
    writer.extend(numbers)?;
    writer.finish()
}

/// The answers of all peers to the case of that number, in the order of their names' folders.
///
/// # Errors
/// If a file cannot be read, or does not fit to the number of rays.
pub fn read(folder: &Path, number: usize, case: &Case) -> io::Result<Vec<Answers>> {
    let folder = folder.join(format!("{number:02} {}", case.name));
    let entries = fs::read_dir(&folder)?.collect::<io::Result<Vec<_>>>()?;
    let mut peers: Vec<_> = entries.into_iter().map(|entry| entry.path()).collect();
    peers.retain(|peer| peer.join("about.json").exists());
    peers.sort();
    peers.iter().map(|peer| read_peer(peer, case.shots.len())).collect()
}

fn read_peer(folder: &Path, rays: usize) -> io::Result<Answers> {
    let about = serde_json::from_slice(&fs::read(folder.join("about.json"))?)?;
    let (closest, any) = (numbers(folder, "closest.npy")?, numbers(folder, "any.npy")?);
    let (splits, t) = (numbers::<u64>(folder, "splits.npy")?, numbers::<f32>(folder, "t.npy")?);
    let all = splits.zip(t).map(|(splits, t)| Lists { splits, t });
    let answers = Answers { about, closest, any, all };
    if answers.fits(rays) {
        return Ok(answers);
    }
    let wrong = format!("{}: not as many answers as rays", folder.display());
    Err(io::Error::new(io::ErrorKind::InvalidData, wrong))
}

/// The numbers of an array, if there is such a file.
fn numbers<T: Deserialize>(folder: &Path, name: &str) -> io::Result<Option<Vec<T>>> {
    let path = folder.join(name);
    if !path.exists() {
        return Ok(None);
    }
    NpyFile::new(BufReader::new(File::open(path)?))?.into_vec().map(Some)
}

impl Answers {
    /// Whether it is said where closest hits are: who says only whether there are any gives each a t of zero.
    pub fn say_where(&self) -> bool {
        self.closest.iter().flatten().any(|&t| t.is_finite() && t != 0.0)
    }

    fn fits(&self, rays: usize) -> bool {
        let closest = self.closest.as_ref().is_none_or(|it| it.len() == rays);
        let any = self.any.as_ref().is_none_or(|it| it.len() == rays);
        closest && any && self.all.as_ref().is_none_or(|lists| lists.fit(rays))
    }
}

impl Lists {
    fn fit(&self, rays: usize) -> bool {
        self.splits.len() == rays + 1
            && self.splits.is_sorted()
            && self.splits.last() == Some(&(self.t.len() as u64))
    }

    /// The numbers of a list.
    pub fn of(&self, index: usize) -> &[f32] {
        &self.t[self.splits[index] as usize..self.splits[index + 1] as usize]
    }
}
