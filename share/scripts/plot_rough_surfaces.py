#!/usr/bin/python3
"""Figures 2 and 3 of paper B: rough surfaces in contact, and their friction loops; SVG and PNG.

    plot_rough_surfaces.py FOLDER

Reads figure_2.csv and figure_3.csv, which the test verification.rough_surface_curves writes into
paper_b_figures below its build folder; writes figure_2 and figure_3 beside them. Needs no display.
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from microslip.plots.command import given, run_command
from microslip.plots.rough_surfaces import plot_figures

if __name__ == "__main__":
    sys.exit(run_command(plot_figures, *given(__doc__, 1, 1)))
