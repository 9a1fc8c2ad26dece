#!/usr/bin/python3
"""Plots and report.html of a run folder.

    report_run.py RUN_FOLDER [INTO [SUMMARY.json [CACHE]]]

Reads summary.json (or SUMMARY.json in its place), scene.toml, curves/, model.h5 and maps/*.h5; writes INTO/plots and INTO/report.html,
RUN_FOLDER by default. Plots that were drawn of the same before and are kept in the folder CACHE are taken from there. The page
needs no network and no matplotlib. Exit code 1, and a sentence, where a part cannot be made; the rest is.
"""

import os
import sys

sys.dont_write_bytecode = True  # a full disk cuts it off, and no later run could read it
sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from microslip.report.command import report

if __name__ == "__main__":
    sys.exit(report(*sys.argv[1:]))
