#!/usr/bin/python3
"""Plots of a run folder: curve family, peak against preload, contact maps; SVG and PNG.

    plot_run.py RUN_FOLDER [FOLDER]

Reads summary.json, curves/, peak_against_preload.csv and maps/*.h5; writes into FOLDER, RUN_FOLDER/plots by default. The same folder
gives the same SVG files byte for byte. Needs no display.
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from microslip.plots.command import given, run_command
from microslip.plots.run_plots import plot_run

if __name__ == "__main__":
    sys.exit(run_command(plot_run, *given(__doc__, 1, 2)))
