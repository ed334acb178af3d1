#!/usr/bin/env python3
"""draw_modules.py GRAPH.dot OUT.svg: the libraries and programs of the product, and which uses which.

GRAPH.dot is what `cmake --graphviz` writes. Left out are tests, libraries of others, and an arrow to what is reached
through another arrow as well. A box is named by its folder and stands in the frame of its part. Needs dot of Graphviz.
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PARTS = {  # in the order of their frames: the longest folder that fits, fill
    "capture": "#fdebd3", "master": "#fbf6d5", "releases": "#f5e6ea", "commands": "#f3efe6", "render_node": "#dcebf7",
         "calibration": "#eee0f5", "console": "#f7e1dd", "drawings": "#e0f0ee", "guests": "#e9f0e0",
         "common": "#e2f2df"}
ACROSS = "#00000055"  # fainter, an arrow from one part to another
DECLARED = re.compile(r"aquarama_(library|program)\(([\w-]+)")
EDGE = re.compile(r'" -> ".*// ([\w-]+) -> ([\w-]+)$', re.MULTILINE)


def folders():
    """target -> the folder that declares it, and whether it is a program."""
    found = {}
    for part in ("common", "capture", "master", "releases", "commands", "render_node", "calibration", "console",
                 "drawings", "guests"):
        for listing in sorted((ROOT / part).rglob("CMakeLists.txt")):
            for kind, name in DECLARED.findall(listing.read_text(encoding="utf-8")):
                target = name if kind == "program" else f"aquarama_{name}"
                found[target] = str(listing.parent.relative_to(ROOT)), kind == "program"
    return found


def part_of(folder):
    return max((part for part in PARTS if f"{folder}/".startswith(f"{part}/")), key=len)


def label_of(target, folder, declared):
    """The folder within its part; the library's own name where the folder declares several."""
    several = sum(other == folder for other, is_program in declared.values() if not is_program) > 1
    inside = folder.removeprefix(part_of(folder)).strip("/")
    return target.removeprefix("aquarama_") if several or not inside else inside


def graph_of(declared, edges):
    lines = ['digraph modules {', 'rankdir=TB; nodesep=0.15; ranksep=0.45; fontname="Helvetica"; fontsize=15;',
             'node [fontname="Helvetica", fontsize=13, shape=box, style="filled,rounded", fillcolor=white, '
             'height=0.32, margin="0.1,0.03"];',
             'edge [color="#000000aa", arrowsize=0.6];']
    for number, (part, fill) in enumerate(PARTS.items()):
        lines.append(f'subgraph cluster{number} {{ label="{part}"; style="filled,rounded"; color="{fill}";')
        for target, (folder, is_program) in declared.items():
            if not is_program and part_of(folder) == part:
                lines.append(f'"{target}" [label="{label_of(target, folder, declared)}"];')
        lines.append("}")
    lines += [f'"{target}" [shape=ellipse, style=filled, fillcolor="#333333", fontcolor=white];'
              for target, (_, is_program) in declared.items() if is_program]
    for user, used in sorted(edges):
        across = part_of(declared[user][0]) != part_of(declared[used][0])
        lines.append(f'"{user}" -> "{used}"' + (f' [color="{ACROSS}"];' if across else ";"))
    return "\n".join([*lines, "}"])


def main():
    if shutil.which("dot") is None:
        sys.exit("draw_modules.py: no dot of Graphviz is here; install graphviz (apt)")
    declared = folders()
    pairs = set(EDGE.findall(Path(sys.argv[1]).read_text(encoding="utf-8")))
    graph = graph_of(declared, {(user, used) for user, used in pairs if user in declared and used in declared})
    reduced = subprocess.run(["tred"], input=graph, capture_output=True, text=True, check=True).stdout
    subprocess.run(["dot", "-Tsvg", "-o", sys.argv[2]], input=reduced, text=True, check=True)


main()
