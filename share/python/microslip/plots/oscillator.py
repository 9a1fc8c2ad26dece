"""Motion of one contact point over a period, as the four graphs of paper B, figure 6."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Sequence

import numpy as np
from matplotlib.lines import Line2D

from microslip.files import RunError, data_file
from microslip.plots.output import save_as
from microslip.plots.run_folder import Run, first_map
from microslip.plots.style import legend_below, light_grid, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes

STUCK, MOVING = "#12355b", "#f4a259"


class PointMotion:
    """Relative displacement of one point over one period, closed at its end."""

    def __init__(self, folder: str, point: int) -> None:
        name = first_map(Run(folder))
        with data_file(os.path.join(folder, "maps", name + ".h5")) as file:
            if not 0 <= point < len(file["state"]):
                raise RunError(f"{folder}: no contact point {point + 1}; it has {len(file['state'])}")
            self.frequency = file["frequency_Hz"][0]
            phase, u = file["phase_deg"][:], file["relative_displacement_m"][point]
            stuck = file["state"][point] == 0
        rate = 2j * np.pi * self.frequency * np.fft.rfftfreq(len(u), 1 / len(u))
        velocity = np.fft.irfft(rate * np.fft.rfft(u), len(u))
        self.phase = np.append(phase, 360.0)
        self.u, self.velocity = np.append(u, u[0]), np.append(velocity, velocity[0])
        self.stuck = np.append(stuck, stuck[0])
        self.drive = np.sin(np.radians(self.phase))


def draw(axes: Axes, x: np.ndarray, y: np.ndarray, stuck: np.ndarray) -> None:
    """The motion, with its stuck parts on top."""
    axes.plot(x, y, color=MOVING, linewidth=1.2)
    axes.plot(np.where(stuck, x, np.nan), y, color=STUCK, linewidth=2.4)
    light_grid(axes)


def draw_row(row: Sequence[Axes], motion: PointMotion) -> None:
    draw(row[0], motion.phase, motion.u, motion.stuck)
    draw(row[1], motion.phase, motion.velocity, motion.stuck)
    draw(row[2], motion.u, motion.velocity, motion.stuck)
    draw(row[3], motion.drive, motion.u, motion.stuck)
    row[0].set_ylabel(f"{motion.frequency:.4g} Hz\ndisplacement [m]")
    row[1].set_ylabel("velocity [m/s]")
    row[2].set_ylabel("velocity [m/s]")
    row[3].set_ylabel("displacement [m]")
    for axes in row[:2]:
        axes.set_xlim(0, 360)
        axes.set_xticks(np.arange(0, 361, 90))


def plot_oscillator(folders: Sequence[str], point: int, path: str) -> None:
    """A row of graphs per run, of the point with this number from 0."""
    motions = [PointMotion(folder, point) for folder in folders]
    figure, grid = subplots(len(motions), 4, (11, 0.7 + 2.2 * len(motions)), squeeze=False)
    for row, motion in zip(grid, motions):
        draw_row(row, motion)
    for axes, name in zip(grid[-1], ("phase θ [°]", "phase θ [°]", "displacement [m]",
                                     "excitation sin θ")):
        axes.set_xlabel(name)
    legend_below(figure, [Line2D([], [], color=STUCK, linewidth=2.4, label="stick"),
                          Line2D([], [], color=MOVING, linewidth=1.2, label="slip, separated")])
    save_as(figure, path)
