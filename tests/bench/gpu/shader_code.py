"""What AMD's compiler makes of the programs: reads shaders.txt of `aquarama_gpu_bench --counts`, drawn by AMD's driver
without its card, and writes a CSV with a row for each piece of code: what is run once, and the body of each loop."""

import argparse
import csv
import re
import sys
from collections import Counter

KINDS = ("vector", "slow", "texture", "memory")
# A quarter as fast as others on the generations of this compiler's cards.
SLOW = re.compile(r"v_(rcp|rsq|sqrt|exp|log|sin|cos|mul_lo|mul_hi|mad_[ui]64|\w+_f64)_?")
HEAD = ("program", "shader", "loop", *KINDS)


def kind_of(instruction):
    """One of KINDS; None for scalar ones and exports, which run beside them."""
    if instruction.startswith("v_"):
        return "slow" if SLOW.match(instruction) else "vector"
    if re.match(r"image_(sample|gather|load)", instruction):
        return "texture"
    if re.match(r"(buffer|global|flat|scratch|image|tbuffer|ds)_", instruction):
        return "memory"
    return None


def loops_of(lines):
    """(first, last) of the lines of each loop: from a label to the last jump back to it."""
    labels, loops = {}, {}
    for number, line in enumerate(lines):
        if label := re.match(r"\s*(\w+):", line):
            labels[label[1]] = number
        elif (jump := re.match(r"\s+s_c?branch\w*\s+(\w+)", line)) and jump[1] in labels:
            loops[labels[jump[1]]] = number
    return sorted(loops.items())


def counted(lines):
    """A Counter of KINDS for what is run once, "", and for the body of each loop: "1", "2", in it "2.1"."""
    loops = loops_of(lines)
    names, inner = [], Counter()
    for i, (first, last) in enumerate(loops):
        outer = [names[j] for j in range(i) if loops[j][1] >= last]
        inner[outer[-1] if outer else ""] += 1
        names.append((outer[-1] + "." if outer else "") + str(inner[outer[-1] if outer else ""]))
    pieces = {name: Counter() for name in ["", *names]}
    for number, line in enumerate(lines):
        within = [names[i] for i, (first, last) in enumerate(loops) if first <= number <= last]
        instruction = re.match(r"\s+(\w+)", line)
        if instruction and (kind := kind_of(instruction[1])):
            pieces[within[-1] if within else ""][kind] += 1
    return pieces


def by_shader(program, codes):
    """{ending of the shader's file: its code}; a fragment shader's is in several pieces, one behind the other. AMD's
    driver adds an empty one where a program has none."""
    if program.endswith(".comp"):
        return {"comp": codes[-1:]}
    is_vertex = [any(re.match(r"\s+exp pos", line) for line in code) for code in codes]
    shaders = {"vert": [code for code, vertex in zip(codes, is_vertex) if vertex][-1:],
               "frag": [code for code, vertex in zip(codes, is_vertex) if not vertex]}
    return {shader: pieces for shader, pieces in shaders.items() if pieces and f".{shader}" in program}


def programs_in(log):
    """{(program, shader): pieces of code, each a list of lines}: what the last draw made of each, or else linking."""
    programs, waiting, code = {}, [], None
    for line in log:
        if line.startswith("Shader Disassembly Begin"):
            code = []
        elif line.startswith("Shader Disassembly End"):
            waiting.append(code)
            code = None
        elif code is not None:
            code.append(line)
        elif line.startswith("=== program ") and waiting:
            program = line.removeprefix("=== program ").strip()
            programs |= {(program, shader): pieces for shader, pieces in by_shader(program, waiting).items()}
            waiting = []
    return programs


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("shaders", type=argparse.FileType())
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(HEAD)
    for (program, shader), codes in sorted(programs_in(parser.parse_args().shaders).items()):
        pieces = {}
        for code in codes:
            for loop, counts in counted(code).items():
                pieces[loop] = pieces.get(loop, Counter()) + counts
        for loop, counts in sorted(pieces.items()):
            table.writerow((program, shader, loop, *(counts[kind] for kind in KINDS)))


if __name__ == "__main__":
    main()
