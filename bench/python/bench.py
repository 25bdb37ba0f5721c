"""kdray's Python package beside trimesh and Open3D, and beside the Rust library (`cargo xtask bench python`).

The same rays and points for all, in turns; each in the form that the library wants, made before the clock starts.
Answers are compared with those of kdray to rays and points of f64 (`differ`), and at the stairs with what is known.
Tables of Markdown go to standard output.
"""

import argparse
import math
import os
import shutil
from pathlib import Path

import contenders
import kdray
import native
import numpy as np
import points
import rays
import resources
import scenes
from libraries import say
from timing import clock, in_turns, ratio

SETS = {"primary": lambda scene, traced, count: rays.primary(scene, count), "diffuse": rays.diffuse}

CLOSED = ("armadillo", "torus")
"""Scenes that have an inside."""

TARGETS = {
    ("closest", "trimesh"): 1.5, ("closest", "Open3D"): 1.5, ("closest", "trimesh, ids only"): 1.5,
    ("all", "trimesh"): 5, ("all", "Open3D"): 3,
    ("contains", "trimesh"): 10,
}  # fmt: skip
"""How many times as fast kdray shall be."""


def main():
    options = arguments()
    cases = [scenes.load(name) for name in options.scenes]
    table = Table(options)
    for scene in cases:
        beside(scene, options, table)
    for threads in options.threads:
        stairs(threads, options, table)
    print(f"{contenders.versions()}; {len(os.sched_getaffinity(0))} processors, median of {options.rounds} rounds\n")
    table.show()
    if options.native:
        against_native(cases, options)
    needs(options)


def arguments():
    parser = argparse.ArgumentParser(prog="cargo xtask bench python", description=__doc__)
    numbers = lambda text: [int(float(part)) for part in text.split(",")]  # noqa: E731
    parser.add_argument("--scenes", type=lambda text: text.split(","), default=scenes.default_names(),
                        help="names of ../shared/scenes/scenes.json, or torus")  # fmt: skip
    parser.add_argument("--sizes", type=numbers, default=[100_000, 1_000_000], help="how many rays, or points")
    parser.add_argument("--threads", type=numbers, default=[1, os.cpu_count() or 1])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--memory-rays", type=lambda text: int(float(text)), default=10_000_000)
    parser.add_argument("--native", type=Path, help=argparse.SUPPRESS)
    parser.add_argument("--work", type=Path, default=Path("cases"), help=argparse.SUPPRESS)
    options = parser.parse_args()
    options.threads = sorted(set(options.threads))
    return options


def beside(scene, options, table):
    """Rays and points of one scene."""
    exact = kdray.Scene(scene.vertices, scene.faces).build()
    for threads in options.threads:
        asked = [make(scene, threads) for make in contenders.everyone()]
        for size in options.sizes:
            for name, make in SETS.items():
                say(f"{scene.name}, {name}: {size} rays, {threads} threads")
                lines = make(scene, exact, size)
                where = (f"{scene.name}, {name}", size, threads)
                closest(exact, asked, lines, scene, where, options, table)
                all_hits(exact, asked, lines, where, options, table)
            if scene.name in CLOSED:
                inside(exact, asked, points.in_box(scene, size), scene, threads, options, table)


def closest(exact, asked, lines, scene, where, options, table):
    seconds, answers = measure(asked, "closest", lines, where[2], options.rounds)
    right = exact.closest_hit(lines.astype(np.float64)).t
    wrong = {}
    for it in asked:
        t = it.t(lines, answers[it.name])
        away = np.isinf(t) != np.isinf(right)
        with np.errstate(invalid="ignore"):
            away |= np.abs(t - right) > 2e-5 * (np.abs(right) + scene.diagonal)
        wrong[it.name] = int(np.count_nonzero(away))
    table.add("closest", where, seconds, wrong)


def all_hits(exact, asked, lines, where, options, table):
    seconds, answers = measure(asked, "all", lines, where[2], options.rounds)
    right = exact.count(lines.astype(np.float64))
    differ = lambda it: int(np.count_nonzero(it.counts(lines, answers[it.name]) != right))  # noqa: E731
    table.add("all", where, seconds, {it.name: differ(it) for it in asked if it.name in answers})


def inside(exact, asked, places, scene, threads, options, table):
    where = (f"{scene.name}, in its box", len(places), threads)
    seconds, answers = measure(asked, "contains", places, threads, options.rounds)
    right = exact.contains(places.astype(np.float64))
    wrong = {name: int(np.count_nonzero(answer != right)) for name, answer in answers.items()}
    table.add("contains", where, seconds, wrong)


def stairs(threads, options, table):
    """Points whose place is known, beside vertices, edges and faces."""
    solid = points.stairs()
    scene = points.surface(solid)
    asked = [make(scene, threads) for make in contenders.everyone()]
    places, right = points.beside(solid, options.sizes[0])
    seconds, answers = measure(asked, "contains", places, threads, options.rounds)
    wrong = {name: int(np.count_nonzero(answer != right)) for name, answer in answers.items()}
    table.add("contains", ("stairs, 1 ulp beside", len(places), threads), seconds, wrong)


def measure(asked, query, array, threads, rounds):
    able = [it for it in asked if getattr(it, query)]
    runs = {it.name: getattr(it, query)(array) for it in able}
    return in_turns(runs, rounds, {it.name: clock(it.name, threads) for it in able})


class Table:
    """What was measured, line by line; and at the end, by query, size and threads."""

    def __init__(self, options):
        self.others = [it.name for it in contenders.everyone() if it.name != "kdray"]
        self.options, self.lines, self.ratios = options, [], {}

    def add(self, query, where, seconds, wrong):
        place, size, threads = where
        own = seconds["kdray"]
        cells = [f"{query}: {place}", f"{size:,}", threads, f"{size / sorted(own)[len(own) // 2] / 1e6:.2f}"]
        for name in self.others:
            if name in seconds:
                times = ratio(seconds[name], own)
                self.ratios.setdefault((query, size, threads, name), []).append(times)
                cells.append(f"{times:.1f}")
            else:
                cells.append("–")
        cells += [f"{wrong[name]:,}" if name in wrong else "–" for name in ("kdray", *self.others)]
        self.lines.append(cells)
        say("  ".join(map(str, cells)))

    def show(self):
        to = [f"to {name}" for name in self.others]
        head = ["", "size", "threads", "M/s", *to, *(f"differ: {name}" for name in ("kdray", *self.others))]
        show(head, self.lines)
        means = {key: math.exp(sum(map(math.log, all)) / len(all)) for key, all in self.ratios.items()}
        lines = []
        for (query, size, threads, name), mean in means.items():
            wanted = TARGETS.get((query, name))
            verdict = "–" if wanted is None else f"{wanted} {'reached' if mean >= wanted else 'missed'}"
            least = min(self.ratios[query, size, threads, name])
            lines.append([query, name, f"{size:,}", threads, f"{mean:.2f}", f"{least:.2f}", verdict])
        show(["kdray is times as fast", "as", "size", "threads", "geometric mean", "least", "wanted"], lines)


def against_native(cases, options):
    say("the Rust library")
    chosen, size = [], min(size for size in options.sizes)
    for scene in cases:
        exact = kdray.Scene(scene.vertices, scene.faces).build()
        made = {name: make(scene, exact, size) for name, make in SETS.items()}
        chosen += [(f"{scene.name}, {name}", scene, exact, lines) for name, lines in made.items()]
    shutil.rmtree(options.work, ignore_errors=True)
    times = native.overhead(options.native, options.work, chosen, options.rounds)
    percent = lambda name, query: f"{100 * (times[name, query] - 1):+.0f} %"  # noqa: E731
    lines = [[name, *(percent(name, query) for query in native.QUERIES)] for name, *_ in chosen]
    show([f"over the Rust library, {size:,} rays, 1 thread", *native.QUERIES.values()], lines)


def needs(options):
    say("imports and memory")
    lines = []
    for module in ("kdray", "numpy"):
        wall, cpu = resources.import_seconds(module)
        lines.append([f"import {module}", f"{wall:.3f} s, {cpu:.3f} s of them processor time"])
    if not Path("/proc/self/status").exists():
        return show(["", "takes"], lines)
    for query in ("closest_hit", "all_hits"):
        found = resources.memory(query, options.memory_rays)
        mega = {key: round(value / 1e6) for key, value in found.items()}
        more = mega["peak"] - mega["input"] - mega["output"]
        text = f"{mega['input']} MB of rays, {mega['output']} MB of hits, {more} MB else at the peak"
        lines.append([f"{query}, {options.memory_rays:,} rays", text])
    return show(["", "takes"], lines)


def show(head, lines):
    """A table of Markdown; all but the first column to the right."""
    print("| " + " | ".join(map(str, head)) + " |")
    print("|---" + "|---:" * (len(head) - 1) + "|")
    for line in lines:
        print("| " + " | ".join(map(str, line)) + " |")
    print(flush=True)


if __name__ == "__main__":
    main()
