# SPDX-License-Identifier: Apache-2.0
"""Makes the page fidelity.html with its pictures and prints the tables of docs/fidelity.md: draw_fidelity.py DIR SEED.

DIR holds the files of CSV that `aquarama fidelity` writes (fidelity.h says what is in them).
"""

import sys
from itertools import groupby
from pathlib import Path

import numpy as np
from matplotlib.lines import Line2D

sys.path.append(str(Path(__file__).resolve().parents[1] / "report"))
from figures import (INK, PX, from_above, hide_axes, html_table, markdown_table, picture, plt, read_csv, save,
                     write_page)

# Colours of the kinds of commands: gaits in blues, turns in orange, fast starts in red.
KINDS = {"slow": "#9fc9e8", "medium": "#5b9fd0", "fast": "#1f6aa5", "gradual turn": "#f2b35c", "sharp turn": "#e0702c",
         "fast start": "#a8447f", "glide": "#9bbf7a", "up, down, level": "#b59ad6", "brake, retreat": "#8a969e"}
# Colours: the uncorrected replica, one of several species, the goal, the number of segments that repertoires have.
ALONE, SPECIES, GOAL, OURS = "#7b3f00", "#b9c6cd", "#c0392b", "#e0702c"
INTRODUCTION = """<p>The biomechanical fish and its kinematic replica obey the same commands. Shape: root mean square
distance of the 23 nodal points in the body frame, in per cent of a body length (BL); within a segment, after the
first beat, at the lag of its beat; and in the transition, the first beat as it was played. Path: distance at the end
of a command, in per cent of the way, laid over each other at its start by place and heading; along the way it is the
speed's, across it the heading's (medians). <span class="over">Over the goal</span>: shape 1 % within a segment, path
5 %.</p>"""
# Body lengths; share of the path. The same goals as in compare.cpp and fidelity.cpp.
SHAPE_GOAL, PATH_GOAL = 0.01, 0.05


# The colour of a command's kind. Of a forward gait and a turn the last word names it.
def colour_of(command):
    gaits = {"ascend": "up, down, level", "descend": "up, down, level", "balance": "up, down, level", "glide": "glide",
             "brake": "brake, retreat", "retreat": "brake, retreat"}
    first, last = command.split("_")[0], command.split("_")[-1]
    kind = gaits.get(command) or {"turn": f"{last} turn", "start": "fast start"}.get(first, last)
    return KINDS[kind]


# An array with a row for each of the rows and a column for each key; NaN where a value is empty.
def column(rows, *keys):
    return np.array([[row[key] if row[key] is not None else np.nan for key in keys] for row in rows])


# The ticks of each command. A number instead of the name: two commands in a row may have the same name.
def commands_of(ticks):
    return [list(rows) for _, rows in groupby(ticks, key=lambda row: row["number"])]


def kind_marks():
    return [Line2D([], [], color=colour, linewidth=5, label=kind) for kind, colour in KINDS.items()]


def draw_ways(axes, ticks, width, every):
    """The way of the fish from above, lying so that the longer side is across; each command in its colour. Over it,
    thin, the replica's, laid over it anew at each command, and dashed the one that was left alone. Of `every` ticks one
    is drawn."""
    seen = np.concatenate([from_above(column(ticks, f"{who}_x", f"{who}_z")) for who in ["fish", "alone"]])
    is_turned = np.ptp(seen[:, 1]) > np.ptp(seen[:, 0])

    # Draws one of the three paths; the last point is always drawn, so that commands meet.
    def plot(rows, who, **style):
        points = from_above(column(rows[:-1:every] + rows[-1:], f"{who}_x", f"{who}_z"))
        return axes.plot(*(points[:, ::-1] * (-1, 1) if is_turned else points).T, **style)
    for rows in commands_of(ticks):
        plot(rows, "fish", color=colour_of(rows[0]["command"]), linewidth=width, solid_capstyle="butt")
    plot(ticks, "alone", color=ALONE, linewidth=max(0.6, width / 6), dashes=(5, 3), zorder=3)
    for rows in commands_of(ticks):
        plot(rows, "replica", color="#10202b", linewidth=max(0.6, width / 6), zorder=4,
             marker="o", markersize=width / 3, markevery=[0], markeredgewidth=0)
    axes.set_aspect("equal", adjustable="datalim")
    hide_axes(axes)


# `height` is a share of the axes; it may lie outside of them.
def draw_scale(axes, height):
    """Ten body lengths, at the left; when the limits are known."""
    length = 10 / np.ptp(axes.get_xlim())
    axes.plot([0.03, 0.03 + length], [height] * 2, color=INK, linewidth=1.6, transform=axes.transAxes, clip_on=False)
    axes.text(0.03 + length + 0.015, height, "10 BL", transform=axes.transAxes, va="center")


def draw_ways_of_one(ticks):
    # The height in px follows the shape of the path, within limits.
    seen = np.ptp(column(ticks, "fish_x", "fish_z"), axis=0)
    high = min(600, max(200, 1080 * min(seen) / max(seen)) + 90)
    figure, axes = plt.subplots(figsize=(1080 * PX, high * PX), gridspec_kw={
        "left": 0.01, "right": 0.99, "bottom": 30 / high, "top": 1 - 30 / high})
    draw_ways(axes, ticks, 5, 2)
    axes.margins(0.03, 0.08)
    # The limits of the axes are known only after a drawing, and the scale needs them.
    figure.canvas.draw()
    draw_scale(axes, -15 / (high - 60))
    figure.legend(handles=kind_marks(), loc="upper left", ncols=len(KINDS), handlelength=1.6, borderaxespad=0.3)
    figure.legend(handles=[Line2D([], [], color="#10202b", linewidth=1, label="replica, laid over at each command"),
                           Line2D([], [], color=ALONE, linewidth=1, dashes=(5, 3),
                                  label="replica, laid over at the beginning only")],
                  loc="lower right", ncols=2, borderaxespad=0.1)
    return figure


def draw_ways_of_all(by_species):
    # A panel for each species, four in a row; panels that remain are hidden.
    columns = 4
    rows = -(-len(by_species) // columns)
    high = 215 * rows + 32
    figure, panels = plt.subplots(rows, columns, squeeze=False, figsize=(1080 * PX, high * PX), gridspec_kw={
        "left": 0.01, "right": 0.99, "bottom": 0.01, "top": 1 - 32 / high, "wspace": 0.05, "hspace": 0.07})
    for axes in panels.flat[len(by_species):]:
        axes.set_visible(False)
    for axes, (species, ticks) in zip(panels.flat, by_species.items()):
        draw_ways(axes, ticks, 2.8, 6)
        axes.margins(0.06, 0.3)
        axes.annotate(species, (0, 1), (6, -6), "axes fraction", "offset points", va="top", fontsize=9.5)
    figure.canvas.draw()
    for axes, _ in zip(panels.flat, by_species):
        draw_scale(axes, 0.06)
    figure.legend(handles=kind_marks(), loc="upper left", ncols=len(KINDS), handlelength=1.6, borderaxespad=0.3)
    return figure


def draw_times(ticks):
    """Error of the shape over time, the commands, and the speeds of both."""
    figure, (shape, commands, speed) = plt.subplots(
        3, 1, sharex=True, figsize=(1080 * PX, 480 * PX), layout="constrained", height_ratios=[19, 1, 15])
    seconds = column(ticks, "seconds")
    # Logarithmic: the errors range over three decades.
    for key, colour, label in [("shape_as_played_bl", SPECIES, "as played"),
                               ("shape_in_phase_bl", INK, "in the fish's phase")]:
        shape.semilogy(seconds, 100 * column(ticks, key), color=colour, linewidth=0.9, label=label)
    shape.axhline(100 * SHAPE_GOAL, color=GOAL, linewidth=0.8, dashes=(5, 4), label="1 %, the goal within a segment")
    shape.set(ylim=(0.01, 10), yticks=[0.01, 0.1, 1, 10], yticklabels=["0.01", "0.1", "1", "10"],
              title="error of the shape, root mean square over 23 nodal points, % of a body length")
    shape.legend(loc="upper right", ncols=3, bbox_to_anchor=(1, 1.13), borderaxespad=0)
    # A narrow band that shows which command is in force.
    for rows in commands_of(ticks):
        commands.axvspan(rows[0]["seconds"], rows[-1]["seconds"], color=colour_of(rows[0]["command"]), linewidth=0)
    hide_axes(commands)
    commands.tick_params(bottom=False)
    speed.plot(seconds, column(ticks, "fish_speed"), color="#8fbfe0", linewidth=3)
    speed.plot(seconds, column(ticks, "replica_speed"), color=INK, linewidth=1)
    speed.set(xlim=(0, seconds[-1, 0]), ylim=(0, None), xlabel="time, s",
              title="speed over the last beat of medium swimming, BL/s: fish (wide) and replica")
    speed.set_xticks(np.arange(0, seconds[-1, 0] + 1e-9, 10))
    return figure


def draw_vocabularies(vocabularies):
    """Errors against the number of segments, a line for each species and their median."""
    by_species = [list(rows) for _, rows in groupby(vocabularies, key=lambda row: row["species"])]
    figure, panels = plt.subplots(1, 3, figsize=(1080 * PX, 310 * PX), layout="constrained")
    known = by_species[0]
    # The numbers of segments are evenly spaced on the x axis, not to scale.
    places = np.arange(len(known))
    for axes, key, scale, title in [(panels[0], "shape_within_bl", 100, "shape within a segment, % BL"),
                                    (panels[1], "path_median", 100, "path of a command, median, %"),
                                    (panels[2], "turn_heading_rms_deg", 1, "heading after a turn, rms, deg")]:
        values = scale * np.array([[row[key] for row in rows] for rows in by_species])
        # The upper median where the number of species is even, so that it is the value of a species.
        median = np.sort(values, axis=0)[len(values) // 2]
        axes.plot(places, values.T, color=SPECIES, linewidth=1, label="one species")
        axes.plot(places, median, color=INK, linewidth=2, marker="o", markersize=5, label="their median")
        ours = [row["segments"] for row in known].index(7)
        axes.plot(ours, median[ours], "o", color=OURS, markersize=8, zorder=4,
                  label="the seven of every repertoire here")
        axes.set(ylim=(0, None), title=title, xticks=places,
                 xticklabels=[f"{row['segments']:.0f}\n{row['bytes'] / 1e6:.1f}" for row in known])
        axes.grid(axis="x", color="none")
    panels[0].set_xlabel("above: segments; below: MB with control points", loc="left")
    marks = dict(zip(*panels[0].get_legend_handles_labels()[::-1]))
    panels[2].legend(marks.values(), marks.keys())
    return figure


# A share as a percentage; in HTML, marked, where it misses the goal.
def percent(share, goal=None):
    text = f"{100 * share:.2f}"
    return f'<span class="over">{text}</span>' if goal is not None and share > goal else text


# `name` is the column that names the rows: the species or the command.
def summary_table(rows, name):
    head = ["command", "count", "shape within, %", "in transition, %", "agrees after, s", "path, median, %",
            "9 of 10 within, %", "worst, %", "along, %", "across, %", "heading, rms, deg"]
    return html_table(head, [[
        row[name], f"{row['count']:.0f}", percent(row["shape_within_bl"], SHAPE_GOAL),
        percent(row["shape_transition_bl"]),
        "never" if row["never_agree"] == row["count"] else f"{row['agrees_after_s']:.2f}",
        *(percent(row[key], PATH_GOAL) for key in ["path_median", "path_ninth", "path_worst"]),
        percent(row["path_along"]), percent(row["path_across"]), f"{row['heading_rms_deg']:.1f}"] for row in rows])


# One row for each command, folded away on the page.
def command_table(rows):
    head = ["command", "start, s", "lasts, s", "lag of the beat, s", "shape within, %", "in transition, %", "path, BL",
            "error at the end, %", "most, %", "turn, deg", "heading error, deg"]
    return "<details><summary>Command by command</summary>" + html_table(head, [[
        row["command"], f"{row['start_s']:.2f}", f"{row['duration_s']:.2f}", f"{row['lag_s']:.3f}",
        percent(row["shape_within_bl"], SHAPE_GOAL), percent(row["shape_transition_bl"]), f"{row['path_bl']:.2f}",
        percent(row["path_error_end"], PATH_GOAL), percent(row["path_error_most"]), f"{row['turn_deg']:.1f}",
        f"{row['heading_error_deg']:.1f}"] for row in rows]) + "</details>\n"


# `alone` holds the row of the whole script by species.
def print_tables(summaries, alone):
    """The tables of docs/fidelity.md: species by species, and command by command over all of them."""
    def tenths(number, factor=1):
        return f"{factor * number:.1f}"
    rows = [["*goal*", "", "*1*", "", "*5*", "", "*5*", "", "", "", ""]]
    for row in summaries:
        if row["command"] == "all":
            way = alone[row["species"]]
            rows.append([
                row["species"], f"{row['count']:.0f}", percent(row["shape_within_bl"]),
                percent(row["shape_transition_bl"]), tenths(row["path_median"], 100),
                f"{tenths(row['path_along'], 100)}, {tenths(row['path_across'], 100)}", tenths(row["path_ninth"], 100),
                tenths(row["heading_rms_deg"]), f"{way['path_bl']:.0f}",
                tenths(way["path_error_end"], way["path_bl"]), tenths(way["heading_error_deg"])])
    print(markdown_table(["species", "commands", "shape within a segment, % BL", "shape in transitions, % BL",
                          "path, median, %", "along, across, %", "path, 9 of 10 within, %", "heading, rms, deg",
                          "open loop: way, BL", "off at the end, BL", "heading off, deg"], rows))
    rows = [[row["command"], f"{row['count']:.0f}", tenths(row["path_median"], 100),
             f"{100 * row['paths_within_goal'] / row['count']:.0f}", percent(row["shape_within_bl"]),
             tenths(row["heading_rms_deg"])] for row in summaries if row["species"] == "all"]
    print(markdown_table(["command", "count", "path, median, %", "% of them within 5 %", "shape within a segment, % BL",
                          "heading, rms, deg"], rows), end="")


def main(folder, seed):
    commands, summaries, ticks, vocabularies = (
        read_csv(folder / f"fidelity{name}.csv") for name in ["", "_summaries", "_ticks", "_vocabularies"])
    # The rows of a species stand together, so groupby finds each species once.
    by_species = {species: list(rows) for species, rows in groupby(ticks, key=lambda row: row["species"])}
    alone = {row["species"]: row for row in commands if row["command"] == "open_loop"}

    def show(name, figure):
        return picture(save(figure, folder / f"fidelity_{name}.svg"))
    show("ways", draw_ways_of_all(by_species))
    body = [
        INTRODUCTION, f"<p>Script {seed}.</p>",
        summary_table([row for row in summaries if row["command"] == "all"], "species"),
        "<h2>How few segments are enough</h2>", show("segments", draw_vocabularies(vocabularies))]
    for species, rows in by_species.items():
        way = alone[species]
        length = way["path_bl"]
        own = [row for row in summaries if row["species"] == species]
        # The summaries of a species: first "all", which goes to the end of the table, then each command.
        body += [
            f"<h2>{species}</h2>", show(f"ways_{species}", draw_ways_of_one(rows)),
            f"<p>Left alone for the whole script, the replica ends {way['path_error_end'] * length:.1f} BL from the "
            f"fish after a way of {length:.1f} BL ({percent(way['path_error_end'])} %; at most "
            f"{way['path_error_most'] * length:.1f} BL) and heads {way['heading_error_deg']:.1f} degrees from it.</p>",
            show(f"times_{species}", draw_times(rows)), summary_table(own[1:] + own[:1], "command"),
            command_table([row for row in commands if row["species"] == species and row["command"] != "open_loop"])]
    page = write_page(folder / "fidelity.html", "Fidelity of the replicas", "\n".join(body))
    print(page, file=sys.stderr)
    print_tables(summaries, alone)


main(Path(sys.argv[1]), sys.argv[2])
