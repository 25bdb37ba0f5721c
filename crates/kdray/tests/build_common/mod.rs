//! Inputs that the tests of the build share.

#![allow(dead_code, reason = "each test file uses some of them")]

use kdray::build::SahBuilder;
use kdray::primitives::{Balls, Segments};
use kdray::{BuildOptions, Preset, Strategy, TriangleMesh};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// For each strategy its good settings, and the hardest: a leaf size of one, which is good for SAH.
/// The presets, and what they are made of at its hardest.
pub(crate) fn all_options() -> Vec<BuildOptions> {
    Strategy::ALL
        .into_iter()
        .map(BuildOptions::for_strategy)
        .flat_map(|options| match options.strategy {
            Strategy::Sah => vec![options],
            _ => vec![options, BuildOptions { leaf_size: 1, ..options }],
        })
        .chain(Preset::ALL.map(BuildOptions::preset))
        .chain([binned_deep(), BuildOptions { prune: true, ..binned_deep() }])
        .collect()
}

/// Bins down to leaves of one primitive.
pub(crate) fn binned_deep() -> BuildOptions {
    let sah_builder = SahBuilder::Binned { sweep_below: 0 };
    BuildOptions { sah_builder, ..BuildOptions::for_strategy(Strategy::Sah) }
}

type Soup = Vec<[[f32; 3]; 3]>;

/// Triangles of any size up to `size` in a unit cube. With `snapped`, corners lie on a grid of
/// eighths, so that bounds coincide, many triangles are flat and some are lines or points.
pub(crate) fn random_soup(count: usize, size: f32, snapped: bool, seed: u64) -> Soup {
    let mut random = Pcg64::seed_from_u64(seed);
    let snap = |x: f32| if snapped { (x * 8.0).round() / 8.0 } else { x };
    (0..count)
        .map(|_| {
            let center = [0; 3].map(|_| random.random::<f32>());
            [0; 3].map(|_| center.map(|x| snap(x + size * (random.random::<f32>() - 0.5))))
        })
        .collect()
}

/// A flat floor of `side`² squares.
fn floor(side: u32, z: f32) -> Soup {
    let squares = (0..side).flat_map(|y| (0..side).map(move |x| (x as f32, y as f32)));
    squares
        .flat_map(|(x, y)| {
            let [a, b, c, d] =
                [[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]].map(|[x, y]| [x, y, z]);
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// Squares with a common centre in one plane.
fn concentric(count: u32) -> Soup {
    (1..=count)
        .flat_map(|r| {
            let r = r as f32;
            let [a, b, c, d] = [[-r, -r], [r, -r], [r, r], [-r, r]].map(|[x, y]| [x, 0.5, y]);
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

fn scaled(soup: Soup, scale: f32, offset: f32) -> Soup {
    soup.into_iter().map(|t| t.map(|p| p.map(|x| x * scale + offset))).collect()
}

/// Soups small enough for the naive builder, by name.
pub(crate) fn small_soups() -> Vec<(&'static str, Soup)> {
    let tetrahedron = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let [a, b, c, d] = tetrahedron;
    vec![
        ("nothing", vec![]),
        ("one triangle", vec![[a, b, c]]),
        ("tetrahedron", vec![[a, b, c], [a, b, d], [a, c, d], [b, c, d]]),
        ("small triangles", random_soup(300, 0.1, false, 1)),
        ("large triangles", random_soup(120, 1.0, false, 2)),
        ("snapped triangles", random_soup(300, 0.5, true, 3)),
        ("tiny snapped triangles", random_soup(300, 0.2, true, 4)),
        ("floor", floor(10, 1.0)),
        ("stack of floors", (0..4).flat_map(|z| floor(5, z as f32)).collect()),
        ("floor at negative zero", floor(4, -0.0).into_iter().chain(floor(4, 0.0)).collect()),
        ("concentric squares", concentric(40)),
        ("identical triangles", vec![[a, b, d]; 100]),
        ("identical points", vec![[b; 3]; 50]),
        ("points in a line", (0..50).map(|x| [[x as f32, 0.0, 0.0]; 3]).collect()),
        ("huge", scaled(random_soup(100, 0.3, false, 5), 1e38, 0.0)),
        ("denormal", scaled(random_soup(100, 0.3, false, 6), 1e-42, 0.0)),
        ("far away", scaled(random_soup(200, 0.1, false, 7), 1.0, 1e6)),
        ("needles", {
            let shear = |p: [f32; 3]| [p[0] * 100.0, p[1] * 0.001 + p[0] * 30.0, p[2]];
            random_soup(100, 0.8, false, 8).into_iter().map(|t| t.map(shear)).collect()
        }),
    ]
}

pub(crate) fn mesh(soup: Soup) -> TriangleMesh {
    TriangleMesh::from_soup(soup).unwrap()
}

/// Segments in the plane, by name.
pub(crate) fn small_plans() -> Vec<(&'static str, Segments)> {
    let mut random = Pcg64::seed_from_u64(9);
    let mut segments = |count: usize, size: f32, grid: f32| {
        let snap = |x: f32| if grid > 0.0 { (x / grid).round() * grid } else { x };
        let ends = (0..count).map(|_| {
            let center = [0; 2].map(|_| random.random::<f32>());
            [0; 2].map(|_| center.map(|x| snap(x + size * (random.random::<f32>() - 0.5))))
        });
        Segments::new(ends.collect()).unwrap()
    };
    vec![
        ("short", segments(200, 0.1, 0.0)),
        ("long", segments(100, 1.5, 0.0)),
        ("snapped", segments(200, 0.5, 0.125)),
    ]
}

/// Spheres, whose clipped bounds are the default of the trait.
pub(crate) fn balls(count: usize) -> Balls<3> {
    let mut random = Pcg64::seed_from_u64(10);
    let ball = |_| ([0; 3].map(|_| random.random::<f32>()), 0.1 * random.random::<f32>());
    Balls::new((0..count).map(ball).collect()).unwrap()
}
