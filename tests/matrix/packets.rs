//! Packets: each kind, on rays that have nothing in common and on bundles that have.

use crate::cases::{Aimed, Case};
use crate::checks::{in_split_planes, same};
use kdray::traverse::{Cull, PacketKind};
use kdray::{BuildOptions, Ray, ShapeScene};
use kdray_tests::Subject;
use kdray_tests::bundles::bundles;
use kdray_tests::rays::random;

/// Around every so manieth ray there are bundles.
const BETWEEN_BUNDLES: usize = 6;

/// Builds a tree over each case and checks its rays in packets, as they come, against the answers
/// without a tree; and bundles around some of them, against the single traversal.
pub(crate) fn on_each<S: Subject<3> + Cull + Clone + Send + Sync>(
    options: &BuildOptions,
    cases: &[Case<S, 3>],
    kind: PacketKind,
) {
    for case in cases {
        let scene = ShapeScene::build(case.subject.clone(), options).expect("cases are valid");
        let in_planes = in_split_planes(case, scene.tree());
        let aimed: Vec<_> = case.aimed.iter().chain(&in_planes).collect();
        let checked = as_they_come(&scene, &aimed, kind)
            .and_then(|()| in_bundles(&scene, &aimed, kind, case.seed));
        if let Err(error) = checked {
            panic!("case {:?}, {error}", case.name);
        }
    }
}

fn as_they_come<S: Subject<3> + Cull>(
    scene: &ShapeScene<S, 3>,
    aimed: &[&Aimed<3>],
    kind: PacketKind,
) -> Result<(), String> {
    let rays: Vec<Ray> = aimed.iter().map(|aimed| aimed.ray).collect();
    let packets = scene.packets(kind);
    let (closest, any) = (packets.closest_hits(&rays, &mut ()), packets.any_hits(&rays, &mut ()));
    for ((aimed, closest), any) in aimed.iter().zip(closest).zip(any) {
        let told = |error| format!("{:?}: {error}", aimed.ray);
        same(&closest, &aimed.touched.naive.first().copied()).map_err(told)?;
        same(&any, &!aimed.touched.naive.is_empty()).map_err(told)?;
    }
    Ok(())
}

fn in_bundles<S: Subject<3> + Cull>(
    scene: &ShapeScene<S, 3>,
    aimed: &[&Aimed<3>],
    kind: PacketKind,
    seed: u64,
) -> Result<(), String> {
    let mut random = random(seed);
    for aimed in aimed.iter().step_by(BETWEEN_BUNDLES) {
        for rays in bundles(&aimed.ray, scene.tree().bounds(), &mut random) {
            let packets = scene.packets(kind);
            let (closest, any) =
                (packets.closest_hits(&rays, &mut ()), packets.any_hits(&rays, &mut ()));
            for ((ray, closest), any) in rays.iter().zip(closest).zip(any) {
                let told = |error| format!("{ray:?} in a bundle around {:?}: {error}", aimed.ray);
                same(&closest, &scene.closest_hit(ray)).map_err(told)?;
                same(&any, &scene.any_hit(ray)).map_err(told)?;
            }
        }
    }
    Ok(())
}
