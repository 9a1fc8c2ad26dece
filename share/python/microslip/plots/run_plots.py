"""All plots of a run folder."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Callable, Optional

from microslip.files import shown
from microslip.plots.figures import OF_A_RUN
from microslip.plots.kept import KeptFigures, inputs_of_map, inputs_of_run
from microslip.plots.maps import map_figure, map_tasks, maps_of, name_of
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


Draw = Callable[[], "Optional[Figure]"]


def figures_of(run: Run) -> list[tuple[str, bytes, Draw]]:
    """Name, digest of all it is drawn from, and how, of every figure."""
    of_all = inputs_of_run(run)
    figures: list[tuple[str, bytes, Draw]] = [(name, of_all, lambda draw=draw: draw(run)) for name, draw in OF_A_RUN.items()]
    return figures + [("map_" + name_of(path), inputs_of_map(run, path, title), lambda path=path, title=title: map_figure(path, title))
                      for path, title in maps_of(run) if os.path.exists(path)]


def plot_run(run_folder: str, folder: Optional[str] = None, cache: Optional[str] = None) -> bool:
    """Curves, peaks and maps into a folder, RUN_FOLDER/plots by default; those that are kept in the folder `cache` are not
    drawn again. Whether all was there and is drawn; if not, stderr says what."""
    run = Run(run_folder)
    folder = plots_folder(run, folder)
    kept = KeptFigures(cache)

    def draw_and_keep(name: str, inputs: bytes, draw: Draw) -> None:
        save_if_any(draw(), folder, name)
        kept.keep(name, inputs, folder)

    drawn = run_shared([lambda figure=figure: draw_and_keep(*figure) for figure in figures_of(run)
                        if not kept.restore(*figure[:2], folder)])
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
