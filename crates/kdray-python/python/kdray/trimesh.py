"""Ray queries of ``trimesh`` meshes, under trimesh's own interface.

>>> import trimesh, kdray.trimesh                                       # doctest: +SKIP
>>> mesh.ray = kdray.trimesh.RayMeshIntersector(mesh)                   # doctest: +SKIP
>>> mesh.ray.intersects_first([[0, 0, -5]], [[0, 0, 1]])                # doctest: +SKIP

trimesh itself is not imported: whatever has ``vertices``, ``faces`` and a hash that changes with them will do.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arrays import floats, vectors
from .errors import ArgumentError, renamed
from .hits import Hits
from .scene import Scene
from .warning import warn

__all__ = ["RayMeshIntersector"]

Ids = NDArray[np.int64]
"""Indices of faces or of rays."""

MAX_HITS = 100
"""How many hits of each ray are kept, as by trimesh's own, unless told otherwise."""

ON_SURFACE = 2.0**-46
"""How far behind the surface an origin may be to lie on it, in units of the largest coordinate."""

Locations = NDArray[np.float64]
"""Points (m, 3)."""


@dataclass
class _Built:
    """A mesh as it was once."""

    version: int
    """The mesh's hash."""

    scene: Scene

    @cached_property
    def behind(self) -> float:
        """How far behind the surface an origin may be to lie on it."""
        bounds = self.scene.bounds
        return 0.0 if bounds is None else ON_SURFACE * float(np.abs(bounds).max())


class RayMeshIntersector:
    """What ``trimesh.ray.ray_pyembree.RayMeshIntersector`` is, with exact answers.

    Methods, arguments and shapes are its own. Those of ``ray_triangle`` are the same but for three things: it keeps all
    hits of a ray, and not the first ``max_hits`` (there is a warning where hits may be missing that you did not leave
    out); in the third place ``intersects_id`` takes ``return_locations``, so name what you give; and it ignores
    arguments that it does not know, where this one raises ``TypeError``. What differs from both:

    - Hits are decided on the mesh's own f64 vertices. No ray slips through an edge or a vertex; where a ray
      meets an edge, it crosses one of the two faces, and is counted once.
    - Hits come in order: by ray, and by rising distance along it.
    - ``contains_points`` is exact for watertight meshes, however near to the surface a point is; on the surface
      it is inside. Of others, it tells by the winding number.
    - A ray with a NaN or without a direction hits nothing.

    A ray that begins on the surface hits it there, even if rounding put its origin a little behind it: nearer
    than 2^-46 of the largest coordinate.

    The tree is built by the first query, and anew by the first after the mesh was changed.
    """

    def __init__(self, geometry: Any, scale_to_box: bool = True) -> None:
        """Queries about ``geometry``, a ``trimesh.Trimesh``.

        ``scale_to_box`` is there for those who give it. It changes nothing: answers do not depend on scale.
        """
        self.mesh = geometry
        self._scale_to_box = scale_to_box
        self._built: Optional[_Built] = None

    @property
    def scene(self) -> Scene:
        """The ``kdray.Scene`` of the mesh as it is now, for kdray's other queries."""
        return self._now().scene

    def _now(self) -> _Built:
        built, version = self._built, hash(self.mesh)
        if built is None or built.version != version:
            vertices = np.asarray(self.mesh.vertices, dtype=np.float64)
            built = self._built = _Built(version, Scene(vertices, np.asarray(self.mesh.faces)))
        return built

    def intersects_location(
        self,
        ray_origins: ArrayLike,
        ray_directions: ArrayLike,
        multiple_hits: bool = True,
        **kwargs: Any,
    ) -> tuple[Locations, Ids, Ids]:
        """Where rays hit the mesh: locations (m, 3), index_ray (m,), index_tri (m,).

        Takes what ``intersects_id`` takes.
        """
        kwargs["return_locations"] = True
        found = self.intersects_id(ray_origins, ray_directions, multiple_hits, **kwargs)
        index_tri, index_ray, locations = found  # type: ignore[misc]
        return locations, index_ray, index_tri

    def intersects_id(
        self,
        ray_origins: ArrayLike,
        ray_directions: ArrayLike,
        multiple_hits: bool = True,
        max_hits: Optional[int] = None,
        return_locations: bool = False,
    ) -> Union[tuple[Ids, Ids], tuple[Ids, Ids, Locations]]:
        """Which faces rays (n, 3) hit: index_tri (m,), index_ray (m,), and the locations (m, 3) if asked for.

        With ``multiple_hits`` all, but not more than the first ``max_hits`` of each ray; else the first. Without
        ``max_hits`` they are 100, with a warning where a ray has as many.
        """
        built = self._now()
        rays, scene = _rays(built, ray_origins, ray_directions), built.scene
        hits: Hits
        if multiple_hits:
            with renamed({"limit": "max_hits"}):
                hits = every = scene.all_hits(**rays, limit=MAX_HITS if max_hits is None else max_hits)
            if max_hits is None and every.counts.max(initial=0) == MAX_HITS:
                warn(f"max_hits: a ray has {MAX_HITS} hits, and maybe more, which are left out; give max_hits")
            index_ray = every.ray_id
        else:
            closest = scene.closest_hit(**rays)
            index_ray = np.flatnonzero(closest.hit).astype(np.int64)
            hits = closest[index_ray]
        index_tri = hits.primitive_id.astype(np.int64)
        if return_locations:
            return index_tri, index_ray, hits.position.astype(np.float64, copy=False)
        return index_tri, index_ray

    def intersects_first(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> Ids:
        """The first face that each ray hits (n,), or -1."""
        built = self._now()
        hits = built.scene.closest_hit(**_rays(built, ray_origins, ray_directions))
        return hits.primitive_id.astype(np.int64)

    def intersects_any(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> NDArray[np.bool_]:
        """Whether each ray hits anything (n,)."""
        built = self._now()
        return built.scene.any_hit(**_rays(built, ray_origins, ray_directions))

    def contains_points(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Whether each of the points (n, 3) is inside the mesh, or on its surface."""
        return self.scene.contains(_rows("points", points), invalid="miss")

    def __getstate__(self) -> dict[str, Any]:
        """All but the tree, which the copy builds for itself."""
        return {**self.__dict__, "_built": None}

    def __copy__(self, *_: Any) -> RayMeshIntersector:
        return RayMeshIntersector(geometry=self.mesh, scale_to_box=self._scale_to_box)

    def __deepcopy__(self, *_: Any) -> RayMeshIntersector:
        return self.__copy__()


def _rays(built: _Built, ray_origins: ArrayLike, ray_directions: ArrayLike) -> dict[str, Any]:
    """The rays in f64, which is what trimesh answers in, as arguments of queries."""
    origins = _rows("ray_origins", ray_origins)
    directions = _rows("ray_directions", ray_directions)
    if origins.shape != directions.shape:
        text = f"there are {len(origins)} origins and {len(directions)} directions; give as many of each"
        raise ArgumentError(f"ray_origins, ray_directions: {text}")
    # Faster than numpy.linalg.norm, and the same but for the order of a sum.
    lengths = np.sqrt(np.einsum("ij,ij->i", directions, directions))
    t_min = np.divide(-built.behind, lengths, out=np.zeros_like(lengths), where=lengths > 0.0)
    return {"origins": origins, "directions": directions, "t_min": t_min, "invalid": "miss"}


def _rows(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Vectors (n, 3) as f64; no vectors, of any shape, are (0, 3)."""
    numbers = floats(name, values)
    if numbers.size == 0:
        return np.zeros((0, 3))
    rows = vectors(name, numbers)
    if rows.ndim != 2:
        raise ArgumentError(f"{name}: give an array of shape (n, 3), not {rows.shape}")
    return rows.astype(np.float64, copy=False)
