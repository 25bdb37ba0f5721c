"""The compiled part of kdray. Its arrays are those that the package's own files make; use these."""

from collections.abc import Callable, Sequence
from typing import Any, Optional, final

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray
from .rays import RayArrays

__all__ = [
    "Look",
    "Mesh",
    "Picture",
    "Tree",
    "World",
    "closest_point",
    "contains",
    "file_hash",
    "is_tree_file",
    "load_tree",
    "map_tree",
    "read_mesh",
    "render",
    "save_tree",
    "signed_distance",
    "stats",
    "thickness",
    "tree_hash",
    "visible",
    "winding_number",
    "write_file",
]

_Progress = Optional[Callable[[int, int], object]]
# t, u, v, primitive_id, front; geometry_id if there are several; instance_id if there are any
_HitArrays = tuple[
    FloatArray,
    FloatArray,
    FloatArray,
    NDArray[np.int32],
    NDArray[np.bool_],
    Optional[NDArray[np.int32]],
    Optional[NDArray[np.int32]],
]
# point, distance, u, v, primitive_id, geometry_id
_NearestArrays = tuple[
    FloatArray,
    FloatArray,
    FloatArray,
    FloatArray,
    NDArray[np.int32],
    NDArray[np.int32],
]
# the geometry, three rows of a matrix into the world, the mask
_Copy = tuple[int, Sequence[Sequence[float]], int]

@final
class Look:
    """What a file says besides its triangles: materials, lights, cameras."""

@final
class Picture:
    """A rendered picture."""

    @property
    def rgba(self) -> NDArray[np.uint8]: ...
    @property
    def channels(self) -> dict[str, NDArray[Any]]: ...
    def png(self, bits: int) -> bytes: ...
    def exr(self) -> bytes: ...

@final
class World:
    """A scene with what its triangles look like."""

    def __new__(cls, tree: Tree, look: Look | None) -> World: ...

@final
class Mesh:
    """Triangles of one geometry."""

    def __new__(cls, vertices: FloatArray, faces: NDArray[np.uint32]) -> Mesh: ...
    @property
    def face_count(self) -> int: ...
    @property
    def vertex_count(self) -> int: ...
    @property
    def is_double(self) -> bool: ...
    @property
    def vertices(self) -> FloatArray: ...
    @property
    def faces(self) -> NDArray[np.uint32]: ...

@final
class Tree:
    """A built scene, to be asked from any thread."""

    @staticmethod
    def build(
        meshes: Sequence[Mesh],
        copies: Sequence[_Copy],
        *,
        is_double: bool,
        preset: str | None,
        split: str | None,
        leaf_size: int | None,
        max_depth: int | None,
        memory_limit: int | None,
        threads: int | None,
        progress: _Progress,
    ) -> Tree: ...
    @property
    def bounds(self) -> NDArray[np.float64] | None: ...
    @property
    def face_count(self) -> int: ...
    @property
    def is_double(self) -> bool: ...
    @property
    def vertices(self) -> FloatArray: ...
    @property
    def faces(self) -> NDArray[np.uint32]: ...
    def closest_hit(
        self,
        rays: RayArrays,
        *,
        is_double: bool,
        lenient: bool,
        mask: int,
        threads: int | None,
        progress: _Progress,
    ) -> _HitArrays: ...
    def any_hit(
        self,
        rays: RayArrays,
        *,
        lenient: bool,
        mask: int,
        threads: int | None,
        progress: _Progress,
    ) -> NDArray[np.bool_]: ...
    def count(
        self,
        rays: RayArrays,
        *,
        lenient: bool,
        mask: int,
        threads: int | None,
        progress: _Progress,
    ) -> NDArray[np.int32]: ...
    def all_hits(
        self,
        rays: RayArrays,
        *,
        is_double: bool,
        limit: int | None,
        lenient: bool,
        mask: int,
        threads: int | None,
        progress: _Progress,
    ) -> tuple[NDArray[np.int64], _HitArrays]: ...
    def normals(
        self,
        primitive_id: NDArray[np.int32],
        geometry_id: NDArray[np.int32],
        instance_id: NDArray[np.int32],
        *,
        threads: int | None,
    ) -> NDArray[np.float64]: ...
    def positions(
        self,
        primitive_id: NDArray[np.int32],
        geometry_id: NDArray[np.int32],
        instance_id: NDArray[np.int32],
        u: NDArray[np.float64],
        v: NDArray[np.float64],
        *,
        threads: int | None,
    ) -> NDArray[np.float64]: ...

def contains(
    tree: Tree,
    points: FloatArray,
    *,
    lenient: bool,
    threads: int | None,
    progress: _Progress,
) -> NDArray[np.bool_]: ...
def closest_point(
    tree: Tree,
    points: FloatArray,
    *,
    is_double: bool,
    lenient: bool,
    threads: int | None,
    progress: _Progress,
) -> _NearestArrays: ...
def signed_distance(
    tree: Tree,
    points: FloatArray,
    *,
    is_double: bool,
    lenient: bool,
    threads: int | None,
    progress: _Progress,
) -> FloatArray: ...
def winding_number(
    tree: Tree,
    points: FloatArray,
    *,
    is_double: bool,
    lenient: bool,
    threads: int | None,
    progress: _Progress,
) -> FloatArray: ...
def visible(
    tree: Tree,
    points: FloatArray,
    others: FloatArray,
    *,
    lenient: bool,
    threads: int | None,
    progress: _Progress,
) -> NDArray[np.bool_]: ...
def thickness(
    tree: Tree,
    primitive_id: NDArray[np.int32],
    geometry_id: NDArray[np.int32],
    u: NDArray[np.float64],
    v: NDArray[np.float64],
    *,
    side: str,
    is_double: bool,
    threads: int | None,
    progress: _Progress,
) -> FloatArray: ...

def read_mesh(path: str, *, drop_bad: bool) -> tuple[Mesh, Look, list[str]]: ...
def is_tree_file(path: str) -> bool: ...
def save_tree(tree: Tree, path: str) -> None: ...
def write_file(path: str, content: bytes) -> None: ...
def load_tree(path: str, *, memory_limit: int | None, threads: int | None) -> Tree: ...
def map_tree(path: str) -> Tree: ...
def file_hash(path: str) -> str: ...
def tree_hash(tree: Tree) -> str: ...
def stats(tree: Tree) -> dict[str, Any]: ...
def render(
    world: World,
    view: dict[str, Any],
    quality: dict[str, Any],
    *,
    threads: int | None,
    progress: _Progress,
) -> Picture: ...
