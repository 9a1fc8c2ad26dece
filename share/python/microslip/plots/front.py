"""Error against time of the methods of tests/benchmarks/bench_front."""

from __future__ import annotations

import csv
import math
from typing import TYPE_CHECKING, Iterable, Mapping, Sequence, Tuple

from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

from microslip.plots.output import save_as
from microslip.plots.style import ACCENT, legend_below, light_grid, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes

METHODS = [  # name, colour, mark
    ("closed form", ACCENT, "*"),
    ("located events", "#12355b", "s"),
    ("slider band", "#3a86ff", "D"),
    ("planar events", "#5b9279", "^"),
    ("lanes", "#f4a259", "o"),
    ("plain return", "#888888", "x"),
    ("centres of cells", "#f4a259", "o"),
    ("extrapolated", "#b23a6f", "s"),
]
Mark = Tuple[float, float]  # time and error
READ = (1e-6, 1e-2)  # errors a user sees
SMALLEST = 1e-16  # an error below is drawn there


def read_front(path: str) -> dict[str, dict[str, list[Mark]]]:
    """{kind: {method: [(time, error)]}} in the order of the file."""
    kinds = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file, delimiter=";"):
            marks = kinds.setdefault(row["kind"], {}).setdefault(row["method"], [])
            marks.append((float(row["microseconds"]), max(float(row["force_error"]), SMALLEST)))
    return kinds


def front_of(marks: Iterable[Mark]) -> list[Mark]:
    """Those of which no other is faster and more accurate, from the fastest on."""
    front = []
    for time, error in sorted(marks):
        if not front or error < front[-1][1]:
            front.append((time, error))
    return front


def draw_kind(axes: Axes, kind: str, methods: Mapping[str, Sequence[Mark]]) -> None:
    axes.axhspan(*READ, color="0.95", zorder=0)
    for name, colour, mark in METHODS:
        if name in methods:
            times, errors = zip(*sorted(methods[name]))
            axes.plot(times, errors, marker=mark, markersize=6 if mark == "*" else 4, color=colour, linewidth=0.8)
    every = [mark for marks in methods.values() for mark in marks]
    all_times = [time for time, _ in every]
    times, errors = zip(*front_of(every))
    axes.step(times, errors, where="post", color="0.1", linewidth=0.7, linestyle=":")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(10 ** math.floor(math.log10(min(all_times))), 10 ** math.ceil(math.log10(max(all_times))))
    axes.set_ylim(SMALLEST / 3, 1.0)
    axes.yaxis.set_major_locator(LogLocator(numticks=6))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.xaxis.set_minor_formatter(NullFormatter())
    light_grid(axes)
    axes.set_title(kind.replace("two directions, ", "two directions,\n"), loc="left")
    axes.set_xlabel("µs per patch" if "patch" in kind else "µs per point")


def plot_front(table: str, output: str) -> None:
    """One panel for each kind of point, one for the rule over the patch."""
    kinds = read_front(table)
    figure, grid = subplots(-(-len(kinds) // 4), 4, (11.0, 7.6))
    for axes, (kind, methods) in zip(grid.flat, kinds.items()):
        draw_kind(axes, kind, methods)
    for axes in grid.flat[len(kinds):]:
        axes.set_axis_off()
    for axes in grid[:, 0]:
        axes.set_ylabel("error of the force")
    present = {name for methods in kinds.values() for name in methods}
    handles = [Line2D([], [], color=colour, marker=mark, linewidth=0.8, markersize=4, label=name)
               for name, colour, mark in METHODS if name in present]
    legend_below(figure, handles + [Line2D([], [], color="0.1", linewidth=0.7, linestyle=":", label="front")])
    save_as(figure, output)
