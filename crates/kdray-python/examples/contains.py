"""Which points are inside a mesh, and how far its surface is: python contains.py [MESH [OUT.png]]"""

import sys

import kdray
import matplotlib.pyplot as plt
import numpy as np


def ring(n=240, m=60):
    """A closed ring, thick and thin by turns: vertices (n * m, 3), faces (2 * n * m, 3)."""
    u, v = 2 * np.pi * np.arange(n)[:, None] / n, 2 * np.pi * np.arange(m) / m
    thick = 0.6 + 0.25 * np.cos(5 * u)
    out = 2 + thick * np.cos(v)
    vertices = np.stack([out * np.cos(u), out * np.sin(u), thick * np.sin(v)], axis=-1)
    a = np.arange(n * m).reshape(n, m)
    b, c, d = np.roll(a, -1, 0), np.roll(a, (-1, -1), (0, 1)), np.roll(a, -1, 1)
    return vertices.reshape(-1, 3), np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)


scene = kdray.Scene.of(sys.argv[1]) if len(sys.argv) > 1 else kdray.Scene(*ring())
low, high = scene.bounds
points = np.random.default_rng(0).uniform(low, high, (100_000, 3))
inside = scene.contains(points)
x, y = np.delete(range(3), thin := np.argmin(high - low))  # the picture's axes: across the shortest side
plane = np.full((200, 200, 3), (low + high) / 2)
plane[..., x], plane[..., y] = np.meshgrid(*np.linspace(low, high, 200).T[[x, y]])
distance = scene.signed_distance(plane)

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), sharey=True, layout="constrained")
near = np.argsort(np.abs(points - plane[0, 0])[:, thin])[:3000]
left.scatter(points[near, x], points[near, y], s=3, c=np.where(inside[near], "tab:blue", "lightgrey"))
left.set_title(f"{inside.mean():.1%} of {inside.size:,} points: volume {np.prod(high - low) * inside.mean():.3g}")
levels = -distance.min() * np.linspace(-1, 1, 21)
shades = right.contourf(plane[..., x], plane[..., y], distance, levels, cmap="RdBu", extend="max")
right.contour(plane[..., x], plane[..., y], distance, [0], colors="black")
right.set_title("signed distance in the middle plane, negative inside")
figure.colorbar(shades, format="%.2g", ticks=levels[::5])
plt.setp((left, right), xlabel="xyz"[x], ylabel="xyz"[y], aspect="equal")
figure.savefig(sys.argv[2] if len(sys.argv) > 2 else "contains.png", dpi=90)
