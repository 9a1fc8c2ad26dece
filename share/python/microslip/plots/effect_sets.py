"""Seconds of a curve by the set of effects of its scene, beside the full model, as tests/benchmarks/effect_sets.py measures them."""

from __future__ import annotations

import csv
from typing import TYPE_CHECKING, Any, Mapping, Sequence

from matplotlib.patches import Patch

from microslip.plots.output import save_as
from microslip.plots.style import ACCENT, legend_below, light_grid, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes

OWN, FULL = ACCENT, "0.75"
THICKNESS = 0.38  # of a bar; two of them share a row


def read_sets(path: str) -> list[dict[str, Any]]:
    """Rows of the table, numbers as such."""
    with open(path, newline="", encoding="utf-8") as file:
        return [{key: value if key == "set" else float(value) for key, value in row.items()}
                for row in csv.DictReader(file, delimiter=";")]


def draw_bars(axes: Axes, rows: Sequence[Mapping[str, Any]]) -> None:
    places = range(len(rows))
    for key, colour, shift in (("seconds", OWN, -0.5), ("full_seconds", FULL, 0.5)):
        axes.barh([place + shift * THICKNESS for place in places], [row[key] for row in rows], THICKNESS, color=colour)
    for place, row in zip(places, rows):
        axes.annotate(f"{row['unknowns']:.0f} of {row['full_unknowns']:.0f} unknowns, ×{row['full_seconds'] / row['seconds']:.3g}",
                      (max(row["seconds"], row["full_seconds"]), place), (4, 0), textcoords="offset points", va="center", fontsize=7)
    axes.set_yticks(list(places), [row["set"] for row in rows])
    axes.invert_yaxis()
    axes.set_xscale("log")
    axes.set_xlim(right=100 * max(row["full_seconds"] for row in rows))  # room for what stands behind the bars
    axes.set_xlabel("processor seconds of a curve")
    axes.tick_params(axis="y", length=0)
    light_grid(axes)


def plot_effect_sets(table: str, output: str) -> None:
    """A pair of bars for each set of effects."""
    rows = read_sets(table)
    figure, axes = subplots(1, 1, (9.0, 0.8 + 0.42 * len(rows)))
    draw_bars(axes, rows)
    legend_below(figure, [Patch(color=OWN, label="the effects of the scene"), Patch(color=FULL, label="every effect on")])
    save_as(figure, output)
