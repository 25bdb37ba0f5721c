"""Exact ray queries on triangle meshes, by kd-trees.

>>> import kdray, numpy as np
>>> scene = kdray.Scene([[0, 0, 2], [1, 0, 2], [0, 1, 2]], [[0, 1, 2]])
>>> hits = scene.closest_hit([0.25, 0.25, 0], [0, 0, 1])
>>> float(hits.t), int(hits.primitive_id)
(2.0, 0)
"""

from typing import TYPE_CHECKING

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

if TYPE_CHECKING:
    from . import dask as dask
    from . import open3d as open3d
    from . import trimesh as trimesh
else:
    _MODULES = ("dask", "open3d", "trimesh")

    def __getattr__(name):
        """Modules that not everybody needs, imported where they are first named."""
        from importlib import import_module

        missing = f"module {__name__!r} has no attribute {name!r}"
        if name not in _MODULES:
            raise AttributeError(missing)
        try:
            return import_module(f"{__name__}.{name}")
        except ModuleNotFoundError as error:
            raise AttributeError(f"{missing}, for what it needs is not there: {error}") from error

    def __dir__():
        return sorted({*globals(), *_MODULES})


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
