//! From where the scene is seen, and how large the picture is.

use super::{Size, numbers};

/// From where the scene is seen, and how large the picture is.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct ViewArgs {
    /// The size of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "960x640")]
    pub(crate) size: Size,
    /// The observer; without it the file's first camera, or one that frames the scene
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = numbers::<3>)]
    pub(crate) eye: Option<[f64; 3]>,
    /// The point in the middle of the picture
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = numbers::<3>)]
    pub(crate) look_at: Option<[f64; 3]>,
    /// What points up in the picture
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = numbers::<3>)]
    pub(crate) up: Option<[f64; 3]>,
    /// The angle between the lower and the upper edge of the picture
    #[arg(long, value_name = "DEGREES")]
    pub(crate) fov: Option<f64>,
    /// A camera of the file, by its name or by its number from 0
    #[arg(long, value_name = "NAME|INDEX")]
    pub(crate) camera: Option<String>,
    /// Add a point light; may be given several times
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = numbers::<3>)]
    pub(crate) light: Vec<[f64; 3]>,
}
