//! `kdray draw`: the tree as a picture.

use crate::{
    args::{BuildArgs, SceneArgs, ViewArgs},
    backdrop::Backdrop,
    build,
    cli::Globals,
    error::CliError,
    load,
    pictures::{
        AROUND, LineColor, PictureFile, Section, Slice, Wireframe, draw_slice, draw_wireframe,
        scene_name,
    },
    progress,
    wording::{counted, exact},
};
use kdray_render::World;
use std::path::{Path, PathBuf};

/// The deepest cells drawn over a render: 2^12 are more than can be told apart.
const MAX_WIREFRAME_DEPTH: u32 = 12;
const WIREFRAME_DEPTH: u32 = 5;

/// What has no meaning for a slice.
const OF_A_RENDER: [&str; 8] =
    ["eye", "look_at", "up", "fov", "camera", "light", "samples", "color"];

/// Draw the tree: its cells over a render, or a slice through it
///
/// Without --slice, the planes of the tree's upper levels are drawn as outlines over a render of
/// the scene; what surfaces hide of them is dotted. With --slice, one plane through the scene is
/// shown: its leaves, shaded by how many triangles they list, the splitting planes, coloured by
/// axis, and the triangles, each as the plane cuts it.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example: the first six levels of a tree over the scene
  kdray draw bunny.ply -o cells.png --depth 6

Example: a slice, for two ways to choose the splitting plane
  kdray draw bunny.ply -o sah.svg --slice z=0
  kdray draw bunny.ply -o middle.svg --slice z=0 --split middle

Example: a part of a slice of the built-in scene, whose floor is wide
  kdray draw -o part.svg --slice z=0 --window=-5,5,-0.3,3")]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The picture: a name that ends in .svg or .png
    #[arg(long, short, value_name = "OUT.svg|png")]
    out: PathBuf,
    /// Show this plane through the scene instead of a render
    #[arg(long, value_name = "x|y|z=VALUE", allow_hyphen_values = true, value_parser = slice_plane, conflicts_with_all = OF_A_RENDER)]
    slice: Option<(usize, f64)>,
    /// Show only this part of a slice, in the numbers at its edges: from the left to the right, and
    /// from below to above
    #[arg(long, value_name = "LEFT,RIGHT,BELOW,ABOVE", allow_hyphen_values = true, requires = "slice", value_parser = window)]
    window: Option<[[f64; 2]; 2]>,
    /// How many splits deep cells are drawn; without it 5 over a render (12 at most), and all of
    /// a slice. Where the tree is not as deep, its leaves are drawn
    #[arg(long, value_name = "N")]
    depth: Option<u32>,
    /// What the colours of lines over a render say
    #[arg(long, value_name = "WHAT", default_value = "axis")]
    color: LineColor,
    /// Rays a pixel of the render
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=65536))]
    samples: u32,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    build: BuildArgs,
}

/// Builds the tree and draws it.
pub(crate) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    if let (None, Some(depth)) = (args.slice, args.depth)
        && depth > MAX_WIREFRAME_DEPTH
    {
        return Err(CliError::Usage(format!(
            "--depth {depth}: over a render, cells are drawn to a depth of {MAX_WIREFRAME_DEPTH} \
             at most; deeper ones are shown by --slice"
        )));
    }
    let file = PictureFile::create(&args.out)?;
    // A slice may be smaller than its room.
    if args.slice.is_none() {
        file.check_size(args.view.size, AROUND)?;
    }
    let model = load::model(&args.scene, globals)?;
    if model.triangles.is_empty() {
        return Err(nothing_to_draw(args));
    }
    let world = build::world(model, &args.build.options(), globals)?;
    match args.slice {
        Some(plane) => write_slice(args, globals, file, &world, plane),
        None => write_wireframe(args, globals, file, &world),
    }
}

fn write_slice(
    args: &Args,
    globals: &Globals,
    file: PictureFile,
    world: &World,
    (axis, value): (usize, f64),
) -> Result<(), CliError> {
    let name = ["x", "y", "z"][axis];
    let bounds = world.scene().tree().bounds();
    let depth = args.depth.unwrap_or(u32::MAX);
    let title = format!(
        "{}: slice at {name} = {}, split {}{}",
        scene_name(&args.scene),
        exact(value),
        args.build.strategy().name(),
        args.depth.map_or(String::new(), |depth| format!(", to depth {depth}")),
    );
    let section = Section::perpendicular(axis, value);
    let slice = Slice { section, depth, window: args.window, title: &title };
    let room = [args.view.size.width as f64, args.view.size.height as f64];
    let corner = |p: [f32; 3]| p.map(exact).join(", ");
    let Some((canvas, figures)) = draw_slice(world.scene().shapes(), &slice, room) else {
        return Err(CliError::Usage(format!(
            "--slice {name}={value}: nothing of the scene is there; its box goes from ({}) to \
             ({}): choose a value, and a --window, within",
            corner(bounds.min),
            corner(bounds.max),
        )));
    };
    file.write(canvas, 1.0)?;
    let cells = counted(figures.cells, "cell", "cells");
    let triangles = counted(figures.triangles, "cut triangle", "cut triangles");
    let out = args.out.display();
    progress::say(globals, &format!("drew {cells} and {triangles}: {out}"));
    Ok(())
}

fn write_wireframe(
    args: &Args,
    globals: &Globals,
    file: PictureFile,
    world: &World,
) -> Result<(), CliError> {
    let bounds = world.scene().tree().bounds();
    let camera = args.view.camera(world.model(), bounds)?;
    let (view, size, samples) = (&args.view, args.view.size, args.samples);
    let backdrop = Backdrop { world, camera: &camera, view, size, samples };
    let render = backdrop.render(&args.out, globals)?;
    let deepest = world.scene().tree().cells().map(|cell| cell.depth).max().unwrap_or(0);
    let depth = args.depth.unwrap_or(WIREFRAME_DEPTH).min(deepest);
    let title = format!(
        "{}: the planes of the tree to depth {depth}, split {}",
        scene_name(&args.scene),
        args.build.strategy().name()
    );
    let canvas = draw_wireframe(&Wireframe {
        scene: world.scene().shapes(),
        camera: &camera,
        render: &render,
        size: [args.view.size.width as f64, args.view.size.height as f64],
        depth,
        color: args.color,
        title: &title,
    });
    file.write(canvas, 1.0)?;
    progress::say(globals, &format!("drew the cells to depth {depth}: {}", args.out.display()));
    Ok(())
}

fn nothing_to_draw(args: &Args) -> CliError {
    let path = args.scene.scene.as_deref().unwrap_or(Path::new("-"));
    CliError::input(path, "the scene has no triangles, so there is nothing to draw")
}

/// Reads `x=VALUE`, `y=VALUE` or `z=VALUE`.
fn slice_plane(text: &str) -> Result<(usize, f64), String> {
    let wrong = || "give an axis and a value, such as z=0.5".to_owned();
    let (axis, value) = text.split_once('=').ok_or_else(wrong)?;
    let axis = match axis.trim() {
        "x" | "X" => 0,
        "y" | "Y" => 1,
        "z" | "Z" => 2,
        _ => return Err(wrong()),
    };
    let [value] = crate::args::numbers::<1>(value).map_err(|_| wrong())?;
    Ok((axis, value))
}

/// Reads `LEFT,RIGHT,BELOW,ABOVE`; refuses what a panel could not show as it is.
fn window(text: &str) -> Result<[[f64; 2]; 2], String> {
    let edges @ [left, right, below, above] = crate::args::numbers::<4>(text)?;
    let [width, height] = [right - left, above - below];
    if !(width > 0.0 && height > 0.0) {
        return Err("LEFT must be less than RIGHT, and BELOW less than ABOVE".to_owned());
    }
    let (long, short) = (width.max(height), width.min(height));
    let far = edges.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if !long.is_finite() || short < 1e-3 * long {
        Err("width and height may differ a thousandfold at most".to_owned())
    } else if short < (1e-12 * far).max(1e-30) {
        Err("the window is too small to tell numbers in it apart".to_owned())
    } else {
        Ok([[left, right], [below, above]])
    }
}

#[cfg(test)]
mod tests {
    use super::{slice_plane, window};

    #[test]
    fn windows_have_an_extent() {
        assert_eq!(window("-1,2,0,0.5"), Ok([[-1.0, 2.0], [0.0, 0.5]]));
        assert_eq!(window("9e5,900000.01,0,0.01"), Ok([[9e5, 900_000.01], [0.0, 0.01]]));
        for bad in ["", "1,1,0,1", "0,1,2,1", "0,1,2", "0,1,0,inf"] {
            assert!(window(bad).is_err(), "{bad}");
        }
        for unseen in ["0,1,0,0.0001", "1,1.0000000000001,0,0.0000000000001", "0,1e-31,0,1e-31"] {
            assert!(window(unseen).is_err(), "{unseen}");
        }
    }

    #[test]
    fn slices_have_an_axis_and_a_finite_value() {
        assert_eq!(slice_plane("y=-2.5"), Ok((1, -2.5)));
        for bad in ["", "w=1", "x", "x=", "x=nan", "=1", "x=1,2"] {
            assert!(slice_plane(bad).is_err(), "{bad}");
        }
    }
}
