"""Tree files that scenes come from: what a pickled scene is."""

from __future__ import annotations

import os
from dataclasses import dataclass
from threading import Lock
from typing import TYPE_CHECKING, Any, Literal, Optional
from weakref import WeakValueDictionary

from . import _kdray
from .errors import ArgumentTypeError, FileError, SceneError
from .whole import whole_or_none

if TYPE_CHECKING:
    from .scene import Scene


@dataclass(frozen=True)
class Saved:
    """A tree file, and what it held when it was written or opened."""

    path: str
    """The absolute path."""

    content_hash: str
    """That of its content, in hexadecimal digits."""

    way: Literal["load", "mmap"]
    """How it was opened."""


_OPEN: WeakValueDictionary[Saved, Scene] = WeakValueDictionary()
"""The scenes that were unpickled in this process, so that each file is opened once."""

_OPENING = Lock()


def reopen(path: str, content_hash: str, way: Literal["load", "mmap"]) -> Scene:
    """What a pickled scene is made from. Scenes in use are not opened again."""
    from .scene import Scene

    saved = Saved(path, content_hash, way)
    with _OPENING:
        scene = _OPEN.get(saved)
        if scene is None:
            scene = Scene.load(path) if way == "load" else Scene.mmap(path)
            if scene.content_hash != content_hash:
                text = "the file has changed since the scene was pickled; pickle the scene of the new file"
                raise FileError(f"{path}: {text}")
            _OPEN[saved] = scene
    return scene


def path_of(name: str, path: Any) -> str:
    """A path as a text."""
    try:
        return os.fsdecode(os.fspath(path))
    except TypeError as error:
        raise ArgumentTypeError(f"{name}: give the path of a file: {error}") from None


class Saving:
    """Scenes to tree files, and back."""

    _saved: Optional[Saved] = None

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the mesh and its tree to a file, which takes the place of an older one when it is whole.

        A file holds one geometry without instances; other scenes are refused (``SceneError``, ``UnsupportedError``).

        The tree is built if need be. The same triangles and options give the same bytes. Afterwards the scene can
        be pickled, by reference to this file.
        """
        text = os.path.abspath(path_of("path", path))
        tree = self._as_scene()._built()
        _kdray.save_tree(tree, text)
        self._saved = Saved(text, _kdray.file_hash(text), "mmap")

    @classmethod
    def load(
        cls,
        path: str | os.PathLike[str],
        *,
        memory_limit: Optional[int] = None,
        threads: Optional[int] = None,
    ) -> Scene:
        """The scene of a tree file, all of which is read and verified: whoever made it, answers are right.

        Takes about as long as a build, and three times the file's size in memory at most; if that is more than ``memory_limit``
        bytes, the file is refused.
        """
        text = os.path.abspath(path_of("path", path))
        content_hash = _kdray.file_hash(text)
        limit, count = whole_or_none("memory_limit", memory_limit), whole_or_none("threads", threads)
        tree = _kdray.load_tree(text, memory_limit=limit, threads=count)
        return cls._of_tree(tree, Saved(text, content_hash, "load"))

    @classmethod
    def mmap(cls, path: str | os.PathLike[str]) -> Scene:
        """The scene of a tree file that you trust, mapped into memory: within milliseconds, and without a copy.

        All processes that map a file share its memory. It must not be written to meanwhile; to save another in its
        place is safe. Who changed it with intent may get wrong answers, but no crash.
        """
        text = os.path.abspath(path_of("path", path))
        content_hash = _kdray.file_hash(text)
        return cls._of_tree(_kdray.map_tree(text), Saved(text, content_hash, "mmap"))

    @property
    def path(self) -> Optional[str]:
        """The tree file that the scene was last saved to or comes from; None if there is none."""
        return None if self._saved is None else self._saved.path

    @property
    def content_hash(self) -> str:
        """A hash of mesh and tree, 16 hexadecimal digits: the same for the scene and its file.

        Not one that withstands those who want it to be the same.
        """
        if self._saved is not None:
            return self._saved.content_hash
        return _kdray.tree_hash(self._as_scene()._built())

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickles a reference to the tree file, never the triangles."""
        if self._saved is None:
            raise SceneError("a scene is pickled by reference to its tree file; call scene.save(path) first")
        return reopen, (self._saved.path, self._saved.content_hash, self._saved.way)

    def _as_scene(self) -> Scene:
        raise NotImplementedError

    @classmethod
    def _of_tree(cls, tree: _kdray.Tree, saved: Saved) -> Scene:
        raise NotImplementedError
