//! How long a tree over a million triangles takes, by every strategy and preset:
//! `cargo run --release -p kdray --example build_million [terrain|soup] [TRIANGLES] [sah|fast|...]`,
//! under `/usr/bin/time -v` also the peak of memory. `RAYON_NUM_THREADS` sets the threads.

use kdray::{BuildOptions, KdTree, Preset, Strategy, TriangleMesh};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::error::Error;
use std::io::Write;
use std::time::Instant;

/// A fractal landscape: octaves of random heights, bilinearly interpolated, over a unit square that
/// is turned so that no plane runs along its rows.
fn terrain(triangles: usize) -> Result<TriangleMesh, Box<dyn Error>> {
    let side = (triangles as f64 / 2.0).sqrt() as u32;
    let mut random = Pcg64::seed_from_u64(1);
    let mut heights = vec![0.0_f32; (side as usize + 1).pow(2)];
    for octave in 1..=8 {
        let cells = 1_usize << octave;
        let grid: Vec<f32> = (0..(cells + 2).pow(2)).map(|_| random.random()).collect();
        for (index, height) in heights.iter_mut().enumerate() {
            let (x, y) = (index % (side as usize + 1), index / (side as usize + 1));
            let at = |i: usize| i as f32 * cells as f32 / side as f32;
            let (column, row) = (at(x) as usize, at(y) as usize);
            let (u, v) = (at(x) - column as f32, at(y) - row as f32);
            let corner = |i: usize, j: usize| grid[(row + j) * (cells + 2) + column + i];
            let lower = corner(0, 0) * (1.0 - u) + corner(1, 0) * u;
            let upper = corner(0, 1) * (1.0 - u) + corner(1, 1) * u;
            *height += (lower * (1.0 - v) + upper * v) * 0.4 / cells as f32;
        }
    }
    let vertices = (0..).zip(&heights).map(|(i, &height)| {
        let [x, y] = [i % (side + 1), i / (side + 1)].map(|i| i as f32 / side as f32);
        [0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, height]
    });
    let squares = (0..side).flat_map(|y| (0..side).map(move |x| y * (side + 1) + x));
    let triangles =
        squares.flat_map(|a| [[a, a + 1, a + side + 2], [a, a + side + 2, a + side + 1]]);
    Ok(TriangleMesh::new(vertices.collect(), triangles.collect())?)
}

/// Triangles anywhere in the unit cube, about as large as a surface of as many would have.
fn soup(triangles: usize) -> Result<TriangleMesh, Box<dyn Error>> {
    let mut random = Pcg64::seed_from_u64(2);
    let size = 1.0 / (triangles as f32).sqrt();
    let corners = (0..triangles).map(|_| {
        let center = [0; 3].map(|_| random.random::<f32>());
        [0; 3].map(|_| center.map(|x| x + size * (random.random::<f32>() - 0.5)))
    });
    Ok(TriangleMesh::from_soup(corners)?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let kind = arguments.next().unwrap_or("terrain".to_owned());
    let triangles = arguments.next().map_or(Ok(1_000_000), |n| n.parse())?;
    let only = arguments.next();
    let mesh = if kind == "soup" { soup(triangles)? } else { terrain(triangles)? };
    let mut out = std::io::stdout().lock();
    let strategies = Strategy::ALL.map(|s| (s.name(), BuildOptions::for_strategy(s)));
    let presets = Preset::ALL.map(|preset| (preset.name(), BuildOptions::preset(preset)));
    let is_wanted = |name: &str| only.as_ref().is_none_or(|only| only == name);
    for (name, options) in strategies.into_iter().chain(presets) {
        if !is_wanted(name) {
            continue;
        }
        let start = Instant::now();
        let tree = KdTree::build(&mesh, &options)?;
        let seconds = start.elapsed().as_secs_f64();
        let stats = tree.stats(mesh.triangles().len(), &options.cost);
        writeln!(
            out,
            "{name}: {seconds:.2} s, {} triangles, {} nodes, depth {}, {:.2} references a \
             triangle, SAH cost {:.1}, {:.1} MB",
            stats.primitives,
            stats.nodes,
            stats.max_depth,
            stats.references_per_primitive,
            stats.sah_cost,
            stats.bytes as f64 / 1e6,
        )?;
    }
    Ok(())
}
