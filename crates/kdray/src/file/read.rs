//! From bytes to a scene.

use super::header::{HEADER_BYTES, Header};
use super::sections::Sections;
use super::{FileError, checksum};
use crate::layout::{WideParts, WideTree};
use crate::memory::{SharedBytes, Store};
use crate::primitives::TriangleMesh;
use crate::query::{Precision, Scene};
use crate::tree::KdTree;

impl<T: Precision> Scene<T> {
    /// The scene of a saved file, all of which is verified, as [`crate::file`] says. Its coordinates must be
    /// of this precision; [`AnyScene`](super::AnyScene) takes either.
    ///
    /// # Errors
    /// See [`FileError`].
    pub fn load(bytes: SharedBytes) -> Result<Self, FileError> {
        // First, because damage is likelier than deceit, and says what to do.
        let (header, sections) = Header::read::<T>((*bytes).as_ref())?;
        verify_bytes((*bytes).as_ref(), &header, &sections)?;
        let scene = Self::open(bytes)?;
        scene.verify_trees()?;
        Ok(scene)
    }

    /// The scene of a saved file that you trust, without looking at all of it: header and structure
    /// are checked, as [`crate::file`] says, so that no query panics or hangs, whoever made the file.
    /// But that its hits are right, only [`verify`](Self::verify) makes sure.
    ///
    /// Where `bytes` begin at a multiple of 64, as files in memory do, nothing is copied: the scene
    /// refers to them for as long as it or a clone is there. They must not change.
    ///
    /// # Errors
    /// See [`FileError`].
    pub fn open(bytes: SharedBytes) -> Result<Self, FileError> {
        let (header, sections) = Header::read::<T>((*bytes).as_ref())?;
        let [vertices, triangles, nodes, references, lines, homes, above] =
            sections.ranges.map(|range| range.start as usize..range.end as usize);
        let mesh = TriangleMesh::of_stores(
            Store::in_bytes(&bytes, vertices),
            Store::in_bytes(&bytes, triangles),
        )?;
        let tree = KdTree {
            bounds: header.bounds,
            nodes: Store::in_bytes(&bytes, nodes),
            references: Store::in_bytes(&bytes, references),
        };
        let triangles = mesh.triangles().len();
        tree.check_structure(triangles)?;
        let parts = WideParts {
            lines: Store::in_bytes(&bytes, lines),
            homes: Store::in_bytes(&bytes, homes),
            above: Store::in_bytes(&bytes, above),
        };
        let wide = if header.has_wide {
            Some(WideTree::of_parts(parts, &tree, &mesh)?)
        } else if parts.is_empty() {
            None
        } else {
            return Err(FileError::BadHeader("there is no wide tree, but parts of one"));
        };
        Ok(Self::of_trees(mesh, tree, wide, Some(bytes)))
    }

    /// Makes sure that all answers are right: of a scene that was [opened](Self::open), the checksum of
    /// its file; of any scene that the canonical tree is valid, and the wide one that of the canonical
    /// one and the mesh. Takes about as long as a build.
    ///
    /// # Errors
    /// See [`FileError`].
    pub fn verify(&self) -> Result<(), FileError> {
        if let Some(bytes) = self.source() {
            let (header, sections) = Header::read::<T>(bytes)?;
            verify_bytes(bytes, &header, &sections)?;
        }
        self.verify_trees()
    }

    fn verify_trees(&self) -> Result<(), FileError> {
        T::verify_tree(self)?;
        Ok(T::verify_wide_tree(self)?)
    }
}

/// Checks what is not part of any array, and the checksum.
fn verify_bytes(bytes: &[u8], header: &Header, sections: &Sections) -> Result<(), FileError> {
    if checksum(&bytes[HEADER_BYTES..]) != header.body_checksum {
        return Err(FileError::Damaged);
    }
    let mut gaps = sections.gaps().map(|gap| &bytes[gap.start as usize..gap.end as usize]);
    if gaps.any(|gap| gap.iter().any(|&byte| byte != 0)) {
        return Err(FileError::BadHeader("what lies between the arrays is not zero"));
    }
    Ok(())
}
