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
