//! The picture at the top of the README.

use crate::{Camera, Light, Model, Projection};

/// The scene that is rendered when none is named: with its own camera and lights.
pub fn showcase() -> Model {
    let vertices = vec![[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.5, 0.0]];
    let camera = Camera {
        name: "showcase".into(),
        eye: [0.0, 1.0, 5.0],
        look_at: [0.0, 0.7, 0.0],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { vfov_degrees: 35.0 },
    };
    let light = Light::Directional { direction: [-0.4, -1.0, -0.6], irradiance: [2.5; 3] };
    Model {
        vertices,
        triangles: vec![[0, 1, 2]],
        cameras: vec![camera],
        lights: vec![light],
        ..Model::default()
    }
}
