"""Page and plots of a run, each as far as it can be made."""

from __future__ import annotations

import os
import sys
import warnings
from typing import Optional

from microslip.files import RoomError, RunError
from microslip.report.page import write_page
from microslip.results import Run, RunWarning


def write_report_page(folder: str, into: str, summary: Optional[str] = None, cache: Optional[str] = None) -> None:
    """INTO/report.html. RunError without a summary that can be read."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RunWarning)  # the page says it
        run = Run(folder, summary)
    write_page(run, os.path.join(into, "report.html"), cache)


def draw_plots(folder: str, into: str, cache: Optional[str]) -> int:
    """INTO/plots, of `cache` those that earlier runs have drawn. An exit code."""
    try:
        from microslip.plots.command import run_command
    except ModuleNotFoundError as error:
        print(f"no plots: the Python package {error.name} is not installed: apt-get install python3-matplotlib; "
              "report.html, curves and maps are there", file=sys.stderr)
        return 1
    from microslip.plots.run_plots import plot_run
    return run_command(plot_run, folder, os.path.join(into, "plots"), cache)


def report(folder: str, into: Optional[str] = None, summary: Optional[str] = None, cache: Optional[str] = None) -> int:
    """Both. The exit code."""
    into = into or folder
    try:
        write_report_page(folder, into, summary, cache)  # first: it is quick, and a run may be short of time
    except RunError as error:
        print(error, file=sys.stderr)
        return 4 if isinstance(error, RoomError) else 1
    return draw_plots(folder, into, cache)
