"""How much sky the places of a city have, and which see a mast: python sky_view.py [MESH [OUT.png]]"""

import sys

import kdray
import matplotlib.pyplot as plt
import numpy as np


def city():
    """Houses and a tower on a ground, boxes all, each a geometry of the scene."""
    scene, cube = kdray.Scene(), np.indices((2, 2, 2)).reshape(3, 8).T
    sizes = np.random.default_rng(3).uniform([10, 10, 4], [22, 22, 25], (9, 9, 3))
    sizes[4, 4] = 12, 12, 60
    sides = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    boxes = [[[-15, -15, -1], [270, 270, 1]]] + [[[30 * x, 30 * y, 0], sizes[x, y]] for x, y in np.ndindex(9, 9)]
    for low, size in boxes:
        scene.add_triangles(low + cube * size, sides[:, [0, 1, 2, 0, 2, 3]].reshape(12, 3))
    return scene


scene = kdray.Scene.of(sys.argv[1]) if len(sys.argv) > 1 else city()
x, y, _ = np.linspace([0.75, 0.25], [0.25, 0.75], 300).dot(scene.bounds).T  # the middle half of its box
above = np.stack(np.broadcast_arrays(*np.meshgrid(x, y), scene.bounds[1, 2] + 1), axis=-1)
eyes = scene.closest_hit(above, [0, 0, -1]).position + [0, 0, 1.6]  # on streets and roofs
# Directions as dense as what they send to flat ground: sunflower seeds on a disc, lifted to the dome above it.
out, turn = np.sqrt((np.arange(96) + 0.5) / 96), np.arange(96) * np.pi * (3 - np.sqrt(5))
dome = np.stack([out * np.cos(turn), out * np.sin(turn), np.sqrt(1 - out**2)], axis=-1)
sky = 1 - scene.any_hit(eyes[..., None, :], dome, invalid="miss").mean(axis=-1)
mast = eyes[eyes[..., 2] > np.nanmax(eyes[..., 2]) - 0.01].mean(axis=0) + [0, 0, 10]
seen = scene.visible(eyes, mast, invalid="miss")

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.4), sharey=True, layout="constrained")
frame = {"origin": "lower", "extent": [x[0], x[-1], y[0], y[-1]]}
figure.colorbar(left.imshow(sky, "cividis", vmin=0, vmax=1, **frame), label="share of an even sky's light")
left.set(title="sky view factor", xlabel="x, m", ylabel="y, m")
right.imshow(np.where(seen[..., None], [1, 0.8, 0.4], [0.3, 0.35, 0.5]) * (0.4 + 0.6 * sky[..., None]), **frame)
right.plot(*mast[:2], "r*")
right.set(title=f"{seen.mean():.0%} see the mast (star), {mast[2]:.0f} m high", xlabel="x, m")
figure.savefig(sys.argv[2] if len(sys.argv) > 2 else "sky_view.png", dpi=90)
