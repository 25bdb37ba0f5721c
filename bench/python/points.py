"""Points whose place inside or outside is known."""

import numpy as np
from scenes import Scene


def in_box(scene, count):
    """Points anywhere in the mesh's box, as f32."""
    rng = np.random.default_rng(7)
    low, high = scene.vertices.min(0), scene.vertices.max(0)
    return np.minimum(rng.uniform(low, high, size=(count, 3)).astype(np.float32), high)


def stairs(size=40):
    """Which unit cells of a grid are solid: columns that do not rise along either axis.

    So solid cells never meet in an edge or a corner alone, and the surface is a closed manifold.
    """
    rng = np.random.default_rng(8)
    i, j = np.ogrid[:size, :size]
    heights = size - (i + j) // 2 - rng.integers(0, 3, (size, size))
    heights = np.minimum.accumulate(np.minimum.accumulate(heights, 0), 1).clip(1)
    return np.arange(size) < heights[..., None]


def surface(solid):
    """The surface between solid cells and empty ones, two triangles a square, on whole coordinates from 1 on:
    next to 0 are numbers that Embree takes for 0.
    """
    padded = np.pad(solid, 1)
    quads = []
    for axis in range(3):
        ahead = np.diff(padded.astype(np.int8), axis=axis)
        for sign in (-1, 1):
            cells = np.argwhere(ahead == sign) - 1
            # The plane lies behind the first of the two cells.
            cells[:, axis] += 1
            u, v = np.eye(3, dtype=int)[[(axis + 1) % 3, (axis + 2) % 3]]
            corners = [cells, cells + u, cells + u + v, cells + v]
            quads.append(np.stack(corners if sign < 0 else corners[::-1], axis=1))
    quads = np.concatenate(quads)
    vertices, index = np.unique(quads.reshape(-1, 3), axis=0, return_inverse=True)
    index = index.reshape(-1, 4)
    faces = np.concatenate([index[:, [0, 1, 2]], index[:, [0, 2, 3]]]).astype(np.uint32)
    return Scene("stairs", vertices.astype(np.float32) + 1, faces)


def beside(solid, count):
    """Points of f32 one unit in the last place from vertices, edges' middles, faces' middles and walls of the
    cells, and whether each is inside: its cell is.

    Each coordinate is next to a whole number or, half of the time, in the middle between two.
    """
    rng = np.random.default_rng(9)
    size = solid.shape[0]
    grid = rng.integers(1, size + 2, (count, 3)).astype(np.float32)
    away = np.where(rng.random((count, 3)) < 0.5, np.float32(-np.inf), np.float32(np.inf))
    points = np.where(rng.random((count, 3)) < 0.5, np.nextafter(grid, away), grid + np.float32(0.5))
    cells = np.floor(points).astype(int) - 1
    within = ((cells >= 0) & (cells < size)).all(1)
    inside = within.copy()
    inside[within] = solid[tuple(cells[within].T)]
    return points, inside
