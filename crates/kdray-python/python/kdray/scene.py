"""Scenes."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from html import escape
from threading import Lock, get_ident
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _kdray
from ._kdray import Look, Mesh, Tree
from .arrays import FloatArray, face_indices, floats, vectors
from .errors import ArgumentError, ArgumentTypeError, SceneError
from .figures import as_html
from .meshes import triangles_of
from .point_queries import PointQueries
from .progress import Progress, telling
from .ray_queries import RayQueries
from .rendering import Rendering
from .saved import Saved, Saving, path_of
from .warning import warn
from .whole import ALL, mask_bits, whole, whole_or_none
from .word import word_or_none

if TYPE_CHECKING:
    from ._kdray import _Copy


class Scene(RayQueries, PointQueries, Rendering, Saving):
    """Triangles with a tree over them, to be asked from any thread.

    >>> scene = Scene()
    >>> scene.add_triangles([[0, 0, 2], [1, 0, 2], [0, 1, 2]], [[0, 1, 2]])
    0
    >>> scene.any_hit([[0.25, 0.25, 0], [0.75, 0.75, 0]], [0, 0, 1])
    array([ True, False])

    The tree is built by ``build``, or by the first query; nothing can be added any more then.

    Arguments of all queries, where they have them:

    - ``t_min``, ``t_max``: the part of each ray that counts, in lengths of its direction; numbers, or arrays that
      are broadcast with the rays.
    - ``mask``: bits; only instances that share one are seen, and geometries without instances, always.
    - ``invalid``: ``"raise"`` refuses rays and points that are not finite, or directions of zeros; ``"miss"``
      has them hit nothing.
    - ``threads``: how many; without it those of the environment variable ``KDRAY_THREADS``, or all.
    - ``progress``: ``True`` for a bar by tqdm, or a function that is told what is done and of how much.
    """

    def __init__(
        self,
        vertices: Optional[ArrayLike] = None,
        faces: Optional[ArrayLike] = None,
        *,
        dtype: Optional[DTypeLike] = None,
    ) -> None:
        """A scene without triangles, or with those of one mesh.

        ``dtype`` is the precision of all vertices, float32 or float64. Without it they are float32 if those of
        all geometries are, else float64; whole numbers become float64.
        """
        self._dtype = _precision(dtype)
        self._meshes: list[Mesh] = []
        self._looks: list[Optional[Look]] = []
        self._copies: list[_Copy] = []
        self._tree: Optional[Tree] = None
        self._lock = Lock()
        self._holder: Optional[int] = None
        if vertices is not None and faces is not None:
            self.add_triangles(vertices, faces)
        elif vertices is not None or faces is not None:
            text = "give both, or neither; Scene.of takes the path of a file, or a mesh of another package"
            raise ArgumentError(f"vertices, faces: {text}")

    @classmethod
    def of(cls, mesh: Any, *, dtype: Optional[DTypeLike] = None) -> Scene:
        """The scene of one mesh, see ``add``; or of a tree file, see ``load``."""
        if isinstance(mesh, (str, os.PathLike)) and _kdray.is_tree_file(path_of("mesh", mesh)):
            scene = cls.load(mesh)
            if dtype is not None and scene.dtype != _precision(dtype):
                raise ArgumentError(f"dtype: the tree file is of {scene.dtype}; leave it out")
            return scene
        scene = cls(dtype=dtype)
        scene.add(mesh)
        return scene

    def add_triangles(self, vertices: ArrayLike, faces: ArrayLike) -> int:
        """Adds a geometry: vertices (n, 3), and faces (m, 3) of three vertices each. Returns its id.

        Both are copied. Vertices that no face uses may be anything; all others are finite. Faces without area
        are kept, and no ray hits them.
        """
        points = floats("vertices", vertices)
        points = vectors("vertices", points) if points.size else np.zeros((0, 3), np.float32)
        if points.ndim != 2:
            raise ArgumentError(f"vertices: give an array of shape (n, 3), not {points.shape}")
        if self._dtype is not None:
            # What overflows is not finite, and refused.
            with np.errstate(over="ignore"):
                points = points.astype(self._dtype, copy=False)
        return self._add(Mesh(np.ascontiguousarray(points), face_indices(faces)), None)

    def add(self, mesh: Any, *, drop_bad: bool = False) -> int:
        """Adds a mesh as a geometry. Returns its id.

        It is a ``trimesh.Trimesh``, an Open3D mesh of either kind, or the path of an OBJ, PLY, STL, OFF, glTF or
        GLB file, which may be compressed (.gz, .zst) and is read as f32. ``drop_bad`` drops triangles of the file with indices out of
        range or vertices that are not finite, with a warning, instead of refusing the file.
        """
        if not isinstance(mesh, (str, os.PathLike)):
            return self.add_triangles(*triangles_of("mesh", mesh, "the path of a file"))
        path = path_of("mesh", mesh)
        if _kdray.is_tree_file(path):
            raise ArgumentError("mesh: this is a tree file, which is a scene of its own; take Scene.load")
        read, look, told = _kdray.read_mesh(path, drop_bad=bool(drop_bad))
        for text in told:
            warn(text)
        if self._dtype is not None and (self._dtype == np.float64) != read.is_double:
            read = Mesh(read.vertices.astype(self._dtype), read.faces)
        return self._add(read, look)

    def add_instance(self, geometry_id: int, transform: ArrayLike, *, mask: int = ALL) -> int:
        """Adds a copy of a geometry, placed by a matrix (3, 4) or (4, 4) into the world. Returns its id.

        A geometry that has instances is where these are, and there only; give the identity as well to
        keep it where it is. Rays see instances whose ``mask`` shares a bit with their own.
        """
        matrix = np.asarray(vectors("transform", transform, 4), dtype=np.float64)
        if matrix.shape == (4, 4):
            if not np.array_equal(matrix[3], [0, 0, 0, 1]):
                raise ArgumentError("transform: the last row is not 0, 0, 0, 1; give an affine matrix")
            matrix = matrix[:3]
        if matrix.shape != (3, 4):
            raise ArgumentError(f"transform: give an array of shape (3, 4) or (4, 4), not {matrix.shape}")
        geometry, bits = whole("geometry_id", geometry_id), mask_bits(mask)
        with self._changing():
            if not 0 <= geometry < len(self._meshes):
                text = f"geometry_id: there is no geometry {geometry}; there are {len(self._meshes)}"
                raise ArgumentError(text)
            self._copies.append((geometry, matrix.tolist(), bits))
            return len(self._copies) - 1

    def build(
        self,
        preset: Optional[str] = None,
        *,
        split: Optional[str] = None,
        leaf_size: Optional[int] = None,
        max_depth: Optional[int] = None,
        memory_limit: Optional[int] = None,
        threads: Optional[int] = None,
        progress: Progress = None,
    ) -> Scene:
        """Builds the tree, and returns the scene. Without it the first query does, by what is standard.

        The words are those of the command ``kdray``: ``preset`` is ``"fast"``, ``"balanced"`` (without it) or
        ``"best"``, for how long the build may take for how fast a tree; ``split`` instead is ``"sah"``,
        ``"middle"``, ``"median"`` or ``"round-robin"``, for a tree of the lecture, with its slower traversal.
        Nodes of ``leaf_size`` triangles are not cut, nor are those at ``max_depth``. A build that is expected to
        take more than ``memory_limit`` bytes is refused. The tree is the same for any number of threads.
        """
        options = {"leaf_size": leaf_size, "max_depth": max_depth, "memory_limit": memory_limit}
        with self._held():
            if self._tree is not None:
                raise SceneError("the scene is built already; make a new one to build it otherwise")
            self._build(preset, split, options, threads, progress)
        return self

    def stats(self) -> dict[str, Any]:
        """The figures of the scene and its tree, under the names that the command ``kdray stats`` gives them.

        ``sah_cost`` is what a random line is expected to cost. With instances, the tree is that over them.
        Asking for them builds the tree.
        """
        return _kdray.stats(self._built())

    @property
    def is_built(self) -> bool:
        """Whether the tree is there, and nothing can be added any more."""
        return self._tree is not None

    @property
    def dtype(self) -> np.dtype[Any]:
        """The precision of the vertices, float32 or float64."""
        if self._tree is not None:
            is_double = self._tree.is_double
        elif self._dtype is not None:
            return self._dtype
        else:
            is_double = any(mesh.is_double for mesh in self._meshes)
        return np.dtype(np.float64 if is_double else np.float32)

    @property
    def vertices(self) -> FloatArray:
        """A copy of the vertices (n, 3): those of the first geometry, then those of the next."""
        if self._tree is not None:
            return self._tree.vertices
        lists = [mesh.vertices for mesh in self._meshes]
        empty = np.zeros((0, 3), self.dtype)
        return np.concatenate([empty, *lists]).astype(self.dtype, copy=False)

    @property
    def faces(self) -> NDArray[np.uint32]:
        """A copy of the faces (m, 3) of all geometries, by the indices of ``vertices``."""
        if self._tree is not None:
            return self._tree.faces
        faces, before = [np.zeros((0, 3), np.uint32)], 0
        for mesh in self._meshes:
            faces.append(mesh.faces + np.uint32(before))
            before += mesh.vertex_count
        return np.concatenate(faces)

    @property
    def bounds(self) -> Optional[NDArray[np.float64]]:
        """The box (2, 3) that holds all triangles, by its lower and its upper corner; None without any.

        With instances, it is a little larger. Asking for it builds the tree.
        """
        return self._built().bounds

    def __copy__(self, *_: Any) -> Scene:
        """A scene that is built cannot be changed, and so is its own copy."""
        if self._tree is None:
            raise SceneError("the scene is not built, and what can be changed is not copied; call build() first")
        return self

    __deepcopy__ = __copy__

    def _repr_html_(self) -> str:
        """What notebooks show: the figures of a scene that is built."""
        if self._tree is None:
            return f"<pre>{escape(repr(self))}</pre>"
        return as_html(self.stats())

    def __len__(self) -> int:
        """How many triangles there are, each geometry counted once."""
        if self._tree is not None:
            return self._tree.face_count
        return sum(mesh.face_count for mesh in self._meshes)

    def __bool__(self) -> bool:
        """A scene is true, even without triangles."""
        return True

    def __repr__(self) -> str:
        state = "built" if self.is_built else "not built"
        return f"<kdray.Scene: {len(self)} triangles, {self.dtype}, {state}>"

    def _built(self, threads: Optional[int] = None) -> Tree:
        tree = self._tree
        if tree is None:
            with self._held():
                tree = self._tree or self._build(None, None, {}, threads, None)
        return tree

    def _as_scene(self) -> Scene:
        return self

    def _look(self) -> Optional[Look]:
        return self._looks[0] if len(self._looks) == 1 else None

    @classmethod
    def _of_tree(cls, tree: Tree, saved: Saved) -> Scene:
        scene = cls()
        scene._tree, scene._saved = tree, saved
        return scene

    def _add(self, mesh: Mesh, look: Optional[Look]) -> int:
        with self._changing():
            self._meshes.append(mesh)
            self._looks.append(look)
            return len(self._meshes) - 1

    def _build(
        self,
        preset: Optional[str],
        split: Optional[str],
        options: dict[str, Optional[int]],
        threads: Optional[int],
        progress: Progress,
    ) -> Tree:
        is_double = self.dtype == np.float64
        numbers = {name: whole_or_none(name, number) for name, number in options.items()}
        with telling(progress, "triangle") as told:
            self._tree = Tree.build(
                self._meshes,
                self._copies,
                is_double=is_double,
                preset=word_or_none("preset", preset),
                split=word_or_none("split", split),
                leaf_size=numbers.get("leaf_size"),
                max_depth=numbers.get("max_depth"),
                memory_limit=numbers.get("memory_limit"),
                threads=whole_or_none("threads", threads),
                progress=told,
            )
        # The tree has copies of its own.
        self._meshes, self._copies = [], []
        return self._tree

    @contextmanager
    def _held(self) -> Iterator[None]:
        """Holds the lock. What is called meanwhile, to be told of progress, cannot have it too."""
        if self._holder == get_ident():
            raise SceneError("the scene is being built; ask it when that is done")
        with self._lock:
            self._holder = get_ident()
            try:
                yield
            finally:
                self._holder = None

    @contextmanager
    def _changing(self) -> Iterator[None]:
        """Holds the lock while something is added."""
        with self._held():
            if self._tree is not None:
                raise SceneError("the scene is built, and cannot be changed any more; make a new one")
            yield


def _precision(dtype: Optional[DTypeLike]) -> Optional[np.dtype[Any]]:
    if dtype is None:
        return None
    try:
        precision = np.dtype(dtype)
    except TypeError as error:
        raise ArgumentTypeError(f"dtype: give float32 or float64: {error}") from error
    if precision not in (np.float32, np.float64):
        raise ArgumentTypeError(f"dtype: give float32 or float64, not {precision}")
    return precision
