"""What Open3D and trimesh answer to the rays of an attack (`cargo xtask attack --peers`).

Called with the folder of the cases. For each case and peer it writes the answers as arrays of numpy, and what
they took of this thread's processor time, as `bench/src/peers` does for others. All on one thread.
"""

import importlib.metadata
import json
import os
import statistics
import sys
import time
from pathlib import Path

os.environ["OMP_NUM_THREADS"] = "1"

import libraries
import numpy as np
from libraries import say

ROUNDS = 3


def open3d():
    """Open3D's RaycastingScene, which runs on Embree in its robust mode."""
    o3d = libraries.open3d()
    if o3d is None:
        return None

    def queries(vertices, triangles, rays):
        scene = o3d.t.geometry.RaycastingScene(nthreads=1)
        scene.add_triangles(o3d.core.Tensor(vertices), o3d.core.Tensor(triangles))
        rays = o3d.core.Tensor(rays)

        def all_hits():
            found = scene.list_intersections(rays, nthreads=1)
            return found["ray_splits"].numpy(), found["t_hit"].numpy()

        return {
            "closest": lambda: scene.cast_rays(rays, nthreads=1)["t_hit"].numpy(),
            "any": lambda: scene.test_occlusions(rays, nthreads=1).numpy(),
            "all": all_hits,
        }

    return "Open3D", o3d.__version__, queries


def trimesh():
    """trimesh on Embree; it finds all hits by casting rays again from behind each hit."""
    package = libraries.trimesh()
    if package is None:
        return None
    from trimesh.ray.ray_pyembree import RayMeshIntersector

    def queries(vertices, triangles, rays):
        mesh = package.Trimesh(vertices, triangles, process=False, validate=False)
        scene = RayMeshIntersector(mesh)
        origins, directions = rays[:, :3], rays[:, 3:]
        # What is prepared on the first call is not measured.
        scene.intersects_first(origins[:1], directions[:1])

        def closest():
            return np.where(scene.intersects_first(origins, directions) >= 0, 0, np.inf)

        def all_hits():
            _, ray_ids, places = scene.intersects_id(
                origins, directions, multiple_hits=True, max_hits=1000, return_locations=True
            )
            # Where the hits of a ray stand among those of others is an accident; their own order is kept.
            order = np.argsort(ray_ids, kind="stable")
            ray_ids, places = ray_ids[order], places[order]
            along = directions[ray_ids].astype(np.float64)
            t = np.sum((places - origins[ray_ids]) * along, axis=1) / np.sum(along * along, axis=1)
            return np.searchsorted(ray_ids, np.arange(len(rays) + 1)), t

        return {
            "closest": closest,
            "any": lambda: scene.intersects_any(origins, directions),
            "all": all_hits,
        }

    version = f"{package.__version__}, embreex {importlib.metadata.version('embreex')}"
    return "trimesh", version, queries


def timed(query):
    """The median time that a query takes, and its answer."""
    seconds = []
    for _ in range(ROUNDS):
        begin = time.thread_time()
        answer = query()
        seconds.append(time.thread_time() - begin)
    return statistics.median(seconds), answer


def write(folder, query, answer):
    if query == "closest":
        np.save(folder / "closest.npy", np.asarray(answer, "<f4").reshape(-1))
    elif query == "any":
        np.save(folder / "any.npy", np.asarray(answer, "u1").reshape(-1))
    else:
        splits, t = answer
        np.save(folder / "splits.npy", np.asarray(splits, "<u8"))
        np.save(folder / "t.npy", np.asarray(t, "<f4"))


def main(folder):
    peers = [peer for peer in (open3d(), trimesh()) if peer]
    for case in sorted(path.parent for path in Path(folder).glob("*/rays.npy")):
        arrays = [np.load(case / f"{name}.npy") for name in ("vertices", "triangles", "rays")]
        say(f"{case.name}: {len(arrays[2])} rays")
        for name, version, queries in peers:
            out = case / name
            out.mkdir(exist_ok=True)
            about = {"name": name, "version": version}
            for query, run in queries(*arrays).items():
                about[query], answer = timed(run)
                write(out, query, answer)
            (out / "about.json").write_text(json.dumps(about))


if __name__ == "__main__":
    main(sys.argv[1])
