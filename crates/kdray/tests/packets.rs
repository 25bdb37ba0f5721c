//! All kinds of packets against the single traversal.

use kdray::primitives::{Balls, HitRule, TriangleMesh, intersect_triangle};
use kdray::traverse::{Cull, PacketCounters, PacketKind, PacketRecorder, PacketStep};
use kdray::{BuildOptions, Ray, ShapeScene, Strategy};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

type Soup = Vec<[[f32; 3]; 3]>;

/// Triangles in the cube from −1 to 1. If `snapped`, corners lie on a grid of quarters, so that many
/// triangles and planes share coordinates.
fn soup(count: usize, snapped: bool, seed: u64) -> Soup {
    let mut random = Pcg64::seed_from_u64(seed);
    let snap = |x: f32| if snapped { (x * 4.0).round() / 4.0 } else { x };
    let mut triangle = || {
        let center = [0; 3].map(|_| random.random_range(-0.8..0.8_f32));
        [0; 3].map(|_| center.map(|c| snap(c + random.random_range(-0.2..0.2_f32))))
    };
    (0..count).map(|_| triangle()).collect()
}

/// A closed octahedron.
fn octahedron() -> Soup {
    let corner = |axis: usize, sign: f32| {
        let mut p = [0.0; 3];
        p[axis] = sign;
        p
    };
    let signs = [[1.0, 1.0, 1.0], [1.0, 1.0, -1.0], [1.0, -1.0, 1.0], [1.0, -1.0, -1.0]];
    let all = signs.into_iter().flat_map(|s| [s, s.map(|x: f32| -x)]);
    all.map(|s| [corner(0, s[0]), corner(1, s[1]), corner(2, s[2])]).collect()
}

fn scenes() -> Vec<ShapeScene> {
    let soups = [soup(300, false, 1), soup(300, true, 2), octahedron(), soup(1, false, 3)];
    let scene = |(soup, strategy): (&Soup, Strategy)| {
        let mesh = TriangleMesh::from_soup(soup.clone()).expect("test meshes are finite");
        let options = BuildOptions { leaf_size: 1, ..BuildOptions::for_strategy(strategy) };
        ShapeScene::build(mesh, &options).expect("test meshes are valid")
    };
    soups.iter().flat_map(|soup| Strategy::ALL.map(|strategy| scene((soup, strategy)))).collect()
}

/// Packets of all kinds and sizes give the answers of the single traversal; how many rays all kinds
/// leave to it.
fn assert_same<P: Cull>(scene: &ShapeScene<P, 3>, rays: &[Ray]) -> [u64; 3] {
    let closest: Vec<_> = rays.iter().map(|ray| scene.closest_hit(ray)).collect();
    let any: Vec<_> = rays.iter().map(|ray| scene.any_hit(ray)).collect();
    PacketKind::ALL.map(|kind| {
        for size in [1, 3, 8, 64, 100, 256] {
            let packets = scene.packets(kind).with_size(size);
            assert_eq!(packets.closest_hits(rays, &mut ()), closest, "{kind:?} of {size}");
            assert_eq!(packets.any_hits(rays, &mut ()), any, "{kind:?} of {size}");
        }
        let mut counters = PacketCounters::default();
        scene.packets(kind).closest_hits(rays, &mut counters);
        counters.left
    })
}

/// Rays from `origin` through a square of 16 x 16 points, `half` to each side of `target`.
fn camera(origin: [f64; 3], target: [f64; 3], half: f64) -> Vec<Ray> {
    let at = |i: usize| half * (i as f64 / 7.5 - 1.0);
    let pixel = |i: usize| [target[0] + at(i % 16), target[1] + at(i / 16), target[2]];
    (0..256).map(|i| Ray::through(origin, pixel(i))).collect()
}

#[test]
fn camera_rays_hit_what_single_rays_do() {
    for scene in scenes() {
        for half in [0.0, 1e-6, 0.05, 0.4, 2.0] {
            let left = assert_same(&scene, &camera([0.3, 0.2, -4.0], [0.3, 0.2, 0.0], half));
            assert_eq!(left[2], 0, "all share their origin");
            assert_same(&scene, &camera([0.11, -0.2, 0.05], [0.2, 0.1, 1.0], half));
            assert_same(&scene, &camera([0.25, 0.5, 0.0], [0.25, 0.5, -1.0], half));
        }
    }
}

#[test]
fn rays_within_one_octant_are_all_taken() {
    for scene in scenes() {
        let left = assert_same(&scene, &camera([-3.0, -3.0, -4.0], [0.0, 0.0, 0.0], 0.8));
        assert_eq!(left, [0, 0, 0]);
    }
}

#[test]
fn parallel_rays_hit_what_single_rays_do() {
    for scene in scenes() {
        for direction in [[0.0, 0.0, 1.0], [-0.0, 2.0, 0.0], [0.3, -0.2, 1.0], [-7.0, 0.0, 1e-9]] {
            let origins = camera([0.0; 3], [0.0, 0.0, -0.3], 1.0);
            let rays: Vec<Ray> =
                origins.iter().map(|ray| Ray::new(ray.direction, direction)).collect();
            assert_eq!(assert_same(&scene, &rays), [0, 0, 0]);
        }
    }
}

#[test]
fn shadow_rays_are_bounded_from_the_light() {
    let light = [0.7, 1.9, 0.3];
    for scene in scenes() {
        let places = camera([0.3, 0.2, -4.0], [0.3, 0.2, 0.0], 0.8);
        let rays: Vec<Ray> = places
            .iter()
            .filter_map(|ray| Some(ray.at(scene.closest_hit(ray)?.t)))
            .map(|place| Ray::through(place, light).with_interval(1e-9, 1.0))
            .collect();
        assert_same(&scene, &rays);
        let mut counters = PacketCounters::default();
        scene.packets(PacketKind::Frustum).any_hits(&rays, &mut counters);
        assert_eq!(counters.left, 0);
    }
}

#[test]
fn what_stands_at_the_light_is_hit() {
    for scene in scenes() {
        for corner in [0, 1] {
            let light = scene.primitives().corners(0)[corner].map(f64::from);
            let places = camera([0.0; 3], [0.3, 0.2, -2.0], 1.5);
            let rays = places.iter().map(|ray| Ray::through(ray.direction, light));
            let rays: Vec<Ray> = rays.map(|ray| ray.with_interval(1.0 - 1e-12, 1.0)).collect();
            assert_same(&scene, &rays);
            assert!(scene.packets(PacketKind::Frustum).any_hits(&rays, &mut ()).contains(&true));
        }
    }
}

#[test]
fn rays_in_split_planes_and_through_corners_lose_no_hit() {
    for scene in scenes() {
        let corners = (0..40).map(|i| {
            scene.primitives().corners(i % scene.primitives().triangles().len() as u32)[0]
        });
        let origin = [0.0, 0.25, -2.0];
        let at_corners: Vec<Ray> =
            corners.clone().map(|p| Ray::through(origin, p.map(f64::from))).collect();
        assert_same(&scene, &at_corners);
        let along: Vec<Ray> = corners
            .map(|p| Ray::new([f64::from(p[0]), f64::from(p[1]), -3.0], [0.0, 0.0, 1.0]))
            .collect();
        assert_same(&scene, &along);
    }
}

#[test]
fn any_rays_get_their_answer() {
    let mut random = Pcg64::seed_from_u64(7);
    for scene in scenes() {
        let rays: Vec<Ray> = (0..300)
            .map(|i| {
                let mut point = || [0; 3].map(|_| random.random_range(-1.5..1.5_f64));
                let (origin, mut direction) = (point(), point());
                if i % 3 == 0 {
                    direction[i % 2] = if i % 2 == 0 { 0.0 } else { -0.0 };
                }
                let ray = Ray::new(origin, direction);
                match i % 7 {
                    0 => ray.with_interval(f64::NEG_INFINITY, f64::INFINITY),
                    1 => ray.with_interval(0.5, 0.1),
                    2 => ray.with_interval(0.2, 1.0),
                    _ => ray,
                }
            })
            .collect();
        assert_same(&scene, &rays);
    }
}

#[test]
fn dead_rays_widen_no_bounds() {
    let scene = &scenes()[3];
    let mut rays = camera([0.3, 0.2, -4.0], [0.3, 0.2, 0.0], 0.1);
    let frusta = |rays: &[Ray]| {
        let mut seen = PacketRecorder::default();
        scene.packets(PacketKind::Frustum).closest_hits(rays, &mut seen);
        assert!(!seen.steps.iter().any(|step| matches!(step, PacketStep::Left(_))));
        let steps = seen.steps.into_iter();
        steps.filter(|step| matches!(step, PacketStep::Frustum(_))).collect::<Vec<_>>()
    };
    (rays[0], rays[1]) = (rays[2], rays[2]);
    let narrow = frusta(&rays);
    rays[0] = Ray::new([f64::NAN; 3], [1.0; 3]);
    rays[1] = Ray::new(rays[1].origin, [1.0, 0.0, 0.0]);
    assert_same(scene, &rays);
    assert_eq!(frusta(&rays), narrow);
}

#[test]
fn opposite_rays_are_left_and_answered() {
    let scene = &scenes()[3];
    let mut rays = camera([0.0; 3], [0.1, 0.2, 1.0], 0.05);
    let back: Vec<Ray> =
        rays.iter().step_by(2).map(|ray| Ray::new([0.0; 3], ray.direction.map(|d| -d))).collect();
    let count = back.len();
    for (ray, back) in rays.iter_mut().skip(1).step_by(2).zip(back) {
        *ray = back;
    }
    let left = assert_same(scene, &rays);
    assert_eq!(left[1..], [count as u64; 2]);
}

#[test]
fn balls_are_culled_by_their_boxes() {
    let balls = (0..200_i16).map(|i| {
        let at = |k: i16| f32::from(i * k % 41) / 20.0 - 1.0;
        ([at(7), at(11), at(13)], 0.06)
    });
    let balls = Balls::new(balls.collect()).unwrap();
    let options = BuildOptions { leaf_size: 20, ..BuildOptions::for_strategy(Strategy::Middle) };
    let scene = ShapeScene::build(balls, &options).unwrap();
    let rays = camera([0.3, 0.2, -4.0], [0.3, 0.2, 0.0], 0.5);
    assert_same(&scene, &rays);
    let mut counters = PacketCounters::default();
    scene.packets(PacketKind::Frustum).closest_hits(&rays, &mut counters);
    assert!(counters.culled > 0, "{counters:?}");
}

#[test]
fn what_a_frustum_culls_is_hit_by_none_of_its_rays() {
    for scene in &scenes()[..8] {
        for half in [0.02, 0.3] {
            let rays = camera([0.3, 0.2, -4.0], [0.3, 0.2, 0.0], half);
            let mut seen = PacketRecorder::default();
            scene.packets(PacketKind::Frustum).closest_hits(&rays, &mut seen);
            let mesh = scene.primitives();
            let frusta = seen.steps.iter().filter_map(|step| match step {
                PacketStep::Frustum(frustum) => Some(frustum),
                _ => None,
            });
            let mut missed = 0;
            for (frustum, rays) in frusta.zip(rays.chunks(32)) {
                for id in (0..mesh.triangles().len() as u32).filter(|&id| mesh.misses(id, frustum))
                {
                    missed += 1;
                    for ray in rays {
                        let hit = intersect_triangle(&mesh.corners(id), id, ray, HitRule::Touching);
                        assert_eq!(hit, None);
                    }
                }
            }
            assert!(missed > 300, "a narrow frustum misses most: {missed}");
        }
    }
}

#[test]
fn the_steps_show_what_the_counters_count() {
    let scene = &scenes()[3];
    let rays = camera([0.3, 0.2, -4.0], [0.3, 0.2, 0.0], 0.3);
    for kind in PacketKind::ALL {
        let (mut counters, mut seen) = (PacketCounters::default(), PacketRecorder::default());
        scene.packets(kind).closest_hits(&rays, &mut counters);
        scene.packets(kind).closest_hits(&rays, &mut seen);
        let count =
            |is: fn(&PacketStep) -> bool| seen.steps.iter().filter(|step| is(step)).count() as u64;
        assert_eq!(count(|step| matches!(step, PacketStep::Packet(_))), counters.packets);
        assert_eq!(count(|step| matches!(step, PacketStep::Split(_))), counters.decisions);
        assert_eq!(count(|step| matches!(step, PacketStep::Leaf(_))), counters.leaves);
        assert_eq!(count(|step| matches!(step, PacketStep::Culled(_))), counters.culled);
        assert_eq!(count(|step| matches!(step, PacketStep::SetUp(_))), counters.set_ups);
        assert_eq!(count(|step| matches!(step, PacketStep::Test { .. })), counters.tests);
        assert_eq!(count(|step| matches!(step, PacketStep::Left(_))), counters.left);
    }
}

#[test]
fn larger_packets_ask_fewer_nodes() {
    let scene = &scenes()[3];
    let rays = camera([-3.0, -3.0, -4.0], [0.0, 0.0, 0.0], 0.1);
    for kind in [PacketKind::Interval, PacketKind::Frustum] {
        let decisions = [8, 64, 256].map(|size| {
            let mut counters = PacketCounters::default();
            scene.packets(kind).with_size(size).closest_hits(&rays, &mut counters);
            counters.decisions
        });
        assert!(decisions[0] > decisions[1] && decisions[1] > decisions[2], "{decisions:?}");
    }
}
