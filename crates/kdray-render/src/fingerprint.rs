//! A number that tells pictures apart by what they are of, so that parts of different ones are not
//! put together.

use crate::options::RenderOptions;
use crate::world::World;
use kdray::TriangleMesh;
use kdray_scene::{Camera, Light, Model};
use std::hash::Hasher;
use twox_hash::xxhash3_64::Hasher as Xxh3;

/// Levels of a texture's values: what another machine's powers round otherwise is the same.
const LEVELS: f32 = 4096.0;

/// Pixels of a texture that are looked at together.
const AT_ONCE: usize = 4096;

/// The hash of all that a picture depends on, but for what its file says in words: its size, samples,
/// seed and kind, and which part of it is rendered.
pub(crate) fn of_picture(
    world: &World,
    camera: &Camera,
    lights: &[Light],
    options: &RenderOptions,
) -> u64 {
    let spoken_of = RenderOptions::default();
    let options = RenderOptions {
        width: spoken_of.width,
        height: spoken_of.height,
        samples: spoken_of.samples,
        picture: spoken_of.picture,
        packets: spoken_of.packets,
        all_layers: spoken_of.all_layers,
        seed: spoken_of.seed,
        crop: None,
        sample_range: None,
        exposure: spoken_of.exposure,
        heat_max: None,
        ..options.clone()
    };
    let camera = Camera { name: String::new(), ..camera.clone() };
    let mut hasher = Xxh3::new();
    hasher.write_u64(world.fingerprint());
    hasher.write(env!("CARGO_PKG_VERSION").as_bytes());
    hasher.write(format!("{camera:?} {lights:?} {options:?}").as_bytes());
    hasher.finish()
}

/// The hash of a mesh and what its triangles look like.
pub(crate) fn of_model(mesh: &TriangleMesh, model: &Model) -> u64 {
    let mut hasher = Xxh3::new();
    let mut list = |bytes: &[u8]| {
        hasher.write_usize(bytes.len());
        hasher.write(bytes);
    };
    list(bytemuck::cast_slice(mesh.vertices()));
    list(bytemuck::cast_slice(mesh.triangles()));
    list(bytemuck::cast_slice(model.normals.as_flattened()));
    list(bytemuck::cast_slice(model.uvs.as_flattened()));
    list(bytemuck::cast_slice(model.colors.as_flattened()));
    list(bytemuck::cast_slice(&model.material_ids));
    list(format!("{:.5?}", model.materials).as_bytes());
    for texture in &model.textures {
        list(format!("{} {} {:?}", texture.width, texture.height, texture.wrap).as_bytes());
        for pixels in texture.pixels.chunks(AT_ONCE) {
            let levels = pixels.as_flattened().iter().map(|value| (value * LEVELS).round() as i32);
            list(bytemuck::cast_slice(&levels.collect::<Vec<_>>()));
        }
    }
    hasher.finish()
}
