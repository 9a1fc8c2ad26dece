"""Figures 2 and 3 of paper B: rough surfaces in contact, and their friction loops."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from microslip.files import read_table
from microslip.plots.output import save
from microslip.plots.style import light_grid, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CUBIC = {"color": "#12355b", "label": "cubic law (1)"}
GAUSSIAN = {"color": "#f4a259", "label": "Gaussian heights", "linestyle": (0, (4, 2))}


def label(axes: Axes, x_label: str, y_label: str, title: str) -> None:
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.set_title(title, loc="left")
    light_grid(axes)


def figure_2(folder: str) -> None:
    """Load over approach, and tangential stiffness over load."""
    table = read_table(os.path.join(folder, "figure_2.csv"))
    figure, (load, stiffness) = subplots(1, 2, (7.2, 3.2))
    for law, style in (("cubic", CUBIC), ("gaussian", GAUSSIAN)):
        load.plot(table["approach"], table["load_" + law], **style)
        stiffness.plot(table["load"], table["stiffness_" + law], **style)
    label(load, "$u^*$", "$F_N^*$", "normal force")
    label(stiffness, "$F_N^*$", "$k_T^*$", "tangential stiffness")
    load.legend(loc="upper left")
    save(figure, folder, "figure_2")


def figure_3(folder: str) -> None:
    """Friction over relative motion: stick, a constant load, and rough surfaces whose load varies."""
    table = read_table(os.path.join(folder, "figure_3.csv"))
    figure, grid = subplots(1, 3, (7.2, 2.8), sharey=True)
    titles = {"stick": "(a) stick only", "slip": r"(b) slip, constant $\mu F_N$",
              "rough": "rough, varying load"}
    for axes, (name, title) in zip(grid, titles.items()):
        axes.plot(table["u_" + name] * 1e6, table["f_" + name] / 1e6, color=CUBIC["color"])
        axes.axhline(0.0, color="0.8", linewidth=0.6, zorder=0)
        axes.axvline(0.0, color="0.8", linewidth=0.6, zorder=0)
        label(axes, "relative motion [µm]", "", title)
    grid[0].set_ylabel("friction [MPa]")
    save(figure, folder, "figure_3")


def plot_figures(folder: str) -> None:
    """Both, beside their tables."""
    figure_2(folder)
    figure_3(folder)
