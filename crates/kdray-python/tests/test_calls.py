"""How calls are carried out: threads, progress, interrupts."""

import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from conftest import CUBE_FACES, CUBE_VERTICES, random_rays, sphere

import kdray
from kdray.errors import renamed
from kdray.warning import warn


def test_threads_change_nothing(ball, monkeypatch):
    rays = random_rays(20_000)
    one = ball.closest_hit(rays, threads=1)
    every = ball.all_hits(rays, threads=1)
    for threads in (2, 3, 8):
        np.testing.assert_array_equal(ball.closest_hit(rays, threads=threads).t, one.t)
        np.testing.assert_array_equal(ball.all_hits(rays, threads=threads).u, every.u)
    monkeypatch.setenv("KDRAY_THREADS", "3")
    np.testing.assert_array_equal(ball.closest_hit(rays).t, one.t)


def test_the_environment_says_how_many_threads():
    program = (
        "import kdray, numpy as np, os, time\n"
        "scene = kdray.Scene([[0, 0, 2], [1, 0, 2], [0, 1, 2]], [[0, 1, 2]])\n"
        "scene.any_hit(np.ones((5000, 6)))\n"
        "time.sleep(0.2)\n"
        "names = [open(f'/proc/self/task/{task}/comm').read() for task in os.listdir('/proc/self/task')]\n"
        "print(sum(name.startswith('kdray') for name in names))\n"
    )
    if not os.path.exists("/proc/self/task"):
        pytest.skip("the system does not list threads")
    for variables, expected in [
        ({"KDRAY_THREADS": "3"}, 3),
        ({"RAYON_NUM_THREADS": "4"}, 4),
        ({"KDRAY_THREADS": "2", "RAYON_NUM_THREADS": "5"}, 2),
    ]:
        others = {k: v for k, v in os.environ.items() if k not in ("KDRAY_THREADS", "RAYON_NUM_THREADS")}
        run = [sys.executable, "-c", program]
        told = subprocess.run(run, env=others | variables, capture_output=True, text=True, check=True)
        assert int(told.stdout) == expected


def test_other_threads_run_meanwhile(large):
    rays = random_rays(400_000)
    counted, done = 0, threading.Event()

    def ask():
        large.all_hits(rays, threads=1)
        done.set()

    asking = threading.Thread(target=ask)
    asking.start()
    while not done.is_set():
        counted += 1
        time.sleep(0.001)
    asking.join()
    assert counted > 20, "this thread hardly came to run"


def test_many_threads_may_ask_and_the_first_builds():
    scene, rays = kdray.Scene(*sphere(40)), random_rays(5000)
    with ThreadPoolExecutor(8) as threads:
        answers = list(threads.map(lambda _: scene.closest_hit(rays).t, range(8)))
    for answer in answers:
        np.testing.assert_array_equal(answer, answers[0])


@pytest.mark.parametrize("way", ["this thread", "another thread"])
def test_a_call_does_not_wait_for_another(large, way):
    told, many, few = [], np.broadcast_to(random_rays(1)[0], (10**8, 6)), random_rays(2000)
    expected = large.any_hit(few, threads=1)

    def tell(done, total):
        """Asks once, and ends the call when it is told again, if the call goes on."""
        told.append(done)
        if len(told) > 1 and done < total:
            raise LookupError("goes on")
        if len(told) == 1 and way == "this thread":
            np.testing.assert_array_equal(large.any_hit(few, threads=1), expected)
        elif len(told) == 1:
            with ThreadPoolExecutor(1) as other:
                np.testing.assert_array_equal(other.submit(large.any_hit, few, threads=1).result(), expected)

    with pytest.raises(LookupError, match="goes on"):
        large.any_hit(many, threads=1, progress=tell)


def test_threads_are_not_shared_by_calls_but_kept_for_the_next():
    if not os.path.exists("/proc/self/task"):
        pytest.skip("the system does not list threads")
    program = (
        "import kdray, numpy as np, os\n"
        "scene = kdray.Scene([[0, 0, 2], [1, 0, 2], [0, 1, 2]], [[0, 1, 2]])\n"
        "few, many = np.ones((5000, 6)), np.broadcast_to(np.ones(6), (10**8, 6))\n"
        "def workers():\n"
        "    names = {task: open(f'/proc/self/task/{task}/comm').read() for task in os.listdir('/proc/self/task')}\n"
        "    return {task for task, name in names.items() if name.startswith('kdray')}\n"
        "def tell(done, total):\n"
        "    assert len(workers()) == 1\n"
        "    scene.any_hit(few, threads=1)\n"
        "    both.update(workers())\n"
        "    raise LookupError\n"
        "both = set()\n"
        "try:\n"
        "    scene.any_hit(many, threads=1, progress=tell)\n"
        "except LookupError:\n"
        "    scene.any_hit(few, threads=1)\n"
        "print(len(both), both == workers())\n"
    )
    told = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert told.stdout.split() == ["2", "True"]


def counted_tasks(program, variables):
    """What a program prints that may call ``tasks``: how many threads it has more than before its first call."""
    if not os.path.exists("/proc/self/task"):
        pytest.skip("the system does not list threads")
    before = (
        "import kdray, numpy as np, os, pickle, time\n"
        "first = len(os.listdir('/proc/self/task'))\n"
        "tasks = lambda: len(os.listdir('/proc/self/task')) - first\n"
        "triangle = [[0, 0, 2], [1, 0, 2], [0, 1, 2]], [[0, 1, 2]]\n"
        "many = np.broadcast_to(np.ones(6), (10**8, 6))\n"
    )
    run = [sys.executable, "-c", before + program]
    told = subprocess.run(run, env=os.environ | variables, capture_output=True, text=True)
    assert told.returncode == 0, told.stderr
    return [int(word) for word in told.stdout.split()]


@pytest.mark.parametrize(("threads", "expected"), [("1", 1), ("2", 2), ("None", 3)])
@pytest.mark.parametrize(
    ("query", "use"),
    [
        ("closest_hit", "hits.normal"),
        ("closest_hit", "hits.position"),
        ("closest_hit", "hits[:4000].normal, hits[:4000].position"),
        ("closest_hit", "pickle.dumps(hits)"),
        ("all_hits", "hits.normal, hits.position"),
        ("closest_point", "hits.normal"),
        ("closest_point", "pickle.dumps(hits)"),
    ],
)
def test_normals_and_positions_are_computed_on_the_threads_of_the_query(query, use, threads, expected):
    rows = "[0.25, 0.25, 0]" if query == "closest_point" else "[0.25, 0.25, 0, 0, 0, 1]"
    program = (
        f"scene = kdray.Scene(*triangle).build(threads={threads})\n"
        f"hits = scene.{query}(np.tile({rows}, (5000, 1)), threads={threads})\n"
        f"{use}\n"
        "print(tasks())\n"
    )
    assert counted_tasks(program, {"KDRAY_THREADS": "3"}) == [expected]


@pytest.mark.parametrize(
    ("threads", "expected"), [("None", [4, 6, 7, 8, 9]), ("1", [1, 2, 3, 4, 5]), ("4", [4, 8, 12, 16, 20])]
)
def test_calls_at_once_have_fewer_threads_each_unless_they_say_how_many(threads, expected):
    program = (
        f"scene = kdray.Scene(*triangle).build(threads={threads})\n"
        "told = []\n"
        "def tell(done, total):\n"
        "    told.append(tasks())\n"
        "    if len(told) < 5:\n"
        f"        scene.any_hit(many, threads={threads}, progress=tell)\n"
        "    raise LookupError\n"
        "try:\n"
        f"    scene.any_hit(many, threads={threads}, progress=tell)\n"
        "except LookupError:\n"
        "    print(*told)\n"
    )
    assert counted_tasks(program, {"KDRAY_THREADS": "4"}) == expected


def test_idle_threads_are_few_and_those_used_last():
    if not hasattr(os, "sched_setaffinity"):
        pytest.skip("the system does not say on which processors a process runs")
    # What was ended takes a while to be gone.
    program = (
        "os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})\n"
        "def settled(count):\n"
        "    end = time.monotonic() + 30\n"
        "    while tasks() != count and time.monotonic() < end:\n"
        "        time.sleep(0.01)\n"
        "    return tasks()\n"
        "scene = kdray.Scene(*triangle).build(threads=1)\n"
        "def ask(threads):\n"
        "    scene.any_hit(many[:5000], threads=threads)\n"
        "def tell(done, total):\n"
        "    ask(1), ask(1)\n"
        "    raise LookupError\n"
        "try:\n"
        "    scene.any_hit(many, threads=1, progress=tell)\n"
        "except LookupError:\n"
        "    print(settled(2))\n"
        "for threads in (2, 5, 3, 40, 1):\n"
        "    ask(threads)\n"
        "    print(settled(threads))\n"
    )
    assert counted_tasks(program, {}) == [2, 2, 5, 3, 40, 1]


def test_what_says_how_many_threads_is_blamed_if_the_system_has_none():
    program = (
        "import kdray, numpy as np\n"
        "scene = kdray.Scene([[0, 0, 2], [1, 0, 2], [0, 1, 2]], [[0, 1, 2]])\n"
        "try:\n"
        "    scene.any_hit(np.ones((5000, 6)), threads={threads})\n"
        "except kdray.KdrayError as error:\n"
        "    print(type(error).__name__, error)\n"
    )
    # As large as no memory is.
    stack = {"RUST_MIN_STACK": str(1 << 50)}
    others = {k: v for k, v in os.environ.items() if k not in ("KDRAY_THREADS", "RAYON_NUM_THREADS")}
    for threads, variables, expected in [
        (2, {"KDRAY_THREADS": "3"}, "ArgumentError threads: the system does not start"),
        (None, {"KDRAY_THREADS": "3"}, "ArgumentError KDRAY_THREADS: the system does not start"),
        (None, {}, "KdrayError the system does not start"),
    ]:
        run = [sys.executable, "-c", program.format(threads=threads)]
        told = subprocess.run(run, env=others | stack | variables, capture_output=True, text=True, check=True)
        assert told.stdout.startswith(expected), told.stdout


@pytest.mark.parametrize("query", ["closest_hit", "any_hit", "count", "all_hits"])
def test_an_interrupt_ends_a_query(large, query):
    # Strides of zero: no end of rays, and no memory.
    rays = np.broadcast_to(random_rays(1)[0], (10**9 if query != "all_hits" else 10**8, 6))
    if query in ("closest_hit", "count"):
        rays = rays[: 10**8]
    previous = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        started = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            getattr(large, query)(rays, threads=1)
        assert time.monotonic() - started < 3
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, previous)
    assert large.any_hit(rays[0])


def test_an_interrupt_ends_a_build():
    scene = kdray.Scene(*sphere(300))
    previous = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        with pytest.raises(KeyboardInterrupt):
            scene.build("best", threads=1)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, previous)
    assert not scene.is_built and len(scene) == 4 * 300 * 299
    scene.build("fast")


def test_progress_is_told(ball):
    told = []
    ball.closest_hit(random_rays(200_000), progress=lambda done, total: told.append((done, total)), threads=1)
    assert told[-1] == (200_000, 200_000)
    assert all(total == 200_000 for _, total in told) and told == sorted(told)
    told.clear()
    kdray.Scene(*sphere(30)).build(progress=lambda done, total: told.append((done, total)))
    assert told[-1][0] == told[-1][1] > 0


def test_progress_of_few_is_told():
    ball, told = kdray.Scene(*sphere(10)), []
    ball.count(random_rays(3), progress=lambda done, total: told.append((done, total)))
    ball.contains(random_rays(4)[:, :3], progress=lambda done, total: told.append((done, total)))
    assert (3, 3) in told and told[-1] == (4, 4)


def test_what_the_progress_function_raises_ends_the_call(large):
    def tell(done, total):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        large.any_hit(np.broadcast_to(random_rays(1)[0], (10**9, 6)), progress=tell)


def test_a_progress_function_that_asks_its_own_scene_is_told():
    scene = kdray.Scene(*sphere(30))
    with pytest.raises(kdray.SceneError, match="being built"):
        scene.build(progress=lambda done, total: scene.bounds)
    assert not scene.is_built and scene.build().bounds is not None


def test_progress_by_tqdm(ball, capsys, monkeypatch):
    ball.any_hit(random_rays(5000), progress=True)
    assert "5.00k/5.00k" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    with pytest.raises(kdray.UnsupportedError, match="pip install tqdm"):
        ball.any_hit(random_rays(5), progress=True)


def test_a_fork_can_ask():
    if not hasattr(os, "fork"):
        pytest.skip("the system does not fork")
    program = (
        "import kdray, numpy as np, os, sys\n"
        "scene = kdray.Scene([[0, 0, 2], [1, 0, 2], [0, 1, 2]], [[0, 1, 2]])\n"
        "rays = np.tile([0.25, 0.25, 0, 0, 0, 1], (5000, 1))\n"
        "scene.any_hit(rays, threads=2)\n"
        "child = os.fork()\n"
        "ok = scene.any_hit(rays, threads=2).all()\n"
        "sys.exit(not ok) if child == 0 else sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True, timeout=30)


def test_meshes_of_other_packages():
    class Trimesh:
        vertices, faces = CUBE_VERTICES.astype(float), CUBE_FACES

    class Legacy:
        vertices, triangles = CUBE_VERTICES.astype(float), CUBE_FACES.astype(np.int32)

    class Tensor:
        def __init__(self, array):
            self.array = array

        def numpy(self):
            return self.array

    class Attributes(dict):
        __getattr__ = dict.__getitem__

    class Modern:
        vertex = Attributes(positions=Tensor(CUBE_VERTICES))
        triangle = Attributes(indices=Tensor(CUBE_FACES))

    for mesh, dtype in [(Trimesh(), np.float64), (Legacy(), np.float64), (Modern(), np.float32)]:
        scene = kdray.Scene.of(mesh)
        assert scene.dtype == dtype and scene.count([0.3, 0.2, -1, 0, 0, 1]) == 2
    assert kdray.Scene.of(Trimesh(), dtype=np.float32).dtype == np.float32


def test_modules_beside_the_package_are_imported_where_they_are_named():
    program = (
        "import sys, kdray\n"
        "names = ['kdray.dask', 'kdray.open3d', 'kdray.trimesh']\n"
        "assert not set(names) & set(sys.modules)\n"
        "kdray.open3d.RaycastingScene(), kdray.trimesh.RayMeshIntersector, kdray.dask.closest_hit\n"
        "assert set(names) < set(sys.modules)\n"
        "assert not hasattr(kdray, 'pytorch3d')\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


def test_a_module_whose_package_is_missing_is_no_attribute():
    program = (
        "import sys, kdray\n"
        "assert {'dask', 'open3d', 'trimesh', 'Scene', '__name__'} <= set(dir(kdray))\n"
        "sys.modules['dask'] = None\n"
        "assert not hasattr(kdray, 'dask') and hasattr(kdray, 'open3d')\n"
        "try:\n"
        "    kdray.dask\n"
        "except AttributeError as error:\n"
        "    assert 'dask' in str(error) and isinstance(error.__cause__, ModuleNotFoundError), error\n"
        "try:\n"
        "    import kdray.dask\n"
        "except ModuleNotFoundError as error:\n"
        "    assert error.name.partition('.')[0] == 'dask', error.name\n"
        "else:\n"
        "    raise AssertionError\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


def test_warnings_point_to_the_caller_through_decorators():
    decorated = renamed({"limit": "max_hits"})(warn)
    with pytest.warns(UserWarning, match="max_hits") as warned:
        warn("max_hits: one")
        decorated("max_hits: another")
        renamed({})(decorated)("max_hits: a third")
    assert [warning.filename for warning in warned] == [__file__] * 3


def test_importing_is_quick_and_needs_numpy_alone():
    program = (
        "import time, sys\n"
        "import numpy\n"
        "before = set(sys.modules)\n"
        "start = time.perf_counter()\n"
        "import kdray\n"
        "took = time.perf_counter() - start\n"
        "others = {name.split('.')[0] for name in set(sys.modules) - before}\n"
        "print(took, *others & {'tqdm', 'trimesh', 'open3d', 'dask', 'PIL', 'scipy', 'matplotlib'})\n"
    )
    run = [sys.executable, "-c", program]
    tries = [subprocess.run(run, capture_output=True, text=True, check=True).stdout.split() for _ in range(3)]
    assert all(len(words) == 1 for words in tries), "something heavy was imported"
    assert min(float(words[0]) for words in tries) < 0.1
