# SPDX-License-Identifier: Apache-2.0
"""Draws the sheet of the forms of swimming beside its data and prints the table of docs/motion.md: draw_forms.py
forms.json."""

import json
import sys
from pathlib import Path

import numpy as np

from figures import INK, PUBLISHED, PX, QUIET, markdown_table, plt, save

WIDE, HIGH = 300, 90  # of the midlines of a body length and its room at both sides, px
STROKE, WORDS, GAP, TOP, BOTTOM, LEFT = 190, 360, 46, 62, 44, 52  # px
ROW = HIGH + 62
SIDES = [("left fin", "#2f77b4", "-"), ("right fin", "#bf4a24", (0, (4, 2)))]

# In the order of the sheet; a fish of none of them comes last.
FORMS = ["carangiform", "yawing head", "stiff body", "labriform"]

# Columns of the table: words, and the figures of a gait in a cell.
COLUMNS = {
    "beat, Hz": lambda f: f"tail {f['tail_hertz']:.2f}" if f["tail_hertz"] else f"fins {f['fin_hertz']:.2f}",
    "speed, L/s": lambda f: f"{f['speed']:.2f}",
    "stride, L": lambda f: f"{f['stride']:.2f}",
    "Strouhal": lambda f: of_the_tail(f, "strouhal", 2),
    "tail, L": lambda f: f"{f['tail']:.3f}",
    "head, L": lambda f: f"{f['head']:.3f}",
    "least, L, at": lambda f: f"{of_the_tail(f, 'least', 3)} at {of_the_tail(f, 'least_at', 2)}"
    if f["tail_hertz"] else "–",
    "part that swings": lambda f: of_the_tail(f, "swinging", 2),
    "wave, L": lambda f: of_the_tail(f, "wavelength", 2),
    "head yaws": lambda f: f"{f['head_yaw_degrees']:.1f}°",
    "fin stroke": lambda f: f"{f['fin_stroke_degrees']:.0f}°",
}
# Living fish of each form, below ours: which, and a cell for each column. docs/motion.md has the sources by number.
LIVING = {
    "carangiform": [
        ("saithe, mackerel", ["", "1.2–2.2 [5]", "0.5–0.7 [1]", "0.2–0.4 [2]", "0.2 [6]", "0.04 [7]",
                              "0.019 at 0.25 [7]", "0.25 [7]", "0.9–1.1 [7]", "", "folded [7]"]),
        ("largemouth bass", ["", "0.7–2.4 [8]", "", "", "0.106–0.132 [8]", "0.008–0.024 [8]", "at 0.25 [8]", "",
                             "", "≤ 8° [8]", ""])],
    "yawing head": [
        ("blacktip reef shark", ["rises [9]", "up to 4 [9]", "falls [9]", "0.2–0.4 [2]", "falls [9]", "", "", "",
                                 "falls [9]", "", ""])],
    "stiff body": [
        ("needlefish", ["", "0.25–2 [10]", "", "0.2–0.4 [2]", "rises [10]", "", "", "", "≤ 2 [10]", "",
                        "folded [10]"])],
    "labriform": [
        ("bluegill", ["fins 1.2–2.1 [3]", "0.3–1.0 [3]", "0.25–0.48 [3]", *[""] * 8]),
        ("surfperch", [*[""] * 10, "0.35–0.40 L [4]"]),
        ("young damselfish", ["", "< 8, fins [11]", *[""] * 9]),
        ("Schlegel's parrotfish", ["", "< 3.2, fins [12]", *[""] * 9])],
}


def plain(name):
    return name.replace("_", " ")


def of_the_tail(figures, key, digits):
    """A figure that has no meaning for a tail that is still."""
    return f"{figures[key]:.{digits}f}" if figures["tail_hertz"] else "–"


def table(fish):
    rows = []
    for form in dict.fromkeys(one["form"] for one in fish):
        for one in fish:
            if one["form"] != form:
                continue
            for gait, first in [("slow", f"**{plain(one['species'])}**"), ("fast", "")]:
                rows.append([first, f"{form}, {gait}" if first else gait,
                             *(cell(one[gait]["figures"]) for cell in COLUMNS.values())])
        rows += [[f"*{which}*", "living", *cells] for which, cells in LIVING.get(form, [])]
    return markdown_table(["", "", *COLUMNS], rows)


def draw_midlines(axes, gait):
    """The midlines of one beat over each other, dark to light, how far each point of them swings, and the part of the
    length that swings over half as far as the tail."""
    lines = gait["midlines"][::4]
    for i, line in enumerate(lines):  # every second point is enough for the eye
        axes.plot(line["station"][::2], line["left"][::2], color=plt.cm.Blues_r(0.15 + 0.55 * i / len(lines)),
                  linewidth=0.8)
    station, half = np.array(gait["swing"]["station"]), np.array(gait["swing"]["half"])
    saithe = 0.02 - 0.0825 * station + 0.1625 * station**2  # Videler & Hess 1984
    for side in [-1, 1]:
        axes.plot(station, side * half, color=INK, linewidth=1.4)
        if gait["figures"]["tail_hertz"] > 0:
            axes.plot(station, side * saithe, **PUBLISHED)
    axes.axvspan(station[-1] * (1 - gait["figures"]["swinging"]), station[-1], color="#fbeedd", zorder=0)
    axes.set(xlim=(0, 1), ylim=(-0.15, 0.15), yticks=[-0.1, 0, 0.1], xticks=[0, 0.5, 1])


def draw_strokes(axes, gaits):
    """The stroke of both pectoral fins over one beat, the slow gait thick, the fast one thin."""
    for gait, wide in zip(gaits, [2.2, 0.9]):
        for (_, colour, style), strokes in zip(SIDES, gait["strokes_degrees"]):
            beat = np.linspace(0, 1, len(strokes) + 1)
            axes.plot(beat, [*strokes, strokes[0]], color=colour, linestyle=style, linewidth=wide)
    axes.set(xlim=(0, 1), ylim=(-70, 70), yticks=[-50, 0, 50], xticks=[0, 0.5, 1])


def words_of(gait):
    """The figures of a gait, in lines."""
    f = gait["figures"]
    if not f["tail_hertz"]:
        return (f"fins {f['fin_hertz']:.2f} Hz, {f['speed']:.2f} BL/s, stride {f['stride']:.2f} BL\n"
                f"stroke {f['fin_stroke_degrees']:.0f}°, left and right {f['fins_apart_degrees']:.0f}° apart; "
                "body still")
    return (f"tail {f['tail_hertz']:.2f} Hz, {f['speed']:.2f} BL/s, stride {f['stride']:.2f} BL, Strouhal "
            f"{f['strouhal']:.2f}\ntail {f['tail']:.3f}, head {f['head']:.3f}, least {f['least']:.3f} at "
            f"{f['least_at']:.2f}; wave {f['wavelength']:.2f} BL\nswinging part {f['swinging']:.2f}, head yaws "
            f"{f['head_yaw_degrees']:.1f}°, fins {'beat' if f['fin_hertz'] else 'still'}")


def draw(fish):
    """The sheet: a row for each species."""
    wide = LEFT + 2 * (WIDE + GAP) + STROKE + GAP + WORDS
    tall = TOP + len(fish) * ROW + BOTTOM
    figure = plt.figure(figsize=(wide * PX, tall * PX))
    figure.text(LEFT / wide, 1 - 24 / tall, "Forms of swimming: captured midlines and pectoral fins of one beat",
                fontsize=13.5)
    figure.text(LEFT / wide, 1 - 44 / tall, "Midlines dark to light; thick: how far each point swings; dashed: a "
                "saithe's (Videler & Hess 1984); shaded: the part that swings over half as far as the tail. Fins: slow "
                "thick, fast thin.", color=QUIET)
    for row, one in enumerate(fish):
        top = TOP + row * ROW + 34

        def panel(left, width, top=top):
            return figure.add_axes([left / wide, 1 - (top + HIGH) / tall, width / wide, HIGH / tall])
        gaits = [one["slow"], one["fast"]]
        for i, gait in enumerate(gaits):
            axes = panel(LEFT + i * (WIDE + GAP), WIDE)
            draw_midlines(axes, gait)
            title = f"{plain(one['species'])}: {one['form']}, slow" if i == 0 else "fast"
            axes.set_title(title, fontsize=10.5 if i == 0 else 9.5)
            if row == len(fish) - 1:
                axes.set_xlabel("distance from the nose, BL")
        axes = panel(LEFT + 2 * (WIDE + GAP), STROKE)
        draw_strokes(axes, gaits)
        axes.set_title("stroke of the fins, degrees")
        if row == len(fish) - 1:
            axes.set_xlabel("share of the beat")
        for i, (name, gait) in enumerate(zip(["slow", "fast"], gaits)):
            figure.text((LEFT + 2 * (WIDE + GAP) + STROKE + 20) / wide, 1 - (top - 6 + 54 * i) / tall,
                        f"{name}: {words_of(gait)}", va="top", linespacing=1.35, fontsize=8.5)
    figure.legend(handles=[plt.Line2D([], [], color=colour, linestyle=style, label=name)
                           for name, colour, style in SIDES], loc="lower right", ncols=2)
    return figure


def main(path):
    fish = json.loads(path.read_text(encoding="utf-8"))
    fish.sort(key=lambda one: FORMS.index(one["form"]) if one["form"] in FORMS else len(FORMS))
    print(table(fish))
    print(save(draw(fish), path.with_suffix(".svg")))


main(Path(sys.argv[1]))
