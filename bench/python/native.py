"""The Rust library beside the package, on the same rays: both on one thread, by processor time."""

import json
import statistics
import subprocess
import time

import numpy as np
from timing import ratio

QUERIES = {"closest": "closest_hit", "any": "any_hit", "all": "all_hits"}
"""What the bench calls a query, and what the package does."""


RUNS = 3
"""How often each is run in a round, one after the other, as the program does; the median counts."""


def overhead(program, folder, cases, rounds):
    """How many times as long the package takes as the library, for each case and query.

    ``cases`` are a name, the mesh, the kdray.Scene and rays. ``program`` is kdray-bench, which answers them by the
    library's batches, and has rays in the library's own form before the clock starts.
    """
    for name, mesh, _, rays in cases:
        case = folder / name
        case.mkdir(parents=True, exist_ok=True)
        for key, array in {"vertices": mesh.vertices, "triangles": mesh.faces, "rays": rays}.items():
            np.save(case / f"{key}.npy", array)
    own, native = {}, {}
    for _ in range(rounds):
        command = [program, "peers", folder, "--peers", "kdray batch"]
        subprocess.run(command, check=True, capture_output=True)
        for name, _, scene, rays in cases:
            about = json.loads((folder / name / "kdray, batch" / "about.json").read_text())
            for query, method in QUERIES.items():
                seconds = statistics.median(timed(getattr(scene, method), rays) for _ in range(RUNS))
                own.setdefault((name, query), []).append(seconds)
                native.setdefault((name, query), []).append(about[query])
    return {key: ratio(own[key], native[key]) for key in own}


def timed(method, rays):
    begin = time.process_time()
    method(rays, threads=1)
    return time.process_time() - begin
