//! From where the scene is seen, and how large the picture is.

use super::{Size, field_of_view, numbers};
use crate::error::CliError;
use kdray::Aabb;
use kdray_render::{Background, Y_UP, frame, point_light_for};
use kdray_scene::{Camera, Light, Model, Projection};

/// From where the scene is seen, and how large the picture is.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct ViewArgs {
    /// The size in pixels of a render, and of the picture in a drawing, whose key and scale come
    /// on top
    #[arg(long, value_name = "WxH", default_value = "960x540")]
    pub(crate) size: Size,
    /// The observer; without it the file's first camera, or one that frames the scene
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = numbers::<3>)]
    pub(crate) eye: Option<[f64; 3]>,
    /// The point in the middle of the picture
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = numbers::<3>)]
    pub(crate) look_at: Option<[f64; 3]>,
    /// What points up in the picture, and from the horizon of a sky to where it is deepest; a camera
    /// that frames the scene looks from above accordingly. Without it what the camera says, and +y
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = numbers::<3>)]
    pub(crate) up: Option<[f64; 3]>,
    /// The angle between the lower and the upper edge of the picture, below 180; without it the
    /// camera's
    #[arg(long, value_name = "DEGREES", value_parser = field_of_view)]
    pub(crate) fov: Option<f64>,
    /// A camera of the file, by its name or by its number from 0
    #[arg(long, value_name = "NAME|INDEX")]
    pub(crate) camera: Option<String>,
    /// Add a point light; may be given several times
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = numbers::<3>)]
    pub(crate) light: Vec<[f64; 3]>,
}

impl ViewArgs {
    /// Width over height of the picture.
    pub(crate) fn aspect(&self) -> f64 {
        self.size.width as f64 / self.size.height as f64
    }

    /// The camera: the one that was named, or else the scene's first, or else one that frames the
    /// scene in `bounds`; then changed as the arguments say.
    pub(crate) fn camera(&self, model: &Model, bounds: &Aabb<3>) -> Result<Camera, CliError> {
        let mut camera = match &self.camera {
            Some(name) => named_camera(model, name)?.clone(),
            None => match model.cameras.first() {
                Some(camera) => camera.clone(),
                None => frame(bounds, self.upward(), self.aspect()),
            },
        };
        camera.eye = self.eye.unwrap_or(camera.eye);
        camera.look_at = self.look_at.unwrap_or(camera.look_at);
        camera.up = self.up.unwrap_or(camera.up);
        if let Some(vfov_degrees) = self.fov {
            camera.projection = Projection::Perspective { vfov_degrees };
        }
        Ok(camera)
    }

    /// The sky over the scene.
    pub(crate) fn sky(&self) -> Background {
        Background::sky(self.upward())
    }

    /// What is up in the scene, whatever its cameras say.
    fn upward(&self) -> [f64; 3] {
        self.up.unwrap_or(Y_UP)
    }

    /// The scene's lights and those of the arguments.
    pub(crate) fn lights(&self, model: &Model, bounds: &Aabb<3>) -> Vec<Light> {
        let added = self.light.iter().map(|&position| point_light_for(bounds, position));
        model.lights.iter().cloned().chain(added).collect()
    }
}

/// The camera of that name, or of that number.
fn named_camera<'a>(model: &'a Model, name: &str) -> Result<&'a Camera, CliError> {
    let by_name = model.cameras.iter().find(|camera| camera.name == name);
    let by_number = || model.cameras.get(name.parse::<usize>().ok()?);
    by_name.or_else(by_number).ok_or_else(|| {
        let list: Vec<String> = model.cameras.iter().enumerate().map(describe).collect();
        let list = if list.is_empty() { "none".to_owned() } else { list.join(", ") };
        CliError::Usage(format!("--camera {name}: no such camera; the scene has {list}"))
    })
}

fn describe((number, camera): (usize, &Camera)) -> String {
    format!("{number} `{}`", camera.name)
}
