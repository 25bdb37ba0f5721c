"""kdray.dask: the same answers as on one machine, whatever becomes of workers."""

import os
import signal
import time

import dask.array as da
import distributed
import numpy as np
import pandas
import pytest
from conftest import random_rays, sphere
from test_errors import fails

import kdray
import kdray.dask


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    path = tmp_path_factory.mktemp("tree") / "ball.kdray"
    kdray.Scene(*sphere(30)).save(path)
    return path


@pytest.fixture(scope="module")
def rays():
    return random_rays(5000)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_answers_are_those_of_one_machine(tree, rays, dtype):
    rays = rays.astype(dtype)
    scene = kdray.Scene.mmap(tree)
    lazy = kdray.dask.closest_hit(tree, da.from_array(rays, chunks=(700, 2)))
    assert lazy.shape == (5000,) and lazy["t"].dtype == dtype
    hits, expected = lazy.compute(), scene.closest_hit(rays)
    for name in ("t", "u", "v", "primitive_id", "front"):
        np.testing.assert_array_equal(hits[name], getattr(expected, name))
    for query in ("any_hit", "count"):
        answers = getattr(kdray.dask, query)(tree, rays, per_task=999)
        assert answers.npartitions == 6
        np.testing.assert_array_equal(answers.compute(), getattr(scene, query)(rays))
    points = rays[:, :3] * dtype(0.6)
    for query in ("contains", "signed_distance"):
        answers = getattr(kdray.dask, query)(tree, points, per_task=999).compute()
        np.testing.assert_array_equal(answers, getattr(scene, query)(points))


def test_all_hits_of_all_blocks(tree, rays):
    hits = kdray.dask.all_hits(tree, rays, per_task=999, t_max=0.9).compute()
    expected = kdray.Scene.mmap(tree).all_hits(rays, t_max=0.9)
    for name in ("ray_id", "t", "u", "v", "primitive_id", "front"):
        np.testing.assert_array_equal(hits[name], getattr(expected, name))


def test_pictures_of_rays_keep_their_shape(tree, rays):
    picture = rays.reshape(50, 100, 6)
    hits = kdray.dask.closest_hit(tree, picture, per_task=300)
    assert hits.shape == (50, 100) and hits.npartitions > 10
    np.testing.assert_array_equal(hits["t"].compute(), kdray.Scene.mmap(tree).closest_hit(picture).t)


def test_rays_from_files(tree, rays, tmp_path):
    expected = kdray.Scene.mmap(tree).closest_hit(rays).t
    np.save(tmp_path / "rays.npy", rays)
    lazy = kdray.dask.rays_from(tmp_path / "rays.npy", per_task=999)
    assert lazy.numblocks == (6, 1)
    np.testing.assert_array_equal(kdray.dask.closest_hit(tree, lazy)["t"].compute(), expected)
    np.save(tmp_path / "empty.npy", np.zeros((0, 6)))
    assert kdray.dask.count(tree, kdray.dask.rays_from(tmp_path / "empty.npy")).compute().shape == (0,)
    da.from_array(rays, chunks=(1000, 6)).to_zarr(str(tmp_path / "rays.zarr"))
    lazy = kdray.dask.rays_from(tmp_path / "rays.zarr")
    np.testing.assert_array_equal(kdray.dask.closest_hit(tree, lazy)["t"].compute(), expected)


def test_rays_from_parquet(tree, rays, tmp_path):
    pandas.DataFrame(rays, columns=list("abcdef")).to_parquet(tmp_path / "rays.parquet")
    lazy = kdray.dask.rays_from(tmp_path / "rays.parquet")
    expected = kdray.Scene.mmap(tree).closest_hit(rays).t
    np.testing.assert_array_equal(kdray.dask.closest_hit(tree, lazy)["t"].compute(), expected)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda tree: kdray.dask.closest_hit(tree, np.zeros((3, 5))), "rays"),
        (lambda tree: kdray.dask.all_hits(tree, np.zeros((3, 2, 6))), "rays"),
        (lambda tree: kdray.dask.contains(tree, np.zeros((3, 6))), "points"),
        (lambda tree: kdray.dask.any_hit(tree, np.zeros((3, 6)), per_task=0), "per_task"),
        (lambda tree: kdray.dask.any_hit(tree, np.zeros((3, 6)), per_task=1.5), "per_task"),
        (lambda tree: kdray.dask.any_hit(tree, np.zeros((3, 6), complex)), "rays"),
        (lambda tree: kdray.dask.any_hit(tree, da.zeros((3, 6), dtype=complex)), "rays"),
        (lambda tree: kdray.dask.any_hit(tree, [[1, 2, 3], [4]]), "rays"),
        (lambda tree: kdray.dask.any_hit(tree, np.zeros((3, 6)), t_mx=1), "t_mx: .*t_max"),
        (lambda tree: kdray.dask.all_hits(tree, np.zeros((3, 6)), threads=1), "threads"),
        (lambda tree: kdray.dask.any_hit(tree, np.zeros((3, 6)), progress=True), "progress"),
        (lambda tree: kdray.dask.any_hit(tree, np.zeros((3, 6)), t_max=[[1], [2, 3]]), "t_max"),
        (lambda tree: kdray.dask.render(tree, crop=(0, 0, 1, 1)), "crop"),
        (lambda tree: kdray.dask.render(tree, width=0), "width"),
        (lambda tree: kdray.dask.render(tree, tile=0), "tile"),
        (lambda tree: kdray.dask.radiance(tree, sample_range=(0, 1)), "sample_range"),
        (lambda tree: kdray.dask.radiance(tree, samples=1.5), "samples"),
        (lambda tree: kdray.dask.rays_from("rays.npy", per_task=0), "per_task"),
        (lambda tree: kdray.dask.rays_from(5), "path"),
        (lambda tree: kdray.dask.rays_from("rays.txt"), "path"),
        (lambda tree: kdray.dask.any_hit(tree, np.zeros((3, 6)), t_max=np.ones(3)), "t_max"),
        (lambda tree: kdray.dask.any_hit(tree, np.zeros((3, 6)), t_max=np.nan), "t_min, t_max"),
        (lambda tree: kdray.dask.closest_hit(tree, np.zeros((3, 6)), t_min="near"), "t_min"),
        (lambda tree: kdray.dask.count(tree, np.zeros((3, 6)), mask=0), "mask: give a number of 32 bits"),
        (lambda tree: kdray.dask.all_hits(tree, np.zeros((3, 6)), limit=-1), "limit"),
        (lambda tree: kdray.dask.contains(tree, np.zeros((3, 3)), invalid="pass"), "invalid"),
        (lambda tree: kdray.dask.render(tree, picture="photograph"), "picture"),
        (lambda tree: kdray.dask.render(tree, samples=0), "samples"),
        (lambda tree: kdray.dask.radiance(tree, samples=1 << 20), "samples"),
        (lambda tree: kdray.dask.radiance(tree, exposure="long"), "exposure"),
        (lambda tree: kdray.dask.any_hit(str(tree) + ".gone", np.zeros((3, 6))), ".*gone"),
    ],
)
def test_errors_name_the_argument(tree, call, name):
    with pytest.raises(kdray.KdrayError, match=f"^{name}") as raised:
        call(tree)
    assert "where the block begins" not in str(raised.value)


@pytest.mark.parametrize("ending", ["npy", "zarr", "parquet"])
def test_files_without_rays(tmp_path, ending):
    path = tmp_path / f"rays.{ending}"
    fails(kdray.MissingFileError, str(path), kdray.dask.rays_from, path)
    path.write_bytes(b"none")
    fails(kdray.FileError, str(path), kdray.dask.rays_from, path)


def test_arrays_that_are_no_rays(tmp_path):
    path = tmp_path / "rays.npy"
    np.save(path, np.zeros((3, 6), complex))
    fails(kdray.ArgumentTypeError, "path", kdray.dask.rays_from, path)
    np.save(path, np.zeros((3, 5)))
    fails(kdray.ArgumentError, "path", kdray.dask.rays_from, path)
    with open(path, "wb") as file:
        np.savez(file, np.zeros((3, 6)))
    fails(kdray.FileError, str(path), kdray.dask.rays_from, path)


def test_a_bad_ray_is_named_by_its_block(tree, rays):
    bad = rays.copy()
    bad[2500, 1] = np.nan
    for ask in (kdray.dask.any_hit, kdray.dask.all_hits):
        lazy = ask(tree, bad, per_task=1000)
        with pytest.raises(kdray.ArgumentError, match="of ray 500 .* counted from 2000, where the block begins"):
            lazy.compute()
    with pytest.raises(kdray.ArgumentError, match="counted from \\(2, 0\\)"):
        kdray.dask.count(tree, da.from_array(bad.reshape(5, 1000, 6), chunks=(1, 1000, 6))).compute()


def test_blocks_are_told_of_what_is_counted_alone():
    info = [{"array-location": [(2000, 3000), (0, 6)]}]
    for text, told in [
        ("mask: give a number", "mask: give a number"),
        ("origins: that of ray 5 is", "origins: that of ray 5 is; counted from 2000, where the block begins"),
        ("points: that of index 5 is", "points: that of index 5 is; counted from 2000, where the block begins"),
    ]:
        with pytest.raises(kdray.ArgumentError) as raised, kdray.dask._counting(info):
            raise kdray.ArgumentError(text)
        assert str(raised.value) == told


def test_a_tree_that_changed_is_an_error(tree, rays, tmp_path):
    path = tmp_path / "changing.kdray"
    kdray.Scene(*sphere(8)).save(path)
    hits = kdray.dask.closest_hit(path, rays)
    kdray.Scene(*sphere(9)).save(path)
    with pytest.raises(kdray.KdrayError, match="has changed"):
        hits.compute()


def test_pictures_are_those_of_one_machine(tree):
    size = {"width": 60, "height": 40, "samples": 4}
    whole = kdray.Scene.mmap(tree).render(**size)
    tiles = kdray.dask.render(tree, tile=25, **size)
    assert tiles.numblocks == (2, 3, 1) and tiles.dtype == np.uint8
    np.testing.assert_array_equal(tiles.compute(), whole)
    light = kdray.dask.radiance(tree, tile=32, samples_per_task=3, **size)
    assert light.shape == (40, 60, 3) and light.dtype == np.float32
    expected = np.stack([whole.layers[f"color.{channel}"] for channel in "RGB"], axis=-1)
    np.testing.assert_allclose(light.compute(), expected, rtol=1e-5, atol=1e-6)


def test_pictures_of_mesh_files(tmp_path):
    path = tmp_path / "face.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    size = {"width": 24, "height": 16, "samples": 1}
    picture = kdray.dask.render(path, tile=10, **size)
    np.testing.assert_array_equal(picture.compute(), kdray.Scene.of(path).render(**size))
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n")
    kdray.dask._OPENED.clear()
    with pytest.raises(kdray.KdrayError, match="has changed"):
        picture.compute()


def test_a_worker_that_is_killed_loses_nothing(tree):
    rays = random_rays(20_000)

    def held(block, block_info):
        """The last rays are there when a worker was killed."""
        if block_info[0]["chunk-location"][0] == 19:
            assert distributed.Event("killed").wait("60s"), "no worker was killed"
        return block

    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None
    ) as cluster, distributed.Client(cluster) as client:
        lazy = da.from_array(rays, chunks=(1000, 6)).map_blocks(held, dtype=rays.dtype)
        answers = kdray.dask.closest_hit(tree, lazy)["t"]
        future = client.compute(answers)
        victim = with_answers(client, answers.name)
        os.kill(client.run(os.getpid, workers=[victim])[victim], signal.SIGKILL)
        distributed.Event("killed").set()
        t = future.result(timeout=120)
    np.testing.assert_array_equal(t, kdray.Scene.mmap(tree).closest_hit(rays).t)


def with_answers(client, name):
    """A worker that has blocks of the array of that name, for which it waits."""
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        for worker, keys in client.has_what().items():
            if any(name in str(key) for key in keys):
                return worker
        time.sleep(0.01)
    raise AssertionError("no task was finished")
