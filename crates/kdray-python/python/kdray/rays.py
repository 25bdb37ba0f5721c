"""Rays as callers give them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray, broadcast, common_shape, floats, vectors
from .errors import ArgumentError

RayArrays = tuple[FloatArray, FloatArray, FloatArray, FloatArray]
"""Origins, directions, and the bounds of t: what the compiled part takes."""


@dataclass(frozen=True)
class Rays:
    """Rays of one shape. Nothing is copied but what is no array of f32 or f64."""

    arrays: RayArrays
    """Of shape (..., 3), (..., 3), (..., 1) and (..., 1), with the same shape before the last."""

    shape: tuple[int, ...]
    """What they have in common before the last dimension, and so do the answers."""

    is_double: bool
    """Whether answers are f64: unless origins and directions are both f32."""

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
            rays = vectors("rays", origins, 6)
            first, second = rays[..., :3], rays[..., 3:]
        else:
            first, second = vectors("origins", origins), vectors("directions", directions)
        bounds = {"t_min": floats("t_min", t_min), "t_max": floats("t_max", t_max)}
        arguments = {"origins": first, "directions": second}
        arguments |= {name: bound[..., np.newaxis] for name, bound in bounds.items()}
        shape = common_shape(arguments)
        a, b, c, d = (broadcast(shape, array) for array in arguments.values())
        is_double = not first.dtype == second.dtype == np.float32
        return cls((a, b, c, d), shape, is_double)


def is_lenient(invalid: str) -> bool:
    """What becomes of rays and points that are not finite: whether they are nowhere, instead of an error."""
    if invalid not in ("raise", "miss"):
        raise ArgumentError(f'invalid: give "raise" or "miss", not {invalid!r}')
    return invalid == "miss"
