//! The public face: a scene that answers queries.

mod scene;

pub use scene::Scene;
