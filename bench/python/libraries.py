"""The other libraries: None, and a line on standard error, where one cannot be imported."""

import ctypes
import sys


def open3d():
    """Open3D, whose RaycastingScene runs on Embree in its robust mode."""
    try:
        # Open3D needs libusb, which few machines have installed.
        import libusb_package

        ctypes.CDLL(str(libusb_package.get_library_path()), ctypes.RTLD_GLOBAL)
        import open3d as package
    except (ImportError, OSError) as error:
        return say(f"going on without Open3D: {error}")
    return package


def trimesh():
    """trimesh with embreex, or else it would trace rays in numpy."""
    try:
        import embreex  # noqa: F401
        import trimesh as package
    except (ImportError, OSError) as error:
        return say(f"going on without trimesh: {error}")
    return package


def say(line):
    print(line, file=sys.stderr, flush=True)
