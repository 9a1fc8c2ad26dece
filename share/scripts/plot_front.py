#!/usr/bin/python3
"""Error against time of every way to evaluate a contact, as tests/benchmarks/bench_front measures them.

    bench_front --csv FRONT.csv && plot_front.py FRONT.csv -o PICTURE

A mark is a method at a setting (instants, tolerance, cells), a line a method; the step line is the front: nothing
below it is both faster and more accurate. Grey is the range a user reads, 1e-2 to 1e-6.
"""

import argparse
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from microslip.plots.command import run_command
from microslip.plots.front import plot_front


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("table", help="CSV of bench_front")
    parser.add_argument("-o", "--output", required=True, help="picture to write (.png, .svg, .pdf)")
    arguments = parser.parse_args()
    return run_command(plot_front, arguments.table, arguments.output)


if __name__ == "__main__":
    sys.exit(main())
