//! A device with one scene of one mesh.

use super::ffi::{self, Arguments, RayHit, RayHit8, Valid8};
use super::library::Open;
use super::{Hint, Quality};
use crate::error::BenchError;
use kdray::TriangleMesh;
use std::ffi::{CString, c_int, c_void};
use std::ptr;
use std::sync::Arc;
use std::sync::atomic::{AtomicIsize, Ordering};

/// A device, which counts its memory.
pub(super) struct Device {
    raw: ffi::Device,
    /// Bytes allocated and not freed. Boxed: the library holds its address.
    bytes: Box<AtomicIsize>,
    pub(super) library: Arc<Open>,
}

// SAFETY: Embree's devices may be used from any thread.
unsafe impl Send for Device {}
// SAFETY: likewise; the counter is atomic.
unsafe impl Sync for Device {}

impl Device {
    fn new(library: Arc<Open>, threads: usize) -> Result<Self, BenchError> {
        let config = CString::new(format!("threads={threads},set_affinity=0"));
        let config = config.map_err(|error| BenchError::Embree(error.to_string()))?;
        // SAFETY: the string ends in zero and is copied.
        let raw = unsafe { (library.functions.new_device)(config.as_ptr()) };
        if raw.is_null() {
            return Err(BenchError::Embree("there is no device for this processor".to_owned()));
        }
        let device = Self { raw, bytes: Box::new(AtomicIsize::new(0)), library };
        let counter = ptr::from_ref(device.bytes.as_ref()).cast_mut().cast();
        // SAFETY: `counted` has the type that is asked for, and the counter outlives the device.
        unsafe { (device.library.functions.set_memory_monitor)(raw, counted, counter) };
        Ok(device)
    }

    /// What went wrong since this was last asked.
    fn check(&self, what: &str) -> Result<(), BenchError> {
        // SAFETY: the device is alive.
        match unsafe { (self.library.functions.get_device_error)(self.raw) } {
            0 => Ok(()),
            code => Err(BenchError::Embree(format!("{what} failed with error {code}"))),
        }
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: nobody else releases it; scenes hold references of their own.
        unsafe { (self.library.functions.release_device)(self.raw) };
    }
}

/// Called by the library when it allocates or frees.
unsafe extern "C" fn counted(counter: *mut c_void, bytes: isize, _post: bool) -> bool {
    // SAFETY: it is the counter of `Device::new`, which outlives the device.
    let counter: &AtomicIsize = unsafe { &*counter.cast() };
    counter.fetch_add(bytes, Ordering::Relaxed);
    true
}

/// The number that the library gives for its version.
pub(super) fn version(library: Arc<Open>) -> Result<isize, BenchError> {
    let device = Device::new(library, 1)?;
    let property = device.library.functions.get_device_property;
    // SAFETY: the device is alive.
    Ok(unsafe { property(device.raw, ffi::DEVICE_PROPERTY_VERSION) })
}

/// A scene, ready for rays.
pub(crate) struct Scene {
    pub(super) raw: ffi::Scene,
    arguments: [Arguments; 2],
    pub(super) device: Device,
}

// SAFETY: a committed scene may be asked from any thread; the pointers in `arguments` are null.
unsafe impl Send for Scene {}
// SAFETY: likewise.
unsafe impl Sync for Scene {}

impl Drop for Scene {
    fn drop(&mut self) {
        // SAFETY: nobody else releases it, and the device is still there.
        unsafe { (self.device.library.functions.release_scene)(self.raw) };
    }
}

impl Scene {
    pub(super) fn build(
        library: Arc<Open>,
        mesh: &TriangleMesh,
        quality: Quality,
        threads: usize,
        flags: c_int,
    ) -> Result<Self, BenchError> {
        let device = Device::new(library, threads)?;
        // SAFETY: the device is alive.
        let raw = unsafe { (device.library.functions.new_scene)(device.raw) };
        device.check("making a scene")?;
        let hints = [ffi::RAY_QUERY_FLAG_INCOHERENT, ffi::RAY_QUERY_FLAG_COHERENT];
        let scene = Self { raw, arguments: hints.map(arguments), device };
        scene.commit(mesh, quality, flags)?;
        Ok(scene)
    }

    /// Gives the scene its triangles and builds its BVH.
    fn commit(
        &self,
        mesh: &TriangleMesh,
        quality: Quality,
        more_flags: c_int,
    ) -> Result<(), BenchError> {
        let functions = &self.device.library.functions;
        let (build, flags) = match quality {
            Quality::Medium => (ffi::BUILD_QUALITY_MEDIUM, ffi::SCENE_FLAG_NONE),
            Quality::High => (ffi::BUILD_QUALITY_HIGH, ffi::SCENE_FLAG_NONE),
            Quality::Robust => (ffi::BUILD_QUALITY_MEDIUM, ffi::SCENE_FLAG_ROBUST),
        };
        // SAFETY: device and scene are alive. The geometry is released here, when the scene has a
        // reference of its own.
        unsafe {
            (functions.set_scene_build_quality)(self.raw, build);
            (functions.set_scene_flags)(self.raw, flags | more_flags);
            let geometry = (functions.new_geometry)(self.device.raw, ffi::GEOMETRY_TYPE_TRIANGLE);
            self.device.check("making a geometry")?;
            (functions.set_geometry_build_quality)(geometry, build);
            let (vertices, triangles) = (mesh.vertices(), mesh.triangles());
            self.fill(geometry, ffi::BUFFER_TYPE_VERTEX, ffi::FORMAT_FLOAT3, vertices)?;
            self.fill(geometry, ffi::BUFFER_TYPE_INDEX, ffi::FORMAT_UINT3, triangles)?;
            (functions.commit_geometry)(geometry);
            (functions.attach_geometry)(self.raw, geometry);
            (functions.release_geometry)(geometry);
            (functions.commit_scene)(self.raw);
        }
        self.device.check("building the scene")
    }

    /// Copies triples of four-byte numbers into a buffer of the geometry.
    ///
    /// # Safety
    /// `geometry` is alive, and `format` is that of `T`.
    unsafe fn fill<T: Copy>(
        &self,
        geometry: ffi::Geometry,
        kind: c_int,
        format: c_int,
        items: &[[T; 3]],
    ) -> Result<(), BenchError> {
        let new_buffer = self.device.library.functions.set_new_geometry_buffer;
        // SAFETY: as the caller promises.
        let buffer =
            unsafe { new_buffer(geometry, kind, 0, format, size_of::<[T; 3]>(), items.len()) };
        self.device.check("making a buffer")?;
        if !buffer.is_null() {
            // SAFETY: the buffer was made for just so many items of this size, and is new.
            unsafe { ptr::copy_nonoverlapping(items.as_ptr(), buffer.cast(), items.len()) };
        }
        Ok(())
    }

    /// How many bytes the device has allocated: triangles, BVH and all.
    pub(crate) fn bytes(&self) -> usize {
        usize::try_from(self.device.bytes.load(Ordering::Relaxed)).unwrap_or(0)
    }

    /// The arguments for a query. The library only reads them.
    fn arguments(&self, hint: Hint) -> *mut Arguments {
        ptr::from_ref(&self.arguments[hint as usize]).cast_mut()
    }

    /// `rtcIntersect1`: t and triangle of the closest hit.
    #[inline]
    pub(crate) fn closest(&self, ray: &SingleRay) -> Option<(f32, u32)> {
        let mut query = RayHit { ray: ray.0, hit: NO_HIT };
        let intersect = self.device.library.functions.intersect1;
        // SAFETY: the scene is committed, and the structures are those of the interface.
        unsafe { intersect(self.raw, &raw mut query, self.arguments(Hint::Incoherent)) };
        let is_hit = query.hit.geometry != ffi::INVALID_GEOMETRY_ID;
        is_hit.then_some((query.ray.t_far, query.hit.primitive))
    }

    /// `rtcOccluded1`: whether there is any hit.
    #[inline]
    pub(crate) fn any(&self, ray: &SingleRay) -> bool {
        let mut query = ray.0;
        let occluded = self.device.library.functions.occluded1;
        // SAFETY: as in `closest`.
        unsafe { occluded(self.raw, &raw mut query, self.arguments(Hint::Incoherent)) };
        query.t_far < 0.0
    }

    /// `rtcIntersect8`: t and triangle of the closest hits; `u32::MAX` for no hit.
    #[inline]
    pub(crate) fn closest8(&self, packet: &Packet, hint: Hint) -> ([f32; 8], [u32; 8]) {
        let mut query = RayHit8 { ray: packet.rays, hit: NO_HIT8 };
        let intersect = self.device.library.functions.intersect8;
        let valid = packet.valid.0.as_ptr();
        // SAFETY: as in `closest`; the mask is aligned to 32 bytes, too.
        unsafe { intersect(valid, self.raw, &raw mut query, self.arguments(hint)) };
        // Rays that hit nothing keep the id that they came with.
        (query.ray.t_far, query.hit.primitive)
    }

    /// `rtcOccluded8`: whether there is any hit.
    #[inline]
    pub(crate) fn any8(&self, packet: &Packet, hint: Hint) -> [bool; 8] {
        let mut query = packet.rays;
        let occluded = self.device.library.functions.occluded8;
        // SAFETY: as in `closest8`.
        unsafe {
            occluded(packet.valid.0.as_ptr(), self.raw, &raw mut query, self.arguments(hint));
        }
        query.t_far.map(|t| t < 0.0)
    }
}

pub(super) fn arguments(flags: c_int) -> Arguments {
    Arguments {
        flags,
        feature_mask: ffi::FEATURE_FLAG_ALL,
        context: ptr::null_mut(),
        filter: ptr::null_mut(),
        intersect: ptr::null_mut(),
        min_width_distance_factor: 0.0,
    }
}

pub(super) const NO_HIT: ffi::Hit = ffi::Hit {
    normal: [0.0; 3],
    uv: [0.0; 2],
    primitive: ffi::INVALID_GEOMETRY_ID,
    geometry: ffi::INVALID_GEOMETRY_ID,
    instance: [ffi::INVALID_GEOMETRY_ID],
    instance_primitive: [ffi::INVALID_GEOMETRY_ID],
};

const NO_HIT8: ffi::Hit8 = ffi::Hit8 {
    normal: [[0.0; 8]; 3],
    uv: [[0.0; 8]; 2],
    primitive: [ffi::INVALID_GEOMETRY_ID; 8],
    geometry: [ffi::INVALID_GEOMETRY_ID; 8],
    instance: [[ffi::INVALID_GEOMETRY_ID; 8]],
    instance_primitive: [[ffi::INVALID_GEOMETRY_ID; 8]],
};

/// A ray in Embree's format.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SingleRay(pub(super) ffi::Ray);

impl SingleRay {
    /// The ray for t from 0 to `t_far`.
    pub(crate) fn new(origin: [f32; 3], direction: [f32; 3], t_far: f32) -> Self {
        Self(ffi::Ray {
            origin,
            t_near: 0.0,
            direction,
            time: 0.0,
            t_far,
            mask: u32::MAX,
            id: 0,
            flags: 0,
        })
    }
}

/// Up to eight rays in Embree's format.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Packet {
    rays: ffi::Ray8,
    valid: Valid8,
}

impl Packet {
    /// The packet of rays (origin, direction, t_far), of which the first eight count.
    pub(crate) fn new(rays: impl Iterator<Item = ([f32; 3], [f32; 3], f32)>) -> Self {
        let mut packet = Self {
            rays: ffi::Ray8 {
                origin: [[0.0; 8]; 3],
                t_near: [0.0; 8],
                direction: [[1.0; 8]; 3],
                time: [0.0; 8],
                t_far: [f32::NEG_INFINITY; 8],
                mask: [u32::MAX; 8],
                id: [0; 8],
                flags: [0; 8],
            },
            valid: Valid8([0; 8]),
        };
        for (lane, (origin, direction, t_far)) in rays.take(8).enumerate() {
            for axis in 0..3 {
                packet.rays.origin[axis][lane] = origin[axis];
                packet.rays.direction[axis][lane] = direction[axis];
            }
            packet.rays.t_far[lane] = t_far;
            packet.valid.0[lane] = -1;
        }
        packet
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packets_say_which_rays_are_there() {
        let ray = |x: f32| ([x, 1.0, 2.0], [3.0, 4.0, 5.0], 6.0);
        let packet = Packet::new([ray(7.0), ray(8.0)].into_iter());
        assert_eq!(packet.valid.0, [-1, -1, 0, 0, 0, 0, 0, 0]);
        assert_eq!(packet.rays.origin[0][..2], [7.0, 8.0]);
        assert_eq!(packet.rays.direction[2][1], 5.0);
        assert_eq!(packet.rays.t_far[1], 6.0);
    }
}
