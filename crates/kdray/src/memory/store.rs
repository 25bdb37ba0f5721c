//! An array that does not change any more, whoever owns its memory.

use super::SharedBytes;
use bytemuck::{Pod, bytes_of_mut, try_cast_slice};
use std::fmt::{Debug, Formatter};
use std::ops::{Deref, Range};
use std::panic::{RefUnwindSafe, UnwindSafe};
use std::sync::Arc;
use yoke::Yoke;

/// An array that does not change any more. To use it costs as much as a `Vec`: where it lies is looked
/// up once, when it is made. Clones share it.
pub(crate) struct Store<T: 'static>(Yoke<&'static [T], Arc<dyn Owner<T>>>);

/// What arrays in files are made of: numbers of so many bytes each.
pub(crate) trait Words: Pod + Send + Sync {
    /// How long a number is.
    const WORD: usize = 4;
}

impl Words for u32 {}
impl Words for [u32; 3] {}

/// Whoever owns the memory of an array.
trait Owner<T>: Send + Sync {
    fn items(&self) -> &[T];
}

impl<T: Send + Sync> Owner<T> for Vec<T> {
    fn items(&self) -> &[T] {
        self
    }
}

/// A part of bytes that somebody else owns.
struct Part {
    bytes: SharedBytes,
    range: Range<usize>,
}

impl Part {
    fn get(&self) -> &[u8] {
        let bytes: &[u8] = (*self.bytes).as_ref();
        bytes.get(self.range.clone()).unwrap_or_default()
    }
}

impl<T: Pod + Send + Sync> Owner<T> for Part {
    fn items(&self) -> &[T] {
        try_cast_slice(self.get()).unwrap_or_default()
    }
}

impl<T: Send + Sync> Store<T> {
    fn of_owner(owner: Arc<dyn Owner<T>>) -> Self {
        Self(Yoke::attach_to_cart(owner, |owner| owner.items()))
    }
}

impl<T: Words> Store<T> {
    /// The array that lies in a part of `bytes`, little-endian: in place, or as a copy where the part is
    /// not aligned, or the processor is big-endian. Of a part that is no whole number of items, or not
    /// within the bytes, nothing.
    pub(crate) fn in_bytes(bytes: &SharedBytes, range: Range<usize>) -> Self {
        let part = Part { bytes: bytes.clone(), range };
        if cfg!(target_endian = "little") && try_cast_slice::<u8, T>(part.get()).is_ok() {
            return Self::of_owner(Arc::new(part));
        }
        let whole = part.get().chunks_exact(size_of::<T>());
        let items = whole.map(|bytes| {
            let mut item = T::zeroed();
            bytes_of_mut(&mut item).copy_from_slice(bytes);
            to_little_endian(bytes_of_mut(&mut item), T::WORD);
            item
        });
        Self::from(items.collect::<Vec<T>>())
    }

    /// Gives `write` the array as little-endian bytes, in pieces.
    pub(crate) fn write<E>(&self, write: impl FnMut(&[u8]) -> Result<(), E>) -> Result<(), E> {
        write_little_endian(self, write)
    }
}

/// Gives `write` an array as little-endian bytes, in pieces.
fn write_little_endian<T: Words, E>(
    items: &[T],
    mut write: impl FnMut(&[u8]) -> Result<(), E>,
) -> Result<(), E> {
    const PIECE: usize = 1 << 12;
    items.chunks(PIECE).try_for_each(|piece| {
        let bytes = bytemuck::cast_slice(piece);
        if cfg!(target_endian = "little") {
            return write(bytes);
        }
        let mut bytes = bytes.to_vec();
        to_little_endian(&mut bytes, T::WORD);
        write(&bytes)
    })
}

/// Puts the bytes of numbers of `word` bytes into the other order, if this processor's is not little-endian.
fn to_little_endian(bytes: &mut [u8], word: usize) {
    if cfg!(target_endian = "big") {
        bytes.chunks_exact_mut(word).for_each(<[u8]>::reverse);
    }
}

#[cfg(test)]
impl<T: Clone + Send + Sync> Store<T> {
    /// Puts a changed copy in the place of the array.
    pub(crate) fn edit(&mut self, change: impl FnOnce(&mut Vec<T>)) {
        let mut items = self.to_vec();
        change(&mut items);
        *self = items.into();
    }
}

impl<T> Deref for Store<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        self.0.get()
    }
}

impl<T: Send + Sync> From<Vec<T>> for Store<T> {
    fn from(items: Vec<T>) -> Self {
        Self::of_owner(Arc::new(items))
    }
}

impl<T: Send + Sync> FromIterator<T> for Store<T> {
    fn from_iter<I: IntoIterator<Item = T>>(items: I) -> Self {
        Self::from(items.into_iter().collect::<Vec<T>>())
    }
}

impl<T: Send + Sync> Default for Store<T> {
    fn default() -> Self {
        Self::from(Vec::new())
    }
}

impl<T> Clone for Store<T> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

/// How many items there are: a scene has millions.
impl<T> Debug for Store<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} items", self.len())
    }
}

/// What the owner has does not change, so a panic leaves nothing half done.
impl<T> UnwindSafe for Store<T> {}
impl<T> RefUnwindSafe for Store<T> {}

impl<T: PartialEq> PartialEq for Store<T> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

#[cfg(test)]
mod tests {
    use super::super::AlignedBytes;
    use super::*;

    impl Words for f32 {}

    fn shared(bytes: &[u8]) -> SharedBytes {
        Arc::new(AlignedBytes::from(bytes))
    }

    #[test]
    fn what_is_aligned_lies_where_it_lay() {
        let numbers = [1.5_f32, -2.0, 3.25, 0.0];
        let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        let owner = shared(&bytes);
        let store = Store::<f32>::in_bytes(&owner, 4..16);
        assert_eq!(&*store, &numbers[1..]);
        if cfg!(target_endian = "little") {
            assert_eq!(store.as_ptr().addr(), (*owner).as_ref().as_ptr().addr() + 4);
        }
        let clone = store.clone();
        drop((store, owner));
        assert_eq!(&*clone, &numbers[1..], "the clone keeps the bytes");
    }

    #[test]
    fn what_is_not_aligned_is_copied() {
        let owner = shared(&[9, 1, 0, 0, 0, 2, 0, 0, 0, 9]);
        let store = Store::<u32>::in_bytes(&owner, 1..9);
        assert_eq!(&*store, &[1, 2]);
        let mut written = Vec::new();
        let wrote: Result<(), ()> = store.write(|bytes| {
            written.extend_from_slice(bytes);
            Ok(())
        });
        assert_eq!((wrote, written), (Ok(()), vec![1, 0, 0, 0, 2, 0, 0, 0]));
        assert!(Store::<u32>::in_bytes(&owner, 4..99).is_empty(), "outside of the bytes");
    }
}
