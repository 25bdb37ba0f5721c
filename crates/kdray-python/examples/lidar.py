"""What a spinning LIDAR measures in a city, z up, in metres: python lidar.py [MESH [OUT.png]]"""

import sys

import kdray
import matplotlib.pyplot as plt
import numpy as np


def city():
    """Houses on a ground, boxes all, each a geometry of the scene."""
    scene, cube = kdray.Scene(), np.indices((2, 2, 2)).reshape(3, 8).T
    sizes = np.random.default_rng(3).uniform([10, 10, 4], [22, 22, 25], (9, 9, 3))
    sides = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    boxes = [[[-15, -15, -1], [270, 270, 1]]] + [[[30 * x, 30 * y, 0], sizes[x, y]] for x, y in np.ndindex(9, 9)]
    for low, size in boxes:
        scene.add_triangles(low + cube * size, sides[:, [0, 1, 2, 0, 2, 3]].reshape(12, 3))
    return scene


scene = kdray.Scene.of(sys.argv[1]) if len(sys.argv) > 1 else city()
low, high = scene.bounds
# The sensor is 2 m above the ground, where there is most room as told 40 m above: near the middle, on no roof.
above = low + (high - low) * np.random.default_rng(0).uniform([0.35, 0.35, 1], [0.65, 0.65, 1], (3000, 3))
ground = scene.closest_hit(above, [0, 0, -1]).position
ground = ground[ground[:, 2] <= np.nanquantile(ground[:, 2], 0.1)]
sensor = ground[np.argmax(scene.closest_point(ground + [0, 0, 40]).distance)] + [0, 0, 2]
up, turn = np.radians(np.linspace(15, -25, 128))[:, None], np.radians(np.arange(2048) * 360 / 2048)
beams = np.stack([np.cos(up) * np.cos(turn), np.cos(up) * np.sin(turn), np.sin(up) + 0 * turn], axis=-1)
hits = scene.closest_hit(sensor, beams, t_min=0.5, t_max=150)
ranges = np.where(hits.hit, hits.t + np.random.default_rng(1).normal(0, 0.02, hits.shape), np.nan)  # +- 2 cm
cloud = (sensor + ranges[..., None] * beams)[hits.hit]

figure, (top, bottom) = plt.subplots(2, 1, figsize=(10, 7), layout="constrained", height_ratios=[3, 1])
seen = (cloud - sensor) @ np.array([[-0.6, 0.8, 0], [-0.48, -0.36, 0.8]]).T  # from aside and above
figure.colorbar(top.scatter(*seen.T, 1, cloud[:, 2], lw=0, cmap="rainbow", vmax=30), label="z, m", extend="max")
top.set(aspect="equal", facecolor="black", xticks=[], yticks=[], title=f"{len(cloud):,} points of one turn")
figure.colorbar(bottom.imshow(ranges, "viridis_r", aspect="auto", extent=[0, 360, -25, 15]), label="range, m")
bottom.set(xlabel="azimuth, degrees", ylabel="elevation, degrees")
figure.savefig(sys.argv[2] if len(sys.argv) > 2 else "lidar.png", dpi=90)
