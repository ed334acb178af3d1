# SPDX-License-Identifier: Apache-2.0
"""Draws the sheet of the nine motor controllers beside its data: draw_controllers.py controllers.json."""

import json
import sys
from pathlib import Path

import numpy as np
from matplotlib.patches import Polygon
from matplotlib.ticker import MultipleLocator

from figures import INK, PX, QUIET, plt, save

WIDE, HIGH = 370, 190  # size of a panel, px
# A body length in px: in panels from above or the side, and in the panel where the fish is seen from behind.
BODY, SECTION = 84, 130
FIN = {"color": "#bf4a24", "linewidth": 1.8, "solid_capstyle": "round"}
# The controllers that change the course are drawn as maps; the least value of their y axis, body lengths.
LEAST = {"left turn": -0.7, "right turn": -1.55, "ascend": -0.7, "descend": -1.55}


# The style of the fish number i of `count`: from light, early, to dark, late.
def shade(i, count):
    return {"facecolor": "#5b7280", "alpha": 0.25 + 0.75 * i / (count - 1), "linewidth": 0}


def draw_fish(axes, trial, place):
    """The fish of a trial, dark is late; place() takes points of a moment to the panel."""
    for i, fish in enumerate(trial["fish"]):
        for part in fish["body"]:
            axes.add_patch(Polygon(place(fish["moment"], np.array(part)), **shade(i, len(trial["fish"]))))
        for fin in fish["fins"]:
            axes.plot(*place(fish["moment"], np.array(fin)).T, **FIN)


def draw_straight(axes, trial, name):
    """Where the fish is, up the paper as time goes."""
    # The y axis is time. Outlines are scaled so that a body length has the same size across and along the paper.
    seconds = np.array(trial["seconds"])
    span = 1.32 * seconds[-1]
    axes.set(xlim=np.array([0, WIDE / BODY]) - (3 if name == "retreat" else 1), xlabel="ahead, BL",
             ylim=(-0.16 * seconds[-1], 1.16 * seconds[-1]), ylabel="time, s",
             title=f"{name.capitalize()}, from above: {trial['speed_before']:.2f} → {trial['speed_after']:.2f} BL/s")
    axes.xaxis.set_major_locator(MultipleLocator(1))
    axes.yaxis.set_major_locator(MultipleLocator(1 if seconds[-1] > 2 else 0.5))
    draw_fish(axes, trial, lambda moment, points: np.column_stack(
        [points[:, 0], seconds[moment] + points[:, 1] * BODY / HIGH * span]))
    axes.plot(np.array(trial["way"])[:, 0], seconds, color="#2f77b4", linewidth=1.3)


def draw_map(axes, trial, name):
    """The way itself."""
    # The title names the change of heading, or the mean pitch over the last quarter of the trial.
    heading, pitch = trial["heading_degrees"], trial["pitch_degrees"]
    is_above = trial["view"] == "above"
    last = np.mean(pitch[-(len(pitch) // 4):])
    tells = f"turns by {heading[-1] - heading[0]:.0f}°" if is_above else f"pitch {last:.0f}°"
    axes.set(xlim=np.array([0, WIDE / BODY]) - 1, xlabel="ahead, BL", ylim=np.array([0, HIGH / BODY]) + LEAST[name],
             ylabel="to the left, BL" if is_above else "up, BL",
             title=f"{name.capitalize()}, from {'above' if is_above else 'the side'}: {tells}")
    axes.xaxis.set_major_locator(MultipleLocator(1))
    axes.yaxis.set_major_locator(MultipleLocator(0.5))
    draw_fish(axes, trial, lambda moment, points: points)
    axes.plot(*np.array(trial["way"]).T, color="#2f77b4", linewidth=1.3)


def draw_roll(axes, trial, name):
    """Roll over time, with the fish from behind: a section of its body, the fin on its back and those at its sides."""
    seconds, roll = np.array(trial["seconds"]), np.array(trial["roll_degrees"])
    # The first moment within 5 degrees of upright: argmax gives the first True.
    level = seconds[np.argmax(np.abs(roll) < 5)]
    axes.set(xlim=(-0.3, seconds[-1] + 0.3), xlabel="time, s", ylim=(-25, 75), ylabel="roll, degrees",
             title=f"{name.capitalize()}, from behind: upright within 5° after {level:.1f} s")
    axes.plot(seconds, roll, color="#2f77b4", linewidth=1.3)
    # From body lengths to the units of the axes.
    scale = SECTION / np.array([WIDE / (seconds[-1] + 0.6), HIGH / 100])
    # The section of the body is an ellipse of 0.14 by 0.24 body lengths: a symbol, not the species' shape.
    angles = np.linspace(0, 2 * np.pi, 41)
    for i, fish in enumerate(trial["fish"]):
        moment = fish["moment"]
        c, s = np.cos(np.radians(roll[moment])), np.sin(np.radians(roll[moment]))

        def turned(points):
            return (seconds[moment], roll[moment]) + np.array(points) @ [[c, s], [-s, c]] * scale
        axes.add_patch(Polygon(turned(np.column_stack([0.07 * np.cos(angles), 0.12 * np.sin(angles)])),
                               **shade(i, len(trial["fish"]))))
        axes.plot(*turned([(0, 0.12), (0, 0.2)]).T, color=INK, linewidth=1.2)
        for side in [-1, 1]:
            axes.plot(*turned([(0.05 * side, -0.03), (0.17 * side, -0.06)]).T, **FIN)


def main(path):
    data = json.loads(path.read_text(encoding="utf-8"))
    wide, high = 3 * (WIDE + 76) + 24, 3 * (HIGH + 94) + 58
    figure = plt.figure(figsize=(wide * PX, high * PX))
    species = data["species"].replace("_", " ")
    figure.text(62 / wide, 1 - 36 / high, f"Nine motor controllers: the biomechanical {species}, in its stride at "
                "medium speed, then so ordered", fontsize=13.5)
    figure.text(62 / wide, 1 - 56 / high, "Dark is late; pectoral fins in red; lengths in body lengths (BL). Balance "
                "begins rolled by 40°, retreat at rest.", color=QUIET)
    # Three rows of three panels; positions in px from the top left, as shares of the figure for matplotlib.
    for i, trial in enumerate(data["trials"]):
        left, top = 62 + i % 3 * (WIDE + 76), 96 + i // 3 * (HIGH + 94)
        axes = figure.add_axes([left / wide, 1 - (top + HIGH) / high, WIDE / wide, HIGH / high])
        name = trial["controller"]
        draw = draw_map if name in LEAST else draw_roll if name == "balance" else draw_straight
        draw(axes, trial, name)
    print(save(figure, path.with_suffix(".svg")))


main(Path(sys.argv[1]))
