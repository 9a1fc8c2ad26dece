#!/usr/bin/python3
"""The blade of a scene from two sides, with supports, contacts, forces and output marked.

    plot_scene.py SCENE.json PICTURE

Reads what `microslip check SCENE --plot PICTURE` writes for it. Needs no display.
"""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from microslip.plots.command import given, run_command
from microslip.plots.scene import plot_scene

if __name__ == "__main__":
    sys.exit(run_command(plot_scene, *given(__doc__, 2, 2)))
