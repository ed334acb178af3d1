# SPDX-License-Identifier: Apache-2.0
"""Makes the page about a repertoire of SPECIES.json, which `aquarama capture` writes: draw_report.py SPECIES.json...

Beside the data come SPECIES.html and its pictures as SPECIES_NAME.svg.
"""

import json
import sys
from pathlib import Path

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon

from figures import (AMBER, INK, PUBLISHED, PX, QUIET, from_above, hide_axes, html_table, picture, plt, save,
                     write_page)

# One colour a segment: straight on in blues, turns in warm colours for the left and greens for the right, curves in
# paler ones of their side and width.
COLOURS = dict(zip(["forward_slow", "forward_medium", "forward_fast", "turn_left_gradual", "turn_left_sharp",
                    "turn_right_gradual", "turn_right_sharp"],
                   ["#7fb2d6", "#2f77b4", "#143d6b", "#e2a33b", "#bf4a24", "#7fb069", "#2e7d4f"]))
COLOURS |= {f"curve_{way}_{gait}": colour for gait in ["slow", "medium", "fast"]
            for way, colour in [("left_wide", "#f0cf9a"), ("left_tight", "#dd9c83"),
                                ("right_wide", "#c0dab5"), ("right_tight", "#93c2a6")]}
INTRODUCTION = """<p class="quiet">A repertoire of motion captured from a simulated fish. Lengths are in body lengths
(BL), so that they hold for a fish of any size; a tick is 1/60 s.</p>"""
MIDLINES = """<p class="quiet">Midlines at 16 phases of one beat, dark to light; thick: how far each point of them
swings; dashed: how far a saithe's does (Videler &amp; Hess 1984), a carangiform swimmer.</p>"""
SPEED = """<p class="quiet">The three captured gaits, and the straight line through them by least squares.
Bainbridge's line is for beats above 5 Hz; for slower and larger fish it is a guide only.</p>"""
TURNING = """<p>To the left is positive. Living fish turn at 100 to 500 deg/s in routine turns (Domenici 2004), at the
tightest with a radius of 0.11 (bass) to 0.18 BL (trout; Webb 1983).</p>"""
CLOSURE = """<p>How a segment meets itself when it is repeated. Pose: by how much the farthest nodal point is off the
smooth way of its neighbours in time, where the last phase meets the first and at most elsewhere. Heading: after one
and after a hundred repetitions, from the course of a gait, or beyond so many times the angle of a turn. Lean is roll
and pitch together.</p>"""
SEGMENTS = """<p>In each frame the body as it bends, and the body frame up to then (as in Figs. 3 and 4 of Yu &amp;
Terzopoulos 1998).</p>"""
# Colours of the axes of the body frame.
X_AXIS, Z_AXIS = "#10202b", "#e08a2c"
X_LENGTH, Z_LENGTH = 0.22, 0.16  # of the axes of the body frame, body lengths


def draw_body(body):
    """The straight fish from the side and from above: nodal points, springs, muscles, and its skin."""
    nodes, skin = np.array(body["nodes"]), np.array(body["skin"]).reshape(-1, 3)
    everything = np.concatenate([nodes, skin])
    # Coordinates of the panels: x and y from the side; x and z, which points down, from above.
    sides = [[0, 1], [0, 2]]
    # The panels share one scale: their widths are in the ratio of what they show, and the height follows.
    spans = [np.ptp(everything[:, side], axis=0) for side in sides]
    high = 940 * PX * max(span[1] for span in spans) / sum(span[0] for span in spans) + 0.4
    figure, panels = plt.subplots(1, 2, figsize=(940 * PX, high), gridspec_kw={
        "width_ratios": [span[0] for span in spans], "wspace": 0.05,
        "left": 0.01, "right": 0.99, "bottom": 0.3 / high, "top": 1})
    for axes, side, up in zip(panels, sides, [1, -1]):
        def lines(pairs, side=side, up=up):
            return [nodes[pair][:, side] * (1, up) for pair in pairs]
        if len(skin):
            axes.add_collection(PolyCollection([skin[face][:, side] * (1, up) for face in body["faces"]],
                                               facecolors="#d8e3e9", edgecolors="#d8e3e9", linewidths=0.4))
        axes.add_collection(LineCollection(lines(body["springs"]), colors="#8ba0ab", linewidths=0.7))
        axes.add_collection(LineCollection(lines(body["muscles"]), colors="#bf4a24", linewidths=1.6))
        axes.plot(nodes[:, side[0]], up * nodes[:, side[1]], "o", color=INK, markersize=3.6)
        axes.set_aspect("equal")
        axes.axis("off")
    marks = [Line2D([], [], marker="o", color=INK, linestyle="", markersize=3.6, label=f"{len(nodes)} nodal points"),
             Line2D([], [], color="#8ba0ab", linewidth=0.8, label=f"{len(body['springs'])} springs"),
             Line2D([], [], color="#bf4a24", linewidth=1.6, label=f"{len(body['muscles'])} muscles")]
    if len(skin):
        marks.append(Patch(color="#d8e3e9", label="recorded control points"))
    figure.legend(handles=marks, loc="lower left", ncols=4, bbox_to_anchor=(0, -0.02))
    return figure


def draw_segment(segment):
    """Frame by frame, as the paper's Figs. 3 and 4: the bent body, and up to then the axes of the body frame."""
    # Every second phase: with all of them the axes would cover one another.
    frames = segment["frames"][::2]
    origins = from_above([frame["origin"] for frame in frames])
    axes_of_body = [(from_above([frame["z_axis"] for frame in frames]) * Z_LENGTH, Z_AXIS),
                    (from_above([frame["x_axis"] for frame in frames]) * X_LENGTH, X_AXIS)]
    fish = [from_above(points) for view in segment["views"]
            for points in [view["outline"], view["midline"], *view["pectorals"]]]
    # All panels have the same limits, so that the motion from one to the next can be seen.
    seen = np.concatenate([*fish, *(origins + axis for axis, _ in axes_of_body)])
    least, most = seen.min(axis=0) - 0.06, seen.max(axis=0) + 0.06
    most[1] += (most[0] - least[0]) * 26 / 262  # room for the time
    wide, high = 272 * PX, 10 * PX + 0.24 * 4 * 272 * PX * (most[1] - least[1]) / (most[0] - least[0])
    tall = 2 * high + 0.35
    figure = plt.figure(figsize=(4 * wide, tall))
    # Two rows of four panels.
    for i, view in enumerate(segment["views"]):
        axes = figure.add_axes([i % 4 / 4 + 0.005, 1 - (i // 4 + 1) * high / tall, 0.24, (high - 10 * PX) / tall],
                               xlim=(least[0], most[0]), ylim=(least[1], most[1]))
        hide_axes(axes)
        for fin in view["pectorals"]:
            axes.add_patch(Polygon(from_above(fin), facecolor="#dbe5ea", edgecolor="#6d8794", linewidth=0.6))
        axes.add_patch(Polygon(from_above(view["outline"]), facecolor="#b9cbd6", edgecolor="#33515f", linewidth=0.8))
        midline = from_above(view["midline"])
        axes.plot(*midline.T, color="#6d8794", linewidth=0.6)
        axes.plot(*midline[0], "o", color=X_AXIS, markersize=3)
        # The body frames from the start up to this view.
        count = view["phase"] // 2 + 1
        for axis, colour in axes_of_body:
            axes.quiver(*origins[:count].T, *axis[:count].T, color=colour, angles="xy", scale_units="xy", scale=1,
                        width=0.9, units="dots", headwidth=4.5, headlength=5, headaxislength=4.5, zorder=3)
        seconds = segment["period_seconds"] * view["phase"] / (len(segment["frames"]) - 1)
        axes.annotate(f"{seconds:.3f} s", (0, 1), (5, -5), "axes fraction", "offset points", va="top")
    # The bar at the lower right is a body length.
    length = 0.24 / (most[0] - least[0])  # of a body, as a share of the figure's width
    figure.legend(handles=[
        Line2D([], [], color=colour, marker=">", markevery=[1], markersize=4, linewidth=1, label=label)
        for colour, label in [(X_AXIS, "x axis of the body frame, anterior"), (Z_AXIS, "z axis, to the right")]],
                  loc="lower left", ncols=2, bbox_to_anchor=(0, -0.01))
    foot = 0.15 / tall
    figure.add_artist(Line2D([0.995 - length, 0.995], [foot, foot], color=INK, linewidth=1.6))
    figure.text(0.985 - length, foot, "1 body length", ha="right", va="center")
    return figure


def draw_turns(turns):
    """The way of the body frame's origin in each turn, from one start, and the heading at its end."""
    figure, axes = plt.subplots(figsize=(390 * PX, 460 * PX), layout="constrained")
    for turn in turns:
        way = from_above([frame["origin"] for frame in turn["frames"]])
        heading = from_above(turn["frames"][-1]["x_axis"])[0]
        tip = way[-1] + 0.25 * heading / np.linalg.norm(heading)
        axes.plot(*way.T, color=COLOURS[turn["name"]], linewidth=2, label=turn["name"])
        axes.plot(*tip, ".", color="none")  # within the limits
        axes.annotate("", tip, way[-1], arrowprops={"arrowstyle": "-|>", "color": COLOURS[turn["name"]], "shrinkA": 0,
                                                    "shrinkB": 0})
    # Left and right turns have equal room.
    side = max(abs(limit) for limit in axes.get_ylim())
    axes.set(xlim=(0, None), ylim=(-side, side), aspect="equal", xlabel="ahead, BL", ylabel="to the left, BL")
    axes.legend(loc="upper left")
    return figure


def draw_headings(turns):
    """The heading over each turn."""
    figure, axes = plt.subplots(figsize=(500 * PX, 460 * PX), layout="constrained")
    for turn in turns:
        # The x axis of the body frame at each phase; its angle is the heading.
        ahead = from_above([frame["x_axis"] for frame in turn["frames"]])
        seconds = np.linspace(0, turn["period_seconds"], len(ahead))
        axes.plot(seconds, np.degrees(np.arctan2(ahead[:, 1], ahead[:, 0])), color=COLOURS[turn["name"]], linewidth=2,
                  label=turn["name"])
    axes.set(xlim=(0, None), xlabel="time, s", ylabel="heading, deg, to the left")
    axes.legend(loc="center right")
    return figure


def draw_midlines(gait):
    """The midlines of one beat over each other, how far each point of them swings, and a saithe's does."""
    figure, axes = plt.subplots(figsize=(372 * PX, 143 * PX), layout="constrained")
    # 16 of the 64 phases.
    lines = gait["midlines"]["lines"][::4]
    for i, line in enumerate(lines):  # from dark to light through the beat, so that the wave's way can be seen
        axes.plot(line["station"], line["left"], color=plt.cm.Blues_r(0.15 + 0.55 * i / len(lines)), linewidth=0.9)
    swing, station = gait["midlines"]["swing"], np.linspace(0, 1, 41)
    # Half the amplitude in body lengths against the distance from the nose.
    saithe = 0.02 - 0.0825 * station + 0.1625 * station**2  # Videler & Hess 1984
    for side in [-1, 1]:
        axes.plot(swing["station"], side * np.array(swing["half"]), color=COLOURS[gait["name"]], linewidth=1.8)
        axes.plot(station, side * saithe, **PUBLISHED)
    axes.set(xlim=(0, 1), ylim=(-0.15, 0.15), yticks=[-0.1, 0, 0.1], aspect="equal",
             xlabel="distance from the nose, BL", ylabel="to the left, BL")
    return figure


def draw_speed(gaits, line):
    """Speed against beat frequency with the line through the gaits, and Bainbridge's (1958)."""
    beats, speeds = [gait["beat_hertz"] for gait in gaits], [gait["speed"] for gait in gaits]
    figure, axes = plt.subplots(figsize=(520 * PX, 380 * PX), layout="constrained")
    # Bainbridge gives the speed in lengths a second as (3 f - 4) / 4 for a beat frequency f.
    hertz = np.linspace(0, 1.12 * max(beats), 200)
    sign = "−" if line["intercept"] < 0 else "+"
    # The line through the gaits, and the published one.
    for speed, style in [(line["slope"] * hertz + line["intercept"], {
            "color": QUIET, "linewidth": 1.3,
            "label": f"speed = {line['slope']:.2f} f {sign} {abs(line['intercept']):.2f}, "
                     f"R² = {line['r_squared']:.3f}"}),
            ((3 * hertz - 4) / 4, PUBLISHED | {"label": "dace, trout, goldfish: (3 f − 4) / 4 (Bainbridge 1958)"})]:
        axes.plot(hertz, speed, **style)
    for gait in gaits:
        axes.plot(gait["beat_hertz"], gait["speed"], "o", color=COLOURS[gait["name"]], markersize=8)
        axes.annotate(gait["name"].removeprefix("forward_"), (gait["beat_hertz"], gait["speed"]), (-6, 6),
                      textcoords="offset points", ha="right")
    axes.set(xlim=(0, hertz[-1]), ylim=(0, 1.3 * max(speeds)), xlabel="tail beat, Hz", ylabel="speed, BL/s")
    axes.legend(loc="upper left")
    return figure


def draw_strouhal_and_stride(gaits):
    """Both against beat frequency, over the ranges of living fish."""
    figure, panels = plt.subplots(2, 1, figsize=(460 * PX, 380 * PX), sharex=True, layout="constrained")
    # The band is the range of living fish.
    for axes, key, label, band, source in [
            (panels[0], "strouhal", "Strouhal number", (0.2, 0.4), "0.2 to 0.4: Taylor, Nudds & Thomas 2003"),
            (panels[1], "stride", "stride, BL", (0.5, 0.7), "0.5 to 0.7: Videler & Wardle 1991")]:
        axes.axhspan(*band, color="#fbeedd", zorder=0)
        for gait in gaits:
            axes.plot(gait["beat_hertz"], gait[key], "o", color=COLOURS[gait["name"]], markersize=8)
            axes.annotate(f"{gait[key]:.2f}", (gait["beat_hertz"], gait[key]), (0, -16), textcoords="offset points",
                          ha="center")
        axes.text(0.02, 0.95, source, transform=axes.transAxes, va="top", color=AMBER)
        axes.set(xlim=(0, 1.15 * gaits[-1]["beat_hertz"]), ylim=(0, 0.9), ylabel=label)
    panels[1].set_xlabel("tail beat, Hz")
    return figure


# What the repertoire's file holds. A speed response of zeros means that none was measured.
def file_table(file):
    # One value for each gait: slow, medium, fast.
    drag = ", ".join(f"{value:.3f}" for value in file["swim_drag"])
    control = (f" and {file['control_points']} control points" if file["control_points"]
               else "; control points are computed from them, not recorded")
    response = (
        f"drag {drag} swimming, {file['retreat_drag']:.3f} retreating, {file['glide_drag']:.3f} gliding, per BL; brake "
        f"{file['brake_rate']:.3f} per s"
                if file["glide_drag"] > 0 or file["brake_rate"] > 0 else "not measured")
    return html_table([], [
        ["recorded fish", f"{file['recorded_metres']:.3f} m, nose to tip of the tail"],
        ["segments", f"{file['segments']} captured, {file['phases']} phases each"],
        ["poses", f"{file['nodal_points']} nodal points{control}"],
        ["speed response", response],
        ["file", f"{file['bytes']} bytes, format version {file['format_version']}"],
        ["SHA-256", f"<code>{file['sha256']}</code>"]], words=True)


# The name of a segment after a square in its colour, as HTML.
def swatch(segment):
    return f'<span style="color:{COLOURS[segment["name"]]}">■</span> {segment["name"]}'


def gait_table(gaits):
    # Words, key in the data, digits after the point, the range of living fish, its source.
    quantities = [
        ("tail beat, Hz", "beat_hertz", 2, "", ""),
        ("speed, BL/s", "speed", 2, "linear in the beat, see below", "Bainbridge 1958"),
        ("stride, BL a beat", "stride", 3, "0.5–0.7, typically 0.6–0.7", "Videler &amp; Wardle 1991"),
        ("tail, peak to peak, BL", "tail", 3, "rises with the beat to about 0.2", "Bainbridge 1958"),
        ("Strouhal number, beat × tail / speed", "strouhal", 3, "0.2–0.4", "Taylor, Nudds &amp; Thomas 2003"),
        ("nose, peak to peak, BL", "nose", 3, "0.008–0.024 (largemouth bass)", "Jayne &amp; Lauder 1995"),
        ("length of the body wave, BL", "wavelength", 2, "0.9–1.1 (carangiform)", "Videler &amp; Hess 1984")]
    return html_table(["", *map(swatch, gaits), "living fish", ""],
                      [[words, *(f"{gait[key]:.{digits}f}" for gait in gaits), living, source]
                       for words, key, digits, living, source in quantities])


# Angles and rates are positive to the left.
def turn_table(turns):
    head = ["segment", "lasts, s", "turns, deg", "mean radius, BL", "mean rate, deg/s", "peak rate, deg/s",
            "mean speed, BL/s"]
    return html_table(head, [[swatch(turn), f"{turn['period_seconds']:.3f}", f"{turn['turn_degrees']:.1f}",
                              f"{turn['radius']:.2f}", f"{turn['turn_rate']:.0f}", f"{turn['peak_turn_rate']:.0f}",
                              f"{turn['speed']:.2f}"] for turn in turns])


def closure_table(segments):
    def exact(value):  # what is zero but for rounding is no exponent to read
        return "0" if abs(value) < 1e-9 else f"{abs(value):.0e}"
    def drifts(segment):
        return [exact(segment[f"drift_after_{times}"][drift]) for drift in ["heading_degrees", "lean_degrees", "climb"]
                for times in [1, 100]]
    head = ["segment", "pose at the join, BL off a smooth way", "elsewhere", "heading after 1, deg", "after 100",
            "lean after 1, deg", "after 100", "climb after 1, BL", "after 100", "largest step, BL a tick"]
    return html_table(head, [[swatch(segment), f"{segment['seam_at_the_join']:.5f}", f"{segment['seam_elsewhere']:.5f}",
                              *drifts(segment), f"{segment['largest_step']:.4f}"] for segment in segments])


def report(path):
    """Draws what one file of data tells and writes the page."""
    data = json.loads(path.read_text(encoding="utf-8"))
    # The order is that of motion::Action without slopes and the retreat: three gaits, twelve curves, then four turns.
    segments = data["segments"]
    gaits, curves, turns = segments[:3], segments[3:15], segments[15:]

    def show(name, figure, caption=""):
        return picture(save(figure, path.with_name(f"{path.stem}_{name}.svg")), caption)
    body = [
        INTRODUCTION, show("body", draw_body(data["body"]), "The fish when it glides, from its right and from above."),
        file_table(data["file"]), "<h2>Swimming straight</h2>", gait_table(gaits), "<h3>Body wave</h3>",
        *(show(f"midlines_{gait['name']}", draw_midlines(gait), gait["name"]) for gait in gaits), MIDLINES,
        "<h3>Speed, Strouhal number and stride</h3>",
        show("speed", draw_speed(gaits, data["speed_line"])), show("strouhal", draw_strouhal_and_stride(gaits)), SPEED,
        "<h2>Turning</h2>", TURNING, turn_table(turns + curves),
        show("turns", draw_turns(turns), "The way of the body frame's origin, and the heading at its end."),
        show("headings", draw_headings(turns), "The heading of the body frame over the turn."),
        "<h2>Closure</h2>", CLOSURE, closure_table(segments), "<h2>Segments from above</h2>", SEGMENTS,
        *(f"<h3>{segment['name']}</h3>" + show(segment["name"], draw_segment(segment)) for segment in segments)]
    title = data["species"].replace("_", " ").capitalize() + ": repertoire"
    print(write_page(path.with_suffix(".html"), title, "\n".join(body)), flush=True)


for name in sys.argv[1:]:
    report(Path(name))
