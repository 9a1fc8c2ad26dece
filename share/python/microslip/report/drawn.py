"""What the script of the page draws: curves, peaks and maps as plain numbers."""

from __future__ import annotations

import base64
import json
import os
from typing import TYPE_CHECKING, Any, Callable, Dict, Mapping, Optional, Sequence

import numpy as np

from microslip.arrows import arrows_at
from microslip.branch import AMPLITUDE, PHASE, cubics
from microslip.boundaries import GUARDS, Vertices, instant_boundaries, parted_cells, period_boundaries, starts_of_states, triangles_of
from microslip.files import RunError, trace_in
from microslip.kept import Kept, bytes_in, digest, sources_in
from microslip.plots.numbers import digits_told, is_number, length_unit, plain
from microslip.states import STATES

if TYPE_CHECKING:
    from microslip.results import ContactMap, Curve, Run

Entry = Dict[str, Any]  # of the page's data
# (key, in a word, what the axis says, whether it is logarithmic)
QUANTITIES = [
    ("amplitude", "amplitude", "response amplitude", True),
    ("phase_deg", "phase [°]", "phase of the first harmonic [°]", False),
    ("reduction", "against free", "amplitude over that of the free blade at the same frequency", True),
    ("equivalent_damping", "damping [%]", "equivalent damping ratio, friction and modal damping [%]", True),
    ("dissipated_energy", "dissipated [J]", "energy dissipated by friction [J per period]", True),
    ("slip_share", "slip [%]", "share of area and period that slips [%]", False),
    ("separated_share", "open [%]", "share of area and period that is open [%]", False),
]
VIRIDIS = ((68, 1, 84), (70, 50, 127), (54, 92, 141), (39, 127, 142), (31, 161, 135), (74, 194, 109), (160, 218, 57))
LIMITS = {"free": "#1a1a1a", "stuck": "#8c8c8c"}
MOST_PHASES = 72
MOST_BYTES = 6e6  # of maps in one page


def colour(share: float) -> str:
    """Of a preload, by its place among them, 0 … 1."""
    place = share * (len(VIRIDIS) - 1)
    first = min(int(place), len(VIRIDIS) - 2)
    mixed = [round(a + (place - first) * (b - a)) for a, b in zip(VIRIDIS[first], VIRIDIS[first + 1])]
    return "#" + "".join(f"{value:02x}" for value in mixed)


def numbers(values: Any, digits: int = 7) -> list[Optional[float]]:
    """For JSON: no more digits than are seen, null where there is no number."""
    return [float(f"{value:.{digits}g}") if np.isfinite(value) else None for value in np.asarray(values, dtype=float)]


def gap_of(curve: Curve) -> Optional[float]:
    """Width of the gap everywhere [µm]; None where there is none, or not one."""
    gap = curve.summary.get("gap_m")
    return 1e6 * gap if gap else None


def label_of(curve: Curve) -> str:
    """What tells a curve from the others of its family."""
    if not is_number(curve.preload):
        return str(curve.preload)
    if curve.summary.get("preload_scale") is not None:
        return f"preload × {curve.preload:g}"
    if curve.preload >= 0:
        return f"{plain(curve.preload)} N"
    gap = gap_of(curve)
    return f"gap {gap:.3g} µm" if gap else f"gap ({plain(curve.preload)} N)"


def ratio_to_free(table: Mapping[str, Any], free: Mapping[str, Any]) -> np.ndarray:
    """Amplitude over that of the free curve at the same frequency; NaN outside of its range."""
    order = np.argsort(free["frequency_Hz"])
    at = np.interp(table["frequency_Hz"], free["frequency_Hz"][order], free["amplitude_m"][order], np.nan, np.nan)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(at > 0, table["amplitude_m"] / at, np.nan)


def columns_of(curve: Curve, free: Optional[Curve], size: float, damage: list[str]) -> dict[str, list[Optional[float]]]:
    """Values of every quantity the run has."""
    columns = {"amplitude": curve["amplitude_m"] / size}
    columns.update({name: factor * curve[name] for name, factor in
                    (("phase_deg", 1.0), ("slip_share", 100.0), ("separated_share", 100.0)) if name in curve})
    if free is not None and curve.name != free.name:
        columns["reduction"] = ratio_to_free(curve, free)
    try:
        columns["equivalent_damping"] = 100.0 * curve.energy["equivalent_damping_ratio"]
        if curve.preload != "free" and curve.preload != "stuck":
            columns["dissipated_energy"] = curve.energy["dissipated_energy_J"]
    except (RunError, ImportError) as error:
        damage.append(f"no damping, no dissipated energy: {error}")
    return {name: numbers(values) for name, values in columns.items()}


def between(curve: Curve, size: float) -> dict[str, list[Optional[list[Optional[float]]]]]:
    """How the curve goes from each point to the next: two control points of a cubic, null for a gap."""
    drawn_as = {"amplitude": (AMPLITUDE, size), "phase_deg": (PHASE, 1.0)}
    ways = {}
    for name, (quantity, unit) in drawn_as.items():
        if quantity[0] in curve:
            inner = cubics(curve.summary, curve, quantity)[:, 1:3] / (1.0, unit)
            ways[name] = [numbers(points.ravel(), 8) if np.isfinite(points).all() else None for points in inner]
    return ways


def digits_of(bar: Mapping[str, Any], peak: Mapping[str, Any], size: float) -> dict[str, int]:
    """Significant digits by what the script tells: those of the highest peak, as the tables have it."""
    told = {"amplitude": ("peak_amplitude", (peak.get("amplitude_m") or 0.0) / size),
            "frequency": ("peak_frequency", peak.get("frequency_Hz") or 0.0),
            "dissipated_energy": ("dissipated_energy", peak.get("dissipated_energy_J") or 0.0)}
    return {name: digits_told(bar, goal, value) for name, (goal, value) in told.items()}


def curve_entry(curve: Curve, free: Optional[Curve], unit: tuple[str, float], shade: str, damage: list[str]) -> Entry:
    """One curve as the script draws it."""
    name, size = unit
    bar, peak = curve.summary.get("bar"), curve.peak
    entry = {"name": curve.name, "label": label_of(curve), "colour": shade, "limit": not is_number(curve.preload),
             "complete": curve.summary["complete"], "frequency": numbers(curve["frequency_Hz"], 9),
             "stable": [int(value) for value in curve["stable"]], "mark": curve["mark"],
             "values": columns_of(curve, free, size, damage), "between": between(curve, size)}
    entry["digits"] = digits_of(bar or {}, curve.largest or {}, size)
    if bar and peak:
        entry["bar"] = {"frequency": peak["frequency_Hz"], "amplitude": peak["amplitude_m"] / size,
                        "of_frequency": bar.get("peak_frequency") or 0.0, "of_amplitude": bar.get("peak_amplitude") or 0.0}
    more = (curve.summary.get("harmonics") or {}).get("with_more") or {}
    if peak and is_number(more.get("amplitude_m")) and is_number(more.get("frequency_Hz")):
        entry["richer"] = {"harmonics": more.get("highest"),
                           "amplitude": numbers([place["amplitude_m"] / size for place in (peak, more)]),
                           "frequency": numbers([place["frequency_Hz"] for place in (peak, more)], 9)}
    return entry


def read_curves(run: Run, damage: list[str]) -> list[Curve]:
    """The curves that can be read; of the others what is wrong."""
    curves = []
    for name in run.curves:
        try:
            curves.append(run.curves[name])
        except RunError as error:
            damage.append(str(error))
    return curves


def shades_of(curves: Sequence[Curve]) -> dict[str, str]:
    """Colour by name: the limits grey, preloads in order."""
    loads = sorted({curve.preload for curve in curves if is_number(curve.preload)})
    places = {load: i / max(len(loads) - 1, 1) for i, load in enumerate(loads)}
    return {curve.name: colour(places[curve.preload]) if is_number(curve.preload) else LIMITS.get(curve.preload, "#888")
            for curve in curves}


def trace_entry(run: Run, size: float, damage: list[str]) -> Optional[Entry]:
    """Peaks a search went over, value, amplitude and frequency, and the number it varied; None without a search."""
    optimum = run.optimum
    if not optimum:
        return None
    parameter = optimum["parameter"]
    name, column = ("preload", "preload_N") if parameter == "preload" else ("parameter", "value")
    try:
        trace = trace_in(os.path.join(run.folder, f"peak_against_{name}.csv"), column)
    except RunError as error:
        damage.append(str(error))
        return None
    best, bar = None, optimum.get("bar") or {}
    if optimum.get("found"):
        best = {"value": optimum["value"], "frequency": optimum["frequency_Hz"], "amplitude": optimum["amplitude_m"] / size}
    return {"parameter": parameter, "value": numbers(trace[:, 0]), "frequency": numbers(trace[:, 1], 9),
            "amplitude": numbers(trace[:, 2] / size), "best": best,
            "digits": {**digits_of(bar, optimum, size), "value": digits_told(bar, "optimum", optimum.get("value") or 0.0)}}


def peak_entries(curves: Sequence[Curve], shades: Mapping[str, str], size: float) -> list[Entry]:
    """The highest peak of every curve."""
    return [{"label": label_of(curve), "colour": shades[curve.name], "frequency": curve.peak["frequency_Hz"],
             "preload": curve.preload if is_number(curve.preload) else None, "gap": gap_of(curve), "amplitude": curve.peak["amplitude_m"] / size,
             "digits": digits_of(curve.summary.get("bar") or {}, curve.peak, size)}
            for curve in curves if curve.peak]


def bytes_of(values: np.ndarray, low: float, high: float) -> str:
    """One byte per value, low … high as 0 … 255, in base64."""
    scaled = np.zeros(values.shape) if high <= low else 255.0 * (values - low) / (high - low)
    return base64.b64encode(np.round(np.clip(scaled, 0, 255)).astype(np.uint8).tobytes()).decode()


def varying(contact: ContactMap, name: str, label: str, chosen: slice, scale: float) -> Entry:
    """An array over points and phases, its range in the unit of the label."""
    values = scale * contact[name][:, chosen]
    low = -np.abs(values).max() if values.min() < 0 else 0.0
    high = np.abs(values).max()
    return {"label": label, "low": float(low), "high": float(high), "data": bytes_of(values.T, low, high)}


def loop_of(contact: ContactMap) -> Entry:
    """Hysteresis of the whole patch along p: mean relative displacement [µm] and friction force [N], closed."""
    weights = contact["weights"]
    x = 1e6 * weights @ contact["relative_displacement_m"] / weights.sum()
    y = weights @ contact["friction_traction_Pa"]
    return {"x": numbers(np.append(x, x[0])), "y": numbers(np.append(y, y[0])),
            "phases": numbers(np.append(contact["phase_deg"], 360.0))}


def words_of(values: np.ndarray) -> Entry:
    """Two bytes per value in base64, and what a unit of them is."""
    largest = np.abs(values).max(initial=0.0)
    unit = largest / 32767.0 if largest > 0 else 1.0
    return {"unit": float(unit), "data": base64.b64encode(np.round(values / unit).astype("<i2").tobytes()).decode()}


def cycles_of(contact: ContactMap, chosen: slice) -> list[Entry]:
    """Displacement [µm] and friction traction [MPa] of every point over the period, for its hysteresis loops along p and r."""
    return [{"along": along, "x": words_of(1e6 * contact[f"relative_displacement{part}_m"][:, chosen]),
             "y": words_of(1e-6 * contact[f"friction_traction{part}_Pa"][:, chosen])}
            for along, part in (("p", ""), ("r", "_r")) if f"friction_traction{part}_Pa" in contact]


def vertices_of(contact: ContactMap, corners: np.ndarray, cells: np.ndarray) -> Optional[Vertices]:
    """What is known at the corners of the cells; None where it is not."""
    if not len(cells) or "vertex_state_starts_deg" not in contact:
        return None
    guards = {name: contact[f"vertex_{name}_Pa"] for name in GUARDS if f"vertex_{name}_Pa" in contact}
    starts = starts_of_states(contact["vertex_state_starts_deg"])
    return Vertices(corners, triangles_of(cells), contact["phase_deg"], contact["vertex_state"], starts, guards)


def parted_entry(cells: list[int], polygons: Sequence[np.ndarray], states: list[int]) -> Entry:
    """Cells that are drawn part by part: the state of each part, how many corners it has, and all corners."""
    corners = np.concatenate(polygons) if polygons else np.zeros((0, 2))
    return {"cells": cells, "states": states, "sizes": [len(polygon) for polygon in polygons], "corners": words_of(corners.ravel())}


def lines_over(contact: ContactMap, vertices: Optional[Vertices], flat: Callable[[Any], tuple[Any, ...]],
               numbers_chosen: Sequence[int]) -> Entry:
    """What lies over the cells: those that boundaries part, boundaries of the states at each phase and of the period, arrows of slip."""
    over = {"boundaries": [], "parted": [], "period": {}, "arrows": []}
    if vertices is not None:
        over["parted"] = [parted_entry(*parted_cells(vertices, phase, contact["state"][:, phase])) for phase in numbers_chosen]
        over["boundaries"] = [numbers(instant_boundaries(vertices, phase).ravel(), 5) for phase in numbers_chosen]
        over["period"] = {name: numbers(lines.ravel(), 5) for name, lines in period_boundaries(vertices).items()}
    if "slip_r_m" in contact:
        slider = flat((contact["slip_m"], contact["slip_r_m"]))
        points = 1e3 * np.column_stack(flat(contact["points"].T))
        over["arrows"] = [numbers(arrows_at(points, slider, contact["state"], phase).ravel(), 5) for phase in numbers_chosen]
    return over


def map_entry(contact: ContactMap) -> Entry:
    """A contact map: states and tractions at up to MOST_PHASES phases, sums over the period."""
    phases = contact["phase_deg"]
    chosen = slice(None, None, -(-len(phases) // MOST_PHASES))
    area = contact["weights"] / contact["weights"].sum()
    cells, corners = contact["cells"], 1e3 * contact["vertices"]
    names, on_its_side = ["p [mm]", "r [mm]"], len(cells) and np.ptp(corners[:, 1]) > np.ptp(corners[:, 0])

    def flat(pair: Any) -> tuple[Any, ...]:
        """A long patch lies on its side."""
        return tuple(pair)[::-1] if on_its_side else tuple(pair)

    corners, names = np.column_stack(flat(corners.T)), list(flat(names))
    entry = {**lines_over(contact, vertices_of(contact, corners, cells), flat, range(len(phases))[chosen]),
             "cycles": cycles_of(contact, chosen), "name": contact.name, "frequency": float(contact["frequency_Hz"][0]), "phases": numbers(phases[chosen]),
             "states": base64.b64encode(np.ascontiguousarray(contact["state"][:, chosen].T).astype(np.uint8)).decode(),
             "area": numbers(area, 5), "corners": numbers(corners.ravel(), 6), "axes": names,
             "cells": [[int(i) for i in cell] for cell in cells], "n": len(area),
             "loop": loop_of(contact),
             "varying": [varying(contact, "normal_traction_Pa", "normal traction [MPa]", chosen, 1e-6),
                         varying(contact, "friction_traction_Pa", "friction traction along p [MPa]", chosen, 1e-6)]}
    for name, label, scale in (("dissipated_energy_J_per_m2", "dissipated energy [J/m² per period]", 1.0),
                               ("slip_distance_m", "slip distance [µm per period]", 1e6)):
        values = scale * contact[name]
        entry["varying"].append({"label": label, "low": 0.0, "high": float(values.max()), "constant": True,
                                 "data": bytes_of(values, 0.0, values.max())})
    return entry


def kept_entry(contact: ContactMap, path: str, kept: Kept, drawn_by: bytes) -> Entry:
    """map_entry() as an earlier run has made it of the same file, or anew."""
    inputs = digest(drawn_by, contact.name.encode(), bytes_in(path)) if kept.folder else b""
    before = kept.find(inputs)
    if before is not None:
        return json.loads(before[0])
    entry = map_entry(contact)
    kept.keep(inputs, [json.dumps(entry).encode()])
    return entry


def map_digits(run: Run, name: str, frequency: float) -> int:
    """Of the frequency of a map: it is given, but at a peak or a fold."""
    curve = next(curve for curve in run.summary["curves"] if name in (curve.get("maps") or []))
    is_given = not name[len(curve["name"]):].startswith(("_peak", "_fold"))
    return 6 if is_given else digits_told(curve.get("bar") or {}, "peak_frequency", frequency)


def read_maps(run: Run, damage: list[str], cache: Optional[str]) -> list[Entry]:
    """The maps a page has room for."""
    maps, room = [], MOST_BYTES
    kept, drawn_by = Kept(cache, "page"), sources_in("report", "plots") if cache else b""
    for name in run.maps:
        try:
            contact = run.maps[name]
            size = contact["state"].shape[0] * min(contact["state"].shape[1], MOST_PHASES) * 10
            if size > room:
                damage.append(f"map {name} is left out of this page, which would grow too large; plots/map_{name}.png "
                              "shows it")
                continue
            entry = kept_entry(contact, os.path.join(run.folder, "maps", name + ".h5"), kept, drawn_by)
            maps.append({**entry, "frequency_digits": map_digits(run, name, entry["frequency"])})
            room -= size
        except (RunError, ImportError, KeyError) as error:
            damage.append(f"map {name}: {error}")
    return maps


def drawn(run: Run, damage: list[str], cache: Optional[str] = None) -> Entry:
    """Everything that is drawn; sentences about what cannot be are added to `damage`."""
    curves = read_curves(run, damage)
    free = next((curve for curve in curves if curve.preload == "free"), None)
    unit = length_unit(max((curve["amplitude_m"].max() for curve in curves), default=1.0))
    shades = shades_of(curves)
    entries = [curve_entry(curve, free, unit, shades[curve.name], damage) for curve in curves]
    of_length = {"amplitude": f" [{unit[0]}]"}
    quantities = [{"key": key, "short": short + of_length.get(key, ""), "label": label + of_length.get(key, ""),
                   "log": log} for key, short, label, log in QUANTITIES if any(key in entry["values"] for entry in entries)]
    return {"curves": entries, "quantities": quantities, "unit": unit[0],
            "trace": trace_entry(run, unit[1], damage), "peaks": peak_entries(curves, shades, unit[1]),
            "scaled": any(curve.summary.get("preload_scale") is not None for curve in curves),
            "maps": read_maps(run, damage, cache), "states": [[name, shade] for _, name, shade in STATES]}
