"""Shapes, strides and dtypes."""

import numpy as np
import pytest
from conftest import CUBE_FACES, CUBE_VERTICES, random_rays

import kdray


@pytest.fixture(scope="module")
def expected(ball):
    return ball.closest_hit(random_rays(6000, np.float32))


def same(hits, expected):
    for name in ("t", "u", "v", "primitive_id", "front"):
        np.testing.assert_array_equal(getattr(hits, name).reshape(-1), getattr(expected, name), name)


def test_shapes_are_those_of_the_rays(ball, expected):
    rays = random_rays(6000, np.float32)
    for shape in [(6000,), (60, 100), (3, 1, 20, 100), (6000, 1)]:
        hits = ball.closest_hit(rays.reshape(*shape, 6))
        assert hits.t.shape == hits.hit.shape == hits.instance_id.shape == hits.shape == shape
        assert hits.normal.shape == hits.position.shape == (*shape, 3)
        same(hits, expected)
        assert ball.any_hit(rays.reshape(*shape, 6)).shape == shape
        assert ball.count(rays.reshape(*shape, 6)).shape == shape
        assert ball.all_hits(rays.reshape(*shape, 6)).counts.shape == shape
    one = ball.closest_hit(rays[0])
    assert one.shape == () and one.t == expected.t[0]


def strided(rays):
    """The same rays by other strides."""
    yield "in the order of Fortran", np.asfortranarray(rays)
    apart = np.zeros((len(rays) * 2, 9), rays.dtype)
    apart[::2, 1:7] = rays
    yield "with gaps", apart[::2, 1:7]
    yield "backwards", rays[::-1].copy()[::-1]
    yield "backwards in both", rays[::-1, ::-1].copy()[::-1, ::-1]
    cut = np.zeros((60, 120, 6), rays.dtype)
    cut[:, 10:110] = rays.reshape(60, 100, 6)
    yield "cut out of more", cut[:, 10:110]
    turned = np.ascontiguousarray(rays.reshape(60, 100, 6).transpose(1, 0, 2))
    yield "turned", turned.transpose(1, 0, 2)
    deep = np.ascontiguousarray(rays.reshape(3, 20, 10, 10, 6).transpose(3, 1, 4, 0, 2))
    yield "turned, of five dimensions", deep.transpose(3, 1, 4, 0, 2)
    bytes_apart = np.zeros(rays.nbytes + 1, np.uint8)
    bytes_apart[1:] = rays.reshape(-1).view(np.uint8)
    yield "not aligned", bytes_apart[1:].view(rays.dtype).reshape(rays.shape)
    yield "of the other byte order", rays.astype(rays.dtype.newbyteorder())
    fixed = rays.copy()
    fixed.flags.writeable = False
    yield "read-only", fixed


@pytest.mark.parametrize("way", [name for name, _ in strided(random_rays(6000, np.float32))])
def test_strides_do_not_matter(ball, expected, way):
    rays = dict(strided(random_rays(6000, np.float32)))[way]
    hits = ball.closest_hit(rays)
    assert hits.t.dtype == np.float32
    same(hits, expected)
    same(ball.closest_hit(rays[..., :3], rays[..., 3:]), expected)


def test_origins_and_directions_are_broadcast(cube):
    directions = random_rays(1000)[:, 3:]
    center = [0.5, 0.4, 0.6]
    by_row = cube.closest_hit(np.tile(center, (1000, 1)), directions)
    same(cube.closest_hit(center, directions), by_row)
    grid = cube.closest_hit(np.full((4, 1, 3), center), directions[:50])
    assert grid.shape == (4, 50)
    np.testing.assert_array_equal(grid.t, np.tile(by_row.t[:50], (4, 1)))
    bounded = cube.closest_hit(center, directions[:50], t_max=np.array([[1e-9], [np.inf]], np.float32))
    np.testing.assert_array_equal(bounded.hit, [[False] * 50, [True] * 50])


def test_precision_follows_the_rays(cube):
    origin, direction = np.float32([0.3, 0.2, -1]), np.float32([0, 0, 1])
    cases = [
        (origin, direction, np.float32),
        (origin, direction.astype(float), np.float64),
        (origin.astype(float), direction, np.float64),
        (origin.astype(np.float16), direction, np.float64),
        ([0.3, 0.2, -1], [0, 0, 1], np.float64),
        (origin, np.array([0, 0, 1], np.int8), np.float64),
    ]
    for o, d, dtype in cases:
        hits = cube.closest_hit(o, d)
        assert hits.t.dtype == hits.u.dtype == hits.normal.dtype == hits.position.dtype == dtype
        assert cube.all_hits(o, d).t.dtype == dtype
    assert cube.closest_hit(origin, direction, t_min=np.float64(0)).t.dtype == np.float32


def test_no_rays(cube):
    for rays in [np.zeros((0, 6)), np.zeros((5, 0, 6), np.float32), np.zeros((0, 5, 6))]:
        hits = cube.closest_hit(rays)
        assert hits.shape == rays.shape[:-1] and hits.normal.shape == (*rays.shape[:-1], 3)
        assert cube.any_hit(rays).shape == cube.count(rays).shape == rays.shape[:-1]
        every = cube.all_hits(rays)
        assert len(every) == 0 and list(every.offsets) == [0] and every.ray_id.size == 0


def test_no_triangles():
    empty = [kdray.Scene(), kdray.Scene([], []), kdray.Scene(np.zeros((0, 3)), np.zeros((0, 3), int))]
    for scene in [*empty, kdray.Scene(CUBE_VERTICES, [])]:
        assert len(scene) == 0 and scene and scene.bounds is None
        assert not scene.any_hit([0, 0, 0], [0, 0, 1]) and scene.count([0, 0, 0, 0, 0, 1]) == 0
        assert scene.closest_hit(np.ones((2000, 6))).t.tolist() == [np.inf] * 2000
        assert scene.faces.shape == (0, 3)


def test_hits_can_be_indexed(cube):
    hits = cube.closest_hit(random_rays(50).reshape(5, 10, 6))
    assert len(hits) == 5 and "shape (5, 10)" in repr(hits)
    row = hits[1]
    assert row.shape == (10,)
    np.testing.assert_array_equal(row.normal, hits.normal[1])
    found = hits[hits.hit]
    assert found.hit.all() and found.t.shape == (np.count_nonzero(hits.hit),)
    assert hits[0, 0].shape == ()


def test_vertices_and_faces_of_many_dtypes():
    for dtype, kept in [("f4", "f4"), ("f8", "f8"), (int, "f8"), ("f2", "f8"), (">f4", "f4")]:
        for index in (int, np.uint8, np.uint32, np.int64, np.uint64, ">i4"):
            scene = kdray.Scene(CUBE_VERTICES.astype(dtype), CUBE_FACES.astype(index))
            assert scene.dtype == scene.vertices.dtype == kept
            for _ in range(2):
                np.testing.assert_array_equal(scene.vertices, CUBE_VERTICES)
                np.testing.assert_array_equal(scene.faces, CUBE_FACES)
                assert scene.faces.dtype == np.uint32 and len(scene) == 12
                scene.bounds
    assert kdray.Scene(CUBE_VERTICES.astype(float), CUBE_FACES, dtype="f4").dtype == np.float32
    assert kdray.Scene(CUBE_VERTICES, CUBE_FACES, dtype=float).vertices.dtype == np.float64
    assert kdray.Scene(CUBE_VERTICES[::-1], 7 - CUBE_FACES[:, ::-1]).count([0.3, 0.2, -1, 0, 0, 1]) == 2


def test_arrays_of_the_caller_are_copied(cube):
    vertices, faces = CUBE_VERTICES.copy(), CUBE_FACES.astype(np.uint32)
    scene = kdray.Scene(vertices, faces)
    vertices[:], faces[:] = np.nan, 99
    assert scene.count([0.3, 0.2, -1, 0, 0, 1]) == 2
