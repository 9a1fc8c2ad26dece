"""What every choice of the discretisation does to the highest peak of every curve: one bar per curve, in parts."""

import numpy as np

from microslip.plots.run_folder import load_of
from microslip.plots.style import legend_below, light_grid, subplots

SOURCES = ("harmonics", "mesh", "second_direction", "cells", "basis", "fit", "instants", "newton")
COLOURS = ("#c44e52", "#4c72b0", "#8172b3", "#55a868", "#ccb974", "#64b5cd", "0.6", "0.35")
SMALLEST = 1e-4  # %, where the axis begins


def effects(run, curve):
    """Sizes of the effects on the amplitude [%], in the order of SOURCES; None without a budget."""
    rows = [row for row in run.summary.get("error_budget", ())
            if row["curve"] == curve["name"] and row["goal"] == "peak_amplitude"]
    if not rows:
        return None
    sizes = {row["source"]: 100.0 * abs(row["effect"]) for row in rows}
    return [sizes.get(source, 0.0) for source in SOURCES]


def error_budget_figure(run):
    """None without a budget."""
    told = [(run.label(load_of(curve)), effects(run, curve)) for curve, _ in run.curves]
    told = [(label, sizes) for label, sizes in told if sizes]
    if not told:
        return None
    figure, axes = subplots(1, 1, (7.2, 1.2 + 0.42 * len(told)))
    rows = np.arange(len(told))
    height = 0.8 / len(SOURCES)
    for i, (source, colour) in enumerate(zip(SOURCES, COLOURS)):
        sizes = [max(sizes[i], SMALLEST) for _, sizes in told]
        axes.barh(rows + (i - 0.5 * (len(SOURCES) - 1)) * height, sizes, height, left=0.0, color=colour,
                  label=source.replace("_", " "))
    axes.set_xscale("log")
    axes.set_xlim(SMALLEST, max(max(sizes) for _, sizes in told) * 2.0)
    axes.set_yticks(rows, [label for label, _ in told])
    axes.invert_yaxis()
    axes.set_xlabel("effect on the amplitude of the peak [%]")
    axes.set_title(run.title, loc="left")
    light_grid(axes)
    legend_below(figure, axes.get_legend_handles_labels()[0])
    return figure
