//! Where the large arrays of meshes and trees lie: in memory of their own, or in bytes that somebody
//! else holds, such as a file in memory.

mod aligned;
mod store;

pub use aligned::AlignedBytes;
pub(crate) use store::{Store, Words};

use std::sync::Arc;

/// Bytes with an owner, who keeps them as they are for as long as anything refers to them: a `Vec<u8>`,
/// [`AlignedBytes`], a memory-mapped file.
pub type SharedBytes = Arc<dyn AsRef<[u8]> + Send + Sync>;

/// Bytes that a scene lies in.
pub(crate) struct Source(pub(crate) SharedBytes);

/// For the reason given at [`Store`].
impl std::panic::UnwindSafe for Source {}
impl std::panic::RefUnwindSafe for Source {}

impl std::fmt::Debug for Source {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} bytes", (*self.0).as_ref().len())
    }
}
