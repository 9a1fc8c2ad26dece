"""Contact maps of a run: which there are, how each is drawn, under which title."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterator, Mapping, NamedTuple, Optional

import numpy as np

from microslip.plots.contact_map import ContactMap
from microslip.plots.line_figure import line_figure
from microslip.plots.line_map import LineMap, line_positions
from microslip.plots.numbers import length_unit, told_like
from microslip.plots.output import save
from microslip.plots.patch_map import patch_figure, row_figure
from microslip.plots.run_folder import Run, load_of
from microslip.plots.style import figure_title

if TYPE_CHECKING:
    from matplotlib.figure import Figure


Bar = Dict[str, Any]  # that of a curve in summary.json


def place_in_words(suffix: str) -> str:
    """peak, fold 2, solution 1: the frequency of "315Hz_1" stands in the title anyway."""
    first, _, rest = suffix.partition("_")
    return f"solution {rest}" if first.endswith("Hz") else suffix.replace("_", " ")


class Heading(NamedTuple):
    """What stands above a map; the frequency of the map has a bar where it was solved for."""

    text: str
    amplitude_bar: Bar
    frequency_bar: Optional[Bar]


def heading(text: str, place: str, curve: Mapping[str, Any]) -> Heading:
    known = curve.get("bar") or {}
    bar = {goal: known.get(goal) for goal in ("peak_amplitude", "peak_frequency", "not_known")}
    return Heading(text, bar, bar if place.startswith(("peak", "fold")) else None)


def maps_of(run: Run) -> Iterator[tuple[str, Heading]]:
    """(file, heading) of every map the summary names."""
    for curve, _ in run.curves:
        for name in curve.get("maps", []):
            place = place_in_words(name[len(curve["name"]):].strip("_"))
            word = "preload scale" if run.scaled else "preload"
            text = f"{run.title}: {word} {run.label(load_of(curve))}, {place}"
            yield os.path.join(run.folder, "maps", name + ".h5"), heading(text, place, curve)


def figure_of(contact: ContactMap, run_folder: str, name: str) -> Figure:
    """A patch of cells as such; points without area over position or number and phase where they lie in a row."""
    position = line_positions(run_folder) if contact.cells is None else None
    if position is not None:
        return line_figure(LineMap(run_folder, name, position))
    row = contact.cells is None and np.min(contact.high - contact.low) == 0.0
    return row_figure(contact) if row else patch_figure(contact)


def name_of(path: str) -> str:
    return os.path.splitext(os.path.basename(path))[0]


def map_figure(path: str, title: Heading) -> Figure:
    """Of one file maps/NAME.h5."""
    contact = ContactMap(path)
    figure = figure_of(contact, os.path.dirname(os.path.dirname(path)), name_of(path))
    unit, size = length_unit(contact.amplitude)
    stability = {1: ", stable", 0: ", unstable"}.get(contact.stable, ", stability not judged")
    asked, solved = f"{contact.frequency:.6g}", title.frequency_bar
    frequency = asked if solved is None else told_like(solved, "peak_frequency", float(contact.frequency))
    amplitude = told_like(title.amplitude_bar, "peak_amplitude", float(contact.amplitude) / size)
    figure_title(figure, f"{title.text}, {frequency} Hz, {amplitude} {unit}{stability}")
    return figure


def map_tasks(run: Run, folder: str) -> list[Callable[[], None]]:
    """FOLDER/map_NAME.svg and .png, one call per map that is there."""
    return [lambda path=path, title=title: save(map_figure(path, title), folder, "map_" + name_of(path))
            for path, title in maps_of(run) if os.path.exists(path)]
