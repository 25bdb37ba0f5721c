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


SHARE_OF_HITS = {camera: (0.2, 0.3), all_around: (0.99, 1), sun: (0.2, 0.4), one_line: (0.99, 1)}
"""Least and most of the rays that hit something."""


def tiny(rng):
    """So close to each other that the inverse of a distance is infinite."""
    return np.arange(COUNT)[:, np.newaxis] * 1e-42 * [1, 0, 0]


def huge(rng):
    """Too far for f32, where places are told apart."""
    return rng.normal(size=(COUNT, 3)) * 10.0 ** rng.integers(-50, 50, (COUNT, 1))


def in_line(rng):
    """On one line, from place to place."""
    return rng.uniform(-0.5, 0.5, (COUNT, 1)) * [1, 1, 0]


def not_finite(rng):
    """Most are no places."""
    places = rng.uniform(-0.5, 0.5, (COUNT, 3))
    places[rng.random(COUNT) < 0.9] = [np.nan, np.inf, -np.inf]
    return places


def alone(query, rays, **bounds):
    parts = [slice(first, first + ALONE) for first in range(0, len(rays), ALONE)]
    chosen = lambda part: {name: np.broadcast_to(it, len(rays))[part] for name, it in bounds.items()}  # noqa: E731
    return [query(rays[part], invalid="miss", **chosen(part)) for part in parts]


@pytest.mark.parametrize("make", [camera, all_around, sun, one_line])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("invalid", [False, True])
@pytest.mark.parametrize("geometries", [1, 2])
def test_answers_are_those_of_rays_alone(make, dtype, invalid, geometries):
    rng = np.random.default_rng(3)
    scene = scene_of(geometries)
    lines = np.broadcast_arrays(*make(rng))
    rays = np.concatenate(lines, axis=1).astype(dtype)
    # What rays share stays shared.
    column = 0 if make is sun else 3 + rng.integers(3)
    if invalid:
        rays[::777, column] = np.nan
    least, most = SHARE_OF_HITS[make]
    assert least - 1 / 777 <= scene.closest_hit(rays, invalid="miss").hit.mean() <= most
    for bounds in ({}, {"t_min": 0.5}, {"t_min": rng.uniform(-1, 2, COUNT), "t_max": rng.uniform(2, 9, COUNT)}):
        assert_as_alone(scene, rays, **bounds)


@pytest.mark.parametrize("make", [tiny, huge, in_line, not_finite])
@pytest.mark.parametrize("parallel", [False, True])
def test_each_ray_has_one_answer_wherever_it_is(make, parallel):
    origins, directions = np.array([[0, 0, -4.0]]), np.array([[0, 0, 1.0]])
    if parallel:
        origins = origins + make(np.random.default_rng(5))
    else:
        directions = directions + make(np.random.default_rng(5))
    rays = np.concatenate(np.broadcast_arrays(origins, directions), axis=1)[:5000]
    for geometries in (1, 2):
        assert_as_alone(scene_of(geometries), rays)


def scene_of(geometries):
    """A ball, or one in another."""
    scene = kdray.Scene(*sphere(40))
    if geometries == 2:
        vertices, faces = sphere(12)
        scene.add_triangles(vertices * np.float32(0.5), faces)
    return scene


def assert_as_alone(scene, rays, **bounds):
    hits = scene.closest_hit(rays, invalid="miss", **bounds)
    assert hits.hit.any()
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
