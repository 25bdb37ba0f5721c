//! `kdray trace`: the steps of one ray.

mod table;

use crate::{
    args::{BuildArgs, SceneArgs, TableArgs, ViewArgs, numbers},
    build,
    cli::Globals,
    error::CliError,
    load, output,
    pictures::{PictureFile, RayPath, draw_ray_path, readable, scene_name},
    progress,
    table::print_json,
};
use kdray::{Ray, traverse::StepRecorder};
use kdray_render::{RenderError, View, World};
use std::path::PathBuf;

/// Show the steps of one ray through the tree
///
/// The ray looks for its closest hit. Each step is printed in the words of the traversal: the
/// node, the axis of its plane, t_near and t_far, where the ray enters and leaves the node's box,
/// t_split, where it meets the plane, which of the three cases that is, and what waits on the
/// stack. With --out, the way of the ray is drawn in the plane that holds the ray and one axis.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example: from (0, 0, 0) in the direction (0.4, 0.1, 1)
  kdray trace triangle.obj --ray 0,0,0,0.4,0.1,1

Example: the ray through a pixel, as a table and as a picture
  kdray trace bunny.ply --pixel 480,320 -o ray.svg")]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    which: WhichRay,
    /// Also draw the way of the ray: a name that ends in .svg or .png
    #[arg(long, short, value_name = "OUT.svg|png")]
    out: Option<PathBuf>,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    build: BuildArgs,
    #[command(flatten)]
    table: TableArgs,
}

#[derive(Debug, clap::Args)]
#[group(required = true, multiple = false)]
struct WhichRay {
    /// The ray: its origin and its direction, which may have any length
    #[arg(long, value_name = "OX,OY,OZ,DX,DY,DZ", allow_hyphen_values = true, value_parser = numbers::<6>)]
    ray: Option<[f64; 6]>,
    /// The ray through the middle of this pixel of the picture, from 0,0 in the upper left corner
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pixel: Option<(usize, usize)>,
}

/// Builds the tree and follows the ray.
pub(crate) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    let file = args.out.as_deref().map(PictureFile::create).transpose()?;
    let model = load::model(&args.scene, globals)?;
    let world = build::world(model, &args.build.options(), globals)?;
    let ray = ray(args, &world)?;
    let scene = world.scene().shapes();
    let mut recorder = StepRecorder::default();
    let hit = scene.closest_hit_traced(&ray, &mut recorder);
    let steps = recorder.steps;

    if args.table.json {
        print_json(&table::json(scene, &ray, &steps, hit))?;
    } else {
        output::print(table::text(scene, &ray, &steps, hit).as_bytes())?;
    }
    let (Some(file), Some(out)) = (file, &args.out) else { return Ok(()) };
    let [o, d] = [ray.origin, ray.direction].map(|v| v.map(readable).join(", "));
    let title = format!(
        "{}: ray from ({o}) along ({d}), split {}",
        scene_name(&args.scene),
        args.build.split.name()
    );
    let path = RayPath { scene, ray: &ray, steps: &steps, hit, title: &title };
    match draw_ray_path(&path) {
        Some(canvas) => file.write(canvas, 1.5),
        None => {
            let line = format!("the ray misses the scene's box: {} is not drawn", out.display());
            progress::say(globals, &line);
            Ok(())
        }
    }
}

fn ray(args: &Args, world: &World) -> Result<Ray, CliError> {
    let ray = match (args.which.ray, args.which.pixel) {
        (Some([ox, oy, oz, dx, dy, dz]), _) => Ray::new([ox, oy, oz], [dx, dy, dz]),
        (None, Some(pixel)) => pixel_ray(args, world, pixel)?,
        (None, None) => return Err(CliError::Usage("give --ray or --pixel".to_owned())),
    };
    ray.check().map_err(|error| CliError::Usage(error.to_string()))?;
    Ok(ray)
}

fn pixel_ray(args: &Args, world: &World, (x, y): (usize, usize)) -> Result<Ray, CliError> {
    let (width, height) = (args.view.size.width, args.view.size.height);
    if x >= width || y >= height {
        return Err(CliError::Usage(format!(
            "--pixel {x},{y}: the picture has the pixels 0,0 to {},{}; choose one of them, or \
             another --size",
            width - 1,
            height - 1
        )));
    }
    let camera = args.view.camera(world.model(), world.scene().tree().bounds())?;
    let view = View::new(&camera, args.view.aspect()).map_err(RenderError::from)?;
    Ok(view.ray((x as f64 + 0.5) / width as f64, (y as f64 + 0.5) / height as f64))
}

fn pixel(text: &str) -> Result<(usize, usize), String> {
    text.split_once(',')
        .and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)))
        .ok_or_else(|| "give column and row, such as 480,320".to_owned())
}
