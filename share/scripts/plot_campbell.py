#!/usr/bin/python3
"""The diagram of a `microslip campbell` study.

    plot_campbell.py FOLDER/campbell HIGHEST_ENGINE_ORDER

Reads frequencies.csv and crossings.csv, writes campbell.svg and .png beside them. Needs no display.
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from microslip.plots.campbell import plot_campbell
from microslip.plots.command import given, run_command

if __name__ == "__main__":
    sys.exit(run_command(plot_campbell, *given(__doc__, 2, 2)))
