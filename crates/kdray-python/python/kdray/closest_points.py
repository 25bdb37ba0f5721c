"""The nearest points of a surface."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray

if TYPE_CHECKING:
    from ._kdray import Tree, _NearestArrays


class ClosestPoints:
    """The nearest points of a scene to some points, as arrays of their shape.

    In a scene without triangles ``point`` is NaN, ``distance`` infinite, and the ids are -1.
    """

    point: FloatArray
    """The nearest point (..., 3)."""

    distance: FloatArray
    """How far it is; zero exactly on the surface."""

    u: FloatArray
    """The weight of the triangle's second vertex b: the point is (1-u-v) a + u b + v c."""

    v: FloatArray
    """The weight of its third vertex c."""

    primitive_id: NDArray[np.int32]
    """The index of the triangle in its geometry; of several that are as near, the first."""

    geometry_id: NDArray[np.int32]
    """The geometry, as numbered by ``Scene.add_triangles``."""

    def __init__(
        self,
        tree: Tree,
        arrays: _NearestArrays,
        shape: tuple[int, ...],
        threads: Optional[int],
    ) -> None:
        point, distance, u, v, primitive_id, geometry_id = arrays
        self.point, self.distance = point.reshape((*shape, 3)), distance.reshape(shape)
        self.u, self.v = u.reshape(shape), v.reshape(shape)
        self.primitive_id = primitive_id.reshape(shape)
        self.geometry_id = geometry_id.reshape(shape)
        # What was a pickle has none; its normals are there.
        self._tree: Any = tree
        # Those of the query, on which normals are computed.
        self._threads = threads

    @property
    def shape(self) -> tuple[int, ...]:
        """That of the points."""
        return self.distance.shape

    @cached_property
    def normal(self) -> FloatArray:
        """The triangles' unit normals (..., 3), which point to the front."""
        flat = (self.primitive_id.reshape(-1), self.geometry_id.reshape(-1))
        none = np.full(flat[0].shape, -1, dtype=np.int32)
        found = self._tree.normals(*flat, none, threads=self._threads)
        normals: FloatArray = found.reshape((*self.shape, 3))
        return normals.astype(self.distance.dtype, copy=False)

    def __getstate__(self) -> dict[str, Any]:
        """All but the tree, and so with what only the tree can tell."""
        return {**self.__dict__, "normal": self.normal, "_tree": None}

    def __copy__(self) -> ClosestPoints:
        """Another of the same arrays, and the same tree."""
        twin = object.__new__(type(self))
        twin.__dict__.update(self.__dict__)
        return twin

    def __len__(self) -> int:
        return len(self.distance)

    def __repr__(self) -> str:
        return f"<ClosestPoints: shape {self.shape}, {self.distance.dtype}>"
