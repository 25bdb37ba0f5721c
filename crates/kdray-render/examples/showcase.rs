//! Renders the built-in scene: `cargo run --release -p kdray-render --example showcase`.

use kdray::BuildOptions;
use kdray_render::{PngDepth, RenderOptions, World, render};
use std::ops::ControlFlow;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1);
    let mut number = |default: usize| args.next().and_then(|a| a.parse().ok()).unwrap_or(default);
    let (width, height, samples) = (number(960), number(540), number(16));
    let go_on = ControlFlow::Continue(());
    let start = Instant::now();
    let model = kdray_scene::built_in::showcase();
    eprintln!("scene {:?}, {} triangles", start.elapsed(), model.triangles.len());
    let start = Instant::now();
    let world = World::new(model, &BuildOptions::default(), &|_| go_on)?;
    eprintln!("build {:?}", start.elapsed());
    let start = Instant::now();
    let options = RenderOptions { width, height, samples: samples as u32, ..Default::default() };
    let model = world.model();
    let rays = std::sync::atomic::AtomicU64::new(0);
    let picture = render(&world, &model.cameras[0], &model.lights, &options, &|p| {
        rays.store(p.rays, std::sync::atomic::Ordering::Relaxed);
        go_on
    })?;
    eprintln!("render {:?}, {:?} rays", start.elapsed(), rays);
    picture.write_png("/tmp/showcase.png", PngDepth::Eight)?;
    Ok(())
}
