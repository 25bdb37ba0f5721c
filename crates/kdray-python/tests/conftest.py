"""What the tests share."""

from __future__ import annotations

import numpy as np
import pytest

import kdray

CUBE_VERTICES = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=np.float32)
CUBE_FACES = np.array(
    [
        [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
        [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5],
    ]
)  # fmt: skip


def sphere(bands: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """A closed mesh around the origin, of 4 bands^2 triangles or fewer, dented a little."""
    angles = np.linspace(0, np.pi, bands + 1)[1:-1]
    turns = np.linspace(0, 2 * np.pi, 2 * bands, endpoint=False)
    rings = [[np.sin(a) * np.cos(t), np.sin(a) * np.sin(t), np.cos(a)] for a in angles for t in turns]
    vertices = np.array([[0, 0, 1], *rings, [0, 0, -1]])
    rng = np.random.default_rng(seed)
    vertices *= rng.uniform(0.9, 1.0, (len(vertices), 1))
    around, faces = 2 * bands, []
    at = lambda ring, turn: 1 + ring * around + turn % around
    for turn in range(around):
        faces.append([0, at(0, turn), at(0, turn + 1)])
        faces.append([len(vertices) - 1, at(bands - 2, turn + 1), at(bands - 2, turn)])
        for ring in range(bands - 2):
            a, b, c, d = at(ring, turn), at(ring, turn + 1), at(ring + 1, turn), at(ring + 1, turn + 1)
            faces += [[a, c, b], [b, c, d]]
    return vertices.astype(np.float32), np.array(faces)


def random_rays(count: int, dtype: type = np.float64, seed: int = 1) -> np.ndarray:
    """Rays (count, 6) from around the unit ball, most of which meet it."""
    rng = np.random.default_rng(seed)
    origins = rng.normal(size=(count, 3))
    origins *= 2 / np.linalg.norm(origins, axis=1, keepdims=True)
    targets = rng.uniform(-0.8, 0.8, (count, 3))
    return np.hstack([origins, targets - origins]).astype(dtype)


def brute_force(vertices: np.ndarray, faces: np.ndarray, rays: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """t of each ray and triangle, infinite where they do not meet, and the sides, by Moeller and Trumbore in f64."""
    a, b, c = (vertices[faces[:, k]].astype(np.float64)[None] for k in range(3))
    origin, direction = (part[:, None].astype(np.float64) for part in (rays[:, :3], rays[:, 3:]))
    first, second = b - a, c - a
    across = np.cross(direction, second)
    det = (across * first).sum(-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        start = origin - a
        u = (start * across).sum(-1) / det
        turned = np.cross(start, first)
        v = (direction * turned).sum(-1) / det
        t = (second * turned).sum(-1) / det
        meets = (u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0)
    return np.where(meets, t, np.inf), det > 0


@pytest.fixture
def cube() -> kdray.Scene:
    return kdray.Scene(CUBE_VERTICES, CUBE_FACES)


@pytest.fixture(scope="session")
def ball() -> kdray.Scene:
    return kdray.Scene(*sphere(20))


@pytest.fixture(scope="session")
def large() -> kdray.Scene:
    """A scene in which rays take a while."""
    return kdray.Scene(*sphere(150)).build()
