//! Files that were made to deceive: their checksums are right.

mod saved_common;

use kdray::geometry::RayPacket;
use kdray::layout::WideError;
use kdray::primitives::HitArrays;
use kdray::tree::TreeError;
use kdray::{Arithmetic, FileError, Hit, InstructionSet, MeshError, Precision, Ray, Scene};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use saved_common::Section::{Above, Homes, Lines, Nodes, References, Triangles, Vertices};
use saved_common::{Forgery, Section, soup_in_f64};

/// Words of a wide node: those of its planes, links and orders.
const PLANES: usize = 0;
const LINKS: usize = 48;
const ORDERS: usize = 56;

fn rays(count: usize, seed: u64) -> Vec<Ray> {
    let mut random = Pcg64::seed_from_u64(seed);
    let mut point = |from: f64, to: f64| [0; 3].map(|_| random.random_range(from..to));
    (0..count).map(|_| Ray::through(point(-1.0, 2.0), point(0.0, 1.0))).collect()
}

/// The error of opening a file. To load it is an error, too.
fn refused(forgery: &Forgery) -> FileError {
    assert!(Scene::<f32>::load(forgery.sealed()).is_err());
    Scene::<f32>::open(forgery.sealed()).expect_err("it is refused")
}

/// The error of verifying a file that can be opened.
fn found(forgery: &Forgery) -> FileError {
    found_in::<f32>(forgery)
}

fn found_in<T: Precision>(forgery: &Forgery) -> FileError {
    let opened = Scene::<T>::open(forgery.sealed()).unwrap_or_else(|error| panic!("{error}"));
    for set in InstructionSet::available() {
        ask_everything(&opened.clone().with_instructions(set), &rays(50, 1));
    }
    let error = opened.verify().expect_err("it is wrong");
    assert_eq!(Scene::<T>::load(forgery.sealed()).err(), Some(error));
    error
}

/// Asks a scene all that can be asked. The closest hits.
fn ask_everything<T: Precision>(scene: &Scene<T>, rays: &[Ray]) -> Vec<Option<Hit>> {
    let float = scene.clone().with_arithmetic(Arithmetic::Float);
    let (mut hits, mut found) = (vec![None; rays.len()], vec![false; rays.len()]);
    let mut hints = Vec::new();
    for ray in rays {
        let _ = (scene.closest_hit(ray), scene.any_hit(ray));
        let _ = (float.closest_hit(ray), float.any_hit(ray));
        let _ = (scene.shapes().closest_hit(ray), scene.shapes().occluder(ray));
        for hit in scene.all_hits(ray).chain(scene.all_touched(ray)).take(1000) {
            scene.mesh().corners(hit.primitive_id);
        }
        let mut all = Vec::new();
        scene.all_hits_into(ray, &mut all);
        let _ = (scene.count(ray), scene.closest_hit_where(ray, |hit| hit.u > 0.5));
        ask_about_points(scene, ray);
        let hit = scene.closest_hit_with_hint(ray);
        hints.push(hit.map(|(_, hint)| hint).unwrap_or_default());
    }
    for scene in [&float, scene] {
        scene.closest_hits(rays, &mut hits);
        scene.any_hits(rays, &mut found);
        scene.any_hits_near(rays, &hints, &mut found);
        for hit in hits.iter().flatten() {
            scene.mesh().corners(hit.primitive_id);
        }
    }
    ask_in_packets(scene);
    hits
}

/// Asks about the points where a ray begins and where it is at t = 1.
fn ask_about_points<T: Precision>(scene: &Scene<T>, ray: &Ray) {
    let end = [0, 1, 2].map(|k| ray.origin[k] + ray.direction[k]);
    for point in [ray.origin, end] {
        let _ = (scene.contains(point), scene.signed_distance(point), scene.winding_number(point));
        if let Some(nearest) = scene.closest_point(point) {
            let id = nearest.primitive_id;
            let _ = scene.thickness(id, nearest.u, nearest.v, kdray::Side::Front);
        }
    }
    let _ = scene.visible(ray.origin, end);
}

/// Asks for rays that go together.
fn ask_in_packets<T: Precision>(scene: &Scene<T>) {
    let origin = [0.5, 0.5, -2.0];
    let row = |f: fn(i32) -> i32| (0..256).map(|i| 0.04 * f64::from(f(i)) - 0.3).collect();
    let (x, y, z): (Vec<_>, Vec<_>, _) = (row(|i| i % 16), row(|i| i / 16), [1.0; 256]);
    let packet = RayPacket::from(origin, [&x, &y, &z]);
    let (mut hits, mut found) = (HitArrays::default(), vec![false; packet.len()]);
    scene.packet_closest_hits(&packet, &mut hits);
    scene.packet_any_hits(&packet, &mut found);
    for hit in (0..packet.len()).filter_map(|i| hits.get(i)) {
        scene.mesh().corners(hit.primitive_id);
    }
}

#[test]
fn counts_that_are_not_true_take_no_memory() {
    let honest = Forgery::of(40);
    for section in Section::ALL {
        for count in [0, 1, u64::MAX, u64::MAX / 64, 1 << 40, honest.count(section) + 100] {
            if count == honest.count(section) {
                continue;
            }
            let mut forgery = honest.clone();
            forgery.set_count(section, count);
            let error = refused(&forgery);
            let is_named = matches!(error, FileError::Length { .. } | FileError::BadHeader(_));
            assert!(is_named || count <= 1, "{section:?} {count}: {error}");
        }
    }
}

#[test]
fn headers_that_contradict_themselves_are_named() {
    let with = |place: usize, word: u32| {
        let mut forgery = Forgery::of(40);
        forgery.bytes[place..place + 4].copy_from_slice(&word.to_le_bytes());
        refused(&forgery)
    };
    assert_eq!(with(8, 2), FileError::Version(2));
    assert_eq!(with(12, 64), FileError::Precision { found: 64, expected: 32 });
    assert!(matches!(with(12, 16), FileError::BadHeader(_)), "the bits of a coordinate");
    assert!(matches!(with(104, 2), FileError::BadHeader(_)), "whether there is a wide tree");
    assert!(matches!(with(104, 0), FileError::BadHeader(_)), "there is one");
    assert!(matches!(with(200, 1), FileError::BadHeader(_)), "a word that means nothing");
    assert_eq!(with(80, f32::NAN.to_bits()), FileError::Tree(TreeError::BadBounds));
    assert_eq!(with(92, f32::INFINITY.to_bits()), FileError::Tree(TreeError::BadBounds));
    assert_eq!(with(92, 1e30_f32.to_bits()), FileError::Wide(WideError::OutOfRange));
}

#[test]
fn meshes_that_could_not_be_built_over_are_refused() {
    let honest = || Forgery::of(40);
    let error = refused(&honest().with_word(Triangles, 5, 1000));
    assert!(matches!(error, FileError::Mesh(MeshError::IndexOutOfRange { triangle: 1, .. })));
    for bad in [f32::NAN, f32::INFINITY] {
        let error = refused(&honest().with_float(Vertices, 4, bad));
        assert!(matches!(error, FileError::Mesh(MeshError::NonFiniteVertex { vertex: 1, .. })));
    }
}

#[test]
fn links_of_the_canonical_tree_that_lead_elsewhere_are_refused() {
    let honest = Forgery::of(300);
    let root = honest.word(Nodes, 1);
    let mut seen = Vec::new();
    // The root's upper child is itself, its lower one, the next, the one behind the last, and none.
    for above in [0, 1, 2, (root >> 2) + 1, honest.count(Nodes) as u32, (1 << 30) - 1] {
        let error = refused(&honest.clone().with_word(Nodes, 1, above << 2 | root & 3));
        let FileError::Tree(error) = error else { panic!("{error}") };
        seen.push(error);
    }
    assert!(seen.iter().all(|it| matches!(it, TreeError::NotDepthFirst { .. })), "{seen:?}");
    // A leaf in its place, and an inner node in that of the last leaf.
    let error = refused(&honest.clone().with_word(Nodes, 1, 3).with_word(Nodes, 0, 0));
    assert!(matches!(error, FileError::Tree(TreeError::UnreachedNodes { reached: 1, .. })));
    let last = honest.words(Nodes) - 1;
    let error = refused(&honest.clone().with_word(Nodes, last, 0));
    assert!(matches!(error, FileError::Tree(TreeError::ChildOutOfRange { .. })), "{error}");
}

#[test]
fn lists_that_name_what_is_not_there_are_refused() {
    let honest = Forgery::of(40);
    let error = refused(&honest.clone().with_word(References, 3, 40));
    assert!(matches!(error, FileError::Tree(TreeError::NoSuchPrimitive { primitive: 40, .. })));
    let leaf = (0..honest.words(Nodes) / 2).find(|i| honest.word(Nodes, 2 * i + 1) & 3 == 3);
    let leaf = leaf.expect("there is a leaf");
    let error = refused(&honest.clone().with_word(Nodes, 2 * leaf + 1, u32::MAX));
    assert!(matches!(error, FileError::Tree(TreeError::ListOutOfRange { .. })), "{error}");
    let error = refused(&honest.clone().with_word(Nodes, 2 * leaf, 1));
    assert!(matches!(error, FileError::Tree(TreeError::ListsDoNotTile { .. })), "{error}");
}

#[test]
fn a_chain_deeper_than_the_stacks_is_refused() {
    let mut forgery = Forgery::of(3000);
    let nodes = forgery.count(Nodes) as usize;
    assert!(nodes > 140);
    for index in 0..70 {
        forgery = forgery.with_word(Nodes, 2 * index + 1, (nodes as u32 - 1) << 2);
    }
    let error = refused(&forgery);
    assert!(matches!(error, FileError::Tree(TreeError::TooDeep { .. })), "{error}");
}

/// Cells without extent can be as many as a file holds, and each primitive in their plane lies in all of them.
#[test]
fn planes_in_the_faces_of_their_cells_are_refused() {
    let honest = Forgery::of(300);
    let axis = (honest.word(Nodes, 1) & 3) as usize;
    for face in [80 + 4 * axis, 92 + 4 * axis] {
        let bound = honest.bytes[face..face + 4].try_into().expect("four bytes");
        let error = found(&honest.clone().with_word(Nodes, 0, u32::from_le_bytes(bound)));
        let is_named = matches!(error, FileError::Tree(TreeError::SplitOutsideCell { .. }));
        assert!(is_named, "{error}");
    }
}

#[test]
fn links_of_the_wide_tree_that_lead_elsewhere_are_refused() {
    let honest = Forgery::of(300);
    let node = |place: usize, link: u32| {
        let error = refused(&honest.clone().with_word(Lines, LINKS + place, link));
        let FileError::Wide(error) = error else { panic!("{error}") };
        error
    };
    let first = honest.word(Lines, LINKS);
    assert_ne!(first, 0);
    let lines = honest.count(Lines) as u32;
    // Without its first child; one line on; behind the end; a leaf without blocks; none at all.
    assert_eq!(node(0, 0), WideError::BoxWithoutChild { line: 0 });
    let not_here = WideError::NotDepthFirst { line: 4 };
    assert_eq!(node(0, first + 1), not_here);
    assert_eq!(node(0, lines), not_here);
    assert_eq!(node(0, (1 << 28) - 1), not_here);
    assert_eq!(node(0, 1 << 31), WideError::EmptyLeaf { line: 0 });
    assert!(matches!(node(0, u32::MAX), WideError::NotDepthFirst { .. }));
    // Twice the same child, and a child that is its parent's parent.
    let second = node(1, first);
    assert!(matches!(second, WideError::NotDepthFirst { .. }), "{second}");
}

#[test]
fn nodes_that_kernels_would_trip_over_are_refused() {
    let honest = Forgery::of(300);
    for order in [0, 0x7654_3211, 0xf654_3210, 0x8654_3210] {
        let error = refused(&honest.clone().with_word(Lines, ORDERS + 3, order));
        assert_eq!(error, FileError::Wide(WideError::BadOrder { line: 0 }));
    }
    let root_home =
        |word: usize, value: u32| refused(&honest.clone().with_word(Homes, word, value));
    for word in [0, 3, 4, 7] {
        assert_eq!(root_home(word, 1), FileError::Wide(WideError::BadHome { line: 0 }));
    }
    for parent in [1, 2, 1000] {
        // Word 3 of the second home: it would be its own parent, or one behind it.
        let error = refused(&honest.clone().with_word(Homes, 8 + 3, parent));
        assert!(matches!(error, FileError::Wide(WideError::BadHome { .. })), "{error}");
    }
    // A block's ids stand behind its 72 coordinates.
    let leaf = (0..8).find(|place| honest.word(Lines, LINKS + place) >> 31 == 1);
    if let Some(leaf) = leaf {
        let line = honest.word(Lines, LINKS + leaf) & ((1 << 28) - 1);
        let error = refused(&honest.clone().with_word(Lines, 16 * line as usize + 72, 300));
        assert_eq!(error, FileError::Wide(WideError::NoSuchTriangle { line: line as usize }));
    }
}

#[test]
fn whatever_would_change_a_hit_is_found() {
    let honest = Forgery::of(300);
    assert_eq!(Scene::<f32>::load(honest.sealed()).err(), None);
    let wide = |forgery: Forgery| match found(&forgery) {
        FileError::Wide(error) => error,
        error => panic!("{error}"),
    };
    let planes = |word: usize, x: f32| honest.clone().with_float(Lines, PLANES + word, x);
    // Lower and upper plane of the root's first child on the x axis.
    for (word, x) in [(0, 0.9), (0, f32::NAN), (8, -0.1), (8, f32::NAN), (8, f32::NEG_INFINITY)] {
        let error = wide(planes(word, x));
        assert!(matches!(error, WideError::BoxTooSmall { .. }), "{word} {x}: {error}");
    }
    let swapped = honest.word(Lines, ORDERS).rotate_left(4);
    let order = wide(honest.clone().with_word(Lines, ORDERS, swapped));
    assert!(matches!(order, WideError::NotTheTrees { line: 0 }), "{order}");
    let home = wide(honest.clone().with_float(Homes, 8, -5.0));
    assert!(matches!(home, WideError::BadHome { .. }), "{home}");
    assert_eq!(wide(honest.clone().with_word(Above, 1, 77_777)), WideError::WrongNodeAbove);
    // A vertex that is moved leaves the blocks and perhaps the canonical tree behind.
    let x = f32::from_bits(honest.word(Vertices, 0));
    let moved = found(&honest.clone().with_float(Vertices, 0, x + 1e-6));
    assert!(matches!(moved, FileError::Wide(_) | FileError::Tree(_)), "{moved}");
    let split = f32::from_bits(honest.word(Nodes, 0));
    let moved = found(&honest.clone().with_float(Nodes, 0, split + 0.01));
    assert!(matches!(moved, FileError::Tree(_)), "{moved}");
}

/// The same for vertices in f64, of which blocks hold rounded copies.
#[test]
fn whatever_would_change_a_hit_in_f64_is_found() {
    let honest = Forgery::of_mesh(soup_in_f64(300, |x| x / 3.0));
    assert_eq!(Scene::<f64>::load(honest.sealed()).err(), None);
    for (word, x) in [(PLANES, 3.0), (PLANES + 8, -3.0), (PLANES, f32::NAN)] {
        let error = found_in::<f64>(&honest.clone().with_float(Lines, word, x));
        assert!(matches!(error, FileError::Wide(WideError::BoxTooSmall { .. })), "{error}");
    }
    // The last block ends the arena. Its first lane is one with a triangle.
    let last = honest.words(Lines) - 80;
    let x = f32::from_bits(honest.word(Lines, last));
    let error = found_in::<f64>(&honest.clone().with_float(Lines, last, x.next_up()));
    assert!(matches!(error, FileError::Wide(WideError::NotTheLeafs { .. })), "{error}");
    let home = found_in::<f64>(&honest.clone().with_float(Homes, 8, -5.0));
    assert!(matches!(home, FileError::Wide(WideError::BadHome { .. })), "{home}");
    // The mesh is larger, and with it the tree's coordinates are others.
    let far =
        found_in::<f64>(&honest.clone().with_word(Vertices, 1, (100.0_f64.to_bits() >> 32) as u32));
    assert!(matches!(far, FileError::Wide(_) | FileError::Tree(_)), "{far}");
    let bad = honest.clone().with_word(Vertices, 1, (f64::INFINITY.to_bits() >> 32) as u32);
    let error = Scene::<f64>::open(bad.sealed()).err();
    assert!(matches!(error, Some(FileError::Mesh(MeshError::NonFiniteVertex { .. }))), "{error:?}");
}

/// Each box of the file, each coordinate, link and id is made another, one by one.
#[test]
fn no_word_can_be_changed_without_being_found_or_changing_nothing() {
    let rays = rays(20, 2);
    change_every_word::<f32>(&Forgery::of(25), &rays);
    // Rays that hit the same triangles a third as large.
    let scaled = rays.iter().map(|ray| Ray {
        origin: ray.origin.map(|x| x / 3.0),
        direction: ray.direction.map(|x| x / 3.0),
        interval: ray.interval,
    });
    let in_f64 = Forgery::of_mesh(soup_in_f64(9, |x| x / 3.0));
    change_every_word::<f64>(&in_f64, &scaled.collect::<Vec<_>>());
}

fn change_every_word<T: Precision>(honest: &Forgery, rays: &[Ray]) {
    let mut found = 0;
    for section in Section::ALL {
        for index in 0..honest.words(section) {
            let word = honest.word(section, index);
            let others = [word ^ 1, word.wrapping_add(7), word ^ 1 << 31, 0, u32::MAX];
            for other in others.into_iter().filter(|&other| other != word) {
                let forgery = honest.clone().with_word(section, index, other);
                found += usize::from(!is_right_or_refused::<T>(&forgery, rays));
            }
        }
    }
    assert!(found > 1000, "{found} were refused");
}

/// Several words at a time, some of which are made of others.
#[test]
fn no_forgery_panics_hangs_or_passes() {
    forge::<f32>(&Forgery::of(120), 5000);
    forge::<f64>(&Forgery::of_mesh(soup_in_f64(60, |x| x)), 1500);
}

fn forge<T: Precision>(honest: &Forgery, times: usize) {
    let mut random = Pcg64::seed_from_u64(3);
    let rays = rays(12, 4);
    let mut opened = 0;
    for _ in 0..times {
        let mut forgery = honest.clone();
        // In vertices and lines mostly: elsewhere nearly all is refused at once.
        let section =
            [Vertices, Lines, Lines, Lines, Above, Nodes, Homes][random.random_range(0..7)];
        for _ in 0..random.random_range(1..20) {
            let index = random.random_range(0..honest.words(section));
            let special =
                [0, 1, u32::MAX, f32::NAN.to_bits(), f32::INFINITY.to_bits(), 0xff80_0000];
            let word = match random.random_range(0..3) {
                0 => special[random.random_range(0..special.len())],
                1 => honest.word(section, random.random_range(0..honest.words(section))),
                _ => honest.word(section, index).wrapping_add(random.random_range(0..9) << 12),
            };
            forgery = forgery.with_word(section, index, word);
        }
        opened += usize::from(Scene::<T>::open(forgery.sealed()).is_ok());
        is_right_or_refused::<T>(&forgery, &rays);
    }
    assert!(opened > times / 30, "{opened} were opened");
}

/// Whether a forgery passes the verification, in which case its hits are right. If it can be opened, it
/// is asked everything in any case: by one instruction set, which its bytes choose.
fn is_right_or_refused<T: Precision>(forgery: &Forgery, rays: &[Ray]) -> bool {
    let Ok(opened) = Scene::<T>::open(forgery.sealed()) else {
        assert!(Scene::<T>::load(forgery.sealed()).is_err());
        return false;
    };
    let sets = InstructionSet::available();
    let sum: usize = forgery.bytes.iter().map(|&byte| usize::from(byte)).sum();
    let opened = opened.with_instructions(sets[sum % sets.len()]);
    let hits = ask_everything(&opened, rays);
    let is_right = opened.verify().is_ok();
    if is_right {
        let naive: Vec<_> =
            rays.iter().map(|ray| opened.shapes().naive().closest_hit(ray)).collect();
        assert_eq!(hits, naive);
    }
    is_right
}
