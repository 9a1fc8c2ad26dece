"""Harmonic balance and time integration of one scene in one figure, with their difference.

Between two rows the branch is read off a cubic through four rows over their chord length: continuation takes
steps that turn by some 0.13 rad, so that this is accurate to some 1e-4 of the step.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence

import numpy as np
from matplotlib.lines import Line2D

from microslip.files import read_summary, read_table
from microslip.plots.numbers import length_unit
from microslip.plots.style import subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PIECES = 40  # straight pieces between two rows of the branch; their sagitta is 1600 times below the rows'
COLOURS = ["#12355b", "#c1121f", "#5b9279", "#f4a259", "#b23a6f", "#6c757d", "#3a86ff", "#8d6e00"]


def curves_of(folder: str) -> dict[str, dict[str, Any]]:
    """Tables of the curves of a run by name; limits are left out."""
    summary = read_summary(os.path.join(folder, "summary.json"))
    tables = {}
    for curve in summary["curves"]:
        path = os.path.join(folder, "curves", curve["name"] + ".csv")
        if curve["name"] not in ("free", "stuck") and os.path.exists(path):
            table = read_table(path, ("frequency_Hz", "amplitude_m"))
            if len(table["frequency_Hz"]):
                tables[curve["name"]] = table
    return tables


def through(points: np.ndarray, chords: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Lagrange's polynomial through points (n × 2) given at chord lengths (n)."""
    value = np.zeros((len(at), points.shape[1]))
    for i, point in enumerate(points):
        others = np.delete(chords, i)
        weight = np.prod((at[:, None] - others) / (chords[i] - others), axis=1)
        value += weight[:, None] * point
    return value


def fine_branch(table: Mapping[str, Any]) -> np.ndarray:
    """Frequency and amplitude along the branch, PIECES points for each row."""
    points = np.column_stack([table["frequency_Hz"], table["amplitude_m"]])
    if len(points) < 2:
        return points
    scaled = points / np.maximum(np.ptp(points, axis=0), 1e-300)
    steps = np.hypot(*np.diff(scaled, axis=0).T)
    keep = np.concatenate([[True], steps > 0])  # a peak solved for may fall on a row
    points, chords = points[keep], np.concatenate([[0.0], np.cumsum(steps[steps > 0])])
    pieces = []
    for i in range(len(points) - 1):
        first, last = max(i - 1, 0), min(i + 3, len(points))
        at = np.linspace(chords[i], chords[i + 1], PIECES, endpoint=False)
        pieces.append(through(points[first:last], chords[first:last], at))
    return np.vstack(pieces + [points[-1:]])


def amplitudes_at(branch: np.ndarray, frequency: float) -> list[float]:
    """Of all solutions of the branch at a frequency."""
    f, a = branch.T
    low, high = np.minimum(f[:-1], f[1:]), np.maximum(f[:-1], f[1:])
    found = []
    for i in np.flatnonzero((low <= frequency) & (frequency <= high)):
        share = 0.0 if f[i] == f[i + 1] else (frequency - f[i]) / (f[i + 1] - f[i])
        found.append(a[i] + share * (a[i + 1] - a[i]))
    return found


def differences(branch: np.ndarray, table: Mapping[str, Any]) -> np.ndarray:
    """Signed difference of each steady state from the nearest solution; NaN where the branch has none."""
    result = []
    for frequency, amplitude in zip(table["frequency_Hz"], table["amplitude_m"]):
        found = amplitudes_at(branch, frequency)
        result.append(min((amplitude - a for a in found), key=abs, default=np.nan))
    return np.array(result)


def unstable_parts(table: Mapping[str, Any]) -> list[slice]:
    """Slices of rows in which no row is stable, a neighbour on each side included."""
    unstable = table["stable"] == 0
    edges = np.flatnonzero(np.diff(np.concatenate([[0], unstable.astype(int), [0]])))
    return [slice(max(a - 1, 0), b + 1) for a, b in edges.reshape(-1, 2)]


def draw_branch(axes: Axes, table: Mapping[str, Any], branch: np.ndarray, colour: str, unit: float) -> None:
    axes.plot(branch[:, 0], branch[:, 1] / unit, color=colour, lw=1.1, zorder=2)
    for part in unstable_parts(table):
        axes.plot(table["frequency_Hz"][part], table["amplitude_m"][part] / unit, color="white",
                  lw=1.4, ls=(0, (2, 2)), zorder=3)


def compared(name: str, run: str, branch: np.ndarray, table: Mapping[str, Any], peak: float) -> tuple[np.ndarray, float, str]:
    """Differences in % of the peak, and a line about them; infinite where nothing can be compared."""
    share = 100.0 * differences(branch, table) / peak
    valid = np.isfinite(share)
    if not valid.any():
        return share, float("inf"), f"{name}, {run}: no steady state within the range of the branch"
    worst = int(np.nanargmax(np.abs(share)))
    return share, abs(share[worst]), (
        f"{name}, {run}: {valid.sum()} of {len(share)} steady states compared, largest difference "
        f"{abs(share[worst]):.4f} % of the peak at {table['frequency_Hz'][worst]:.6g} Hz")


def draw_curve(axes: tuple[Axes, Axes], name: str, colour: str, table: Mapping[str, Any],
               times: Sequence[tuple[str, Mapping[str, Any]]], unit: float) -> tuple[float, list[str]]:
    """The branch above, steady states of each time run above and their differences below. The largest of these [%],
    and a line of text per run."""
    top, bottom = axes
    branch, peak = fine_branch(table), table["amplitude_m"].max()
    draw_branch(top, table, branch, colour, unit)
    largest, texts = 0.0, []
    for run, steady in times:
        share, worst, text = compared(name, run, branch, steady, peak)
        texts.append(text)
        largest = max(largest, worst)
        marker = "v" if steady["frequency_Hz"][0] > steady["frequency_Hz"][-1] else "^"
        style = {"ls": "none", "marker": marker, "ms": 3.6, "mfc": "none", "mec": colour, "mew": 0.8}
        top.plot(steady["frequency_Hz"], steady["amplitude_m"] / unit, zorder=4, **style)
        bottom.plot(steady["frequency_Hz"], share, **style)
    return largest, texts


def label(top: Axes, bottom: Axes, names: Sequence[str], unit_name: str, limit: Optional[float]) -> None:
    handles = [Line2D([], [], color=COLOURS[i % len(COLOURS)], label=name.replace("_", " "))
               for i, name in enumerate(names)]
    handles += [Line2D([], [], color="0.3", marker=marker, ls="none", mfc="none", ms=4, label=text)
                for marker, text in (("^", "time, up"), ("v", "time, down"))]
    top.set_ylabel(f"half peak-to-peak [{unit_name}]")
    top.legend(handles=handles)
    bottom.set_ylabel("difference\n[% of the peak]")
    bottom.set_xlabel("frequency [Hz]")
    bottom.axhline(0.0, color="0.6", lw=0.6)
    if limit is not None:
        bottom.axhspan(-limit, limit, color="0.92", zorder=0)


def methods_figure(balance: Mapping[str, Mapping[str, Any]], times: Sequence[tuple[str, Mapping[str, Mapping[str, Any]]]],
                   limit: Optional[float] = None) -> Optional[tuple[Figure, float, list[str]]]:
    """The figure, the largest difference [% of the peak] and a line of text per curve and run.

    balance: tables of the curves by name (curves_of); times: (name, such tables) of each time run. None where no curve is
    in both.
    """
    names = [name for name in balance if any(name in curves for _, curves in times)]
    if not names:
        return None
    figure, (top, bottom) = subplots(2, 1, (6.6, 5.4), sharex=True, gridspec_kw={"height_ratios": [3, 1]})
    unit_name, unit = length_unit(max(balance[name]["amplitude_m"].max() for name in names))
    largest, texts = 0.0, []
    for i, name in enumerate(names):
        steady = [(run, curves[name]) for run, curves in times if name in curves]
        worst, lines = draw_curve((top, bottom), name, COLOURS[i % len(COLOURS)], balance[name], steady, unit)
        largest = max(largest, worst)
        texts += lines
    label(top, bottom, names, unit_name, limit)
    return figure, largest, texts
