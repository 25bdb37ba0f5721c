//! What of Embree's C interface is used, as its API documentation of version 4 describes it.

use std::ffi::{c_char, c_int, c_uint, c_void};

/// `RTCDevice`, `RTCScene`, `RTCGeometry`: pointers to what only the library knows.
pub(super) type Device = *mut c_void;
pub(super) type Scene = *mut c_void;
pub(super) type Geometry = *mut c_void;

pub(super) const GEOMETRY_TYPE_TRIANGLE: c_int = 0;
pub(super) const BUFFER_TYPE_INDEX: c_int = 0;
pub(super) const BUFFER_TYPE_VERTEX: c_int = 1;
pub(super) const FORMAT_UINT3: c_int = 0x5003;
pub(super) const FORMAT_FLOAT3: c_int = 0x9003;
pub(super) const BUILD_QUALITY_MEDIUM: c_int = 1;
pub(super) const BUILD_QUALITY_HIGH: c_int = 2;
pub(super) const SCENE_FLAG_NONE: c_int = 0;
pub(super) const SCENE_FLAG_ROBUST: c_int = 1 << 2;
pub(super) const SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS: c_int = 1 << 3;
pub(super) const RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER: c_int = 1 << 1;
pub(super) const RAY_QUERY_FLAG_INCOHERENT: c_int = 0;
pub(super) const RAY_QUERY_FLAG_COHERENT: c_int = 1 << 16;
pub(super) const FEATURE_FLAG_ALL: c_uint = 0xffff_ffff;
pub(super) const INVALID_GEOMETRY_ID: c_uint = 0xffff_ffff;
pub(super) const DEVICE_PROPERTY_VERSION: c_int = 0;

/// `RTCRay`.
#[repr(C, align(16))]
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub(super) origin: [f32; 3],
    pub(super) t_near: f32,
    pub(super) direction: [f32; 3],
    pub(super) time: f32,
    pub(super) t_far: f32,
    pub(super) mask: c_uint,
    pub(super) id: c_uint,
    pub(super) flags: c_uint,
}

/// `RTCHit`.
#[repr(C, align(16))]
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub(super) normal: [f32; 3],
    pub(super) uv: [f32; 2],
    pub(super) primitive: c_uint,
    pub(super) geometry: c_uint,
    pub(super) instance: [c_uint; 1],
    pub(super) instance_primitive: [c_uint; 1],
}

/// `RTCRayHit`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub(super) struct RayHit {
    pub(super) ray: Ray,
    pub(super) hit: Hit,
}

/// `RTCRay8`.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray8 {
    pub(super) origin: [[f32; 8]; 3],
    pub(super) t_near: [f32; 8],
    pub(super) direction: [[f32; 8]; 3],
    pub(super) time: [f32; 8],
    pub(super) t_far: [f32; 8],
    pub(super) mask: [c_uint; 8],
    pub(super) id: [c_uint; 8],
    pub(super) flags: [c_uint; 8],
}

/// `RTCHit8`.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit8 {
    pub(super) normal: [[f32; 8]; 3],
    pub(super) uv: [[f32; 8]; 2],
    pub(super) primitive: [c_uint; 8],
    pub(super) geometry: [c_uint; 8],
    pub(super) instance: [[c_uint; 8]; 1],
    pub(super) instance_primitive: [[c_uint; 8]; 1],
}

/// `RTCRayHit8`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub(super) struct RayHit8 {
    pub(super) ray: Ray8,
    pub(super) hit: Hit8,
}

/// The mask of a packet: −1 for each ray that is there.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug)]
pub(super) struct Valid8(pub(super) [c_int; 8]);

/// `RTCIntersectArguments` and `RTCOccludedArguments`, which are laid out alike. The last member is
/// there only in some builds of the library, behind all others.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub(super) struct Arguments {
    pub(super) flags: c_int,
    pub(super) feature_mask: c_uint,
    pub(super) context: *mut c_void,
    pub(super) filter: *mut c_void,
    pub(super) intersect: *mut c_void,
    pub(super) min_width_distance_factor: f32,
}

/// `RTCRayQueryContext`, to which more may be added at its end.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub(super) struct Context {
    pub(super) instance: [c_uint; 1],
    pub(super) instance_primitive: [c_uint; 1],
}

/// `RTCFilterFunctionNArguments`, for one ray at a time.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub(super) struct FilterArguments {
    pub(super) valid: *mut c_int,
    pub(super) user: *mut c_void,
    pub(super) context: *mut c_void,
    pub(super) ray: *const Ray,
    pub(super) hit: *const Hit,
    pub(super) count: c_uint,
}

/// `RTCFilterFunctionN`.
pub(super) type Filter = unsafe extern "C" fn(*const FilterArguments);

/// `RTCMemoryMonitorFunction`: called with the bytes that are allocated, or negative ones that are
/// freed.
pub(super) type MemoryMonitor = unsafe extern "C" fn(*mut c_void, isize, bool) -> bool;

/// The functions.
#[derive(Clone, Copy)]
pub(super) struct Functions {
    pub(super) new_device: unsafe extern "C" fn(*const c_char) -> Device,
    pub(super) release_device: unsafe extern "C" fn(Device),
    pub(super) get_device_error: unsafe extern "C" fn(Device) -> c_int,
    pub(super) get_device_property: unsafe extern "C" fn(Device, c_int) -> isize,
    pub(super) set_memory_monitor: unsafe extern "C" fn(Device, MemoryMonitor, *mut c_void),
    pub(super) new_scene: unsafe extern "C" fn(Device) -> Scene,
    pub(super) release_scene: unsafe extern "C" fn(Scene),
    pub(super) set_scene_build_quality: unsafe extern "C" fn(Scene, c_int),
    pub(super) set_scene_flags: unsafe extern "C" fn(Scene, c_int),
    pub(super) commit_scene: unsafe extern "C" fn(Scene),
    pub(super) new_geometry: unsafe extern "C" fn(Device, c_int) -> Geometry,
    pub(super) release_geometry: unsafe extern "C" fn(Geometry),
    pub(super) set_geometry_build_quality: unsafe extern "C" fn(Geometry, c_int),
    pub(super) set_new_geometry_buffer:
        unsafe extern "C" fn(Geometry, c_int, c_uint, c_int, usize, usize) -> *mut c_void,
    pub(super) commit_geometry: unsafe extern "C" fn(Geometry),
    pub(super) attach_geometry: unsafe extern "C" fn(Scene, Geometry) -> c_uint,
    pub(super) intersect1: unsafe extern "C" fn(Scene, *mut RayHit, *mut Arguments),
    pub(super) occluded1: unsafe extern "C" fn(Scene, *mut Ray, *mut Arguments),
    pub(super) intersect8: unsafe extern "C" fn(*const c_int, Scene, *mut RayHit8, *mut Arguments),
    pub(super) occluded8: unsafe extern "C" fn(*const c_int, Scene, *mut Ray8, *mut Arguments),
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sizes that the headers' structures have.
    #[test]
    fn layouts_are_those_of_the_interface() {
        assert_eq!((size_of::<Ray>(), align_of::<Ray>()), (48, 16));
        assert_eq!((size_of::<Hit>(), size_of::<RayHit>()), (48, 96));
        assert_eq!((size_of::<Ray8>(), align_of::<Ray8>()), (384, 32));
        assert_eq!((size_of::<Hit8>(), size_of::<RayHit8>()), (288, 672));
        assert_eq!(std::mem::offset_of!(Ray, t_far), 32);
        assert_eq!(std::mem::offset_of!(Hit, primitive), 20);
        assert_eq!(std::mem::offset_of!(Arguments, context), 8);
        assert_eq!(std::mem::offset_of!(Arguments, filter), 16);
        assert_eq!((size_of::<Context>(), std::mem::offset_of!(FilterArguments, ray)), (8, 24));
        assert_eq!(std::mem::offset_of!(FilterArguments, count), 40);
    }
}
