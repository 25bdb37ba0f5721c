"""Words as callers give them."""

from __future__ import annotations

from typing import Optional

from .errors import ArgumentTypeError


def word(name: str, text: str) -> str:
    """A word, which may be one that nobody knows; ``name`` is what the caller calls it."""
    if not isinstance(text, str):
        raise ArgumentTypeError(f"{name}: give a word, not {text!r}")
    return text


def word_or_none(name: str, text: Optional[str]) -> Optional[str]:
    """The same, if there is one."""
    return None if text is None else word(name, text)
