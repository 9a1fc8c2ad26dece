"""Error of a peak against the seconds it took: one panel per curve, one line per knob of the discretisation."""

from __future__ import annotations

import csv
import os
from typing import TYPE_CHECKING, Any, Mapping, Sequence

from matplotlib.lines import Line2D

from microslip.files import RunError, shown
from microslip.plots.output import save
from microslip.plots.style import legend_below, light_grid, log_scale, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = {"element_size": "#4c72b0", "mesh_file": "#4c72b0", "refinement": "#1f3b66", "modes": "#dd8452",
           "residual": "#937860", "attachment_degree": "#ccb974", "cells": "#55a868", "points": "#55a868", "fit": "#64b5cd",
           "harmonics": "#c44e52", "instants": "#da8bc3", "steps": "#c44e52", "second_direction": "#8172b3",
           "method": "#4d4d4d"}
SMALLEST = 1e-5  # %, of an error that is drawn


def read_knob(path: str) -> list[dict[str, Any]]:
    """Rows of one table, numbers where there are any."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        for key in ("seconds", "true_error", "estimated_error"):
            row[key] = float(row[key]) if row.get(key) else None
    return rows


def draw_knob(axes: Axes, rows: Sequence[Mapping[str, Any]], colour: str) -> None:
    for key, face in (("true_error", colour), ("estimated_error", "white")):
        told = sorted((row["seconds"], max(100.0 * abs(row[key]), SMALLEST)) for row in rows
                      if row[key] is not None and row["seconds"])  # a line goes to the right
        if told:
            axes.plot(*zip(*told), color=colour, marker="o", markersize=4, markerfacecolor=face, linewidth=0.9,
                      linestyle="-" if key == "true_error" else ":")


def work_precision_figure(folder: str) -> Figure:
    """Of the tables in a folder. RunError without any."""
    knobs = {name: read_knob(os.path.join(folder, name + ".csv")) for name in COLOURS
             if os.path.exists(os.path.join(folder, name + ".csv"))}
    curves = list(dict.fromkeys(row["curve"] for rows in knobs.values() for row in rows))
    if not curves:
        raise RunError(f"{shown(folder)}: no table of `microslip converge` with a curve in it")
    columns = min(3, len(curves))
    lines = -(-len(curves) // columns)
    figure, grid = subplots(lines, columns, (3.0 * columns + 0.8, 2.5 * lines + 0.6), squeeze=False, sharey=True)
    for axes, curve in zip(grid.flat, curves):
        for name, rows in knobs.items():
            draw_knob(axes, [row for row in rows if row["curve"] == curve], COLOURS[name])
        log_scale(axes.xaxis)
        axes.set_title(curve, loc="left")
        axes.set_xlabel("seconds")
        light_grid(axes)
    log_scale(grid[0, 0].yaxis)  # shared
    for axes in list(grid.flat)[len(curves):]:
        axes.set_visible(False)
    for row in grid:
        row[0].set_ylabel("error of the peak [%]")
    handles = [Line2D([], [], color=colour, marker="o", markersize=4, label=name.replace("_", " "))
               for name, colour in COLOURS.items() if name in knobs]
    handles.append(Line2D([], [], color="0.4", marker="o", markersize=4, markerfacecolor="white", linestyle=":",
                          label="as told"))
    legend_below(figure, handles)
    return figure


def plot_work_precision(folder: str) -> bool:
    """FOLDER/work_precision.svg and .png. Whether it is drawn."""
    save(work_precision_figure(folder), folder, "work_precision")
    return True
