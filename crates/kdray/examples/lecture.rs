//! The examples of the founding lecture, with its numbers: where a ray meets a line (S2), the box
//! test (S4), and the three cases of the traversal (S11).
//!
//! `cargo run --release -p kdray --example lecture`

use kdray::geometry::Plane;
use kdray::primitives::Segments;
use kdray::traverse::{Step, StepRecorder, TraversalCase};
use kdray::{Aabb, BuildOptions, Ray, ShapeScene, Strategy};
use std::io::{self, Write};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn main() -> Outcome {
    let mut out = io::stdout().lock();
    ray_and_lines(&mut out)?;
    box_test(&mut out)?;
    traversal(&mut out)
}

/// S2: P = E + D·t, put into Ax + By + C = 0.
fn ray_and_lines(out: &mut impl Write) -> Outcome {
    writeln!(out, "S2  Where a ray meets a line")?;
    let ray = Ray::new([0.0, 0.0], [5.0, 4.0]);
    let vertical = Plane { normal: [1.0, 0.0], offset: -10.0 };
    let horizontal = Plane { normal: [0.0, 1.0], offset: -6.0 };
    let meets = |line: Plane<2>| line.ray_parameter(&ray).ok_or("the ray is parallel to the line");
    let (t_x, t_y) = (meets(vertical)?, meets(horizontal)?);
    writeln!(out, "    E = (0, 0), D = (5, 4)")?;
    writeln!(out, "    the vertical   x - 10 = 0 is met at t_x = {t_x}")?;
    writeln!(out, "    the horizontal y -  6 = 0 is met at t_y = {t_y}")?;
    writeln!(out, "    t_x > t_y is {}: the horizontal is met first\n", t_x > t_y)?;
    Ok(())
}

/// S3 and S4: l and h are the t of the two planes of an axis, m and M the smaller and the larger.
fn box_test(out: &mut impl Write) -> Outcome {
    writeln!(out, "S4  The box test")?;
    let triangle = [[-2.0, 2.0, 4.0], [2.0, 2.0, 4.0], [2.0, -2.0, 9.0]];
    let aabb = Aabb::of_points(triangle);
    let ray = Ray::new([0.0, 0.0, 0.0], [0.4, 0.1, 1.0]);
    writeln!(out, "    E = (0, 0, 0), direction (0.4, 0.1, 1)")?;
    writeln!(out, "    box min {:?}, max {:?}", aabb.min, aabb.max)?;
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let at = |side: f32| {
            let plane = Plane::perpendicular(axis, f64::from(side));
            plane.ray_parameter(&ray).ok_or("the ray is parallel to the planes")
        };
        let (l, h) = (at(aabb.min[axis])?, at(aabb.max[axis])?);
        let (m, big_m) = (l.min(h), l.max(h));
        writeln!(out, "    {name}: l = {l:.0}, h = {h:.0}, so m = {m:.0}, M = {big_m:.0}")?;
    }
    match aabb.slab(&ray) {
        Some(t) => writeln!(out, "    t_min = {:.0} < t_max = {:.0}: HIT\n", t.t_min, t.t_max)?,
        None => writeln!(out, "    t_min > t_max: MISS\n")?,
    }
    Ok(())
}

/// S11: four walls in the plane, each in a quarter of the box, and three rays.
fn traversal(out: &mut impl Write) -> Outcome {
    writeln!(out, "S11 The traversal of a kd-tree")?;
    let walls = Segments::new(vec![
        [[0.0, 0.0], [2.0, 3.0]],
        [[0.0, 8.0], [3.0, 6.0]],
        [[6.0, 1.0], [8.0, 3.0]],
        [[7.0, 8.0], [5.0, 5.0]],
    ])?;
    let options = BuildOptions { leaf_size: 1, ..BuildOptions::for_strategy(Strategy::Middle) };
    let scene = ShapeScene::build(walls, &options)?;
    for (origin, direction) in [([-2.0, 2.0], [1.0, 0.0]), ([9.0, 7.0], [-1.0, -1.0])] {
        let mut recorder = StepRecorder::default();
        let ray = Ray::new(origin, direction);
        let hit = scene.closest_hit_traced(&ray, &mut recorder);
        writeln!(out, "    E = {origin:?}, D = {direction:?}")?;
        for step in &recorder.steps {
            writeln!(out, "      {}", describe(step))?;
        }
        match hit {
            Some(hit) => writeln!(out, "      wall {} is hit at t = {}", hit.primitive_id, hit.t)?,
            None => writeln!(out, "      nothing is hit")?,
        }
    }
    Ok(())
}

fn describe(step: &Step) -> String {
    match step {
        Step::Root(Some(t)) => {
            format!("root: the ray is in the box from t = {:.2} to {:.2}", t.t_min, t.t_max)
        }
        Step::Root(None) => "root: the ray misses the box".to_owned(),
        Step::Split(s) => {
            let (near, split, far) = (s.t_near, s.t_split, s.t_far);
            let case = match s.case {
                TraversalCase::NearOnly => {
                    "t_split > t_far: the near child, the far one is dropped"
                }
                TraversalCase::NearThenFar => {
                    "t_near < t_split < t_far: the near child first, the far one onto the stack"
                }
                TraversalCase::FarOnly => "t_split < t_near: only the far child",
            };
            let axis = ["x", "y", "z"][s.axis];
            format!(
                "node {}, {axis} = {}: t_near = {near:.2}, t_split = {split:.2}, t_far = {far:.2}; {case}",
                s.node, s.split
            )
        }
        Step::Leaf(l) => format!("leaf {} with {} primitives", l.node, l.primitives),
        Step::Primitive { id, t: Some(t) } => format!("  wall {id}: hit at t = {t:.2}"),
        Step::Primitive { id, t: None } => format!("  wall {id}: missed"),
        Step::Pop { node, t_near } => format!("node {node} from the stack, t_near = {t_near:.2}"),
        Step::FinishEarly { t, t_near } => {
            format!("done: the hit at t = {t:.2} is nearer than what waits, t_near = {t_near:.2}")
        }
    }
}
