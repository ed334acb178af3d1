#!/usr/bin/env python3
"""Fills in what studies of the fish print in the documents: docs/studies.py BEGINNING..., for all commands that begin
so ("aquarama study --seeds"). With --check says where a document's figures are of an earlier motor or earlier minds.

A mark is a comment with a command, a table of what it prints (all of it where none is named), and what moved the fish:

<!-- study: aquarama study chronicle reef.txtpb --hours 24 | table 1 | motor 6, minds 3, commit abcdef0 -->
...
<!-- end of study -->

What stands up to the end is replaced. A mark without an end stands before figures that people write in: they run its
command and enter versions and commit. Where the command has DIR it gets a folder; pictures that it leaves there and
docs/pictures has are copied. A mark that names no minds depends on the motor alone. Programs are those of build/show.
The commit that they are built from is entered, and outside docs nothing may have changed since."""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VERSIONS = ROOT / "common/base/movement_versions.h"
BIN = ROOT / "build/show/bin"
# Groups: the command; the number of a table; motor; minds; commit.
MARK = re.compile(r"<!-- study: ([^|\n]+?)(?: \| table (\d+))? \| "
                  r"motor (\d+)(?:, minds (\d+))?, commit ([0-9a-f]{7,40}) -->")
# A mark, what stands after it and the end.
BLOCK = re.compile(rf"{MARK.pattern}\n((?:(?!<!-- study: ).)*?)(<!-- end of study -->)", re.DOTALL)
# The line by which a command says what moved the fish.
SAID = re.compile(r"^motor (\d+)(?:, minds (\d+))?\n", re.MULTILINE)
TABLE = re.compile(r"^(?:\|.*\n)+", re.MULTILINE)


def documents():
    return sorted([*(ROOT / "docs").rglob("*.md"), ROOT / "README.md"])


def versions_in(header):
    """The version of the motor and that of the minds, as texts."""
    return tuple(re.search(rf"k{name}Version = (\d+);", header)[1] for name in ("Motor", "Minds"))


def problems(name, text, versions):
    """Where a document's figures are of other versions than these."""
    for mark in MARK.finditer(text):
        command, _, motor, minds, _ = mark.groups()
        if motor == versions[0] and minds in (None, versions[1]):
            continue
        filled = BLOCK.match(text, mark.start())
        remedy = f"run docs/studies.py '{command}'" if filled else f"run {command}, and enter figures and versions"
        yield (f"{name}: figures are of {mark[0].split(' | ')[-1][:-4]}, not of motor {versions[0]}, "
               f"minds {versions[1]}: {remedy}")
    marks = len(MARK.findall(text))
    if marks != text.count("<!-- study: "):
        yield f"{name}: has a mark of a study that is not of the form that docs/studies.py says"


def printed_by(*command):
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout


def commit_of_programs():
    """The commit of build/show. Exits where it is not the present one, or files outside docs differ from that."""
    changed = printed_by("git", "status", "--porcelain", "--untracked-files=no", "--", ".", ":!docs")
    if changed:
        sys.exit(f"commit the changes first, so that the figures are of a commit:\n{changed.rstrip()}")
    commit = printed_by("git", "rev-parse", "--short=8", "HEAD").strip()
    if f"commit     {commit}" not in printed_by(BIN / "aquarama", "--version"):
        sys.exit(f"build/show is not of commit {commit}: cmake --build --preset show --target aquarama_programs")
    return commit


def run(command):
    """What a command prints. Pictures that it draws are copied."""
    print(command, file=sys.stderr)
    with tempfile.TemporaryDirectory() as folder:
        words = [folder if word == "DIR" else word for word in shlex.split(command)]
        environment = os.environ | {"PATH": f"{BIN}:{os.environ['PATH']}"}
        done = subprocess.run(words, cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True, check=True)
        for picture in Path(folder).glob("*.svg"):
            if (ROOT / "docs/pictures" / picture.name).exists():
                shutil.copy(picture, ROOT / "docs/pictures")
    return done.stdout


def block(command, table, output, commit):
    """A mark, what its command printed, and the end."""
    motor, minds = SAID.search(output).groups()
    versions = f"motor {motor}" + (f", minds {minds}" if minds else "")
    said = SAID.sub("", output).strip() if table is None else TABLE.findall(output)[int(table) - 1].strip()
    number = f" | table {table}" if table else ""
    return (f"<!-- study: {command}{number} | {versions}, commit {commit} -->\n"
            f"Figures of {versions.replace(', ', ' and ')}, commit {commit}, the same on any machine:\n\n"
            f"{said}\n<!-- end of study -->")


def fill(beginnings):
    """Runs the commands that begin so and replaces what stands in their blocks."""
    commit = commit_of_programs()
    printed = {}
    for path in documents():
        text = path.read_text(encoding="utf-8")

        def filled(found):
            command, table = found[1], found[2]
            if not command.startswith(beginnings):
                return found[0]
            if command not in printed:
                printed[command] = run(command)
            return block(command, table, printed[command], commit)

        after = BLOCK.sub(filled, text)
        if after != text:
            path.write_text(after, encoding="utf-8")
    if not printed:
        sys.exit(f"no document has a study that begins with {' or '.join(beginnings)}")


def main(arguments):
    if not arguments:
        sys.exit(__doc__)
    if arguments != ["--check"]:
        fill(tuple(arguments))
        return
    versions = versions_in(VERSIONS.read_text(encoding="utf-8"))
    found = [problem for path in documents()
             for problem in problems(path.relative_to(ROOT), path.read_text(encoding="utf-8"), versions)]
    sys.exit("\n".join(dict.fromkeys(found)) or 0)


if __name__ == "__main__":
    main(sys.argv[1:])
