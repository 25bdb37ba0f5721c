"""Meshes, and from where they are seen."""

import json
from dataclasses import dataclass
from pathlib import Path

import kdray
import numpy as np

SHARED = Path(__file__).resolve().parents[3] / "shared" / "scenes"
"""Where large scenes are, if they are there: beside the checkout."""


@dataclass(frozen=True)
class Scene:
    """Triangles and a camera."""

    name: str
    vertices: np.ndarray
    """(n, 3) of f32."""
    faces: np.ndarray
    """(m, 3) of u32."""
    eye: tuple = (0.0, 0.0, 0.0)
    look_at: tuple = (0.0, 0.0, -1.0)
    up: tuple = (0.0, 1.0, 0.0)
    vfov: float = 40.0
    """Between the upper and the lower edge of the picture, in degrees."""

    @property
    def diagonal(self):
        return float(np.linalg.norm(np.ptp(self.vertices.astype(np.float64), axis=0)))


def default_names():
    """Scans and interiors, or what code can make."""
    names = ["armadillo", "bunny", "sponza", "kitchen"]
    return names if (SHARED / "scenes.json").exists() else ["torus"]


def load(name):
    """The scene of that name."""
    if name == "torus":
        return torus()
    listing = json.loads((SHARED / "scenes.json").read_text())["scenes"] if SHARED.exists() else []
    entry = next((entry for entry in listing if entry["name"] == name), None)
    if entry is None:
        known = ", ".join(["torus", *(entry["name"] for entry in listing)])
        raise SystemExit(f"there is no scene {name}, but these: {known}")
    mesh, camera = kdray.Scene.of(SHARED / entry["file"]), entry["camera"]
    view = (tuple(camera[key]) for key in ("eye", "look_at", "up"))
    return Scene(name, mesh.vertices, mesh.faces, *view, camera["vfov_deg"])


def torus(around=400, across=250):
    """200,000 triangles, closed."""
    a, b = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    u, v = a * (2 * np.pi / around), b * (2 * np.pi / across)
    r = 2 + 0.8 * np.cos(v)
    vertices = np.stack([r * np.cos(u), 0.8 * np.sin(v), r * np.sin(u)], axis=-1)
    corner = lambda i, j: ((a + i) % around * across + (b + j) % across).reshape(-1)  # noqa: E731
    one, two, three, four = corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)
    faces = np.concatenate([np.stack([one, two, three], 1), np.stack([one, three, four], 1)])
    vertices = vertices.reshape(-1, 3).astype(np.float32)
    return Scene("torus", vertices, faces.astype(np.uint32), eye=(0.0, 4.0, 7.0), look_at=(0.0, 0.0, 0.0))
