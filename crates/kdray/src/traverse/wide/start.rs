//! Rays of a batch, with or without hints.

use crate::geometry::Ray;
use crate::layout::Hint;
use std::borrow::Borrow;

/// A ray, and where its search begins.
pub(crate) trait Start {
    /// Whether there are hints.
    const NEAR: bool;

    fn ray(&self) -> &Ray<3>;

    fn hint(&self) -> Hint;
}

/// A ray with a hint.
pub(crate) struct Near<R>(pub(crate) R, pub(crate) Hint);

impl<R: Borrow<Ray<3>>> Start for R {
    const NEAR: bool = false;

    #[inline(always)]
    fn ray(&self) -> &Ray<3> {
        self.borrow()
    }

    #[inline(always)]
    fn hint(&self) -> Hint {
        Hint::NONE
    }
}

impl<R: Borrow<Ray<3>>> Start for Near<R> {
    const NEAR: bool = true;

    #[inline(always)]
    fn ray(&self) -> &Ray<3> {
        self.0.borrow()
    }

    #[inline(always)]
    fn hint(&self) -> Hint {
        self.1
    }
}
