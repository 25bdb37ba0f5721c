"""Rays that share an origin or a direction: the same answers as of each alone."""

import numpy as np
import pytest
from conftest import random_rays, sphere

import kdray

COUNT = 20_000
"""Several blocks."""

ALONE = 50
"""So few rays are never a packet."""


def camera(rng):
    """Line by line, from one point."""
    y, x = np.divmod(np.arange(COUNT), 160)
    directions = np.stack([x / 80 - 1, y / 80 - 0.8, np.full(COUNT, 2.0)], axis=1)
    return np.array([[0.1, 0.2, -4.0]]), directions


def all_around(rng):
    """In all directions, from within."""
    return np.array([[0.1, 0.2, 0.3]]), rng.normal(size=(COUNT, 3))


def sun(rng):
    """In one direction."""
    origins = rng.uniform(-1.5, 1.5, (COUNT, 3)) - [0, 0, 4]
    return origins, np.array([[0.25, -0.125, 1.0]])


def one_line(rng):
    """The same ray again and again."""
    return np.array([[0.1, 0.2, -4.0]]), np.broadcast_to([0.0, 0.0, 1.0], (COUNT, 3))


def alone(query, rays, **bounds):
    parts = [slice(first, first + ALONE) for first in range(0, COUNT, ALONE)]
    chosen = lambda part: {name: np.broadcast_to(it, COUNT)[part] for name, it in bounds.items()}  # noqa: E731
    return [query(rays[part], invalid="miss", **chosen(part)) for part in parts]


@pytest.mark.parametrize("make", [camera, all_around, sun, one_line])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_answers_are_those_of_rays_alone(make, dtype):
    rng = np.random.default_rng(3)
    first, second = sphere(40), sphere(12)
    scene = kdray.Scene(*first)
    scene.add_triangles(second[0] * dtype(0.5), second[1])
    lines = np.broadcast_arrays(*make(rng))
    rays = np.concatenate(lines, axis=1).astype(dtype)
    rays[::777, 3 + rng.integers(3)] = np.nan
    for bounds in ({}, {"t_min": 0.5}, {"t_min": rng.uniform(-1, 2, COUNT), "t_max": rng.uniform(2, 9, COUNT)}):
        hits = scene.closest_hit(rays, invalid="miss", **bounds)
        assert 0 < np.count_nonzero(hits.hit) < COUNT
        expected = alone(scene.closest_hit, rays, **bounds)
        for name in ("t", "u", "v", "primitive_id", "geometry_id", "front"):
            together = np.concatenate([getattr(part, name) for part in expected])
            np.testing.assert_array_equal(getattr(hits, name), together, err_msg=name)
        found = scene.any_hit(rays, invalid="miss", **bounds)
        np.testing.assert_array_equal(found, np.concatenate(alone(scene.any_hit, rays, **bounds)))


def test_rays_may_be_one_array_or_two():
    scene, rays = kdray.Scene(*sphere(20)), random_rays(5000).astype(np.float32)
    expected = scene.closest_hit(rays).t
    np.testing.assert_array_equal(scene.closest_hit(rays[:, :3], rays[:, 3:]).t, expected)
    apart = np.ascontiguousarray(rays[:, :3]), np.asfortranarray(rays[:, 3:])
    np.testing.assert_array_equal(scene.closest_hit(*apart).t, expected)
    every = np.repeat(rays, 2, axis=0)[::2]
    np.testing.assert_array_equal(scene.closest_hit(every).t, expected)
    picture = rays.reshape(50, 100, 6)[:, ::-1]
    np.testing.assert_array_equal(scene.closest_hit(picture).t, expected.reshape(50, 100)[:, ::-1])
