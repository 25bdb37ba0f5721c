//! Opening the library at run time.

use super::ffi::{self, Functions};
use super::scene::Scene;
use super::{Quality, wheel};
use crate::error::BenchError;
use kdray::TriangleMesh;
use libloading::Library;
use std::mem::ManuallyDrop;
use std::path::Path;
use std::sync::Arc;

/// Embree, open.
#[derive(Clone)]
pub(crate) struct Embree {
    inner: Arc<Open>,
}

/// The functions. The library that they are in is never closed: threads that its scheduler started
/// may run in it to the end of the process.
pub(super) struct Open {
    pub(super) functions: Functions,
}

impl Embree {
    /// Fetches Embree if that was not done yet, and opens it.
    pub(crate) fn fetch(folder: &Path) -> Result<Self, BenchError> {
        Self::open(&wheel::library(folder)?)
    }

    fn open(path: &Path) -> Result<Self, BenchError> {
        let fail = |error: libloading::Error| BenchError::Embree(error.to_string());
        // SAFETY: the library's initialisers are those of Embree and TBB, as published; they need
        // nothing from us.
        let library = ManuallyDrop::new(unsafe { Library::new(path) }.map_err(fail)?);
        /// A function of the library by its name, as of the type of the member it becomes.
        macro_rules! symbol {
            ($name:literal) => {
                // SAFETY: the type is that of the function of this name in Embree 4's interface.
                *unsafe { library.get($name) }.map_err(fail)?
            };
        }
        let functions = Functions {
            new_device: symbol!("rtcNewDevice"),
            release_device: symbol!("rtcReleaseDevice"),
            get_device_error: symbol!("rtcGetDeviceError"),
            get_device_property: symbol!("rtcGetDeviceProperty"),
            set_memory_monitor: symbol!("rtcSetDeviceMemoryMonitorFunction"),
            new_scene: symbol!("rtcNewScene"),
            release_scene: symbol!("rtcReleaseScene"),
            set_scene_build_quality: symbol!("rtcSetSceneBuildQuality"),
            set_scene_flags: symbol!("rtcSetSceneFlags"),
            commit_scene: symbol!("rtcCommitScene"),
            new_geometry: symbol!("rtcNewGeometry"),
            release_geometry: symbol!("rtcReleaseGeometry"),
            set_geometry_build_quality: symbol!("rtcSetGeometryBuildQuality"),
            set_new_geometry_buffer: symbol!("rtcSetNewGeometryBuffer"),
            commit_geometry: symbol!("rtcCommitGeometry"),
            attach_geometry: symbol!("rtcAttachGeometry"),
            intersect1: symbol!("rtcIntersect1"),
            occluded1: symbol!("rtcOccluded1"),
            intersect8: symbol!("rtcIntersect8"),
            occluded8: symbol!("rtcOccluded8"),
        };
        Ok(Self { inner: Arc::new(Open { functions }) })
    }

    /// Builds a scene on `threads` threads.
    pub(crate) fn scene(
        &self,
        mesh: &TriangleMesh,
        quality: Quality,
        threads: usize,
    ) -> Result<Scene, BenchError> {
        Scene::build(Arc::clone(&self.inner), mesh, quality, threads, ffi::SCENE_FLAG_NONE)
    }

    /// Builds a scene on one thread that can be asked for all hits.
    pub(crate) fn collecting_scene(
        &self,
        mesh: &TriangleMesh,
        quality: Quality,
    ) -> Result<Scene, BenchError> {
        let flags = ffi::SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
        Scene::build(Arc::clone(&self.inner), mesh, quality, 1, flags)
    }

    /// The version, such as 4.4.0.
    pub(crate) fn version(&self) -> Result<String, BenchError> {
        let number = super::scene::version(Arc::clone(&self.inner))?;
        Ok(format!("{}.{}.{}", number / 10000, number / 100 % 100, number % 100))
    }
}
