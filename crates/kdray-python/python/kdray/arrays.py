"""What callers give, as arrays of f32 or f64 that can be read where they lie."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import ArgumentError, ArgumentTypeError

FloatArray = NDArray[np.floating[Any]]
"""An array of f32 or f64."""

MOST_DIMENSIONS = 31
"""The compiled part reads arrays of 32, of which bounds of t get one here."""


def floats(name: str, values: ArrayLike) -> FloatArray:
    """Any numbers as an array of f32 or f64, without a copy if they are one.

    f32 and f64 stay what they are, whatever their strides; all other numbers become f64. ``name`` is what
    the caller calls them.
    """
    array = _array(name, values)
    if array.ndim > MOST_DIMENSIONS:
        raise ArgumentError(f"{name}: give an array of at most {MOST_DIMENSIONS} dimensions, not {array.ndim}")
    if array.dtype.kind not in "fiub":
        raise ArgumentTypeError(f"{name}: give real numbers, not an array of {array.dtype}")
    if array.dtype.newbyteorder("=") not in (np.float32, np.float64):
        return array.astype(np.float64)
    if not (array.flags.aligned and array.dtype.isnative):
        return np.array(array, dtype=array.dtype.newbyteorder("="))
    return array


def vectors(name: str, values: ArrayLike, width: int = 3, others: str = "") -> FloatArray:
    """The same of vectors: an array of shape (..., width). ``others`` is what else the caller may give."""
    array = floats(name, values)
    if array.ndim == 0 or array.shape[-1] != width:
        raise ArgumentError(f"{name}: give an array of shape (..., {width}), not {array.shape}{others}")
    return array


def is_single(values: Any) -> bool:
    """Whether this is one number, and no array."""
    try:
        return np.ndim(values) == 0
    except ValueError:
        return False


def face_indices(values: ArrayLike) -> NDArray[np.uint32]:
    """Three indices of vertices a triangle, as a contiguous array of uint32."""
    array = _array("faces", values)
    if array.size == 0 and array.ndim < 2:
        return np.zeros((0, 3), dtype=np.uint32)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ArgumentError(f"faces: give an array of shape (m, 3), not {array.shape}")
    if array.dtype.kind not in "iu":
        raise ArgumentTypeError(f"faces: give whole numbers, not an array of {array.dtype}")
    for limit in (array.min(initial=0), array.max(initial=0)):
        if not 0 <= int(limit) < 1 << 32:
            face = int(np.argwhere(array == limit)[0][0])
            raise ArgumentError(f"faces: face {face} names vertex {limit}, which cannot be there")
    return np.ascontiguousarray(array, dtype=np.uint32)


def broadcast(shape: tuple[int, ...], array: FloatArray) -> FloatArray:
    """The same vectors for all of ``shape``, without a copy."""
    wanted = (*shape, array.shape[-1])
    return array if array.shape == wanted else np.broadcast_to(array, wanted)


def common_shape(arguments: dict[str, FloatArray]) -> tuple[int, ...]:
    """The shape that vectors have in common, but for their last dimension."""
    try:
        return np.broadcast_shapes(*(array.shape[:-1] for array in arguments.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape[:-1]}" for name, array in arguments.items())
        text = f"{', '.join(arguments)}: the shapes do not fit each other: {shapes}"
        raise ArgumentError(text) from None


def _array(name: str, values: ArrayLike) -> NDArray[Any]:
    try:
        array = np.asarray(values)
    except (TypeError, ValueError) as error:
        raise ArgumentTypeError(f"{name}: this is no array of numbers: {error}") from error
    if array.dtype == object:
        raise ArgumentTypeError(f"{name}: this is no array of numbers: {type(values).__name__}")
    return array
