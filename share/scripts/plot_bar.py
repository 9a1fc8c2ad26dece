#!/usr/bin/python3
"""Stick-slip boundaries along a line of contact points: states over position and phase, transition lines.

    plot_bar.py RUN_FOLDER [RUN_FOLDER …] [-o FILE]

One folder: a figure per contact map in RUN_FOLDER/plots (the report of a run makes the same). Several
folders, or -o: the transition lines of their first maps in one figure, to compare numbers of modes or forces.

Field and lines are the instants at which each state begins, as the run wrote them: both show the same boundaries,
which are not bound to the phases of the map. Between two points that go through the same states boundaries are
straight; where slip ends along the line it closes at the zero of its guard. Maps of older versions have sampled
states alone: their field is drawn, without lines.
"""

import argparse
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from microslip.plots.command import run_command
from microslip.plots.line_figure import plot_comparison
from microslip.plots.run_plots import plot_maps


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folders", nargs="+", metavar="RUN_FOLDER")
    parser.add_argument("-o", "--output", help="picture to write (.png, .svg, .pdf)")
    arguments = parser.parse_args()
    if arguments.output:
        return run_command(plot_comparison, arguments.folders, arguments.output)
    if len(arguments.folders) > 1:
        parser.error("several folders are compared in one picture: name it with -o")
    return run_command(plot_maps, arguments.folders[0])


if __name__ == "__main__":
    sys.exit(main())
