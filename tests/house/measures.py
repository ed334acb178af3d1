#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the code and the documents to limits (docs/decisions/0068-limits-that-guide.md) and lists what exceeds them.

Here: the size of functions, repeated lines and knots. declarations.py: the size of classes and doc lines. texts.py: the
width of lines and the length of sentences. Except for texts, only the product is measured: the folders of PARTS.
lizard measures functions; tests/support/get_tools.sh fetches it. Usage: measures.py ROOT
"""
import os
import pathlib
import re
import sys

import declarations
import texts

MOST_LINES_P95 = 26         # of a function
MOST_LINES = 60
MOST_COMPLEXITY_P95 = 6     # cyclomatic
REPEATED_LINES = 10         # so many equal lines of code, one after another, are a repetition
TABLES = ("water_lobes_table.cpp",)  # data

PARTS = ("common", "capture", "master", "releases", "commands", "render_node",
         "calibration", "console", "drawings", "guests")
SUFFIXES = {".h", ".cpp", ".proto", ".py", ".glsl", ".vert", ".frag", ".comp"}


def product_files(root):
    return sorted(path for part in PARTS for path in (root / part).rglob("*")
                  if path.suffix in SUFFIXES and "__pycache__" not in path.parts)


def code_lines(path):
    """(line number, text) of each line except blank lines, comments, includes and brackets that stand alone."""
    comment = "#" if path.suffix == ".py" else "//"
    for number, line in enumerate(map(str.strip, path.read_text().splitlines()), 1):
        if len(line) > 3 and not line.startswith((comment, "#include")):
            yield number, line


def repetitions(files):
    """Places where REPEATED_LINES lines of code stand a second time."""
    seen = {}
    for path in files:
        if path.name in TABLES:
            continue
        lines = list(code_lines(path))
        after = 0  # windows of one repetition are reported once
        for i in range(len(lines) - REPEATED_LINES + 1):
            window = tuple(text for _, text in lines[i:i + REPEATED_LINES])
            first = seen.setdefault(window, (path, lines[i][0], i))
            if first[0] == path and first[2] == i or i < after:
                continue
            after = i + REPEATED_LINES
            yield f"{path}:{lines[i][0]} repeats {first[0]}:{first[1]}"


def inclusions(root, files):
    """File -> files that it includes, as paths from the root."""
    include = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)
    return {str(path.relative_to(root)): set(include.findall(path.read_text()))
            for path in files if path.suffix in {".h", ".cpp"}}


def of_folders(edges):
    """The same inclusions between folders."""
    folders = {}
    for path, included in edges.items():
        home = os.path.dirname(path)
        folders.setdefault(home, set()).update(set(map(os.path.dirname, included & edges.keys())) - {home})
    return folders


def cycle(edges):
    """One cycle as a list whose last is its first, or an empty list."""
    done = set()

    def visit(place, way):
        if place in way:
            return way[way.index(place):] + [place]
        if place in done or place not in edges:
            return []
        found = next(filter(None, (visit(there, way + [place]) for there in sorted(edges[place]))), [])
        done.add(place)
        return found

    return next(filter(None, (visit(place, []) for place in sorted(edges))), [])


def knots(edges):
    for one in cycle(edges), cycle(of_folders(edges)):
        if one:
            yield "a knot: " + " includes ".join(one)


def percentile_95(values):
    return sorted(values)[int(0.95 * (len(values) - 1))]


def function_problems(functions):
    """`functions` as lizard lists them."""
    for function in functions:
        if function.length > MOST_LINES:
            yield (f"{function.filename}:{function.start_line} {function.name} has {function.length} lines, "
                   f"more than {MOST_LINES}: part it")
    lines = percentile_95([function.length for function in functions])
    complexity = percentile_95([function.cyclomatic_complexity for function in functions])
    print(f"functions {len(functions)}: 95 % have at most {lines} lines and a complexity of {complexity}")
    if lines > MOST_LINES_P95:
        yield f"95 % of the functions have up to {lines} lines, more than {MOST_LINES_P95}"
    if complexity > MOST_COMPLEXITY_P95:
        yield f"95 % of the functions have a complexity up to {complexity}, more than {MOST_COMPLEXITY_P95}"


def measured_functions(files):
    """What lizard finds; None where it is not installed."""
    try:
        import lizard
    except ImportError:
        print("SKIPPED: no lizard (tests/support/get_tools.sh fetches it): functions are not measured", file=sys.stderr)
        return None
    return [function for path in files if path.suffix in {".h", ".cpp"}
            for function in lizard.analyze_file(str(path)).function_list]


def problems(root):
    files = product_files(root)
    print(f"{len(files)} files in {len({path.parent for path in files})} folders")
    yield from repetitions(files)
    yield from knots(inclusions(root, files))
    functions = measured_functions(files)
    if functions is not None:
        yield from function_problems(functions)
    elif os.environ.get("CI"):
        yield "no lizard"
    yield from declarations.problems(files)
    yield from texts.problems(root)


def main():
    root = pathlib.Path(sys.argv[1])
    sys.path.insert(0, str(root / "build/tools"))
    found = list(problems(root))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
