//! `kdray trace --tile`: the rays through a tile of pixels, as a packet in a frustum (S12).

use super::{Args, tile_json, tile_table};
use crate::{
    args::Size,
    backdrop::Backdrop,
    build,
    cli::Globals,
    error::CliError,
    load, output,
    pictures::{
        FrustumPath, FrustumView, PictureFile, draw_frustum_path, draw_frustum_view, scene_name,
    },
    progress,
    table::print_json,
    wording::counted,
};
use glam::DVec3;
use kdray::{
    Hit, Ray, ShapeScene,
    geometry::tile_order,
    traverse::{Counters, PacketCounters, PacketKind, PacketRecorder, PacketStep},
};
use kdray_render::{RenderError, View};
use kdray_scene::{Camera, Projection};

/// The size of the picture in space, whatever that of the picture whose tile it is about.
const SIZE_IN_SPACE: Size = Size { width: 960, height: 540 };

/// The field of view of the picture in space, in degrees.
const VFOV_IN_SPACE: f64 = 45.0;

/// Pixels that lie together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tile {
    /// The pixel in the upper left corner.
    pub(super) at: [usize; 2],
    /// Pixels across and down.
    pub(super) size: [usize; 2],
}

/// What a tile's packet did, and what its rays would have cost one by one.
pub(super) struct TileTrace<'a> {
    pub(super) tile: Tile,
    pub(super) scene: &'a ShapeScene,
    pub(super) rays: &'a [Ray],
    pub(super) hits: Vec<Option<Hit>>,
    pub(super) steps: Vec<PacketStep>,
    pub(super) counters: PacketCounters,
    pub(super) single: Counters,
}

/// Follows the packet through the tile that holds the given pixel.
pub(super) fn run(args: &Args, pixel: (usize, usize), globals: &Globals) -> Result<(), CliError> {
    let file = args.out.as_deref().map(PictureFile::create).transpose()?;
    let view_file = args.tile.out_3d.as_deref().map(PictureFile::create).transpose()?;
    let model = load::model(&args.scene, globals)?;
    let world = build::world(model, &args.build.options(), globals)?;
    let camera = args.view.camera(world.model(), world.scene().tree().bounds())?;
    let view = View::new(&camera, args.view.aspect()).map_err(RenderError::from)?;
    let tile = Tile::new(args, pixel)?;
    let rays = tile.rays(&view, args);
    let traced = TileTrace::new(tile, world.scene().shapes(), &rays)?;
    let [x, y] = tile.at;
    let title = format!(
        "{}: packet of {} from pixel {x},{y}, split {}",
        scene_name(&args.scene),
        counted(rays.len(), "ray", "rays"),
        args.build.strategy().name()
    );
    let ray = super::ray_through(&view, args, pixel);
    // Pictures first: whoever reads the steps may stop, as `head` does.
    if let Some(file) = file {
        write_path(file, &traced, &ray, &title, globals)?;
    }
    if let (Some(file), Some(out)) = (view_file, &args.tile.out_3d) {
        let camera = aside(args, &camera, &traced, &ray);
        let (view, samples) = (&args.view, args.tile.samples);
        let backdrop =
            Backdrop { world: &world, camera: &camera, view, size: SIZE_IN_SPACE, samples };
        write_view(file, &traced, &camera, &backdrop.render(out, globals)?, &title)?;
    }
    if args.table.json {
        print_json(&tile_json::json(&traced))
    } else {
        output::print(tile_table::text(&traced).as_bytes())
    }
}

fn write_view(
    file: PictureFile,
    traced: &TileTrace<'_>,
    camera: &Camera,
    render: &[u8],
    title: &str,
) -> Result<(), CliError> {
    let picture = FrustumView {
        scene: traced.scene,
        camera,
        render,
        size: [SIZE_IN_SPACE.width as f64, SIZE_IN_SPACE.height as f64],
        steps: &traced.steps,
        hit_points: &traced.hit_points(),
        title,
    };
    file.write(draw_frustum_view(&picture), 1.0)
}

fn write_path(
    file: PictureFile,
    traced: &TileTrace<'_>,
    ray: &Ray,
    title: &str,
    globals: &Globals,
) -> Result<(), CliError> {
    let path = FrustumPath {
        scene: traced.scene,
        ray,
        steps: &traced.steps,
        hit_points: &traced.hit_points(),
        title,
        summary: &tile_table::summary(traced),
    };
    match draw_frustum_path(&path) {
        Some(canvas) => file.write(canvas, 1.5),
        None => {
            progress::say(globals, "no frustum meets the scene's box: nothing is drawn");
            Ok(())
        }
    }
}

/// A camera beside the frustum, on the right of `ray` and a little above.
fn aside(args: &Args, camera: &Camera, traced: &TileTrace<'_>, ray: &Ray) -> Camera {
    let hits = traced.hits.iter().flatten().map(|hit| hit.t);
    let farthest = hits.reduce(f64::max);
    let box_end = || traced.scene.tree().bounds().slab(ray).map_or(1.0, |inside| inside.t_max);
    let [start, end] = [0.0, farthest.unwrap_or_else(box_end)].map(|t| DVec3::from(ray.at(t)));
    let (forward, length) = ((end - start).normalize_or(DVec3::X), (end - start).length());
    let up = DVec3::from(camera.up).normalize_or(DVec3::Y);
    let right = forward.cross(up).normalize_or(DVec3::X);
    let middle = start.lerp(end, 0.5);
    let eye = middle + (right - 0.3 * forward + 0.4 * up) * length;
    Camera {
        eye: args.tile.from.unwrap_or(eye.into()),
        look_at: middle.into(),
        projection: Projection::Perspective { vfov_degrees: VFOV_IN_SPACE },
        ..camera.clone()
    }
}

impl Tile {
    /// The tile that holds a pixel, as far as it is in the picture.
    fn new(args: &Args, (x, y): (usize, usize)) -> Result<Self, CliError> {
        super::check_pixel("--tile", args, (x, y))?;
        let size = usize::from(args.tile.tile_size);
        let at = [x / size * size, y / size * size];
        let room = [args.view.size.width - at[0], args.view.size.height - at[1]];
        Ok(Self { at, size: room.map(|room| room.min(size)) })
    }

    /// Rays through the middles of all pixels, neighbours together.
    fn rays(&self, view: &View, args: &Args) -> Vec<Ray> {
        let [width, height] = self.size.map(|pixels| pixels as u32);
        let pixels = tile_order(width, height).map(|pixel| pixel.map(|i| i as usize));
        let pixels = pixels.map(|[x, y]| (self.at[0] + x, self.at[1] + y));
        pixels.map(|pixel| super::ray_through(view, args, pixel)).collect()
    }
}

impl<'a> TileTrace<'a> {
    /// Answers the rays as one packet and one by one, which must be the same.
    fn new(tile: Tile, scene: &'a ShapeScene, rays: &'a [Ray]) -> Result<Self, CliError> {
        let packets = scene.packets(PacketKind::Frustum).with_size(rays.len());
        let (mut recorder, mut counters) = (PacketRecorder::default(), PacketCounters::default());
        let hits = packets.closest_hits(rays, &mut recorder);
        packets.closest_hits(rays, &mut counters);
        let mut single = Counters::default();
        for (index, (ray, hit)) in rays.iter().zip(&hits).enumerate() {
            let alone = scene.closest_hit_traced(ray, &mut single);
            if alone != *hit {
                return Err(CliError::Disagreement(format!(
                    "the packet and the single ray disagree on ray {index}: {hit:?} and {alone:?}"
                )));
            }
        }
        Ok(Self { tile, scene, rays, hits, steps: recorder.steps, counters, single })
    }

    /// Where the rays hit.
    fn hit_points(&self) -> Vec<[f64; 3]> {
        let hits = self.rays.iter().zip(&self.hits);
        hits.filter_map(|(ray, hit)| hit.map(|hit| ray.at(hit.t))).collect()
    }
}
