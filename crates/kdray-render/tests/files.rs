//! Pictures as PNG and OpenEXR.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod support;

use exr::prelude::{ReadChannels, ReadLayers};
use kdray_render::{Picture, PictureKind, PngDepth, RenderOptions, Samples, WriteError};
use std::io::{self, Cursor, Write};
use support::*;

#[test]
fn files_hold_what_was_computed() {
    let (world, camera, lights) = still_life();
    let options = RenderOptions { all_layers: true, ..small(PictureKind::Shaded) };
    let picture = shoot(&world, &camera, &lights, &options);
    let mut file = Vec::new();
    picture.write_exr(&mut file).unwrap();
    let read = exr::prelude::read().no_deep_data().largest_resolution_level().all_channels();
    let read = read.all_layers().all_attributes().from_buffered(Cursor::new(file)).unwrap();
    let channels = &read.layer_data[0].channel_data.list;
    let names: Vec<String> = channels.iter().map(|c| c.name.to_string()).collect();
    let expected = [
        "A",
        "B",
        "G",
        "R",
        "cost.nodes",
        "cost.primitives",
        "depth.Z",
        "normal.X",
        "normal.Y",
        "normal.Z",
        "occlusion.V",
        "packet.cost",
        "packet.size",
        "primitive.id",
    ];
    assert_eq!(names, expected);
    let values = |name: &str| &channels.iter().find(|c| c.name.eq(name)).unwrap().sample_data;
    let depth: Vec<f32> = values("depth.Z").values_as_f32().collect();
    assert_eq!(depth, picture.floats("depth", "Z").unwrap());
    let exr::prelude::FlatSamples::U32(ids) = values("primitive.id") else { panic!("not whole") };
    assert_eq!(ids, picture.ids("primitive", "id").unwrap());

    let image = image::load_from_memory(&png(&picture, PngDepth::Sixteen)).unwrap();
    assert_eq!((image.width(), image.height()), (64, 48));
    assert_eq!(image.color(), image::ColorType::Rgba16);
}

/// A place with room for so many bytes.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_that_keeps_its_cause() {
    let (world, camera, lights) = still_life();
    let picture = shoot(&world, &camera, &lights, &small(PictureKind::Depth));
    for room in [0, 50] {
        for error in [
            picture.write_png(Full(room), PngDepth::Eight).unwrap_err(),
            picture.write_exr(Full(room)).unwrap_err(),
        ] {
            let WriteError::Io(cause) = &error else { panic!("{error:?}") };
            assert_eq!(cause.kind(), io::ErrorKind::StorageFull);
            assert!(!error.to_string().contains(&cause.to_string()), "told once: {error}");
        }
    }
}

#[test]
fn a_picture_that_no_file_can_hold_is_refused() {
    let (world, camera, lights) = still_life();
    let picture = shoot(&world, &camera, &lights, &plain(1, 1, 1));
    for (width, height) in [(1 << 32, 0), (1 << 31, 1), (0, 0), (1, usize::MAX)] {
        for error in refusals(&Picture { width, height, ..picture.clone() }) {
            assert!(matches!(error, WriteError::Size { .. }), "{width} x {height}: {error:?}");
        }
    }
}

#[test]
fn a_picture_that_contradicts_itself_is_refused() {
    let (world, camera, lights) = still_life();
    for kind in PictureKind::ALL {
        let good =
            shoot(&world, &camera, &lights, &RenderOptions { picture: kind, ..plain(2, 1, 1) });
        for rendered in [vec![], vec![true; 1], vec![true; 3]] {
            is_refused(&Picture { rendered, ..good.clone() }, "rendered");
        }
        for (width, height) in [(1, 1), (3, 1), ((1 << 30) - 2, (1 << 30) - 2)] {
            is_refused(&Picture { width, height, ..good.clone() }, "rendered");
        }
        for length in [0, 1, 3] {
            let mut bad = good.clone();
            let layer = &mut bad.layers[0];
            let channel = layer.channels.last_mut().unwrap();
            match &mut channel.samples {
                Samples::F32(samples) => samples.resize(length, 0.0),
                Samples::U32(samples) => samples.resize(length, 0),
            }
            let name = format!("{}.{}", layer.name, channel.name);
            is_refused(&bad, &name);
        }
    }
}

#[test]
fn a_png_of_what_was_not_rendered_is_refused() {
    let (world, camera, lights) = still_life();
    let picture = shoot(&world, &camera, &lights, &plain(2, 1, 1));
    for kind in PictureKind::ALL.into_iter().filter(|&kind| kind != PictureKind::Shaded) {
        let picture = Picture { kind, ..picture.clone() };
        let refused = picture.write_png(Vec::new(), PngDepth::Eight);
        assert!(matches!(refused, Err(WriteError::NotThere(it)) if it == kind), "{refused:?}");
    }
}

#[test]
fn names_that_no_exr_can_hold_are_refused() {
    let (world, camera, lights) = still_life();
    let picture = shoot(&world, &camera, &lights, &plain(2, 1, 1));
    for name in ["", "G", "日"] {
        let mut picture = picture.clone();
        picture.layers[0].channels[0].name = name;
        let refused = picture.write_exr(Vec::new());
        assert!(matches!(refused, Err(WriteError::Encode(_))), "{name}: {refused:?}");
    }
    let nothing = Picture { layers: vec![], ..picture };
    let refused = nothing.write_exr(Vec::new());
    assert!(matches!(refused, Err(WriteError::Encode(_))), "{refused:?}");
}

/// Whether both formats refuse the picture for the length of a list.
fn is_refused(picture: &Picture, bad: &str) {
    for error in refusals(picture) {
        let WriteError::Length { list, .. } = &error else { panic!("{error:?}") };
        assert_eq!(list, bad, "{error}");
    }
}

fn refusals(picture: &Picture) -> [WriteError; 2] {
    let png = picture.write_png(Vec::new(), PngDepth::Eight);
    [png.unwrap_err(), picture.write_exr(Vec::new()).unwrap_err()]
}
