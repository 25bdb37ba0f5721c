//! Saved scenes, and forged ones.

#![allow(dead_code, reason = "no test file uses all of it")]

use kdray::memory::{AlignedBytes, SharedBytes};
use kdray::{BuildOptions, Precision, Scene, TriangleMesh};
use rand::{RngExt, SeedableRng};
use std::convert::Infallible;
use std::ops::Range;
use std::sync::Arc;
use twox_hash::XxHash3_64;

pub(crate) fn soup(count: usize) -> TriangleMesh {
    let mut random = rand_pcg::Pcg64::seed_from_u64(1);
    let triangles = (0..count).map(|_| {
        let center = [0; 3].map(|_| random.random::<f32>());
        [0; 3].map(|_| center.map(|x| x + 0.1 * random.random::<f32>()))
    });
    TriangleMesh::from_soup(triangles).expect("finite corners")
}

/// The same in f64, each number as it comes out.
pub(crate) fn soup_in_f64(count: usize, vertex: impl Fn(f64) -> f64) -> TriangleMesh<f64> {
    let mesh = soup(count);
    let vertices = mesh.vertices().iter().map(|p| p.map(|x| vertex(x.into()))).collect();
    TriangleMesh::new(vertices, mesh.triangles().to_vec()).expect("finite corners")
}

pub(crate) fn saved<T: Precision>(scene: &Scene<T>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let written = scene.save(|piece| {
        bytes.extend_from_slice(piece);
        Ok::<(), Infallible>(())
    });
    written.expect("memory is written without errors");
    assert_eq!(bytes.len() as u64, scene.saved_bytes());
    bytes
}

pub(crate) fn shared(bytes: &[u8]) -> SharedBytes {
    Arc::new(AlignedBytes::from(bytes))
}

/// The arrays of a file, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Section {
    Vertices,
    Triangles,
    Nodes,
    References,
    Lines,
    Homes,
    Above,
}

impl Section {
    pub(crate) const ALL: [Self; 7] = [
        Self::Vertices,
        Self::Triangles,
        Self::Nodes,
        Self::References,
        Self::Lines,
        Self::Homes,
        Self::Above,
    ];

    /// How many bytes an item has, with coordinates of so many.
    fn item_bytes(self, coordinate: usize) -> usize {
        [3 * coordinate, 12, 8, 4, 64, 32, 4][self as usize]
    }
}

/// A file whose checksums are right whatever is changed.
#[derive(Clone)]
pub(crate) struct Forgery {
    pub(crate) bytes: Vec<u8>,
}

impl Forgery {
    pub(crate) fn of(count: usize) -> Self {
        Self::of_mesh(soup(count))
    }

    pub(crate) fn of_mesh<T: Precision>(mesh: TriangleMesh<T>) -> Self {
        let scene = Scene::build(mesh, &BuildOptions::default()).expect("a small mesh");
        Self { bytes: saved(&scene) }
    }

    /// How many bytes a coordinate has.
    fn coordinate(&self) -> usize {
        u32::from_le_bytes(self.bytes[12..16].try_into().expect("four bytes")) as usize / 8
    }

    pub(crate) fn count(&self, section: Section) -> u64 {
        let place = 24 + 8 * section as usize;
        u64::from_le_bytes(self.bytes[place..place + 8].try_into().expect("eight bytes"))
    }

    pub(crate) fn set_count(&mut self, section: Section, count: u64) {
        let place = 24 + 8 * section as usize;
        self.bytes[place..place + 8].copy_from_slice(&count.to_le_bytes());
    }

    /// Where an array lies.
    pub(crate) fn range(&self, section: Section) -> Range<usize> {
        let mut end: usize = 256;
        let mut range = 0..0;
        for other in &Section::ALL[..=section as usize] {
            let start = end.next_multiple_of(64);
            end = start + self.count(*other) as usize * other.item_bytes(self.coordinate());
            range = start..end;
        }
        range
    }

    /// A number of an array, in words of four bytes from its begin.
    pub(crate) fn word(&self, section: Section, index: usize) -> u32 {
        let place = self.range(section).start + 4 * index;
        u32::from_le_bytes(self.bytes[place..place + 4].try_into().expect("four bytes"))
    }

    #[must_use]
    pub(crate) fn with_word(mut self, section: Section, index: usize, word: u32) -> Self {
        let place = self.range(section).start + 4 * index;
        self.bytes[place..place + 4].copy_from_slice(&word.to_le_bytes());
        self
    }

    #[must_use]
    pub(crate) fn with_float(self, section: Section, index: usize, x: f32) -> Self {
        self.with_word(section, index, x.to_bits())
    }

    /// How many words an array has.
    pub(crate) fn words(&self, section: Section) -> usize {
        self.range(section).len() / 4
    }

    /// The file with checksums that are right.
    pub(crate) fn sealed(&self) -> SharedBytes {
        let mut bytes = self.bytes.clone();
        let body = XxHash3_64::oneshot(&bytes[256..]);
        bytes[16..24].copy_from_slice(&body.to_le_bytes());
        let header = XxHash3_64::oneshot(&bytes[..248]);
        bytes[248..256].copy_from_slice(&header.to_le_bytes());
        shared(&bytes)
    }
}
