"""What trimesh's own tests of its ray module ask for, but its source distribution lacks: helpers and models.

The models are made here, after what the tests say of them. All rays go to kdray: both of trimesh's modules for rays
are replaced, that on Embree and that in Python.
"""

import logging
import sys
import time
from types import ModuleType, SimpleNamespace

import numpy as np
import trimesh
import trimesh.ray

from kdray.trimesh import RayMeshIntersector

__all__ = ["data", "get_mesh", "log", "np", "random", "time", "trimesh"]

log = logging.getLogger("trimesh")


def random(shape):
    return np.random.default_rng(0).random(shape)


def get_mesh(name, use_embree=True):
    mesh = MODELS[name]()
    mesh.ray = RayMeshIntersector(mesh)
    mesh._source = SimpleNamespace(file_name=name)
    return mesh


def notched_cube():
    """A cube around the origin, without its eighth where all coordinates are positive."""
    cells = {(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)} - {(1, 1, 1)}
    corners, faces = [], []
    for cell in cells:
        box = trimesh.creation.box(bounds=[np.array(cell), np.array(cell) + 1])
        for triangle, normal in zip(box.triangles, np.rint(box.face_normals).astype(int)):
            if tuple(np.array(cell) + normal) not in cells:
                faces.append(np.arange(3) + len(corners))
                corners.extend(triangle)
    mesh = trimesh.Trimesh((np.array(corners) - 1) * 5.0, faces)
    assert mesh.is_watertight and np.isclose(mesh.volume, 7 * 125)
    return mesh


def bowl():
    """An open mesh: part of a sphere."""
    sphere = trimesh.creation.icosphere(subdivisions=2, radius=3.0)
    sphere.update_faces(sphere.triangles_center[:, 2] < 1.0)
    return sphere


MODELS = {
    "unit_sphere.STL": lambda: trimesh.creation.icosphere(subdivisions=2, radius=0.5),
    "unit_cube.STL": lambda: trimesh.creation.box(extents=[1, 1, 1]),
    "7_8ths_cube.stl": notched_cube,
    "featuretype.STL": lambda: trimesh.creation.annulus(0.5, 1.0, 0.25),
    "teapot.stl": bowl,
}

origins = random((50, 3)) * 4 - 2
data = {
    "ray_data": {
        "load_kwargs": [{"name": name, "use_embree": use} for name in MODELS for use in (True, False)],
        "rays": {name: {"ray_origins": origins, "ray_directions": -origins} for name in MODELS},
    }
}

module = ModuleType("trimesh.ray.ray_pyembree")
module.RayMeshIntersector = RayMeshIntersector
sys.modules[module.__name__] = trimesh.ray.ray_pyembree = module
trimesh.ray.ray_triangle.RayMeshIntersector = RayMeshIntersector
trimesh.ray.has_embree = True
# A test asks for the version of what it thinks it tests.
sys.modules["embreex"] = ModuleType("embreex")
sys.modules["embreex"].__version__ = "4.4.0"
