"""What an import takes, and how much memory a call."""

import json
import statistics
import subprocess
import sys

IMPORT = """
import time
wall, cpu = time.perf_counter(), time.process_time()
import {module}
print(time.perf_counter() - wall, time.process_time() - cpu)
"""

MEMORY = r"""
import json, re, sys
from pathlib import Path
import numpy as np
import kdray
from scenes import torus

count, query = int(sys.argv[1]), sys.argv[2]
mesh = torus()
scene = kdray.Scene(mesh.vertices, mesh.faces).build()
rng = np.random.default_rng(10)
rays = np.empty((count, 6), np.float32)
# Not more than a part at once, or what makes the rays would take more than the call.
for part in np.array_split(rays, max(1, count // 100_000)):
    part[:] = rng.normal(size=part.shape)
hits = getattr(scene, query)(rays)
names = ["t", "u", "v", "primitive_id", "front"] + ["offsets", "counts"] * (query == "all_hits")
output = sum(getattr(hits, name).nbytes for name in names)
# Of Linux. What getrusage tells begins with what the process had that started this one.
peak = int(re.search(r"VmHWM:\s*(\d+)", Path("/proc/self/status").read_text())[1]) * 1024
print(json.dumps({"input": rays.nbytes, "output": output, "peak": peak}))
"""


def import_seconds(module, times=10):
    """The median wall time and the median processor time that an import takes in a new interpreter."""
    runs = [_python(IMPORT.format(module=module)).split() for _ in range(times)]
    return [statistics.median(float(run[which]) for run in runs) for which in (0, 1)]


def memory(query, count=10_000_000):
    """Bytes of rays, of their answer, and of all that a process has at its peak, with Python and the scene."""
    return json.loads(_python(MEMORY, str(count), query))


def _python(program, *arguments):
    run = [sys.executable, "-c", program, *arguments]
    folder = __file__.rpartition("/")[0]
    return subprocess.run(run, check=True, capture_output=True, text=True, cwd=folder).stdout
