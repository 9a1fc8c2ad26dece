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

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from microslip.plots.command import run_command
from microslip.plots.methods import curves_of, methods_figure
from microslip.plots.output import save


def compare(arguments):
    balance = curves_of(arguments.balance)
    times = [(os.path.basename(os.path.normpath(folder)), curves_of(folder)) for folder in arguments.time]
    drawn = methods_figure(balance, times, arguments.limit)
    if drawn is None:
        sys.exit(f"plot_methods.py: no curve of {arguments.balance} is in the other runs")
    figure, largest, texts = drawn
    print(*texts, sep="\n")
    output = arguments.output or os.path.join(arguments.balance, "plots", "methods.png")
    folder, name = os.path.split(os.path.abspath(output))
    os.makedirs(folder, exist_ok=True)
    save(figure, folder, os.path.splitext(name)[0])
    print(f"largest difference {largest:.4f} % of the peak; written: {output}")
    if arguments.limit is not None and not largest <= arguments.limit:
        sys.exit(f"plot_methods.py: above the limit of {arguments.limit} %")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("balance", help="run folder of harmonic balance")
    parser.add_argument("time", nargs="+", help="run folders of method = \"time\"")
    parser.add_argument("-o", "--output", help="figure; default: BALANCE_FOLDER/plots/methods.png")
    parser.add_argument("--limit", type=float, help="largest difference allowed, %% of the peak")
    return run_command(compare, parser.parse_args())


if __name__ == "__main__":
    sys.exit(main())
