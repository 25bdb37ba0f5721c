"""What a scene answers about rays."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, Literal, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ArgumentError
from .hits import AllHits, Hits
from .progress import Progress, telling
from .rays import Rays, is_lenient
from .whole import ALL, mask_bits, whole_or_none

if TYPE_CHECKING:
    from ._kdray import Tree


class RayQueries:
    """Queries about rays. All take the same arguments:

    ``origins`` and ``directions``
        Arrays of shape (..., 3), which are broadcast to each other; or one array of rays (..., 6), as
        ``origins`` alone. A direction may have any length but zero. f32 and f64 are read where they lie,
        whatever their strides; other numbers become f64. They must not be changed during the call.
    ``t_min``, ``t_max``
        Which part of the ray counts, both ends included, in lengths of its direction: numbers, or arrays (...).
    ``mask``
        In a scene with instances: which of them are seen, namely those whose mask shares a bit with it.
    ``invalid``
        What becomes of a ray with a NaN, an infinite coordinate or a zero direction: ``"raise"``, or
        ``"miss"``: it hits nothing.
    ``threads``
        On how many threads; without it by the environment variables ``KDRAY_THREADS``, else
        ``RAYON_NUM_THREADS``, or as many as there are processors. The answers are the same.
    ``progress``
        ``True`` for a bar by tqdm, or a function of what is done and of all.

    Answers are f32 if origins and directions are, else f64, and have the shape of the rays. They are exact
    but for the rounding of what is reported, whichever it is. Other Python threads run meanwhile, and Ctrl-C
    ends a call.
    """

    @abstractmethod
    def _built(self, threads: Optional[int] = None) -> Tree:
        """The tree, which is built on so many threads if need be."""

    def closest_hit(
        self,
        origins: ArrayLike,
        directions: Optional[ArrayLike] = None,
        *,
        t_min: ArrayLike = 0.0,
        t_max: ArrayLike = np.inf,
        mask: int = ALL,
        invalid: Literal["raise", "miss"] = "raise",
        threads: Optional[int] = None,
        progress: Progress = None,
    ) -> Hits:
        """The hit of least t of each ray; of several at the same t, the one of the smallest triangle.

        What a ray touches counts, edges and vertices, too.
        """
        rays, lenient = Rays.of(origins, directions, t_min, t_max), is_lenient(invalid)
        with telling(progress, "ray") as told:
            tree = self._built(threads)
            count = whole_or_none("threads", threads)
            arrays = tree.closest_hit(
                rays.arrays,
                is_double=rays.is_double,
                lenient=lenient,
                mask=mask_bits(mask),
                threads=count,
                progress=told,
            )
        return Hits(tree, arrays, rays.shape, count)

    def any_hit(
        self,
        origins: ArrayLike,
        directions: Optional[ArrayLike] = None,
        *,
        t_min: ArrayLike = 0.0,
        t_max: ArrayLike = np.inf,
        mask: int = ALL,
        invalid: Literal["raise", "miss"] = "raise",
        threads: Optional[int] = None,
        progress: Progress = None,
    ) -> NDArray[np.bool_]:
        """Whether each ray hits anything: whether it is occluded. Faster than ``closest_hit``.

        What a ray touches counts, so that there may be a hit where ``count`` is 0.
        """
        rays, lenient = Rays.of(origins, directions, t_min, t_max), is_lenient(invalid)
        with telling(progress, "ray") as told:
            found = self._built(threads).any_hit(
                rays.arrays,
                lenient=lenient,
                mask=mask_bits(mask),
                threads=whole_or_none("threads", threads),
                progress=told,
            )
        return found.reshape(rays.shape)

    def all_hits(
        self,
        origins: ArrayLike,
        directions: Optional[ArrayLike] = None,
        *,
        t_min: ArrayLike = 0.0,
        t_max: ArrayLike = np.inf,
        limit: Optional[int] = None,
        mask: int = ALL,
        invalid: Literal["raise", "miss"] = "raise",
        threads: Optional[int] = None,
        progress: Progress = None,
    ) -> AllHits:
        """Every crossing of a surface, once, by rising t: at an edge that triangles share, one of them.

        ``limit`` is the most that are kept of each ray: its first. It saves memory, not time.
        """
        rays, lenient = Rays.of(origins, directions, t_min, t_max), is_lenient(invalid)
        most = whole_or_none("limit", limit)
        if most is not None and most < 0:
            raise ArgumentError("limit: give a whole number that is not negative")
        with telling(progress, "ray") as told:
            tree = self._built(threads)
            count = whole_or_none("threads", threads)
            offsets, arrays = tree.all_hits(
                rays.arrays,
                is_double=rays.is_double,
                limit=most,
                lenient=lenient,
                mask=mask_bits(mask),
                threads=count,
                progress=told,
            )
        return AllHits(tree, arrays, offsets, rays.shape, count)

    def count(
        self,
        origins: ArrayLike,
        directions: Optional[ArrayLike] = None,
        *,
        t_min: ArrayLike = 0.0,
        t_max: ArrayLike = np.inf,
        mask: int = ALL,
        invalid: Literal["raise", "miss"] = "raise",
        threads: Optional[int] = None,
        progress: Progress = None,
    ) -> NDArray[np.int32]:
        """How many surfaces each ray crosses: the number of ``all_hits``.

        On a closed mesh it is even for a ray from outside without end, and odd for one from inside.
        """
        rays, lenient = Rays.of(origins, directions, t_min, t_max), is_lenient(invalid)
        with telling(progress, "ray") as told:
            counts = self._built(threads).count(
                rays.arrays,
                lenient=lenient,
                mask=mask_bits(mask),
                threads=whole_or_none("threads", threads),
                progress=told,
            )
        return counts.reshape(rays.shape)
