"""Rays by the billion: queries on Dask's clusters, against a saved tree that every worker maps into memory.

>>> import kdray, kdray.dask                                            # doctest: +SKIP
>>> kdray.Scene.of("city.ply").save("city.kdray")                       # doctest: +SKIP
>>> rays = kdray.dask.rays_from("rays.npy")                             # doctest: +SKIP
>>> hits = kdray.dask.closest_hit("city.kdray", rays)                   # doctest: +SKIP
>>> hits["t"].min().compute()                                           # doctest: +SKIP

Answers are lazy arrays; those about hits are of records, whose fields are those of ``kdray.Hits``. They are the same
to the last bit as those of one machine, but for ``radiance``, whatever becomes of workers meanwhile: an answer depends on its rays and on
the tree alone, and Dask does a task again that was lost. A file is known by the hash of its content, so that a
worker that finds another in its place says so; of a mesh file, materials and textures in other files are not looked at.

All workers must see the tree's file, and those of rays, under the paths that are given. Each task runs on as many
threads as Dask gives it: one. Errors about a ray or a point come from workers; they count within the block, and say
where it begins.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from hashlib import blake2b
from inspect import signature
from os import PathLike
from pathlib import Path
from typing import Any, Callable, Union

import dask.array as da
import numpy as np
from dask.base import tokenize
from numpy.typing import DTypeLike, NDArray

from . import _kdray
from .arrays import floats, is_single
from .errors import ArgumentError, ArgumentTypeError, FileError, about_file
from .hits import Hits
from .saved import path_of
from .scene import Scene
from .whole import whole

__all__ = [
    "all_hits",
    "any_hit",
    "closest_hit",
    "contains",
    "count",
    "radiance",
    "rays_from",
    "render",
    "signed_distance",
]

TreeFile = Union[str, "PathLike[str]"]
"""The path of a saved tree."""

Crop = tuple[int, int, int, int]
"""x, y, width and height of a part of a picture."""

PER_TASK = 2_000_000
"""Rays or points a task, unless told otherwise: seconds of work, and 160 MB of rays and hits in f64."""

COUNTED = re.compile(r"\bof (ray|index) \d")
"""What errors say that are about one ray or point."""

TAKEN = frozenset({"threads", "progress", "crop"})
"""Options that each task has from here, or that only one process can have."""


def rays_from(path: Union[str, "PathLike[str]"], per_task: int = PER_TASK) -> da.Array:
    """Rays (n, 6) from a file, of which each task reads its own part: ``.npy``, ``.zarr`` or ``.parquet``.

    A Parquet file has six columns of numbers, origins before directions. Zarr and Parquet need what Dask needs for
    them.
    """
    name = path_of("path", path)
    ending, count = Path(name).suffix.lower(), _positive("per_task", per_task)
    if ending == ".npy":
        return _rays_from_npy(name, count)
    if ending not in (".zarr", ".parquet"):
        raise ArgumentError(f"path: {name} ends neither in .npy nor in .zarr or .parquet")
    with _reading(name):
        rays = da.from_zarr(name) if ending == ".zarr" else _from_parquet(name)
    return _blocks("path", rays, 6, count)


def closest_hit(tree: TreeFile, rays: Any, *, per_task: int = PER_TASK, **options: Any) -> da.Array:
    """The closest hits of rays (..., 6): records (...) of t, u, v, primitive_id and front.

    ``rays`` is an array of Dask or numpy. ``options`` are those of ``kdray.Scene.closest_hit`` that are numbers.
    """
    blocks = _blocks("rays", rays, 6, per_task)
    return _asked(tree, "closest_hit", blocks, _hit_records(blocks.dtype), options)


def any_hit(tree: TreeFile, rays: Any, *, per_task: int = PER_TASK, **options: Any) -> da.Array:
    """Whether each of the rays (..., 6) hits anything."""
    return _asked(tree, "any_hit", _blocks("rays", rays, 6, per_task), np.bool_, options)


def count(tree: TreeFile, rays: Any, *, per_task: int = PER_TASK, **options: Any) -> da.Array:
    """How many surfaces each of the rays (..., 6) crosses."""
    return _asked(tree, "count", _blocks("rays", rays, 6, per_task), np.int32, options)


def all_hits(tree: TreeFile, rays: Any, *, per_task: int = PER_TASK, **options: Any) -> da.Array:
    """All hits of rays (n, 6), by ray and by rising t: records of ray_id, t, u, v, primitive_id and front.

    How many there are is known when they are computed, so that the length of the array is NaN until then.
    """
    blocks = _blocks("rays", rays, 6, per_task)
    if blocks.ndim != 2:
        raise ArgumentError(f"rays: give an array of shape (n, 6), not {blocks.shape}")
    _check("all_hits", options)
    records = np.dtype([("ray_id", np.int64), *_hit_records(blocks.dtype).descr])
    firsts = np.cumsum([0, *blocks.chunks[0][:-1]])
    first = da.from_array(firsts[:, np.newaxis], chunks=(1, 1))
    path, content_hash = _known(tree)

    def hits(
        block: NDArray[Any], first: NDArray[np.int64], block_info: Any = None
    ) -> NDArray[Any]:
        with _counting(block_info):
            found = _opened(path, content_hash).all_hits(block, threads=1, **options)
        table = _recorded(found, records)
        table["ray_id"] = found.ray_id + first[0, 0]
        return table

    lengths = ((np.nan,) * len(firsts),)
    meta = np.empty(0, records)
    found: da.Array = da.map_blocks(
        hits, blocks, first, dtype=records, drop_axis=1, chunks=lengths, meta=meta
    )
    return found


def contains(tree: TreeFile, points: Any, *, per_task: int = PER_TASK, **options: Any) -> da.Array:
    """Whether each of the points (..., 3) is inside, or on the surface."""
    return _asked(tree, "contains", _blocks("points", points, 3, per_task), np.bool_, options)


def signed_distance(
    tree: TreeFile, points: Any, *, per_task: int = PER_TASK, **options: Any
) -> da.Array:
    """How far each of the points (..., 3) is from the surface, negative inside."""
    blocks = _blocks("points", points, 3, per_task)
    return _asked(tree, "signed_distance", blocks, blocks.dtype, options)


def render(
    scene: TreeFile, *, width: int = 960, height: int = 540, tile: int = 256, **options: Any
) -> da.Array:
    """A picture (height, width, 3) of uint8 of a mesh file or a saved tree, of which each task renders a tile.

    ``options`` are those of ``kdray.Scene.render``. The pixels are those of one machine, bit for bit; pictures of
    cost need a ``heat_max``, or each tile would have its own. Stack the pictures of several cameras for an animation.
    """
    _check_picture(options)

    def pixels(seen: Scene, crop: Crop) -> NDArray[np.uint8]:
        picture = seen.render(width=width, height=height, crop=crop, threads=1, **options)
        return np.asarray(picture).copy()

    return _tiles(scene, (height, width), tile, np.uint8, pixels)


def radiance(
    scene: TreeFile,
    *,
    width: int = 960,
    height: int = 540,
    tile: int = 256,
    samples: int = 16,
    samples_per_task: int = 16,
    **options: Any,
) -> da.Array:
    """The light (height, width, 3), linear RGB in f32, of which each task renders some samples of a tile.

    The mean of all samples, as ``Scene.render(...).layers`` has it but for the rounding of sums.
    """
    samples, at_once = _positive("samples", samples), _positive("samples_per_task", samples_per_task)
    _check_picture({"samples": samples, **options}, TAKEN | {"sample_range"})

    def light(first: int, end: int) -> da.Array:
        def sums(seen: Scene, crop: Crop) -> NDArray[np.float64]:
            part: dict[str, Any] = {"samples": samples, "sample_range": (first, end), "crop": crop}
            layers = seen.render(width=width, height=height, threads=1, **part, **options).layers
            means = np.stack([layers[f"color.{channel}"] for channel in "RGB"], axis=-1)
            return means.astype(np.float64) * (end - first)

        return _tiles(scene, (height, width), tile, np.float64, sums)

    starts = range(0, samples, at_once)
    parts = [light(first, min(first + at_once, samples)) for first in starts]
    mean: da.Array = (sum(parts[1:], start=parts[0]) / samples).astype(np.float32)
    return mean


def _tiles(
    scene: TreeFile,
    shape: tuple[int, int],
    tile: int,
    dtype: DTypeLike,
    pixels: Callable[[Scene, Crop], NDArray[Any]],
) -> da.Array:
    """A picture of three channels, lazily, in tiles that ``pixels`` renders."""
    height, width = _positive("height", shape[0]), _positive("width", shape[1])
    side = _positive("tile", tile)
    path, content_hash = _known(scene)

    def part(block_info: Any = None) -> NDArray[Any]:
        rows, columns, _ = block_info[None]["array-location"]
        crop = (columns[0], rows[0], columns[1] - columns[0], rows[1] - rows[0])
        return pixels(_opened(path, content_hash), crop)

    chunks = da.core.normalize_chunks((side, side, 3), (height, width, 3))
    meta = np.empty((0, 0, 0), dtype)
    picture: da.Array = da.map_blocks(part, chunks=chunks, dtype=dtype, meta=meta)
    return picture


def _asked(
    tree: TreeFile, query: str, blocks: da.Array, dtype: DTypeLike, options: dict[str, Any]
) -> da.Array:
    """The answers to all blocks, lazily, of the shape of their vectors."""
    _check(query, options)
    path, content_hash = _known(tree)

    def answers(block: NDArray[Any], block_info: Any = None) -> NDArray[Any]:
        ask: Callable[..., Any] = getattr(_opened(path, content_hash), query)
        with _counting(block_info):
            found = ask(block, threads=1, **options)
        table: NDArray[Any] = _recorded(found, np.dtype(dtype)) if isinstance(found, Hits) else found
        return table

    meta = np.empty((0,) * (blocks.ndim - 1), dtype)
    last = blocks.ndim - 1
    found: da.Array = da.map_blocks(answers, blocks, dtype=dtype, drop_axis=last, meta=meta)
    return found


@contextmanager
def _counting(block_info: Any) -> Iterator[None]:
    """Errors that count rays or points say where the block begins within which they do."""
    try:
        yield
    except ArgumentError as error:
        if not COUNTED.search(str(error)):
            raise
        starts = [start for start, _ in block_info[0]["array-location"][:-1]]
        begin = starts[0] if len(starts) == 1 else tuple(starts)
        raise ArgumentError(f"{error}; counted from {begin}, where the block begins") from None


def _check(query: str, options: dict[str, Any]) -> None:
    """Refuses options that a query does not have, arrays, which would be broadcast to each block and not to all, and
    what the query does not take."""
    _check_names(query, options)
    for name, value in options.items():
        if not is_single(value):
            raise ArgumentError(f"{name}: give one number for all")
    width = 3 if query in ("contains", "signed_distance") else 6
    getattr(_nothing(), query)(np.ones((1, width)), threads=1, **options)


def _check_picture(options: dict[str, Any], taken: frozenset[str] = TAKEN) -> None:
    """The same for pictures. Which cameras there are, the file says."""
    _check_names("render", options, taken)
    others = {name: value for name, value in options.items() if name != "camera"}
    _nothing().render(width=1, height=1, threads=1, **others)


def _nothing() -> Scene:
    """A scene of nothing, which is quick to say what it does not take."""
    return Scene().build(threads=1)


def _check_names(query: str, options: dict[str, Any], taken: frozenset[str] = TAKEN) -> None:
    """Refuses options that a method of scenes does not have."""
    parameters = signature(getattr(Scene, query)).parameters.values()
    known = [it.name for it in parameters if it.kind is it.KEYWORD_ONLY and it.name not in taken]
    for name in options:
        if name not in known:
            raise ArgumentTypeError(f"{name}: this cannot be given here; there are {', '.join(known)}")


def _positive(name: str, number: int) -> int:
    count = whole(name, number)
    if count < 1:
        raise ArgumentError(f"{name}: give 1 or more, not {count}")
    return count


def _known(file: TreeFile) -> tuple[str, str]:
    """A file's path as workers see it, and the hash of what it holds."""
    path = os.path.abspath(path_of("path", file))
    return path, _hash_of(path)


def _hash_of(path: str) -> str:
    """Of a tree file that which it says of itself; of a mesh file one of all its bytes."""
    if _kdray.is_tree_file(path):
        return _kdray.file_hash(path)
    try:
        with open(path, "rb") as file:
            return blake2b(file.read()).hexdigest()
    except OSError as error:
        raise about_file(path, error) from error


_OPENED: dict[tuple[str, str], Scene] = {}
"""The scenes that this worker has opened."""

MOST_OPENED = 16
"""How many scenes a worker keeps open."""


def _opened(path: str, content_hash: str) -> Scene:
    """The scene of a file, opened once in each worker; trees are mapped."""
    scene = _OPENED.get((path, content_hash))
    if scene is None:
        if _hash_of(path) != content_hash:
            raise FileError(f"{path} has changed since the query was made; make it anew")
        scene = Scene.mmap(path) if _kdray.is_tree_file(path) else Scene.of(path)
        if len(_OPENED) >= MOST_OPENED:
            _OPENED.clear()
        _OPENED[path, content_hash] = scene
    return scene


def _hit_records(floats: DTypeLike) -> np.dtype[Any]:
    numbers = [(name, floats) for name in ("t", "u", "v")]
    return np.dtype([*numbers, ("primitive_id", np.int32), ("front", np.bool_)])


def _recorded(hits: Hits, records: np.dtype[Any]) -> NDArray[Any]:
    """Hits as records; fields that hits do not have are left to the caller."""
    table = np.empty(hits.shape, records)
    for name in records.names or ():
        if name != "ray_id":
            table[name] = getattr(hits, name)
    return table


def _blocks(name: str, vectors: Any, width: int, per_task: int) -> da.Array:
    """Vectors (..., width) in blocks of f32 or f64, each of whole vectors and not above ``per_task`` of them."""
    count = _positive("per_task", per_task)
    array = vectors if isinstance(vectors, da.Array) else da.from_array(floats(name, vectors))
    if array.dtype.kind not in "fiub":
        raise ArgumentTypeError(f"{name}: give real numbers, not an array of {array.dtype}")
    if array.ndim < 2 or array.shape[-1] != width:
        raise ArgumentError(f"{name}: give an array of shape (..., {width}), not {array.shape}")
    if np.isnan(array.shape).any():
        raise ArgumentError(f"{name}: its length is not known; call compute_chunk_sizes() first")
    if array.dtype not in (np.float32, np.float64):
        array = array.astype(np.float64)
    most = count * width * array.dtype.itemsize
    too_large = np.prod([max(sizes) for sizes in array.chunks[:-1]]) > count
    if too_large or len(array.chunks[-1]) > 1:
        whole = {axis: "auto" for axis in range(array.ndim - 1)} | {array.ndim - 1: -1}
        array = array.rechunk(whole, block_size_limit=most)
    return array


@contextmanager
def _reading(path: str) -> Iterator[None]:
    """Errors of other packages about a file, as those of kdray."""
    try:
        yield
    except OSError as error:
        raise about_file(path, error) from error
    except (ValueError, EOFError) as error:
        raise FileError(f"{path}: this is no array that can be read: {error}") from error


def _from_parquet(path: str) -> da.Array:
    from dask.dataframe import read_parquet

    rays: da.Array = read_parquet(path).to_dask_array(lengths=True)
    return rays


def _rays_from_npy(path: str, per_task: int) -> da.Array:
    header = _mapped(path)
    if header.ndim != 2 or header.shape[1] != 6:
        raise ArgumentError(f"path: {path} holds an array of shape {header.shape}; it must be (n, 6)")
    if header.dtype.kind not in "fiub":
        raise ArgumentTypeError(f"path: {path} holds an array of {header.dtype}; it must be of real numbers")
    starts = range(0, len(header), per_task) or range(1)
    sizes = tuple(min(per_task, len(header) - start) for start in starts)

    def part(block_info: Any = None) -> NDArray[Any]:
        (start, stop), _ = block_info[None]["array-location"]
        return np.array(_mapped(path)[start:stop])

    meta = np.empty((0, 0), header.dtype)
    written = os.stat(path)
    # Another file in its place is another array to Dask.
    token = (path, written.st_mtime_ns, written.st_size, sizes)
    rays: da.Array = da.map_blocks(
        part, chunks=(sizes, (6,)), dtype=header.dtype, meta=meta, token=tokenize(token)
    )
    return rays


def _mapped(path: str) -> NDArray[Any]:
    """The array of a file of numpy's, mapped into memory."""
    with _reading(path):
        array: NDArray[Any] = np.load(path, mmap_mode="r")
    if not isinstance(array, np.ndarray):
        raise FileError(f"{path}: this holds several arrays; save one with numpy.save")
    return array
