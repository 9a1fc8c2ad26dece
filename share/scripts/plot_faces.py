#!/usr/bin/python3
"""The faces of a STEP file from two sides, each in a colour of its own and with its number.

    plot_faces.py FACES.json PICTURE

Reads what `microslip faces FILE` writes for it. Needs no display.
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from microslip.plots.command import given, run_command
from microslip.plots.faces import plot_faces

if __name__ == "__main__":
    sys.exit(run_command(plot_faces, *given(__doc__, 2, 2)))
