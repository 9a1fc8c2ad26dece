"""Natural frequencies over the speed of rotation, lines of the engine orders, and where they meet."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Mapping

import numpy as np

from microslip.files import read_table
from microslip.plots.output import save
from microslip.plots.style import ACCENT, light_grid, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw_modes(axes: Axes, table: Mapping[str, Any]) -> None:
    for mode in np.unique(table["mode"]):
        rows = table["mode"] == mode
        axes.plot(table["speed_rpm"][rows], table["frequency_Hz"][rows], color="#12355b")
        axes.annotate(f"{mode:.0f}", (table["speed_rpm"][rows][0], table["frequency_Hz"][rows][0]), xytext=(2, 2),
                      textcoords="offset points", fontsize=7, color="#12355b")


def draw_engine_orders(axes: Axes, highest: int, speeds: np.ndarray, top: float) -> None:
    """Straight lines through the origin, each with its number where it leaves the diagram."""
    for order in range(1, highest + 1):
        end = min(speeds[-1], 60.0 * top / order)
        if end <= speeds[0]:
            continue
        axes.plot((0.0, end), (0.0, order * end / 60.0), color="0.7", linewidth=0.7, zorder=1)
        axes.annotate(f"EO {order}", (end, order * end / 60.0), xytext=(2, 1), textcoords="offset points", fontsize=7,
                      color="0.5", annotation_clip=False)


def frequency_of_interest(table: Mapping[str, Any], highest: int, speeds: np.ndarray) -> float:
    """Upper end of the diagram: a little above the last engine order and the first mode; what lies higher meets nothing."""
    first = table["frequency_Hz"][table["mode"] == table["mode"].min()].max()
    return min(1.05 * table["frequency_Hz"].max(), 1.2 * max(first, highest * speeds[-1] / 60.0))


def plot_campbell(folder: str, highest: str) -> bool:
    """FOLDER/campbell.svg and .png."""
    table = read_table(os.path.join(folder, "frequencies.csv"), ("speed_rpm", "mode", "frequency_Hz"))
    met = read_table(os.path.join(folder, "crossings.csv"), ("speed_rpm", "frequency_Hz"))
    speeds = np.unique(table["speed_rpm"])
    top = frequency_of_interest(table, int(highest), speeds)
    figure, axes = subplots(1, 1, (6.4, 4.4))
    draw_engine_orders(axes, int(highest), speeds, top)
    draw_modes(axes, table)
    axes.plot(met["speed_rpm"], met["frequency_Hz"], "o", color=ACCENT, markersize=4)
    axes.set_xlim(speeds[0], speeds[-1])
    axes.set_ylim(0.0, top)
    axes.set_xlabel("speed [rpm]")
    axes.set_ylabel("frequency [Hz]")
    light_grid(axes)
    save(figure, folder, "campbell")
    return True
