//! What the coordinates of vertices are: f32 or f64.

use super::TreeSpace;
use crate::memory::Words;
use std::fmt::Debug;

/// A coordinate of a vertex: f32 or f64. Nothing else can be one.
///
/// Rays and hits are f64 for both, and a hit means the same: it is decided as if in real arithmetic
/// on the given numbers.
pub trait Coordinate: Sealed + Copy + Debug + Default + PartialOrd + Send + Sync + 'static {
    /// Whether trees hold these numbers as they are. Others are moved and scaled first, then rounded:
    /// see [`TreeSpace`].
    const FITS_TREE: bool;

    /// How far, in the tree's coordinates, a ray may pass a point there that it meets in the mesh. Zero for
    /// numbers that fit.
    const TREE_ERROR: f64;

    /// What tells numbers apart.
    #[doc(hidden)]
    type Bits: Ord + Copy + Send;

    /// The number's bits, those of the two zeros alike.
    #[doc(hidden)]
    fn bits(self) -> Self::Bits;

    /// The same number.
    fn to_f64(self) -> f64;

    /// The same number.
    fn from_f32(x: f32) -> Self;

    /// The number next to it.
    fn from_f64(x: f64) -> Self;

    /// An f32 that is not above `self − error`, if `self` is not far out of its range. The error of a
    /// number that fits is zero.
    fn below(self, error: f64) -> f32;

    /// An f32 that is not below `self + error`.
    fn above(self, error: f64) -> f32;
}

mod sealed {
    pub trait Sealed: bytemuck::Pod {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}
use sealed::Sealed;

impl<T: Coordinate> Words for [T; 3] {
    const WORD: usize = size_of::<T>();
}

impl Coordinate for f32 {
    const FITS_TREE: bool = true;
    const TREE_ERROR: f64 = 0.0;
    type Bits = u32;

    #[inline]
    fn bits(self) -> u32 {
        (self + 0.0).to_bits()
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }

    #[inline(always)]
    fn from_f32(x: f32) -> Self {
        x
    }

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x as f32
    }

    #[inline(always)]
    fn below(self, error: f64) -> f32 {
        debug_assert!(error == 0.0);
        self
    }

    #[inline(always)]
    fn above(self, error: f64) -> f32 {
        debug_assert!(error == 0.0);
        self
    }
}

impl Coordinate for f64 {
    const FITS_TREE: bool = false;
    const TREE_ERROR: f64 = TreeSpace::ERROR;
    type Bits = u64;

    #[inline]
    fn bits(self) -> u64 {
        (self + 0.0).to_bits()
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }

    #[inline(always)]
    fn from_f32(x: f32) -> Self {
        f64::from(x)
    }

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x
    }

    #[inline]
    fn below(self, error: f64) -> f32 {
        round_down(self - error)
    }

    #[inline]
    fn above(self, error: f64) -> f32 {
        round_up(self + error)
    }
}

/// The largest f32 that is not above x.
pub(super) fn round_down(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) > x { nearest.next_down() } else { nearest }
}

/// The smallest f32 that is not below x.
pub(super) fn round_up(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) < x { nearest.next_up() } else { nearest }
}
