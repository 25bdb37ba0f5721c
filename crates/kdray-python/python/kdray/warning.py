"""Warnings that point to the line of a caller, however deep in the package they come up."""

from __future__ import annotations

import sys
import warnings


def warn(text: str) -> None:
    """Warns at the last line that is not of this package."""
    frame, level = sys._getframe(), 1
    while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
        frame, level = frame.f_back, level + 1
    warnings.warn(text, stacklevel=level)
