//! From a scene to bytes.

use super::header::{Header, bits_of};
use super::sections::{COUNT, Sections};
use crate::layout::{WideParts, WideTree};
use crate::query::{Precision, Scene};
use std::convert::Infallible;
use std::hash::Hasher;
use twox_hash::xxhash3_64::Hasher as Xxh3;

impl<T: Precision> Scene<T> {
    /// How many bytes the scene takes when it is saved.
    pub fn saved_bytes(&self) -> u64 {
        self.sections().file_bytes()
    }

    /// Gives `write` the scene's mesh and trees as the bytes of a tree file, in pieces, and stops at its
    /// first error. How hits are decided, and with which instructions, is not saved: that is a choice
    /// of each program.
    ///
    /// ```
    /// # use kdray::{BuildOptions, Ray, Scene, TriangleMesh, memory::AlignedBytes};
    /// # use std::sync::Arc;
    /// # let corners = vec![[0.0_f32, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];
    /// # let scene = Scene::build(TriangleMesh::new(corners, vec![[0, 1, 2]])?, &Default::default())?;
    /// let mut file = Vec::new();
    /// let kept = scene.save(|bytes| {
    ///     file.extend_from_slice(bytes);
    ///     Ok::<(), std::convert::Infallible>(())
    /// });
    /// assert!(kept.is_ok());
    /// let loaded = Scene::<f32>::load(Arc::new(AlignedBytes::from(&file[..])))?;
    /// let ray = Ray::new([0.25, 0.25, 0.0], [0.0, 0.0, 1.0]);
    /// assert_eq!(loaded.closest_hit(&ray), scene.closest_hit(&ray));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// That of `write`.
    pub fn save<E>(&self, mut write: impl FnMut(&[u8]) -> Result<(), E>) -> Result<(), E> {
        let header = Header {
            coordinate_bits: bits_of::<T>(),
            body_checksum: self.body_checksum(),
            counts: self.section_counts(),
            bounds: *self.tree().bounds(),
            has_wide: self.wide_tree().is_some(),
        };
        write(&header.to_bytes())?;
        self.write_body(write)
    }

    fn sections(&self) -> Sections {
        let sections = Sections::new(bits_of::<T>(), &self.section_counts());
        sections.expect("what is in memory fits a file")
    }

    fn wide_parts(&self) -> WideParts {
        self.wide_tree().map(WideTree::parts).unwrap_or_default()
    }

    fn section_counts(&self) -> [u64; COUNT] {
        let (mesh, tree, wide) = (self.mesh(), self.tree(), self.wide_parts());
        let lengths = [
            mesh.vertices().len(),
            mesh.triangles().len(),
            tree.nodes().len(),
            tree.references.len(),
            wide.lines.len(),
            wide.homes.len(),
            wide.above.len(),
        ];
        lengths.map(|length| length as u64)
    }

    fn body_checksum(&self) -> u64 {
        let mut hasher = Xxh3::new();
        let hashed = self.write_body(|bytes| {
            hasher.write(bytes);
            Ok::<(), Infallible>(())
        });
        hashed.map_or_else(|never| match never {}, |()| hasher.finish())
    }

    /// All that follows the header.
    fn write_body<E>(&self, mut write: impl FnMut(&[u8]) -> Result<(), E>) -> Result<(), E> {
        let (mesh, tree, wide) = (self.mesh(), self.tree(), self.wide_parts());
        let sections = self.sections();
        let mut gaps = sections.gaps();
        let mut fill = |write: &mut dyn FnMut(&[u8]) -> Result<(), E>| {
            let gap = gaps.next().map_or(0, |gap| gap.end - gap.start);
            write(&[0; 64][..gap as usize])
        };
        fill(&mut write)?;
        mesh.vertex_store().write(&mut write)?;
        fill(&mut write)?;
        mesh.triangle_store().write(&mut write)?;
        fill(&mut write)?;
        tree.nodes.write(&mut write)?;
        fill(&mut write)?;
        tree.references.write(&mut write)?;
        fill(&mut write)?;
        wide.lines.write(&mut write)?;
        fill(&mut write)?;
        wide.homes.write(&mut write)?;
        fill(&mut write)?;
        wide.above.write(&mut write)
    }
}
