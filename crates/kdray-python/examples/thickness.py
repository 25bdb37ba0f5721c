"""How thick the walls of a mesh are, seen along its shortest side: python thickness.py [MESH [OUT.png]]"""

import sys

import kdray
import matplotlib.pyplot as plt
import numpy as np


def vase(n=360):
    """A vase, fluted outside and smooth inside: a profile up, down again and to the axis, turned about z."""
    height, turn = np.linspace(0, 1, 60), 2 * np.pi * np.arange(n) / n
    outer = 0.3 + 0.1 * np.sin(6 * height + 0.5)
    radius = np.r_[0, outer, outer[:4:-1] - 0.05, 0][:, None] + np.zeros(n)
    radius[1:61] += 0.02 * np.cos(12 * turn)
    z = np.r_[0, height, height[:4:-1], height[5]][:, None] + np.zeros(n)
    vertices = np.stack([radius * np.cos(turn), radius * np.sin(turn), z], axis=-1)
    a = np.arange(z.size).reshape(z.shape)
    b, c, d = np.roll(a, -1, 1), np.roll(a, (-1, -1), (0, 1)), np.roll(a, -1, 0)
    return vertices.reshape(-1, 3), np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)


scene = kdray.Scene.of(sys.argv[1]) if len(sys.argv) > 1 else kdray.Scene(*vase())
low, high = scene.bounds
x, y = np.delete(range(3), thin := np.argmin(high - low))
toward = np.eye(3)[thin] * (-1 if thin == 1 else 1)  # to the eye, so that no picture is mirrored
pixels = np.full((600, 600, 3), (low + high) / 2 + toward * (high - low))
pixels[..., x], pixels[..., y] = np.meshgrid(*np.linspace(low, high, 600).T[[x, y]])
hits = scene.closest_hit(pixels, -toward)
thickness = scene.thickness(hits)

cmap = plt.get_cmap("turbo_r").with_extremes(bad="grey")  # a hole in the mesh: no surface on the way
scale = plt.cm.ScalarMappable(plt.Normalize(0, np.nanquantile(thickness, 0.95)), cmap)
colours = scale.to_rgba(thickness)[..., :3] * (0.35 + 0.65 * np.abs(hits.normal @ toward))[..., None]
figure, axes = plt.subplots(figsize=(7, 5.6), layout="constrained")
axes.imshow(np.where(hits.hit[..., None], colours, 1), origin="lower", extent=[low[x], high[x], low[y], high[y]])
figure.colorbar(scale, ax=axes, label="thickness at a right angle to the surface", extend="max")
axes.set_title(f"one pixel in ten is thinner than {np.nanquantile(thickness, 0.1):.3g}")
axes.set(xlabel="xyz"[x], ylabel="xyz"[y])
figure.savefig(sys.argv[2] if len(sys.argv) > 2 else "thickness.png", dpi=90)
