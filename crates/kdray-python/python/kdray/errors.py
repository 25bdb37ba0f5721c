"""What can go wrong. Every message names what is to blame, and says what to do."""

import errno
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

__all__ = [
    "ArgumentError",
    "ArgumentTypeError",
    "BuildError",
    "FileError",
    "InternalError",
    "KdrayError",
    "MissingFileError",
    "SceneError",
    "UnsupportedError",
]


class KdrayError(Exception):
    """Whatever kdray raises of its own."""


class ArgumentError(KdrayError, ValueError):
    """An argument has a value that cannot be used: a shape, a NaN, an index out of range."""


class ArgumentTypeError(KdrayError, TypeError):
    """An argument is of a type, or an array of a dtype, that cannot be used."""


class BuildError(KdrayError, RuntimeError):
    """There is no tree over these triangles."""


class SceneError(KdrayError, RuntimeError):
    """The scene is not in the state that the call needs: it is built already, or not saved."""


class UnsupportedError(KdrayError, NotImplementedError):
    """kdray cannot do this, for now."""


class FileError(KdrayError, OSError):
    """A file cannot be read or written, has changed, or is none that can be used."""


class MissingFileError(FileError, FileNotFoundError):
    """A file is not there, or one that it needs, or the folder that it is to be written to."""

    errno = errno.ENOENT


class InternalError(KdrayError, RuntimeError):
    """A mistake in kdray itself."""


def about_file(path: str, error: OSError) -> FileError:
    """What the system says about a file, as an error of kdray."""
    kind = MissingFileError if isinstance(error, FileNotFoundError) else FileError
    return kind(f"{path}: {error.strerror or error}")


@contextmanager
def renamed(names: Mapping[str, str]) -> Iterator[None]:
    """Tells what is wrong with arguments by the names that the caller gave them under, not by those of calls within."""
    try:
        yield
    except (ArgumentError, ArgumentTypeError) as error:
        blamed, _, reason = str(error).partition(": ")
        given = ", ".join(names.get(name, name) for name in blamed.split(", "))
        if given == blamed:
            raise
        raise type(error)(f"{given}: {reason}") from None
