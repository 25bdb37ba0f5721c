//! Rays in files, so that every run traces the same ones.
//!
//! A file is: eight bytes that name the format and its version, the key, the resolution, then for
//! each set the number of rays, their seven numbers each (origin, direction, t_max) and, but for
//! primary rays, their parents; at last the xxHash64 of all that. Everything little-endian. A file
//! that is not just so is made anew.

use super::{Ray, RaySet, RaySets, SetKind};
use crate::error::BenchError;
use crate::scene::BenchScene;
use std::fs;
use std::hash::Hasher;
use std::io::Write;
use std::path::{Path, PathBuf};
use twox_hash::XxHash64;

/// The format; the last digit is its version, to be raised whenever rays are made differently.
const MAGIC: [u8; 8] = *b"kdrays 2";

/// What rays are made from.
pub(super) struct Key {
    name: String,
    resolution: u32,
    hash: u64,
}

impl Key {
    /// The key of the rays of `scene`: its name, the resolution, and a hash of triangles, camera
    /// and light.
    pub(super) fn of(scene: &BenchScene, resolution: u32) -> Self {
        let mut hasher = XxHash64::with_seed(0);
        for vertex in scene.mesh.vertices() {
            hasher.write(vertex.map(f32::to_le_bytes).as_flattened());
        }
        for triangle in scene.mesh.triangles() {
            hasher.write(triangle.map(u32::to_le_bytes).as_flattened());
        }
        let camera = &scene.camera;
        for point in [camera.eye, camera.look_at, camera.up, scene.light] {
            hasher.write(point.map(f64::to_le_bytes).as_flattened());
        }
        hasher.write(format!("{:?}", camera.projection).as_bytes());
        Self { name: scene.name.clone(), resolution, hash: hasher.finish() }
    }

    fn path(&self, folder: &Path) -> PathBuf {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        let name: String = self.name.chars().map(plain).collect();
        folder.join(format!("{name}-{}-{:016x}.rays", self.resolution, self.hash))
    }
}

/// Writes the rays under their key.
pub(super) fn write(folder: &Path, key: &Key, sets: &RaySets) -> Result<(), BenchError> {
    let path = key.path(folder);
    let fail = |error| BenchError::io(&path, error);
    fs::create_dir_all(folder).map_err(fail)?;
    let mut file = tempfile::NamedTempFile::new_in(folder).map_err(fail)?;
    let mut bytes = encode(key, sets);
    bytes.extend(checksum(&bytes).to_le_bytes());
    file.write_all(&bytes).map_err(fail)?;
    file.persist(&path).map_err(|error| fail(error.error))?;
    Ok(())
}

/// The rays of that key, if there is a file with them.
pub(super) fn read(folder: &Path, key: &Key) -> Option<RaySets> {
    let bytes = fs::read(key.path(folder)).ok()?;
    let (content, sum) = bytes.split_last_chunk::<8>()?;
    (u64::from_le_bytes(*sum) == checksum(content)).then(|| decode(key, content))?
}

fn checksum(bytes: &[u8]) -> u64 {
    XxHash64::oneshot(0, bytes)
}

fn encode(key: &Key, sets: &RaySets) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    bytes.extend(key.hash.to_le_bytes());
    bytes.extend(sets.resolution.to_le_bytes());
    for set in &sets.sets {
        bytes.extend((set.rays.len() as u64).to_le_bytes());
        for Ray { origin, direction, t_max } in &set.rays {
            let numbers = origin.iter().chain(direction).chain([t_max]);
            numbers.for_each(|x| bytes.extend(x.to_le_bytes()));
        }
        set.parents.iter().for_each(|parent| bytes.extend(parent.to_le_bytes()));
    }
    bytes
}

fn decode(key: &Key, bytes: &[u8]) -> Option<RaySets> {
    let mut rest = Rest(bytes);
    let fits = rest.take()? == MAGIC && rest.take()? == key.hash.to_le_bytes();
    if !fits || rest.u32()? != key.resolution {
        return None;
    }
    let set = |rest: &mut Rest<'_>, kind| {
        let count = usize::try_from(u64::from_le_bytes(rest.take()?)).ok()?;
        let rays: Option<Vec<Ray>> = (0..count).map(|_| rest.ray()).collect();
        let parents = if kind == SetKind::Primary { 0 } else { count };
        let parents: Option<Vec<u32>> = (0..parents).map(|_| rest.u32()).collect();
        Some(RaySet { kind, rays: rays?, parents: parents? })
    };
    let [a, b, c, d, e] = SetKind::ALL.map(|kind| set(&mut rest, kind));
    let sets = [a?, b?, c?, d?, e?];
    rest.0.is_empty().then_some(RaySets { resolution: key.resolution, sets })
}

/// What of a file is still to be read.
struct Rest<'a>(&'a [u8]);

impl Rest<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*first)
    }

    fn u32(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    fn point(&mut self) -> Option<[f32; 3]> {
        let mut next = || self.take().map(f32::from_le_bytes);
        Some([next()?, next()?, next()?])
    }

    fn ray(&mut self) -> Option<Ray> {
        let (origin, direction) = (self.point()?, self.point()?);
        Some(Ray { origin, direction, t_max: self.take().map(f32::from_le_bytes)? })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::terrain;
    use super::*;

    #[test]
    fn rays_come_back_as_they_went() {
        let (mut scene, _, sets) = terrain();
        let folder = tempfile::tempdir().unwrap();
        let key = Key::of(&scene, sets.resolution);
        assert!(read(folder.path(), &key).is_none());
        write(folder.path(), &key, &sets).unwrap();
        assert_eq!(read(folder.path(), &key), Some(sets));
        // Another light makes other rays.
        scene.light[0] += 1.0;
        assert!(read(folder.path(), &Key::of(&scene, 64)).is_none());
    }

    #[test]
    fn a_damaged_file_is_not_used() {
        let (scene, _, sets) = terrain();
        let folder = tempfile::tempdir().unwrap();
        let key = Key::of(&scene, sets.resolution);
        write(folder.path(), &key, &sets).unwrap();
        let path = key.path(folder.path());
        let whole = fs::read(&path).unwrap();
        let mut flipped = whole.clone();
        flipped[1000] ^= 1;
        for bad in [&flipped[..], &whole[..whole.len() - 1], &whole[..4], &[]] {
            fs::write(&path, bad).unwrap();
            assert!(read(folder.path(), &key).is_none());
        }
    }
}
