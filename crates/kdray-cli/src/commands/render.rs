//! `kdray render`: a picture by backward ray tracing.

use crate::{
    args::{
        FastBuildArgs, SceneArgs, ViewArgs, bits, color, crop, positive, positive_f32, sample_range,
    },
    build,
    cli::Globals,
    error::CliError,
    interrupt, load,
    output::Output,
    picture_file::{Format, write},
    progress::{self, Progress},
};
use clap::ValueEnum;
use kdray::BuildOptions;
use kdray_render::{
    Background, Crop, Picture, PictureKind, PngDepth, RenderOptions, RenderProgress, World,
};
use std::{
    ops::Range,
    path::PathBuf,
    sync::{Mutex, PoisonError},
};

/// Render a picture by backward ray tracing
///
/// Without a scene it renders the built-in one. Ctrl-C ends a render early: what is done is
/// written, and the exit code is 130; a second Ctrl-C ends it without.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example: the built-in scene to kdray.png
  kdray render

Example: a mesh seen from the left, lit from above
  kdray render bunny.ply -o bunny.png --size 800x600 --eye=-1,0.1,0 --light 0,2,0

Example: what the tree costs each pixel
  kdray render bunny.ply -o cost.png --picture cost

Example: the left half on one machine, the right half on another, put together
  kdray render bunny.ply -o left.exr --crop 0,0,480x540
  kdray render bunny.ply -o right.exr --crop 480,0,480x540
  kdray merge left.exr right.exr -o bunny.png")]
pub(crate) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// The picture: a name that ends in .png or .exr
    #[arg(long, short, value_name = "OUT.png|exr", default_value = "kdray.png")]
    out: PathBuf,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    part: PartArgs,
    #[command(flatten)]
    quality: QualityArgs,
    #[command(flatten)]
    build: FastBuildArgs,
}

/// Which part of the picture is rendered, for `kdray merge`.
#[derive(Debug, clap::Args)]
struct PartArgs {
    /// Render these pixels of the picture alone, the same as in the whole; X,Y is the upper left one
    #[arg(long, value_name = "X,Y,WxH", value_parser = crop)]
    crop: Option<Crop>,
    /// Trace these of each pixel's samples alone: from A to before B
    #[arg(long, value_name = "A..B", value_parser = sample_range)]
    sample_range: Option<Range<u32>>,
}

/// What is computed, and how well. What is not given is the renderer's default.
#[derive(Debug, clap::Args)]
struct QualityArgs {
    /// What the picture shows
    #[arg(long, value_name = "WHAT", default_value = "shaded")]
    picture: Shown,
    /// Compute the layers of every picture; only for .exr
    #[arg(long)]
    layers: bool,
    /// Bits a channel, 8 without it; only for .png
    #[arg(long, value_name = "8|16", value_parser = bits)]
    bits: Option<PngDepth>,
    /// Rays a pixel through the camera
    #[arg(long, value_name = "N", default_value_t = RenderOptions::default().samples, value_parser = clap::value_parser!(u32).range(1..=65536))]
    samples: u32,
    /// How many times a ray may be mirrored or refracted
    #[arg(long, value_name = "N", default_value_t = RenderOptions::default().max_bounces, value_parser = clap::value_parser!(u32).range(..=64))]
    bounces: u32,
    /// Shadow rays per camera ray and rectangular light
    #[arg(long, value_name = "N", default_value_t = RenderOptions::default().light_samples, value_parser = clap::value_parser!(u32).range(1..=1024))]
    light_samples: u32,
    /// Chooses the random numbers: the same seed gives the same picture
    #[arg(long, value_name = "N", default_value_t = RenderOptions::default().seed)]
    seed: u64,
    /// Trace no rays in packets: the same picture, to compare the time
    #[arg(long)]
    no_packets: bool,
    /// The colour behind everything, linear RGB; without it a sky
    #[arg(long, value_name = "R,G,B", value_parser = color)]
    background: Option<[f32; 3]>,
    /// Light from all around, linear RGB; without it a faint, bluish one
    #[arg(long, value_name = "R,G,B", value_parser = color)]
    ambient: Option<[f32; 3]>,
    /// Rays per camera ray by which the surroundings block ambient light; 0 for none
    #[arg(long, value_name = "N", default_value_t = RenderOptions::default().ambient_rays, value_parser = clap::value_parser!(u32).range(..=1024))]
    ambient_rays: u32,
    /// How far surfaces block ambient light, in units of the scene; without it a tenth of the
    /// diagonal
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    occlusion_distance: Option<f64>,
    /// What a PNG multiplies colours by
    #[arg(long, value_name = "FACTOR", default_value_t = RenderOptions::default().exposure, value_parser = positive_f32)]
    exposure: f32,
    /// The cost with the last colour of a cost picture; without it the 99.5th percentile
    #[arg(long, value_name = "COST", value_parser = positive_f32)]
    heat_max: Option<f32>,
}

/// The pictures by their names on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Shown {
    /// Light: materials, lights, shadows, mirrors and glass
    Shaded,
    /// The distance to the hit
    Depth,
    /// The shading normal
    Normal,
    /// A colour for each triangle
    PrimitiveId,
    /// The share of the sky that a surface sees
    AmbientOcclusion,
    /// Nodes visited and triangles tested, with a legend
    Cost,
    /// Nodes visited
    CostNodes,
    /// Triangles tested
    CostPrimitives,
    /// Work for packets of camera rays, by the number of rays
    PacketCost,
    /// How many camera rays go together in packets
    PacketSize,
}

/// Pictures of cost are of the lecture's traversal, and of its tree unless another is asked for.
fn tree_options(args: &Args) -> BuildOptions {
    let of_cost =
        matches!(args.quality.picture, Shown::Cost | Shown::CostNodes | Shown::CostPrimitives);
    if of_cost && args.build.preset.is_none() {
        args.build.lecture_options()
    } else {
        args.build.options()
    }
}

/// Reads, builds, renders and writes.
pub(crate) fn run(args: &Args, globals: &Globals) -> Result<(), CliError> {
    let format = Format::of(&args.out)?;
    check_fits(&args.quality, format)?;
    check_part(args)?;
    // Refused now, not after an hour of rendering.
    let mut output = Output::create(&args.out)?;
    let model = load::model(&args.scene, globals)?;
    let world = build::world(model, &tree_options(args), globals)?;
    let (picture, report) = render(args, &world, globals)?;
    write(&picture, format, args.quality.bits, &mut output, &args.out)?;
    output.commit()?;
    progress::say(globals, &format!("{report}: {}", args.out.display()));
    if picture.complete { Ok(()) } else { Err(CliError::Interrupted) }
}

/// Refuses options that the format has no use for.
fn check_fits(quality: &QualityArgs, format: Format) -> Result<(), CliError> {
    if format == Format::Png && quality.layers {
        let refused = "--layers needs an output that ends in .exr: a PNG holds one picture";
        return Err(CliError::Usage(refused.to_owned()));
    }
    format.check_bits(quality.bits)
}

/// Refuses parts that the picture has not.
fn check_part(args: &Args) -> Result<(), CliError> {
    let (size, samples) = (args.view.size, args.quality.samples);
    if let Some(crop) = args.part.crop.filter(|it| !it.is_within(size.width, size.height)) {
        return Err(CliError::Usage(format!(
            "--crop {crop}: the picture of {} x {} has not all of these pixels; change it or --size",
            size.width, size.height
        )));
    }
    match &args.part.sample_range {
        Some(range) if range.end > samples => Err(CliError::Usage(format!(
            "--sample-range {}..{}: a pixel has samples 0..{samples}; change it or --samples",
            range.start, range.end
        ))),
        _ => Ok(()),
    }
}

/// The picture, whole or as far as Ctrl-C let it come, and a line on what was done.
fn render(args: &Args, world: &World, globals: &Globals) -> Result<(Picture, String), CliError> {
    let bounds = world.scene().tree().bounds();
    let camera = args.view.camera(world.model(), bounds)?;
    let lights = args.view.lights(world.model(), bounds);
    let options = options(args);
    let pixels = match options.crop {
        Some(crop) => crop.width * crop.height,
        None => options.width * options.height,
    };
    let last = Mutex::new(RenderProgress::default());

    let progress = Progress::start("rendering", pixels as u64, "pixels", globals);
    let _watch = interrupt::watch();
    let picture = kdray_render::render_with_progress(world, &camera, &lights, &options, &|done| {
        *last.lock().unwrap_or_else(PoisonError::into_inner) = done;
        progress.set_fraction(done.fraction);
        interrupt::flow()
    })?;

    let took = progress.elapsed();
    let last = last.into_inner().unwrap_or_else(PoisonError::into_inner);
    let megarays = last.rays as f64 / 1e6;
    let rate = megarays / took.as_secs_f64().max(1e-9);
    let (width, height) = (picture.width, picture.height);
    let share = match picture.complete {
        true => String::new(),
        false => format!("{:.0} % of ", last.fraction * 100.0),
    };
    let report = format!(
        "rendered {share}{width} x {height} pixels with {megarays:.1} million rays in {took:.2?} \
         ({rate:.2} Mrays/s)"
    );
    Ok((picture, report))
}

fn options(args: &Args) -> RenderOptions {
    let (quality, default) = (&args.quality, RenderOptions::default());
    RenderOptions {
        width: args.view.size.width,
        height: args.view.size.height,
        samples: quality.samples,
        crop: args.part.crop,
        sample_range: args.part.sample_range.clone(),
        max_bounces: quality.bounces,
        picture: quality.picture.kind(),
        packets: !quality.no_packets,
        all_layers: quality.layers,
        seed: quality.seed,
        background: quality.background.map_or_else(|| args.view.sky(), Background::Color),
        ambient: quality.ambient.unwrap_or(default.ambient),
        ambient_rays: quality.ambient_rays,
        occlusion_distance: quality.occlusion_distance.or(default.occlusion_distance),
        light_samples: quality.light_samples,
        exposure: quality.exposure,
        heat_max: quality.heat_max.or(default.heat_max),
    }
}

impl Shown {
    /// The library's name for it.
    fn kind(self) -> PictureKind {
        match self {
            Self::Shaded => PictureKind::Shaded,
            Self::Depth => PictureKind::Depth,
            Self::Normal => PictureKind::Normal,
            Self::PrimitiveId => PictureKind::PrimitiveId,
            Self::AmbientOcclusion => PictureKind::AmbientOcclusion,
            Self::Cost => PictureKind::Cost,
            Self::CostNodes => PictureKind::CostNodes,
            Self::CostPrimitives => PictureKind::CostPrimitives,
            Self::PacketCost => PictureKind::PacketCost,
            Self::PacketSize => PictureKind::PacketSize,
        }
    }
}
