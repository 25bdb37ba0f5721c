"""Telling how far a long call is."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Callable, Optional, Union

from .errors import ArgumentTypeError, UnsupportedError

Progress = Union[bool, None, Callable[[int, int], object]]
"""``True`` for a bar by tqdm, or a function that is given what is done and what there is in all, now and then.

What the function raises ends the call.
"""


@contextmanager
def telling(progress: Progress, unit: str) -> Iterator[Optional[Callable[[int, int], object]]]:
    """The function to tell, while the call lasts."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        with _bar(unit) as told:
            yield told
    elif callable(progress):
        yield progress
    else:
        raise ArgumentTypeError("progress: give True, or a function of what is done and of all")


@contextmanager
def _bar(unit: str) -> Iterator[Callable[[int, int], object]]:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        text = "progress: True shows a bar by tqdm, which is not installed: pip install tqdm"
        raise UnsupportedError(text) from None
    with tqdm(unit=unit, unit_scale=True) as bar:

        def tell(done: int, total: int) -> None:
            bar.total = total
            bar.update(done - bar.n)

        yield tell
