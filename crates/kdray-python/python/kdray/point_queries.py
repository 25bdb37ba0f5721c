"""What a scene answers about points."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, Literal, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _kdray
from .arrays import FloatArray, broadcast, common_shape, vectors
from .closest_points import ClosestPoints
from .errors import renamed
from .hits import Hits
from .progress import Progress, telling
from .rays import is_lenient
from .whole import whole_or_none
from .word import word

if TYPE_CHECKING:
    from ._kdray import Tree


class PointQueries:
    """Queries about points. All take arrays (..., 3), and answer in the shape (...), or with more behind it.

    A point that is not finite is an error, or with ``invalid="miss"`` nowhere: not inside, infinitely far, its
    signed distance and winding number NaN.
    Answers are f32 if the points are, else f64. ``threads`` and ``progress`` are those of ``RayQueries``.
    Scenes with instances do not answer.
    """

    @abstractmethod
    def _built(self, threads: Optional[int] = None) -> Tree:
        """The tree, which is built on so many threads if need be."""

    def contains(
        self,
        points: ArrayLike,
        *,
        invalid: Literal["raise", "miss"] = "raise",
        threads: Optional[int] = None,
        progress: Progress = None,
    ) -> NDArray[np.bool_]:
        """Whether each point is inside the mesh or on its surface.

        Exact in a closed mesh, whichever way its triangles face; a closed part within another is a hollow. In an
        open mesh, whose triangles must face outward, a point is inside if the mesh winds half around it.
        """
        array = vectors("points", points)
        with telling(progress, "point") as told:
            inside = _kdray.contains(
                self._built(threads),
                array,
                lenient=is_lenient(invalid),
                threads=whole_or_none("threads", threads),
                progress=told,
            )
        return inside.reshape(array.shape[:-1])

    def closest_point(
        self,
        points: ArrayLike,
        *,
        invalid: Literal["raise", "miss"] = "raise",
        threads: Optional[int] = None,
        progress: Progress = None,
    ) -> ClosestPoints:
        """The point of the mesh that is nearest to each point."""
        array = vectors("points", points)
        with telling(progress, "point") as told:
            tree = self._built(threads)
            count = whole_or_none("threads", threads)
            nearest = _kdray.closest_point(
                tree,
                array,
                is_double=array.dtype != np.float32,
                lenient=is_lenient(invalid),
                threads=count,
                progress=told,
            )
        return ClosestPoints(tree, nearest, array.shape[:-1], count)

    def signed_distance(
        self,
        points: ArrayLike,
        *,
        invalid: Literal["raise", "miss"] = "raise",
        threads: Optional[int] = None,
        progress: Progress = None,
    ) -> FloatArray:
        """How far each point is from the mesh: negative inside, positive outside, zero on the surface.

        trimesh has the signs the other way round. NaN for a scene without triangles.
        """
        array = vectors("points", points)
        with telling(progress, "point") as told:
            distances = _kdray.signed_distance(
                self._built(threads),
                array,
                is_double=array.dtype != np.float32,
                lenient=is_lenient(invalid),
                threads=whole_or_none("threads", threads),
                progress=told,
            )
        return distances.reshape(array.shape[:-1])

    def winding_number(
        self,
        points: ArrayLike,
        *,
        invalid: Literal["raise", "miss"] = "raise",
        threads: Optional[int] = None,
        progress: Progress = None,
    ) -> FloatArray:
        """How often the mesh winds around each point: 1 inside a closed mesh that faces outward, 0 outside.

        Exact in closed and oriented meshes; in others to some thousandths.
        """
        array = vectors("points", points)
        with telling(progress, "point") as told:
            numbers = _kdray.winding_number(
                self._built(threads),
                array,
                is_double=array.dtype != np.float32,
                lenient=is_lenient(invalid),
                threads=whole_or_none("threads", threads),
                progress=told,
            )
        return numbers.reshape(array.shape[:-1])

    def thickness(
        self,
        at: Union[ArrayLike, Hits, ClosestPoints],
        *,
        side: Literal["front", "back"] = "front",
        invalid: Literal["raise", "miss"] = "raise",
        threads: Optional[int] = None,
        progress: Progress = None,
    ) -> FloatArray:
        """How far it is from places on the mesh, straight through the material, to the next surface.

        The places are hits or nearest points of this scene, or points (..., 3), which stand for the nearest points
        of the mesh. ``side`` is the one that is seen from outside; the way leads off the other, at a right angle.
        NaN where no surface is on the way, or nothing was hit.
        """
        is_lenient(invalid)
        if not isinstance(at, (Hits, ClosestPoints)):
            with renamed({"points": "at"}):
                at = self.closest_point(at, invalid=invalid, threads=threads)
        number = at.t if isinstance(at, Hits) else at.distance
        ids = [np.ascontiguousarray(each).reshape(-1) for each in (at.primitive_id, at.geometry_id)]
        weights = [np.ascontiguousarray(w, dtype=np.float64).reshape(-1) for w in (at.u, at.v)]
        with telling(progress, "point") as told:
            lengths = _kdray.thickness(
                self._built(threads),
                ids[0],
                ids[1],
                weights[0],
                weights[1],
                side=word("side", side),
                is_double=number.dtype != np.float32,
                threads=whole_or_none("threads", threads),
                progress=told,
            )
        return lengths.reshape(number.shape)

    def visible(
        self,
        a: ArrayLike,
        b: ArrayLike,
        *,
        invalid: Literal["raise", "miss"] = "raise",
        threads: Optional[int] = None,
        progress: Progress = None,
    ) -> NDArray[np.bool_]:
        """Whether nothing is strictly between two points (..., 3), which are broadcast to each other.

        A surface that one of them lies on is not in the way.
        """
        first, second = vectors("a", a), vectors("b", b)
        shape = common_shape({"a": first, "b": second})
        with telling(progress, "pair") as told:
            seen = _kdray.visible(
                self._built(threads),
                broadcast(shape, first),
                broadcast(shape, second),
                lenient=is_lenient(invalid),
                threads=whole_or_none("threads", threads),
                progress=told,
            )
        return seen.reshape(shape)
