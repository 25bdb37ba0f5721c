//! What the tests share: an oracle in rational arithmetic, meshes and rays that are hard on
//! purpose, the scenes beside the checkout, and a fast answer without a tree.

#![forbid(unsafe_code)]

pub mod agree;
pub mod attack;
pub mod bits;
pub mod bundles;
pub mod closed;
pub mod command_line;
pub mod flat;
pub mod fuzz;
pub mod meshes;
pub mod oracle;
pub mod owned_packet;
pub mod packer;
pub mod parity;
pub mod peers;
pub mod points;
pub mod rays;
pub mod sets;
pub mod shared;
pub mod subject;

pub use owned_packet::OwnedPacket;
pub use packer::Packer;
pub use subject::Subject;
