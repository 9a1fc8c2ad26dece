#!/usr/bin/python3
"""Motion of one contact point over a period, as the four graphs of paper B, figure 6; a row per run.

    plot_oscillator.py RUN_FOLDER [RUN_FOLDER …] -o FILE [--point N]

Displacement and velocity over the phase, velocity over displacement, displacement over the excitation sin θ;
from the first contact map of each run. Stick is drawn thick. SI units; the velocity is that of physical time.
"""

import argparse
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from microslip.plots.command import run_command
from microslip.plots.oscillator import plot_oscillator


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folders", nargs="+", metavar="RUN_FOLDER")
    parser.add_argument("-o", "--output", required=True, help="picture to write (.png, .svg, .pdf)")
    parser.add_argument("--point", type=int, default=1, help="number of the contact point; default 1")
    arguments = parser.parse_args()
    return run_command(plot_oscillator, arguments.folders, arguments.point - 1, arguments.output)


if __name__ == "__main__":
    sys.exit(main())
