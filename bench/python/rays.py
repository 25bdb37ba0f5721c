"""Rays as renderers and simulations cast them: arrays (n, 6) of f32, the same on every run."""

import numpy as np


def primary(scene, count):
    """One through each pixel of a square picture, line by line."""
    eye, look_at, up = (np.array(v) for v in (scene.eye, scene.look_at, scene.up))
    forward = unit(look_at - eye)
    right = unit(np.cross(forward, up))
    side = int(np.ceil(np.sqrt(count)))
    y, x = np.divmod(np.arange(count), side)
    reach = np.tan(np.radians(scene.vfov) / 2)
    x, y = (reach * (2 * (line + 0.5) / side - 1) for line in (x, y))
    across = x[:, None] * right - y[:, None] * np.cross(right, forward)
    return together(np.broadcast_to(eye, (count, 3)), unit(forward + across))


def diffuse(scene, traced, count):
    """From where camera rays hit, one in a random direction by the cosine to the normal, as many as asked for.

    ``traced`` is the kdray.Scene.
    """
    rng = np.random.default_rng(6)
    lines = primary(scene, count).astype(np.float64)
    hits = traced.closest_hit(lines)
    seen = np.flatnonzero(hits.hit)
    # Those that hit more than once or not at all make up for those that miss.
    chosen = seen[np.sort(rng.integers(len(seen), size=count))]
    normals = hits.normal[chosen]
    normals *= -np.sign(np.sum(normals * lines[chosen, 3:], axis=1, keepdims=True))
    # Points of a sphere that touches the surface are spread by the cosine.
    directions = unit(normals + unit(rng.normal(size=(count, 3))) * (1 - 1e-6))
    return together(hits.position[chosen] + 1e-5 * scene.diagonal * normals, directions)


def together(origins, directions):
    return np.ascontiguousarray(np.concatenate([origins, directions], axis=1), np.float32)


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
