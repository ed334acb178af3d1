#!/usr/bin/env python3
"""Holds the processor time of each suite against tests/budgets.csv: check_budgets.py build/dev.

A suite may take half as much again as its budget. Machines differ: where the median suite takes longer than its budget,
all budgets grow by as much. A machine that shares its processors with others differs from minute to minute: a fixed
piece of work, done beside each suite, tells by how much."""

import csv
import statistics
import sys
from pathlib import Path

FILE = "tests/budgets.csv"
GROWTH = 1.5
LEAST_SECONDS = 2.0  # what is shorter is start-up and noise


def read_budgets(path):
    with open(path, newline="") as file:
        return {row["suite"]: float(row["seconds"]) for row in csv.DictReader(file)}


def read_times(folder):
    """Suite -> seconds, and the milliseconds of the piece of work beside it, as timed.py wrote them."""
    return {path.name: tuple(map(float, path.read_text().split())) for path in Path(folder).iterdir()}


def at_one_speed(times):
    """Suite -> the seconds that it had taken if the machine had never been slower than beside the median suite."""
    median = statistics.median(piece for _, piece in times.values())
    return {suite: seconds * min(1, median / piece) for suite, (seconds, piece) in times.items()}


def slowness(taken, budgets):
    """How much longer than its budget the median suite takes, at least 1."""
    ratios = [taken[suite] / budgets[suite] for suite in taken.keys() & budgets.keys()
              if budgets[suite] > LEAST_SECONDS]
    return max(1.0, statistics.median(ratios)) if ratios else 1.0


def complaints(taken, budgets):
    factor = slowness(taken, budgets)
    lines = []
    for suite in sorted(taken.keys() | budgets.keys()):
        if suite not in taken:
            lines.append(f"{FILE}: there is no suite {suite}: remove its line")
        elif suite not in budgets:
            lines.append(f"{FILE}: the suite {suite} has no budget: add the line {suite},{taken[suite]:.0f}")
        else:
            budget = factor * max(budgets[suite], LEAST_SECONDS)
            if taken[suite] > GROWTH * budget:
                lines.append(
                    f"the suite {suite} took {taken[suite]:.0f} s of processor time, its budget is {budget:.0f} s: "
                             f"make it cheaper, or raise its line in {FILE} and say why")
    return lines


def main(build):
    times, budgets = read_times(Path(build) / "processor_time"), read_budgets(FILE)
    taken = at_one_speed(times)
    print(f"{'suite':<28}{'seconds':>9}{'budget':>9}   of processor time")
    for suite in sorted(taken, key=taken.get, reverse=True):
        print(f"{suite:<28}{taken[suite]:>9.1f}{budgets.get(suite, 0):>9.0f}")
    print(f"{'all':<28}{sum(taken.values()):>9.1f}{sum(budgets.values()):>9.0f}")
    if (factor := slowness(taken, budgets)) > 1:
        print(f"this machine takes {factor:.2f} times the budgets")
    wrong = complaints(taken, budgets)
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
