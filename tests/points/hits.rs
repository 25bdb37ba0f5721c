//! Hits one by one, against lists of all.

use super::*;

#[test]
fn hits_go_on_after_any_of_them() {
    hits_go_on(awkward_meshes());
    hits_go_on(awkward_meshes_in_f64());
}

fn hits_go_on<T: Precision>(meshes: Vec<(&str, TriangleMesh<T>)>) {
    for (name, mesh) in meshes {
        let scene = scene(mesh.clone());
        for ray in Archer::new(&mesh, 71).all_kinds(6, 10.0) {
            let (crossed, touched): (Vec<_>, Vec<_>) =
                (scene.all_hits(&ray).collect(), scene.all_touched(&ray).collect());
            for (i, hit) in crossed.iter().enumerate() {
                let rest: Vec<_> = scene.all_hits_after(&ray, hit).collect();
                assert_eq!(rest, crossed[i + 1..], "{name} {ray:?}");
            }
            for (i, hit) in touched.iter().enumerate() {
                let rest: Vec<_> = scene.all_touched_after(&ray, hit).collect();
                assert_eq!(rest, touched[i + 1..], "{name} {ray:?}");
            }
        }
    }
}

#[test]
fn the_first_hit_of_those_that_are_kept() {
    first_hits_are_kept(awkward_meshes());
    first_hits_are_kept(awkward_meshes_in_f64());
}

fn first_hits_are_kept<T: Precision>(meshes: Vec<(&str, TriangleMesh<T>)>) {
    for (name, mesh) in meshes {
        let scene = scene(mesh.clone());
        for ray in Archer::new(&mesh, 72).all_kinds(6, 10.0) {
            let all = scene.shapes().naive().all_hits(&ray, HitRule::Touching);
            let keeps: [fn(&Hit) -> bool; 4] = [
                |_| true,
                |_| false,
                |hit| hit.primitive_id % 3 == 1,
                |hit| hit.side == Side::Front && hit.t > 0.5,
            ];
            for keep in keeps {
                let expected = all.iter().copied().find(keep);
                let mut asked = Vec::new();
                let found = scene.closest_hit_where(&ray, |hit| {
                    asked.push(*hit);
                    keep(hit)
                });
                assert_eq!(found, expected, "{name} {ray:?}");
                assert_eq!(asked, all[..asked.len()], "{name} {ray:?}");
                assert_eq!(scene.any_hit_where(&ray, keep), expected.is_some());
            }
        }
    }
}
