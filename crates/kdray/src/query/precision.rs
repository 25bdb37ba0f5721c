//! The precision of a scene's vertices, and what is compiled for each.

use super::Scene;
use crate::build::{BuildError, BuildOptions, BuildProgress};
use crate::geometry::{Coordinate, Ray, RayPacket};
use crate::layout::{Hint, WideError, WideTree};
use crate::primitives::{ClosestPoint, Closure, Hit, HitArrays, Side, TriangleMesh};
use crate::traverse::wide::packet::PacketWork;
use crate::tree::TreeError;
use std::ops::ControlFlow;

/// What may be told how far a build is.
type Progress<'a> = &'a (dyn Fn(BuildProgress) -> ControlFlow<()> + Sync);

/// The precision of a [`Scene`]'s vertices: f32 or f64. Nothing else can be one.
///
/// Its methods are those of the scene. They are here so that the builders and the kernels are compiled once
/// for each precision, in this crate, and not anew in each that uses scenes.
pub trait Precision: Coordinate {
    #[doc(hidden)]
    fn build(
        mesh: TriangleMesh<Self>,
        options: &BuildOptions,
        progress: Progress<'_>,
    ) -> Result<Scene<Self>, BuildError>;
    #[doc(hidden)]
    fn closest_hit(scene: &Scene<Self>, ray: &Ray) -> Option<Hit>;
    #[doc(hidden)]
    fn any_hit(scene: &Scene<Self>, ray: &Ray) -> bool;
    #[doc(hidden)]
    fn all_hits_into(scene: &Scene<Self>, ray: &Ray, hits: &mut Vec<Hit>);
    #[doc(hidden)]
    fn crossed(scene: &Scene<Self>, ray: &Ray) -> Vec<u32>;
    #[doc(hidden)]
    fn counts(scene: &Scene<Self>, rays: &[Ray], counts: &mut [usize]);
    #[doc(hidden)]
    fn closest_hit_with_hint(scene: &Scene<Self>, ray: &Ray) -> Option<(Hit, Hint)>;
    #[doc(hidden)]
    fn any_hit_near(scene: &Scene<Self>, ray: &Ray, hint: Hint) -> bool;
    #[doc(hidden)]
    fn closest_hits(scene: &Scene<Self>, rays: &[Ray], hits: &mut [Option<Hit>]);
    #[doc(hidden)]
    fn any_hits(scene: &Scene<Self>, rays: &[Ray], found: &mut [bool]);
    #[doc(hidden)]
    fn any_hits_near(scene: &Scene<Self>, rays: &[Ray], hints: &[Hint], found: &mut [bool]);
    #[doc(hidden)]
    fn packet_closest_hits(
        scene: &Scene<Self>,
        packet: &RayPacket<'_>,
        hits: &mut HitArrays,
    ) -> PacketWork;
    #[doc(hidden)]
    fn packet_any_hits(
        scene: &Scene<Self>,
        packet: &RayPacket<'_>,
        found: &mut [bool],
    ) -> PacketWork;
    #[doc(hidden)]
    fn closest_point(scene: &Scene<Self>, point: [f64; 3]) -> Option<ClosestPoint>;
    #[doc(hidden)]
    fn contains(scene: &Scene<Self>, point: [f64; 3]) -> bool;
    #[doc(hidden)]
    fn contains_each(scene: &Scene<Self>, points: &[[f64; 3]], inside: &mut [bool]);
    #[doc(hidden)]
    fn signed_distance(scene: &Scene<Self>, point: [f64; 3]) -> Option<f64>;
    #[doc(hidden)]
    fn winding_number(scene: &Scene<Self>, point: [f64; 3]) -> f64;
    #[doc(hidden)]
    fn closure(mesh: &TriangleMesh<Self>) -> Closure;
    #[doc(hidden)]
    fn visible(scene: &Scene<Self>, from: [f64; 3], to: [f64; 3]) -> bool;
    #[doc(hidden)]
    fn thickness(
        scene: &Scene<Self>,
        primitive_id: u32,
        weights: [f64; 2],
        side: Side,
    ) -> Option<f64>;
    #[doc(hidden)]
    fn verify_tree(scene: &Scene<Self>) -> Result<(), TreeError>;
    #[doc(hidden)]
    fn verify_wide_tree(scene: &Scene<Self>) -> Result<(), WideError>;
}

macro_rules! compile_for {
    ($($coordinate:ty)*) => {
        $(
            impl Precision for $coordinate {
                fn build(
                    mesh: TriangleMesh<Self>,
                    options: &BuildOptions,
                    progress: Progress<'_>,
                ) -> Result<Scene<Self>, BuildError> {
                    Scene::of_mesh(mesh, options, progress)
                }

                fn closest_hit(scene: &Scene<Self>, ray: &Ray) -> Option<Hit> {
                    scene.find_closest_hit(ray)
                }

                fn any_hit(scene: &Scene<Self>, ray: &Ray) -> bool {
                    scene.find_any_hit(ray)
                }

                fn all_hits_into(scene: &Scene<Self>, ray: &Ray, hits: &mut Vec<Hit>) {
                    scene.find_all_hits(ray, hits);
                }

                fn crossed(scene: &Scene<Self>, ray: &Ray) -> Vec<u32> {
                    scene.find_crossed(ray)
                }

                fn counts(scene: &Scene<Self>, rays: &[Ray], counts: &mut [usize]) {
                    scene.each_count(rays, |index, count| counts[index] = count);
                }

                fn closest_hit_with_hint(scene: &Scene<Self>, ray: &Ray) -> Option<(Hit, Hint)> {
                    scene.find_closest_hit_with_hint(ray)
                }

                fn any_hit_near(scene: &Scene<Self>, ray: &Ray, hint: Hint) -> bool {
                    scene.find_any_hit_near(ray, hint)
                }

                fn closest_hits(scene: &Scene<Self>, rays: &[Ray], hits: &mut [Option<Hit>]) {
                    scene.each_closest_hit(rays, |index, hit| hits[index] = hit);
                }

                fn any_hits(scene: &Scene<Self>, rays: &[Ray], found: &mut [bool]) {
                    scene.each_any_hit(rays, |index, is_hit| found[index] = is_hit);
                }

                fn any_hits_near(
                    scene: &Scene<Self>,
                    rays: &[Ray],
                    hints: &[Hint],
                    found: &mut [bool],
                ) {
                    scene.find_any_hits_near(rays, hints, found);
                }

                fn packet_closest_hits(
                    scene: &Scene<Self>,
                    packet: &RayPacket<'_>,
                    hits: &mut HitArrays,
                ) -> PacketWork {
                    scene.find_packet_closest_hits(packet, hits)
                }

                fn packet_any_hits(
                    scene: &Scene<Self>,
                    packet: &RayPacket<'_>,
                    found: &mut [bool],
                ) -> PacketWork {
                    scene.find_packet_any_hits(packet, found)
                }

                fn closest_point(scene: &Scene<Self>, point: [f64; 3]) -> Option<ClosestPoint> {
                    scene.find_closest_point(point)
                }

                fn contains(scene: &Scene<Self>, point: [f64; 3]) -> bool {
                    scene.finds_inside(point)
                }

                fn contains_each(scene: &Scene<Self>, points: &[[f64; 3]], inside: &mut [bool]) {
                    scene.find_inside_each(points, inside);
                }

                fn signed_distance(scene: &Scene<Self>, point: [f64; 3]) -> Option<f64> {
                    scene.find_signed_distance(point)
                }

                fn winding_number(scene: &Scene<Self>, point: [f64; 3]) -> f64 {
                    scene.find_winding_number(point)
                }

                fn closure(mesh: &TriangleMesh<Self>) -> Closure {
                    Closure::of(mesh)
                }

                fn visible(scene: &Scene<Self>, from: [f64; 3], to: [f64; 3]) -> bool {
                    scene.finds_visible(from, to)
                }

                fn thickness(
                    scene: &Scene<Self>,
                    primitive_id: u32,
                    weights: [f64; 2],
                    side: Side,
                ) -> Option<f64> {
                    scene.find_thickness(primitive_id, weights, side)
                }

                fn verify_tree(scene: &Scene<Self>) -> Result<(), TreeError> {
                    scene.tree().validate(scene.mesh())
                }

                fn verify_wide_tree(scene: &Scene<Self>) -> Result<(), WideError> {
                    let verify = |wide: &WideTree| wide.verify(scene.tree(), scene.mesh());
                    scene.wide_tree().map_or(Ok(()), verify)
                }
            }
        )*
    };
}

compile_for!(f32 f64);
