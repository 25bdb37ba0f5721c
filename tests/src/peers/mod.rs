//! The same rays put to kdray and to others (`cargo xtask attack --peers`).
//!
//! [`cases`] makes closed meshes and rays of which f32 has every number, [`files`] writes them and reads
//! what the others answer, [`judge`] counts what is wrong, and [`table`] tells it. Others are asked by the
//! bench and by a program in Python.

pub mod cases;
pub mod files;
pub mod judge;
pub mod table;
