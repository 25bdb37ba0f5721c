"""Pictures of scenes."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable
from threading import Lock
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _kdray
from .arrays import vectors
from .errors import ArgumentError, ArgumentTypeError
from .picture import Picture
from .progress import Progress, telling
from .whole import whole, whole_or_none


class Rendering:
    """A scene that can be seen."""

    _world: Optional[_kdray.World] = None
    # One for all scenes: it is held for a moment, when a scene is first rendered.
    _seeing = Lock()

    @abstractmethod
    def _built(self, threads: Optional[int] = None) -> _kdray.Tree:
        """The tree, which is built on so many threads if need be."""

    @abstractmethod
    def _look(self) -> Optional[_kdray.Look]:
        """What the file of the triangles says of their materials, and of lights and cameras."""

    def render(
        self,
        *,
        width: int = 960,
        height: int = 540,
        eye: Optional[ArrayLike] = None,
        look_at: Optional[ArrayLike] = None,
        up: Optional[ArrayLike] = None,
        fov: Optional[float] = None,
        camera: Union[str, int, None] = None,
        light: Optional[ArrayLike] = None,
        picture: str = "shaded",
        layers: bool = False,
        samples: int = 16,
        bounces: int = 8,
        light_samples: int = 2,
        seed: int = 0,
        packets: bool = True,
        background: Optional[ArrayLike] = None,
        ambient: Optional[ArrayLike] = None,
        ambient_rays: int = 1,
        occlusion_distance: Optional[float] = None,
        exposure: float = 1.0,
        heat_max: Optional[float] = None,
        crop: Optional[tuple[int, int, int, int]] = None,
        sample_range: Optional[tuple[int, int]] = None,
        threads: Optional[int] = None,
        progress: Progress = None,
    ) -> Picture:
        """Renders the scene, as the command ``kdray render`` does, and by its words.

        A scene of one mesh file has its materials, lights and cameras; others are grey, in the light of a sun.

        ``eye``, ``look_at``, ``up``, ``fov``
            The observer, the point in the middle, what points up, and the angle between the lower and the upper edge
            in degrees; without them the file's first camera, or one that frames the scene.
            ``up`` also says where above is for the camera that frames the scene, and for the sky: +y otherwise.
        ``camera``
            A camera of the file, by its name or its number.
        ``light``
            Points (3,) or (n, 3) at which lights are added.
        ``picture``
            ``"shaded"``, ``"depth"``, ``"normal"``, ``"primitive-id"``, ``"ambient-occlusion"``; what the tree costs each
            ray: ``"cost"``, ``"cost-nodes"``, ``"cost-primitives"``; or each packet: ``"packet-cost"``, ``"packet-size"``.
        ``layers``
            Whether the layers of all of them are computed.
        ``samples``, ``bounces``, ``light_samples``, ``ambient_rays``
            Rays a pixel; how often each is mirrored or refracted; shadow rays for each of them and each rectangular light;
            rays by which surroundings block ambient light, as far as ``occlusion_distance``.
        ``background``, ``ambient``
            Linear RGB: behind everything, without it a sky; and from all around.
        ``exposure``, ``heat_max``
            What light is multiplied by in the array, and the cost that has the last colour.

        ``crop``
            The part (x, y, width, height) of the picture that is rendered, from its upper left corner: the same
            pixels, bit for bit.
        ``sample_range``
            Which of the samples of each pixel are taken, the first and that behind the last: ``color`` in
            ``layers`` is the mean of these.

        The same ``seed`` gives the same picture, on any number of threads.
        """
        view = {
            "width": _count("width", width),
            "height": _count("height", height),
            "eye": _triple("eye", eye),
            "look_at": _triple("look_at", look_at),
            "up": _triple("up", up),
            "fov": _number_or_none("fov", fov),
            "camera": None if camera is None else str(camera),
            "light": [] if light is None else vectors("light", light).reshape(-1, 3).tolist(),
        }
        quality = {
            "picture": str(picture),
            "layers": bool(layers),
            "samples": _count("samples", samples),
            "bounces": _count("bounces", bounces),
            "light_samples": _count("light_samples", light_samples),
            "seed": _count("seed", seed, 63),
            "packets": bool(packets),
            "background": _triple("background", background),
            "ambient": _triple("ambient", ambient),
            "ambient_rays": _count("ambient_rays", ambient_rays),
            "occlusion_distance": _number_or_none("occlusion_distance", occlusion_distance),
            "exposure": _number("exposure", exposure),
            "heat_max": _number_or_none("heat_max", heat_max),
            "crop": None if crop is None else _counts("crop", crop, 4),
            "sample_range": None if sample_range is None else _counts("sample_range", sample_range, 2),
        }
        with telling(progress, "pixel") as told:
            world = self._seen(threads)
            count = whole_or_none("threads", threads)
            made = _kdray.render(world, view, quality, threads=count, progress=told)
        return Picture.of(made)

    def _seen(self, threads: Optional[int]) -> _kdray.World:
        tree = self._built(threads)
        with self._seeing:
            if self._world is None:
                self._world = _kdray.World(tree, self._look())
            return self._world


def _count(name: str, number: int, bits: int = 32) -> int:
    count = whole(name, number)
    if not 0 <= count < 1 << bits:
        raise ArgumentError(f"{name}: give a whole number from 0, of {bits} bits")
    return count


def _counts(name: str, numbers: Iterable[int], many: int) -> list[int]:
    if not isinstance(numbers, Iterable):
        raise ArgumentTypeError(f"{name}: give {many} whole numbers, not {numbers!r}")
    counts = [_count(name, number) for number in numbers]
    if len(counts) != many:
        raise ArgumentError(f"{name}: give {many} whole numbers, not {len(counts)}")
    return counts


def _number(name: str, number: float) -> float:
    is_real = isinstance(number, (int, float, np.integer, np.floating))
    if isinstance(number, bool) or not is_real:
        raise ArgumentTypeError(f"{name}: give a number, not {number!r}")
    return float(number)


def _number_or_none(name: str, number: Optional[float]) -> Optional[float]:
    return None if number is None else _number(name, number)


def _triple(name: str, values: Optional[ArrayLike]) -> Optional[list[Any]]:
    if values is None:
        return None
    array = vectors(name, values)
    if array.shape != (3,):
        raise ArgumentError(f"{name}: give three numbers, not an array of shape {array.shape}")
    numbers: list[Any] = array.tolist()
    return numbers
