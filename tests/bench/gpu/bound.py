"""A bound for cards on paper: the time below which a frame cannot go, by stage, from what a frame gives a card to do
(counts.csv of `aquarama_gpu_bench --counts`), what AMD's compiler makes of its programs (shader_code.py) and the peak
rates of cards. Prints the tables of docs/measurements/README.md.

    bound.py [--folder docs/measurements/bound]
"""

import argparse
import csv
from collections import defaultdict
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[3] / "docs/measurements/bound"
SLOWER = 4  # cycles of a lane for what shader_code.py calls slow
SHARE = 0.4  # of a frame's time that a bound may take
AIMS = (("gpu/theatre/reef/high", "theatre, `reef`", 240, "Radeon RX 6800"),
        ("gpu/theatre/reef_full/high", "theatre, `reef_full`", 120, "Radeon RX 6800"),
        ("gpu/theatre/bait_ball_100000/high", "theatre, 100 000 fish", 60, "Radeon RX 6800"),
        ("gpu/eight_4k/reef/high", "eight of 4K, `reef`", 60, "Radeon RX 7900 XTX"))
# Of a stage, each in milliseconds of a card: what is slowest bounds it.
RESOURCES = ("arithmetic", "textures", "pixels", "triangles", "memory")


def rows_of(file):
    with open(file) as table:
        return list(csv.DictReader(table))


def files_of(program, ending):
    """(its file with this ending, what it includes in place of others); None where it has no such file."""
    names = program.split()
    own = next((name for name in names if name.endswith(ending)), None)
    return (own, tuple(name for name in names if name.endswith(".glsl"))) if own else None


class Code:
    """Cycles of a lane and textures read by an invocation of each shader."""

    def __init__(self, programs, loops):
        turns = {(row["shader"], row["loop"]): float(row["turns"]) for row in loops}
        self.costs = {}
        for row in programs:
            program, (file, _) = row["program"], files_of(row["program"], "." + row["shader"])
            times = self._times(turns, file, row["loop"])
            cycles, textures = self.costs.get((program, file), (0.0, 0.0))
            self.costs[program, file] = (cycles + times * (int(row["vector"]) + SLOWER * int(row["slow"])),
                                         textures + times * int(row["texture"]))
        # One program of several with the same code is compiled: another's stands in, with the same includes if there is
        # one, else another skin's.
        for (program, file), cost in list(self.costs.items()):
            for key in (files_of(program, file), (file, None)):
                self.costs[key] = max(cost, self.costs.get(key, cost))

    @staticmethod
    def _times(turns, file, loop):
        """How often a piece of code runs: loops within loops are named 2.1."""
        times = 1.0
        names = loop.split(".") if loop else []
        for depth in range(len(names)):
            name = ".".join(names[:depth + 1])
            times *= turns[file, name] if (file, name) in turns else turns[file, "*"]
        return times

    def of(self, program, ending):
        """Zeros where the program has no such shader; KeyError where its code is not known."""
        key = files_of(program, ending)
        if key is None:
            return (0.0, 0.0)
        for known in ((program, key[0]), key):
            if known in self.costs:
                return self.costs[known]
        return self.costs[key[0], None]


def work_of(row, code, whole_quads):
    """What a line of the counts asks of each of RESOURCES: cycles of a lane, texels, pixels, triangles, bytes.

    Pixels are those whose samples pass the depth test. With whole quads each block of 4 x 4 pixels that llvmpipe
    shaded costs the four lanes of one quad of 2 x 2 at least, as if depth rejected none before it was shaded.
    """
    samples = max(int(row["target_samples"]), 1)
    pixels = int(row["samples"]) / samples
    shaded = max(pixels, int(row["fragments"]) / 4) if whole_quads else pixels
    invocations = {".vert": int(row["vertices"]), ".frag": shaded, ".comp": int(row["computed"])}
    cycles = textures = 0.0
    for ending, times in invocations.items():
        cost = code.of(row["program"], ending)
        cycles, textures = cycles + times * cost[0], textures + times * cost[1]
    copied = int(row["bytes"])
    if row["program"] == "copy" and not whole_quads:
        copied *= 2 / (samples + 1)  # where samples of a pixel are alike, they are kept and read once
    return cycles, textures, pixels, int(row["primitives"]), pixels * int(row["pixel_bytes"]) + copied


def milliseconds(work, card):
    """By resource. An instruction of a lane counts as two operations in a card's peak rate."""
    rates = (1e9 * float(card["tflops"]) / 2, 1e6 * float(card["gigatexels"]), 1e6 * float(card["gigapixels"]),
             1e6 * float(card["gigatriangles"]), 1e6 * float(card["gigabytes"]))
    return tuple(amount / rate for amount, rate in zip(work, rates))


def bound_of(counts, code, card, whole_quads=False):
    """{stage: (milliseconds, resource)}: a stage takes as long as its slowest resource, one stage after the other."""
    stages = defaultdict(lambda: (0.0,) * len(RESOURCES))
    for row in counts:
        times = milliseconds(work_of(row, code, whole_quads), card)
        stages[row["stage"]] = tuple(map(sum, zip(stages[row["stage"]], times)))
    return {stage: max(zip(times, RESOURCES)) for stage, times in stages.items()}


def total(bound):
    return sum(time for time, _ in bound.values())


class Paper:
    """The tables, as text."""

    def __init__(self, folder):
        self.cards = {row["card"]: row for row in rows_of(folder / "cards.csv")}
        self.code = Code(rows_of(folder / "programs.csv"), rows_of(folder / "loops.csv"))
        self.counts = defaultdict(list)
        for row in rows_of(folder / "counts.csv"):
            self.counts[row["wall"]].append(row)

    def both(self, wall, card):
        return [bound_of(self.counts[wall], self.code, self.cards[card], whole) for whole in (False, True)]

    def aims(self):
        yield "| aim, `high` | frame | card | bound | of the frame | with whole quads | of the frame | measured |"
        yield "|---|---|---|---|---|---|---|---|"
        for wall, name, rate, card in AIMS:
            least, quads = map(total, self.both(wall, card))
            yield (f"| {name}: {rate} a second | {1000 / rate:.1f} ms | {card} | {least:.2f} ms | "
                   f"{least * rate / 10:.0f} % | {quads:.2f} ms | {quads * rate / 10:.0f} % | not measured yet |")

    def all_cards(self):
        yield "| bound (with whole quads), ms | " + " | ".join(self.cards) + " |"
        yield "|---" * (1 + len(self.cards)) + "|"
        for wall, name, _, _ in AIMS:
            cells = (tuple(map(total, self.both(wall, card))) for card in self.cards)
            yield f"| {name} | " + " | ".join("{:.2f} ({:.2f})".format(*cell) for cell in cells) + " |"

    def stages(self):
        bounds = [self.both(wall, card) for wall, _, _, card in AIMS]
        names = sorted({stage for least, _ in bounds for stage in least},
                       key=lambda stage: (-max(quads.get(stage, (0,))[0] for _, quads in bounds), stage))
        yield "| stage | " + " | ".join(name for _, name, _, _ in AIMS) + " | bounded by |"
        yield "|---" * (2 + len(AIMS)) + "|"
        for stage in names:
            pairs = [(least.get(stage, (0, ""))[0], quads.get(stage, (0, ""))[0]) for least, quads in bounds]
            if max(quads for _, quads in pairs) < 0.005:
                continue
            by = sorted({least[stage][1] for least, _ in bounds if stage in least and least[stage][0] >= 0.005})
            yield (f"| {stage} | " + " | ".join("{:.2f} ({:.2f})".format(*pair) for pair in pairs) +
                   f" | {', '.join(by)} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", type=Path, default=FOLDER)
    paper = Paper(parser.parse_args().folder)
    print("\n\n".join("\n".join(table) for table in (paper.aims(), paper.all_cards(), paper.stages())))


if __name__ == "__main__":
    main()
