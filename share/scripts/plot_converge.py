#!/usr/bin/python3
"""Work and precision of a `microslip converge` study.

    plot_converge.py FOLDER/converge

Reads KNOB.csv, writes work_precision.svg and .png beside them: error of the peak against seconds, a panel for each curve,
a line for each knob; hollow marks are what the error budget tells. Needs no display.
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from microslip.plots.command import given, run_command
from microslip.plots.work_precision import plot_work_precision

if __name__ == "__main__":
    sys.exit(run_command(plot_work_precision, *given(__doc__, 1, 1)))
