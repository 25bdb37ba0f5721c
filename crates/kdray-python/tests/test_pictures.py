"""Pictures."""

import struct

import numpy as np
import pytest
from conftest import CUBE_FACES, CUBE_VERTICES
from test_errors import fails

import kdray

SMALL = {"width": 48, "height": 32, "samples": 1}


def test_a_picture_is_an_array(cube):
    picture = cube.render(**SMALL)
    assert picture.shape == (32, 48, 3) and picture.dtype == np.uint8 and picture.std() > 10
    png = picture._repr_png_()
    assert png.startswith(b"\x89PNG") and struct.unpack(">II", png[16:24]) == (48, 32)
    light = np.stack([picture.layers[f"color.{c}"] for c in "RGB"], axis=-1)
    assert light.shape == (32, 48, 3) and light.dtype == np.float32
    display = np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.clip(light, 0, 1) ** (1 / 2.4) - 0.055)
    np.testing.assert_allclose(picture, np.clip(display, 0, 1) * 255, atol=1)


def test_the_same_seed_gives_the_same_picture(cube):
    pictures = [cube.render(**SMALL, threads=threads) for threads in (1, 3)]
    np.testing.assert_array_equal(*pictures)
    others = cube.render(width=48, height=32, samples=4, seed=1), cube.render(width=48, height=32, samples=4, seed=2)
    assert not np.array_equal(*others)


def test_up_turns_frame_and_sky():
    boxes = np.concatenate([CUBE_VERTICES * [1, 2, 3], CUBE_VERTICES * [1, 1, 1] + [2, 0, 0]]).astype(np.float32)
    faces = np.concatenate([CUBE_FACES, CUBE_FACES + 8])
    look = {**SMALL, "ambient_rays": 0}
    upright = kdray.Scene(boxes, faces).render(**look)
    turned = np.stack([boxes[:, 0], -boxes[:, 2], boxes[:, 1]], axis=1)
    picture = kdray.Scene(turned, faces).render(**look, up=[0, 0, 1])
    assert np.mean(np.abs(picture.astype(int) - upright) > 2) < 0.01
    wide = {"eye": [9, 0, 0], "look_at": [30, 0, 0], "fov": 90}
    red = kdray.Scene(boxes, faces).render(**look, **wide, up=[0, 0, 1]).layers["color.R"]
    assert np.all(np.diff(red[:16], axis=0) > 0) and np.ptp(red[16:]) == 0


def test_rays_of_a_picture_are_those_of_queries(cube):
    view = {"eye": [0.5, 0.4, 5], "look_at": [0.5, 0.4, 0], "up": [0, 1, 0], "fov": 20}
    depth = cube.render(**SMALL, **view, picture="depth").layers["depth.Z"]
    y, x = np.mgrid[0:32, 0:48] + 0.5
    half = np.tan(np.radians(10))
    directions = np.stack([(2 * x / 48 - 1) * half * 1.5, (1 - 2 * y / 32) * half, -np.ones_like(x)], axis=-1)
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    hits = cube.closest_hit(view["eye"], directions)
    np.testing.assert_allclose(depth, hits.t, rtol=1e-5)
    ids = cube.render(**SMALL, **view, picture="primitive-id").layers["primitive.id"]
    np.testing.assert_array_equal(ids.astype(np.int32), hits.primitive_id)


def test_parts_of_a_picture(cube):
    whole = cube.render(width=48, height=32, samples=4)
    part = cube.render(width=48, height=32, samples=4, crop=(7, 5, 30, 20))
    np.testing.assert_array_equal(part, whole[5:25, 7:37])
    light = [
        cube.render(width=48, height=32, samples=4, sample_range=(first, first + 2)).layers["color.G"]
        for first in (0, 2)
    ]
    np.testing.assert_allclose(np.mean(light, axis=0), whole.layers["color.G"], rtol=1e-5, atol=1e-6)
    fails(kdray.ArgumentError, "crop", lambda: cube.render(**SMALL, crop=(0, 0, 49, 1)))
    fails(kdray.ArgumentError, "crop", lambda: cube.render(**SMALL, crop=(0, 0, 9)))
    fails(kdray.ArgumentError, "sample_range", lambda: cube.render(**SMALL, sample_range=(1, 2)))


@pytest.mark.parametrize("name", ["depth", "normal", "ambient-occlusion", "cost", "cost-nodes", "packet-cost"])
def test_other_pictures(cube, name):
    picture = cube.render(**SMALL, picture=name)
    assert picture.shape == (32, 48, 3) and picture.layers
    # From a convex body all of the sky is seen.
    assert (picture.std() > 1) == (name != "ambient-occlusion")


def test_all_layers(cube):
    layers = cube.render(**SMALL, layers=True).layers
    assert {"color.R", "depth.Z", "normal.X", "primitive.id", "cost.nodes", "cost.primitives"} <= set(layers)
    assert layers["cost.nodes"].max() > 0 and all(values.shape == (32, 48) for values in layers.values())


def test_a_picture_is_read_only_and_a_copy_is_not(cube, tmp_path):
    picture = cube.render(**SMALL)
    with pytest.raises(ValueError, match="read-only"):
        picture[:] = 0
    changed = picture.copy()
    changed[:] = 0
    fails(kdray.ArgumentError, "picture", changed.save, tmp_path / "a.png")
    assert picture.any()


def test_parts_are_arrays_only(cube, tmp_path):
    picture = cube.render(**SMALL)
    part = picture[4:8]
    assert part._repr_png_() is None
    assert type(picture + 1) is np.ndarray and isinstance(picture.mean(), float)
    with pytest.raises(kdray.ArgumentError, match="part"):
        part.layers
    picture.save(tmp_path / "a.png")
    picture.save(tmp_path / "a.exr")
    assert (tmp_path / "a.png").read_bytes() == picture._repr_png_()
    assert (tmp_path / "a.exr").read_bytes()[:4] == b"\x76\x2f\x31\x01"
    (tmp_path / "link.png").symlink_to(tmp_path / "a.png")
    with open(tmp_path / "a.png", "rb") as older:
        cube.render(**SMALL, background=(1, 0, 0)).save(tmp_path / "link.png")
        assert older.read() == picture._repr_png_()
    assert (tmp_path / "link.png").is_symlink()
    assert (tmp_path / "a.png").read_bytes() != picture._repr_png_()
    assert {path.name for path in tmp_path.iterdir()} == {"a.png", "a.exr", "link.png"}
    fails(kdray.ArgumentError, "path", picture.save, tmp_path / "a.jpg")
    fails(kdray.ArgumentError, "bits", picture.save, tmp_path / "a.png", bits=9)
    fails(kdray.MissingFileError, str(tmp_path / "no" / "a.png"), picture.save, tmp_path / "no" / "a.png")


def test_materials_of_a_file(tmp_path):
    (tmp_path / "red.mtl").write_text("newmtl red\nKd 1 0 0\n")
    lines = ["mtllib red.mtl", "usemtl red"]
    lines += [f"v {x} {y} {z}" for x, y, z in CUBE_VERTICES]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in CUBE_FACES]
    (tmp_path / "red.obj").write_text("\n".join(lines))
    view = {"eye": [0.5, 0.4, 3], "look_at": [0.5, 0.4, 0], "light": [[0, 0, 5], [1, 1, 5]]}
    red = kdray.Scene.of(tmp_path / "red.obj").render(**SMALL, **view)[16, 24]
    grey = kdray.Scene(CUBE_VERTICES, CUBE_FACES).render(**SMALL, **view)[16, 24]
    assert int(red[0]) - int(red[1]) > 100 and np.ptp(grey.astype(int)) < 40


def test_bad_input(cube):
    wrong, mistyped = kdray.ArgumentError, kdray.ArgumentTypeError
    cases = [
        ("width", {"width": 0}), ("width", {"width": -1}), ("width", {"width": 1 << 31, "height": 1 << 31}),
        ("eye", {"eye": [0, 0]}), ("eye", {"eye": [0, 0, float("nan")]}), ("eye, look_at", {"eye": [1, 1, 1], "look_at": [1, 1, 1]}),
        ("up", {"up": [0, 0, 0]}), ("fov", {"fov": 200}), ("camera", {"camera": "left"}), ("light", {"light": [1, 2]}),
        ("light", {"light": [float("inf")] * 3}), ("picture", {"picture": "photo"}), ("samples", {"samples": 0}),
        ("bounces", {"bounces": 100}), ("exposure", {"exposure": 0.0}), ("seed", {"seed": -1}), ("threads", {"threads": 0}),
    ]  # fmt: skip
    for name, options in cases:
        fails(wrong, name, cube.render, **({"width": 8, "height": 8} | options))
    for name, options in [
        ("width", {"width": 8.0}), ("fov", {"fov": "wide"}), ("eye", {"eye": "here"}), ("exposure", {"exposure": None}),
        ("exposure", {"exposure": np.complex64(1)}), ("crop", {"crop": 5}), ("sample_range", {"sample_range": 1}),
    ]:  # fmt: skip
        fails(mistyped, name, cube.render, **options)
    for scene in (kdray.Scene(CUBE_VERTICES.astype(float), CUBE_FACES),):
        with pytest.raises(kdray.UnsupportedError):
            scene.render(**SMALL)
    assert kdray.Scene().render(**SMALL).shape == (32, 48, 3)


def test_progress_and_what_it_raises(cube):
    told = []
    cube.render(**SMALL, progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (48 * 32, 48 * 32)

    def tell(done, total):
        raise LookupError("enough")

    with pytest.raises(LookupError):
        cube.render(width=2000, height=2000, samples=64, progress=tell)
