"""Peak against preload, and against any other number of the scene a search has varied."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence

import numpy as np

from microslip.files import trace_in
from microslip.plots.numbers import is_number, told_with
from microslip.plots.run_folder import Run, load_of
from microslip.plots.style import ACCENT, FREE, STUCK, figure_title, light_grid, log_scale, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def peaks_of(run: Run) -> tuple[list[tuple[float, float, float]], dict[str, tuple[float, float]]]:
    """(preload, frequency, amplitude) of the curves that have a solved peak, and the limits by name."""
    family, limits = [], {}
    for curve, _ in run.curves:
        peak = curve.get("peak")
        if peak is None:
            continue
        if is_number(load_of(curve)):
            family.append((load_of(curve), peak["frequency_Hz"], peak["amplitude_m"]))
        else:
            limits[load_of(curve)] = (peak["frequency_Hz"], peak["amplitude_m"])
    return sorted(family), limits


def draw_peaks(column: Sequence[Axes], run: Run, family: Sequence[tuple[float, float, float]], trace: np.ndarray, sign: int) -> None:
    """One pair of axes: amplitude above, frequency below; sign −1 draws the gaps on a mirrored axis."""
    chosen = [peak for peak in family if sign * peak[0] > 0]
    for axes, index, scale in ((column[0], 2, run.size), (column[1], 1, 1.0)):
        if sign > 0 and len(trace):
            axes.plot(trace[:, 0], trace[:, index] / scale, color="0.35", linewidth=1.1, zorder=2)
        for peak in chosen:
            axes.scatter(sign * peak[0], peak[index] / scale, s=26, color=run.colour(peak[0]),
                         edgecolor="white", linewidth=0.6, zorder=3)
        log_scale(axes.xaxis)
        light_grid(axes)
    log_scale(column[0].yaxis)
    if sign < 0:
        column[0].invert_xaxis()  # shared with the axes below


def draw_limits(column: Sequence[Axes], run: Run, limits: Mapping[str, tuple[float, float]], named: bool) -> None:
    for name, (frequency, amplitude) in limits.items():
        for axes, value in ((column[0], amplitude / run.size), (column[1], frequency)):
            axes.axhline(value, color=FREE if name == "free" else STUCK, linewidth=0.9, zorder=1,
                         linestyle="-" if name == "free" else (0, (6, 2)))
            if named:
                above = is_upper(name, limits, 1 if axes is column[0] else 0)
                axes.annotate(name, (1.0, value), xycoords=("axes fraction", "data"),
                              va="bottom" if above else "top", xytext=(4, -1 if above else 1),
                              textcoords="offset points", fontsize=8)


def is_upper(name: str, limits: Mapping[str, tuple[float, float]], index: int) -> bool:
    """Whether this limit's label goes above its line: the lines may lie close together."""
    return all(limits[name][index] >= pair[index] for other, pair in limits.items() if other != name)


def star(axes: Axes, value: float, at: float) -> None:
    axes.scatter(value, at, marker="*", s=90, color=ACCENT, edgecolor="white", linewidth=0.6, zorder=5)


def mark_optimum(column: Sequence[Axes], run: Run, optimum: Mapping[str, Any], what: str, unit: str = "") -> None:
    """The best value on both axes, with its numbers as the title."""
    value, amplitude = optimum["value"], optimum["amplitude_m"] / run.size
    star(column[0], value, amplitude)
    star(column[1], value, optimum["frequency_Hz"])
    bar = optimum.get("bar") or {}
    value_text, amplitude_text, frequency_text = (
        told_with(bar, goal, number) for number, goal in
        ((value, "optimum"), (amplitude, "peak_amplitude"), (optimum["frequency_Hz"], "peak_frequency")))
    column[0].set_title(f"best {what}{value_text}{unit}: {amplitude_text} {run.unit} at {frequency_text} Hz",
                        loc="right", color=ACCENT, fontsize=8)


def finish(figure: Figure, run: Run, column: Sequence[Axes]) -> Figure:
    column[0].set_ylabel(f"peak amplitude [{run.unit}]")
    column[1].set_ylabel("peak frequency [Hz]")
    figure_title(figure, run.title)
    return figure


def peaks_figure(run: Run) -> Optional[Figure]:
    """Peak against preload, gaps on an axis of their own; None where there are less than two peaks."""
    family, limits = peaks_of(run)
    trace = trace_in(os.path.join(run.folder, "peak_against_preload.csv"), "preload_N")
    optimum = run.summary.get("optimum")
    positive = sum(peak[0] > 0 for peak in family)
    gaps = sum(peak[0] < 0 for peak in family)
    if positive + gaps + len(trace) < 2:
        return None
    sides = ([-1] if gaps else []) + ([1] if positive or len(trace) else [])
    ratios = [max(gaps, 2) if side < 0 else max(positive, 4) for side in sides]
    figure, grid = subplots(2, len(sides), (6.4, 4.8), sharex="col", sharey="row", squeeze=False,
                            gridspec_kw={"width_ratios": ratios, "height_ratios": [1.5, 1]})
    for i, side in enumerate(sides):
        column = grid[:, i]
        draw_peaks(column, run, family, trace, side)
        draw_limits(column, run, limits, named=i == len(sides) - 1)
        name = "preload scale [–]" if run.scaled else "preload [N]" if side > 0 else "gap: −preload [N]"
        column[1].set_xlabel(name)
    if optimum and optimum["found"] and optimum["parameter"] == "preload" and sides[-1] > 0:
        what, unit = ("preload × ", "") if run.scaled else ("preload ", " N")
        mark_optimum(grid[:, -1], run, optimum, what, unit)
        for axes in grid[:, -1]:
            axes.axvline(optimum["value"], color=ACCENT, linewidth=0.7, alpha=0.5, zorder=1)
    return finish(figure, run, grid[:, 0])


def parameter_figure(run: Run) -> Optional[Figure]:
    """Peak against a number of the scene that is not the preload; None where no search has varied one."""
    trace = trace_in(os.path.join(run.folder, "peak_against_parameter.csv"), "value")
    optimum = run.summary.get("optimum")
    if len(trace) < 2 or not optimum:
        return None
    figure, column = subplots(2, 1, (6.4, 4.8), sharex=True, height_ratios=[1.5, 1])
    for axes, values in zip(column, (trace[:, 2] / run.size, trace[:, 1])):
        axes.plot(trace[:, 0], values, color="0.35", linewidth=1.1, marker=".", markersize=4)
        light_grid(axes)
    if trace[0, 0] > 0 and trace[-1, 0] > 5 * trace[0, 0]:
        log_scale(column[0].xaxis)
    log_scale(column[0].yaxis)
    if optimum["found"]:
        mark_optimum(column, run, optimum, "")
    load = optimum.get("preload_N")  # None: that of the static loads
    column[1].set_xlabel(f"{optimum['parameter']} [SI], {'static preload' if load is None else f'preload {load:.4g} N'}")
    return finish(figure, run, column)
