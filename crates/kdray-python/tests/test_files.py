"""Mesh files, tree files, pickles."""

import copy
import errno
import json
import os
import pickle
import subprocess
import sys

import numpy as np
import pytest
from conftest import CUBE_FACES, CUBE_VERTICES, random_rays, sphere
from test_errors import fails

import kdray


@pytest.fixture(params=[np.float32, np.float64])
def saved(request, tmp_path):
    """A scene and its file."""
    scene = kdray.Scene(*sphere(12), dtype=request.param)
    scene.save(tmp_path / "ball.kdray")
    return scene, tmp_path / "ball.kdray"


def write_obj(path, vertices=CUBE_VERTICES, faces=CUBE_FACES):
    lines = [f"v {x} {y} {z}" for x, y, z in vertices] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    path.write_text("\n".join(lines))
    return path


def same_answers(one, other):
    rays = random_rays(2000, np.float32)
    for name in ("t", "u", "v", "primitive_id", "front"):
        np.testing.assert_array_equal(getattr(one.closest_hit(rays), name), getattr(other.closest_hit(rays), name))
    np.testing.assert_array_equal(one.contains(rays[:, :3]), other.contains(rays[:, :3]))


def test_a_saved_scene_is_the_same(saved):
    scene, path = saved
    assert scene.path == str(path)
    for again in (kdray.Scene.load(path), kdray.Scene.mmap(str(path)), kdray.Scene.of(path)):
        same_answers(scene, again)
        assert again.is_built and again.path == str(path) and again.content_hash == scene.content_hash
        np.testing.assert_array_equal(again.vertices, scene.vertices)
        assert again.vertices.dtype == scene.dtype == again.dtype
        np.testing.assert_array_equal(again.faces, scene.faces)
        with pytest.raises(kdray.SceneError):
            again.add_triangles(CUBE_VERTICES, CUBE_FACES)


def test_the_content_hash_is_that_of_mesh_and_tree(saved):
    scene, _ = saved
    assert kdray.Scene(*sphere(12), dtype=scene.dtype).content_hash == scene.content_hash and len(scene.content_hash) == 16
    assert kdray.Scene(*sphere(12)).build("fast").content_hash != scene.content_hash
    assert kdray.Scene(*sphere(12, seed=7)).content_hash != scene.content_hash


@pytest.mark.parametrize("way", ["saved", "mmap", "load"])
def test_pickles_refer_to_the_file(saved, way):
    scene, path = saved
    scene = scene if way == "saved" else getattr(kdray.Scene, way)(path)
    text = pickle.dumps(scene)
    assert len(text) < 400 < os.path.getsize(path)
    again = pickle.loads(text)
    assert again is pickle.loads(text), "a file is opened once"
    same_answers(scene, again)
    program = "import pickle, sys; print(pickle.load(sys.stdin.buffer).any_hit([0, 0, 0], [0, 0, 1]))"
    told = subprocess.run([sys.executable, "-c", program], input=text, capture_output=True, check=True)
    assert told.stdout.strip() == b"True"


def test_pickling_needs_a_file_that_is_still_there(cube, saved):
    with pytest.raises(kdray.SceneError, match="save"):
        pickle.dumps(cube)
    scene, path = saved
    text = pickle.dumps(scene)
    kdray.Scene(*sphere(12, seed=1)).save(path)
    fails(kdray.FileError, f"{path}: the file has changed", pickle.loads, text)
    path.unlink()
    fails(kdray.MissingFileError, str(path), pickle.loads, text)
    assert scene.any_hit([0, 0, 0], [0, 0, 1])


def test_a_mapped_file_may_be_deleted_or_replaced(saved):
    scene, path = saved
    mapped = kdray.Scene.mmap(path)
    kdray.Scene(CUBE_VERTICES, CUBE_FACES).save(path)
    same_answers(mapped, scene)
    path.unlink()
    same_answers(mapped, scene)
    for open_it in (kdray.Scene.mmap, kdray.Scene.load, kdray.Scene.of):
        fails(kdray.MissingFileError, str(path), open_it, path)
    with pytest.raises(FileNotFoundError) as raised:
        kdray.Scene.mmap(path)
    assert raised.value.errno == errno.ENOENT


def test_damaged_files(saved):
    _, path = saved
    whole = path.read_bytes()
    path.write_bytes(whole[:-100])
    fails(kdray.FileError, str(path), kdray.Scene.load, path)
    fails(kdray.FileError, str(path), kdray.Scene.mmap, path)
    path.write_bytes(whole[:400] + b"\xff" + whole[401:])
    fails(kdray.FileError, str(path), kdray.Scene.load, path)
    path.write_bytes(b"")
    fails(kdray.FileError, str(path), kdray.Scene.mmap, path)
    path.write_bytes(whole)
    fails(kdray.FileError, str(path), kdray.Scene.load, path, memory_limit=1000)
    fails(kdray.ArgumentError, "memory_limit", kdray.Scene.load, path, memory_limit=-1)
    fails(kdray.ArgumentTypeError, "path", kdray.Scene.mmap, 5)
    fails(kdray.FileError, str(path.parent), kdray.Scene.mmap, path.parent)


def test_what_cannot_be_saved(cube, tmp_path):
    cube.add_triangles(CUBE_VERTICES, CUBE_FACES)
    with pytest.raises(kdray.SceneError, match="several"):
        cube.save(tmp_path / "two.kdray")
    copies = kdray.Scene(CUBE_VERTICES, CUBE_FACES)
    copies.add_instance(0, np.eye(4))
    with pytest.raises(kdray.UnsupportedError, match="instances"):
        copies.save(tmp_path / "copies.kdray")
    assert not list(tmp_path.iterdir())
    missing = tmp_path / "no" / "folder.kdray"
    fails(kdray.MissingFileError, str(missing), kdray.Scene(CUBE_VERTICES, CUBE_FACES).save, missing)


def test_mesh_files(tmp_path):
    path = write_obj(tmp_path / "cube.obj")
    for named in (path, str(path)):
        scene = kdray.Scene.of(named)
        assert len(scene) == 12 and scene.dtype == np.float32 and scene.count([0.3, 0.2, -1, 0, 0, 1]) == 2
    assert kdray.Scene.of(path, dtype=np.float64).vertices.dtype == np.float64
    two = kdray.Scene()
    assert [two.add(path), two.add(path)] == [0, 1] and len(two) == 24


def test_bad_mesh_files(tmp_path):
    missing = tmp_path / "none.ply"
    fails(kdray.MissingFileError, str(missing), kdray.Scene.of, missing)
    hollow = tmp_path / "hollow.gltf"
    buffer = {"uri": "not_there.bin", "byteLength": 4}
    hollow.write_text(json.dumps({"asset": {"version": "2.0"}, "buffers": [buffer]}))
    fails(kdray.MissingFileError, str(hollow), kdray.Scene.of, hollow)
    (tmp_path / "what").write_bytes(b"nothing known")
    fails(kdray.FileError, str(tmp_path / "what"), kdray.Scene.of, tmp_path / "what")
    holed = write_obj(tmp_path / "holed.obj", faces=np.vstack([CUBE_FACES, [[0, 1, 99]]]))
    fails(kdray.FileError, str(holed), kdray.Scene.of, holed)
    scene = kdray.Scene()
    with pytest.warns(UserWarning, match="drop") as warned:
        scene.add(holed, drop_bad=True)
    assert len(scene) == 12
    assert str(warned[0].message).count(str(holed)) == 1 and warned[0].filename == __file__
    scene.build().save(tmp_path / "tree.kdray")
    fails(kdray.ArgumentError, "mesh", kdray.Scene().add, tmp_path / "tree.kdray")


def test_warnings_point_to_the_caller(tmp_path):
    with pytest.warns(UserWarning, match="no triangles") as warned:
        kdray.Scene.of(write_obj(tmp_path / "points.obj", faces=[]))
    assert warned[0].filename == __file__


def test_answers_are_pickled_without_their_scene(cube):
    rays = random_rays(60).reshape(6, 10, 6)
    hits, every, nearest = cube.closest_hit(rays), cube.all_hits(rays), cube.closest_point(rays[..., :3])
    for copied in (lambda it: pickle.loads(pickle.dumps(it)), copy.deepcopy, copy.copy):
        again = copied(hits)
        for name in ("t", "primitive_id", "geometry_id", "instance_id", "normal", "position"):
            np.testing.assert_array_equal(getattr(again, name), getattr(hits, name))
            for part in (np.s_[2], np.s_[..., 3], np.s_[1, 2], hits.hit):
                np.testing.assert_array_equal(getattr(again[part], name), getattr(hits[part], name))
        np.testing.assert_array_equal(copied(every).ray_id, every.ray_id)
        np.testing.assert_array_equal(copied(every)[3:9].position, every[3:9].position)
        assert copied(every).counts.shape == (6, 10)
        np.testing.assert_array_equal(copied(nearest).normal, nearest.normal)
        np.testing.assert_array_equal(cube.thickness(again), cube.thickness(hits))


def test_a_built_scene_is_its_own_copy(cube):
    for copied in (copy.copy, copy.deepcopy):
        fails(kdray.SceneError, "the scene is not built", copied, kdray.Scene(CUBE_VERTICES, CUBE_FACES))
    cube.build()
    assert copy.copy(cube) is copy.deepcopy([cube])[0] is cube


def test_figures(cube):
    assert "not built" in cube._repr_html_()
    figures = cube.build().stats()
    assert figures["triangles"] == 12 and figures["vertices"] == 8 and figures["geometries"] == 1
    assert figures["bounds_min"] == [0, 0, 0] and figures["bounds_max"] == [1, 1, 1]
    assert figures["nodes"] == 2 * figures["leaves"] - 1 and sum(figures["leaves_at_depth"]) == figures["leaves"]
    html = cube._repr_html_()
    assert html.count("<table>") == html.count("</table>") == 2 and "12" in html and "<script" not in html
    copies = kdray.Scene(CUBE_VERTICES, CUBE_FACES)
    copies.add_instance(0, np.eye(4))
    assert copies.stats()["instances"] == 1 and "instances" in copies._repr_html_()
    assert kdray.Scene().stats()["bounds_min"] is None and kdray.Scene().build()._repr_html_()
