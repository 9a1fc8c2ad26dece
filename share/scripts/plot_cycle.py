#!/usr/bin/python3
"""Loops of contact points over one period, coloured by state; SVG and PNG beside the samples.

    plot_cycle.py FOLDER NAME [NAME …]

Reads FOLDER/NAME.csv as `microslip cycle --plot FOLDER` writes it: friction over u, load over v, and
where w moves friction over w and the orbit of the friction. The same samples give the same SVG files
byte for byte. Needs no display.
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from microslip.plots.command import given, run_command
from microslip.plots.cycle_loops import plot_cycles

if __name__ == "__main__":
    folder, *names = given(__doc__, 2)
    sys.exit(run_command(plot_cycles, folder, names))
