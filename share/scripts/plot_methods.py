#!/usr/bin/python3
"""Curves of one scene by two methods in one picture, and how far they are apart.

    plot_methods.py BALANCE_RUN TIME_RUN -o PICTURE

Curves of the first run folder are lines, points of the second circles. For every preload that both have the
largest difference of amplitude is printed, against the peak of the curve: between points of a branch it is
taken on the cubic through four of them, near a fold on the straight line through two; of several solutions the
nearest counts.
"""

import argparse
import os
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import plot_run
from plot_run import plt


def lagrange(x, y, at):
    """The polynomial through all points."""
    weights = [np.prod([(at - x[j]) / (x[i] - x[j]) for j in range(len(x)) if j != i])
               for i in range(len(x))]
    return np.dot(weights, y)


def nearest_amplitude(table, frequency, amplitude):
    """Of the solutions of a branch at one frequency the nearest to an amplitude; NaN: there is none."""
    x, y = table["frequency_Hz"], table["amplitude_m"]
    left, right = x[:-1] - frequency, x[1:] - frequency
    found = []
    for i in np.flatnonzero((left * right <= 0) & (left != right)):
        around = slice(max(0, i - 1), i + 3)
        steps = np.diff(x[around])
        if not (np.all(steps > 0) or np.all(steps < 0)):
            around = slice(i, i + 2)
        found.append(lagrange(x[around], y[around], frequency))
    return min(found, key=lambda value: abs(value - amplitude), default=np.nan)


def differences(balance, time):
    """(load, largest difference over the peak) of every curve of both runs."""
    tables = {plot_run.load_of(curve): table for curve, table in balance.curves}
    for curve, table in time.curves:
        load = plot_run.load_of(curve)
        if load not in tables or not plot_run.is_number(load):
            continue
        pairs = zip(table["frequency_Hz"], table["amplitude_m"])
        apart = [abs(nearest_amplitude(tables[load], f, a) - a) for f, a in pairs]
        if not np.all(np.isnan(apart)):
            yield load, np.nanmax(apart) / np.max(tables[load]["amplitude_m"])


def plot(balance, time, path):
    figure, axes = plt.subplots(figsize=(7.2, 4.4), layout="constrained")
    for curve, table in balance.curves:
        plot_run.draw_curve(axes, balance, curve, table)
    for curve, table in time.curves:
        axes.scatter(table["frequency_Hz"], table["amplitude_m"] / balance.size, s=18, zorder=5,
                     facecolor="none", edgecolor=balance.colour(plot_run.load_of(curve)), linewidth=0.9)
    plot_run.log_scale(axes.yaxis)
    axes.margins(x=0.01)
    axes.set_xlabel("excitation frequency [Hz]")
    axes.set_ylabel(f"response amplitude [{balance.unit}]")
    axes.set_title(balance.summary.get("title", "") + ": harmonic balance (lines), in time (circles)",
                   loc="left")
    figure.savefig(path, metadata={"Software": None} if path.endswith(".png") else None)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("balance", metavar="BALANCE_RUN")
    parser.add_argument("time", metavar="TIME_RUN")
    parser.add_argument("-o", "--output", required=True, help="picture to write (.png, .svg, .pdf)")
    arguments = parser.parse_args()
    plt.rcParams.update(plot_run.STYLE)
    balance, time = plot_run.Run(arguments.balance), plot_run.Run(arguments.time)
    plot(balance, time, arguments.output)
    for load, difference in differences(balance, time):
        print(f"preload {load:g} N: largest difference {difference:.2e} of the peak")
    return 0


if __name__ == "__main__":
    sys.exit(main())
