"""How every figure looks: sizes, colours, scales, legends."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Iterable, Sequence, Tuple, Union

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from microslip.plots.numbers import plain
from microslip.states import STATES

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.container import Container

STYLE = {
    "svg.hashsalt": "microslip",
    "figure.dpi": 100,
    "savefig.dpi": 160,
    "font.size": 9,
    "axes.labelsize": 9,
    "axes.titlesize": 9,
    "legend.fontsize": 8,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "lines.linewidth": 1.3,
    "lines.solid_capstyle": "round",
    "legend.frameon": False,
}
Colour = Union[str, Tuple[float, ...], np.ndarray]  # a name, or red, green, blue and opacity
FREE, STUCK = "0.1", "0.55"
ACCENT = "#c1121f"
STATE_COLOURS = [colour for _, _, colour in STATES]


def subplots(n_rows: int, n_columns: int, figsize: tuple[float, float], **grid: Any) -> tuple[Figure, Any]:
    """A figure of its own, which no display and no other figure knows of, and its axes."""
    figure = Figure(figsize=figsize, layout="constrained")
    FigureCanvasAgg(figure)
    return figure, figure.subplots(n_rows, n_columns, **grid)


def light_grid(axes: Axes, colour: str = "0.92") -> None:
    """Lines at the major ticks, below everything."""
    axes.grid(True, which="major", color=colour, linewidth=0.6)
    axes.set_axisbelow(True)


def data_of(axis: Axis) -> tuple[float, float]:
    """Of an axis and of those that share it."""
    shared = getattr(axis.axes, f"get_shared_{axis.axis_name}_axes")()
    ends = np.array([getattr(axes, f"{axis.axis_name}axis").get_data_interval()
                     for axes in shared.get_siblings(axis.axes)])
    return ends[:, 0].min(), ends[:, 1].max()


def log_scale(axis: Axis) -> None:
    """Logarithmic, with plain numbers at 1, 2, 5 where there is room and at powers of ten else."""
    low, high = data_of(axis)
    if not high > 0:
        return  # nothing moves: a logarithm has nothing to show
    getattr(axis.axes, f"set_{axis.axis_name}scale")("log")
    few = low > 0 and math.log10(high / low) < 2.2
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if few else (1.0,)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))
    axis.set_minor_formatter(NullFormatter())


def figure_title(figure: Figure, text: str) -> None:
    """Above everything, at the left."""
    figure.suptitle(text, x=0.01, ha="left", fontsize=9)


def legend_below(figure: Figure, handles: Sequence[Union[Artist, Container]]) -> None:
    """One row under everything, two where it would be cut off, in a strip of its own."""
    rows = 1 if len(handles) <= 6 else 2
    inches = 0.28 if rows == 1 else 0.44
    strip = inches / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, strip, 1, 1 - strip))
    figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 0.0),
                  ncols=-(-len(handles) // rows), borderaxespad=0.4, columnspacing=1.6)


def state_legend(figure: Figure, states: Iterable[int], handles: Iterable[Artist] = ()) -> None:
    """Colours of the states; of slip in two directions only where there is any."""
    present = {int(state) for state in states} | {0, 1, 2, 3}
    patches = [Patch(facecolor=colour, edgecolor="0.6", linewidth=0.4, label=name)
               for value, name, colour in STATES if value in present]
    legend_below(figure, patches + list(handles))
