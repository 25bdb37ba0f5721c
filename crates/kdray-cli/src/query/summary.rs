//! What became of the rays, for the user.

use super::Answer;
use kdray::{Ray, RayError};

/// Counts of what became of the rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Summary {
    /// All rays.
    pub(crate) rays: u64,
    /// Rays with a hit.
    pub(crate) hitting: u64,
    /// Rays that could not be traced, and count as misses.
    pub(crate) untraceable: u64,
    /// The first of these, and why.
    first: Option<(u64, RayError)>,
}

impl Summary {
    /// Counts a ray and its answer.
    pub(crate) fn add(&mut self, ray: &Ray, answer: &Answer) {
        if let Err(error) = ray.check() {
            self.untraceable += 1;
            self.first.get_or_insert((self.rays, error));
        }
        self.rays += 1;
        self.hitting += u64::from(match answer {
            Answer::Closest(hit) => hit.is_some(),
            Answer::Any(occluded) => *occluded,
            Answer::All(hits) => !hits.is_empty(),
            Answer::Count(count) => *count > 0,
        });
    }

    /// A sentence on rays that could not be traced, if there were any.
    pub(crate) fn warning(&self) -> Option<String> {
        let (ray, error) = self.first?;
        let (count, rays) = (self.untraceable, self.rays);
        Some(format!(
            "{count} of {rays} rays cannot be traced and count as misses; ray {ray}: {error}"
        ))
    }
}
