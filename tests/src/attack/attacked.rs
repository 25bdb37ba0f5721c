//! The one thing that is not asked of both precisions.

use super::answers::Said;
use kdray::traverse::PacketKind;
use kdray::{Precision, Ray, Scene};

/// A precision whose meshes are attacked.
pub trait Attacked: Precision {
    /// What the packets that can be watched say. There are none at f64 meshes: their frustums are compared with
    /// triangles in the tree's own coordinates, which are f32.
    fn in_watched_packets(_: &Scene<Self>, _: &[Ray], _: &mut dyn FnMut(&str, Said)) {}
}

impl Attacked for f32 {
    fn in_watched_packets(scene: &Scene, rays: &[Ray], add: &mut dyn FnMut(&str, Said)) {
        for kind in PacketKind::ALL {
            let packets = scene.shapes().packets(kind);
            let closest = packets.closest_hits(rays, &mut ());
            add(&format!("watched {kind:?}, closest hit"), Said::Closest(closest));
            let any = packets.any_hits(rays, &mut ());
            add(&format!("watched {kind:?}, any hit"), Said::Any(any));
        }
    }
}

impl Attacked for f64 {}
