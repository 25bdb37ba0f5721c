"""Exact ray queries on triangle meshes, by kd-trees.

>>> import kdray, numpy as np
>>> scene = kdray.Scene([[0, 0, 2], [1, 0, 2], [0, 1, 2]], [[0, 1, 2]])
>>> hits = scene.closest_hit([0.25, 0.25, 0], [0, 0, 1])
>>> float(hits.t), int(hits.primitive_id)
(2.0, 0)
"""

from .closest_points import ClosestPoints
from .errors import (
    ArgumentError,
    ArgumentTypeError,
    BuildError,
    FileError,
    InternalError,
    KdrayError,
    MissingFileError,
    SceneError,
    UnsupportedError,
)
from .hits import AllHits, Hits
from .picture import Picture
from .scene import Scene

__all__ = [
    "AllHits",
    "ArgumentError",
    "ArgumentTypeError",
    "BuildError",
    "ClosestPoints",
    "Hits",
    "FileError",
    "InternalError",
    "KdrayError",
    "MissingFileError",
    "Picture",
    "Scene",
    "SceneError",
    "UnsupportedError",
]
