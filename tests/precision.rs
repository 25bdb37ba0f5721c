//! Vertices in f64: what is an f32 as well gives the same hits, and what is none keeps its digits.

use kdray::primitives::HitArrays;
use kdray::{Arithmetic, BuildOptions, Hit, Precision, Ray, RayPacket, Scene, Side, TriangleMesh};
use kdray_tests::meshes::{
    boxes, degenerate, grid, in_f64, mesh, mesh_in_f64, needles, placed, soup, sphere,
};
use kdray_tests::rays::Archer;

fn scene<T: Precision>(mesh: TriangleMesh<T>) -> Scene<T> {
    Scene::build(mesh, &BuildOptions::default()).expect("test meshes can be built")
}

/// All answers to rays, numbers as bits.
#[derive(Debug, PartialEq)]
struct Answers {
    closest: Vec<Option<HitBits>>,
    in_batch: Vec<Option<HitBits>>,
    any: Vec<bool>,
    near: Vec<bool>,
    crossed: Vec<Vec<HitBits>>,
    touched: Vec<Vec<HitBits>>,
    at_once: Vec<Vec<HitBits>>,
    counts: Vec<[usize; 2]>,
    /// All hits but the first, and the first on a triangle of even id.
    rest: Vec<Vec<HitBits>>,
    even: Vec<Option<HitBits>>,
}

/// A hit with its side.
type HitBits = (u64, u32, [u64; 2], Side);

fn bits(hit: Hit) -> HitBits {
    kdray_tests::bits::bits(&hit)
}

fn answers<T: Precision>(scene: &Scene<T>, rays: &[Ray]) -> Answers {
    let mut batch = vec![None; rays.len()];
    scene.closest_hits(rays, &mut batch);
    let mut counts = vec![usize::MAX; rays.len()];
    scene.counts(rays, &mut counts);
    let at_once = |ray: &Ray| {
        let mut hits = Vec::new();
        scene.all_hits_into(ray, &mut hits);
        hits.into_iter().map(bits).collect()
    };
    let hint = |ray: &Ray| scene.closest_hit_with_hint(ray).map(|(_, hint)| hint);
    Answers {
        closest: rays.iter().map(|ray| scene.closest_hit(ray).map(bits)).collect(),
        in_batch: batch.into_iter().map(|hit| hit.map(bits)).collect(),
        any: rays.iter().map(|ray| scene.any_hit(ray)).collect(),
        near: rays
            .iter()
            .map(|ray| scene.any_hit_near(ray, hint(ray).unwrap_or_default()))
            .collect(),
        crossed: rays.iter().map(|ray| scene.all_hits(ray).map(bits).collect()).collect(),
        touched: rays.iter().map(|ray| scene.all_touched(ray).map(bits).collect()).collect(),
        at_once: rays.iter().map(at_once).collect(),
        counts: rays.iter().zip(counts).map(|(ray, count)| [scene.count(ray), count]).collect(),
        rest: rays
            .iter()
            .filter_map(|ray| Some((ray, scene.all_hits(ray).next()?)))
            .map(|(ray, first)| scene.all_hits_after(ray, &first).map(bits).collect())
            .collect(),
        even: rays
            .iter()
            .map(|ray| scene.closest_hit_where(ray, |hit| hit.primitive_id % 2 == 0).map(bits))
            .collect(),
    }
}

#[test]
fn meshes_of_f32_numbers_are_hit_alike_in_f64() {
    let meshes = [
        mesh(soup(300, [0.0; 3], 1.0, 71)),
        mesh(soup(300, [6e5, -5e6, 300.0], 40.0, 72)),
        mesh(soup(100, [0.0; 3], 1e-30, 73)),
        mesh(soup(100, [0.0; 3], 1e30, 74)),
        mesh(grid(6, 3)),
        mesh(boxes(3)),
        mesh(needles(100, 75)),
        mesh(degenerate(76)),
        sphere(10),
    ];
    for mesh in meshes {
        let rays = Archer::new(&mesh, 77).all_kinds(20, 1e9);
        let found = answers(&scene(mesh_in_f64(&mesh)), &rays);
        assert_eq!(found, answers(&scene(mesh), &rays));
        assert!(found.any.contains(&true) && found.any.contains(&false));
    }
}

#[test]
fn trees_over_f64_are_wide_for_meshes_of_any_size() {
    for scale in [1e-300, 1e-20, 1.0, 1e20, 1e300] {
        let scene = scene(mesh(placed(&soup(200, [0.0; 3], 1.0, 78), scale, [0.0; 3])));
        assert!(scene.wide_tree().is_some(), "{scale}");
        let [a, b, c] = scene.mesh().corners(5);
        let middle = [0, 1, 2].map(|k| 0.3 * a[k] + 0.3 * b[k] + 0.4 * c[k]);
        let ray = Ray::through([9.0 * scale, 0.2 * scale, -3.0 * scale], middle);
        assert_eq!(scene.closest_hit(&ray), scene.shapes().naive().closest_hit(&ray), "{scale}");
        assert!(scene.any_hit(&ray), "{scale}");
    }
}

#[test]
fn numbers_at_the_ends_of_f64_are_decided_too() {
    let (huge, tiny) = (f64::MAX, f64::from_bits(1));
    for size in [huge, 1e300, 1e-300, 1e-310, tiny] {
        let corners = [[-size, -size, size], [size, -size, size], [0.0, size, size]];
        let scene = scene(mesh(vec![corners]));
        for length in [huge, 1.0, size, 1e-300, tiny] {
            let ray = Ray::new([0.0; 3], [0.0, 0.0, length]);
            let naive = scene.shapes().naive().closest_hit(&ray);
            assert_eq!(scene.closest_hit(&ray), naive, "{size} {length}");
            assert_eq!(scene.shapes().closest_hit(&ray), naive, "{size} {length}");
            let t = size / length;
            assert_eq!(naive.is_some(), t.is_finite(), "{size} {length}");
            let aside = Ray::new([-size, size, 0.0], [0.0, 0.0, length]);
            assert!(!scene.any_hit(&aside) && scene.all_hits(&aside).next().is_none());
        }
    }
}

#[test]
fn triangles_closer_than_f32_tells_are_met_in_order() {
    let mut sheets = in_f64(&grid(2, 5));
    sheets.iter_mut().flatten().for_each(|corner| corner[2] = 1e6 + 1e-9 * corner[2]);
    let scene = scene(mesh(sheets));
    let hits: Vec<Hit> = scene.all_hits(&Ray::new([0.3, 0.4, 0.0], [0.0, 0.0, 1.0])).collect();
    assert_eq!(hits.len(), 5);
    for (layer, hit) in hits.iter().enumerate() {
        assert_eq!(hit.t, 1e6 + 1e-9 * layer as f64);
        assert_eq!(hit.primitive_id / 8, layer as u32);
    }
}

#[test]
fn float_arithmetic_and_packets_are_exact_in_f64() {
    let corner = [500_000.0, 5_400_000.0, 100.0];
    let exact = scene(mesh(placed(&soup(500, [0.0; 3], 1.0, 79), 0.01, corner)));
    let rays = Archer::new(exact.mesh(), 80).all_kinds(20, 1e3);
    let float = exact.clone().with_arithmetic(Arithmetic::Float);
    assert_eq!(answers(&exact, &rays), answers(&float, &rays));
    let each = [0, 1, 2].map(|k| rays.iter().map(|ray| ray.origin[k]).collect::<Vec<_>>());
    let packet = RayPacket::towards(corner, [&each[0], &each[1], &each[2]]);
    let mut hits = HitArrays::default();
    float.packet_closest_hits(&packet, &mut hits);
    let mut any = vec![false; rays.len()];
    float.packet_any_hits(&packet, &mut any);
    for (index, any) in any.into_iter().enumerate() {
        let alone = exact.closest_hit(&packet.ray(index));
        assert_eq!((hits.get(index), any), (alone, alone.is_some()));
    }
}
