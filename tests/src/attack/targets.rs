//! What is shot at: closed meshes, whose crossings have a known parity, and awkward ones.

use super::{AnyTarget, Target};
use crate::closed::closed_part;
use crate::meshes::{self, Soup};
use crate::shared::{load_mesh, missing, scenes};
use kdray::TriangleMesh;

/// Scenes with more triangles are left out, because their trees take too long to build again and again.
const MOST: usize = 520_000;

/// How many volleys small targets have in the first round: the next target begins where this one ends.
pub(super) const VOLLEYS: u64 = 4;

/// Scenes whose closed part is shot at in f64 as well.
const IN_F64: [&str; 4] = ["lego_car", "awkward_stadium", "staircase", "quake_inyard"];

/// A place in UTM coordinates, which f32 cannot tell to a millimetre.
const UTM: [f64; 3] = [691_607.123, 5_334_760.456, 520.789];

/// The targets that are made by code, of both precisions.
pub fn made() -> Vec<AnyTarget> {
    let singles = closed().into_iter().chain(scaled()).chain(awkward());
    let all = singles.map(AnyTarget::from).chain(in_f64().into_iter().map(AnyTarget::from));
    in_turns(all)
}

fn in_turns(targets: impl Iterator<Item = AnyTarget>) -> Vec<AnyTarget> {
    (0..).zip(targets).map(|(index, target)| target.beginning_at(VOLLEYS * index)).collect()
}

fn closed() -> Vec<Target> {
    let pair = |a: &TriangleMesh, b: &TriangleMesh| meshes::mesh([soup_of(a), soup_of(b)].concat());
    let (sphere, torus) = (meshes::sphere(16), meshes::torus(24, 16));
    vec![
        Target::new("torus and sphere, crossing", pair(&torus, &moved(&sphere, [0.7, 0.1, 0.0]))),
        Target::new("sphere", sphere.clone()),
        Target::new("torus", torus),
        Target::new("cube of 8 x 8 cells a side", meshes::cube(8)),
        Target::new("5 x 5 x 5 cubes", meshes::mesh(meshes::boxes(5))),
        Target::new("sphere twice", pair(&sphere, &sphere)),
        Target::new("sphere of spikes", meshes::spikes(10, 1e3)),
        Target::new("sheet of two sides", meshes::pillow(8)),
        Target::new("fan of needles", meshes::spindle(200, 1e-5)),
    ]
}

/// Closed meshes of sizes and in places that f32 has little room for.
fn scaled() -> Vec<Target> {
    let of = |name: &str, mesh: TriangleMesh, by: fn([f64; 3]) -> [f64; 3]| {
        let point = |p: &[f32; 3]| by(p.map(f64::from)).map(|x| x as f32);
        let vertices = mesh.vertices().iter().map(point).collect();
        let mesh = TriangleMesh::new(vertices, mesh.triangles().to_vec());
        Target::new(name, mesh.expect("all scales keep within f32"))
    };
    let (sphere, torus) = (|| meshes::sphere(10), || meshes::torus(16, 10));
    vec![
        of("torus in UTM coordinates", torus(), |[x, y, z]| {
            [691_607.0 + 10.0 * x, 5_334_760.0 + 10.0 * y, 520.0 + 10.0 * z]
        }),
        of("sphere, size 1e30", sphere(), |p| p.map(|x| x * 1e30)),
        of("sphere, size 3e38", sphere(), |p| p.map(|x| x * 3e38)),
        of("torus, size 1e-30", torus(), |p| p.map(|x| x * 1e-30)),
        of("sphere of denormals", sphere(), |p| p.map(|x| x * 1e-41)),
        // The kernels' trees reach from 2^-32 to 2^32.
        of("sphere, size 2^28", sphere(), |p| p.map(|x| x * 2.0_f64.powi(28))),
        of("torus, size 2^-33", torus(), |p| p.map(|x| x * 2.0_f64.powi(-33))),
        of("sphere, 1e3 x 1 x 1e-6", sphere(), |[x, y, z]| [1e3 * x, y, 1e-6 * z]),
        of("cube, 2^40 x 1 x 2^-40", meshes::cube(4), |[x, y, z]| {
            [x * 2.0_f64.powi(40), y, z * 2.0_f64.powi(-40)]
        }),
        of("cube, 2^28 x 1 x 2^-28", meshes::cube(4), |[x, y, z]| {
            [x * 2.0_f64.powi(28), y, z * 2.0_f64.powi(-28)]
        }),
    ]
}

/// Meshes whose vertices are no f32: rounded, they would be others.
fn in_f64() -> Vec<Target<f64>> {
    let of = |name: &str, soup: Soup<f64>| Target::new(name, meshes::mesh(soup));
    let (sphere, torus) = (|| soup_of(&meshes::sphere(8)), || soup_of(&meshes::torus(16, 10)));
    let (small, few) = (|| soup_of(&meshes::sphere(4)), || meshes::soup(12, [0.0; 3], 1.0, 9));
    let placed = |soup: &Soup, scale: f64| meshes::placed(soup, scale, [0.0; 3]);
    // Of few digits, though more than f32 has: so that the way to a vertex need not be rounded.
    let snapped = |p: [f64; 3]| p.map(|x| meshes::snapped(x, 1.0));
    let bent = |[x, y, z]: [f64; 3]| snapped([0.1 * x + 0.3, y / 3.0, 0.7 * z - 0.2 * x]);
    let by = |soup: Soup, by: &dyn Fn([f64; 3]) -> [f64; 3]| -> Soup<f64> {
        meshes::in_f64(&soup).into_iter().map(|triangle| triangle.map(by)).collect()
    };
    vec![
        of("f64: torus, bent", by(torus(), &bent)),
        // Of so many digits that edges are rounded.
        of("f64: torus, in thirds", by(torus(), &|p| p.map(|x| x / 3.0))),
        of("f64: torus, a metre in UTM", meshes::placed(&torus(), 1.0, UTM)),
        of("f64: cubes, a millimetre in UTM", meshes::placed(&meshes::boxes(3), 1e-3, UTM)),
        of("f64: cubes as of f32", meshes::in_f64(&meshes::boxes(3))),
        of("f64: sphere, size 1e-300", placed(&sphere(), 1e-300)),
        of("f64: sphere, size 1e-100", placed(&sphere(), 1e-100)),
        of("f64: torus, size 1e100", placed(&torus(), 1e100)),
        // T overflows, and nothing else.
        of("f64: torus, size 1e120", placed(&torus(), 1e120)),
        of("f64: sphere, size 1e148", placed(&sphere(), 1e148)),
        of("f64: sphere, size 1e300", placed(&sphere(), 1e300)),
        of("f64: sphere of denormals", placed(&sphere(), 1e-315)),
        of(
            "f64: soup around a sphere, size 1e-200",
            [placed(&small(), 1e-200), placed(&few(), 1.0)].concat(),
        ),
        of(
            "f64: soup in a sphere, size 1e200",
            [placed(&small(), 1e200), placed(&few(), 1.0)].concat(),
        ),
        of(
            "f64: sphere, 1e6 x 1 x 1e-6",
            by(sphere(), &|[x, y, z]| snapped([1e6 * x, y / 3.0, 1e-6 * z])),
        ),
        of("f64: fan of needles", by(soup_of(&meshes::spindle(100, 1e-5)), &bent)),
        of("f64: soup", by(meshes::soup(300, [0.0; 3], 1.0, 5), &bent)),
        of(
            "f64: soup, in thirds",
            by(meshes::soup(300, [0.0; 3], 1.0, 6), &|p| p.map(|x| x / 3.0)),
        ),
        of(
            "f64: soup, a metre in UTM",
            meshes::placed(&meshes::soup(200, [0.0; 3], 1.0, 7), 1.0, UTM),
        ),
        of("f64: degenerate and double triangles", by(meshes::degenerate(12), &|p| p)),
        of("f64: needles", by(meshes::needles(200, 10), &bent)),
    ]
}

/// Meshes that are no surfaces of anything.
fn awkward() -> Vec<Target> {
    let of = |name: &str, soup: Soup| Target::new(name, meshes::mesh(soup));
    vec![
        // As one leaf it is a node of nodes.
        of("soup", meshes::soup(500, [0.0; 3], 1.0, 1)),
        of("far soup", meshes::soup(200, [6e5, -5e6, 300.0], 40.0, 6)),
        of("coplanar squares in layers", meshes::grid(8, 3)),
        of("coplanar squares, overlapping", overlapping(300)),
        of("needles", meshes::needles(200, 9)),
        of("degenerate and double triangles", meshes::degenerate(10)),
        of("one triangle", meshes::soup(1, [0.0; 3], 1.0, 13)),
        of("one triangle 40 times", [meshes::grid(1, 1)[0]; 40].to_vec()),
    ]
}

/// Triangles of many sizes in three planes, corners on a lattice: edges lie in each other.
fn overlapping(count: usize) -> Soup {
    let place = |i: usize| [i * 7 % 16, i * 11 % 16, i % 3].map(|x| x as f32);
    let size = |i: usize| (1 + i % 5) as f32;
    let triangle = |i: usize| {
        let ([x, y, z], s) = (place(i), size(i));
        [[x, y, z], [x + s, y, z], [x, y + s, z]]
    };
    (0..count).map(triangle).collect()
}

/// The scenes beside the checkout, if they are there: the closed part of those that have one, of some of them in f64
/// too, and all awkward ones as they are. Only those of at most so many triangles.
pub fn of_scenes(most: usize) -> Vec<AnyTarget> {
    let listed = scenes().into_iter().flatten().filter(|info| info.triangles <= most.min(MOST));
    let loaded = listed.filter_map(|info| match load_mesh(&info) {
        Ok(mesh) => Some((mesh, info.name)),
        Err(error) => {
            missing(&error);
            None
        }
    });
    let targets = loaded.flat_map(|(mesh, name)| of_scene(mesh, &name));
    in_turns(targets.filter(|target| target.triangles() > 0))
}

/// What is shot at of one scene.
fn of_scene(mesh: TriangleMesh, name: &str) -> Vec<AnyTarget> {
    let closed = closed_part(&mesh);
    let mut targets = Vec::new();
    if closed.triangles().len() >= 100 {
        if IN_F64.contains(&name) {
            let there = meshes::moved(&closed, |p| [0, 1, 2].map(|k| p[k] / 3.0 + UTM[k]));
            let name = format!("f64: {name}, closed part in UTM");
            targets.push(Target::<f64>::new(name, there).into());
        }
        targets.push(Target::new(format!("{name}, closed part"), closed).into());
    }
    if name.starts_with("awkward") {
        targets.push(Target::new(name, mesh).into());
    }
    targets
}

fn soup_of(mesh: &TriangleMesh) -> Soup {
    (0..mesh.triangles().len() as u32).map(|id| mesh.corners(id)).collect()
}

fn moved(mesh: &TriangleMesh, by: [f32; 3]) -> TriangleMesh {
    let point = |p: &[f32; 3]| std::array::from_fn(|k| p[k] + by[k]);
    let vertices = mesh.vertices().iter().map(point).collect();
    TriangleMesh::new(vertices, mesh.triangles().to_vec()).expect("the move is small")
}

#[cfg(test)]
mod tests {
    use super::super::aim::kind;
    use super::*;
    use kdray::{BuildOptions, Scene};
    use std::collections::HashSet;

    #[test]
    fn what_should_be_closed_is() {
        assert!(closed().iter().chain(&scaled()).all(|target| target.is_closed));
        assert!(awkward().iter().filter(|target| target.is_closed).count() <= 1);
        assert_eq!(in_f64().iter().filter(|target| !target.is_closed).count(), 7);
    }

    #[test]
    fn few_volleys_at_each_are_of_all_kinds() {
        let firsts: Vec<u64> = made().iter().map(AnyTarget::first).collect();
        let numbers = firsts.iter().flat_map(|&first| first..first + VOLLEYS);
        let kinds: HashSet<u64> = numbers.map(kind).collect();
        assert_eq!(kinds.len(), 60);
    }

    #[test]
    fn kernels_have_trees_of_all_but_extreme_sizes() {
        let has_none = |target: &Target| {
            let scene = Scene::build(target.mesh.clone(), &BuildOptions::default());
            scene.is_ok_and(|scene| scene.wide_tree().is_none())
        };
        let all = [closed(), scaled(), awkward()].concat();
        let without: Vec<_> = all.iter().filter(|it| has_none(it)).map(|it| &it.name).collect();
        let extreme = ["sphere, size 1e30", "sphere, size 3e38", "torus, size 1e-30"];
        let more = ["sphere of denormals", "cube, 2^40 x 1 x 2^-40"];
        assert_eq!(without, [&extreme[..], &more].concat());
        for target in in_f64() {
            let scene = Scene::build(target.mesh, &BuildOptions::default()).unwrap();
            assert!(scene.wide_tree().is_some(), "{}", target.name);
        }
    }
}
