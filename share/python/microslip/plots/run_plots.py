"""All plots of a run folder."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Optional

from microslip.files import shown
from microslip.plots.figures import OF_A_RUN
from microslip.plots.maps import map_tasks, maps_of
from microslip.plots.output import run_shared, save
from microslip.plots.run_folder import Run

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def save_if_any(figure: Optional[Figure], folder: str, name: str) -> None:
    """Not every run has every figure."""
    if figure is not None:
        save(figure, folder, name)


def missing_files(run: Run) -> list[str]:
    """Files the summary names and the folder lacks."""
    maps = [path for path, _ in maps_of(run)]
    names = maps + [path[:-3] + ".pvd" for path in maps]
    for curve, _ in run.curves:
        stem = os.path.join(run.folder, "curves", curve["name"])
        names += [f"{stem}_detached_{i}.csv" for i in range(1, curve.get("detached_branches", 0) + 1)]
    return [path for path in names if not os.path.exists(path)]


def plots_folder(run: Run, folder: Optional[str] = None) -> str:
    folder = folder or os.path.join(run.folder, "plots")
    os.makedirs(folder, exist_ok=True)
    return folder


def plot_run(run_folder: str, folder: Optional[str] = None) -> bool:
    """Curves, peaks and maps into a folder, RUN_FOLDER/plots by default. Whether all was there and is drawn; if not,
    stderr says what."""
    run = Run(run_folder)
    folder = plots_folder(run, folder)
    figures = [lambda name=name, draw=draw: save_if_any(draw(run), folder, name) for name, draw in OF_A_RUN.items()]
    drawn = run_shared(figures + map_tasks(run, folder))
    missing = missing_files(run)
    if missing:  # what is there is drawn: maps are large, and may have been removed
        print(f"summary.json names files that are missing: {', '.join(map(shown, missing))}; run the scene again",
              file=sys.stderr)
    return drawn and not missing


def plot_maps(run_folder: str) -> None:
    """The maps alone."""
    run = Run(run_folder)
    for task in map_tasks(run, plots_folder(run)):
        task()
