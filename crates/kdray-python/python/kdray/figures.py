"""Figures of a scene, for people to look at."""

from __future__ import annotations

from html import escape
from typing import Any

_BAR = 24
"""How wide the longest bar of the histogram is, in units of the font's size."""


def as_html(figures: dict[str, Any]) -> str:
    """A table of figures, and the leaves at each depth as bars."""
    rows = [(name, value) for name, value in figures.items() if name != "leaves_at_depth"]
    cells = "".join(
        f"<tr><th style='text-align:left'>{escape(name.replace('_', ' '))}</th>"
        f"<td style='text-align:right'>{escape(_told(value))}</td></tr>"
        for name, value in rows
    )
    return f"<table><caption>kdray.Scene</caption>{cells}</table>{_histogram(figures)}"


def _told(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:,.3f}"
    if isinstance(value, int):
        return f"{value:,}"
    if isinstance(value, list):
        return ", ".join(f"{number:g}" for number in value)
    return "none" if value is None else str(value)


def _histogram(figures: dict[str, Any]) -> str:
    leaves = figures.get("leaves_at_depth")
    if not leaves:
        return ""
    bars = "".join(
        f"<tr><td style='text-align:right'>{depth}</td><td style='text-align:left'>"
        f"<div style='display:inline-block;height:0.8em;background:#4878a8;width:{_BAR * n / max(leaves):.2f}em'>"
        f"</div> {n:,}</td></tr>"
        for depth, n in enumerate(leaves)
        if n > 0
    )
    return f"<details><summary>leaves at each depth</summary><table>{bars}</table></details>"
