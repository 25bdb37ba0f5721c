//! Looking up a texture.

use glam::{Vec3, Vec4};
use kdray_scene::{Texture, TextureRef, Wrap};

/// The texture's linear RGBA at the coordinates (u, v), from its four nearest pixels.
pub(crate) fn sample(textures: &[Texture], reference: &TextureRef, uv: [f32; 2]) -> Vec4 {
    let texture = &textures[reference.texture];
    let [u, v] = reference.transform.map(|row| Vec3::from(row).dot(Vec3::new(uv[0], uv[1], 1.0)));
    // Pixel i has its middle at i + 0.5.
    let (x, y) = (u * texture.width as f32 - 0.5, v * texture.height as f32 - 0.5);
    let (left, upper) = (x.floor(), y.floor());
    let pixel = |dx: f32, dy: f32| {
        let column = wrapped(left + dx, texture.width, texture.wrap[0]);
        let row = wrapped(upper + dy, texture.height, texture.wrap[1]);
        Vec4::from(texture.pixels[row * texture.width + column])
    };
    let (x, y) = (x - left, y - upper);
    let above = pixel(0.0, 0.0).lerp(pixel(1.0, 0.0), x);
    let below = pixel(0.0, 1.0).lerp(pixel(1.0, 1.0), x);
    let color = above.lerp(below, y);
    if color.is_finite() { color } else { pixel(0.0, 0.0) }
}

/// The index from 0 to `size` − 1 that stands for the pixel at `position`.
fn wrapped(position: f32, size: usize, wrap: Wrap) -> usize {
    // A cast of NaN gives 0, one of infinity the largest number.
    let (position, size) = (position as i64, size as i64);
    let index = match wrap {
        Wrap::Repeat => position.rem_euclid(size),
        Wrap::Mirror => {
            let index = position.rem_euclid(2 * size);
            index.min(2 * size - 1 - index)
        }
        Wrap::Clamp => position.clamp(0, size - 1),
    };
    index as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lookup(wrap: Wrap, transform: [[f32; 3]; 2], uv: [f32; 2]) -> f32 {
        let pixels = [0.0, 1.0, 2.0, 3.0].map(|x| [x, 0.0, 0.0, 1.0]).to_vec();
        let texture = Texture { width: 2, height: 2, pixels, wrap: [wrap; 2] };
        sample(&[texture], &TextureRef { texture: 0, transform }, uv).x
    }

    #[test]
    fn pixels_are_met_at_their_middles_and_blended_between() {
        let at = |u, v| lookup(Wrap::Clamp, TextureRef::IDENTITY, [u, v]);
        assert_eq!([at(0.25, 0.25), at(0.75, 0.25), at(0.25, 0.75)], [0.0, 1.0, 2.0]);
        assert_eq!(at(0.5, 0.5), 1.5);
        assert_eq!(at(0.5, 0.25), 0.5);
    }

    #[test]
    fn each_wrap_has_its_own_beyond() {
        let beyond = |wrap| lookup(wrap, TextureRef::IDENTITY, [1.25, 0.25]);
        assert_eq!([Wrap::Repeat, Wrap::Mirror, Wrap::Clamp].map(beyond), [0.0, 1.0, 1.0]);
        assert_eq!(lookup(Wrap::Repeat, TextureRef::IDENTITY, [-0.25, -0.25]), 3.0);
    }

    #[test]
    fn the_transform_comes_first() {
        assert_eq!(lookup(Wrap::Repeat, [[1.0, 0.0, 0.5], [0.0, 1.0, 0.0]], [0.25, 0.25]), 1.0);
    }

    #[test]
    fn strange_coordinates_give_a_color() {
        for uv in [[f32::NAN, 0.0], [f32::INFINITY, 1e38], [-1e38, f32::NEG_INFINITY]] {
            for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
                assert!(lookup(wrap, TextureRef::IDENTITY, uv).is_finite());
            }
        }
    }
}
