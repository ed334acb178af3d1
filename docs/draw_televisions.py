#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""draw_televisions.py FOLDER: the pictures of docs/three_televisions.md, from what tests/end_to_end/monitors_test.py
left there."""
import math
import re
import sys
from pathlib import Path

from PIL import Image

folder = Path(sys.argv[1])


def sheet(name, monitors):
    """The screens side by side, a little apart as their frames keep them."""
    picture = Image.open(folder / f"{name}.png").convert("RGB")
    width = picture.width // monitors
    gap = width // 40
    row = Image.new("RGB", (picture.width + (monitors - 1) * gap, picture.height), (60, 60, 60))
    for i in range(monitors):
        row.paste(picture.crop((i * width, 0, (i + 1) * width, picture.height)), (i * (width + gap), 0))
    row.thumbnail((1000, 1000), Image.LANCZOS)
    row.save(folder / f"{name}.webp", quality=85, method=6)


def plan(rig):
    """From above: the televisions, the eye and the measures that aquarama new-rig asks for."""
    panels = [tuple(map(float, numbers)) for numbers in re.findall(
        r"x_m: (\S+) y_m: 0 z_m: (\S+) }\s+yaw_deg: (\S+)\s+width_m: (\S+)", rig)]
    scale, left, top = 200, 360, 330
    at = lambda x, z: (left + scale * x, top + scale * z)
    shapes = []
    for x, z, yaw, width in panels:
        along = (math.cos(math.radians(yaw)) * width / 2, -math.sin(math.radians(yaw)) * width / 2)
        (x1, y1), (x2, y2) = at(x - along[0], z - along[1]), at(x + along[0], z + along[1])
        shapes.append(
            f'<line x1="{x1:.0f}" y1="{y1:.0f}" x2="{x2:.0f}" y2="{y2:.0f}" stroke="#1f6f8b" stroke-width="9"/>')
    middle = panels[len(panels) // 2]
    (ex, ey), (mx, my) = at(0, 0), at(middle[0], middle[1])
    right = panels[-1]
    edge = at(middle[3] / 2, middle[1])
    radius = 80
    turn = math.radians(-right[2])
    tip = (edge[0] + radius * math.cos(turn), edge[1] + radius * math.sin(turn))
    text = lambda x, y, words: f'<text x="{x:.0f}" y="{y:.0f}">{words}</text>'
    shapes += [
        f'<circle cx="{ex}" cy="{ey}" r="7" fill="#333"/>',
        f'<line x1="{ex}" y1="{ey - 10}" x2="{mx:.0f}" y2="{my + 8:.0f}" stroke="#999" stroke-dasharray="5 4"/>',
        f'<line x1="{edge[0]:.0f}" y1="{edge[1]:.0f}" x2="{edge[0] + 110:.0f}" y2="{edge[1]:.0f}" stroke="#999" '
        f'stroke-dasharray="5 4"/>',
        f'<path d="M {edge[0] + radius:.0f} {edge[1]:.0f} A {radius} {radius} 0 0 1 {tip[0]:.0f} {tip[1]:.0f}" '
        f'fill="none" stroke="#999"/>',
        text(ex + 16, ey + 6, "the eye"),
        text(mx + 10, (ey + my) / 2, f"distance {-middle[1]:.1f} m"),
        text(edge[0] + radius + 16, edge[1] + 42, f"angle {-right[2]:.0f}&#176;"),
        text(mx - 55, my - 16, "middle"),
        text(at(panels[0][0], 0)[0] - 80, at(0, panels[0][1])[1], "left"),
        text(at(right[0], 0)[0] + 50, at(0, right[1])[1], "right")]
    body = "\n".join(shapes)
    (folder / "televisions_plan.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="720" height="380" viewBox="0 0 720 380" '
        f'font-family="sans-serif" font-size="17">\n'
        f'<rect width="720" height="380" fill="white"/>\n{body}\n</svg>\n')


sheet("televisions_grid", 3)
sheet("televisions_reef", 3)
hall = Image.open(folder / "hall.png").convert("RGB").resize((1000, 563), Image.LANCZOS)
hall.save(folder / "televisions_hall.webp", quality=85, method=6)
plan((folder / "school.txtpb").read_text())
