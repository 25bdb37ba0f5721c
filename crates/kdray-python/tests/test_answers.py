"""Answers are those of testing every triangle."""

import numpy as np
import pytest
from conftest import CUBE_FACES, CUBE_VERTICES, brute_force, random_rays, sphere

import kdray

MESH = sphere(8)
PRECISIONS = [(np.float32, np.float32), (np.float64, np.float32), (np.float64, np.float64), (np.float32, np.float64)]


@pytest.fixture(params=PRECISIONS, ids=lambda it: f"{it[0].__name__} mesh, {it[1].__name__} rays")
def asked(request):
    """A scene, rays, and the t of each ray and triangle."""
    of_mesh, of_rays = request.param
    vertices, faces = MESH[0].astype(of_mesh), MESH[1]
    rays = random_rays(3000, of_rays)
    return kdray.Scene(vertices, faces), rays, *brute_force(vertices, faces, rays)


def test_closest_hits(asked):
    scene, rays, t, is_front = asked
    hits = scene.closest_hit(rays)
    expected, nearest = t.min(axis=1), t.argmin(axis=1)
    assert hits.t.dtype == hits.u.dtype == rays.dtype
    np.testing.assert_allclose(hits.t, expected, rtol=1e-6)
    np.testing.assert_array_equal(hits.hit, np.isfinite(expected))
    assert 0 < np.count_nonzero(hits.hit) < len(rays)
    np.testing.assert_array_equal(hits.primitive_id, np.where(hits.hit, nearest, -1))
    assert hits.primitive_id.dtype == np.int32
    rows = np.arange(len(rays))
    np.testing.assert_array_equal(hits.front, hits.hit & is_front[rows, nearest])
    points = rays[:, :3] + hits.t[:, None] * rays[:, 3:]
    np.testing.assert_allclose(hits.position[hits.hit], points[hits.hit], atol=1e-5)
    assert np.isnan(hits.position[~hits.hit]).all() and np.isnan(hits.normal[~hits.hit]).all()
    np.testing.assert_array_equal(hits.geometry_id, np.where(hits.hit, 0, -1))
    np.testing.assert_array_equal(hits.instance_id, -1)


def test_any_hits_and_counts(asked):
    scene, rays, t, _ = asked
    np.testing.assert_array_equal(scene.any_hit(rays), np.isfinite(t).any(axis=1))
    counts = scene.count(rays)
    assert counts.dtype == np.int32
    np.testing.assert_array_equal(counts, np.isfinite(t).sum(axis=1))


def test_all_hits(asked):
    scene, rays, t, _ = asked
    hits = scene.all_hits(rays)
    np.testing.assert_array_equal(hits.counts, scene.count(rays))
    np.testing.assert_array_equal(hits.offsets, np.concatenate([[0], np.cumsum(hits.counts)]))
    ray, triangle = np.nonzero(np.isfinite(t))
    order = np.lexsort((t[ray, triangle], ray))
    np.testing.assert_array_equal(hits.ray_id, ray[order])
    np.testing.assert_array_equal(hits.primitive_id, triangle[order])
    np.testing.assert_allclose(hits.t, t[ray, triangle][order], rtol=1e-6)
    assert hits.t.dtype == rays.dtype and len(hits) == len(ray)
    first = hits[hits.offsets[:-1][hits.counts > 0]]
    np.testing.assert_array_equal(first.t, scene.closest_hit(rays).t[hits.counts > 0])


def test_a_limit_keeps_the_first_hits(ball):
    rays = random_rays(2000)
    whole, one = ball.all_hits(rays), ball.all_hits(rays, limit=1)
    np.testing.assert_array_equal(one.counts, np.minimum(whole.counts, 1))
    np.testing.assert_array_equal(one.t, whole.t[whole.offsets[:-1][whole.counts > 0]])
    assert len(ball.all_hits(rays, limit=0)) == 0


def test_rays_through_edges_and_vertices_are_not_lost(cube):
    x, y = np.meshgrid(np.linspace(0, 1, 5), np.linspace(0, 1, 5))
    origins = np.stack([x, y, np.full_like(x, -1)], axis=-1)
    hits = cube.closest_hit(origins, [0, 0, 1])
    assert hits.shape == (5, 5)
    np.testing.assert_array_equal(hits.t, 1)
    assert set(np.unique(cube.count(origins, [0, 0, 1]))) <= {0, 2}


def test_bounds_of_t_belong_to_the_interval(cube):
    ray = [0.3, 0.2, -1, 0, 0, 1]
    assert cube.any_hit(ray, t_max=1.0) and not cube.any_hit(ray, t_max=np.nextafter(1, 0))
    assert cube.closest_hit(ray, t_min=1.0).t == 1 and cube.closest_hit(ray, t_min=1.5).t == 2
    t_max = np.array([0.5, 1.0, 5.0])
    np.testing.assert_array_equal(cube.any_hit(ray, t_max=t_max), [False, True, True])
    np.testing.assert_array_equal(cube.count(ray, t_min=[[0.0], [1.5]], t_max=t_max), [[0, 1, 2], [0, 0, 1]])
    assert cube.count([0.3, 0.2, 5, 0, 0, 1], t_min=-np.inf) == 2


def test_f64_vertices_are_not_rounded():
    corner = np.array([500_000.0, 5_400_000.0, 0.001])
    scene = kdray.Scene(corner + [[0, 0, 0], [1, 0, 0.001], [0, 1, 0]], [[0, 1, 2]])
    hit = scene.closest_hit(corner * [1, 1, 0] + [0.5, 0.25, 0], [0, 0, 1])
    assert abs(float(hit.t) - 0.0015) < 1e-9


def test_normals_are_of_length_one_and_point_to_the_front(cube):
    hits = cube.closest_hit([[0.3, 0.2, -1], [0.3, 0.2, 0.5]], [0, 0, 1])
    np.testing.assert_array_equal(hits.normal, [[0, 0, -1], [0, 0, 1]])
    np.testing.assert_array_equal(hits.front, [True, False])


def test_several_geometries_have_ids_of_their_own():
    scene = kdray.Scene()
    ids = [scene.add_triangles(CUBE_VERTICES + [3 * k, 0, 0], CUBE_FACES) for k in range(3)]
    assert ids == [0, 1, 2] and len(scene) == 36 and scene.dtype == np.float64
    assert scene.faces.max() == 23 and scene.vertices.shape == (24, 3)
    hits = scene.closest_hit([[0.3, 0.2, -1], [6.3, 0.2, -1], [2, 2, 2]], [0, 0, 1])
    np.testing.assert_array_equal(hits.geometry_id, [0, 2, -1])
    assert hits.primitive_id[0] == hits.primitive_id[1] < 12
    np.testing.assert_allclose(hits.position[:2], [[0.3, 0.2, 0], [6.3, 0.2, 0]])
    np.testing.assert_array_equal(scene.bounds, [[0, 0, 0], [7, 1, 1]])
    assert scene.faces.max() == 23 and scene.vertices.shape == (24, 3)


def test_normals_of_instances_are_exact_at_any_size_and_place():
    ray = [0.3, 0.2, 3.0, 0, 0, -1]
    for scale in (1e-120, 1e-10, 1e120):
        scene = kdray.Scene(CUBE_VERTICES, CUBE_FACES, dtype=np.float64)
        scene.add_instance(0, np.diag([-scale, scale, scale, 1.0]))
        hits = scene.closest_hit(np.multiply(ray, [-scale, scale, scale, 1, 1, 1]))
        assert hits.front and hits.normal.tolist() == [0, 0, 1], scale
    turned = np.eye(4)
    turned[:3] = [[0.36, 0.48, -0.8, 1e9], [-0.8, 0.6, 0, 1e9], [0.48, 0.64, 0.6, 1e9]]
    scene = kdray.Scene(CUBE_VERTICES * np.float32(2**-13), CUBE_FACES, dtype=np.float64)
    scene.add_instance(0, turned)
    hits = scene.closest_hit(turned[:3, :3] @ [0.3 * 2**-13, 0.2 * 2**-13, 9] + 1e9, -turned[:3, 2])
    np.testing.assert_allclose(hits.normal, turned[:3, 2], atol=1e-12)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_bounds_of_instances_leave_out_what_is_empty(dtype):
    scene = kdray.Scene(np.zeros((0, 3), dtype), np.zeros((0, 3), int), dtype=dtype)
    scene.add_instance(0, np.eye(4))
    assert scene.bounds is None and not scene.any_hit([0, 0, -1, 0, 0, 1])
    scene = kdray.Scene(np.zeros((0, 3), dtype), np.zeros((0, 3), int), dtype=dtype)
    cube = scene.add_triangles(CUBE_VERTICES + np.float32(1000), CUBE_FACES)
    scene.add_instance(cube, np.eye(4))
    np.testing.assert_allclose(scene.bounds, [[1000] * 3, [1001] * 3], atol=0.01)
    assert scene.count([1000.3, 1000.2, 0, 0, 0, 1]) == 2


def test_finite_t_of_f32_rays_stay_finite(cube):
    hits = cube.closest_hit(np.array([0.3, 0.2, -1, 0, 0, 1e-40], np.float32))
    assert hits.t == np.finfo(np.float32).max and hits.primitive_id >= 0
    assert cube.closest_hit(np.array([3, 2, -1, 0, 0, 1], np.float32)).t == np.inf


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_instances_are_placed_and_masked(dtype):
    scene = kdray.Scene(CUBE_VERTICES, CUBE_FACES, dtype=dtype)
    floor = scene.add_triangles(np.array([[-9, -9, 5], [9, -9, 5], [0, 9, 5]], np.float32), [[0, 1, 2]])
    moved, mirrored = np.eye(4), np.diag([-1.0, 1, 1, 1])
    moved[:3, 3] = [2, 0, 0]
    assert [scene.add_instance(0, moved), scene.add_instance(0, mirrored[:3], mask=2)] == [0, 1]
    x = np.array([2.3, -0.3, 0.3])
    hits = scene.closest_hit(np.stack([x, x * 0 + 0.2, x * 0 - 1], axis=-1), [0, 0, 1])
    np.testing.assert_array_equal(hits.instance_id, [0, 1, -1])
    np.testing.assert_array_equal(hits.geometry_id, [0, 0, floor])
    np.testing.assert_array_equal(hits.t, [1, 1, 6])
    np.testing.assert_array_equal(hits.normal[:2], [[0, 0, -1], [0, 0, -1]])
    np.testing.assert_allclose(hits.position[:, 0], x)
    ray = [-0.3, 0.2, -1, 0, 0, 1]
    assert scene.count(ray) == 3 and scene.count(ray, mask=1) == 1 and scene.closest_hit(ray, mask=1).t == 6
    assert scene.any_hit(ray, mask=2, t_max=2) and not scene.any_hit(ray, mask=4, t_max=2)
    np.testing.assert_array_equal(scene.all_hits(ray).instance_id, [1, 1, -1])
    assert scene.dtype == scene.vertices.dtype == dtype
    np.testing.assert_allclose(scene.bounds, [[-9, -9, 0], [9, 9, 5]], atol=1e-4)
