//! Cameras and lights.

use super::Document;
use super::graph::PlacedNode;
use crate::cut::cut;
use crate::mesh::MeshBuilder;
use crate::{Camera, Cone, Light, Projection};
use ::gltf::json::extensions::scene::khr_lights_punctual::Type;
use ::gltf::json::validation::Checked;
use glam::DVec3;

/// Where a node stands, and which way its −z axis and its y axis point.
fn pose(node: &PlacedNode) -> Option<[DVec3; 3]> {
    let eye = node.transform.w_axis.truncate();
    let forward = node.transform.transform_vector3(DVec3::NEG_Z).try_normalize()?;
    let up = node.transform.transform_vector3(DVec3::Y).try_normalize()?;
    eye.is_finite().then_some([eye, forward, up])
}

/// Adds the camera of a node to the model. One without a view becomes a warning.
pub(super) fn add_camera(document: Document<'_>, node: &PlacedNode, builder: &mut MeshBuilder<'_>) {
    let json = &document.root.nodes[node.index];
    let Some(camera) = json.camera.and_then(|camera| document.root.get(camera)) else { return };
    let perspective = camera.perspective.as_ref().map(|perspective| Projection::Perspective {
        vfov_degrees: f64::from(perspective.yfov).to_degrees(),
    });
    let orthographic = camera.orthographic.as_ref().map(|orthographic| Projection::Orthographic {
        height: 2.0 * f64::from(orthographic.ymag).abs(),
    });
    let projection = perspective.or(orthographic).filter(|projection| match projection {
        Projection::Perspective { vfov_degrees } => *vfov_degrees > 0.0 && *vfov_degrees < 180.0,
        Projection::Orthographic { height } => *height > 0.0 && height.is_finite(),
    });
    let name = camera.name.clone().or(json.name.clone()).unwrap_or_default();
    let pose = pose(node).filter(|[_, forward, up]| forward.cross(*up).length() > 1e-9);
    let (Some(projection), Some([eye, forward, up])) = (projection, pose) else {
        let warning =
            format!("nodes[{}]: the camera {:?} has no view; left out", node.index, cut(&name));
        builder.warn_often("cameras without a view left out", warning);
        return;
    };
    let look_at = (eye + forward).to_array();
    let camera = Camera { name, eye: eye.to_array(), look_at, up: up.to_array(), projection };
    builder.model.cameras.push(camera);
}

/// Adds the light of a node (`KHR_lights_punctual`) to the model.
///
/// Its numbers stay as they are: a candela becomes 1 W/sr and a lux 1 W/m², so that a file made for
/// viewers with exposure 1 looks here as there. Division by 683 lm/W would be physics, and black.
pub(super) fn add_light(document: Document<'_>, node: &PlacedNode, builder: &mut MeshBuilder<'_>) {
    let root = document.root;
    let extensions = root.nodes[node.index].extensions.as_ref();
    let index = extensions.and_then(|extensions| extensions.khr_lights_punctual.as_ref());
    let lights = root.extensions.as_ref().and_then(|root| root.khr_lights_punctual.as_ref());
    let light = index.zip(lights).and_then(|(index, all)| all.lights.get(index.light.value()));
    let Some(light) = light else { return };
    let power = light.color.map(|channel| (channel * light.intensity).max(0.0));
    let Checked::Valid(kind) = light.type_ else { return };
    let pose = pose(node).filter(|_| power.iter().all(|channel| channel.is_finite()));
    let Some([position, forward, _]) = pose else {
        let warning = format!("nodes[{}]: a light without direction left out", node.index);
        builder.warn_often("lights without direction left out", warning);
        return;
    };
    let (position, direction) = (position.to_array(), forward.to_array());
    let cone = light.spot.as_ref().filter(|_| kind == Type::Spot).map(|spot| {
        let outer_angle = spot.outer_cone_angle.clamp(0.0, std::f32::consts::FRAC_PI_2);
        Cone { direction, inner_angle: spot.inner_cone_angle.clamp(0.0, outer_angle), outer_angle }
    });
    builder.model.lights.push(match kind {
        Type::Directional => Light::Directional { direction, irradiance: power },
        Type::Point | Type::Spot => Light::Point { position, intensity: power, cone },
    });
}
