"""Questions about points."""

import numpy as np
import pytest
from conftest import CUBE_FACES, CUBE_VERTICES, sphere
from test_errors import fails

import kdray

NAN = float("nan")


def box_distance(points):
    """The signed distance to the unit cube."""
    beyond = np.abs(np.asarray(points) - 0.5) - 0.5
    return np.linalg.norm(np.maximum(beyond, 0), axis=-1) + np.minimum(beyond.max(axis=-1), 0)


@pytest.fixture(scope="module")
def points():
    return np.random.default_rng(3).uniform(-1, 2, (2000, 3))


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_distances_to_a_cube(cube, points, dtype):
    points = points.astype(dtype)
    expected = box_distance(points)
    distance = cube.signed_distance(points)
    assert distance.dtype == dtype and cube.winding_number(points).dtype == dtype
    np.testing.assert_allclose(distance, expected, atol=1e-6)
    np.testing.assert_array_equal(cube.contains(points), expected <= 0)
    np.testing.assert_array_equal(cube.winding_number(points), expected <= 0)
    nearest = cube.closest_point(points)
    assert nearest.distance.dtype == nearest.point.dtype == nearest.normal.dtype == dtype
    np.testing.assert_allclose(nearest.distance, np.abs(expected), atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(nearest.point - points, axis=1), np.abs(expected), atol=1e-6)
    corners = CUBE_VERTICES[CUBE_FACES[nearest.primitive_id]]
    weights = np.stack([1 - nearest.u - nearest.v, nearest.u, nearest.v], axis=-1)
    np.testing.assert_allclose((weights[..., None] * corners).sum(axis=1), nearest.point, atol=1e-6)
    assert not nearest.geometry_id.any() and len(nearest) == 2000


def test_a_unit_in_the_last_place_decides(cube):
    edge = [[0.5, 0.5, 1.0], [0.5, 0.5, np.nextafter(1, 2)], [0.0, 0.0, 0.0], [0.0, 0.0, -5e-324]]
    np.testing.assert_array_equal(cube.contains(edge), [True, False, True, False])


def test_shapes(cube, points):
    grid = points.reshape(4, 5, 100, 3)
    assert cube.contains(grid).shape == cube.signed_distance(grid).shape == (4, 5, 100)
    assert cube.closest_point(grid).point.shape == cube.closest_point(grid).normal.shape == grid.shape
    assert cube.thickness(grid).shape == cube.winding_number(grid).shape == (4, 5, 100)
    assert cube.contains([0.5, 0.5, 0.5]).shape == () and cube.contains(np.zeros((0, 3))).shape == (0,)
    turned = np.asfortranarray(points)
    np.testing.assert_array_equal(cube.contains(turned), cube.contains(points))
    np.testing.assert_array_equal(cube.signed_distance(grid[:, ::-1]), cube.signed_distance(grid)[:, ::-1])
    assert cube.visible(np.zeros((3, 1, 3)), points[:7]).shape == (3, 7)


def test_thickness(cube):
    hits = cube.closest_hit([[0.3, 0.2, -1], [5, 5, 5]], [0, 0, 1])
    np.testing.assert_array_equal(cube.thickness(hits), [1, NAN])
    np.testing.assert_array_equal(cube.thickness(hits, side="back"), [NAN, NAN])
    assert cube.thickness([0.4, 0.3, 1.25]) == 1
    np.testing.assert_array_equal(cube.thickness(cube.closest_point([[0.3, 0.2, -1]])), [1])
    fails(kdray.ArgumentError, "side", cube.thickness, [0.3, 0.2, -1], side="top")
    fails(kdray.ArgumentTypeError, "side", cube.thickness, [0.3, 0.2, -1], side=1)
    fails(kdray.ArgumentError, "at: give", cube.thickness, [0.3, 0.2])
    fails(kdray.ArgumentError, "at: that of index 1 is not finite", cube.thickness, [[0, 0, 0], [NAN, 0, 0]])
    np.testing.assert_array_equal(cube.thickness([[0.4, 0.3, 1.25], [NAN, 0, 0]], invalid="miss"), [1, NAN])


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_thickness_at_edges_leaves_out_their_triangles(cube, dtype):
    rng = np.random.default_rng(2)
    for axis, sides in [(axis, sides) for axis in range(3) for sides in ([0, 0], [0, 1], [1, 0], [1, 1])]:
        places = np.insert(np.repeat([sides], 300, axis=0).astype(float), axis, rng.uniform(0.1, 0.9, 300), axis=1)
        # From beside an edge, so that it is the nearest.
        points = places + np.where(np.arange(3) == axis, 0, places - 0.5)
        np.testing.assert_allclose(cube.thickness(points.astype(dtype)), 1, atol=1e-6, err_msg=f"{axis}, {sides}")


def test_visibility(cube):
    eye, others = [0.5, 0.4, 3], [[0.5, 0.4, 2], [0.5, 0.4, 1], [0.5, 0.4, 0.5], [0.5, 0.4, -1]]
    np.testing.assert_array_equal(cube.visible(eye, others), [True, True, False, False])
    np.testing.assert_array_equal(cube.visible(np.tile(others, (300, 1)), eye), [True, True, False, False] * 300)


def test_several_geometries():
    scene = kdray.Scene()
    for k in range(3):
        scene.add_triangles(CUBE_VERTICES + np.float32([3 * k, 0, 0]), CUBE_FACES)
    nearest = scene.closest_point([[0.5, 0.5, 2], [6.5, 0.5, 2]])
    np.testing.assert_array_equal(nearest.geometry_id, [0, 2])
    assert nearest.primitive_id[0] == nearest.primitive_id[1] < 12
    np.testing.assert_array_equal(nearest.normal, [[0, 0, 1]] * 2)
    np.testing.assert_array_equal(scene.thickness(nearest), [1, 1])
    np.testing.assert_array_equal(scene.contains([[3.5, 0.5, 0.5], [2, 0.5, 0.5]]), [True, False])


def test_threads_and_progress(points):
    ball, told = kdray.Scene(*sphere(30)), []
    many = np.tile(points, (20, 1))
    one = ball.signed_distance(many, threads=1, progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (40_000, 40_000)
    np.testing.assert_array_equal(ball.signed_distance(many, threads=4), one)
    np.testing.assert_array_equal(ball.contains(many, threads=4), one <= 0)


def test_bad_input(cube, points):
    wrong, mistyped = kdray.ArgumentError, kdray.ArgumentTypeError
    for ask in (cube.contains, cube.closest_point, cube.signed_distance, cube.winding_number):
        fails(wrong, "points", ask, np.zeros((4, 2)))
        fails(mistyped, "points", ask, ["a", "b", "c"])
        fails(wrong, "points: that of index 1 is not finite", ask, [[0, 0, 0], [0, NAN, 0]])
        fails(wrong, "threads", ask, [0, 0, 0], threads=0)
        fails(wrong, "invalid", ask, [0, 0, 0], invalid="x")
        bad = points.copy()
        bad[1500, 2] = np.inf
        fails(wrong, 'points: that of index 1500 is not finite; with invalid="miss"', ask, bad)
    fails(wrong, "a, b", cube.visible, np.zeros((2, 3)), np.zeros((5, 3)))
    fails(wrong, "b", cube.visible, np.zeros((2, 3)), np.zeros(4))
    fails(wrong, "b: that of index 0", cube.visible, [0, 0, 0], [0, 0, NAN])
    nowhere = [[0.5, 0.5, 0.5], [0.5, NAN, 0.5]]
    np.testing.assert_array_equal(cube.contains(nowhere, invalid="miss"), [True, False])
    np.testing.assert_array_equal(cube.signed_distance(nowhere, invalid="miss"), [-0.5, NAN])
    np.testing.assert_array_equal(cube.closest_point(nowhere, invalid="miss").primitive_id >= 0, [True, False])
    np.testing.assert_array_equal(cube.visible([0.5, 0.5, 0.4], nowhere, invalid="miss"), [True, False])
    nothing = kdray.Scene()
    assert nothing.closest_point([0, 0, 0]).distance == np.inf and np.isnan(nothing.signed_distance([0, 0, 0]))
    assert not nothing.contains([0, 0, 0]) and nothing.visible([0, 0, 0], [1, 1, 1])


def test_vertices_of_f64_are_not_rounded():
    corner = np.array([500_000.0, 5_400_000.0, 0.001])
    scene = kdray.Scene(corner + CUBE_VERTICES.astype(float) / 1024, CUBE_FACES)
    nearest = scene.closest_point(corner + [1 / 2048, 1 / 2048, -1 / 1024])
    assert abs(nearest.distance - 1 / 1024) < 1e-9
    assert abs(scene.thickness(nearest) - 1 / 1024) < 1e-9
    inside = corner + [[1 / 2048] * 3, [1 / 512] * 3]
    np.testing.assert_array_equal(scene.contains(inside), [True, False])
    np.testing.assert_array_equal(scene.winding_number(inside), [1, 0])
    assert not scene.visible(*inside)


def test_instances_are_not_supported(cube):
    cube.add_instance(0, np.eye(4))
    for ask in (cube.contains, cube.closest_point, cube.signed_distance, cube.thickness):
        with pytest.raises(kdray.UnsupportedError, match="instances"):
            ask([0.5, 0.5, 0.5])
