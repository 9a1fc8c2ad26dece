"""Loops of a contact point over one period, coloured by state."""

from __future__ import annotations

import csv
import os
from typing import TYPE_CHECKING, Iterator, Sequence

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

from microslip.plots.numbers import length_unit, pressure_unit
from microslip.plots.output import run_shared, save
from microslip.plots.style import STATES, figure_title, legend_below, light_grid, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = {name: (number, colour) for number, name, colour in STATES}
WORDS = {"stick": "stick", "positive_slip": "positive slip", "negative_slip": "negative slip",
         "slip": "slip in two directions", "separated": "separated"}


def outline(width: float) -> list[withStroke]:
    return [withStroke(linewidth=width + 1.2, foreground="0.6")]


class Samples:
    """One cycle: columns by name, and the state from each sample on."""

    def __init__(self, path: str) -> None:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.columns = {name: np.array([float(row[name]) for row in rows])
                        for name in rows[0] if name != "state"}
        self.states = [WORDS[row["state"]] for row in rows]
        self.two_directions = bool(np.any(self["w_m"] != 0.0))

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[name]


def unit_of(samples: Samples, name: str) -> tuple[str, float]:
    largest = np.max(np.abs(samples[name]))
    return length_unit(largest) if name.endswith("_m") else pressure_unit(largest)


def runs(samples: Samples, chosen: np.ndarray) -> Iterator[tuple[slice, str]]:
    """Slices of points joined by chosen intervals of one state, with their state."""
    states = samples.states
    start = 0
    for i in range(1, len(chosen) + 1):
        if i == len(chosen) or chosen[i] != chosen[start] or states[i] != states[start]:
            if chosen[start]:
                yield slice(start, i + 1), states[start]
            start = i


def draw_lines(axes: Axes, samples: Samples, points: np.ndarray, chosen: np.ndarray, width: float) -> None:
    """One colour per state. The light grey of separation gets an outline."""
    for part, state in sorted(runs(samples, chosen), key=lambda run: run[1] != "separated"):
        axes.plot(points[part, 0], points[part, 1], color=COLOURS[state][1], linewidth=width,
                  path_effects=outline(width) if state == "separated" else None)


def draw(axes: Axes, samples: Samples, abscissa: str, ordinate: str, labels: tuple[str, str]) -> None:
    """A closed line; where the way back may hide the way forth, it is drawn wide below."""
    units = [unit_of(samples, name) for name in (abscissa, ordinate)]
    if abscissa.endswith("Pa"):  # an orbit has one unit and no distortion
        units = [max(units, key=lambda unit: unit[1])] * 2
        axes.set_aspect("equal", adjustable="datalim")
    points = np.column_stack([samples[name] / unit[1]
                              for name, unit in zip((abscissa, ordinate), units)])
    back = (np.diff(points[:, 0]) < 0.0) & (ordinate == "normal_Pa")
    if np.any(back):
        draw_lines(axes, samples, points, back, 4.6)
        axes.set_title("wide: v falls", loc="right", fontsize=8, color="0.4")
    draw_lines(axes, samples, points, ~back, 1.8)
    axes.margins(0.06)
    axes.plot(*points[0], marker="o", markersize=4, color="0.1", zorder=4)
    axes.axhline(0.0, color="0.85", linewidth=0.6, zorder=0)
    axes.set_xlabel(f"{labels[0]} [{units[0][0]}]")
    axes.set_ylabel(f"{labels[1]} [{units[1][0]}]")
    light_grid(axes, "0.93")


def legend(figure: Figure, samples: Samples) -> None:
    present = sorted({COLOURS[state] + (state,) for state in samples.states})
    handles = [Line2D([], [], color=colour, linewidth=1.8, label=name)
               for _, colour, name in present]
    for handle in handles:
        handle.set_path_effects(outline(1.8) if handle.get_label() == "separated" else [])
    handles.append(Line2D([], [], color="0.1", marker="o", markersize=4, linestyle="",
                          label="phase 0"))
    legend_below(figure, handles)


def plot_cycle(folder: str, name: str) -> None:
    """FOLDER/NAME.svg and .png from FOLDER/NAME.csv."""
    samples = Samples(os.path.join(folder, name + ".csv"))
    n_rows = 2 if samples.two_directions else 1
    figure, grid = subplots(n_rows, 2, (7.2, 3.0 * n_rows + 0.4), squeeze=False)
    along_p = "friction $f_p$" if samples.two_directions else "friction $f$"
    draw(grid[0, 0], samples, "u_m", "friction_Pa", ("displacement u", along_p))
    draw(grid[0, 1], samples, "v_m", "normal_Pa", ("approach v", "load $n$"))
    if samples.two_directions:
        draw(grid[1, 0], samples, "w_m", "friction_w_Pa", ("displacement w", "friction $f_r$"))
        draw(grid[1, 1], samples, "friction_Pa", "friction_w_Pa", (along_p, "friction $f_r$"))
    legend(figure, samples)
    figure_title(figure, name.replace("$", r"\$"))
    save(figure, folder, name)


def plot_cycles(folder: str, names: Sequence[str]) -> bool:
    """Shared out to the cores. Whether all could be drawn."""
    return run_shared([lambda name=name: plot_cycle(folder, name) for name in names])
