# SPDX-License-Identifier: Apache-2.0
"""Prints the tables of what a visitor sees and draws the figure of the day: draw_wall.py wall DIR [figure].

DIR holds the files of CSV that `aquarama study wall` writes (see wall_study.h).
"""

import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "capture/report"))
from figures import PX, QUIET, markdown_table, plt, read_csv, save

# For each row of measures.csv: words with the unit, the factor of the unit, digits after the point.
MEASURES = {
    "seconds": ("time, s", 1, 0),
    "cells": ("cells with a fish of half a degree, %", 100, 0),
    "in_view": ("fish of half a degree", 1, 0),
    "large_left": ("fish of a degree: left third", 1, 0),
    "large_middle": ("middle third", 1, 0),
    "large_right": ("right third", 1, 0),
    "largest_group": ("largest school, % of the fish in view", 100, 0),
    "species": ("species of a degree", 1, 0),
    "parts": ("parts of the school", 1, 0),
    "full_left": ("time with five fish of a degree, %: left third", 100, 0),
    "full_middle": ("middle third", 100, 0),
    "full_right": ("right third", 100, 0),
    "full_all": ("all thirds at once", 100, 0),
    "gap_left": ("longest time without a fish of a degree, s: left third", 1, 0),
    "gap_middle": ("middle third", 1, 0),
    "gap_right": ("right third", 1, 0),
    "events": ("events in view a minute", 1, 1),
    "mean_in_view": ("fish of half a degree, mean", 1, 1),
}

# What living fish do by day, of their time. Species, what it is called, the columns of species.csv whose sum is
# comparable, and the published share, %, with its source. Without a source it is from memory of the literature. A fish
# of a cloud that hovers picks what drifts by, so it forages.
PUBLISHED = [
    ("parrotfish", "feeding", ["graze share", "eat share"], "84-91 (Bellwood 1995)"),
    ("powder_blue_tang", "feeding", ["graze share", "eat share"], "80 (*A. lineatus*, Craig 1996)"),
    ("powder_blue_tang", "defence", ["charge share"], "10 (*A. lineatus*, Craig 1996)"),
    ("green_chromis", "foraging", ["hover share", "eat share"], "above 85 (*Dascyllus albisella*); picking 80"),
    ("green_chromis", "hidden", ["hide share"], "2-5"),
    ("sea_goldie", "foraging", ["hover share", "eat share"], "picking 80"),
    ("sea_goldie", "hidden", ["hide share"], "2-5"),
    ("butterflyfish", "feeding", ["graze share", "eat share"], "33 (*C. trifascialis*, Irons 1989)"),
    ("cleaner_wrasse", "inspecting", ["inspect share"], "36 (Grutter 1996)"),
    ("trumpetfish", "hanging", ["lie in wait share"], "55"),
    ("trumpetfish", "following", ["shadow share"], "25"),
    ("coral_grouper", "resting", ["lie in wait share", "rest share"], "80"),
    ("coral_grouper", "patrolling", ["patrol share"], "15"),
    ("coral_grouper", "hunting", ["eat share"], "2"),
    ("clownfish", "within 0.3 m of an anemone", ["at_home"], "80"),
    ("blacktip_reef_shark", "swimming", ["swims"], "100"),
]


def number(value, digits):
    return "–" if value is None else f"{value:.{digits}f}"


def print_measures(rows):
    """Median and 5 % quantile by day and night; a figure that has one value stands under the median."""
    by_key = {row["measure"]: row for row in rows}

    def cells(row):
        words, factor, digits = MEASURES[row["measure"]]
        # Without a second of a part of the day nothing is known of it.
        values = [row[part + of] if by_key["seconds"][part] else None
                  for part in ["day", "night"] for of in ["", "_low"]]
        return [words, *(number(None if value is None else factor * value, digits) for value in values)]

    head = ["each second", "by day: median", "5 %", "by night: median", "5 %"]
    print(markdown_table(head, [cells(by_key[key]) for key in MEASURES]))
    day, night = by_key["mean_in_view"]["day"], by_key["mean_in_view"]["night"]
    print(f"night to day in view: {night / day:.2f}\n" if day and night else "night to day in view: –\n")


def print_events(rows):
    print(markdown_table(["event", "in view a minute by day", "by night", "in view or not, in all"], [[
        row["event"], f"{row['day_a_minute']:.2f}", f"{row['night_a_minute']:.2f}", f"{row['all']:.0f}"]
        for row in rows]))


def shares_of(row):
    """The shares of a species' time by occupation, which name the columns."""
    return {key.removesuffix(" share"): value for key, value in row.items() if key.endswith(" share")}


def print_species(rows):
    """A row a species and part of the day that it was seen in."""
    routines = list(shares_of(rows[0]))
    head = ["species", "fish", "part of the day", "nearest neighbour, lengths: median / 5 %",
            "polarisation: median / 5 %", " / ".join(routines) + ", %"]
    seen = [row for row in rows if sum(shares_of(row).values()) > 0]
    print(markdown_table(head, [[
        row["species"], f"{row['fish']:.0f}", "day" if row["is_day"] else "night",
        f"{row['nearest']:.1f} / {row['nearest_low']:.1f}" if row["fish"] > 1 else "–",
        f"{row['polarisation']:.2f} / {row['polarisation_low']:.2f}" if row["fish"] > 1 else "–",
        " / ".join(f"{100 * share:.1f}" for share in shares_of(row).values())] for row in seen]))


def print_budgets(rows):
    """Time by day of the species that something is published about."""
    by_day = {row["species"]: row for row in rows if row["is_day"] and sum(shares_of(row).values()) > 0}
    budgets = [[species, words, " + ".join(column.removesuffix(" share").replace("_", " ") for column in columns),
                f"{100 * sum(by_day[species][column] or 0 for column in columns):.0f}", published]
               for species, words, columns, published in PUBLISHED if species in by_day]
    if budgets:
        print(markdown_table(["species", "by day", "counted as", "share of the time, %", "published, %"], budgets))


# Pieces of the day of which a curve shows the figures.
PIECES = 40


def pieces_of(rows):
    """The rows of each piece of the day, those of all days together, and the minutes of the pieces' middles."""
    length = max(row["second_of_day"] for row in rows) + 1
    pieces = [[] for _ in range(min(PIECES, len(rows)))]
    for row in rows:
        pieces[int(row["second_of_day"] / length * len(pieces))].append(row)
    minutes = (np.arange(len(pieces)) + 0.5) * length / len(pieces) / 60
    seen = [i for i, piece in enumerate(pieces) if piece]
    return [pieces[i] for i in seen], minutes[seen]


def shade_nights(axes, pieces, minutes):
    """Grey behind the pieces that are night."""
    half = (minutes[1] - minutes[0]) / 2 if len(minutes) > 1 else 0.5
    for piece, middle in zip(pieces, minutes):
        if not piece[0]["is_day"]:
            axes.axvspan(middle - half, middle + half, color="#dfe5ea", linewidth=0)


# Panels of the figure: words, columns of seconds.csv with colours and names, factor.
PANELS = [
    ("cells with a fish of half a degree, %", [("cells", "#1f6f8b", "")], 100),
    ("fish of a degree", [("left", "#b4472f", "left"), ("middle", "#1f6f8b", "middle"), ("right", "#c9a227", "right")],
     1),
    ("largest school, % of the fish in view", [("largest_group", "#1f6f8b", "")], 100),
    ("species of a degree", [("species", "#1f6f8b", "")], 1),
    ("events in view a minute, mean", [("events", "#1f6f8b", "")], 60),
]


def draw_panel(axes, pieces, minutes, columns, factor):
    """Medians as lines, with the 5 % quantile as a band below where there is one line; of events their mean."""
    for column, colour, name in columns:
        values = [factor * np.array([row[column] for row in piece]) for piece in pieces]
        middle = [piece.mean() if column == "events" else np.median(piece) for piece in values]
        axes.plot(minutes, middle, color=colour, linewidth=1.3, label=name)
        if len(columns) == 1 and column != "events":
            axes.fill_between(minutes, [np.quantile(piece, 0.05) for piece in values], middle, color=colour, alpha=0.2,
                              linewidth=0)
    if len(columns) > 1:
        axes.legend(ncols=len(columns), loc="upper right", fontsize=7.5)


def draw_day(rows):
    """The measures over the day; a scene without a day over its time."""
    pieces, minutes = pieces_of(rows)
    figure, panels = plt.subplots(len(PANELS), 1, figsize=(906 * PX, 780 * PX), layout="constrained", sharex=True)
    for axes, (words, columns, factor) in zip(panels, PANELS):
        shade_nights(axes, pieces, minutes)
        draw_panel(axes, pieces, minutes, columns, factor)
        axes.set(ylim=(0, None))
        axes.margins(x=0.02)
        axes.set_title(words, color=QUIET)
    panels[-1].set_xlabel("minutes since midnight of the scene's day; night is grey; lines: median, bands: to the 5 % "
                          "quantile")
    return figure


def main(folder, more):
    print()
    print_measures(read_csv(folder / "measures.csv"))
    print_events(read_csv(folder / "events.csv"))
    species = read_csv(folder / "species.csv")
    print_species(species)
    print_budgets(species)
    # The tables go to standard output; the name of the figure must not be mixed into them.
    if more == "figure":
        print(save(draw_day(read_csv(folder / "seconds.csv")), folder / "wall.svg"), file=sys.stderr)


main(Path(sys.argv[2]), sys.argv[3] if len(sys.argv) > 3 else "")
