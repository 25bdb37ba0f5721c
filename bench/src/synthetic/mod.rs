//! Scenes made by code, so that anyone can run the bench.

mod hair;
mod hall;
mod terrain;

use crate::error::BenchError;
use crate::scene::BenchScene;
use kdray::TriangleMesh;
use kdray_scene::{Camera, Projection};

/// The names to choose from.
pub(crate) const NAMES: &str = "terrain-2m, terrain-10m (any terrain-N), hall, hair";

/// The scene of that name, if there is one.
pub(crate) fn scene(name: &str) -> Option<Result<BenchScene, BenchError>> {
    let (made, view) = match name {
        "hall" => (hall::hall(), hall::VIEW),
        "hair" => (hair::hair(), hair::VIEW),
        _ => (terrain::terrain(terrain_size(name)?), terrain::VIEW),
    };
    Some(view.scene(name, made))
}

/// The number of triangles in a name such as `terrain-2m` or `terrain-10k`.
fn terrain_size(name: &str) -> Option<u32> {
    let digits = name.strip_prefix("terrain-")?;
    let (digits, unit) = match digits.strip_suffix('m') {
        Some(digits) => (digits, 1_000_000),
        None => match digits.strip_suffix('k') {
            Some(digits) => (digits, 1000),
            None => (digits, 1),
        },
    };
    let size = digits.parse::<u32>().ok()?.checked_mul(unit)?;
    (2..=100_000_000).contains(&size).then_some(size)
}

/// Triangles in the making.
#[derive(Debug, Default)]
struct Mesh {
    vertices: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Adds a grid of `columns` x `rows` quadrilaterals, two triangles each, over the points that
    /// `point` gives for columns 0 to `columns` and rows 0 to `rows`.
    fn grid(&mut self, columns: u32, rows: u32, point: impl Fn(u32, u32) -> [f64; 3]) {
        let first = self.vertices.len() as u32;
        for row in 0..=rows {
            let points = (0..=columns).map(|column| point(column, row).map(|x| x as f32));
            self.vertices.extend(points);
        }
        let corner = |column, row| first + row * (columns + 1) + column;
        for row in 0..rows {
            for column in 0..columns {
                let (a, b) = (corner(column, row), corner(column + 1, row));
                let (c, d) = (corner(column + 1, row + 1), corner(column, row + 1));
                self.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
}

/// From where a scene is seen and lit.
struct FixedView {
    eye: [f64; 3],
    look_at: [f64; 3],
    up: [f64; 3],
    vfov_degrees: f64,
    light: [f64; 3],
}

impl FixedView {
    fn scene(&self, name: &str, made: Mesh) -> Result<BenchScene, BenchError> {
        let camera = Camera {
            name: name.to_owned(),
            eye: self.eye,
            look_at: self.look_at,
            up: self.up,
            projection: Projection::Perspective { vfov_degrees: self.vfov_degrees },
        };
        let mesh = TriangleMesh::new(made.vertices, made.triangles)?;
        Ok(BenchScene::new(name, mesh, camera, self.light))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_sizes() {
        assert_eq!(terrain_size("terrain-2m"), Some(2_000_000));
        assert_eq!(terrain_size("terrain-10k"), Some(10_000));
        assert_eq!(terrain_size("terrain-500"), Some(500));
        for bad in ["terrain-", "terrain-x", "terrain-0", "terrain-1000m", "dragon"] {
            assert_eq!(terrain_size(bad), None, "{bad}");
        }
    }

    #[test]
    fn scenes_have_the_stated_sizes() {
        for (name, triangles) in
            [("terrain-10k", 10_000), ("hall", hall::TRIANGLES), ("hair", hair::TRIANGLES)]
        {
            let scene = scene(name).unwrap().unwrap();
            assert_eq!(scene.mesh.triangles().len(), triangles as usize, "{name}");
            assert!(scene.diagonal > 0.1, "{name}");
        }
    }

    #[test]
    fn large_terrains_are_as_large_as_they_say() {
        for size in [30_000, 100_000, 300_000, 1_000_000, 2_000_000, 3_000_000, 10_000_000] {
            let [columns, rows] = terrain::cells(size);
            assert_eq!(2 * columns * rows, size);
            assert!(columns >= rows && columns < 2 * rows + 1, "{columns} x {rows}");
        }
    }
}
