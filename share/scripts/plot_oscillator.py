#!/usr/bin/python3
"""Motion of one contact point over a period, as the four graphs of paper B, figure 6; a row per run.

    plot_oscillator.py RUN_FOLDER [RUN_FOLDER …] -o FILE [--point N]

Displacement and velocity over the phase, velocity over displacement, displacement over the excitation sin θ;
from the first contact map of each run. Stick is drawn thick. SI units; the velocity is that of physical time.
"""

import argparse
import os
import sys

import h5py
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

import plot_run

STUCK, MOVING = "#12355b", "#f4a259"


class Cycle:
    """Relative displacement of one point over one period, closed at its end."""

    def __init__(self, folder, point):
        run = plot_run.Run(folder)
        names = [name for curve in run.summary["curves"] for name in curve["maps"]]
        if not names:
            raise SystemExit(f"{folder}: no contact maps; give the scene [response] maps")
        with h5py.File(os.path.join(folder, "maps", names[0] + ".h5"), "r") as file:
            if not 0 <= point < len(file["state"]):
                raise SystemExit(f"{folder}: no contact point {point + 1}; it has {len(file['state'])}")
            self.frequency = file["frequency_Hz"][0]
            phase, u = file["phase_deg"][:], file["relative_displacement_m"][point]
            stuck = file["state"][point] == 0
        rate = 2j * np.pi * self.frequency * np.fft.rfftfreq(len(u), 1 / len(u))
        velocity = np.fft.irfft(rate * np.fft.rfft(u), len(u))
        self.phase = np.append(phase, 360.0)
        self.u, self.velocity = np.append(u, u[0]), np.append(velocity, velocity[0])
        self.stuck = np.append(stuck, stuck[0])
        self.drive = np.sin(np.radians(self.phase))


def draw(axes, x, y, stuck):
    """The motion, with its stuck parts on top."""
    axes.plot(x, y, color=MOVING, linewidth=1.2)
    axes.plot(np.where(stuck, x, np.nan), y, color=STUCK, linewidth=2.4)
    axes.grid(True, color="0.92", linewidth=0.6)
    axes.set_axisbelow(True)


def draw_row(row, cycle):
    draw(row[0], cycle.phase, cycle.u, cycle.stuck)
    draw(row[1], cycle.phase, cycle.velocity, cycle.stuck)
    draw(row[2], cycle.u, cycle.velocity, cycle.stuck)
    draw(row[3], cycle.drive, cycle.u, cycle.stuck)
    row[0].set_ylabel(f"{cycle.frequency:.4g} Hz\ndisplacement [m]")
    row[1].set_ylabel("velocity [m/s]")
    row[2].set_ylabel("velocity [m/s]")
    row[3].set_ylabel("displacement [m]")
    for axes in row[:2]:
        axes.set_xlim(0, 360)
        axes.set_xticks(np.arange(0, 361, 90))


def plot(folders, point, path):
    cycles = [Cycle(folder, point) for folder in folders]
    figure, grid = plt.subplots(len(cycles), 4, figsize=(11, 0.7 + 2.2 * len(cycles)),
                                layout="constrained", squeeze=False)
    for row, cycle in zip(grid, cycles):
        draw_row(row, cycle)
    for axes, name in zip(grid[-1], ("phase θ [°]", "phase θ [°]", "displacement [m]",
                                     "excitation sin θ")):
        axes.set_xlabel(name)
    plot_run.legend_below(figure, [Line2D([], [], color=STUCK, linewidth=2.4, label="stick"),
                                   Line2D([], [], color=MOVING, linewidth=1.2, label="slip, separated")])
    figure.savefig(path, metadata={"Software": None} if path.endswith(".png") else None)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folders", nargs="+", metavar="RUN_FOLDER")
    parser.add_argument("-o", "--output", required=True, help="picture to write (.png, .svg, .pdf)")
    parser.add_argument("--point", type=int, default=1, help="number of the contact point; default 1")
    arguments = parser.parse_args()
    plt.rcParams.update(plot_run.STYLE)
    plot(arguments.folders, arguments.point - 1, arguments.output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
