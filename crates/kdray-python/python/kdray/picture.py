"""Rendered pictures."""

from __future__ import annotations

import os
from typing import Any, Optional

import numpy as np
from numpy.typing import NDArray

from . import _kdray
from .errors import ArgumentError
from .saved import path_of


class Picture(np.ndarray[Any, np.dtype[np.uint8]]):
    """A picture as an array (height, width, 3) of uint8, as a PNG shows it: shading in sRGB, costs by colours.

    The numbers behind it are in ``layers``. Notebooks show it. Parts of it, and what is computed from it, have none
    of that. It is read-only, for what is saved is what was rendered; a copy can be changed.
    """

    _made: Optional[_kdray.Picture]

    @classmethod
    def of(cls, made: _kdray.Picture) -> Picture:
        """What was rendered, as an array."""
        picture = np.ascontiguousarray(made.rgba[..., :3]).view(cls)
        picture._made = made
        picture.flags.writeable = False
        return picture

    def __array_finalize__(self, _: Any) -> None:
        """What is made of a picture is none."""
        self._made = None

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        """What is computed from a picture is a plain array, or a number."""
        plain = np.asarray(array)
        return plain[()] if plain.ndim == 0 else plain

    @property
    def layers(self) -> dict[str, NDArray[Any]]:
        """The numbers, each an array (height, width): linear light as ``color.R``, ``.G``, ``.B`` and ``.A``;
        ``depth.Z``, ``normal.X``, ``primitive.id``, ``occlusion.V``, ``cost.nodes``, ``cost.primitives`` and so on,
        as far as they were rendered.
        """
        return self._whole().channels

    def save(self, path: str | os.PathLike[str], *, bits: int = 8) -> None:
        """Writes a PNG of 8 or 16 bits a channel, or all layers as OpenEXR, by the ending of ``path``.

        It takes the place of an older file when it is whole, for which the folder must be one that may be written to.
        """
        text = path_of("path", path)
        ending = os.path.splitext(text)[1].lower()
        if bits not in (8, 16):
            raise ArgumentError(f"bits: give 8 or 16, not {bits!r}")
        if ending == ".png":
            content = self._whole().png(bits)
        elif ending == ".exr":
            content = self._whole().exr()
        else:
            raise ArgumentError(f"path: {text}: give a name that ends in .png or .exr")
        _kdray.write_file(text, content)

    def _repr_png_(self) -> Optional[bytes]:
        """What notebooks show."""
        return None if self._made is None else self._made.png(8)

    def _whole(self) -> _kdray.Picture:
        if self._made is None:
            raise ArgumentError("picture: this is a part of a picture, or computed from one; take the whole")
        return self._made
