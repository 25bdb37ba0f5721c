//! Room to work in.

use crate::pace::Pace;
use crate::packet::{self, Packet};
use kdray::geometry::Common;
use kdray::primitives::HitArrays;
use kdray::{Coordinate, Hit, Ray};
use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Room for the answers to a block of rays, from block to block.
#[derive(Debug, Default)]
pub(crate) struct Room {
    pace: Arc<Mutex<Pace>>,
    pub(crate) closest: Vec<Option<Hit>>,
    pub(crate) packet: Packet,
    pub(crate) of_packet: HitArrays,
    pub(crate) any: Vec<bool>,
    /// All hits of all rays, in the order in which rays were done.
    pub(crate) all: Vec<Hit>,
    /// Where those of each ray are.
    pub(crate) places: Vec<Range<usize>>,
}

impl Room {
    /// Room of another thread of the same call.
    pub(crate) fn beside(&self) -> Self {
        Self { pace: Arc::clone(&self.pace), ..Self::default() }
    }

    /// What the rays share, if they are to go in packets. There are none for f64 meshes.
    pub(crate) fn common<T: Coordinate>(&self, rays: &[Ray]) -> Option<Common> {
        let common = if T::FITS_TREE { packet::common(rays) } else { None };
        common.filter(|_| self.pace().take_turn())
    }

    pub(crate) fn pace(&self) -> MutexGuard<'_, Pace> {
        self.pace.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
