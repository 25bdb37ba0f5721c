"""The examples: they run, write a picture, are short, and are what the guide shows."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest

import kdray

CRATE = Path(__file__).parents[1]
GUIDE = CRATE.parents[1] / "docs" / "guide" / "python"
MUNICH = CRATE.parents[2] / "shared" / "scenes" / "city_munich.ply"

SIZES = {
    "contains": (990, 414),
    "depth_camera": (990, 360),
    "lidar": (900, 630),
    "section": (900, 414),
    "sky_view": (990, 396),
    "thickness": (630, 504),
}
"""The examples, and the width and height of their pictures."""


def started(name: str, folder: Path, *arguments: str) -> subprocess.Popen[str]:
    """An example that runs in a folder."""
    package = str(Path(kdray.__file__).parents[1])
    found = os.pathsep.join(filter(None, [package, os.environ.get("PYTHONPATH")]))
    environment = {**os.environ, "MPLBACKEND": "Agg", "PYTHONPATH": found}
    command = [sys.executable, "-W", "error", str(CRATE / "examples" / f"{name}.py"), *arguments]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    return subprocess.Popen(command, cwd=folder, env=environment, text=True, **pipes)


def picture_of(run: subprocess.Popen[str], path: Path) -> np.ndarray:
    """The picture (height, width, 3) that an example wrote, and nothing but that."""
    told, _ = run.communicate(timeout=120)
    assert run.returncode == 0, told
    assert told == ""
    assert [path] == list(path.parent.iterdir())
    return matplotlib.image.imread(path)[..., :3]


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[subprocess.Popen[str], Path]]:
    """All examples without a mesh, which run side by side: most of their time is Python's start."""
    folders = {name: tmp_path_factory.mktemp(name) for name in SIZES}
    return {name: (started(name, folder), folder) for name, folder in folders.items()}


def test_every_example_is_known():
    assert {path.stem for path in (CRATE / "examples").glob("*.py")} == set(SIZES)


@pytest.mark.parametrize("name", SIZES)
def test_picture(runs, name):
    run, folder = runs[name]
    assert_picture(picture_of(run, folder / f"{name}.png"), SIZES[name])


def test_lidar_in_a_city(tmp_path):
    if not MUNICH.exists():
        missing = f"{MUNICH} is not there"
        assert "CI" not in os.environ, missing
        pytest.skip(missing)
    run = started("lidar", tmp_path, str(MUNICH), "cloud.png")
    picture = picture_of(run, tmp_path / "cloud.png")
    assert_picture(picture, SIZES["lidar"])
    # Rings on the ground, in the colour of the lowest points, on the black of what no beam met.
    cloud = picture[:400, :760]
    near = lambda colour: np.abs(cloud - colour).max(axis=-1) < 0.1
    assert near([0.5, 0, 1]).mean() > 0.03 and near([0, 0, 0]).mean() > 0.3


@pytest.mark.parametrize("name", SIZES)
def test_length(name):
    lines = (CRATE / "examples" / f"{name}.py").read_text(encoding="utf-8").splitlines()
    assert len(lines) <= 40 and max(map(len, lines)) <= 115


@pytest.mark.parametrize("name", SIZES)
def test_guide(name):
    page = (GUIDE / f"{name.replace('_', '-')}.md").read_text(encoding="utf-8")
    code = (CRATE / "examples" / f"{name}.py").read_text(encoding="utf-8")
    assert f"```python\n{code}```\n" in page
    assert f"(python/{name.replace('_', '-')}.md)" in (GUIDE.parent / "python.md").read_text(encoding="utf-8")
    picture = GUIDE.parent / "pictures" / f"{name.replace('_', '-')}.png"
    assert f"(../pictures/{picture.name})" in page
    assert picture.stat().st_size < 150_000
    height, width, _ = matplotlib.image.imread(picture).shape
    assert (width, height) == SIZES[name]


def assert_picture(picture: np.ndarray, size: tuple[int, int]) -> None:
    """Of the size, and with more in it than axes and text."""
    height, width, _ = picture.shape
    assert (width, height) == size
    counts = np.bincount(((picture * 15).astype(int) @ [256, 16, 1]).reshape(-1))
    assert np.count_nonzero(counts) > 20 and counts.max() < 0.9 * counts.sum()
