//! Hits of many rays, side by side.

use super::{Hit, Side};

/// The hits of many rays: one array for each of their numbers. A ray without hit has the id
/// [`NO_HIT`](Self::NO_HIT) and an infinite t.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HitArrays {
    pub(crate) t: Vec<f64>,
    pub(crate) primitive_id: Vec<u32>,
    pub(crate) u: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) is_front: Vec<bool>,
}

impl HitArrays {
    /// The id of no primitive.
    pub const NO_HIT: u32 = u32::MAX;

    /// Of how many rays.
    pub fn len(&self) -> usize {
        self.t.len()
    }

    /// Whether they are of no rays.
    pub fn is_empty(&self) -> bool {
        self.t.is_empty()
    }

    /// Makes room for the hits of `len` rays.
    pub(crate) fn resize(&mut self, len: usize) {
        self.t.resize(len, f64::INFINITY);
        self.primitive_id.resize(len, Self::NO_HIT);
        self.u.resize(len, 0.0);
        self.v.resize(len, 0.0);
        self.is_front.resize(len, false);
    }

    pub(crate) fn set(&mut self, index: usize, hit: Option<Hit>) {
        let none =
            Hit { t: f64::INFINITY, primitive_id: Self::NO_HIT, u: 0.0, v: 0.0, side: Side::Back };
        let hit = hit.unwrap_or(none);
        self.t[index] = hit.t;
        self.primitive_id[index] = hit.primitive_id;
        self.u[index] = hit.u;
        self.v[index] = hit.v;
        self.is_front[index] = hit.side == Side::Front;
    }

    /// The hit of a ray.
    ///
    /// # Panics
    /// If there are not so many rays.
    pub fn get(&self, index: usize) -> Option<Hit> {
        let primitive_id = self.primitive_id[index];
        let side = if self.is_front[index] { Side::Front } else { Side::Back };
        let hit = Hit { t: self.t[index], primitive_id, u: self.u[index], v: self.v[index], side };
        (primitive_id != Self::NO_HIT).then_some(hit)
    }

    /// The rays' parameters; infinite where there is no hit.
    pub fn t(&self) -> &[f64] {
        &self.t
    }

    /// The primitives; [`NO_HIT`](Self::NO_HIT) where there is none.
    pub fn primitive_id(&self) -> &[u32] {
        &self.primitive_id
    }

    /// See [`Hit::u`]; zero where there is no hit.
    pub fn u(&self) -> &[f64] {
        &self.u
    }

    /// See [`Hit::v`]; zero where there is no hit.
    pub fn v(&self) -> &[f64] {
        &self.v
    }

    /// Whether the front was hit; false where nothing was.
    pub fn is_front(&self) -> &[bool] {
        &self.is_front
    }
}
