#!/usr/bin/python3
"""What the effects of a scene cost, as tests/benchmarks/effect_sets.py measures them.

    effect_sets.py … --csv SETS.csv && plot_effect_sets.py SETS.csv -o PICTURE

A pair of bars for each set: the scene as it is, and with every effect on.
"""

import argparse
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from microslip.plots.command import run_command
from microslip.plots.effect_sets import plot_effect_sets


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("table", help="CSV of effect_sets.py")
    parser.add_argument("-o", "--output", required=True, help="picture to write (.png, .svg, .pdf)")
    arguments = parser.parse_args()
    return run_command(plot_effect_sets, arguments.table, arguments.output)


if __name__ == "__main__":
    sys.exit(main())
