#!/usr/bin/env python3
"""Fills the figures of the documents from docs/measurements/*.csv, or says with --check where they differ.

A block is a comment with a template and the text that was made of it:

<!-- figures: amd-epyc | a step of the fish | {dynamics_step us 2} µs | for 60 1000: | a tick of {@} fish |
{mind_tick/fish:@ p50_ms 2} ms | --> | a step of the fish | 6.1 µs | | a tick of 60 fish | 0.013 ms | | a tick of 1 000
fish | 0.19 ms | <!-- end -->

{ROW WHAT DIGITS} is a number of docs/measurements/amd-epyc.csv: ROW a benchmark without its /iterations:, /manual_time
and the like; WHAT the column cpu_ns in a unit (ns, us, ms, s) or a counter, which may be multiplied (per_fish*1e9);
DIGITS how many are significant. {ROW WHAT / ROW WHAT DIGITS} is a ratio. """

import csv
import math
import re
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
# Units of the time column, from its nanoseconds.
UNITS = {"ns": 1.0, "us": 1e-3, "ms": 1e-6, "s": 1e-9}
# A template line that is repeated for each of some numbers.
LOOP = re.compile(r"^for ([\d ]+): (.*)$", re.MULTILINE)
# Groups: the comment with its template; machine; template; the text made of it; the end mark.
BLOCK = re.compile(r"(<!-- figures: (\S+)\n(.*?)-->\n)(.*?)(<!-- end -->)", re.DOTALL)
# What Google Benchmark adds to a name for its settings.
SUFFIX = re.compile(r"/(iterations:\d+|manual_time|process_time|real_time)\b")


def rows_of(machine):
    """The figures of a machine by benchmark and counter; the time has the counter ""."""
    rows = {}
    with open(DOCS / "measurements" / f"{machine}.csv", newline="") as file:
        for row in csv.DictReader(file):
            key = SUFFIX.sub("", row["benchmark"]), row["counter"]
            rows[key] = float(row["value"] if row["counter"] else row["cpu_ns"])
    return rows


# "ROW WHAT" as a number. KeyError where the measurements have no such row or counter.
def quantity(text, rows):
    row, what = text.split()
    counter, _, factor = what.partition("*")
    if counter in UNITS:
        return rows[row, ""] * UNITS[counter]
    return rows[row, counter] * float(factor or 1)


# Rounded to so many decimals (negative: to tens, hundreds, ...), with a space for each thousand.
def spaced(value, decimals):
    return f"{round(value, decimals):,.{max(decimals, 0)}f}".replace(",", " ")


# The text for one {field}: a number as it is, a quantity, or a quantity divided by others, with so many significant
# digits.
def number(field, rows):
    if field.isdecimal():
        return spaced(float(field), 0)
    quantities, digits = field.rsplit(maxsplit=1)
    first, *others = (quantity(part, rows) for part in quantities.split(" / "))
    value = first / math.prod(others)
    return spaced(value, int(digits) - 1 - math.floor(math.log10(abs(value))) if value else 0)


# Repeats each "for" line with @ replaced.
def unrolled(template):
    return LOOP.sub(lambda loop: "\n".join(loop[2].replace("@", each) for each in loop[1].split()), template)


# The text of a document with the figures of all its blocks made anew. Exits where a figure is not in the measurements.
def filled(path, text):
    def fill(block):
        head, machine, template, _, end = block.groups()
        rows = rows_of(machine)
        try:
            return head + re.sub(r"\{(.+?)\}", lambda field: number(field[1], rows), unrolled(template)) + end
        except KeyError as missing:
            row, counter = missing.args[0]
            sys.exit(f"{path}: docs/measurements/{machine}.csv has no {counter or 'time'} of {row}: name another row")

    return BLOCK.sub(fill, text)


# Without --check writes the documents that differ; with it writes nothing and fails if any differs.
def main():
    stale = []
    for path in sorted([*DOCS.rglob("*.md"), DOCS.parent / "README.md"]):
        before = path.read_text(encoding="utf-8")
        after = filled(path.relative_to(DOCS.parent), before)
        if after == before:
            continue
        stale.append(str(path.relative_to(DOCS.parent)))
        if "--check" not in sys.argv[1:]:
            path.write_text(after, encoding="utf-8")
    if stale and "--check" in sys.argv[1:]:
        sys.exit(f"figures differ from docs/measurements in {', '.join(stale)}: run docs/figures.py")


main()
