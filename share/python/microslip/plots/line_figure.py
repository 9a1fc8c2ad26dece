"""Figures of contact points on a line: one map, and the transition lines of several runs compared."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Optional, Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

from microslip.files import RunError
from microslip.plots.line_field import KINDS, Field
from microslip.plots.line_map import POSITIVE, STICK, LineMap, cell_edges, line_positions
from microslip.plots.output import save_as
from microslip.plots.run_folder import Run, first_map
from microslip.plots.style import STATE_COLOURS, Colour, state_legend, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def unwrapped(x: np.ndarray, angle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A line over x without the strokes across the picture where it leaves at 360° and returns at 0°."""
    jump = np.abs(np.diff(angle)) > 180
    at = np.flatnonzero(jump) + 1
    return np.insert(x, at, np.nan), np.insert(angle, at, np.nan)


def axes_of_phase(axes: Axes) -> None:
    axes.set_ylim(0, 360)
    axes.set_yticks(np.arange(0, 361, 90))
    axes.set_ylabel("phase θ [°]")


def draw_lines(axes: Axes, field: Field, colour: Colour, outline: Optional[str] = None) -> None:
    for kind, x, angle in field.lines:
        for shift in (-360, 0, 360):
            axes.plot(x, np.add(angle, shift), color=colour, linewidth=1.2, linestyle=KINDS[kind][1],
                      path_effects=[withStroke(linewidth=2.2, foreground=outline)] if outline else None)


def line_handles(fields: Sequence[Field]) -> list[Line2D]:
    """Of the kinds of lines there are."""
    present = {kind for field in fields for kind, _, _ in field.lines}
    return [Line2D([], [], color="0.2", linewidth=1.2, linestyle=style, label=name)
            for kind, (name, style) in enumerate(KINDS) if kind in present]


def draw_samples(axes: Axes, line_map: LineMap) -> None:
    """The field at the phases of the map, for maps that have nothing else."""
    step = 360 / len(line_map.phase)
    edges = np.append(line_map.phase, 360.0) - 0.5 * step  # each instant in the middle of its stripe
    for shift in (0, 360):  # the stripe at 0° is seen at both borders
        axes.pcolormesh(cell_edges(line_map.x), edges + shift, line_map.state.T, vmin=-0.5, vmax=4.5,
                        cmap=ListedColormap(STATE_COLOURS), rasterized=True)


def draw_energy(axes: Axes, line_map: LineMap, edges: np.ndarray) -> None:
    """Where along the line energy is lost, of the largest."""
    most = line_map.energy.max()
    lost = np.pad(line_map.energy, 1, mode="edge") / (most if most > 0 else 1)
    axes.fill_between(np.concatenate([edges[:1], line_map.x, edges[-1:]]), lost, color="0.4", linewidth=0)
    axes.set_ylim(bottom=0)
    axes.set_ylabel("energy lost\n/ largest")
    axes.set_xlabel("position along the contact x [m]")


def line_figure(line_map: LineMap) -> Figure:
    """States over (x, θ) with their boundaries, and where along the line energy is lost."""
    figure, (axes, energy) = subplots(2, 1, (6.4, 5.2), sharex=True, gridspec_kw={"height_ratios": [3.4, 1]})
    fields = []
    if line_map.cycles is None:
        draw_samples(axes, line_map)
    else:
        fields = [Field(line_map)]
        fields[0].draw(axes)
        draw_lines(axes, fields[0], "white", "0.15")
    axes_of_phase(axes)
    edges = cell_edges(line_map.x)
    axes.set_xlim(edges[0], edges[-1])
    draw_energy(energy, line_map, edges)
    state_legend(figure, np.unique(line_map.state), line_handles(fields))
    return figure


def label_of(run: Run) -> str:
    """Number of modes and folder of a run."""
    n_modes = len(run.summary["modes"])
    return f"{n_modes} mode{'s' if n_modes > 1 else ''} ({os.path.basename(os.path.normpath(run.folder))})"


def first_field(run: Run) -> Field:
    """Of the first contact map of a run whose points lie on a line; RunError where there is none."""
    name = first_map(run)
    position = line_positions(run.folder)
    if position is None:
        raise RunError(f"{run.folder}: its contact points do not lie on a line")
    line_map = LineMap(run.folder, name, position)
    if line_map.cycles is None:
        raise RunError(f"{run.folder}: its map was written by an older version; run the scene again")
    return Field(line_map)


def plot_comparison(folders: Sequence[str], path: str) -> None:
    """Transition lines of several runs, and the slip-to-stick line of the first half-cycle enlarged."""
    figure, (axes, enlarged) = subplots(2, 1, (7.2, 6.0), sharex=True, gridspec_kw={"height_ratios": [2, 1]})
    runs = [Run(folder) for folder in folders]
    fields = [first_field(run) for run in runs]
    handles = line_handles(fields)
    for run, field, colour in zip(runs, fields, colormaps["viridis"](np.linspace(0, 0.85, len(runs)))):
        draw_lines(axes, field, colour)
        enlarged.plot(*unwrapped(field.map.x, field.map.transitions(POSITIVE, STICK)), color=colour, linewidth=1.2)
        handles.append(Line2D([], [], color=colour, linewidth=2.5, label=label_of(run)))
    axes.set_xlim(min(field.edges[0] for field in fields), max(field.edges[-1] for field in fields))
    axes_of_phase(axes)
    enlarged.set_ylabel("positive slip to stick,\nenlarged: θ [°]")
    enlarged.set_xlabel("position along the contact x [m]")
    axes.set_title(runs[0].title, loc="left")
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.02))
    save_as(figure, path)
