"""Rays as callers give them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray, broadcast, common_shape, floats, vectors
from .errors import ArgumentError

RayArrays = tuple[FloatArray, Optional[FloatArray], FloatArray, FloatArray]
"""Origins and directions, or rays of six numbers alone, and the bounds of t: what the compiled part takes."""


@dataclass(frozen=True)
class Rays:
    """Rays of one shape. Nothing is copied but what is no array of f32 or f64."""

    arrays: RayArrays
    """Of shape (..., 3) twice, or (..., 6) and none, and (..., 1) twice, with the same shape before the last."""

    shape: tuple[int, ...]
    """What they have in common before the last dimension, and so do the answers."""

    is_double: bool
    """Whether answers are f64: unless all of origins and directions is f32."""

    @classmethod
    def of(
        cls,
        origins: ArrayLike,
        directions: Optional[ArrayLike],
        t_min: ArrayLike,
        t_max: ArrayLike,
    ) -> Rays:
        """Rays of one array (..., 6), or of origins and directions (..., 3); with bounds of t (...)."""
        if directions is None:
            lines = {"rays": vectors("rays", origins, 6, ", or give directions as well")}
        else:
            lines = {"origins": vectors("origins", origins), "directions": vectors("directions", directions)}
        bounds = {"t_min": floats("t_min", t_min), "t_max": floats("t_max", t_max)}
        arguments = lines | {name: bound[..., np.newaxis] for name, bound in bounds.items()}
        shape = common_shape(arguments)
        first, *second, low, high = (broadcast(shape, array) for array in arguments.values())
        is_double = not all(array.dtype == np.float32 for array in lines.values())
        return cls((first, second[0] if second else None, low, high), shape, is_double)


def is_lenient(invalid: str) -> bool:
    """What becomes of rays and points that are not finite: whether they are nowhere, instead of an error."""
    if invalid not in ("raise", "miss"):
        raise ArgumentError(f'invalid: give "raise" or "miss", not {invalid!r}')
    return invalid == "miss"
