//! K = 2: what can be seen from a point in a floor plan. The same tree and traversal as in space,
//! over segments.
//!
//! `cargo run --release -p kdray --example plan_2d`

use kdray::primitives::Segments;
use kdray::{BuildOptions, Ray, ShapeScene, Strategy};
use std::io::{self, Write};

/// The rooms of a flat, 16 m by 8 m, with doors left open.
const WALLS: [[[f32; 2]; 2]; 12] = [
    // Outside.
    [[0.0, 0.0], [16.0, 0.0]],
    [[16.0, 0.0], [16.0, 8.0]],
    [[16.0, 8.0], [0.0, 8.0]],
    [[0.0, 8.0], [0.0, 0.0]],
    // Between the two rooms on the left and the corridor, with a door each.
    [[0.0, 5.0], [3.0, 5.0]],
    [[4.0, 5.0], [8.0, 5.0]],
    [[9.0, 5.0], [10.0, 5.0]],
    [[5.0, 5.0], [5.0, 0.0]],
    // The room on the right.
    [[10.0, 5.0], [10.0, 3.0]],
    [[10.0, 2.0], [10.0, 0.0]],
    [[10.0, 5.0], [12.0, 6.0]],
    // A column, seen as a slanted screen.
    [[13.0, 3.0], [14.0, 4.0]],
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = ShapeScene::build(
        Segments::new(WALLS.to_vec())?,
        &BuildOptions::for_strategy(Strategy::Sah),
    )?;
    let mut out = io::stdout().lock();
    let observer = [7.0, 2.25];
    writeln!(out, "What is seen (.) from E, and what is not (blank):")?;
    for row in 0..24 {
        let y = 8.0 - (f64::from(row) + 0.5) / 3.0;
        let line: String = (0..64).map(|column| symbol(&scene, observer, column, y)).collect();
        writeln!(out, "{}", line.trim_end())?;
    }

    writeln!(out, "\nAround the compass from E = {observer:?}:")?;
    for (name, direction) in [
        ("east", [1.0, 0.0]),
        ("north-east", [1.0, 1.0]),
        ("north", [0.0, 1.0]),
        ("west", [-1.0, 0.0]),
        ("south", [0.0, -1.0]),
    ] {
        let ray = Ray::new(observer, direction);
        let walls = scene.count(&ray);
        let hit = scene.closest_hit(&ray).ok_or("the flat is closed")?;
        let [x, y] = ray.at(hit.t);
        writeln!(
            out,
            "  {name:10} wall {:2} at t = {:.3}, ({x:.2}, {y:.2}); {walls} walls to the outside",
            hit.primitive_id, hit.t
        )?;
    }
    Ok(())
}

/// What stands in the plan at a place: a wall, the observer, a place that is seen, or one that is
/// not, since some wall lies between.
fn symbol(scene: &ShapeScene<Segments, 2>, observer: [f64; 2], column: i32, y: f64) -> char {
    let x = (f64::from(column) + 0.5) / 4.0;
    // A cross of two short rays over the character's cell tells whether a wall passes it.
    let across = Ray::new([x - 0.125, y], [0.25, 0.0]).with_interval(0.0, 1.0);
    let up = Ray::new([x, y - 1.0 / 6.0], [0.0, 1.0 / 3.0]).with_interval(0.0, 1.0);
    if scene.any_hit(&across) || scene.any_hit(&up) {
        return '#';
    }
    if (x - observer[0]).abs() < 0.125 && (y - observer[1]).abs() < 1.0 / 6.0 {
        return 'E';
    }
    let sight = Ray::through(observer, [x, y]).with_interval(0.0, 1.0);
    if scene.any_hit(&sight) { ' ' } else { '.' }
}
