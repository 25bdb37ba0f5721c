//! Meshes made in code: closed ones, and soups that are hard on purpose.

use crate::rays::random;
use kdray::{Coordinate, TriangleMesh};
use rand::RngExt;
use std::f64::consts::{PI, TAU};

/// Three corners a triangle, as [`TriangleMesh::from_soup`] takes them.
pub type Soup<T = f32> = Vec<[[T; 3]; 3]>;

/// A mesh of triangles that share no vertices.
///
/// # Panics
/// If a coordinate is not finite.
pub fn mesh<T: Coordinate>(soup: Soup<T>) -> TriangleMesh<T> {
    TriangleMesh::from_soup(soup).expect("test meshes are finite")
}

/// The same triangles in f64.
pub fn in_f64(soup: &Soup) -> Soup<f64> {
    soup.iter().map(|triangle| triangle.map(|p| p.map(f64::from))).collect()
}

/// The same mesh in f64, of the same vertices and triangles.
///
/// # Panics
/// Never: what was a mesh is one.
pub fn mesh_in_f64(mesh: &TriangleMesh) -> TriangleMesh<f64> {
    let vertices = mesh.vertices().iter().map(|p| p.map(f64::from)).collect();
    TriangleMesh::new(vertices, mesh.triangles().to_vec()).expect("it was a mesh before")
}

/// The same mesh with every vertex moved.
///
/// # Panics
/// If a coordinate is not finite.
pub fn moved<T: Coordinate>(
    mesh: &TriangleMesh,
    vertex: impl Fn([f64; 3]) -> [T; 3],
) -> TriangleMesh<T> {
    let vertices = mesh.vertices().iter().map(|p| vertex(p.map(f64::from))).collect();
    TriangleMesh::new(vertices, mesh.triangles().to_vec()).expect("test meshes are finite")
}

/// Triangles scaled and moved to another place, so that they need f64; of coordinates so short that
/// differences between them are not rounded.
pub fn placed(soup: &Soup, scale: f64, center: [f64; 3]) -> Soup<f64> {
    let largest = center.iter().fold(4.0 * scale, |most, x| x.abs().max(most));
    let place = |p: [f32; 3]| {
        std::array::from_fn(|k| snapped(f64::from(p[k]) * scale + center[k], largest))
    };
    soup.iter().map(|triangle| triangle.map(place)).collect()
}

/// The multiple next to x of 2^-40 of the power of two below `largest`.
pub fn snapped(x: f64, largest: f64) -> f64 {
    let step = f64::from_bits(largest.to_bits() & (0x7ff << 52)) / (1_u64 << 40) as f64;
    if step > 0.0 { (x / step).round() * step } else { x }
}

/// Triangles of about a fifth of `scale`, their corners within `scale` of `center`.
pub fn soup(count: usize, center: [f32; 3], scale: f32, seed: u64) -> Soup {
    let mut random = random(seed);
    let mut near = |p: [f32; 3], r: f32| p.map(|x| x + random.random_range(-1.0_f32..1.0) * r);
    let triangle = |_| {
        let middle = near(center, 0.8 * scale);
        [near(middle, 0.2 * scale), near(middle, 0.2 * scale), near(middle, 0.2 * scale)]
    };
    (0..count).map(triangle).collect()
}

/// `layers` parallel squares in the planes z = 0, 1, …, each of n x n cells of two triangles: many
/// triangles share each plane, edge line and vertex.
pub fn grid(n: usize, layers: usize) -> Soup {
    let mut soup = Soup::new();
    for (z, y, x) in cells([layers, n, n]) {
        let at = |i: usize, j: usize| [(x + i) as f32, (y + j) as f32, z as f32];
        soup.push([at(0, 0), at(1, 0), at(1, 1)]);
        soup.push([at(0, 0), at(1, 1), at(0, 1)]);
    }
    soup
}

fn cells([a, b, c]: [usize; 3]) -> impl Iterator<Item = (usize, usize, usize)> {
    (0..a).flat_map(move |i| (0..b).flat_map(move |j| (0..c).map(move |k| (i, j, k))))
}

/// n³ axis-aligned unit cubes side by side, so that inner walls stand twice.
pub fn boxes(n: usize) -> Soup {
    let mut soup = Soup::new();
    for (z, y, x) in cells([n, n, n]) {
        let corner = |bits: usize| {
            [(x + (bits & 1)) as f32, (y + (bits >> 1 & 1)) as f32, (z + (bits >> 2)) as f32]
        };
        for [a, b, c, d] in
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        {
            soup.push([corner(a), corner(b), corner(c)]);
            soup.push([corner(a), corner(c), corner(d)]);
        }
    }
    soup
}

/// Triangles a million times as long as wide, some along an axis.
pub fn needles(count: usize, seed: u64) -> Soup {
    let mut random = random(seed);
    let needle = |i: usize| {
        let mut point = || [0; 3].map(|_| random.random_range(-1.0_f32..1.0));
        let (a, mut b, c) = (point(), point(), point());
        if i.is_multiple_of(4) {
            b = [a[0], a[1], b[2]];
        }
        [a, b, std::array::from_fn(|k| b[k] + 1e-6 * c[k])]
    };
    (0..count).map(needle).collect()
}

/// Points, lines, and slivers that are no triangles only after rounding, among proper triangles,
/// most of which stand twice or more.
pub fn degenerate(seed: u64) -> Soup {
    let mut soup = soup(60, [0.0; 3], 1.0, seed);
    for i in 0..20 {
        let [a, b, c] = soup[i];
        let middle = std::array::from_fn(|k| 0.5 * (a[k] + b[k]));
        soup.extend([[a, a, a], [a, b, a], [a, middle, b], [b, c, b], [a, b, c], [a, b, c]]);
        soup.push([c, b, a]);
    }
    soup
}

/// A closed sphere of radius 1 around the origin: `rings` from pole to pole of `2·rings` segments.
pub fn sphere(rings: usize) -> TriangleMesh {
    let segments = 2 * rings;
    let mut vertices = vec![[0.0, 0.0, 1.0]];
    for ring in 1..rings {
        let polar = PI * ring as f64 / rings as f64;
        vertices.extend((0..segments).map(|segment| {
            let around = TAU * segment as f64 / segments as f64;
            let (x, y) = (polar.sin() * around.cos(), polar.sin() * around.sin());
            [x as f32, y as f32, polar.cos() as f32]
        }));
    }
    vertices.push([0.0, 0.0, -1.0]);
    let south = vertices.len() as u32 - 1;
    let at = |ring: usize, segment: usize| match ring {
        0 => 0,
        _ if ring == rings => south,
        _ => (1 + (ring - 1) * segments + segment % segments) as u32,
    };
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for segment in 0..segments {
            let [a, b] = [at(ring, segment), at(ring, segment + 1)];
            let [c, d] = [at(ring + 1, segment), at(ring + 1, segment + 1)];
            triangles.extend((ring > 0).then_some([a, c, b]));
            triangles.extend((ring + 1 < rings).then_some([b, c, d]));
        }
    }
    TriangleMesh::new(vertices, triangles).expect("a sphere is finite")
}

/// The radius of the circle in the middle of the [`torus`] tube.
pub const TORUS_RADIUS: f64 = 1.0;

/// A closed torus around the z axis whose tube has the radius 0.4: `major` x `minor` cells.
pub fn torus(major: usize, minor: usize) -> TriangleMesh {
    let angle = |i: usize, n: usize| TAU * i as f64 / n as f64;
    let vertex = |i: usize, j: usize| {
        let (around, across) = (angle(i, major), angle(j, minor));
        let radius = TORUS_RADIUS + 0.4 * across.cos();
        [radius * around.cos(), radius * around.sin(), 0.4 * across.sin()].map(|x| x as f32)
    };
    let grid = (0..major).flat_map(|i| (0..minor).map(move |j| (i, j)));
    let vertices = grid.clone().map(|(i, j)| vertex(i, j)).collect();
    let at = |i: usize, j: usize| (i % major * minor + j % minor) as u32;
    let cell = |(i, j): (usize, usize)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let triangles = grid.flat_map(cell).collect();
    TriangleMesh::new(vertices, triangles).expect("a torus is finite")
}

/// A closed cube from 0 to 1 whose sides are cut into n x n cells of two triangles.
pub fn cube(n: usize) -> TriangleMesh {
    let mut soup = Soup::new();
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        for (axis, end) in [(0, 0.0), (1, 0.0), (2, 0.0), (0, 1.0), (1, 1.0), (2, 1.0)] {
            let at = |i: usize, j: usize| {
                let mut p = [end; 3];
                p[(axis + 1) % 3] = i as f32 / n as f32;
                p[(axis + 2) % 3] = j as f32 / n as f32;
                p
            };
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            soup.extend(if end == 1.0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] });
        }
    }
    mesh(soup)
}

/// A closed [`sphere`] with a spike of that height on every triangle.
pub fn spikes(rings: usize, height: f32) -> TriangleMesh {
    let sphere = sphere(rings);
    let mut soup = Soup::new();
    for id in 0..sphere.triangles().len() as u32 {
        let [a, b, c] = sphere.corners(id);
        let tip = std::array::from_fn(|k| height * (a[k] + b[k] + c[k]));
        soup.extend([[a, b, tip], [b, c, tip], [c, a, tip]]);
    }
    mesh(soup)
}

/// A flat [`grid`] and its back in the same place: closed, around nothing.
pub fn pillow(n: usize) -> TriangleMesh {
    let front = grid(n, 1);
    let back = front.iter().map(|&[a, b, c]| [a, c, b]);
    mesh(front.iter().copied().chain(back).collect())
}

/// A closed spindle from −1 to 1 along x, of that thickness: `sides` needles meet at each of its ends.
pub fn spindle(sides: usize, thickness: f64) -> TriangleMesh {
    let rim = |i: usize| {
        let angle = TAU * (i % sides) as f64 / sides as f64;
        [0.0, thickness * angle.cos(), thickness * angle.sin()].map(|x| x as f32)
    };
    let side = |i: usize| {
        let (a, b) = (rim(i), rim(i + 1));
        [[[1.0, 0.0, 0.0], a, b], [[-1.0, 0.0, 0.0], b, a]]
    };
    mesh((0..sides).flat_map(side).collect())
}
