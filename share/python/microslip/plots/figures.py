"""The figures of a run by name, for files and for Python alike."""

from __future__ import annotations

from typing import TYPE_CHECKING, Optional

from matplotlib import rc_context

from microslip.files import RunError
from microslip.plots.curves import curves_figure, draw_curve, finish_axes
from microslip.plots.error_budget import error_budget_figure
from microslip.plots.maps import map_figure, maps_of, name_of
from microslip.plots.peaks import parameter_figure, peaks_figure
from microslip.plots.run_folder import Run
from microslip.plots.style import STYLE, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

OF_A_RUN = {"peak_against_preload": peaks_figure, "peak_against_parameter": parameter_figure,
            "curves": curves_figure, "error_budget": error_budget_figure}


def figure_of_run(folder: str, name: str, lacking: str) -> Figure:
    """A figure of OF_A_RUN. RunError, which says what is lacking, where the run has none."""
    with rc_context(STYLE):
        figure = OF_A_RUN[name](Run(folder))
    if figure is None:
        raise RunError(f"{folder}: {lacking}")
    return figure


def figure_of_map(folder: str, name: Optional[str] = None) -> Figure:
    """The figure of a contact map, the first by default."""
    maps = {name_of(path): (path, title) for path, title in maps_of(Run(folder))}
    if not maps:
        raise RunError(f"{folder}: no contact maps; give the scene [response] maps")
    name = name or next(iter(maps))
    if name not in maps:
        raise RunError(f"{folder}: no map {name}; there are {', '.join(maps)}")
    with rc_context(STYLE):
        return map_figure(*maps[name])


def draw_one_curve(folder: str, name: str, axes: Optional[Axes] = None) -> Axes:
    """A curve into axes, those of a figure of its own where none are given."""
    run = Run(folder)
    with rc_context(STYLE):
        if axes is None:
            _, axes = subplots(1, 1, (7.2, 4.4))
        for curve, table in run.curves:
            if curve["name"] == name:
                draw_curve(axes, run, curve, table)
        finish_axes(axes, run)
    return axes
