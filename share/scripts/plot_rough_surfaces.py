#!/usr/bin/python3
"""Figures 2 and 3 of paper B: rough surfaces in contact, and their friction loops; SVG and PNG.

    plot_rough_surfaces.py FOLDER

Reads figure_2.csv and figure_3.csv, which the test verification.rough_surface_curves writes into
paper_b_figures below its build folder; writes figure_2 and figure_3 beside them. Needs no display.
"""

import os
import sys

import matplotlib.pyplot as plt

import plot_run

CUBIC = {"color": "#12355b", "label": "cubic law (1)"}
GAUSSIAN = {"color": "#f4a259", "label": "Gaussian heights", "linestyle": (0, (4, 2))}


def axes_style(axes, x_label, y_label, title):
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.set_title(title, loc="left")
    axes.grid(True, color="0.92", linewidth=0.6)
    axes.set_axisbelow(True)


def figure_2(folder):
    """Load over approach, and tangential stiffness over load."""
    table = plot_run.read_table(os.path.join(folder, "figure_2.csv"))
    figure, (load, stiffness) = plt.subplots(1, 2, figsize=(7.2, 3.2), layout="constrained")
    for law, style in (("cubic", CUBIC), ("gaussian", GAUSSIAN)):
        load.plot(table["approach"], table["load_" + law], **style)
        stiffness.plot(table["load"], table["stiffness_" + law], **style)
    axes_style(load, "$u^*$", "$F_N^*$", "normal force")
    axes_style(stiffness, "$F_N^*$", "$k_T^*$", "tangential stiffness")
    load.legend(loc="upper left")
    plot_run.save(figure, folder, "figure_2")


def figure_3(folder):
    """Friction over relative motion: stick, a constant load, and rough surfaces whose load varies."""
    table = plot_run.read_table(os.path.join(folder, "figure_3.csv"))
    figure, grid = plt.subplots(1, 3, figsize=(7.2, 2.8), layout="constrained", sharey=True)
    titles = {"stick": "(a) stick only", "slip": r"(b) slip, constant $\mu F_N$",
              "rough": "rough, varying load"}
    for axes, (name, title) in zip(grid, titles.items()):
        axes.plot(table["u_" + name] * 1e6, table["f_" + name] / 1e6, color=CUBIC["color"])
        axes.axhline(0.0, color="0.8", linewidth=0.6, zorder=0)
        axes.axvline(0.0, color="0.8", linewidth=0.6, zorder=0)
        axes_style(axes, "relative motion [µm]", "", title)
    grid[0].set_ylabel("friction [MPa]")
    plot_run.save(figure, folder, "figure_3")


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__.strip())
        return 0 if len(sys.argv) == 2 else 1
    plt.rcParams.update(plot_run.STYLE)
    figure_2(sys.argv[1])
    figure_3(sys.argv[1])
    return 0


if __name__ == "__main__":
    sys.exit(main())
