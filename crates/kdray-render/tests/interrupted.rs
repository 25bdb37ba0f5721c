//! Renders that are told of and stopped.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod support;

use kdray_render::{
    Picture, PictureKind, PngDepth, RenderOptions, RenderProgress, render_with_progress,
};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use support::*;

/// A render on one thread that is stopped after this many tiles.
fn stopped_after(tiles: usize, options: &RenderOptions) -> Picture {
    let (world, camera, lights) = still_life();
    let calls = AtomicUsize::new(0);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let picture = pool.install(|| {
        render_with_progress(&world, &camera, &lights, options, &|progress| {
            assert_eq!(progress.tiles_done, calls.fetch_add(1, Ordering::Relaxed) + 1);
            if progress.tiles_done == tiles {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })
    });
    picture.unwrap()
}

#[test]
fn an_interrupted_render_keeps_what_is_done() {
    let picture = stopped_after(3, &small(PictureKind::Shaded));
    assert!(!picture.complete);
    let done = picture.floats("color", "A").unwrap().iter().filter(|&&a| a == 1.0).count();
    assert_eq!(done, 3 * 16 * 16);
}

#[test]
fn who_has_stopped_a_render_is_not_called_again() {
    let (world, camera, lights) = still_life();
    let calls = AtomicUsize::new(0);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let options = small(PictureKind::Shaded);
    let render = || {
        render_with_progress(&world, &camera, &lights, &options, &|_| {
            calls.fetch_add(1, Ordering::Relaxed);
            // The only thread turns to another tile, of which nothing is told.
            rayon::yield_now();
            ControlFlow::Break(())
        })
    };
    let picture = pool.install(render).unwrap();
    assert!(picture.rendered.iter().filter(|&&done| done).count() > 16 * 16, "a tile in flight");
    assert_eq!((picture.complete, calls.into_inner()), (false, 1));
}

#[test]
fn what_was_not_rendered_is_transparent_in_every_kind_of_picture() {
    for kind in PictureKind::ALL {
        // Less than 64 pixels across, there is no key to a heat map.
        let options = RenderOptions { width: 48, ..small(kind) };
        let picture = stopped_after(3, &options);
        assert_eq!(picture.rendered.iter().filter(|&&done| done).count(), 3 * 16 * 16, "{kind:?}");
        let shown = image::load_from_memory(&png(&picture, PngDepth::Eight)).unwrap().to_rgba8();
        for (pixel, &rendered) in shown.pixels().zip(&picture.rendered) {
            assert_eq!(pixel.0[3], if rendered { 255 } else { 0 }, "{kind:?}");
        }
    }
    let ids = stopped_after(1, &small(PictureKind::PrimitiveId));
    let undone = ids.rendered.iter().zip(ids.ids("primitive", "id").unwrap());
    assert!(undone.filter(|(done, _)| !**done).all(|(_, &id)| id == u32::MAX));
}

#[test]
fn what_was_not_rendered_does_not_count_for_a_heat_scale() {
    let options = RenderOptions { all_layers: true, ..small(PictureKind::CostNodes) };
    let whole = stopped_after(usize::MAX, &options);
    let expensive = |i: usize| whole.floats("cost", "nodes").unwrap()[i] >= 3.0;
    // As if nothing but one expensive pixel had been rendered: it has the scale's last colour.
    let one = (0..64 * 24).find(|&i| expensive(i)).unwrap();
    let mut rendered = vec![false; 64 * 48];
    rendered[one] = true;
    let picture = Picture { rendered, complete: false, ..whole };
    let shown = image::load_from_memory(&png(&picture, PngDepth::Eight)).unwrap().to_rgba8();
    let [r, g, b, _] = shown.get_pixel(one as u32 % 64, one as u32 / 64).0;
    assert!(r > 100 && g < 50 && b < 50, "{r} {g} {b}");
}

#[test]
fn a_callback_may_use_the_threads_that_render() {
    let (sender, ended) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        let (world, camera, lights) = still_life();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let told = AtomicUsize::new(0);
        // The only thread turns to another tile while it is told of the first.
        let progress = |progress: RenderProgress| {
            assert!(progress.tiles_done > told.swap(progress.tiles_done, Ordering::Relaxed));
            rayon::yield_now();
            ControlFlow::Continue(())
        };
        let options = small(PictureKind::Shaded);
        let render = || render_with_progress(&world, &camera, &lights, &options, &progress);
        let complete = pool.install(render).unwrap().complete;
        sender.send((complete, told.into_inner())).unwrap();
    });
    let ended = ended.recv_timeout(std::time::Duration::from_secs(120));
    assert_eq!(ended, Ok((true, 12)), "all tiles, and the last progress tells of all");
}
