//! A primitive as a node sees it.

use super::BuildError;
use super::parallel::map_range;
use crate::geometry::Aabb;
use crate::primitives::Primitives;

/// A primitive and the bounds of its part in the node's cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reference<const K: usize> {
    pub(super) id: u32,
    pub(super) bounds: Aabb<K>,
}

impl<const K: usize> Reference<K> {
    pub(super) fn new(id: u32, bounds: Aabb<K>) -> Self {
        // Adding zero makes positive zeros of negative ones, so that equal bounds have equal bits.
        let zeros = |p: [f32; K]| p.map(|x| x + 0.0);
        Self { id, bounds: Aabb { min: zeros(bounds.min), max: zeros(bounds.max) } }
    }

    /// The reference to a part of this one that lies in `bounds` and in `cell`, if both share
    /// anything with its own bounds: all three boxes hold the part. Bounds never grow on the way
    /// down.
    pub(super) fn part(&self, bounds: Option<Aabb<K>>, cell: &Aabb<K>) -> Option<Self> {
        let bounds = bounds?.intersection(&self.bounds).intersection(cell);
        (!bounds.is_empty()).then(|| Self::new(self.id, bounds))
    }

    /// References to all primitives that are somewhere, by rising id.
    pub(super) fn to_all(primitives: &impl Primitives<K>) -> Result<Vec<Self>, BuildError> {
        let mut references =
            map_range(primitives.count() as u32, |id| Self::new(id, primitives.bounds(id)));
        let finite = |bounds: &Aabb<K>| bounds.min.iter().chain(&bounds.max).all(|x| x.is_finite());
        match references.iter().find(|reference| !finite(&reference.bounds)) {
            Some(bad) => Err(BuildError::NonFiniteBounds(bad.id)),
            None => {
                references.retain(|reference| !reference.bounds.is_empty());
                Ok(references)
            }
        }
    }
}

/// Sorts the references from `first` on by id, and makes one of those to the same primitive.
pub(super) fn merge_parts<const K: usize>(references: &mut Vec<Reference<K>>, first: usize) {
    references[first..].sort_by_key(|reference| reference.id);
    let mut end = first;
    for next in first..references.len() {
        let part = references[next];
        if end > first && references[end - 1].id == part.id {
            references[end - 1].bounds = references[end - 1].bounds.union(&part.bounds);
        } else {
            references[end] = part;
            end += 1;
        }
    }
    references.truncate(end);
}
