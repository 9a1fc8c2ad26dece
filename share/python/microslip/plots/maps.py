"""Contact maps of a run: which there are, how each is drawn, under which title."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Callable, Iterator

import numpy as np

from microslip.plots.contact_map import ContactMap
from microslip.plots.line_figure import line_figure
from microslip.plots.line_map import LineMap, line_positions
from microslip.plots.numbers import length_unit
from microslip.plots.output import save
from microslip.plots.patch_map import patch_figure, row_figure
from microslip.plots.run_folder import Run, load_of
from microslip.plots.style import figure_title

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def place_in_words(suffix: str) -> str:
    """peak, fold 2, solution 1: the frequency of "315Hz_1" stands in the title anyway."""
    first, _, rest = suffix.partition("_")
    return f"solution {rest}" if first.endswith("Hz") else suffix.replace("_", " ")


def maps_of(run: Run) -> Iterator[tuple[str, str]]:
    """(file, title) of every map the summary names."""
    for curve, _ in run.curves:
        for name in curve.get("maps", []):
            place = place_in_words(name[len(curve["name"]):].strip("_"))
            word = "preload scale" if run.scaled else "preload"
            title = f"{run.title}: {word} {run.label(load_of(curve))}, {place}"
            yield os.path.join(run.folder, "maps", name + ".h5"), title


def figure_of(contact: ContactMap, run_folder: str, name: str) -> Figure:
    """A patch of cells as such; points without area over position or number and phase where they lie in a row."""
    position = line_positions(run_folder) if contact.cells is None else None
    if position is not None:
        return line_figure(LineMap(run_folder, name, position))
    row = contact.cells is None and np.min(contact.high - contact.low) == 0.0
    return row_figure(contact) if row else patch_figure(contact)


def name_of(path: str) -> str:
    return os.path.splitext(os.path.basename(path))[0]


def map_figure(path: str, title: str) -> Figure:
    """Of one file maps/NAME.h5."""
    contact = ContactMap(path)
    figure = figure_of(contact, os.path.dirname(os.path.dirname(path)), name_of(path))
    unit, size = length_unit(contact.amplitude)
    stability = {1: ", stable", 0: ", unstable"}.get(contact.stable, ", stability not judged")
    figure_title(figure, f"{title}, {contact.frequency:.6g} Hz, {contact.amplitude / size:.4g} {unit}{stability}")
    return figure


def map_tasks(run: Run, folder: str) -> list[Callable[[], None]]:
    """FOLDER/map_NAME.svg and .png, one call per map that is there."""
    return [lambda path=path, title=title: save(map_figure(path, title), folder, "map_" + name_of(path))
            for path, title in maps_of(run) if os.path.exists(path)]
