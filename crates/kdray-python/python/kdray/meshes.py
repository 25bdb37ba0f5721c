"""Triangles of other packages' meshes, told by what they have; none of those packages is imported."""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike

from .errors import ArgumentTypeError


def triangles_of(name: str, mesh: Any, others: str) -> tuple[ArrayLike, ArrayLike]:
    """Vertices and faces of a trimesh.Trimesh, or of an Open3D mesh of either kind.

    ``name`` is what the caller calls it, ``others`` what else the caller may give.
    """
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return mesh.vertices, mesh.faces
    vertex, triangle = getattr(mesh, "vertex", None), getattr(mesh, "triangle", None)
    if vertex is not None and triangle is not None:
        return vertex.positions.numpy(), triangle.indices.numpy()
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):
        return mesh.vertices, mesh.triangles
    text = f"give a trimesh.Trimesh, an open3d TriangleMesh, or {others}"
    raise ArgumentTypeError(f"{name}: {type(mesh).__name__} has no triangles that kdray knows of; {text}")
