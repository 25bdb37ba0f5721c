"""kdray.trimesh: trimesh's interface."""

import copy
import inspect
import pickle
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
import trimesh
import trimesh.ray.ray_triangle
from test_errors import fails

import kdray
from kdray.trimesh import RayMeshIntersector

VERSION = "5.2.0"
"""The trimesh whose own tests are run."""

TESTS = {"test_ray.py": 15, "test_ray_upstream.py": 15}
"""Its files of tests of rays, and how many tests at least each of them has."""


@pytest.fixture
def ball():
    mesh = trimesh.creation.icosphere(subdivisions=2)
    mesh.ray = RayMeshIntersector(mesh)
    return mesh


def rays(count, seed=0):
    rng = np.random.default_rng(seed)
    origins = rng.normal(size=(count, 3)) * 3
    return origins, rng.normal(size=(count, 3)) * 0.4 - origins


def test_answers_are_those_of_trimesh_itself(ball):
    origins, directions = rays(300)
    theirs = trimesh.ray.ray_triangle.RayMeshIntersector(ball)
    locations, ray, face = ball.ray.intersects_location(origins, directions)
    assert locations.dtype == np.float64 and ray.dtype == face.dtype == np.int64
    assert len(locations) == len(ray) == len(face) > 300
    same = theirs.intersects_location(origins, directions)
    order = np.lexsort((same[2], same[1]))
    mine = np.lexsort((face, ray))
    np.testing.assert_array_equal(face[mine], same[2][order])
    np.testing.assert_array_equal(ray[mine], same[1][order])
    np.testing.assert_allclose(locations[mine], same[0][order], atol=1e-12)
    np.testing.assert_array_equal(
        ball.ray.intersects_first(origins, directions), theirs.intersects_first(origins, directions)
    )
    np.testing.assert_array_equal(
        ball.ray.intersects_any(origins, directions), theirs.intersects_any(origins, directions)
    )
    points = np.random.default_rng(1).uniform(-1, 1, (500, 3))
    np.testing.assert_array_equal(ball.ray.contains_points(points), theirs.contains_points(points))


def test_hits_come_by_ray_and_by_distance(ball):
    origins, directions = rays(200, seed=3)
    locations, ray, _ = ball.ray.intersects_location(origins, directions)
    distance = np.linalg.norm(locations - origins[ray], axis=1)
    assert (np.lexsort((distance, ray)) == np.arange(len(ray))).all()
    _, first_ray, first = ball.ray.intersects_location(origins, directions, multiple_hits=False)
    assert (np.diff(first_ray) > 0).all()
    np.testing.assert_array_equal(first, ball.ray.intersects_first(origins, directions)[first_ray])


def test_at_most_so_many_hits():
    sheets = trimesh.util.concatenate(
        [trimesh.creation.box(extents=[1, 1, 0.1], transform=np.diag([1, 1, 1, 1.0])) for _ in range(60)]
    )
    rays = ([[0.1, 0.2, -1]], [[0, 0, 1]])
    mesh = RayMeshIntersector(sheets)
    with pytest.warns(UserWarning, match="max_hits: a ray has 100 hits") as warned:
        assert len(mesh.intersects_id(*rays)[0]) == 100
        mesh.intersects_location(*rays)
    assert [warning.filename for warning in warned] == [__file__] * 2
    assert len(mesh.intersects_id(*rays, max_hits=120)[0]) == 120
    with warnings.catch_warnings(action="error"):
        assert len(mesh.intersects_id(*rays, max_hits=3)[0]) == 3
        assert len(mesh.intersects_id(*rays, multiple_hits=False)[0]) == 1


def test_arguments_have_the_names_and_places_of_trimesh():
    methods = ["intersects_location", "intersects_id", "intersects_first", "intersects_any", "contains_points"]
    wanted = {
        "__init__": ["self", "geometry", "scale_to_box"],
        "intersects_location": ["self", "ray_origins", "ray_directions", "multiple_hits"],
        "intersects_id": [
            "self", "ray_origins", "ray_directions", "multiple_hits", "max_hits", "return_locations",
        ],
        "intersects_first": ["self", "ray_origins", "ray_directions"],
        "contains_points": ["self", "points"],
    }  # fmt: skip
    for name, arguments in wanted.items():
        signature = inspect.signature(getattr(RayMeshIntersector, name))
        assert list(signature.parameters)[: len(arguments)] == arguments
    for name in methods:
        theirs = inspect.signature(getattr(trimesh.ray.ray_triangle.RayMeshIntersector, name)).parameters
        ours = inspect.signature(getattr(RayMeshIntersector, name)).parameters
        assert set(theirs) - {"kwargs"} <= set(ours), name


def test_a_mesh_that_changed_has_another_tree(ball):
    assert ball.ray.intersects_any([[0, 0, -5]], [[0, 0, 1]])[0]
    scene = ball.ray.scene
    assert ball.ray.scene is scene
    ball.apply_translation([5, 0, 0])
    assert not ball.ray.intersects_any([[0, 0, -5]], [[0, 0, 1]])[0]
    assert ball.ray.intersects_any([[5, 0, -5]], [[0, 0, 1]])[0]


def test_triangles_are_looked_through_once_a_mesh(ball, monkeypatch):
    bounds, looked = kdray.Scene.bounds, []
    monkeypatch.setattr(kdray.Scene, "bounds", property(lambda scene: looked.append(scene) or bounds.fget(scene)))
    for _ in range(3):
        ball.ray.intersects_any([[0, 0, -5]], [[0, 0, 1]])
    ball.apply_translation([5, 0, 0])
    ball.ray.intersects_first([[0, 0, -5]], [[0, 0, 1]])
    assert len(looked) == 2


def test_copies_answer_alike(ball):
    origins, directions = rays(50)
    first = ball.ray.intersects_first(origins, directions)
    for twin in (copy.copy(ball.ray), copy.deepcopy(ball.ray), pickle.loads(pickle.dumps(ball.ray))):
        np.testing.assert_array_equal(twin.intersects_first(origins, directions), first)


def test_without_rays_or_hits_arrays_have_their_shapes(ball):
    for origins, directions in [([], []), (np.zeros((0, 3)), np.zeros((0, 3))), ([[0, 0, 9]], [[0, 0, 1]])]:
        locations, ray, face = ball.ray.intersects_location(origins, directions)
        assert (locations.shape, ray.shape, face.shape) == ((0, 3), (0,), (0,))
    assert ball.ray.contains_points(np.zeros((0, 3))).shape == (0,)


def test_rays_that_are_none_hit_nothing(ball):
    origins = [[0, 0, -5], [np.nan, 0, 0], [0, 0, -5]]
    directions = [[0, 0, 0], [0, 0, 1], [0, 0, 1]]
    assert ball.ray.intersects_any(origins, directions).tolist() == [False, False, True]
    assert ball.ray.contains_points([[np.nan, 0, 0], [0, 0, 0]]).tolist() == [False, True]


def test_errors_name_the_argument(ball):
    with pytest.raises(ValueError, match="ray_origins, ray_directions"):
        ball.ray.intersects_first([[0, 0, 0]], [[0, 0, 1], [0, 0, 1]])
    with pytest.raises(ValueError, match="ray_origins"):
        ball.ray.intersects_first([[0, 0]], [[0, 0]])
    with pytest.raises(ValueError, match="points"):
        ball.ray.contains_points([0, 0, 0])
    for ask in (ball.ray.intersects_any, ball.ray.intersects_first, ball.ray.intersects_location):
        with pytest.raises(TypeError, match="max_hit'"):
            ask([[0, 0, -5]], [[0, 0, 1]], max_hit=3)
    fails(kdray.ArgumentTypeError, "ray_origins", ball.ray.intersects_any, [[0, 0, 0], [1]], [[0, 0, 1]] * 2)
    for error, most in [(kdray.ArgumentError, -1), (kdray.ArgumentTypeError, 2.5)]:
        fails(error, "max_hits", ball.ray.intersects_id, [[0, 0, -5]], [[0, 0, 1]], max_hits=most)
    assert issubclass(kdray.ArgumentError, ValueError)


def test_rays_that_begin_on_the_surface_hit_it():
    mesh = trimesh.creation.icosphere(subdivisions=3, radius=0.1)
    mesh.apply_translation([3, -7, 11])
    points, faces = trimesh.sample.sample_surface(mesh, 500, seed=0)
    inward = -mesh.face_normals[faces]
    first = RayMeshIntersector(mesh).intersects_first(points, inward)
    np.testing.assert_array_equal(first, faces)


def test_trimesh_passes_its_own_tests(tmp_path):
    """From its source distribution, which has the tests but not what they share: that is in ``upstream``."""
    fetch = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--no-binary", ":all:"]
    subprocess.run([*fetch, "--dest", str(tmp_path), f"trimesh=={VERSION}"], check=True)
    import tarfile

    with tarfile.open(tmp_path / f"trimesh-{VERSION}.tar.gz") as archive:
        archive.extractall(tmp_path, filter="data")
    tests = tmp_path / f"trimesh-{VERSION}" / "tests"
    paths = [str(Path(__file__).parent / "upstream"), str(Path(kdray.__file__).parents[1])]
    program = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *TESTS]
    run = subprocess.run(
        program, cwd=tests, env={"PYTHONPATH": ":".join(paths)}, capture_output=True, text=True
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert " skipped" not in run.stdout
    passed = int(run.stdout.rsplit(" passed", 1)[0].split()[-1])
    assert passed >= sum(TESTS.values())
