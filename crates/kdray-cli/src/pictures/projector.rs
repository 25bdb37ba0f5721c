//! From points in the world to points of a picture: the camera's rays backwards.

use glam::DVec3;
use kdray_scene::{Camera, Projection};

/// A camera, for drawing lines over what it sees.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projector {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    /// Pixels per unit: at distance 1 if `perspective`.
    scale: f64,
    size: [f64; 2],
    perspective: bool,
}

impl Projector {
    /// The camera for a picture of `size` pixels. The camera must be one that can be rendered.
    pub(crate) fn new(camera: &Camera, size: [f64; 2]) -> Self {
        let eye = DVec3::from(camera.eye);
        let forward = (DVec3::from(camera.look_at) - eye).normalize_or(-DVec3::Z);
        let right = forward.cross(camera.up.into()).normalize_or(DVec3::X);
        let (half_height, perspective) = match camera.projection {
            Projection::Perspective { vfov_degrees } => {
                ((vfov_degrees.to_radians() / 2.0).tan(), true)
            }
            Projection::Orthographic { height } => (height / 2.0, false),
        };
        let scale = size[1] / 2.0 / half_height;
        Self { eye, right, up: right.cross(forward), forward, scale, size, perspective }
    }

    /// The part of a straight line that lies before the camera, at least `near` away from it.
    pub(crate) fn clip(&self, [a, b]: [DVec3; 2], near: f64) -> Option<[DVec3; 2]> {
        if !self.perspective {
            return Some([a, b]);
        }
        let depth = |p: DVec3| (p - self.eye).dot(self.forward) - near;
        let (da, db) = (depth(a), depth(b));
        let cut = || a + (b - a) * (da / (da - db));
        match (da >= 0.0, db >= 0.0) {
            (true, true) => Some([a, b]),
            (true, false) => Some([a, cut()]),
            (false, true) => Some([cut(), b]),
            (false, false) => None,
        }
    }

    /// Where a point before the camera appears, in pixels from the upper left corner.
    pub(crate) fn place(&self, p: DVec3) -> [f64; 2] {
        let from_eye = p - self.eye;
        let scale =
            if self.perspective { self.scale / from_eye.dot(self.forward) } else { self.scale };
        [
            self.size[0] / 2.0 + from_eye.dot(self.right) * scale,
            self.size[1] / 2.0 - from_eye.dot(self.up) * scale,
        ]
    }

    /// The point of a line before the camera that appears `share` of the way between its ends'
    /// places.
    pub(crate) fn unproject(&self, [a, b]: [DVec3; 2], share: f64) -> DVec3 {
        if !self.perspective {
            return a.lerp(b, share);
        }
        // 1 / depth is linear in the picture, and so is (share on the line) / depth.
        let (da, db) = ((a - self.eye).dot(self.forward), (b - self.eye).dot(self.forward));
        let weight = share / db;
        a.lerp(b, weight / (weight + (1.0 - share) / da))
    }

    /// From where the camera sees `p`: the eye, or for parallel rays the point `reach` before it.
    pub(crate) fn viewpoint(&self, p: DVec3, reach: f64) -> DVec3 {
        if self.perspective { self.eye } else { p - self.forward * reach }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kdray_render::View;

    #[test]
    fn points_on_a_pixels_ray_fall_on_the_pixel() {
        let size = [300.0, 200.0];
        for projection in [
            Projection::Perspective { vfov_degrees: 50.0 },
            Projection::Orthographic { height: 7.0 },
        ] {
            let camera = Camera {
                name: String::new(),
                eye: [1.0, 2.0, 3.0],
                look_at: [-2.0, 0.5, -4.0],
                up: [0.1, 1.0, 0.0],
                projection,
            };
            let view = View::new(&camera, size[0] / size[1]).unwrap();
            let projector = Projector::new(&camera, size);
            for (x, y) in [(0.5, 0.5), (0.1, 0.9), (0.8, 0.2)] {
                let found = projector.place(DVec3::from(view.ray(x, y).at(5.0)));
                let expected = [x * size[0], y * size[1]];
                assert!((0..2).all(|k| (found[k] - expected[k]).abs() < 1e-9), "{projection:?}");
            }
        }
    }

    #[test]
    fn the_middle_of_a_drawn_line_is_found_on_the_line() {
        let camera = Camera {
            name: String::new(),
            eye: [0.0; 3],
            look_at: [0.0, 0.0, -1.0],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective { vfov_degrees: 60.0 },
        };
        let projector = Projector::new(&camera, [100.0, 100.0]);
        let line = [DVec3::new(-1.0, 0.5, -2.0), DVec3::new(3.0, -1.0, -9.0)];
        let [[x0, y0], [x1, y1]] = line.map(|p| projector.place(p));
        let [x, y] = projector.place(projector.unproject(line, 0.25));
        assert!((x - (0.75 * x0 + 0.25 * x1)).abs() < 1e-9);
        assert!((y - (0.75 * y0 + 0.25 * y1)).abs() < 1e-9);
    }

    #[test]
    fn lines_end_before_the_camera() {
        let camera = Camera {
            name: String::new(),
            eye: [0.0; 3],
            look_at: [0.0, 0.0, -1.0],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective { vfov_degrees: 90.0 },
        };
        let projector = Projector::new(&camera, [10.0, 10.0]);
        let (behind, ahead) = (DVec3::new(0.0, 0.0, 1.0), DVec3::new(0.0, 0.0, -1.0));
        let clipped = projector.clip([behind, ahead], 0.5).unwrap();
        assert_eq!(clipped, [DVec3::new(0.0, 0.0, -0.5), ahead]);
        assert_eq!(projector.clip([behind, behind], 0.5), None);
    }
}
