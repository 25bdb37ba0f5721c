//! Eight numbers at a time, on whatever instructions the processor has.
//!
//! The kernels are written once, over vectors of any set; an [`InstructionSet`] runs them compiled for
//! itself. The vectors are those of the crate `fearless_simd`, so nothing here is `unsafe`.

mod instruction_set;
mod lanes;

pub(crate) use instruction_set::Kernel;
pub use instruction_set::{InstructionSet, UnknownInstructionSet};
pub(crate) use lanes::{Lanes, Lists};
