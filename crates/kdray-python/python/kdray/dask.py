"""Rays by the billion: queries on Dask's clusters, against a saved tree that every worker maps into memory.

>>> import kdray, kdray.dask                                            # doctest: +SKIP
>>> kdray.Scene.of("city.ply").save("city.kdray")                       # doctest: +SKIP
>>> rays = kdray.dask.rays_from("rays.npy")                             # doctest: +SKIP
>>> hits = kdray.dask.closest_hit("city.kdray", rays)                   # doctest: +SKIP
>>> hits["t"].min().compute()                                           # doctest: +SKIP

Answers are lazy arrays; those about hits are of records, whose fields are those of ``kdray.Hits``. They are the same
to the last bit as those of one machine, whatever becomes of workers meanwhile: an answer depends on its rays and on
the tree alone, and Dask does a task again that was lost. The tree is known by the hash of its content, so that a
worker that finds another file in its place says so.

All workers must see the tree's file, and those of rays, under the paths that are given. Each task runs on as many
threads as Dask gives it: one.
"""

from __future__ import annotations

from os import PathLike, fspath
from pathlib import Path
from typing import Any, Callable, Union

import dask.array as da
import numpy as np
from numpy.typing import DTypeLike, NDArray

from .errors import ArgumentError, FileError
from .hits import Hits
from .scene import Scene

__all__ = ["all_hits", "any_hit", "closest_hit", "contains", "count", "rays_from", "signed_distance"]

TreeFile = Union[str, "PathLike[str]"]
"""The path of a saved tree."""

PER_TASK = 2_000_000
"""Rays or points a task, unless told otherwise: seconds of work, and 160 MB of rays and hits in f64."""


def rays_from(path: Union[str, "PathLike[str]"], per_task: int = PER_TASK) -> da.Array:
    """Rays (n, 6) from a file, of which each task reads its own part: ``.npy``, ``.zarr`` or ``.parquet``.

    A Parquet file has six columns of numbers, origins before directions. Zarr and Parquet need what Dask needs for
    them.
    """
    name, ending = fspath(path), Path(path).suffix.lower()
    if ending == ".npy":
        return _rays_from_npy(name, per_task)
    if ending == ".zarr":
        return _blocks("path", da.from_zarr(name), 6, per_task)
    if ending == ".parquet":
        from dask.dataframe import read_parquet

        return _blocks("path", read_parquet(name).to_dask_array(lengths=True), 6, per_task)
    raise ArgumentError(f"path: {name} ends neither in .npy nor in .zarr or .parquet")


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
    records = np.dtype([("ray_id", np.int64), *_hit_records(blocks.dtype).descr])
    firsts = np.cumsum([0, *blocks.chunks[0][:-1]])
    first = da.from_array(firsts[:, np.newaxis], chunks=(1, 1))
    path, content_hash = _known(tree)

    def hits(block: NDArray[Any], first: NDArray[np.int64]) -> NDArray[Any]:
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


def _asked(
    tree: TreeFile, query: str, blocks: da.Array, dtype: DTypeLike, options: dict[str, Any]
) -> da.Array:
    """The answers to all blocks, lazily, of the shape of their vectors."""
    path, content_hash = _known(tree)

    def answers(block: NDArray[Any]) -> NDArray[Any]:
        ask: Callable[..., Any] = getattr(_opened(path, content_hash), query)
        found = ask(block, threads=1, **options)
        table: NDArray[Any] = _recorded(found, np.dtype(dtype)) if isinstance(found, Hits) else found
        return table

    meta = np.empty((0,) * (blocks.ndim - 1), dtype)
    last = blocks.ndim - 1
    found: da.Array = da.map_blocks(answers, blocks, dtype=dtype, drop_axis=last, meta=meta)
    return found


def _known(tree: TreeFile) -> tuple[str, str]:
    """A tree's path as workers see it, and the hash of what it holds."""
    path = str(Path(tree).resolve())
    return path, Scene.mmap(path).content_hash


_OPENED: dict[tuple[str, str], Scene] = {}
"""The trees that this worker has mapped."""

MOST_OPENED = 16
"""How many trees a worker keeps mapped."""


def _opened(path: str, content_hash: str) -> Scene:
    """The tree, mapped once in each worker."""
    scene = _OPENED.get((path, content_hash))
    if scene is None:
        scene = Scene.mmap(path)
        if scene.content_hash != content_hash:
            raise FileError(f"{path} is another tree than when the query was made; make it anew")
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
    if per_task < 1:
        raise ArgumentError(f"per_task: give 1 or more, not {per_task}")
    array = vectors if isinstance(vectors, da.Array) else da.from_array(np.asarray(vectors))
    if array.ndim < 2 or array.shape[-1] != width:
        raise ArgumentError(f"{name}: give an array of shape (..., {width}), not {array.shape}")
    if np.isnan(array.shape).any():
        raise ArgumentError(f"{name}: its length is not known; call compute_chunk_sizes() first")
    if array.dtype not in (np.float32, np.float64):
        array = array.astype(np.float64)
    most = per_task * width * array.dtype.itemsize
    too_large = np.prod([max(sizes) for sizes in array.chunks[:-1]]) > per_task
    if too_large or len(array.chunks[-1]) > 1:
        whole = {axis: "auto" for axis in range(array.ndim - 1)} | {array.ndim - 1: -1}
        array = array.rechunk(whole, block_size_limit=most)
    return array


def _rays_from_npy(path: str, per_task: int) -> da.Array:
    header = np.load(path, mmap_mode="r")
    if header.ndim != 2 or header.shape[1] != 6:
        raise ArgumentError(f"path: {path} holds an array of shape {header.shape}; it must be (n, 6)")
    starts = range(0, len(header), per_task) or range(1)
    sizes = tuple(min(per_task, len(header) - start) for start in starts)

    def part(block_info: Any = None) -> NDArray[Any]:
        (start, stop), _ = block_info[None]["array-location"]
        rays: NDArray[Any] = np.array(np.load(path, mmap_mode="r")[start:stop])
        return rays

    meta = np.empty((0, 0), header.dtype)
    rays: da.Array = da.map_blocks(part, chunks=(sizes, (6,)), dtype=header.dtype, meta=meta)
    return rays
