//! What is shot at.

use super::Extent;
use crate::Subject;
use crate::closed::{is_closed, vertices_and_edges};
use kdray::{Coordinate, TriangleMesh};

/// A mesh and where it can be aimed at.
#[derive(Clone, Debug)]
pub struct Target<T: 'static = f32> {
    /// What it is called in tables.
    pub name: String,
    /// The mesh.
    pub mesh: TriangleMesh<T>,
    /// Its box.
    pub extent: Extent,
    /// Whether every ray without end from outside crosses it an even number of times.
    pub is_closed: bool,
    /// The vertices that triangles use.
    pub vertices: Vec<u32>,
    /// The pairs of them that are edges.
    pub edges: Vec<(u32, u32)>,
    /// The number of its first volley. Targets begin at others, so that few volleys at each are of all kinds
    /// together, at trees of all settings.
    pub first: u64,
}

/// A target of either precision.
#[derive(Clone, Debug)]
pub enum AnyTarget {
    /// Of f32 vertices.
    Single(Target<f32>),
    /// Of f64 vertices.
    Double(Target<f64>),
}

impl<T: Coordinate> Target<T> {
    /// A mesh by that name.
    pub fn new(name: impl Into<String>, mesh: TriangleMesh<T>) -> Self {
        let (vertices, edges) = vertices_and_edges(&mesh);
        let (extent, is_closed) = (Extent::of(&mesh), is_closed(&mesh));
        Self { name: name.into(), mesh, extent, is_closed, vertices, edges, first: 0 }
    }

    /// A number next to x that has few digits: see [`Subject::rounded`].
    pub fn rounded(&self, x: f64) -> f64 {
        TriangleMesh::<T>::rounded(x, self.extent.largest())
    }

    /// A corner of it.
    pub fn vertex(&self, index: u32) -> [f64; 3] {
        self.mesh.vertices()[index as usize].map(T::to_f64)
    }
}

impl AnyTarget {
    /// The same, with another first volley.
    #[must_use]
    pub fn beginning_at(mut self, number: u64) -> Self {
        match &mut self {
            Self::Single(target) => target.first = number,
            Self::Double(target) => target.first = number,
        }
        self
    }

    /// The number of its first volley.
    pub fn first(&self) -> u64 {
        match self {
            Self::Single(target) => target.first,
            Self::Double(target) => target.first,
        }
    }

    /// What it is called.
    pub fn name(&self) -> &str {
        match self {
            Self::Single(target) => &target.name,
            Self::Double(target) => &target.name,
        }
    }

    /// Of what its vertices are: `f32` or `f64`.
    pub fn precision(&self) -> &'static str {
        match self {
            Self::Single(_) => "f32",
            Self::Double(_) => "f64",
        }
    }

    /// How many triangles it has.
    pub fn triangles(&self) -> usize {
        match self {
            Self::Single(target) => target.mesh.triangles().len(),
            Self::Double(target) => target.mesh.triangles().len(),
        }
    }

    /// Whether it is closed.
    pub fn is_closed(&self) -> bool {
        match self {
            Self::Single(target) => target.is_closed,
            Self::Double(target) => target.is_closed,
        }
    }
}

impl From<Target<f32>> for AnyTarget {
    fn from(target: Target<f32>) -> Self {
        Self::Single(target)
    }
}

impl From<Target<f64>> for AnyTarget {
    fn from(target: Target<f64>) -> Self {
        Self::Double(target)
    }
}
