"""A section through a scan, and the areas of all such sections: python section.py [MESH [OUT.png]]"""

import sys

import kdray
import matplotlib.pyplot as plt
import numpy as np


def nut(n=120):
    """A shell and a kernel: a profile from pole to pole, back inside, and down again, turned about z."""
    lat, turn = np.r_[0:np.pi:60j, np.pi:0:60j, 0:np.pi:60j][:, None], 2 * np.pi * np.arange(n) / n
    radius = np.repeat([1, 0.8, 0.5], 60)[:, None] * (1 + 0.1 * np.cos(3 * turn) * np.sin(4 * lat))
    out = radius * np.sin(lat).round(12)  # zero at both poles
    vertices = np.stack([out * np.cos(turn), 0.9 * out * np.sin(turn), radius * np.cos(lat)], axis=-1)
    a = np.arange(out.size).reshape(out.shape)
    b, c, d = np.roll(a, -1, 0), np.roll(a, (-1, -1), (0, 1)), np.roll(a, -1, 1)
    return vertices.reshape(-1, 3), np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)


scene = kdray.Scene.of(sys.argv[1]) if len(sys.argv) > 1 else kdray.Scene(*nut())
low, high = scene.bounds
x, y = np.delete(range(3), thin := np.argmin(high - low))  # across the shortest side: 101 planes of 500 rays
at, rows = (low[a] + (high - low)[a] * (np.arange(n) + 0.5) / n for a, n in ((thin, 101), (y, 500)))
origins = np.full((at.size, rows.size, 3), low)
origins[..., thin], origins[..., y] = at[:, None], rows
hits = scene.all_hits(origins, np.eye(3)[x])
# A line leaves a closed mesh as often as it enters it. Where not, it went through a hole of the scan: left out.
paired = (hits.counts.reshape(-1) % 2 == 0)[hits.ray_id]
start, end = low[x] + hits.t[paired].reshape(-1, 2).T
plane, row = np.divmod(hits.ray_id[paired][::2], rows.size)
areas = np.bincount(plane, end - start, at.size) * (rows[1] - rows[0])

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.6), layout="constrained", width_ratios=[3, 2])
left.hlines(rows[row[plane == 50]], start[plane == 50], end[plane == 50], lw=1.2, snap=False)
left.set(xlabel="xyz"[x], ylabel="xyz"[y], aspect="equal", title=f"section at {'xyz'[thin]} = {at[50]:.3g}")
right.fill_between(at, areas, alpha=0.4)
right.axvline(at[50], color="black", lw=1)
right.set(xlabel="xyz"[thin], title=f"areas of all sections: volume {areas.sum() * (at[1] - at[0]):.4g}", ylim=0)
figure.savefig(sys.argv[2] if len(sys.argv) > 2 else "section.png", dpi=90)
