//! `kdray trace`: the steps of one ray, or of the packet of rays through a tile of pixels.

mod table;
mod tile;
mod tile_json;
mod tile_table;

use crate::{
    args::{BuildArgs, SceneArgs, TableArgs, ViewArgs, numbers},
    build,
    cli::Globals,
    error::CliError,
    load, output,
    pictures::{PictureFile, RayPath, draw_ray_path, scene_name},
    progress,
    table::print_json,
    wording::{exact, readable},
};
use kdray::{Ray, traverse::StepRecorder};
use kdray_render::{RenderError, View, World};
use std::path::PathBuf;

/// Show the steps of one ray through the tree, or of a packet of rays
///
/// The ray looks for its closest hit. Each step is printed in the words of the traversal: the
/// node, the axis of its plane, t_near and t_far, where the ray enters and leaves the node's box,
/// t_split, where it meets the plane, which of the three cases that is, and what waits on the
/// stack. With --out, the way of the ray is drawn in the plane that holds the ray and one axis.
///
/// With --tile, the rays through a tile of pixels go together, in up to eight sub-frusta: each node
/// is decided upon once for all of them. --out draws the way of the frusta in a plane with the
/// pixel's own ray, and --out-3d in space, from beside them.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example: from (0, 0, 0) in the direction (0.4, 0.1, 1)
  kdray trace triangle.obj --ray 0,0,0,0.4,0.1,1

Example: the ray through a pixel, as a table and as a picture
  kdray trace bunny.ply --pixel 480,320 -o ray.svg

Example: the packet of the 16 x 16 pixels around one, in a section and in space
  kdray trace bunny.ply --tile 480,320 -o frustum.svg --out-3d frustum.png")]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    which: WhichRay,
    /// Also draw the way of the ray: a name that ends in .svg or .png
    #[arg(long, short, value_name = "OUT.svg|png")]
    out: Option<PathBuf>,
    #[command(flatten)]
    tile: TileArgs,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    build: BuildArgs,
    #[command(flatten)]
    table: TableArgs,
}

/// What has no meaning for a ray that is given.
const OF_A_VIEW: [&str; 7] = ["size", "eye", "look_at", "up", "fov", "camera", "light"];

#[derive(Debug, clap::Args)]
#[group(required = true, multiple = false)]
struct WhichRay {
    /// The ray: its origin and its direction, which may have any length
    #[arg(long, value_name = "OX,OY,OZ,DX,DY,DZ", allow_hyphen_values = true, value_parser = numbers::<6>, conflicts_with_all = OF_A_VIEW)]
    ray: Option<[f64; 6]>,
    /// The ray through the middle of this pixel of the picture, from 0,0 in the upper left corner
    #[arg(long, value_name = "X,Y", value_parser = pixel, conflicts_with = "light")]
    pixel: Option<(usize, usize)>,
    /// The packet of rays through the tile of pixels that holds this one
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    tile: Option<(usize, usize)>,
}

/// What has a meaning for a tile only.
#[derive(Debug, clap::Args)]
struct TileArgs {
    /// Pixels across and down of a tile, at most 16
    #[arg(long, value_name = "N", default_value_t = 16, conflicts_with_all = ["ray", "pixel"], value_parser = clap::value_parser!(u8).range(1..=16))]
    tile_size: u8,
    /// Also draw the way of the frusta in space: a name that ends in .svg or .png
    #[arg(long, value_name = "OUT.svg|png", conflicts_with_all = ["ray", "pixel"])]
    out_3d: Option<PathBuf>,
    /// From where the picture in space is seen; without it from beside the frusta
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, requires = "out_3d", value_parser = numbers::<3>)]
    from: Option<[f64; 3]>,
    /// Rays a pixel of the render in the picture in space
    #[arg(long, value_name = "N", default_value_t = 4, requires = "out_3d", value_parser = clap::value_parser!(u32).range(1..=65536))]
    samples: u32,
}

/// Builds the tree and follows the ray.
pub(crate) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    if let Some(pixel) = args.which.tile {
        return tile::run(args, pixel, globals);
    }
    let file = args.out.as_deref().map(PictureFile::create).transpose()?;
    let model = load::model(&args.scene, globals)?;
    let world = build::world(model, &args.build.options(), globals)?;
    let ray = ray(args, &world)?;
    let scene = world.scene().shapes();
    let mut recorder = StepRecorder::default();
    let hit = scene.closest_hit_traced(&ray, &mut recorder);
    let steps = recorder.steps;

    let words = ray_words(args, &ray);
    // The picture first: whoever reads the steps may stop, as `head` does.
    if let Some(file) = file {
        let [o, d] = &words;
        let (name, split) = (scene_name(&args.scene), args.build.strategy().name());
        let title = format!("{name}: ray from ({o}) along ({d}), split {split}");
        let path = RayPath { scene, ray: &ray, steps: &steps, hit, title: &title };
        write_picture(file, &path, globals)?;
    }
    if args.table.json {
        print_json(&table::json(scene, &ray, &steps, hit))
    } else {
        output::print(table::text(scene, &ray, &words, &steps, hit).as_bytes())
    }
}

fn write_picture(file: PictureFile, path: &RayPath<'_>, globals: &Globals) -> Result<(), CliError> {
    match draw_ray_path(path) {
        Some(canvas) => file.write(canvas, 1.5),
        None => {
            let out = file.path().display();
            progress::say(globals, &format!("the ray misses the scene's box: {out} is not drawn"));
            Ok(())
        }
    }
}

/// Origin and direction of the ray: as they were given, or rounded if they were computed.
fn ray_words(args: &Args, ray: &Ray) -> [String; 2] {
    let number = if args.which.ray.is_some() { exact } else { readable };
    [ray.origin, ray.direction].map(|v| v.map(number).join(", "))
}

fn ray(args: &Args, world: &World) -> Result<Ray, CliError> {
    let ray = match (args.which.ray, args.which.pixel) {
        (Some([ox, oy, oz, dx, dy, dz]), _) => Ray::new([ox, oy, oz], [dx, dy, dz]),
        (None, Some(pixel)) => pixel_ray(args, world, pixel)?,
        (None, None) => return Err(CliError::Usage("give --ray, --pixel or --tile".to_owned())),
    };
    ray.check().map_err(|error| CliError::Usage(error.to_string()))?;
    Ok(ray)
}

fn pixel_ray(args: &Args, world: &World, pixel: (usize, usize)) -> Result<Ray, CliError> {
    check_pixel("--pixel", args, pixel)?;
    let camera = args.view.camera(world.model(), world.scene().tree().bounds())?;
    let view = View::new(&camera, args.view.aspect()).map_err(RenderError::from)?;
    Ok(ray_through(&view, args, pixel))
}

/// The ray through the middle of a pixel.
fn ray_through(view: &View, args: &Args, (x, y): (usize, usize)) -> Ray {
    let (width, height) = (args.view.size.width as f64, args.view.size.height as f64);
    view.ray((x as f64 + 0.5) / width, (y as f64 + 0.5) / height)
}

/// Refuses a pixel outside the picture, named by `option`.
fn check_pixel(option: &str, args: &Args, (x, y): (usize, usize)) -> Result<(), CliError> {
    let (width, height) = (args.view.size.width, args.view.size.height);
    if x < width && y < height {
        return Ok(());
    }
    Err(CliError::Usage(format!(
        "{option} {x},{y}: the picture has the pixels 0,0 to {},{}; choose one of them, or \
         another --size",
        width - 1,
        height - 1
    )))
}

fn pixel(text: &str) -> Result<(usize, usize), String> {
    text.split_once(',')
        .and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)))
        .ok_or_else(|| "give column and row, such as 480,320".to_owned())
}
