#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the size of the product's code to limits: files, folders, functions, comments, repeated lines.

Product code is what stands in common, capture, master, commands, render_node, calibration and console. Functions are measured by lizard, which
tests/support/get_tools.sh fetches. Usage: measures.py ROOT
"""
import os
import pathlib
import sys

MOST_FILES = 597            # .h .cpp .proto .py and shaders
MOST_FOLDERS = 39           # that hold such files
MOST_LINES_P95 = 26         # of a function
MOST_LINES = 60
MOST_COMPLEXITY_P95 = 6     # cyclomatic
LEAST_COMMENT_SHARE = 0.12  # comment lines / (comment + code lines)
REPEATED_LINES = 10         # so many equal lines of code, one after another, are a repetition
TABLES = ("water_lobes_table.cpp",)  # data

PARTS = ("common", "capture", "master", "commands", "render_node", "calibration", "console")
SUFFIXES = {".h", ".cpp", ".proto", ".py", ".glsl", ".vert", ".frag", ".comp"}


def product_files(root):
    return sorted(path for part in PARTS for path in (root / part).rglob("*")
                  if path.suffix in SUFFIXES and "__pycache__" not in path.parts)


def is_comment(line, suffix):
    return line.startswith("#" if suffix == ".py" else "//")


def comment_share(files):
    """Whole lines of comment, without the line of the licence, against lines that are not blank."""
    comments = code = 0
    for path in files:
        for line in map(str.strip, path.read_text().splitlines()):
            if not line or "SPDX" in line:
                continue
            if is_comment(line, path.suffix):
                comments += 1
            else:
                code += 1
    return comments / (comments + code)


def code_lines(path):
    """(line number, text) of what is neither blank, comment, include nor a lone bracket."""
    for number, line in enumerate(map(str.strip, path.read_text().splitlines()), 1):
        if len(line) > 3 and not is_comment(line, path.suffix) and not line.startswith("#include"):
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


def percentile_95(values):
    return sorted(values)[int(0.95 * (len(values) - 1))]


def function_problems(files):
    try:
        import lizard
    except ImportError:
        missing = "no lizard (tests/support/get_tools.sh fetches it): the sizes of functions are not measured"
        if os.environ.get("CI"):
            yield missing
        print("SKIPPED:", missing, file=sys.stderr)
        return
    functions = [function for path in files if path.suffix in {".h", ".cpp"}
                 for function in lizard.analyze_file(str(path)).function_list]
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


def problems(root):
    files = product_files(root)
    folders = {path.parent for path in files}
    share = comment_share(files)
    print(f"{len(files)} files in {len(folders)} folders, {share:.1%} comment")
    if len(files) > MOST_FILES:
        yield f"{len(files)} files, more than {MOST_FILES}: merge what is read together"
    if len(folders) > MOST_FOLDERS:
        yield f"{len(folders)} folders with code, more than {MOST_FOLDERS}: merge neighbours"
    if share < LEAST_COMMENT_SHARE:
        yield f"{share:.1%} of the lines are comment, fewer than {LEAST_COMMENT_SHARE:.0%}"
    yield from repetitions(files)
    yield from function_problems(files)


def main():
    root = pathlib.Path(sys.argv[1])
    sys.path.insert(0, str(root / "build/tools"))
    found = list(problems(root))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
