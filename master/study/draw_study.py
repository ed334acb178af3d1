# SPDX-License-Identifier: Apache-2.0
"""Prints the tables of docs/adaptation.md and draws the figure: draw_study.py adaptation DIR [figure], or
draw_study.py chronicle DIR HOURS.

DIR holds the files of CSV that `aquarama study` or `aquarama study chronicle` writes (see study.h).
"""

import sys
from collections import defaultdict
from pathlib import Path

import numpy as np
from scipy import stats

sys.path.append(str(Path(__file__).resolve().parents[2] / "capture/report"))
from figures import PX, QUIET, markdown_table, plt, read_csv, save

# For each column of adaptation.csv: words with the unit, digits after the point, published value.
QUANTITIES = {
    "touches_per_fish_minute": ("overlaps that begin, a fish and minute", 3, ""),
    "deep_touches_per_fish_minute": ("of them deeper than a quarter of a body", 4, ""),
    "overlap_share_percent": ("time in another fish, %", 2, ""),
    "bumps_per_fish_minute": ("into rock, sand or surface, a fish and minute", 4, ""),
    "meals_per_try": ("particles eaten a target gone for", 3, ""),
    "particles_per_fish_minute": ("particles eaten a fish and minute", 3, ""),
    "pursuit_seconds_per_particle": ("pursuit for each particle eaten, s", 2, ""),
    "half_pinch_seconds": ("until half a pinch is eaten, s", 2, ""),
    "catches_per_rush": ("prey caught a rush", 3, ""),
    "same_segment_percent": ("pairs of the school on one segment, %", 1, ""),
    "in_step_percent": ("pairs in step (same segment, a sixteenth of a beat), %", 2, ""),
    "phase_resultant": ("mean resultant length of the phases", 3, "0.12: 51 at random"),
    "nearest_neighbour_lengths": ("nearest neighbour, body lengths", 2,
                                  "0.5-1.5 (Partridge 1980; Pitcher & Parrish 1993)"),
    "polarisation": ("polarisation", 2, "> 0.65 schooling (Tunstrom 2013)"),
    "rotation": ("rotation", 2, "> 0.65 milling (Tunstrom 2013)"),
    "intention_changes_per_minute": ("changes of intention, a fish and minute", 2, ""),
}
# Panels of the figure: the adaptation, the condition without it, and the scenario and quantity in
# which its effect should show.
PANELS = [("recommendations", "no recommendations", "school", "same_segment_percent"),
          ("recommendations", "no recommendations", "school", "in_step_percent"),
          ("enlarged regions", "regions not enlarged", "crowded tank", "touches_per_fish_minute"),
          ("enlarged regions", "regions not enlarged", "reef_1998", "touches_per_fish_minute"),
          ("earlier pursuit", "late pursuit", "alone: bigeye_scad", "pursuit_seconds_per_particle"),
          ("earlier pursuit", "late pursuit", "alone: blue_tang", "pursuit_seconds_per_particle")]
# Scenarios of a single fish have this before the name of its species; of them only these quantities are printed.
ALONE = "alone: "
ALONE_QUANTITIES = ["pursuit_seconds_per_particle", "meals_per_try"]
# Colours of runs without and with the adaptation.
WITHOUT, WITH = "#b4472f", "#1f6f8b"


def is_clear(without, with_all):
    """Whether runs differ, seed by seed, by more than chance would do in 95 of 100 studies."""
    # A paired t-test: both runs of a seed begin with the same fish.
    differences = with_all - without
    differences = differences[~np.isnan(differences)]
    # One difference has no standard error.
    if len(differences) < 2:
        return False
    return abs(differences.mean()) > stats.t.ppf(0.975, len(differences) - 1) * stats.sem(differences)


def runs_of(rows):
    """The values of all seeds by scenario, condition and quantity; NaN where a run has none."""
    runs = defaultdict(lambda: defaultdict(lambda: defaultdict(list)))
    for row in rows:
        for quantity in QUANTITIES:
            runs[row["scenario"]][row["condition"]][quantity].append(np.nan if row[quantity] is None else row[quantity])
    # Lists become arrays; all have the seeds in the same order, so that they can be compared in pairs.
    return {scenario: {condition: {quantity: np.array(values) for quantity, values in quantities.items()}
                       for condition, quantities in conditions.items()} for scenario, conditions in runs.items()}


def cell(values, digits, is_bold):
    """Mean and its standard error over the seeds that have a value."""
    values = values[~np.isnan(values)]
    if len(values) == 0:
        return "–"
    error = stats.sem(values) if len(values) > 1 else 0
    text = f"{values.mean():.{digits}f} ± {error:.{digits}f}"
    return f"**{text}**" if is_bold else text


def cells_of(conditions, quantity):
    """A cell for each condition; bold differs clearly from the first, "all"."""
    digits = QUANTITIES[quantity][1]
    # The first condition in the file is "all": with every adaptation.
    with_all = next(iter(conditions.values()))
    return [cell(of[quantity], digits, of is not with_all and is_clear(of[quantity], with_all[quantity]))
            for of in conditions.values()]


def print_adaptation(runs):
    """For each scenario a row a quantity and a column a condition; for single fish a row a species."""
    alone = {scenario: conditions for scenario, conditions in runs.items() if scenario.startswith(ALONE)}
    for scenario, conditions in runs.items():
        if scenario in alone:
            continue
        # A quantity that no run of the scenario has is left out.
        rows = [[words, *cells_of(conditions, quantity), published]
                for quantity, (words, _, published) in QUANTITIES.items()
                if not all(np.isnan(of[quantity]).all() for of in conditions.values())]
        print(f"### {scenario}\n\n{markdown_table(['', *conditions, 'published'], rows)}")
    for quantity in ALONE_QUANTITIES if alone else []:
        rows = [[scenario.removeprefix(ALONE), *cells_of(conditions, quantity)]
                for scenario, conditions in alone.items()]
        head = [QUANTITIES[quantity][0], *next(iter(alone.values()))]
        print(f"### alone: {QUANTITIES[quantity][0]}\n\n{markdown_table(head, rows)}")


def draw_adaptation(runs):
    """With and without each adaptation: each seed a thin line, and the means."""
    figure, panels = plt.subplots(2, 3, figsize=(906 * PX, 620 * PX), layout="constrained")
    figure.get_layout_engine().set(hspace=0.06, wspace=0.04)
    for axes, (adaptation, condition, scenario, quantity) in zip(panels.flat, PANELS):
        if scenario not in runs:
            axes.set_visible(False)
            continue
        without, with_all = runs[scenario][condition][quantity], runs[scenario]["all"][quantity]
        # Left without the adaptation, right with it; a line joins the two runs of one seed.
        axes.plot([1, 2], [without, with_all], color="#c3cdd4", linewidth=0.8)
        for place, values, colour in [(1, without, WITHOUT), (2, with_all, WITH)]:
            axes.plot(np.full(len(values), place), values, "o", color=colour, markersize=4.5, alpha=0.6,
                      markeredgewidth=0)
            if not np.isnan(values).all():
                axes.plot([place - 0.25, place + 0.25], [np.nanmean(values)] * 2, color=colour, linewidth=2)
        axes.set(xlim=(0.4, 2.6), ylim=(0, None), xticks=[1, 2], xticklabels=["without", "with"])
        axes.grid(axis="x", color="none")
        axes.set_title(f"{adaptation}, {scenario}\n", fontsize=9.5)
        axes.annotate(QUANTITIES[quantity][0], (0, 1), (0, 5), "axes fraction", "offset points", color=QUIET,
                      fontsize=7.5)
    return figure


# A row for each hour of a chronicle. The shares of time in each routine stand in one column, separated by slashes.
def print_hours(hours):
    # hoursCsv() names these columns by routine; their order is that of the intentions.
    routines = [key for key in hours[0] if key.endswith(" share")]
    shares = " / ".join(key.removesuffix(" share") for key in routines) + ", %"
    head = ["hour", "fewest fish", "meals", "catches", "returns", "spawnings", shares,
            "changes of intention, a fish and minute", "overlaps, a fish and minute", "in another fish, %",
            "into terrain", "shortest way, m", "longest stay, s (fish)", "farthest out, m", "spread, m",
            "water used, %"]
    print(markdown_table(head, [[
        *(f"{hour[key]:.0f}" for key in ["hour", "fewest_fish", "meals", "catches", "returns", "spawnings"]),
        " / ".join(f"{100 * hour[key]:.1f}" for key in routines), f"{hour['changes_per_fish_minute']:.1f}",
        f"{hour['touches_per_fish_minute']:.3f}", f"{hour['overlap_percent']:.2f}", f"{hour['into_terrain']:.0f}",
        f"{hour['shortest_way_m']:.0f}", f"{hour['longest_stay_s']:.0f} ({hour['who_stayed']:.0f})",
        f"{hour['farthest_out_m']:.2f}", f"{hour['spread_m']:.2f}", f"{hour['water_used_percent']:.0f}"]
        for hour in hours]))


def print_overlaps(overlaps, key, words, hours):
    """By the pair of what `key` names; those that lasted longest together first."""
    groups = defaultdict(list)
    for row in overlaps:
        # The order of the two fish does not matter.
        groups[", ".join(sorted([row[f"{key}_a"], row[f"{key}_b"]]))].append(row)
    head = [words, "overlaps an hour", "seconds an hour", "longest, s", "longest over a quarter of a body, s",
            "deepest, % of the shorter body"]
    # Seconds of overlap of each pair, which give the order of the rows.
    totals = {pair: sum(row["seconds"] for row in rows) for pair, rows in groups.items()}
    print(markdown_table(head, [[
        pair, f"{len(groups[pair]) / hours:.1f}", f"{totals[pair] / hours:.1f}",
        f"{max(row['seconds'] for row in groups[pair]):.1f}", f"{max(row['deep_seconds'] for row in groups[pair]):.1f}",
        f"{100 * max(row['deepest_share'] for row in groups[pair]):.0f}"]
        for pair in sorted(totals, key=lambda pair: (-totals[pair], pair))]))


# `more` is "figure" or empty for an adaptation study, and the hours simulated for a chronicle.
def main(what, folder, more):
    if what == "adaptation":
        runs = runs_of(read_csv(folder / "adaptation.csv"))
        print_adaptation(runs)
        # The table goes to standard output; the name of the figure must not be mixed into it.
        if more == "figure":
            print(save(draw_adaptation(runs), folder / "adaptation.svg"), file=sys.stderr)
    else:
        hours, overlaps = read_csv(folder / "hours.csv"), read_csv(folder / "overlaps.csv")
        if hours:
            print_hours(hours)
        print_overlaps(overlaps, "species", "species", float(more))
        print_overlaps(overlaps, "routine", "as it began they would", float(more))


main(sys.argv[1], Path(sys.argv[2]), sys.argv[3] if len(sys.argv) > 3 else "")
