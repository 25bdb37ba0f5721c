//! Pictures that are rendered in parts, and put together.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod support;

use kdray_render::{
    Crop, Merge, MergeError, Picture, PictureKind, PngDepth, ReadError, RenderError, RenderOptions,
    World, WriteError, render,
};
use kdray_scene::{Camera, Light};
use std::io::Cursor;
use std::ops::Range;
use std::sync::LazyLock;
use support::*;

static SCENE: LazyLock<(World, Camera, Vec<Light>)> = LazyLock::new(still_life);

/// All layers of a picture whose sides are no multiples of a tile's.
fn all_layers() -> RenderOptions {
    RenderOptions {
        width: 40,
        height: 28,
        samples: 4,
        all_layers: true,
        ..small(PictureKind::Cost)
    }
}

fn shot(options: &RenderOptions) -> Picture {
    let (world, camera, lights) = &*SCENE;
    shoot(world, camera, lights, options)
}

/// The part of `options` in these columns and rows, of these samples.
fn part(
    options: &RenderOptions,
    columns: Range<usize>,
    rows: Range<usize>,
    samples: Range<u32>,
) -> Picture {
    let [x, y, width, height] = [columns.start, rows.start, columns.len(), rows.len()];
    let crop = Some(Crop { x, y, width, height });
    shot(&RenderOptions { crop, sample_range: Some(samples), ..options.clone() })
}

/// Parts that were written, read and merged.
fn merged(parts: &[Picture]) -> Result<Picture, MergeError> {
    added(Merge::default(), parts)?.finish()
}

fn added(mut merge: Merge, parts: &[Picture]) -> Result<Merge, MergeError> {
    for (i, part) in parts.iter().enumerate() {
        let read = read(&exr(part));
        assert_eq!(&read, part, "what is written is read again");
        merge.add(&format!("part {i}"), &read)?;
    }
    Ok(merge)
}

fn exr(picture: &Picture) -> Vec<u8> {
    let mut file = Vec::new();
    picture.write_exr(&mut file).unwrap();
    file
}

fn read(file: &[u8]) -> Picture {
    Picture::read_exr(Cursor::new(file)).unwrap()
}

/// The tile's middle, as a render that was interrupted would leave it.
fn interrupted(mut picture: Picture, keep: impl Fn(usize) -> bool) -> Picture {
    picture.complete = false;
    for (i, rendered) in picture.rendered.iter_mut().enumerate() {
        *rendered = keep(i);
    }
    for channel in picture.layers.iter_mut().flat_map(|layer| &mut layer.channels) {
        match &mut channel.samples {
            kdray_render::Samples::F32(values) => blank(values, &picture.rendered, 0.0),
            kdray_render::Samples::U32(values) => blank(values, &picture.rendered, u32::MAX),
        }
    }
    picture
}

fn blank<T: Copy>(values: &mut [T], rendered: &[bool], nothing: T) {
    let left_out = values.iter_mut().zip(rendered).filter(|&(_, &rendered)| !rendered);
    left_out.for_each(|(value, _)| *value = nothing);
}

#[test]
fn crops_make_the_picture_bit_for_bit() {
    let options = all_layers();
    let whole = shot(&options);
    // Across tiles, and in any order.
    let crops = [(25..40, 0..9), (0..25, 9..28), (0..25, 0..9), (25..40, 9..28)];
    let parts = crops.map(|(columns, rows)| part(&options, columns, rows, 0..4));
    let merged = merged(&parts).unwrap();
    assert_eq!(merged, whole);
    assert_eq!(exr(&merged), exr(&whole));
    assert_eq!(png(&merged, PngDepth::Sixteen), png(&whole, PngDepth::Sixteen));
}

#[test]
fn ranges_of_samples_make_the_picture_but_for_rounding() {
    let options = all_layers();
    let whole = shot(&options);
    let parts = [0..1, 1..4].map(|samples| part(&options, 0..40, 0..28, samples));
    assert_ne!(parts[0].floats("color", "G"), parts[1].floats("color", "G"));
    let merged = merged(&parts).unwrap();
    assert_eq!((&merged.part, merged.complete), (&whole.part, true));
    for (layer, found) in whole.layers.iter().zip(&merged.layers) {
        for (channel, found) in layer.channels.iter().zip(&found.channels) {
            let name = format!("{}.{}", layer.name, channel.name);
            match (&channel.samples, &found.samples) {
                (kdray_render::Samples::F32(a), kdray_render::Samples::F32(b)) => {
                    for (a, b) in a.iter().zip(b) {
                        let same = a.to_bits() == b.to_bits();
                        assert!(same || (a - b).abs() <= 1e-6 * a.abs(), "{name}: {a} and {b}");
                    }
                }
                (a, b) => assert_eq!(a, b, "{name}"),
            }
        }
    }
}

#[test]
fn tiles_of_unlike_ranges_go_together() {
    let options = RenderOptions { picture: PictureKind::Shaded, all_layers: false, ..all_layers() };
    let whole = shot(&options);
    let parts = [
        part(&options, 0..20, 0..28, 0..2),
        part(&options, 0..20, 0..28, 2..4),
        part(&options, 20..40, 0..28, 1..4),
        part(&options, 20..40, 0..28, 0..1),
    ];
    let merged = merged(&parts).unwrap();
    let channel = |picture: &Picture| picture.floats("color", "R").unwrap().to_vec();
    for (a, b) in channel(&whole).into_iter().zip(channel(&merged)) {
        assert!((a - b).abs() <= 1e-6 * a.abs(), "{a} and {b}");
    }
    assert_eq!((merged.complete, merged.part), (true, whole.part));
}

#[test]
fn what_is_missing_is_named_or_left_out() {
    let options = RenderOptions { all_layers: false, ..all_layers() };
    let whole = shot(&options);
    let left = part(&options, 0..17, 0..28, 0..4);
    let refused = merged(std::slice::from_ref(&left)).unwrap_err();
    let missing = MergeError::Missing { pixels: 23 * 28, all: 40 * 28, x: 17, y: 0, sample: 0 };
    assert_eq!(refused, missing);

    // Pixels: the merge is a part that lacks them, and can be completed.
    let merge = added(Merge::default().allow_missing(), std::slice::from_ref(&left)).unwrap();
    let half = merge.finish().unwrap();
    assert_eq!((half.complete, half.part.sample_range.clone()), (false, 0..4));
    assert_eq!(half.rendered.iter().filter(|&&it| it).count(), 17 * 28);
    let right = part(&options, 17..40, 0..28, 0..4);
    assert_eq!(merged(&[half, right.clone()]).unwrap(), whole);

    // Samples of all pixels: the merge is the part that has the others.
    let some = part(&options, 0..40, 0..28, 0..3);
    let refused = merged(std::slice::from_ref(&some)).unwrap_err();
    assert!(matches!(refused, MergeError::Missing { x: 0, y: 0, sample: 3, .. }), "{refused}");
    let merge = added(Merge::default().allow_missing(), std::slice::from_ref(&some)).unwrap();
    assert_eq!(merge.finish().unwrap(), some);

    // Samples of some pixels: these have the mean of the others, and the file says how many.
    let few = part(&options, 0..17, 0..28, 1..2);
    let merge = added(Merge::default().allow_missing(), &[few.clone(), right]).unwrap();
    let mixed = merge.finish().unwrap();
    assert!(!mixed.complete && mixed.rendered.iter().all(|&it| it));
    assert_eq!(mixed.floats("cost", "nodes").unwrap()[0], few.floats("cost", "nodes").unwrap()[0]);
    let counts = mixed.ids("samples", "count").unwrap();
    assert_eq!([counts[16], counts[17], counts[40]], [1, 4, 1]);
    let refused = merged(&[mixed]).unwrap_err();
    assert!(matches!(refused, MergeError::Mixed { .. }), "{refused}");
    assert_eq!(merged(&[]).unwrap_err(), MergeError::NoParts);
}

#[test]
fn an_interrupted_part_is_as_much_as_it_has() {
    let options = all_layers();
    let whole = shot(&options);
    let begun = interrupted(whole.clone(), |i| i % 40 < 16);
    let refused = merged(std::slice::from_ref(&begun)).unwrap_err();
    assert!(matches!(refused, MergeError::Missing { x: 16, y: 0, sample: 0, .. }), "{refused}");
    let rest = part(&options, 16..40, 0..28, 0..4);
    assert_eq!(merged(&[begun.clone(), rest]).unwrap(), whole);
    let too_much = part(&options, 15..40, 0..28, 0..4);
    let refused = merged(&[too_much, begun]).unwrap_err();
    let (first, second) = ("part 0".to_owned(), "part 1".to_owned());
    assert_eq!(refused, MergeError::Overlap { first, second, sample: 0, x: 15, y: 0 });
}

#[test]
fn the_same_samples_twice_are_refused() {
    let options = RenderOptions { all_layers: false, ..all_layers() };
    let first = part(&options, 0..20, 0..20, 0..3);
    let second = part(&options, 19..40, 18..28, 2..4);
    let refused = merged(&[first.clone(), second]).unwrap_err();
    assert!(matches!(refused, MergeError::Overlap { x: 19, y: 18, sample: 2, .. }), "{refused}");
    let text = refused.to_string();
    assert!(text.contains("part 0 and part 1 both have sample 2 of pixel (19, 18)"), "{text}");
    let merge = added(Merge::default().allow_missing(), &[first.clone(), first]);
    assert!(matches!(merge.unwrap_err(), MergeError::Overlap { x: 0, y: 0, sample: 0, .. }));
}

#[test]
fn parts_of_different_pictures_are_refused() {
    let options = RenderOptions { all_layers: false, ..all_layers() };
    let good = part(&options, 0..20, 0..28, 0..4);
    let rest = |options| part(&options, 20..30, 0..28, 0..2);
    let o = || options.clone();
    for (other, what) in [
        (rest(RenderOptions { height: 29, ..o() }), "size is 40 x 28 pixels and 40 x 29 pixels"),
        (rest(RenderOptions { samples: 5, ..o() }), "samples is 4 and 5"),
        (rest(RenderOptions { seed: 7, ..o() }), "seed is 0 and 7"),
        (
            rest(RenderOptions { picture: PictureKind::CostNodes, ..o() }),
            "picture is cost and cost-n",
        ),
        (rest(RenderOptions { all_layers: true, ..o() }), "layers is cost of 2 and color of 4"),
        (rest(RenderOptions { exposure: 2.0, ..o() }), "exposure is 1 and 2"),
        (rest(RenderOptions { heat_max: Some(9.0), ..o() }), "heat_max is none and 9"),
        (rest(RenderOptions { max_bounces: 3, ..o() }), "their scenes, cameras, lights or options"),
    ] {
        let refused = merged(&[good.clone(), other]).unwrap_err().to_string();
        assert!(refused.contains(what), "no `{what}` in {refused}");
        assert!(refused.starts_with("part 0 and part 1 are parts of different pictures"));
    }
    // Of how it is traced nothing depends.
    let rest = part(&RenderOptions { packets: false, ..o() }, 20..40, 0..28, 0..4);
    assert_eq!(merged(&[good, rest]).unwrap(), shot(&options));
}

#[test]
fn pictures_of_different_scenes_differ_in_their_hash() {
    let (world, camera, lights) = &*SCENE;
    let options = plain(2, 2, 1);
    let scene = |world: &World, camera: &Camera, lights: &[Light]| {
        render(world, camera, lights, &options).unwrap().part.scene
    };
    let hash = scene(world, camera, lights);
    assert_eq!(hash, scene(&still_life().0, camera, lights), "the same scene, built again");
    assert_ne!(hash, scene(world, &from_above(0.0, 0.0, 4.0), lights));
    assert_ne!(hash, scene(world, camera, &lights[..1]));
    let built = |change: &dyn Fn(&mut kdray_scene::Model)| {
        let mut model = kdray_scene::Model { textures: vec![checker()], ..Default::default() };
        model.materials = vec![textured(lambert(0.5))];
        add_floor(&mut model, 1.0, 0.0, 0);
        change(&mut model);
        scene(&support::world(model), camera, lights)
    };
    let hash = built(&|_| {});
    assert_eq!(hash, built(&|_| {}));
    assert_ne!(hash, built(&|model| model.vertices[0][1] += 1e-6));
    assert_ne!(hash, built(&|model| model.triangles[0].rotate_left(1)));
    assert_ne!(hash, built(&|model| model.materials[0].roughness = 0.5));
    assert_ne!(hash, built(&|model| model.textures[0].pixels[63][2] = 0.25));
    assert_ne!(hash, built(&|model| model.uvs[1][2][0] = 0.5));
}

#[test]
fn middles_must_be_the_same_in_all_parts() {
    for kind in [PictureKind::Depth, PictureKind::Normal, PictureKind::PrimitiveId] {
        let options = RenderOptions { all_layers: false, picture: kind, ..all_layers() };
        let [first, mut second] = [0..2, 2..4].map(|range| part(&options, 0..40, 0..28, range));
        assert_eq!(merged(&[first.clone(), second.clone()]).unwrap(), shot(&options));
        match &mut second.layers[0].channels[0].samples {
            kdray_render::Samples::F32(values) => values[41] = 1234.5,
            kdray_render::Samples::U32(values) => values[41] ^= 1,
        }
        let refused = merged(&[first, second]).unwrap_err();
        assert!(matches!(refused, MergeError::Disagree { x: 1, y: 1, .. }), "{refused}");
    }
}

#[test]
fn parts_that_are_none_of_the_picture_are_refused() {
    let (world, camera, lights) = &*SCENE;
    let refused = |options: &RenderOptions| render(world, camera, lights, options).unwrap_err();
    let options = plain(8, 6, 4);
    for (x, y, width, height) in [
        (0, 0, 0, 1),
        (0, 0, 1, 0),
        (8, 0, 1, 1),
        (0, 5, 8, 2),
        (1, 0, 8, 6),
        (usize::MAX, 0, 2, 1),
    ] {
        let crop = Some(Crop { x, y, width, height });
        let error = refused(&RenderOptions { crop, ..options.clone() });
        assert!(matches!(error, RenderError::Crop { .. }), "{error}");
    }
    for (start, end) in [(0, 0), (4, 5), (3, 2), (0, 5), (2, u32::MAX)] {
        let sample_range = Some(start..end);
        let error = refused(&RenderOptions { sample_range, ..options.clone() });
        assert!(matches!(error, RenderError::SampleRange { .. }), "{error}");
    }
    let crop = Some(Crop { x: 1 << 40, y: 0, width: 1, height: 1 });
    let error = refused(&RenderOptions { width: 1 << 41, crop, ..options });
    assert!(matches!(error, RenderError::Option { .. }), "{error}");
}

#[test]
fn a_small_part_of_a_huge_picture_is_rendered() {
    let crop = Some(Crop { x: 700_000_001, y: 300_000_000, width: 3, height: 2 });
    let options = RenderOptions { crop, ..plain(1_000_000_000, 1_000_000_000, 2) };
    let picture = shot(&options);
    assert_eq!((picture.width, picture.height, picture.complete), (3, 2, true));
    assert_eq!(read(&exr(&picture)), picture);
    let refused = Merge::default().add("part", &picture).unwrap_err();
    assert!(matches!(refused, MergeError::TooLarge { .. }), "{refused}");
}

#[test]
fn a_picture_that_is_no_part_of_its_whole_is_not_written() {
    let good = shot(&plain(2, 2, 2));
    for change in [
        |it: &mut Picture| it.part.x = 1,
        |it: &mut Picture| it.part.full_height = 1,
        |it: &mut Picture| it.part.sample_range = 0..3,
        |it: &mut Picture| it.part.sample_range = 1..1,
    ] {
        let mut bad = good.clone();
        change(&mut bad);
        let refused = bad.write_exr(Vec::new());
        assert!(matches!(refused, Err(WriteError::Part(_))), "{refused:?}");
        let refused = Merge::default().add("part", &bad);
        assert!(matches!(refused, Err(MergeError::Inconsistent { .. })), "{refused:?}");
    }
}

#[test]
fn files_that_are_no_parts_are_refused() {
    let refused = |file: &[u8]| Picture::read_exr(Cursor::new(file)).unwrap_err();
    assert!(matches!(refused(b""), ReadError::Exr(_)));
    assert!(matches!(refused(&png(&shot(&plain(2, 2, 1)), PngDepth::Eight)), ReadError::Exr(_)));
    let mut other = Cursor::new(Vec::new());
    let pixel = |_| (0.5_f32, 0.5_f32, 0.5_f32);
    let channels = exr::prelude::SpecificChannels::rgb(pixel);
    let image = exr::prelude::Image::from_channels((4, 4), channels);
    exr::prelude::WritableImage::write(&image).to_buffered(&mut other).unwrap();
    let error = refused(other.get_ref());
    assert!(error.to_string().contains("it has no attribute `kdray`"), "{error}");
}

/// Whatever is changed in a file, it is refused, or is a picture that can be used.
#[test]
fn broken_files_are_no_danger() {
    let options = RenderOptions { all_layers: true, ..plain(5, 4, 2) };
    let crop = Some(Crop { x: 1, y: 1, width: 3, height: 2 });
    let picture = interrupted(shot(&RenderOptions { crop, ..options }), |i| i > 0);
    let file = exr(&picture);
    let mut read = 0;
    for at in 0..file.len() {
        for value in [0, 255, file[at] ^ 1] {
            let mut bad = file.clone();
            bad[at] = value;
            if let Ok(picture) = Picture::read_exr(Cursor::new(bad)) {
                read += 1;
                // One byte can make a picture that is allowed, and needs gigabytes.
                if picture.part.full_width.max(picture.part.full_height) > 1000 {
                    continue;
                }
                let mut merge = Merge::default().allow_missing();
                if merge.add("part", &picture).is_ok() {
                    merge.finish().unwrap().write_exr(Vec::new()).unwrap();
                }
            }
        }
        assert!(Picture::read_exr(Cursor::new(&file[..at])).is_err(), "cut after {at} bytes");
    }
    assert!(read > 0, "some bytes are no more than values");
}
