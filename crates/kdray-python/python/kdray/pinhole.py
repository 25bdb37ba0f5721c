"""Rays of a pinhole camera, by the conventions of computer vision: x to the right, y down, z ahead."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .arrays import floats
from .errors import ArgumentError
from .whole import whole


def rays_of_matrices(
    intrinsic_matrix: Any, extrinsic_matrix: Any, width_px: int, height_px: int
) -> NDArray[np.float32]:
    """Rays (height_px, width_px, 6) through the middles of the pixels, the upper row first.

    ``intrinsic_matrix`` (3, 3) takes points before the camera to pixels, ``extrinsic_matrix`` (4, 4) the world
    before the camera, with a rotation. All directions have depth 1.
    """
    intrinsic = _matrix("intrinsic_matrix", intrinsic_matrix, (3, 3))
    extrinsic = _matrix("extrinsic_matrix", extrinsic_matrix, (4, 4))
    width, height = _pixels("width_px", width_px), _pixels("height_px", height_px)
    rotation, offset = extrinsic[:3, :3], extrinsic[:3, 3]
    try:
        # Of row vectors: p -> (K^-1 p) R, for R's inverse is its transpose.
        to_world = np.linalg.inv(intrinsic).T @ rotation
    except np.linalg.LinAlgError:
        raise ArgumentError("intrinsic_matrix: it has no inverse") from None
    rays = np.empty((height, width, 6), dtype=np.float32)
    rays[..., :3] = -rotation.T @ offset
    x, y = np.arange(width) + 0.5, np.arange(height)[:, np.newaxis] + 0.5
    for axis in range(3):
        rays[..., 3 + axis] = x * to_world[0, axis] + y * to_world[1, axis] + to_world[2, axis]
    return rays


def rays_of_field_of_view(
    fov_deg: float, center: Any, eye: Any, up: Any, width_px: int, height_px: int
) -> NDArray[np.float32]:
    """The same of a camera at ``eye`` that looks to ``center``, ``fov_deg`` degrees across.

    As Open3D has it, ``up`` is where rows go: the lowest row is the first, and the picture is turned by 180
    degrees. ``rays[::-1, ::-1]`` stands upright.
    """
    angle = float(_matrix("fov_deg", fov_deg, ()))
    if not 0 < angle < 180:
        raise ArgumentError(f"fov_deg: give an angle above 0 and below 180 degrees, not {angle:g}")
    width, height = _pixels("width_px", width_px), _pixels("height_px", height_px)
    ahead = _unit("center", _matrix("center", center, (3,)) - _matrix("eye", eye, (3,)))
    across = _unit("up", np.cross(_matrix("up", up, (3,)), ahead))
    rotation = np.stack([across, np.cross(ahead, across), ahead])
    extrinsic = np.eye(4)
    extrinsic[:3, :3], extrinsic[:3, 3] = rotation, -rotation @ _matrix("eye", eye, (3,))
    focal = 0.5 * width / np.tan(np.radians(0.5 * angle))
    intrinsic = np.array([[focal, 0, 0.5 * width], [0, focal, 0.5 * height], [0, 0, 1]])
    return rays_of_matrices(intrinsic, extrinsic, width, height)


def _matrix(name: str, values: Any, shape: tuple[int, ...]) -> NDArray[np.float64]:
    is_tensor = hasattr(values, "numpy") and not isinstance(values, np.ndarray)
    array = floats(name, values.numpy() if is_tensor else values).astype(np.float64, copy=False)
    if array.shape != shape:
        raise ArgumentError(f"{name}: give an array of shape {shape}, not {array.shape}")
    if not np.isfinite(array).all():
        raise ArgumentError(f"{name}: give finite numbers")
    return array


def _pixels(name: str, count: int) -> int:
    pixels = whole(name, count)
    if pixels < 1:
        raise ArgumentError(f"{name}: give 1 or more, not {pixels}")
    return pixels


def _unit(name: str, vector: NDArray[np.float64]) -> NDArray[np.float64]:
    length = float(np.linalg.norm(vector))
    if length == 0.0:
        raise ArgumentError(f"{name}: with it, the camera has no direction")
    unit: NDArray[np.float64] = vector / length
    return unit
