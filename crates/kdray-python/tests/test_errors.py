"""Whatever is wrong is told as an exception that names the argument."""

import numpy as np
import pytest
from conftest import CUBE_FACES, CUBE_VERTICES, random_rays

import kdray

NAN, INF = float("nan"), float("inf")
QUERIES = ["closest_hit", "any_hit", "count", "all_hits"]


def fails(error, name, call, *arguments, **options):
    assert issubclass(error, kdray.KdrayError)
    with pytest.raises(error) as raised:
        call(*arguments, **options)
    assert str(raised.value).startswith(name), str(raised.value)


@pytest.mark.parametrize("query", QUERIES)
def test_rays(cube, query):
    ask, x, wrong = getattr(cube, query), [1.0, 0, 0], kdray.ArgumentError
    fails(wrong, "rays", ask, np.zeros((4, 5)))
    fails(wrong, "rays: give an array of shape (..., 6), not (4, 3), or give directions", ask, np.zeros((4, 3)))
    fails(wrong, "rays", ask, 1.0)
    fails(wrong, "rays: give an array of at most 31 dimensions, not 33", ask, np.ones((1,) * 32 + (6,)))
    fails(wrong, "t_max: give an array of at most 31 dimensions", ask, np.ones(6), t_max=np.ones((1,) * 32))
    ask(np.ones((1,) * 30 + (6,)), t_max=np.ones((1,) * 31))
    fails(wrong, "origins", ask, [1.0, 2], x)
    fails(wrong, "directions", ask, x, np.zeros((2, 4)))
    fails(wrong, "origins, directions, t_min, t_max", ask, np.ones((2, 3)), np.ones((5, 3)))
    fails(wrong, "rays, t_min, t_max", ask, np.ones((2, 6)), t_max=np.ones(3))
    fails(wrong, "origins", ask, [NAN, 0, 0], x)
    fails(wrong, "origins", ask, [INF, 0, 0], x)
    fails(wrong, "directions", ask, x, [0, NAN, 0])
    fails(wrong, "directions", ask, x, [0, 0, 0])
    fails(wrong, 'origins: that of ray 0 is not finite; with invalid="miss"', ask, [NAN, 0, 0], x)
    fails(wrong, "rays: the origin of ray 1 is not finite", ask, [[1.0] * 6, [NAN, 0, 0, 1, 0, 0]])
    fails(wrong, "rays: the direction of ray 0 is not finite", ask, [0, 0, 0, 1, INF, 0])
    fails(wrong, "rays: the direction of ray 0 is zero", ask, [1.0, 0, 0, 0, 0, 0])
    fails(wrong, "t_min, t_max: a bound of ray 0", ask, [1.0] * 6, t_max=NAN)
    fails(wrong, "t_min", ask, x, x, t_min=NAN)
    fails(wrong, "t_min", ask, x, x, t_max=NAN)
    fails(wrong, "threads", ask, x, x, threads=0)
    fails(wrong, "threads", ask, x, x, threads=-1)
    fails(wrong, "threads", ask, x, x, threads=10**6)
    fails(wrong, "threads", ask, x, x, threads=10**30)
    fails(wrong, "mask", ask, x, x, mask=0)
    fails(wrong, "mask", ask, x, x, mask=1 << 32)
    fails(wrong, "invalid", ask, x, x, invalid="pass")
    mistyped = kdray.ArgumentTypeError
    fails(mistyped, "origins", ask, ["a", "b", "c"], x)
    fails(mistyped, "origins", ask, np.ones(3, complex), x)
    fails(mistyped, "directions", ask, x, [[1, 2, 3], [1, 2]])
    fails(mistyped, "rays", ask, None)
    fails(mistyped, "t_max", ask, x, x, t_max="far")
    fails(mistyped, "threads", ask, x, x, threads=2.0)
    fails(mistyped, "mask", ask, x, x, mask="all")
    fails(mistyped, "progress", ask, x, x, progress="yes")
    with pytest.raises(ValueError):
        ask(np.zeros((4, 5)))
    with pytest.raises(TypeError):
        ask(None)


@pytest.mark.parametrize("query", QUERIES)
def test_a_bad_ray_among_many_is_named(cube, query):
    for count in (100, 5000):
        rays = random_rays(count)
        rays[count - 7, 4] = NAN
        bad = f"of ray {count - 7} is not finite"
        fails(kdray.ArgumentError, f"rays: the direction {bad}", getattr(cube, query), rays)
        fails(kdray.ArgumentError, f"directions: that {bad}", getattr(cube, query), rays[:, :3], rays[:, 3:])


def test_the_first_bad_ray_is_named_on_any_number_of_threads(cube):
    rays = random_rays(20_000)
    rays[3000::1500, 4] = NAN
    points = rays[:, 3:]
    for threads in [1, 2, 4] * 5:
        fails(kdray.ArgumentError, "rays: the direction of ray 3000 is", cube.closest_hit, rays, threads=threads)
        fails(kdray.ArgumentError, "points: that of index 3000 is", cube.contains, points, threads=threads)


def test_bad_rays_may_miss(cube):
    rays = random_rays(3000)
    good = cube.closest_hit(rays)
    bad = np.arange(0, 3000, 7)
    rays[bad, np.arange(len(bad)) % 6] = NAN
    hits = cube.closest_hit(rays, invalid="miss")
    assert not hits.hit[bad].any()
    np.testing.assert_array_equal(np.delete(hits.t, bad), np.delete(good.t, bad))
    assert not cube.any_hit(rays[bad], invalid="miss").any() and not cube.count(rays[bad], invalid="miss").any()
    assert len(cube.all_hits(rays[bad], invalid="miss")) == 0


def test_limits(cube):
    x = [1.0, 0, 0]
    fails(kdray.ArgumentError, "limit", cube.all_hits, x, x, limit=-1)
    fails(kdray.ArgumentTypeError, "limit", cube.all_hits, x, x, limit=1.5)


def test_meshes():
    faces, wrong, mistyped = [[0, 1, 2]], kdray.ArgumentError, kdray.ArgumentTypeError
    corners = [[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]
    fails(wrong, "vertices", kdray.Scene, [[0.0, 0], [1, 0], [0, 1]], faces)
    fails(wrong, "vertices", kdray.Scene, [corners], faces)
    fails(wrong, "vertices: vertex 1", kdray.Scene, [[0.0, 0, 0], [NAN, 0, 0], [0, 1, 0]], faces)
    fails(wrong, "vertices: vertex 1", kdray.Scene, [[0.0, 0, 0], [1e39, 0, 0], [0, 1, 0]], faces, dtype="f4")
    fails(wrong, "vertices, faces", kdray.Scene, corners)
    fails(wrong, "vertices, faces: give both, or neither; Scene.of takes", kdray.Scene, "a.ply")
    fails(mistyped, "vertices", kdray.Scene, [[1, 2, 3], [4, 5]], faces)
    fails(wrong, "faces", kdray.Scene, corners, [0, 1, 2])
    fails(wrong, "faces", kdray.Scene, corners, [[0, 1, 2, 1]])
    fails(wrong, "faces: triangle 0 uses vertex 3", kdray.Scene, corners, [[0, 1, 3]])
    fails(wrong, "faces: face 1 names vertex -1", kdray.Scene, corners, [[0, 1, 2], [0, -1, 2]])
    fails(wrong, "faces: face 0 names vertex 18446744073709551615", kdray.Scene, corners, np.array([[0, 1, 2**64 - 1]], np.uint64))
    fails(mistyped, "faces", kdray.Scene, corners, [[0.0, 1, 2]])
    fails(mistyped, "vertices", kdray.Scene, [["a", "b", "c"]], faces)
    fails(mistyped, "dtype", kdray.Scene, dtype=int)
    fails(mistyped, "dtype", kdray.Scene, dtype="floating")
    fails(mistyped, "mesh: int has no triangles", kdray.Scene.of, 5)


def test_instances(cube):
    wrong = kdray.ArgumentError
    fails(wrong, "geometry_id", cube.add_instance, 1, np.eye(4))
    fails(wrong, "geometry_id", cube.add_instance, -1, np.eye(4))
    fails(wrong, "transform", cube.add_instance, 0, np.eye(3))
    fails(wrong, "transform", cube.add_instance, 0, np.ones((4, 4)))
    fails(wrong, "mask", cube.add_instance, 0, np.eye(4), mask=0)
    fails(kdray.ArgumentTypeError, "geometry_id", cube.add_instance, "0", np.eye(4))
    cube.add_instance(0, np.diag([1.0, 1, 0, 1]))
    fails(wrong, "transform", cube.build)


def test_builds(cube):
    wrong = kdray.ArgumentError
    fails(wrong, "preset", cube.build, "quick")
    fails(wrong, "split", cube.build, split="third")
    fails(wrong, "preset, split", cube.build, "fast", split="sah")
    fails(wrong, "leaf_size", cube.build, leaf_size=-1)
    fails(wrong, "max_depth", cube.build, max_depth=1000)
    fails(wrong, "memory_limit", cube.build, memory_limit=-1)
    fails(wrong, "threads", cube.build, threads=0)
    fails(kdray.ArgumentTypeError, "leaf_size", cube.build, leaf_size=8.0)
    fails(kdray.ArgumentTypeError, "preset", cube.build, 5)
    fails(kdray.ArgumentTypeError, "split", cube.build, split=5)
    fails(kdray.BuildError, "the build needs", cube.build, memory_limit=1000)
    assert not cube.is_built and len(cube) == 12, "what failed left nothing behind"
    assert cube.count([0.3, 0.2, -1, 0, 0, 1]) == 2


def test_a_memory_limit_is_for_all_geometries():
    scene = kdray.Scene()
    for _ in range(100):
        scene.add_triangles(CUBE_VERTICES, CUBE_FACES)
    scene.add_instance(0, np.eye(4))
    fails(kdray.BuildError, "the build needs", scene.build, memory_limit=1_060_000)
    assert scene.build(memory_limit=3_000_000).is_built


def test_a_scene_that_is_built_cannot_be_changed(cube):
    cube.build("fast", leaf_size=4, max_depth=10, threads=1)
    changes = [
        lambda: cube.add_triangles(CUBE_VERTICES, CUBE_FACES),
        lambda: cube.add_instance(0, np.eye(4)),
        cube.build,
    ]
    for change in changes:
        with pytest.raises(kdray.SceneError, match="built"):
            change()
    assert len(cube) == 12


def test_the_environment_names_threads(cube, monkeypatch):
    rays = random_rays(2000)
    monkeypatch.setenv("KDRAY_THREADS", "many")
    fails(kdray.ArgumentError, "KDRAY_THREADS", cube.any_hit, rays)
    assert cube.any_hit(rays, threads=1).any(), "an argument comes first"
    monkeypatch.setenv("KDRAY_THREADS", "")
    monkeypatch.setenv("RAYON_NUM_THREADS", "-3")
    fails(kdray.ArgumentError, "RAYON_NUM_THREADS", cube.any_hit, rays)
    monkeypatch.setenv("RAYON_NUM_THREADS", "0")
    assert cube.any_hit(rays).any()
