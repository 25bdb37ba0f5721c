"""Warnings that point to the line of a caller, however deep in the package they come up."""

from __future__ import annotations

import sys
import warnings
from types import FrameType


def warn(text: str) -> None:
    """Warns at the last line that is neither of this package nor of the decorators within it."""
    frame, level = sys._getframe(), 1
    while frame.f_back is not None and _is_within(frame):
        frame, level = frame.f_back, level + 1
    warnings.warn(text, stacklevel=level)


def _is_within(frame: FrameType) -> bool:
    """Whether this is a line of the package, or of ``contextlib``, whose decorators are between its lines."""
    names = frame.f_globals
    return names.get("__package__") == __package__ or names.get("__name__") == "contextlib"
