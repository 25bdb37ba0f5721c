//! Saved trees: a [`Scene`](crate::Scene) as bytes, and back.
//!
//! # The format, version 1
//! All numbers are little-endian. A header of 256 bytes says how long the arrays are; they follow one
//! after the other, each from a multiple of 64 bytes on, with zeros between them:
//!
//! | array | an item | bytes |
//! |---|---|---:|
//! | vertices | three coordinates, f32 or f64 as the header says | 12 or 24 |
//! | triangles | three indices of vertices | 12 |
//! | nodes of the canonical tree | split or first reference; axis or leaf, upper child or count | 8 |
//! | references | the id of a triangle | 4 |
//! | lines of the wide tree | part of a node of eight children, or of a block of eight triangles | 64 |
//! | homes | the cell of a wide node, the node above it, and where it lies | 32 |
//! | above | the home above each block | 4 |
//!
//! The last three are empty if the scene has no wide tree. The arrays are what queries work on, so that
//! a file in memory need not be unpacked. The same mesh and options give the same bytes, on any number
//! of threads.
//!
//! # What is checked when
//! | | [`open`](crate::Scene::open) | [`load`](crate::Scene::load), [`verify`](crate::Scene::verify) |
//! |---|---|---|
//! | header: magic, version, its checksum, the scene's precision, sizes that fit the file | yes | yes |
//! | structure: whatever an index, a link or a loop relies on | yes | yes |
//! | vertices that triangles use are finite | yes | yes |
//! | the checksum of all bytes (XXH3, 64 bits) | no | yes |
//! | the canonical tree: every invariant of [`KdTree::validate`](crate::KdTree::validate) | no | yes |
//! | the wide tree: that it is one of the canonical tree and the mesh | no | yes |
//!
//! So a file that was damaged by accident is refused by `load`. A file that was *made* to deceive, with
//! checksums that are right, can do no more than give wrong answers after `open`: queries neither panic
//! nor hang, and ids of hits are those of triangles. After `load` or `verify` it gives the hits of the
//! mesh that it holds, but for what `KdTree::validate` allows for rounding: a file whose maker knows it
//! may leave out parts of triangles that reach less than two units in the last place, or 2^-38 of the
//! largest coordinate, into a cell. Whether the mesh is the one that you expect, only a signature could
//! tell.
//!
//! Nothing is allocated by what a file says of itself before that is found to be so.

mod any_scene;
mod error;
mod header;
mod read;
mod sections;
mod write;

pub use any_scene::AnyScene;
pub use error::FileError;
pub use header::{HEADER_BYTES, check_precision, coordinate_bits, file_bytes, is_tree_file};

use twox_hash::XxHash3_64;

/// The checksum of a header, and of what follows it.
fn checksum(bytes: &[u8]) -> u64 {
    XxHash3_64::oneshot(bytes)
}
