//! All hits of a ray: a filter that notes every hit and accepts none, as Embree's documentation advises.

use super::ffi::{self, Context, Filter, FilterArguments, RayHit};
use super::scene::{self, NO_HIT, Scene, SingleRay};
use std::ffi::c_void;
use std::ptr;

/// A query's context, and where its hits go.
#[repr(C)]
struct Collector<'a> {
    context: Context,
    hits: &'a mut Vec<(f32, u32)>,
}

/// Notes t and triangle of a hit, and rejects it.
unsafe extern "C" fn collect(arguments: *const FilterArguments) {
    // SAFETY: the library calls with valid pointers, as `Scene::all` passes one ray and its own context, which
    // a collector begins with.
    unsafe {
        let arguments = &*arguments;
        let collector: &mut Collector<'_> = &mut *arguments.context.cast();
        // The hit's numbers lie one behind the other for a single ray, as in the structure; but not its
        // alignment is promised.
        let t = (&raw const (*arguments.ray).t_far).read_unaligned();
        let primitive = (&raw const (*arguments.hit).primitive).read_unaligned();
        collector.hits.push((t, primitive));
        *arguments.valid = 0;
    }
}

impl Scene {
    /// `rtcIntersect1` with a filter: t and triangle of all hits, by rising t. The scene must be a collecting
    /// one.
    #[inline]
    pub(crate) fn all(&self, ray: &SingleRay, hits: &mut Vec<(f32, u32)>) {
        hits.clear();
        let none = [ffi::INVALID_GEOMETRY_ID];
        let context = Context { instance: none, instance_primitive: none };
        let mut collector = Collector { context, hits };
        let flags = ffi::RAY_QUERY_FLAG_INCOHERENT | ffi::RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
        let mut arguments = scene::arguments(flags);
        arguments.context = ptr::from_mut(&mut collector).cast::<c_void>();
        arguments.filter = collect as Filter as *mut c_void;
        let mut query = RayHit { ray: ray.0, hit: NO_HIT };
        let intersect = self.device.library.functions.intersect1;
        // SAFETY: the scene is committed, and the structures are those of the interface; the collector outlives
        // the call.
        unsafe { intersect(self.raw, &raw mut query, &raw mut arguments) };
        collector.hits.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    }
}
