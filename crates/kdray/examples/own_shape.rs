//! A shape of one's own: upright cylinders, like the columns of a hall, that kdray has never heard
//! of. Two small traits are all it takes for trees, closest, any and all hits.
//!
//! `cargo run --release -p kdray --example own_shape`

use kdray::primitives::{HitRule, Intersect, Primitives};
use kdray::{Aabb, BuildOptions, Hit, Ray, ShapeScene, Side, Strategy};
use std::io::{self, Write};

/// A column: its axis is parallel to y, and its shaft, without top and bottom, is what rays meet.
struct Column {
    x: f32,
    z: f32,
    radius: f32,
    bottom: f32,
    top: f32,
}

struct Columns(Vec<Column>);

/// What a tree needs to know: how many, and where.
impl Primitives<3> for Columns {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn bounds(&self, id: u32) -> Aabb<3> {
        let Column { x, z, radius, bottom, top } = self.0[id as usize];
        // A step outward, since x + radius is rounded.
        let (low, high) = (|x: f32| (x - radius).next_down(), |x: f32| (x + radius).next_up());
        Aabb { min: [low(x), bottom, low(z)], max: [high(x), top, high(z)] }
    }
}

/// What a query needs to know: where a ray meets one of them.
impl Intersect<3> for Columns {
    fn intersect(&self, id: u32, ray: &Ray<3>, _rule: HitRule, report: &mut impl FnMut(Hit)) {
        let column = &self.0[id as usize];
        // Seen from above a column is a circle: |e + t d|² = r² in x and z.
        let (dx, dz) = (ray.direction[0], ray.direction[2]);
        let (ex, ez) = (ray.origin[0] - f64::from(column.x), ray.origin[2] - f64::from(column.z));
        let radius = f64::from(column.radius);
        let (a, b, c) = (dx * dx + dz * dz, ex * dx + ez * dz, ex * ex + ez * ez - radius * radius);
        let root = b * b - a * c;
        if a == 0.0 || root <= 0.0 {
            return;
        }
        for (sign, side) in [(-1.0, Side::Front), (1.0, Side::Back)] {
            let t = (-b + sign * root.sqrt()) / a;
            let height = ray.origin[1] + t * ray.direction[1];
            let on_shaft = f64::from(column.bottom) <= height && height <= f64::from(column.top);
            if on_shaft && ray.interval.contains(t) {
                report(Hit { t, primitive_id: id, u: 0.0, v: 0.0, side });
            }
        }
    }
}

/// Two rows of columns along z.
fn hall() -> Columns {
    let place = |i: usize| {
        let (x, z) = ([-3.0, 3.0][i % 2], 4.0 + 4.0 * (i / 2) as f32);
        Column { x, z, radius: 0.7, bottom: 0.0, top: 6.0 }
    };
    Columns((0..16).map(place).collect())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = ShapeScene::build(hall(), &BuildOptions::for_strategy(Strategy::Sah))?;
    let mut out = io::stdout().lock();
    let stats = scene
        .tree()
        .stats(scene.primitives().count(), &BuildOptions::for_strategy(Strategy::Sah).cost);
    writeln!(out, "16 columns, {} nodes, {} levels deep", stats.nodes, stats.max_depth)?;

    let eye = [0.0, 2.5, -4.0];
    let light = [2.0, 7.0, -2.0];
    for row in 0..24 {
        let line: String = (0..72).map(|column| shade(&scene, eye, light, column, row)).collect();
        writeln!(out, "{}", line.trim_end())?;
    }

    let across = Ray::new([-9.0, 1.0, 12.3], [1.0, 0.0, 0.0]);
    writeln!(out, "A ray across the hall passes in and out of two columns:")?;
    for hit in scene.all_hits(&across) {
        let Hit { t, primitive_id, side, .. } = hit;
        writeln!(out, "  t = {t:7.4}  column {primitive_id:2}  from its {side:?}")?;
    }
    let between = Ray::through([0.0, 1.0, 0.0], [0.0, 1.0, 40.0]).with_interval(0.0, 1.0);
    writeln!(out, "Is the way through the middle blocked? {}", scene.any_hit(&between))?;
    Ok(())
}

/// One character of the picture: the nearest column, by how far away it is, and dark where the
/// lamp does not reach it.
fn shade(
    scene: &ShapeScene<Columns>,
    eye: [f64; 3],
    light: [f64; 3],
    column: i32,
    row: i32,
) -> char {
    let (x, y) = (f64::from(column) / 36.0 - 1.0, 1.0 - f64::from(row) / 12.0);
    let ray = Ray::new(eye, [0.8 * x, 0.5 * y + 0.1, 1.0]);
    let Some(hit) = scene.closest_hit(&ray) else { return ' ' };
    let to_light = Ray::through(ray.at(hit.t), light).with_interval(1e-6, 1.0);
    if scene.any_hit(&to_light) {
        return '.';
    }
    ['@', '#', '*', '+', '=', '-'][((hit.t / 5.0) as usize).min(5)]
}
