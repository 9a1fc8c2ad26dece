"""A run folder as the plots need it: its curves in one unit, each with a colour and a name."""

from __future__ import annotations

import os
from typing import Any, Mapping, Sequence

from matplotlib import colormaps

from microslip.files import AGAIN, RunError, read_summary, read_table, shown
from microslip.plots.numbers import is_number, length_unit, plain
from microslip.plots.style import FREE, STUCK


def load_of(curve: Mapping[str, Any]) -> Any:
    """What tells the curves of a family apart: a scale of the preload, its sum [N], or a limit."""
    scale = curve.get("preload_scale")
    return curve["preload_N"] if scale is None else scale


def shades(name: str, loads: Sequence[float], first: float, last: float) -> dict[float, Any]:
    """Colours of one map, as far from one another as they go: gaps are told from pressure."""
    step = (last - first) / max(len(loads) - 1, 1)
    return {load: colormaps[name](first + i * step) for i, load in enumerate(loads)}


def colours_of(loads: Sequence[float]) -> dict[float, Any]:
    """loads: in order."""
    gaps = [load for load in loads if load < 0]
    return {**shades("magma", gaps, 0.5, 0.85), **shades("viridis", loads[len(gaps):], 0.0, 0.93)}


class Run:
    """Summary, tables of the curves that have points, unit of amplitudes, colours of preloads."""

    def __init__(self, folder: str) -> None:
        self.folder = folder
        self.summary = read_summary(os.path.join(folder, "summary.json"))
        self.title = self.summary.get("title", "")
        self.scaled = any(c.get("preload_scale") is not None for c in self.summary["curves"])
        self.curves = [(curve, self.read_curve(curve))
                       for curve in self.summary["curves"] if curve["points"] > 0]
        largest = max((table["amplitude_m"].max() for _, table in self.curves), default=1.0)
        self.unit, self.size = length_unit(largest)
        loads = sorted({load_of(c) for c, _ in self.curves if is_number(load_of(c))})
        self.colours = colours_of(loads)

    def read_curve(self, curve: Mapping[str, Any]) -> dict[str, Any]:
        path = os.path.join(self.folder, "curves", curve["name"] + ".csv")
        table = read_table(path, ("frequency_Hz", "amplitude_m", "stable", "mark"))
        n_rows = len(table["mark"])
        if n_rows < curve["points"]:
            raise RunError(f"{shown(path)}: {n_rows} rows, summary.json counts {curve['points']} points: {AGAIN}")
        return table

    def colour(self, load: Any) -> Any:
        return self.colours[load] if is_number(load) else (FREE if load == "free" else STUCK)

    def label(self, load: Any) -> str:
        if not is_number(load):
            return load
        if self.scaled:
            return f"× {load:g}"
        return f"{plain(load)} N" if load >= 0 else f"gap ({plain(load)} N)"


def first_map(run: Run) -> str:
    """Name of the first contact map of a run; RunError without any."""
    names = [name for curve in run.summary["curves"] for name in curve["maps"]]
    if not names:
        raise RunError(f"{run.folder}: no contact maps; give the scene [response] maps")
    return names[0]
