"""What a depth camera sees, z up: python depth_camera.py [MESH [OUT.png [EYE TARGET]]], points as 1,2,3"""

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
middle, size = scene.bounds.mean(axis=0), np.linalg.norm(np.diff(scene.bounds, axis=0))
given = [np.array(point.split(","), float) for point in sys.argv[3:5]]
eye, target = given or (middle + size * np.array([0.2, -0.7, 0.35]), middle)
ahead = (target - eye) / np.linalg.norm(target - eye)
right = np.cross(ahead, [0, 0, 1]) / np.linalg.norm(np.cross(ahead, [0, 0, 1]))
axes = np.stack([right, np.cross(ahead, right), ahead])  # x to the right, y down, z ahead
u, v = np.meshgrid(np.arange(640) - 319.5, np.arange(480) - 239.5)
pixels = np.stack([u / 525, v / 525, np.ones_like(u)], axis=-1)
# Each direction goes 1 ahead, so that t is the depth that such cameras give, and not the length of the ray.
hits = scene.closest_hit(eye, pixels @ axes)
x, y, z = hits.position[hits.hit].T

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4), layout="constrained")
figure.colorbar(left.imshow(hits.t, "viridis_r"), label="depth")
left.set(title="depth image", xlabel="pixels", ylabel="pixels")
figure.colorbar(right.scatter(x, y, 1, z, lw=0, cmap="turbo"), label="z")
right.plot(*eye[:2], "r*")
right.set(title="its points, and the camera, from above", xlabel="x", ylabel="y", aspect="equal")
figure.savefig(sys.argv[2] if len(sys.argv) > 2 else "depth_camera.png", dpi=90)
