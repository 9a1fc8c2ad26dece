"""What every choice of the discretisation does to the highest peak of every curve, to its amplitude and to the energy it
dissipates: one bar per curve, in parts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence

import numpy as np

from microslip.plots.run_folder import Run, load_of
from microslip.plots.style import legend_below, light_grid, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SOURCES = ("harmonics", "mesh", "second_direction", "cells", "basis", "fit", "instants", "newton", "eigensolver")
COLOURS = ("#c44e52", "#4c72b0", "#8172b3", "#55a868", "#ccb974", "#64b5cd", "0.6", "0.35", "0.8")
SMALLEST = 1e-4  # %, where the axis begins
Sizes = Mapping[str, float]  # [%] by source

GOALS = (("peak_amplitude", "effect on the amplitude of the peak [%]"),
         ("dissipated_energy", "effect on the energy dissipated there [%]"))


def effects(run: Run, curve: Mapping[str, Any], goal: str) -> Optional[Sizes]:
    """Sizes of the effects on a goal, of the sources that are known; None without rows."""
    rows = [row for row in run.summary.get("error_budget", ())
            if row["curve"] == curve["name"] and row["goal"] == goal]
    if not rows:
        return None
    return {row["source"]: 100.0 * abs(row["effect"]) for row in rows}


def known_sources(told: Sequence[Optional[Sizes]]) -> list[str]:
    """Those that any curve tells: what is off or not known has no bar and no name in the legend."""
    return [source for source in SOURCES if any(sizes and source in sizes for sizes in told)]


def label_of(source: str, told: Sequence[Optional[Sizes]]) -> str:
    """Its name, and where no bar of it is seen that it is too small."""
    seen = any(sizes and sizes.get(source, 0.0) > SMALLEST for sizes in told)
    return source.replace("_", " ") + ("" if seen else f" (below {SMALLEST:.4f} %)")


def draw_goal(axes: Axes, told: Sequence[Optional[Sizes]], sources: Mapping[str, str]) -> None:
    """told: sizes by source of every curve, or None where there are none; sources: with their labels."""
    rows = np.arange(len(told))
    height = 0.8 / len(sources)
    for i, (source, label) in enumerate(sources.items()):
        sizes = [max(sizes.get(source, 0.0), SMALLEST) if sizes else SMALLEST for sizes in told]
        axes.barh(rows + (i - 0.5 * (len(sources) - 1)) * height, sizes, height, left=0.0,
                  color=COLOURS[SOURCES.index(source)], label=label)
    for row, sizes in zip(rows, told):
        if not sizes:
            axes.annotate("friction dissipates nothing", (2 * SMALLEST, row), va="center", fontsize=7, color="0.4")
    axes.set_xscale("log")
    shown = [size for sizes in told if sizes for source, size in sizes.items() if source in sources]
    axes.set_xlim(SMALLEST, 2.0 * max([*shown, SMALLEST]))
    light_grid(axes)


def error_budget_figure(run: Run) -> Optional[Figure]:
    """None without a budget. Runs of earlier programs tell nothing of the energy."""
    curves = [curve for curve, _ in run.curves if effects(run, curve, "peak_amplitude")]
    if not curves:
        return None
    goals = [goal for goal in GOALS if any(effects(run, curve, goal[0]) for curve in curves)]
    figure, grid = subplots(1, len(goals), (3.6 + 3.6 * len(goals), 1.2 + 0.42 * len(curves)), sharey=True, squeeze=False)
    told = {goal: [effects(run, curve, goal) for curve in curves] for goal, _ in goals}
    every = [sizes for sizes_of_goal in told.values() for sizes in sizes_of_goal]
    sources = {source: label_of(source, every) for source in known_sources(every)}
    if not sources:
        return None
    for axes, (goal, label) in zip(grid[0], goals):
        draw_goal(axes, told[goal], sources)
        axes.set_xlabel(label)
    first = grid[0, 0]
    first.set_yticks(np.arange(len(curves)), [run.label(load_of(curve)) for curve in curves])
    first.invert_yaxis()
    first.set_title(run.title, loc="left")
    legend_below(figure, first.get_legend_handles_labels()[0])
    return figure
