"""Whole numbers as callers give them."""

from __future__ import annotations

from typing import Optional

import numpy as np

from .errors import ArgumentError, ArgumentTypeError

ALL = 0xFFFF_FFFF
"""The mask of 32 bits that shares one with every other."""


def whole(name: str, number: int) -> int:
    """A whole number, as an int; ``name`` is what the caller calls it."""
    if isinstance(number, bool) or not isinstance(number, (int, np.integer)):
        raise ArgumentTypeError(f"{name}: give a whole number, not {number!r}")
    if not -(1 << 63) <= number < 1 << 63:
        raise ArgumentError(f"{name}: {number} is out of range")
    return int(number)


def whole_or_none(name: str, number: Optional[int]) -> Optional[int]:
    """The same, if there is one."""
    return None if number is None else whole(name, number)


def mask_bits(mask: int) -> int:
    """A mask of instances, or of the rays that see them."""
    bits = whole("mask", mask)
    if not 0 < bits <= ALL:
        raise ArgumentError("mask: give a number of 32 bits, of which at least one is set")
    return bits
