//! Hits as arrays, one for each of their numbers.

use crate::cast::Found;
use crate::tree::Places;
use kdray::Side;
use kdray::primitives::HitArrays;
use numpy::{Element, IntoPyArray};
use pyo3::{Bound, IntoPyObject, PyAny, Python};
use std::ops::Range;

/// The id of nothing.
const NONE: i32 = -1;

/// The floats that answers are made of.
pub(crate) trait Real: Element + Copy + Send + Sync + Default {
    /// The nearest finite one to a finite number; infinities and NaN stay.
    fn of(number: f64) -> Self;
}

impl Real for f32 {
    fn of(number: f64) -> Self {
        let rounded = number as Self;
        if rounded.is_infinite() && number.is_finite() {
            return Self::MAX.copysign(rounded);
        }
        rounded
    }
}

impl Real for f64 {
    fn of(number: f64) -> Self {
        number
    }
}

/// The numbers of many hits.
#[derive(Debug, Default)]
pub(crate) struct Columns<F> {
    t: Vec<F>,
    u: Vec<F>,
    v: Vec<F>,
    primitive_id: Vec<i32>,
    is_front: Vec<bool>,
    /// Not there if all is one geometry.
    geometry_id: Option<Vec<i32>>,
    /// Not there without instances.
    instance_id: Option<Vec<i32>>,
}

/// The columns as Python has them.
#[derive(IntoPyObject)]
pub(crate) struct Arrays<'py>(
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
    Bound<'py, PyAny>,
    Option<Bound<'py, PyAny>>,
    Option<Bound<'py, PyAny>>,
);

/// Room for the hits of some of the rays.
#[derive(Debug)]
pub(crate) struct Part<'a, F> {
    /// Which rays they are.
    pub(crate) range: Range<usize>,
    places: &'a Places,
    t: &'a mut [F],
    u: &'a mut [F],
    v: &'a mut [F],
    primitive_id: &'a mut [i32],
    is_front: &'a mut [bool],
    geometry_id: Option<&'a mut [i32]>,
    instance_id: Option<&'a mut [i32]>,
}

impl<F: Real> Columns<F> {
    /// Room for a hit of each of so many rays, and for the ids that these places tell.
    pub(crate) fn of_rays(count: usize, places: &Places) -> Self {
        Self {
            t: vec![F::default(); count],
            u: vec![F::default(); count],
            v: vec![F::default(); count],
            primitive_id: vec![0; count],
            is_front: vec![false; count],
            geometry_id: places.are_many().then(|| vec![0; count]),
            instance_id: places.are_instances().then(|| vec![0; count]),
        }
    }

    /// No hits yet.
    pub(crate) fn new(places: &Places) -> Self {
        Self::of_rays(0, places)
    }

    pub(crate) fn len(&self) -> usize {
        self.t.len()
    }

    /// The same room in parts, each for `size` rays but the last.
    pub(crate) fn parts<'a>(&'a mut self, size: usize, places: &'a Places) -> Vec<Part<'a, F>> {
        let count = self.t.len();
        let mut geometries = self.geometry_id.as_mut().map(|ids| ids.chunks_mut(size));
        let mut instances = self.instance_id.as_mut().map(|ids| ids.chunks_mut(size));
        let floats =
            self.t.chunks_mut(size).zip(self.u.chunks_mut(size)).zip(self.v.chunks_mut(size));
        let others = self.primitive_id.chunks_mut(size).zip(self.is_front.chunks_mut(size));
        let parts = floats.zip(others).enumerate();
        let part = |(index, (((t, u), v), (primitive_id, is_front)))| Part {
            range: index * size..count.min((index + 1) * size),
            places,
            t,
            u,
            v,
            primitive_id,
            is_front,
            geometry_id: geometries.as_mut().and_then(Iterator::next),
            instance_id: instances.as_mut().and_then(Iterator::next),
        };
        parts.map(part).collect()
    }

    /// Adds a hit.
    pub(crate) fn push(&mut self, places: &Places, found: &Found) {
        let place = places.of(found);
        self.t.push(F::of(found.hit.t));
        self.u.push(F::of(found.hit.u));
        self.v.push(F::of(found.hit.v));
        self.primitive_id.push(place.primitive_id);
        self.is_front.push(found.hit.side == Side::Front);
        self.geometry_id.iter_mut().for_each(|ids| ids.push(place.geometry_id));
        self.instance_id.iter_mut().for_each(|ids| ids.push(place.instance_id));
    }

    /// Adds the hits of others.
    pub(crate) fn append(&mut self, others: &Self) {
        self.t.extend_from_slice(&others.t);
        self.u.extend_from_slice(&others.u);
        self.v.extend_from_slice(&others.v);
        self.primitive_id.extend_from_slice(&others.primitive_id);
        self.is_front.extend_from_slice(&others.is_front);
        append_ids(&mut self.geometry_id, &others.geometry_id);
        append_ids(&mut self.instance_id, &others.instance_id);
    }

    /// Gives back what is not needed of the room that grew.
    pub(crate) fn shrink(&mut self) {
        self.t.shrink_to_fit();
        self.u.shrink_to_fit();
        self.v.shrink_to_fit();
        self.primitive_id.shrink_to_fit();
        self.is_front.shrink_to_fit();
        self.geometry_id.iter_mut().for_each(Vec::shrink_to_fit);
        self.instance_id.iter_mut().for_each(Vec::shrink_to_fit);
    }

    /// Gives the columns to Python, without a copy.
    pub(crate) fn into_arrays(self, py: Python<'_>) -> Arrays<'_> {
        let ids = |ids: Vec<i32>| ids.into_pyarray(py).into_any();
        Arrays(
            self.t.into_pyarray(py).into_any(),
            self.u.into_pyarray(py).into_any(),
            self.v.into_pyarray(py).into_any(),
            ids(self.primitive_id),
            self.is_front.into_pyarray(py).into_any(),
            self.geometry_id.map(ids),
            self.instance_id.map(ids),
        )
    }
}

fn append_ids(ids: &mut Option<Vec<i32>>, others: &Option<Vec<i32>>) {
    if let (Some(ids), Some(others)) = (ids, others) {
        ids.extend_from_slice(others);
    }
}

impl<F: Real> Part<'_, F> {
    /// Keeps what each of the rays hit.
    pub(crate) fn set_each(&mut self, found: impl Iterator<Item = Option<Found>>) {
        found.enumerate().for_each(|(index, found)| self.set(index, found));
    }

    /// Keeps what the rays of a packet hit; `order` has the index of each in the part. Column by column, for one
    /// fits the first-level cache.
    pub(crate) fn set_packet(&mut self, order: &[u32], hits: &HitArrays) {
        if self.places.are_many() {
            let hit = |place| hits.get(place).map(Found::from);
            let indices = order.iter().enumerate();
            return indices.for_each(|(place, &index)| self.set(index as usize, hit(place)));
        }
        scatter(order, hits.t(), self.t, F::of);
        scatter(order, hits.u(), self.u, F::of);
        scatter(order, hits.v(), self.v, F::of);
        // The id of no hit becomes -1.
        scatter(order, hits.primitive_id(), self.primitive_id, |id| id as i32);
        scatter(order, hits.is_front(), self.is_front, |is_front| is_front);
    }

    /// Keeps what the ray of that index in the part hit. A ray that hits nothing has an infinite t, and ids
    /// of nothing.
    fn set(&mut self, index: usize, found: Option<Found>) {
        let Some(found) = found else {
            self.t[index] = F::of(f64::INFINITY);
            self.primitive_id[index] = NONE;
            self.set_ids(index, NONE, NONE);
            return;
        };
        let place = self.places.of(&found);
        self.t[index] = F::of(found.hit.t);
        self.u[index] = F::of(found.hit.u);
        self.v[index] = F::of(found.hit.v);
        self.primitive_id[index] = place.primitive_id;
        self.is_front[index] = found.hit.side == Side::Front;
        self.set_ids(index, place.geometry_id, place.instance_id);
    }

    fn set_ids(&mut self, index: usize, geometry_id: i32, instance_id: i32) {
        self.geometry_id.iter_mut().for_each(|ids| ids[index] = geometry_id);
        self.instance_id.iter_mut().for_each(|ids| ids[index] = instance_id);
    }
}

fn scatter<A: Copy, B>(order: &[u32], from: &[A], to: &mut [B], of: impl Fn(A) -> B) {
    order.iter().zip(from).for_each(|(&index, &number)| to[index as usize] = of(number));
}
