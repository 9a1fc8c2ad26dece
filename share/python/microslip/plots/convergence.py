"""A study on several element sizes: how far frequencies and peaks are from those of the finest, and what it costs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence

import numpy as np
from matplotlib import colormaps

from microslip.plots.output import save_as
from microslip.plots.style import Colour, figure_title, log_scale, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MODES = [(f"frequency_{n}_Hz", f"f{'₁₂₃'[n - 1]}", colour)
         for n, colour in ((1, "#12355b"), (2, "#f4a259"), (3, "#b23a6f"))]
BEST = [("optimum_preload_N", "best preload", "#c1121f")]


def deviation(rows: Sequence[Mapping[str, Any]], key: str) -> Optional[list[float]]:
    """|value − finest| / finest [%] of all sizes but the finest; None where a value is missing."""
    finest = rows[-1].get(key)
    if not finest:
        return None
    result = [100 * abs(row[key] - finest) / abs(finest) if row.get(key) is not None else None
              for row in rows[:-1]]
    return None if None in result else result


def draw_deviations(axes: Axes, rows: Sequence[Mapping[str, Any]], lines: Sequence[tuple[str, str, Colour]]) -> None:
    unknowns = [row["degrees_of_freedom"] for row in rows[:-1]]
    for key, label, colour in lines:
        values = deviation(rows, key)
        if values:
            axes.plot(unknowns, values, marker="o", markersize=4, color=colour, label=label)
    axes.set_ylabel(f"difference to {rows[-1]['element_size']} [%]")


def draw_cost(axes: Axes, rows: Sequence[Mapping[str, Any]]) -> None:
    unknowns = [row["degrees_of_freedom"] for row in rows]
    for key, label, marker, colour in (("seconds", "time [s]", "o", "0.2"),
                                       ("peak_memory_MB", "memory [MB]", "s", "0.6")):
        axes.plot(unknowns, [row[key] for row in rows], marker=marker, markersize=4, color=colour, label=label)


def finish(figure: Figure, grid: np.ndarray, title: str) -> None:
    """Titles, scales and legends once everything is drawn."""
    for axes, name in zip(grid.flat, ("natural frequencies", "peak frequency", "cost",
                                      "peak amplitude, best preload")):
        axes.set_title(name, loc="left")
        axes.grid(True, which="major", color="0.92", linewidth=0.6)
        if axes.lines:
            log_scale(axes.yaxis)
    log_scale(grid[1, 0].xaxis)
    for axes in grid[1]:
        axes.set_xlabel("unknowns")
    for axes in grid[:, 0]:
        axes.legend()
    grid[1, 1].legend(loc="lower left", bbox_to_anchor=(1.0, 0.0))
    figure_title(figure, title)


def plot_convergence(rows: Sequence[Mapping[str, Any]], names: Sequence[str], stem: str, title: str) -> None:
    """STEM.svg and .png of one flat record per size, coarse to fine; names: those of the curves."""
    palette = colormaps["viridis"]([0.93 * i / max(len(names) - 1, 1) for i in range(len(names))])
    figure, grid = subplots(2, 2, (8.6, 5.4), sharex=True)
    curves = list(zip(names, palette))
    draw_deviations(grid[0, 0], rows, MODES)
    draw_deviations(grid[0, 1], rows, [(name + "_peak_Hz", name, colour) for name, colour in curves])
    draw_deviations(grid[1, 1], rows, BEST + [(name + "_peak_m", name, colour) for name, colour in curves])
    draw_cost(grid[1, 0], rows)
    finish(figure, grid, title)
    for extension in ("svg", "png"):
        save_as(figure, f"{stem}.{extension}")
