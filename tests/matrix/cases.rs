//! What is hit, by which rays, and the answers without a tree.

use kdray::primitives::{Balls, HitRule, Segments};
use kdray::traverse::Naive;
use kdray::{Aabb, Hit, Ray, TriangleMesh};
use kdray_tests::oracle::ExactHit;
use kdray_tests::rays::{Archer, random};
use kdray_tests::{Subject, meshes};
use rand::RngExt;
use rayon::prelude::*;
use std::sync::LazyLock;

/// How many rays of each kind are aimed at each case.
const EACH: usize = 6;

/// Primitives and rays, with all answers.
pub(crate) struct Case<S, const K: usize> {
    pub(crate) name: &'static str,
    pub(crate) subject: S,
    pub(crate) seed: u64,
    pub(crate) aimed: Vec<Aimed<K>>,
}

/// A ray with its answers by [`HitRule::Touching`] and [`HitRule::Crossing`].
pub(crate) struct Aimed<const K: usize> {
    pub(crate) ray: Ray<K>,
    pub(crate) touched: Answer,
    pub(crate) crossed: Answer,
}

/// All hits of a ray by one rule.
pub(crate) struct Answer {
    /// From testing every primitive, in order.
    pub(crate) naive: Vec<Hit>,
    /// From rational arithmetic, on the ray's whole line, in no order; `None` without an oracle.
    pub(crate) exact: Option<Vec<ExactHit>>,
}

impl<const K: usize> Aimed<K> {
    /// Finds the answers.
    pub(crate) fn new<S: Subject<K>>(subject: &S, ray: Ray<K>) -> Self {
        let bounds = (0..subject.count() as u32)
            .fold(Aabb::EMPTY, |bounds, id| bounds.union(&subject.bounds(id)));
        let naive = Naive::new(subject, bounds);
        let answer = |rule| Answer {
            naive: naive.all_hits(&ray, rule),
            exact: subject.exact_hits(&ray, rule),
        };
        Self { ray, touched: answer(HitRule::Touching), crossed: answer(HitRule::Crossing) }
    }

    /// The same ray with intervals that begin or end exactly at a hit, or a step before or behind.
    fn cut_at_hits(&self) -> Vec<Ray<K>> {
        let ends = |hit: &Hit| {
            let t = hit.t;
            let infinite = f64::INFINITY;
            let bounds = [(t, infinite), (t.next_up(), infinite), (-infinite, t), (t, t)];
            bounds.map(|(t_min, t_max)| self.ray.with_interval(t_min, t_max))
        };
        self.touched.naive.first().map(ends).into_iter().flatten().collect()
    }
}

impl<S: Subject<K>, const K: usize> Case<S, K> {
    fn new(name: &'static str, seed: u64, farthest: f64, subject: S) -> Self {
        let rays = Archer::new(&subject, seed).all_kinds(EACH, farthest);
        let mut aimed: Vec<_> = rays.into_par_iter().map(|ray| Aimed::new(&subject, ray)).collect();
        let cut: Vec<_> = aimed.iter().step_by(5).flat_map(Aimed::cut_at_hits).collect();
        aimed.par_extend(cut.into_par_iter().map(|ray| Aimed::new(&subject, ray)));
        Self { name, subject, seed, aimed }
    }
}

/// The largest distance, in diagonals, from which rays come.
pub(crate) const FAR: f64 = 1e12;

pub(crate) static TRIANGLES: LazyLock<Vec<Case<TriangleMesh, 3>>> = LazyLock::new(|| {
    let soup = |scale: f32, seed| meshes::mesh(meshes::soup(150, [0.0; 3], scale, seed));
    let case = |name, seed, mesh| Case::new(name, seed, FAR, mesh);
    vec![
        case("soup", 1, soup(1.0, 1)),
        case("soup of scale 1e-30", 2, soup(1e-30, 2)),
        case("soup of scale 1e-6", 3, soup(1e-6, 3)),
        case("soup of scale 1e6", 4, soup(1e6, 4)),
        case("soup of scale 1e30", 5, soup(1e30, 5)),
        case("far soup", 6, meshes::mesh(meshes::soup(150, [6e5, -5e6, 300.0], 40.0, 6))),
        case("grid of coplanar triangles", 7, meshes::mesh(meshes::grid(6, 3))),
        case("axis-aligned boxes", 8, meshes::mesh(meshes::boxes(3))),
        case("needles", 9, meshes::mesh(meshes::needles(120, 9))),
        case("degenerate and double triangles", 10, meshes::mesh(meshes::degenerate(10))),
        case("sphere", 11, meshes::sphere(8)),
        case("torus", 12, meshes::torus(12, 8)),
        case("one triangle", 13, meshes::mesh(meshes::soup(1, [0.0; 3], 1.0, 13))),
        case("identical triangles", 14, meshes::mesh([meshes::grid(1, 1)[0]; 40].to_vec())),
        case("nothing", 15, TriangleMesh::default()),
    ]
});

/// Among them some that only f64 has: far from zero, very small and very large, and closer than f32 tells.
pub(crate) static TRIANGLES_F64: LazyLock<Vec<Case<TriangleMesh<f64>, 3>>> = LazyLock::new(|| {
    // A corner of a national grid, in metres.
    const GRID: [f64; 3] = [500_000.0, 5_400_000.0, 100.0];
    let soup = |seed| meshes::soup(120, [0.0; 3], 1.0, seed);
    let case = |name, seed, soup: meshes::Soup<f64>| Case::new(name, seed, FAR, meshes::mesh(soup));
    let placed = |seed, scale, center| meshes::placed(&soup(seed), scale, center);
    vec![
        case("soup", 51, meshes::in_f64(&soup(51))),
        case("soup of scale 1e-290", 52, placed(52, 1e-290, [0.0; 3])),
        case("soup of scale 1e-30", 53, placed(53, 1e-30, [0.0; 3])),
        case("soup of scale 1e30", 54, placed(54, 1e30, [0.0; 3])),
        case("soup of scale 1e290", 55, placed(55, 1e290, [0.0; 3])),
        case("soup in a national grid", 56, placed(56, 1000.0, GRID)),
        case("a centimetre of a national grid", 57, placed(57, 0.01, GRID)),
        case("millimetres in kilometres", 58, specks(GRID)),
        case("sheets closer than f32 tells", 59, sheets(1e-12)),
        case("sheets in a national grid", 60, meshes::placed(&meshes::grid(5, 2), 0.001, GRID)),
        case("axis-aligned boxes", 61, meshes::placed(&meshes::boxes(2), 0.1, GRID)),
        case("needles", 62, meshes::in_f64(&meshes::needles(80, 62))),
        case(
            "degenerate and double triangles",
            63,
            meshes::placed(&meshes::degenerate(63), 1.0, GRID),
        ),
        Case::new("sphere", 64, FAR, meshes::mesh_in_f64(&meshes::sphere(7))),
        case("one triangle", 65, meshes::placed(&meshes::soup(1, [0.0; 3], 1.0, 65), 1.0, GRID)),
        case("identical triangles", 66, meshes::in_f64(&[meshes::grid(1, 1)[0]; 40].to_vec())),
        case("nothing", 67, Vec::new()),
    ]
});

/// Triangles of a millimetre, some kilometres apart.
fn specks(center: [f64; 3]) -> meshes::Soup<f64> {
    let places = meshes::soup(100, [0.0; 3], 1.0, 68);
    let speck = |(triangle, place): ([[f32; 3]; 3], [[f32; 3]; 3])| {
        let at = std::array::from_fn(|k| center[k] + 2000.0 * f64::from(place[0][k]));
        meshes::placed(&vec![triangle], 0.001, at)
    };
    let triangles = meshes::soup(100, [0.0; 3], 1.0, 69);
    triangles.into_iter().zip(places).flat_map(speck).collect()
}

/// Squares of coplanar triangles above each other, with so much between.
fn sheets(distance: f64) -> meshes::Soup<f64> {
    let mut sheets = meshes::in_f64(&meshes::grid(4, 4));
    sheets.iter_mut().flatten().for_each(|corner| corner[2] = 1.0 + distance * corner[2]);
    sheets
}

pub(crate) static SEGMENTS: LazyLock<Vec<Case<Segments, 2>>> = LazyLock::new(|| {
    let case = |name, seed, ends| {
        let segments = Segments::new(ends).expect("test segments are finite");
        Case::new(name, seed, FAR, segments)
    };
    vec![
        case("segment soup", 21, segment_soup(150, [0.0; 2], 1.0, 21)),
        case("segment soup of scale 1e-30", 22, segment_soup(150, [0.0; 2], 1e-30, 22)),
        case("segment soup of scale 1e30", 23, segment_soup(150, [0.0; 2], 1e30, 23)),
        case("far segment soup", 24, segment_soup(150, [6e5, -5e6], 40.0, 24)),
        case("lattice", 25, lattice(7)),
        case("closed polygon", 26, polygon(60)),
        case("degenerate and double segments", 27, degenerate_segments(27)),
        case("no segments", 28, Vec::new()),
    ]
});

pub(crate) static BALLS_2D: LazyLock<Vec<Case<Balls<2>, 2>>> = LazyLock::new(|| ball_cases(31));
pub(crate) static BALLS_3D: LazyLock<Vec<Case<Balls<3>, 3>>> = LazyLock::new(|| ball_cases(41));

fn ball_cases<const K: usize>(seed: u64) -> Vec<Case<Balls<K>, K>> {
    let case = |name, seed, balls| {
        let balls = Balls::new(balls).expect("test balls are finite");
        // Balls are not decided exactly: from afar, rounding hides where they end.
        Case::new(name, seed, 1e5, balls)
    };
    vec![
        case("balls", seed, random_balls(150, 1.0, seed)),
        case("balls of scale 1e-15", seed + 1, random_balls(100, 1e-15, seed + 1)),
        case("balls of scale 1e15", seed + 2, random_balls(100, 1e15, seed + 2)),
        case("touching balls in rows", seed + 3, rows_of_balls()),
        case("balls in balls", seed + 4, (1..40).map(|i| ([0.0; K], i as f32)).collect()),
        case("no balls", seed + 5, Vec::new()),
    ]
}

fn random_balls<const K: usize>(count: usize, scale: f32, seed: u64) -> Vec<([f32; K], f32)> {
    let mut random = random(seed);
    let mut ball = || {
        let center = [0.0; K].map(|_: f32| scale * random.random_range(-1.0..1.0_f32));
        (center, scale * random.random_range(0.0..0.2_f32))
    };
    (0..count).map(|_| ball()).collect()
}

fn rows_of_balls<const K: usize>() -> Vec<([f32; K], f32)> {
    let count = 5_usize.pow(K as u32);
    let place = |i: usize| std::array::from_fn(|k| (i / 5_usize.pow(k as u32) % 5) as f32);
    (0..count).map(|i| (place(i), 0.5)).collect()
}

fn segment_soup(n: usize, center: [f32; 2], scale: f32, seed: u64) -> Vec<[[f32; 2]; 2]> {
    let soup = meshes::soup(n, [center[0], center[1], 0.0], scale, seed);
    soup.into_iter().map(|[a, b, _]| [[a[0], a[1]], [b[0], b[1]]]).collect()
}

fn lattice(n: usize) -> Vec<[[f32; 2]; 2]> {
    let cells = (0..n * n).map(|i| [(i % n) as f32, (i / n) as f32]);
    cells.flat_map(|[x, y]| [[[x, y], [x + 1.0, y]], [[x, y], [x, y + 1.0]]]).collect()
}

fn polygon(n: usize) -> Vec<[[f32; 2]; 2]> {
    let corner = |i: usize| {
        let (angle, radius) = ((i % n) as f32 / n as f32 * std::f32::consts::TAU, 1 + i % 3);
        [angle.cos(), angle.sin()].map(|x| x * radius as f32)
    };
    (0..n).map(|i| [corner(i), corner(i + 1)]).collect()
}

fn degenerate_segments(seed: u64) -> Vec<[[f32; 2]; 2]> {
    let soup = segment_soup(40, [0.0; 2], 1.0, seed);
    soup.iter().flat_map(|&[a, b]| [[a, b], [a, a], [b, a], [a, b]]).collect()
}
