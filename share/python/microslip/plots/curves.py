"""Response curves of a run in one figure: stable solid, unstable dashed, peaks and folds marked."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterator, Mapping, Optional, Sequence, Union

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from microslip.branch import AMPLITUDE, cubics, polyline
from microslip.plots.numbers import is_number
from microslip.plots.run_folder import Run, load_of
from microslip.plots.style import ACCENT, legend_below, light_grid, log_scale, subplots

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DASHED = (0, (2.5, 1.6))
DOTTED = (0, (0.8, 1.8))
LINES = {1: "-", 0: DASHED, -1: DOTTED}  # by the column `stable`


def kind_of(flags: Sequence[int]) -> int:
    """Of an interval, from the stability of its ends that are no folds: unstable before not judged before stable."""
    return 0 if 0 in flags or not flags else min(flags)


def branches(table: Mapping[str, Any]) -> Iterator[tuple[int, slice]]:
    """Runs of intervals of one kind: (1 stable, 0 unstable or -1 not judged, slice of points)."""
    stable, mark = table["stable"], table["mark"]
    kinds = [kind_of([int(stable[k]) for k in (i, i + 1) if mark[k] != "fold"]) for i in range(len(stable) - 1)]
    start = 0
    for i in range(1, len(kinds) + 1):
        if i == len(kinds) or kinds[i] != kinds[start]:
            yield kinds[start], slice(start, i + 1)
            start = i


def line_width(load: Union[float, str]) -> float:
    """Curves that follow a limit lie on it, and both are seen."""
    return 1.3 if is_number(load) else 2.4


def richer_peak(curve: Mapping[str, Any]) -> Optional[tuple[int, float, float]]:
    """The highest peak solved again with more harmonics: (harmonics, Hz, m); None: not checked, or not found."""
    more = (curve.get("harmonics") or {}).get("with_more") or {}
    found = (more.get("highest"), more.get("frequency_Hz"), more.get("amplitude_m"))
    return found if all(is_number(value) for value in found) else None


def draw_richer(axes: Axes, run: Run, curve: Mapping[str, Any]) -> None:
    """A star, and the way to it from the peak that the curve has."""
    richer, peak = richer_peak(curve), curve.get("peak")
    if not richer or not peak:
        return
    colour = run.colour(load_of(curve))
    _, frequency, amplitude = richer
    axes.plot([peak["frequency_Hz"], frequency], [peak["amplitude_m"] / run.size, amplitude / run.size],
              color=colour, linewidth=0.7, linestyle=":", zorder=3.5)
    axes.scatter(frequency, amplitude / run.size, marker="*", s=42, color="white", edgecolor=colour,
                 linewidth=0.8, zorder=5)


def draw_bar(axes: Axes, run: Run, curve: Mapping[str, Any]) -> None:
    """How far the highest peak can be trusted, where the run tells it: a cross of both half widths."""
    bar, peak = curve.get("bar"), curve.get("peak")
    if not bar or not peak:
        return
    frequency, amplitude = peak["frequency_Hz"], peak["amplitude_m"] / run.size
    up = amplitude * (bar.get("peak_amplitude") or 0.0)
    axes.errorbar(frequency, amplitude, [[min(up, 0.9 * amplitude)], [up]], frequency * (bar.get("peak_frequency") or 0.0),
                  fmt="none", ecolor=run.colour(load_of(curve)), elinewidth=0.7, capsize=1.5, alpha=0.7, zorder=3.4)


def has_band(table: Mapping[str, Any]) -> bool:
    return "amplitude_low_m" in table and len(table["frequency_Hz"]) > 1


def one_way(frequency: np.ndarray) -> Iterator[slice]:
    """Parts of a branch between its turns."""
    way = np.sign(np.diff(frequency))
    turns = [0, *(np.nonzero(way[1:] * way[:-1] < 0)[0] + 1), len(frequency) - 1]
    return (slice(begin, end + 1) for begin, end in zip(turns, turns[1:]) if end > begin)


def draw_band(axes: Axes, run: Run, curve: Mapping[str, Any], table: Mapping[str, Any]) -> None:
    """Between which amplitudes the curve lies, where the run tells it. Axes are those of the curves: a band may reach zero."""
    if not has_band(table):
        return
    frequency, amplitude, low, high = (np.asarray(table[key]) for key in (
        "frequency_Hz", "amplitude_m", "amplitude_low_m", "amplitude_high_m"))
    low = np.maximum(low, 1e-3 * amplitude)  # zero is nowhere on a logarithmic axis
    strips = [np.concatenate((np.column_stack((frequency[part], low[part] / run.size)),
                              np.column_stack((frequency[part], high[part] / run.size))[::-1])) for part in one_way(frequency)]
    axes.add_collection(PolyCollection(strips, facecolor=run.colour(load_of(curve)), linewidth=0, alpha=0.14, zorder=2),
                        autolim=False)


def draw_curve(axes: Axes, run: Run, curve: Mapping[str, Any], table: Mapping[str, Any]) -> None:
    load = load_of(curve)
    colour = run.colour(load)
    frequency = table["frequency_Hz"]
    amplitude = np.where(table["amplitude_m"] > 0, table["amplitude_m"], np.nan) / run.size
    pieces = cubics(curve, table, AMPLITUDE)
    for kind, part in branches(table):
        line = polyline(pieces[part.start:part.stop - 1], log=True)
        axes.plot(line[:, 0], line[:, 1] / run.size, color=colour, zorder=3 if is_number(load) else 2.5,
                  linewidth=line_width(load), linestyle=LINES[kind])
    marks = np.array(table["mark"])
    for mark, face, style in (("peak", colour, {"marker": "o", "s": 14}),
                              ("fold", "white", {"marker": "D", "s": 13})):
        chosen = marks == mark
        axes.scatter(frequency[chosen], amplitude[chosen], color=face, edgecolor=colour,
                     linewidth=0.8, zorder=4, **style)
    draw_bar(axes, run, curve)
    draw_band(axes, run, curve, table)
    draw_richer(axes, run, curve)
    if not curve["complete"]:
        axes.scatter(frequency[-1], amplitude[-1], marker="x", s=22, color=ACCENT, zorder=5)


def legend_of_loads(axes: Axes, run: Run) -> None:
    """One line per preload, in order, between the limits."""
    loads = [load_of(curve) for curve, _ in run.curves]
    order = (["free"] if "free" in loads else []) + list(run.colours) + (
        ["stuck"] if "stuck" in loads else [])
    lines = [Line2D([], [], color=run.colour(load), label=run.label(load), linewidth=line_width(load))
             for load in order]
    axes.legend(handles=lines, loc="upper left", bbox_to_anchor=(1.0, 1.02), alignment="left",
                title="preload scale" if run.scaled else "preload")


def not_judged(run: Run) -> list[Line2D]:
    """An entry of the legend, where there are such points."""
    some = any(kind == -1 for _, table in run.curves for kind, _ in branches(table))
    return [Line2D([], [], linestyle=DOTTED, color="0.3", label="stability not judged")] if some else []


def legend_of_marks(figure: Figure, run: Run) -> None:
    grey = {"color": "0.3"}
    kinds: list[Artist] = [Line2D([], [], label="stable", **grey),
                           Line2D([], [], linestyle=DASHED, label="unstable", **grey),
                           *not_judged(run),
                           Line2D([], [], marker="o", markersize=4, linestyle="", label="peak", **grey),
                           Line2D([], [], marker="D", markersize=4, linestyle="", markerfacecolor="white", label="fold", **grey)]
    highest = sorted({richer[0] for richer in (richer_peak(curve) for curve, _ in run.curves) if richer})
    if highest:
        harmonics = " or ".join(str(number) for number in highest)
        kinds.append(Line2D([], [], marker="*", markersize=7, linestyle="", markerfacecolor="white",
                            label=f"peak with {harmonics} harmonics", **grey))
    if any(curve.get("bar") for curve, _ in run.curves):
        kinds.append(Line2D([], [], linewidth=0.8, marker="+", markersize=8, label="error of the peak", color="0.5"))
    if any(has_band(table) for _, table in run.curves):
        kinds.append(Patch(facecolor="0.5", alpha=0.3, label="error along the curve"))
    if any(not curve["complete"] for curve, _ in run.curves):
        kinds.append(Line2D([], [], color=ACCENT, marker="x", markersize=5, linestyle="",
                            label="ends here (incomplete)"))
    legend_below(figure, kinds)


def finish_axes(axes: Axes, run: Run) -> None:
    """Scales and names of axes that hold curves."""
    log_scale(axes.yaxis)
    axes.margins(x=0.01)
    axes.set_xlabel("excitation frequency [Hz]")
    axes.set_ylabel(f"response amplitude [{run.unit}]")
    light_grid(axes)


def curves_figure(run: Run) -> Optional[Figure]:
    """All curves; None where there are solutions at one frequency only."""
    if all(len(np.unique(table["frequency_Hz"])) < 2 for _, table in run.curves):
        return None
    figure, axes = subplots(1, 1, (7.2, 4.4))
    for curve, table in run.curves:
        draw_curve(axes, run, curve, table)
    finish_axes(axes, run)
    axes.set_title(run.title, loc="left")
    legend_of_loads(axes, run)
    legend_of_marks(figure, run)
    return figure
