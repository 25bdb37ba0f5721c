//! From a scene to a picture.

use crate::error::{ArgumentError, UnsupportedError, argument};
use crate::files::Look;
use crate::job::{Control, Job};
use crate::picture::Picture;
use crate::tree::{Kind, Tree};
use kdray_render::{Background, CameraError, Crop, PictureKind, RenderError, RenderOptions};
use kdray_render::{RenderProgress, Y_UP, frame, point_light_for, render_with_progress};
use kdray_scene::{Camera, Light, Model, Projection};
use pyo3::{FromPyObject, Py, PyAny, PyErr, PyResult, Python, pyclass, pyfunction, pymethods};
use std::ops::ControlFlow;

/// A scene with what its triangles look like.
#[pyclass(frozen, module = "kdray._kdray")]
#[derive(Debug)]
pub(crate) struct World(kdray_render::World);

#[pymethods]
impl World {
    /// The triangles of a scene, with the materials, lights and cameras of the file that they come from, if any.
    #[new]
    #[pyo3(signature = (tree, look))]
    fn new(py: Python<'_>, tree: &Tree, look: Option<&Look>) -> PyResult<Self> {
        let Kind::F32(scene) = &tree.kind else {
            let reason = "pictures are made of scenes with float32 vertices and without instances";
            return Err(UnsupportedError::new_err(reason));
        };
        py.detach(|| {
            let model = look.map_or_else(Model::default, |look| (*look.0).clone());
            let world = kdray_render::World::of_scene(model, scene.clone());
            world.map(Self).map_err(|error| argument("mesh", error))
        })
    }
}

/// From where, and by what light; by the words of the command line.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct View {
    width: usize,
    height: usize,
    eye: Option<[f64; 3]>,
    look_at: Option<[f64; 3]>,
    up: Option<[f64; 3]>,
    fov: Option<f64>,
    camera: Option<String>,
    light: Vec<[f64; 3]>,
}

impl View {
    /// What is up in the scene, whatever its cameras say.
    fn upward(&self) -> [f64; 3] {
        self.up.unwrap_or(Y_UP)
    }
}

/// What is computed, and how well; by the words of the command line.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Quality {
    picture: String,
    layers: bool,
    samples: u32,
    bounces: u32,
    light_samples: u32,
    seed: u64,
    packets: bool,
    background: Option<[f32; 3]>,
    ambient: Option<[f32; 3]>,
    ambient_rays: u32,
    occlusion_distance: Option<f64>,
    exposure: f32,
    heat_max: Option<f32>,
    /// x, y, width, height.
    crop: Option<[usize; 4]>,
    /// The first, and that behind the last.
    sample_range: Option<[u32; 2]>,
}

/// Renders a picture.
#[pyfunction]
#[pyo3(signature = (world, view, quality, *, threads, progress))]
pub(crate) fn render(
    py: Python<'_>,
    world: &World,
    view: View,
    quality: Quality,
    threads: Option<i64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Picture> {
    let world = &world.0;
    let options = options(&view, &quality)?;
    let camera = camera(&view, world)?;
    let added = view.light.iter().map(|&position| point_light_for(world.bounds(), position));
    let lights: Vec<Light> = world.model().lights.iter().cloned().chain(added).collect();
    let pixels = view.width.saturating_mul(view.height);
    Job::new(threads, progress)?.run(py, pixels as u64, |control| {
        let told = |done: RenderProgress| follow(control, done.fraction * pixels as f64);
        let picture = render_with_progress(world, &camera, &lights, &options, &told);
        picture.map(Picture).map_err(refused)
    })
}

fn follow(control: &Control, pixels: f64) -> ControlFlow<()> {
    control.set(pixels as u64);
    if control.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

fn options(view: &View, quality: &Quality) -> PyResult<RenderOptions> {
    let default = RenderOptions::default();
    let sky = || Background::sky(view.upward());
    Ok(RenderOptions {
        width: view.width,
        height: view.height,
        samples: quality.samples,
        max_bounces: quality.bounces,
        picture: kind(&quality.picture)?,
        packets: quality.packets,
        all_layers: quality.layers,
        seed: quality.seed,
        background: quality.background.map_or_else(sky, Background::Color),
        ambient: quality.ambient.unwrap_or(default.ambient),
        ambient_rays: quality.ambient_rays,
        occlusion_distance: quality.occlusion_distance,
        light_samples: quality.light_samples,
        exposure: quality.exposure,
        heat_max: quality.heat_max,
        crop: quality.crop.map(|[x, y, width, height]| Crop { x, y, width, height }),
        sample_range: quality.sample_range.map(|[first, end]| first..end),
    })
}

/// The picture of that name.
fn kind(name: &str) -> PyResult<PictureKind> {
    const KINDS: [(&str, PictureKind); 10] = [
        ("shaded", PictureKind::Shaded),
        ("depth", PictureKind::Depth),
        ("normal", PictureKind::Normal),
        ("primitive-id", PictureKind::PrimitiveId),
        ("ambient-occlusion", PictureKind::AmbientOcclusion),
        ("cost", PictureKind::Cost),
        ("cost-nodes", PictureKind::CostNodes),
        ("cost-primitives", PictureKind::CostPrimitives),
        ("packet-cost", PictureKind::PacketCost),
        ("packet-size", PictureKind::PacketSize),
    ];
    let found = KINDS.iter().find(|(known, _)| *known == name).map(|&(_, kind)| kind);
    found.ok_or_else(|| {
        let names = KINDS.map(|(name, _)| name).join(", ");
        argument("picture", format!("none is called {name:?}; give one of {names}"))
    })
}

/// The camera that is named, or else the file's first, or else one that frames the scene; changed as asked.
fn camera(view: &View, world: &kdray_render::World) -> PyResult<Camera> {
    let cameras = &world.model().cameras;
    let aspect = view.width as f64 / view.height.max(1) as f64;
    let mut camera = match &view.camera {
        None => {
            cameras.first().cloned().unwrap_or_else(|| frame(world.bounds(), view.upward(), aspect))
        }
        Some(name) => {
            let by_name = cameras.iter().find(|camera| camera.name == *name);
            let found = by_name.or_else(|| cameras.get(name.parse::<usize>().ok()?));
            let found = found.ok_or_else(|| {
                let names: Vec<&str> = cameras.iter().map(|camera| camera.name.as_str()).collect();
                argument("camera", format!("there is none called {name:?}, only {names:?}"))
            });
            found?.clone()
        }
    };
    camera.eye = view.eye.unwrap_or(camera.eye);
    camera.look_at = view.look_at.unwrap_or(camera.look_at);
    camera.up = view.up.unwrap_or(camera.up);
    if let Some(vfov_degrees) = view.fov {
        camera.projection = Projection::Perspective { vfov_degrees };
    }
    Ok(camera)
}

/// That a picture cannot be rendered, by the name of the argument that is to blame.
fn refused(error: RenderError) -> PyErr {
    let names = match &error {
        RenderError::EmptyPicture { .. } | RenderError::TooLarge { .. } => "width, height",
        RenderError::Camera(CameraError::NotFinite) => "eye, look_at, up",
        RenderError::Camera(CameraError::NoDirection) => "eye, look_at",
        RenderError::Camera(CameraError::NoUp) => "up",
        RenderError::Camera(_) => "fov",
        RenderError::Light(_) => "light",
        RenderError::Crop { .. } => "crop",
        RenderError::SampleRange { .. } => "sample_range",
        RenderError::Option { option: "max_bounces", .. } => "bounces",
        RenderError::Option { option, .. } => option,
        _ => "picture",
    };
    ArgumentError::new_err(format!("{names}: {error}"))
}
