"""Those who answer.

Each is made for a scene and a number of threads. Its methods take rays (n, 6) or points (n, 3) of f32, make of them
the arrays that the library wants, and give a function without arguments: that is what is timed. Others give what of its
answer is compared: t, infinite where nothing is hit, or how many hits there are.
"""

import importlib.metadata

import kdray
import libraries
import numpy as np


class Kdray:
    """kdray takes f32 as they are."""

    name = "kdray"

    def __init__(self, scene, threads):
        self.threads = threads
        self.scene = kdray.Scene(scene.vertices, scene.faces).build()

    def closest(self, rays):
        return lambda: self.scene.closest_hit(rays, threads=self.threads)

    def all(self, rays):
        return lambda: self.scene.all_hits(rays, threads=self.threads)

    def contains(self, points):
        # What is found out about the mesh on the first call is not measured, as with the others.
        self.scene.contains(points[:1], threads=self.threads)
        return lambda: self.scene.contains(points, threads=self.threads)

    def t(self, rays, hits):
        return hits.t

    def counts(self, rays, hits):
        return hits.counts


class Trimesh:
    """trimesh on embreex takes f64, and has one thread. It tells where rays hit, for users want that, too."""

    name = "trimesh"

    def __init__(self, scene, threads):
        self.mesh = TRIMESH.Trimesh(scene.vertices, scene.faces, process=False, validate=False)
        # The tree is built by the first call.
        self.closest(np.float32([[0, 0, 0, 1, 0, 0]]))()

    def closest(self, rays):
        return self._hits(rays, False)

    def all(self, rays):
        return self._hits(rays, True)

    def _hits(self, rays, multiple):
        lines = rays.astype(np.float64)
        origins, directions = (np.ascontiguousarray(part) for part in (lines[:, :3], lines[:, 3:]))
        return lambda: self.mesh.ray.intersects_id(
            origins, directions, multiple_hits=multiple, max_hits=1000, return_locations=True
        )

    def contains(self, points):
        points = points.astype(np.float64)
        self.mesh.contains(points[:1])
        return lambda: self.mesh.contains(points)

    def t(self, rays, answer):
        _, ids, places = answer
        along = rays[ids, 3:].astype(np.float64)
        t = np.full(len(rays), np.inf)
        t[ids] = np.sum((places - rays[ids, :3]) * along, 1) / np.sum(along * along, 1)
        return t

    def counts(self, rays, answer):
        return np.bincount(answer[1], minlength=len(rays))


class TrimeshIds(Trimesh):
    """The fastest that trimesh has: which triangle is hit first, and not where."""

    name = "trimesh, ids only"
    all = contains = None

    def __init__(self, scene, threads):
        self.mesh = TRIMESH.Trimesh(scene.vertices, scene.faces, process=False, validate=False)
        self.closest(np.float32([[0, 0, 0, 1, 0, 0]]))()

    def closest(self, rays):
        lines = rays.astype(np.float64)
        origins, directions = (np.ascontiguousarray(part) for part in (lines[:, :3], lines[:, 3:]))
        return lambda: self.mesh.ray.intersects_first(origins, directions)

    def t(self, rays, ids):
        return np.where(ids >= 0, np.nan, np.inf)


class Open3d:
    """Open3D takes tensors of f32, which share memory with numpy's arrays."""

    name = "Open3D"

    def __init__(self, scene, threads):
        self.threads = threads
        self.scene = OPEN3D.t.geometry.RaycastingScene(nthreads=threads)
        self.scene.add_triangles(self._tensor(scene.vertices), self._tensor(scene.faces))
        # The tree is built by the first call.
        self.closest(np.zeros((1, 6), np.float32))()

    @staticmethod
    def _tensor(array):
        return OPEN3D.core.Tensor(np.ascontiguousarray(array))

    def closest(self, rays):
        rays = self._tensor(rays)
        return lambda: self.scene.cast_rays(rays, nthreads=self.threads)

    def all(self, rays):
        rays = self._tensor(rays)
        return lambda: self.scene.list_intersections(rays, nthreads=self.threads)

    def contains(self, points):
        points = self._tensor(points)
        self.scene.compute_occupancy(points[:1], nthreads=self.threads)
        return lambda: self.scene.compute_occupancy(points, nthreads=self.threads).numpy() > 0.5

    def t(self, rays, hits):
        return hits["t_hit"].numpy()

    def counts(self, rays, hits):
        return np.diff(hits["ray_splits"].numpy().astype(np.int64))


TRIMESH, OPEN3D = libraries.trimesh(), libraries.open3d()


def everyone():
    """Those that can be imported here."""
    others = [Trimesh, TrimeshIds] if TRIMESH else []
    return [Kdray, *others, *([Open3d] if OPEN3D else [])]


def versions():
    packages = [package for package in ("trimesh", "embreex", "open3d-cpu", "numpy") if _version(package)]
    return ", ".join(f"{package} {_version(package)}" for package in packages)


def _version(package):
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return None
