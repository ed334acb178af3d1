# SPDX-License-Identifier: Apache-2.0
"""What the scripts share that draw figures and write pages: colours, axes, files, tables in HTML and Markdown."""

import base64
import csv
import html
import os
import sys
from pathlib import Path

# Where aquarama takes what is drawn from, to write it by the rules of all its outputs; else beside the data.
DRAWN = os.environ.get("AQUARAMA_DRAWN")


def end_with_cause(kind, error, trace):
    """What the system refuses is told by the exit status, for one line of aquarama's; all else with its trace."""
    if not DRAWN or not isinstance(error, OSError) or not error.errno:
        return sys.__excepthook__(kind, error, trace)
    os._exit(100 + error.errno)


sys.excepthook = end_with_cause

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np

# Colours: text and main lines, secondary text, grid, notes on published ranges.
INK, QUIET, GRID, AMBER = "#1d2b36", "#5b7280", "#e6ecef", "#a9641a"
PUBLISHED = {"color": "#e08a2c", "linewidth": 1.4, "dashes": (4, 2.5)}  # lines of living fish
PX = 1 / 96  # inches in a px of CSS

# One style for all figures. The salt makes the ids in a file of SVG the same in each run.
plt.rcParams.update({
    "svg.hashsalt": "aquarama",  # the same names in each file
    "font.size": 9, "axes.titlesize": 9.5, "axes.titlelocation": "left", "legend.frameon": False,
    "text.color": INK, "axes.labelcolor": INK, "xtick.color": INK, "ytick.color": INK, "axes.edgecolor": "#9fb1bb",
    "axes.linewidth": 0.8, "axes.grid": True, "axes.axisbelow": True, "grid.color": GRID, "grid.linewidth": 0.8,
    "xtick.major.size": 3, "ytick.major.size": 3, "lines.linewidth": 1.6, "lines.solid_joinstyle": "round",
    "figure.constrained_layout.h_pad": 0.06, "figure.constrained_layout.w_pad": 0.06,
})

# The style sheet of the pages; .over marks what misses a goal, table.words aligns text to the left.
STYLE = """
body { font: 15px/1.5 Helvetica, Arial, sans-serif; color: #1d2b36;
       max-width: 1120px; margin: 2em auto; padding: 0 1em; }
h1, h2, h3 { font-weight: 600; line-height: 1.2; } h2 { margin-top: 2.2em; } p { max-width: 62em; }
.quiet, figcaption, th { color: #4a606c; } .over { color: #c0392b; } code { font-size: 12px; overflow-wrap: anywhere; }
table { border-collapse: collapse; margin: 1em 0; font-size: 14px; font-variant-numeric: tabular-nums; }
th, td { padding: .25em .8em; text-align: right; border-bottom: 1px solid #dbe5ea; vertical-align: bottom; }
th:first-child, td:first-child { text-align: left; } table.words td { text-align: left; }
figure { margin: 1em 0; display: inline-block; vertical-align: top; } figcaption { font-size: 13px; }
img { max-width: 100%; height: auto; } summary { cursor: pointer; margin: 1em 0; }
"""


def save(figure, path):
    """Writes a figure as SVG, the same bytes for the same data, and closes it."""
    # Without date and version of matplotlib, which would differ between runs.
    figure.savefig(drawn(path), metadata={"Date": None, "Creator": None})
    plt.close(figure)
    return Path(path)


def drawn(path):
    """Where the file of this path is written now."""
    return Path(DRAWN) / Path(path).name if DRAWN else Path(path)


def hide_axes(axes):
    """Leaves only what is drawn in them."""
    axes.set_xticks([])
    axes.set_yticks([])
    axes.grid(False)


def read_csv(path):
    """The rows by their columns; numbers as floats, what is empty as None."""
    # Text that is not a number, as a name, stays text.
    def value(text):
        try:
            return float(text) if text else None
        except ValueError:
            return text
    with open(path, newline="", encoding="utf-8") as file:
        return [{key: value(text) for key, text in row.items()} for row in csv.DictReader(file)]


def picture(path, caption=""):
    """A file of SVG as part of a page that fetches nothing."""
    # Embedded as a data URI.
    data = base64.b64encode(drawn(path).read_bytes()).decode()
    return (f'<figure id="{Path(path).stem}"><img alt="{html.escape(caption)}" src="data:image/svg+xml;base64,{data}">'
            f"<figcaption>{caption}</figcaption></figure>\n")


def html_table(head, rows, words=False):
    """The cells are HTML; `words` aligns all of them to the left."""
    def row(cells, kind):
        return "<tr>" + "".join(f"<{kind}>{cell}</{kind}>" for cell in cells) + "</tr>\n"
    return (f'<table{" class=words" if words else ""}>\n' + (row(head, "th") if head else "") +
            "".join(row(cells, "td") for cells in rows) + "</table>\n")


# `head` and `rows` hold strings; the result ends with a line end.
def markdown_table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    rule = "|" + "---|" * len(head)
    return "\n".join(rule if i == 1 else "| " + " | ".join(cells) + " |" for i, cells in enumerate(lines)) + "\n"


def write_page(path, title, body):
    """Writes a page of HTML; returns its path."""
    head = f'<meta charset="utf-8"><title>{title}</title><style>{STYLE}</style>'
    drawn(path).write_text(
        f'<!doctype html>\n<html lang="en"><head>{head}</head>\n<body><h1>{title}</h1>\n{body}</body>'
                          "</html>\n", encoding="utf-8")
    return path


def from_above(points):
    """World (x, z) as it lies on paper: x to the right, z, the right of a fish that heads along x, down."""
    return np.asarray(points, float).reshape(-1, 2) * (1, -1)
