"""How long things take, in turns."""

import statistics
import time


def in_turns(runs, rounds, clocks):
    """Runs each function of a dict once a round, and begins with another one each time.

    Gives, for each, the seconds of all rounds by its clock, and the last answer.
    """
    names = list(runs)
    seconds, answers = {name: [] for name in names}, {}
    for turn in range(rounds):
        first = turn % len(names)
        for name in names[first:] + names[:first]:
            answers.pop(name, None)
            begin = clocks[name]()
            answers[name] = runs[name]()
            seconds[name].append(clocks[name]() - begin)
    return seconds, answers


def clock(name, threads):
    """By what time is told: of the processor on one thread, so that others on the machine matter less.

    kdray works on another thread than the one that asks, hence all threads of the process count; of others only the
    thread that asks, for Embree's idle threads spin. On several threads the wall clock counts.
    """
    if threads > 1:
        return time.perf_counter
    return time.process_time if name == "kdray" else time.thread_time


def ratio(others, own):
    """How many times as long others take: the median of the rounds."""
    return statistics.median(a / b for a, b in zip(others, own))
