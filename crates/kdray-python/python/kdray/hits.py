"""What rays hit."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray

if TYPE_CHECKING:
    from ._kdray import Tree, _HitArrays


class Hits:
    """Hits, as arrays of one shape: for ``closest_hit`` that of the rays.

    Where a ray hits nothing, ``t`` is infinite, the ids are -1, and ``u`` and ``v`` are zero.
    """

    t: FloatArray
    """Where along the ray, in lengths of its direction: the hit is at ``origin + t * direction``."""

    u: FloatArray
    """The weight of the triangle's second vertex b: the hit is at (1-u-v) a + u b + v c."""

    v: FloatArray
    """The weight of its third vertex c."""

    primitive_id: NDArray[np.int32]
    """The index of the triangle in its geometry, or -1."""

    front: NDArray[np.bool_]
    """Whether the front was hit: the side from which the triangle's vertices run counter-clockwise."""

    def __init__(
        self,
        tree: Optional[Tree],
        arrays: _HitArrays,
        shape: tuple[int, ...],
        threads: Optional[int],
    ) -> None:
        t, u, v, primitive_id, front, geometry_id, instance_id = arrays
        self.t, self.u, self.v = t.reshape(shape), u.reshape(shape), v.reshape(shape)
        self.primitive_id, self.front = primitive_id.reshape(shape), front.reshape(shape)
        self._geometry_id, self._instance_id = geometry_id, instance_id
        # What was a pickle has none; its normals and positions are there.
        self._tree: Any = tree
        # Those of the query, on which normals and positions are computed.
        self._threads = threads

    @property
    def shape(self) -> tuple[int, ...]:
        """That of all arrays."""
        return self.t.shape

    @property
    def hit(self) -> NDArray[np.bool_]:
        """Whether there is a hit."""
        return self.primitive_id >= 0

    @cached_property
    def geometry_id(self) -> NDArray[np.int32]:
        """The geometry, as numbered by ``Scene.add_triangles``, or -1."""
        if self._geometry_id is None:
            return np.where(self.hit, np.int32(0), np.int32(-1))
        return self._geometry_id.reshape(self.shape)

    @cached_property
    def instance_id(self) -> NDArray[np.int32]:
        """The instance, as numbered by ``Scene.add_instance``, or -1 where no instance was hit."""
        if self._instance_id is None:
            return np.full(self.shape, -1, dtype=np.int32)
        return self._instance_id.reshape(self.shape)

    @cached_property
    def normal(self) -> FloatArray:
        """The triangles' unit normals (..., 3), which point to the front; NaN where nothing was hit."""
        return self._of_triangles(self._tree.normals(*self._ids(), threads=self._threads))

    @cached_property
    def position(self) -> FloatArray:
        """The points that were hit (..., 3), on the triangles, by u and v; NaN where nothing was hit."""
        weights = [np.ascontiguousarray(w, dtype=np.float64).reshape(-1) for w in (self.u, self.v)]
        positions = self._tree.positions(*self._ids(), *weights, threads=self._threads)
        return self._of_triangles(positions)

    def __getitem__(self, index: Any) -> Hits:
        """The hits at some places, by what arrays are indexed with."""
        def flat(array: Optional[NDArray[Any]]) -> Any:
            return None if array is None else np.asarray(array.reshape(self.shape)[index])

        arrays = (self.t, self.u, self.v, self.primitive_id, self.front)
        chosen: Any = [flat(array) for array in (*arrays, self._geometry_id, self._instance_id)]
        hits = Hits(self._tree, chosen, chosen[0].shape, self._threads)
        if self._tree is None:
            places = np.arange(self.t.size).reshape(self.shape)[index]
            hits.normal = self.normal.reshape(-1, 3)[places]
            hits.position = self.position.reshape(-1, 3)[places]
        return hits

    def __getstate__(self) -> dict[str, Any]:
        """All but the tree, and so with what only the tree can tell."""
        return {**self.__dict__, "normal": self.normal, "position": self.position, "_tree": None}

    def __copy__(self) -> Hits:
        """Another of the same arrays, and the same tree."""
        twin = object.__new__(type(self))
        twin.__dict__.update(self.__dict__)
        return twin

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        found = int(np.count_nonzero(self.hit))
        return f"<{type(self).__name__}: {found} of {self.t.size}, shape {self.shape}, {self.t.dtype}>"

    def _ids(self) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.int32]]:
        """Of triangles, geometries and instances, as flat arrays."""
        ids = (self.primitive_id, self.geometry_id, self.instance_id)
        a, b, c = (np.ascontiguousarray(each).reshape(-1) for each in ids)
        return a, b, c

    def _of_triangles(self, vectors: NDArray[np.float64]) -> FloatArray:
        of_shape: FloatArray = vectors.reshape((*self.shape, 3))
        return of_shape.astype(self.t.dtype, copy=False)


class AllHits(Hits):
    """All hits of many rays, in flat arrays: those of the first ray, by rising t, then those of the next.

    The hits of ray ``i`` are at ``offsets[i]:offsets[i + 1]``; rays are numbered in the order of C.
    """

    offsets: NDArray[np.int64]
    """Where the hits of each ray begin; behind that, where the last end."""

    def __init__(
        self,
        tree: Tree,
        arrays: _HitArrays,
        offsets: NDArray[np.int64],
        shape: tuple[int, ...],
        threads: Optional[int],
    ) -> None:
        super().__init__(tree, arrays, arrays[0].shape, threads)
        self.offsets, self._shape_of_rays = offsets, shape

    @cached_property
    def counts(self) -> NDArray[np.int64]:
        """How many hits each ray has, in the shape of the rays."""
        counts: NDArray[np.int64] = np.diff(self.offsets).reshape(self._shape_of_rays)
        return counts

    @cached_property
    def ray_id(self) -> NDArray[np.int64]:
        """The ray of each hit."""
        rays = np.arange(self.counts.size, dtype=np.int64)
        return np.repeat(rays, self.counts.reshape(-1))
