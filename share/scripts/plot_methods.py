#!/usr/bin/python3
"""Harmonic balance and time integration of one scene in one figure, with their difference.

    plot_methods.py BALANCE_FOLDER TIME_FOLDER [TIME_FOLDER …] [-o FILE] [--limit 0.2]

The first run is harmonic balance (a branch, unstable parts dashed); the others have method = "time": sweeps up
(▲) or down (▼), of which each steady state is one mark. Curves are paired by name. Printed per curve and
run: the largest difference between a steady state and the nearest solution of the branch at its frequency,
over the peak of the branch. --limit, in %: more ends with code 1.

Between two rows the branch is read off a cubic through four rows over their chord length: continuation takes
steps that turn by some 0.13 rad, so that this is accurate to some 1e-4 of the step.
"""

import argparse
import os
import sys

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

import plot_run

PIECES = 40  # straight pieces between two rows of the branch; their sagitta is 1600 times below the rows'
COLOURS = ["#12355b", "#c1121f", "#5b9279", "#f4a259", "#b23a6f", "#6c757d", "#3a86ff", "#8d6e00"]


def curves_of(folder):
    """Tables of the curves of a run by name; limits are left out."""
    summary = plot_run.read_summary(os.path.join(folder, "summary.json"))
    tables = {}
    for curve in summary["curves"]:
        path = os.path.join(folder, "curves", curve["name"] + ".csv")
        if curve["name"] not in ("free", "stuck") and os.path.exists(path):
            table = plot_run.read_table(path, ("frequency_Hz", "amplitude_m"))
            if len(table["frequency_Hz"]):
                tables[curve["name"]] = table
    return tables


def through(points, chords, at):
    """Lagrange's polynomial through points (n × 2) given at chord lengths (n)."""
    value = np.zeros((len(at), points.shape[1]))
    for i, point in enumerate(points):
        others = np.delete(chords, i)
        weight = np.prod((at[:, None] - others) / (chords[i] - others), axis=1)
        value += weight[:, None] * point
    return value


def fine_branch(table):
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


def amplitudes_at(branch, frequency):
    """Of all solutions of the branch at a frequency."""
    f, a = branch.T
    low, high = np.minimum(f[:-1], f[1:]), np.maximum(f[:-1], f[1:])
    found = []
    for i in np.flatnonzero((low <= frequency) & (frequency <= high)):
        share = 0.0 if f[i] == f[i + 1] else (frequency - f[i]) / (f[i + 1] - f[i])
        found.append(a[i] + share * (a[i + 1] - a[i]))
    return found


def differences(branch, table):
    """Signed difference of each steady state from the nearest solution; NaN where the branch has none."""
    result = []
    for frequency, amplitude in zip(table["frequency_Hz"], table["amplitude_m"]):
        found = amplitudes_at(branch, frequency)
        result.append(min((amplitude - a for a in found), key=abs, default=np.nan))
    return np.array(result)


def unstable_parts(table):
    """Slices of rows in which no row is stable, a neighbour on each side included."""
    unstable = table["stable"] == 0
    edges = np.flatnonzero(np.diff(np.concatenate([[0], unstable.astype(int), [0]])))
    return [slice(max(a - 1, 0), b + 1) for a, b in edges.reshape(-1, 2)]


def draw_branch(axes, table, branch, colour, unit):
    axes.plot(branch[:, 0], branch[:, 1] / unit, color=colour, lw=1.1, zorder=2)
    for part in unstable_parts(table):
        axes.plot(table["frequency_Hz"][part], table["amplitude_m"][part] / unit, color="white",
                  lw=1.4, ls=(0, (2, 2)), zorder=3)


def compared(name, run, branch, table, peak):
    """Differences in % of the peak, and a line about them; infinite where nothing can be compared."""
    share = 100.0 * differences(branch, table) / peak
    valid = np.isfinite(share)
    if not valid.any():
        return share, float("inf"), f"{name}, {run}: no steady state within the range of the branch"
    worst = int(np.nanargmax(np.abs(share)))
    return share, abs(share[worst]), (
        f"{name}, {run}: {valid.sum()} of {len(share)} steady states compared, largest difference "
        f"{abs(share[worst]):.4f} % of the peak at {table['frequency_Hz'][worst]:.6g} Hz")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("balance", help="run folder of harmonic balance")
    parser.add_argument("time", nargs="+", help="run folders of method = \"time\"")
    parser.add_argument("-o", "--output", help="figure; default: BALANCE_FOLDER/plots/methods.png")
    parser.add_argument("--limit", type=float, help="largest difference allowed, %% of the peak")
    arguments = parser.parse_args()
    balance = curves_of(arguments.balance)
    runs = {folder: curves_of(folder) for folder in arguments.time}
    names = [name for name in balance if any(name in curves for curves in runs.values())]
    if not names:
        sys.exit(f"plot_methods.py: no curve of {arguments.balance} is in the other runs")

    plt.rcParams.update(plot_run.STYLE)
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(6.6, 5.4), sharex=True, layout="constrained",
                                         gridspec_kw={"height_ratios": [3, 1]})
    unit_name, unit = plot_run.length_unit(max(balance[name]["amplitude_m"].max() for name in names))
    largest = 0.0
    handles = []
    for i, name in enumerate(names):
        colour = COLOURS[i % len(COLOURS)]
        branch = fine_branch(balance[name])
        peak = balance[name]["amplitude_m"].max()
        draw_branch(top, balance[name], branch, colour, unit)
        handles.append(Line2D([], [], color=colour, label=name.replace("_", " ")))
        for folder, curves in runs.items():
            if name not in curves:
                continue
            table = curves[name]
            share, worst, text = compared(name, os.path.basename(os.path.normpath(folder)), branch,
                                          table, peak)
            print(text)
            largest = max(largest, worst)
            marker = "v" if table["frequency_Hz"][0] > table["frequency_Hz"][-1] else "^"
            style = {"ls": "none", "marker": marker, "ms": 3.6, "mfc": "none", "mec": colour, "mew": 0.8}
            top.plot(table["frequency_Hz"], table["amplitude_m"] / unit, zorder=4, **style)
            bottom.plot(table["frequency_Hz"], share, **style)
    handles += [Line2D([], [], color="0.3", marker=marker, ls="none", mfc="none", ms=4, label=label)
                for marker, label in (("^", "time, up"), ("v", "time, down"))]
    top.set_ylabel(f"half peak-to-peak [{unit_name}]")
    top.legend(handles=handles)
    bottom.set_ylabel("difference\n[% of the peak]")
    bottom.set_xlabel("frequency [Hz]")
    bottom.axhline(0.0, color="0.6", lw=0.6)
    if arguments.limit is not None:
        bottom.axhspan(-arguments.limit, arguments.limit, color="0.92", zorder=0)
    output = arguments.output or os.path.join(arguments.balance, "plots", "methods.png")
    folder, name = os.path.split(os.path.abspath(output))
    os.makedirs(folder, exist_ok=True)
    plot_run.save(figure, folder, os.path.splitext(name)[0])
    print(f"largest difference {largest:.4f} % of the peak; written: {output}")
    if arguments.limit is not None and not largest <= arguments.limit:
        sys.exit(f"plot_methods.py: above the limit of {arguments.limit} %")


if __name__ == "__main__":
    main()
