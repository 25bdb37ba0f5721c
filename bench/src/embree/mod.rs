//! Embree 4, behind safe functions. All `unsafe` of the workspace is in this folder.
//!
//! The library is not linked but opened at run time, from the PyPI package that bundles it: whoever
//! does not compare needs neither.
#![expect(unsafe_code, reason = "a C library is called")]

mod collect;
mod ffi;
mod library;
mod scene;
mod wheel;

pub(crate) use library::Embree;
pub(crate) use scene::{Packet, Scene, SingleRay};

/// How a scene is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quality {
    /// `RTC_BUILD_QUALITY_MEDIUM`, the default: binned SAH.
    Medium,
    /// `RTC_BUILD_QUALITY_HIGH`: with spatial splits.
    High,
    /// Medium, with `RTC_SCENE_FLAG_ROBUST`: boxes and edges are tested more carefully.
    Robust,
}

/// What is said of the rays of a packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Hint {
    /// Nothing.
    Incoherent,
    /// `RTC_RAY_QUERY_FLAG_COHERENT`.
    Coherent,
}
