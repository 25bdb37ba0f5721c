//! The part of the Python package `kdray` that is compiled: the module `kdray._kdray`.
//!
//! The package's own files, in `python/kdray`, are what users see. They make all numbers arrays of f32 or f64
//! of one shape, and name what comes back; this module reads those arrays where they lie, lets go of the
//! interpreter, and asks the library on threads of its own. `_kdray.pyi` tells its interface.

#![forbid(unsafe_code)]

mod all_hits;
mod any_hit;
mod block;
mod build;
mod cast;
mod closest_hit;
mod closest_point;
mod columns;
mod error;
mod files;
mod job;
mod mesh;
mod order;
mod pace;
mod packet;
mod picture;
mod point_queries;
mod points;
mod pool;
mod rays;
mod render;
mod room;
mod rows;
mod stats;
mod surface;
mod tree;

/// What `kdray` has compiled. Use the package `kdray` itself.
#[pyo3::pymodule]
mod _kdray {
    #[pymodule_export]
    use crate::files::{
        Look, file_hash, is_tree_file, load_tree, map_tree, read_mesh, save_tree, tree_hash,
        write_file,
    };
    #[pymodule_export]
    use crate::mesh::Mesh;
    #[pymodule_export]
    use crate::picture::Picture;
    #[pymodule_export]
    use crate::point_queries::{
        closest_point, contains, signed_distance, thickness, visible, winding_number,
    };
    #[pymodule_export]
    use crate::render::{World, render};
    #[pymodule_export]
    use crate::stats::stats;
    #[pymodule_export]
    use crate::tree::Tree;
}
