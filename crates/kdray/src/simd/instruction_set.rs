//! Which instructions a kernel is run with.

use super::Lanes;
use fearless_simd::{Fallback, Level};
use std::fmt;
use thiserror::Error;

/// A set of vector instructions that this processor has, and for which the kernels are compiled.
///
/// Every set gives the same hits, to the last bit; they differ in speed only. Those of
/// [`Arithmetic::Float`](crate::Arithmetic::Float) may differ in their last digits, and in what grazes an edge.
/// [`InstructionSet::best`] is what a scene takes by itself.
#[derive(Clone, Copy, Debug)]
pub struct InstructionSet(Token);

/// Proof that the processor has the instructions.
#[derive(Clone, Copy, Debug)]
enum Token {
    Portable(Fallback),
    #[cfg(target_arch = "aarch64")]
    Neon(fearless_simd::aarch64::Neon),
    #[cfg(target_arch = "x86_64")]
    Avx2(fearless_simd::x86::Avx2),
    #[cfg(target_arch = "x86_64")]
    Avx512(fearless_simd::x86::Avx512),
}

/// A name that no instruction set of this processor has.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("this processor has no instruction set called {0:?}; it has {1}")]
pub struct UnknownInstructionSet(pub String, pub String);

/// Something to run, compiled anew for each instruction set. Implementations and all that they
/// call must be `#[inline(always)]`, or the compiler does not know the instructions there.
pub(crate) trait Kernel {
    /// What comes of it.
    type Output;

    /// Runs it.
    fn run<S: Lanes>(self, simd: S) -> Self::Output;
}

impl InstructionSet {
    /// Plain Rust, on every processor.
    pub const PORTABLE: Self = Self(Token::Portable(Fallback::new()));

    /// All sets that this processor has, the best last.
    pub fn available() -> Vec<Self> {
        let level = Level::new();
        let mut sets = vec![Self::PORTABLE];
        #[cfg(target_arch = "aarch64")]
        sets.extend(level.as_neon().map(|neon| Self(Token::Neon(neon))));
        #[cfg(target_arch = "x86_64")]
        sets.extend(level.as_avx2().map(|avx2| Self(Token::Avx2(avx2))));
        #[cfg(target_arch = "x86_64")]
        sets.extend(level.as_avx512().map(|avx512| Self(Token::Avx512(avx512))));
        sets
    }

    /// The best set that this processor has.
    pub fn best() -> Self {
        Self::available().pop().unwrap_or(Self::PORTABLE)
    }

    /// The set of a name.
    ///
    /// # Errors
    /// If this processor does not have it.
    pub fn of_name(name: &str) -> Result<Self, UnknownInstructionSet> {
        let sets = Self::available();
        let names = || sets.iter().map(|set| set.name()).collect::<Vec<_>>().join(", ");
        let found = sets.iter().find(|set| set.name() == name);
        found.copied().ok_or_else(|| UnknownInstructionSet(name.to_owned(), names()))
    }

    /// The name that it has on the command line and in tables.
    pub fn name(self) -> &'static str {
        match self.0 {
            Token::Portable(_) => "portable",
            #[cfg(target_arch = "aarch64")]
            Token::Neon(_) => "neon",
            #[cfg(target_arch = "x86_64")]
            Token::Avx2(_) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Token::Avx512(_) => "avx512",
        }
    }

    /// Runs `kernel` compiled for this set.
    #[inline(always)]
    pub(crate) fn run<K: Kernel>(self, kernel: K) -> K::Output {
        match self.0 {
            Token::Portable(simd) => compiled_for(simd, kernel),
            #[cfg(target_arch = "aarch64")]
            Token::Neon(simd) => compiled_for(simd, kernel),
            #[cfg(target_arch = "x86_64")]
            Token::Avx2(simd) => compiled_for(simd, kernel),
            #[cfg(target_arch = "x86_64")]
            Token::Avx512(simd) => compiled_for(simd, kernel),
        }
    }
}

#[inline(always)]
fn compiled_for<S: Lanes, K: Kernel>(simd: S, kernel: K) -> K::Output {
    simd.vectorize(
        #[inline(always)]
        || kernel.run(simd),
    )
}

impl PartialEq for InstructionSet {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Eq for InstructionSet {}

impl fmt::Display for InstructionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_find_the_sets_of_this_processor() {
        for set in InstructionSet::available() {
            assert_eq!(InstructionSet::of_name(set.name()), Ok(set));
        }
        let unknown = InstructionSet::of_name("abacus").unwrap_err();
        assert!(unknown.to_string().contains("portable"), "{unknown}");
    }
}
