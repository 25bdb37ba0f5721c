"""Ray queries under the interface of ``open3d.t.geometry.RaycastingScene``, in numpy's arrays.

>>> from kdray.open3d import RaycastingScene
>>> scene = RaycastingScene()
>>> scene.add_triangles([[0, 0, 2], [2, 0, 2], [0, 2, 2]], [[0, 1, 2]])
0
>>> scene.cast_rays([[0.5, 0.5, 0, 0, 0, 1]])["t_hit"]
array([2.])

Open3D itself is not needed; its tensors and meshes are taken if there are any.
"""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arrays import FloatArray, face_indices, is_single, vectors
from .errors import ArgumentError, renamed
from .hits import Hits
from .meshes import triangles_of
from .pinhole import rays_of_field_of_view, rays_of_matrices
from .scene import Scene
from .whole import whole

__all__ = ["RaycastingScene"]

Answers = dict[str, NDArray[Any]]
"""Arrays by their names."""

_named = renamed({"t_min": "tnear", "t_max": "tfar", "threads": "nthreads"})
"""Errors name the arguments of queries as Open3D does."""


class RaycastingScene:
    """What ``open3d.t.geometry.RaycastingScene`` is, with exact answers.

    Methods, arguments, names, shapes and whole numbers are Open3D's. What differs:

    - Answers are numpy's arrays: leave out ``.numpy()``.
    - f64 is taken as well, and answered by f64; f32 gives f32.
    - Hits are exact, and those of ``list_intersections`` come by rising ``t_hit``.
    - Inside and outside are exact for watertight meshes, and told by the winding number for others, so that
      ``nsamples`` changes nothing.

    Triangles may be added at any time; the first query after that builds the tree.
    """

    INVALID_ID = 0xFFFF_FFFF
    """The id where nothing was hit."""

    def __init__(self, nthreads: int = 0, device: Any = None) -> None:
        """A scene without triangles, built on ``nthreads`` threads; 0 leaves their number to kdray.

        ``device`` is there for those who give it: all runs on processors.
        """
        self._threads = _threads(nthreads)
        self._meshes: list[tuple[FloatArray, NDArray[Any]]] = []
        self._scene: Optional[Scene] = None

    def add_triangles(
        self, vertex_positions: Any = None, triangle_indices: Any = None, *, mesh: Any = None
    ) -> int:
        """Adds vertices (n, 3) and triangles (m, 3), or an Open3D or trimesh mesh alone. Returns its id."""
        names = {"vertices": "vertex_positions", "faces": "triangle_indices"}
        if triangle_indices is None:
            name, given = ("vertex_positions", vertex_positions) if mesh is None else ("mesh", mesh)
            others = "vertex_positions and triangle_indices; files are read by kdray.Scene.of"
            vertex_positions, triangle_indices = triangles_of(name, given, others)
            names = {}
        with renamed(names):
            positions = np.array(vectors("vertices", _numpy(vertex_positions)))
            indices = np.array(face_indices(_numpy(triangle_indices)))
            # It says what is wrong with them, now.
            Scene(positions, indices)
        self._meshes.append((positions, indices))
        self._scene = None
        return len(self._meshes) - 1

    @_named
    def cast_rays(self, rays: Any, nthreads: int = 0) -> Answers:
        """The first hits of rays (..., 6).

        ``t_hit`` (...) is infinite where there is none; ``geometry_ids`` and ``primitive_ids`` (...) are
        ``INVALID_ID``, ``primitive_uvs`` (..., 2) and ``primitive_normals`` (..., 3) zero.
        """
        hits = self._built().closest_hit(_rays(rays), invalid="miss", threads=_threads(nthreads))
        normals = np.where(hits.hit[..., np.newaxis], hits.normal, hits.t.dtype.type(0))
        return {**_of_hits(hits), "primitive_normals": normals}

    @_named
    def test_occlusions(
        self, rays: Any, tnear: float = 0.0, tfar: float = np.inf, nthreads: int = 0
    ) -> NDArray[np.bool_]:
        """Whether rays (..., 6) hit anything between ``tnear`` and ``tfar``."""
        threads = _threads(nthreads)
        bounds: dict[str, Any] = {"t_min": tnear, "t_max": tfar}
        return self._built().any_hit(_rays(rays), **bounds, invalid="miss", threads=threads)

    @_named
    def count_intersections(self, rays: Any, nthreads: int = 0) -> NDArray[np.int32]:
        """How many surfaces rays (..., 6) cross."""
        return self._built().count(_rays(rays), invalid="miss", threads=_threads(nthreads))

    @_named
    def list_intersections(self, rays: Any, nthreads: int = 0) -> Answers:
        """All hits of rays (..., 6), in flat arrays, by ray and by rising ``t_hit``.

        Those of ray ``i`` are at ``ray_splits[i]:ray_splits[i + 1]``; ``ray_ids`` says the same hit by hit.
        """
        hits = self._built().all_hits(_rays(rays), invalid="miss", threads=_threads(nthreads))
        places = {"ray_splits": _whole(hits.offsets), "ray_ids": _whole(hits.ray_id)}
        return {**places, **_of_hits(hits)}

    @_named
    def compute_closest_points(self, query_points: Any, nthreads: int = 0) -> Answers:
        """The nearest points of the triangles to points (..., 3): ``points`` (..., 3), and where they lie."""
        points = vectors("query_points", _numpy(query_points))
        found = self._built().closest_point(points, invalid="miss", threads=_threads(nthreads))
        return {
            "points": found.point,
            "geometry_ids": found.geometry_id.astype(np.uint32),
            "primitive_ids": found.primitive_id.astype(np.uint32),
            "primitive_uvs": np.stack([found.u, found.v], axis=-1),
            "primitive_normals": found.normal,
        }

    @_named
    def compute_distance(self, query_points: Any, nthreads: int = 0) -> FloatArray:
        """How far points (..., 3) are from the nearest triangle; infinite if there is none."""
        points = vectors("query_points", _numpy(query_points))
        return self._built().closest_point(points, invalid="miss", threads=_threads(nthreads)).distance

    @_named
    def compute_signed_distance(
        self, query_points: Any, nthreads: int = 0, nsamples: int = 1
    ) -> FloatArray:
        """The same, negative inside."""
        _check_samples(nsamples)
        points = vectors("query_points", _numpy(query_points))
        return self._built().signed_distance(points, invalid="miss", threads=_threads(nthreads))

    @_named
    def compute_occupancy(
        self, query_points: Any, nthreads: int = 0, nsamples: int = 1
    ) -> FloatArray:
        """1 for points (..., 3) inside, or on the surface, and 0 for others."""
        _check_samples(nsamples)
        points = vectors("query_points", _numpy(query_points))
        inside = self._built().contains(points, invalid="miss", threads=_threads(nthreads))
        occupancy: FloatArray = inside.astype(points.dtype)
        return occupancy

    @staticmethod
    def create_rays_pinhole(*args: Any, **kwargs: Any) -> NDArray[np.float32]:
        """Rays (height_px, width_px, 6) through the middles of a pinhole camera's pixels, row by row.

        Either of ``intrinsic_matrix`` (3, 3), ``extrinsic_matrix`` (4, 4) from the world to the camera,
        ``width_px`` and ``height_px``: directions reach depth 1. Or of ``fov_deg``, the angle across, ``center``,
        to which the camera looks, ``eye``, ``up``, ``width_px`` and ``height_px``: as Open3D has it, that picture is
        turned by 180 degrees, and ``rays[::-1, ::-1]`` stands upright.
        """
        if "fov_deg" in kwargs or args and is_single(_numpy(args[0])):
            return rays_of_field_of_view(*args, **kwargs)
        return rays_of_matrices(*args, **kwargs)

    def _built(self) -> Scene:
        """The scene of all that was added."""
        if self._scene is None:
            scene = Scene()
            for positions, indices in self._meshes:
                scene.add_triangles(positions, indices)
            self._scene = scene.build(threads=self._threads)
        return self._scene


def _of_hits(hits: Hits) -> Answers:
    """What Open3D calls it; -1 becomes ``INVALID_ID``."""
    return {
        "t_hit": hits.t,
        "geometry_ids": hits.geometry_id.astype(np.uint32),
        "primitive_ids": hits.primitive_id.astype(np.uint32),
        "primitive_uvs": np.stack([hits.u, hits.v], axis=-1),
    }


def _whole(numbers: NDArray[np.int64]) -> NDArray[Any]:
    """As Open3D has them, of 32 bits, unless that is too few."""
    is_small = numbers.max(initial=0) <= np.iinfo(np.uint32).max
    return numbers.astype(np.uint32) if is_small else numbers


def _rays(rays: Any) -> FloatArray:
    return vectors("rays", _numpy(rays), 6)


def _numpy(values: Any) -> ArrayLike:
    """An Open3D tensor as an array, which shares its memory; all else as it is."""
    is_tensor = hasattr(values, "numpy") and not isinstance(values, np.ndarray)
    array: ArrayLike = values.numpy() if is_tensor else values
    return array


def _threads(nthreads: int) -> Optional[int]:
    """Open3D's number of threads, of which 0 leaves the choice."""
    threads = whole("nthreads", nthreads)
    if threads < 0:
        raise ArgumentError(f"nthreads: give 0 or more, not {threads}")
    return threads or None


def _check_samples(nsamples: int) -> None:
    samples = whole("nsamples", nsamples)
    if samples < 1 or samples % 2 == 0:
        raise ArgumentError(f"nsamples: give an odd number above zero, not {samples}")
