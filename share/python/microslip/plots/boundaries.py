"""Boundaries of the states on a patch, drawn over its cells."""

from __future__ import annotations

from typing import TYPE_CHECKING, Collection, Optional

from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path

import numpy as np

from microslip.boundaries import Vertices, instant_boundaries, parted_cells, period_boundaries

if TYPE_CHECKING:
    from matplotlib.axes import Axes

GUARD_LINES = {"slip_guard": ("slips at times", "solid"), "smallest_load": ("open at times", "dashed"),
               "largest_load": ("open throughout", "dotted")}
INSTANT = {"colors": "black", "linewidths": 0.9}


def draw_areas(axes: Axes, cells: np.ndarray, states: np.ndarray, vertices: Optional[Vertices], phase: int, colours: np.ndarray) -> None:
    """States at one phase (its number): cells (polygons) in theirs, but those that boundaries cross part by part. One area per state:
    side by side, polygons of one colour would show their edges."""
    polygons, own = list(cells), list(states)
    if vertices is not None:
        parted, pieces, of_pieces = parted_cells(vertices, phase, states)
        whole = np.setdiff1d(np.arange(len(cells)), parted)
        polygons, own = [cells[i] for i in whole] + pieces, [states[i] for i in whole] + of_pieces
    for state in sorted(set(own)):
        closed = [Path(np.append(polygon, polygon[:1], axis=0), closed=True) for polygon, its in zip(polygons, own) if its == state]
        axes.add_patch(PathPatch(Path.make_compound_path(*closed), color=colours[state], linewidth=0.25, joinstyle="round"))


def draw_boundaries(axes: Axes, vertices: Vertices, phase: int) -> bool:
    """Boundaries of the states at one phase (its number). Whether there are any."""
    segments = instant_boundaries(vertices, phase)
    axes.add_collection(LineCollection(segments, **INSTANT))
    return len(segments) > 0


def draw_guards(axes: Axes, vertices: Vertices) -> set[str]:
    """Boundaries of what occurs within the period, over any colour: white on black. Names of those there are."""
    drawn = period_boundaries(vertices)
    for name, segments in drawn.items():
        for colour, width, style in (("black", 1.6, "solid"), ("white", 1.0, GUARD_LINES[name][1])):
            axes.add_collection(LineCollection(segments, colors=colour, linewidths=width, linestyles=style))
    return set(drawn)


def instant_handle() -> Line2D:
    """Entry of the legend for the boundaries at a phase."""
    return Line2D([], [], color=INSTANT["colors"], linewidth=INSTANT["linewidths"], label="boundary of the states at this phase")


def guard_handles(names: Collection[str]) -> list[Line2D]:
    """Entries of the legend for the guards drawn."""
    return [Line2D([], [], color="0.3", linewidth=1.0, linestyle=style, label=f"boundary: {name}")
            for guard, (name, style) in GUARD_LINES.items() if guard in names]
