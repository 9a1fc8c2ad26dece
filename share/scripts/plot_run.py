#!/usr/bin/python3
"""Plots of a run folder: curve family, peak against preload, contact maps; SVG and PNG.

    plot_run.py RUN_FOLDER

Reads summary.json, curves/, peak_against_preload.csv and maps/*.h5; writes plots/. The same folder
gives the same SVG files byte for byte. Needs no display.
"""

import contextlib
import csv
import io
import json
import math
import os
import re
import sys
import traceback

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter
from matplotlib.tri import Triangulation

STYLE = {
    "svg.hashsalt": "microslip",
    "figure.dpi": 100,
    "savefig.dpi": 160,
    "font.size": 9,
    "axes.labelsize": 9,
    "axes.titlesize": 9,
    "legend.fontsize": 8,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "lines.linewidth": 1.3,
    "lines.solid_capstyle": "round",
    "legend.frameon": False,
}
FREE, STUCK = "0.1", "0.55"
ACCENT = "#c1121f"
# (value in files, name, colour): distinct in hue and in lightness, for colour-blind eyes and grey print
STATES = [
    (0, "stick", "#12355b"),
    (1, "positive slip", "#f4a259"),
    (2, "negative slip", "#b23a6f"),
    (3, "separated", "#e9ecef"),
    (4, "slip in two directions", "#5b9279"),
]


MARKS = ("", "peak", "fold", "optimum", "flat")
AGAIN = "the file is damaged; run the scene again"


def shown(path):
    """A file of the run as messages call it: with the folder it stands in."""
    return os.path.join(*path.split(os.sep)[-2:])


def read_table(path, needed=()):
    """Columns of a CSV file by name: finite numbers, with `mark` and `at` as text. SystemExit where a row, a needed
    column or a number is missing."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            lines = csv.reader(file)
            names = next(lines, [])
            rows = [(lines.line_num, row) for row in lines if row]
    except FileNotFoundError:
        raise SystemExit(f"{shown(path)} is missing; run the scene again") from None
    except (OSError, UnicodeDecodeError, csv.Error):
        raise SystemExit(f"{shown(path)}: cannot be read as a table: {AGAIN}") from None
    for name in needed:
        if name not in names:
            raise SystemExit(f"{shown(path)}:1: column \"{name}\" is missing: {AGAIN}")
    for line, row in rows:
        if len(row) != len(names):
            raise SystemExit(f"{shown(path)}:{line}: {len(row)} values under {len(names)} column names: {AGAIN}")
    return {name: column_in([(line, row[i]) for line, row in rows], path, name) for i, name in enumerate(names)}


def column_in(cells, path, name):
    """The cells of one column, each with its line, as numbers or marks."""
    if name == "at":
        return [text for _, text in cells]
    if name != "mark":
        return np.array([number_in(text, path, line, name) for line, text in cells])
    for line, text in cells:
        if text not in MARKS:
            raise SystemExit(f"{shown(path)}:{line}: mark: '{text}' is no mark: {AGAIN}")
    return [text for _, text in cells]


def number_in(text, path, line, name):
    try:
        value = float(text)
        if math.isfinite(value):
            return value
        fault = f"'{text}' is not finite"
    except ValueError:
        fault = f"'{text}' is no number" if text.strip() else "the value is missing"
    raise SystemExit(f"{shown(path)}:{line}: {name}: {fault}: {AGAIN}")


@contextlib.contextmanager
def data_file(path):
    """An HDF5 file of the run, open for reading. SystemExit where it, or something in it, is missing or damaged."""
    import h5py
    if not os.path.exists(path):
        raise SystemExit(f"{shown(path)} is missing; run the scene again")
    try:
        with h5py.File(path, "r") as file:
            yield file
    except KeyError as error:
        name = re.search(r"object '([^']*)' doesn't exist", str(error))
        what = f"\"{name[1]}\" is missing in it" if name else "a part of it cannot be found"
        raise SystemExit(f"{shown(path)}: {what}: {AGAIN}") from None
    except (OSError, RuntimeError):
        raise SystemExit(f"{shown(path)}: is cut off or no HDF5 file: {AGAIN}") from None


def require_shape(path, name, values, shape):
    if values.shape != shape:
        raise SystemExit(f"{shown(path)}: \"{name}\" holds {' × '.join(map(str, values.shape))} values where "
                         f"{' × '.join(map(str, shape))} belong: {AGAIN}")


def save(figure, folder, name):
    """Both formats, each whole or not at all."""
    figure.draw_without_rendering()
    figure.set_layout_engine(None)  # the layout is found; finding it again takes half of the time
    for extension, metadata in (("svg", {"Date": None}), ("png", {"Software": None})):
        buffer = io.BytesIO()
        figure.savefig(buffer, format=extension, metadata=metadata)
        path = os.path.join(folder, f"{name}.{extension}")
        with open(path + ".part", "wb") as file:
            file.write(buffer.getvalue())
        os.replace(path + ".part", path)
    plt.close(figure)


def length_unit(largest):
    """Unit in which a length reads well: (name, size in metres)."""
    for name, size in (("m", 1.0), ("mm", 1e-3), ("µm", 1e-6)):
        if largest >= size:
            return name, size
    return "nm", 1e-9


def log_scale(axis):
    """Logarithmic, with plain numbers at 1, 2, 5 where there is room and at powers of ten else."""
    low, high = axis.get_data_interval()
    if not high > 0:
        return  # nothing moves: a logarithm has nothing to show
    getattr(axis.axes, f"set_{axis.axis_name}scale")("log")
    few = low > 0 and math.log10(high / low) < 2.2
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if few else (1.0,)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))
    axis.set_minor_formatter(NullFormatter())


def legend_below(figure, handles):
    """One row under everything, two where it would be cut off, in a strip of its own."""
    rows = 1 if len(handles) <= 6 else 2
    inches = 0.28 if rows == 1 else 0.44
    strip = inches / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, strip, 1, 1 - strip))
    figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 0.0), ncols=-(-len(handles) // rows),
                  borderaxespad=0.4, columnspacing=1.6)


class Run:
    """A run folder as the plots need it."""

    def __init__(self, folder):
        self.folder = folder
        self.summary = read_summary(os.path.join(folder, "summary.json"))
        self.scaled = any(c.get("preload_scale") is not None for c in self.summary["curves"])
        self.curves = [(curve, self.read_curve(curve)) for curve in self.summary["curves"] if curve["points"] > 0]
        largest = max((table["amplitude_m"].max() for _, table in self.curves), default=1.0)
        self.unit, self.size = length_unit(largest)
        loads = sorted({load_of(c) for c, _ in self.curves if is_number(load_of(c))})
        self.colours = {load: plt.cm.viridis(0.0 if len(loads) == 1 else 0.93 * i / (len(loads) - 1))
                        for i, load in enumerate(loads)}

    def read_curve(self, curve):
        path = os.path.join(self.folder, "curves", curve["name"] + ".csv")
        table = read_table(path, ("frequency_Hz", "amplitude_m", "stable", "mark"))
        n_rows = len(table["mark"])
        if n_rows < curve["points"]:
            raise SystemExit(f"{shown(path)}: {n_rows} rows, summary.json counts {curve['points']} points: {AGAIN}")
        return table

    def colour(self, load):
        return self.colours[load] if is_number(load) else (FREE if load == "free" else STUCK)

    def label(self, load):
        if not is_number(load):
            return load
        if self.scaled:
            return f"× {load:g}"
        return f"{plain(load)} N" if load >= 0 else f"gap ({plain(load)} N)"


def read_summary(path):
    """summary.json, with what runs of older versions left unsaid."""
    try:
        with open(path, encoding="utf-8") as file:
            summary = json.load(file)
    except FileNotFoundError:
        raise SystemExit(f"{shown(path)} is missing; is this the folder of a run?") from None
    except (OSError, ValueError):
        raise SystemExit(f"{shown(path)}: cannot be read as JSON: {AGAIN}") from None
    optimum = summary.get("optimum")
    if optimum:
        summary["optimum"] = {"found": True, "parameter": "preload", "value": optimum.get("preload_N"), **optimum}
    return summary


def load_of(curve):
    """What tells the curves of a family apart: a scale of the preload, its sum [N], or a limit."""
    scale = curve.get("preload_scale")
    return curve["preload_N"] if scale is None else scale


def is_number(value):
    return isinstance(value, (int, float))


def plain(value):
    """20000000 as 2·10⁷, 50 as 50; a real minus sign."""
    text = f"{value:.6g}"
    if "e" in text:
        mantissa, exponent = text.split("e")
        power = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
        text = f"10{power}" if mantissa == "1" else f"{mantissa}·10{power}"
    return text.replace("-", "−")


def branches(table):
    """Runs of intervals of one kind: (unstable, slice of points)."""
    stable, mark = table["stable"], table["mark"]
    unstable = []
    for i in range(len(stable) - 1):
        flags = [stable[k] for k in (i, i + 1) if mark[k] != "fold"]
        unstable.append(0 in flags or not flags)
    start = 0
    for i in range(1, len(unstable) + 1):
        if i == len(unstable) or unstable[i] != unstable[start]:
            yield unstable[start], slice(start, i + 1)
            start = i


def draw_curve(axes, run, curve, table):
    load = load_of(curve)
    limit = not is_number(load)
    colour = run.colour(load)
    frequency = table["frequency_Hz"]
    amplitude = np.where(table["amplitude_m"] > 0, table["amplitude_m"], np.nan) / run.size
    for unstable, part in branches(table):
        # Curves that follow a limit lie on it, and both are seen.
        axes.plot(frequency[part], amplitude[part], color=colour, zorder=2.5 if limit else 3,
                  linewidth=2.4 if limit else 1.3, linestyle=(0, (2.5, 1.6)) if unstable else "-")
    marks = np.array(table["mark"])
    for mark, style in (("peak", {"marker": "o", "s": 14}),
                        ("fold", {"marker": "D", "s": 13, "facecolor": "white"})):
        chosen = marks == mark
        axes.scatter(frequency[chosen], amplitude[chosen], color=style.pop("facecolor", colour),
                     edgecolor=colour, linewidth=0.8, zorder=4, **style)
    if not curve["complete"]:
        axes.scatter(frequency[-1], amplitude[-1], marker="x", s=22, color=ACCENT, zorder=5)


def plot_curves(run, folder):
    if all(len(np.unique(table["frequency_Hz"])) < 2 for _, table in run.curves):
        return  # solutions at one frequency are no curves
    figure, axes = plt.subplots(figsize=(7.2, 4.4), layout="constrained")
    for curve, table in run.curves:
        draw_curve(axes, run, curve, table)
    log_scale(axes.yaxis)
    axes.margins(x=0.01)
    axes.set_xlabel("excitation frequency [Hz]")
    axes.set_ylabel(f"response amplitude [{run.unit}]")
    axes.set_title(run.summary.get("title", ""), loc="left")
    axes.grid(True, which="major", color="0.92", linewidth=0.6)
    axes.set_axisbelow(True)
    loads = [load_of(curve) for curve, _ in run.curves]
    order = (["free"] if "free" in loads else []) + list(run.colours) + (
        ["stuck"] if "stuck" in loads else [])
    lines = [Line2D([], [], color=run.colour(load), label=run.label(load),
                    linewidth=1.3 if is_number(load) else 2.4) for load in order]
    axes.legend(handles=lines, loc="upper left", bbox_to_anchor=(1.0, 1.02), alignment="left",
                title="preload scale" if run.scaled else "preload")
    kinds = [Line2D([], [], color="0.3", label="stable"),
             Line2D([], [], color="0.3", linestyle=(0, (2.5, 1.6)), label="unstable"),
             Line2D([], [], color="0.3", marker="o", markersize=4, linestyle="", label="peak"),
             Line2D([], [], color="0.3", marker="D", markersize=4, linestyle="",
                    markerfacecolor="white", label="fold")]
    if any(not curve["complete"] for curve, _ in run.curves):
        kinds.append(Line2D([], [], color=ACCENT, marker="x", markersize=5, linestyle="",
                            label="ends here (incomplete)"))
    legend_below(figure, kinds)
    save(figure, folder, "curves")


def peaks_of(run):
    """(preload, frequency, amplitude) of the curves that have a solved peak, and the limits by name."""
    family, limits = [], {}
    for curve, _ in run.curves:
        peak = curve.get("peak")
        if peak is None:
            continue
        if is_number(load_of(curve)):
            family.append((load_of(curve), peak["frequency_Hz"], peak["amplitude_m"]))
        else:
            limits[load_of(curve)] = (peak["frequency_Hz"], peak["amplitude_m"])
    return sorted(family), limits


def trace_of(run):
    path = os.path.join(run.folder, "peak_against_preload.csv")
    return trace_in(path, "preload_N")


def trace_in(path, name):
    """Parameter, frequency and amplitude of the peaks a search went over; no rows without a file."""
    if not os.path.exists(path):
        return np.empty((0, 3))
    table = read_table(path, (name, "frequency_Hz", "amplitude_m"))
    return np.column_stack([table[name], table["frequency_Hz"], table["amplitude_m"]])


def draw_peaks(column, run, family, trace, sign):
    """One pair of axes: amplitude above, frequency below; sign −1 draws the gaps on a mirrored axis."""
    chosen = [peak for peak in family if sign * peak[0] > 0]
    for axes, index, scale in ((column[0], 2, run.size), (column[1], 1, 1.0)):
        if sign > 0 and len(trace):
            axes.plot(trace[:, 0], trace[:, index] / scale, color="0.35", linewidth=1.1, zorder=2)
        for peak in chosen:
            axes.scatter(sign * peak[0], peak[index] / scale, s=26, color=run.colour(peak[0]),
                         edgecolor="white", linewidth=0.6, zorder=3)
        log_scale(axes.xaxis)
        axes.grid(True, which="major", color="0.92", linewidth=0.6)
        axes.set_axisbelow(True)
    log_scale(column[0].yaxis)
    if sign < 0:
        column[0].invert_xaxis()  # shared with the axes below


def draw_limits(column, run, limits, named):
    for name, (frequency, amplitude) in limits.items():
        for axes, value in ((column[0], amplitude / run.size), (column[1], frequency)):
            axes.axhline(value, color=FREE if name == "free" else STUCK, linewidth=0.9, zorder=1,
                         linestyle="-" if name == "free" else (0, (6, 2)))
            if named:
                above = is_upper(value, name, limits, axes is column[0])
                axes.annotate(name, (1.0, value), xycoords=("axes fraction", "data"),
                              va="bottom" if above else "top", xytext=(4, -1 if above else 1),
                              textcoords="offset points", fontsize=8)


def is_upper(value, name, limits, amplitudes):
    """Whether this limit's label goes above its line: the lines may lie close together."""
    others = [pair[1 if amplitudes else 0] for other, pair in limits.items() if other != name]
    return not others or limits[name][1 if amplitudes else 0] >= max(others)


def mark_optimum(column, run, optimum):
    best = (optimum["value"], optimum["amplitude_m"] / run.size, optimum["frequency_Hz"])
    for axes, value in ((column[0], best[1]), (column[1], best[2])):
        axes.scatter(best[0], value, marker="*", s=90, color=ACCENT, edgecolor="white",
                     linewidth=0.6, zorder=5)
        axes.axvline(best[0], color=ACCENT, linewidth=0.7, alpha=0.5, zorder=1)
    unit = "× " if run.scaled else ""
    column[0].set_title(f"best preload {unit}{best[0]:.4g}{'' if run.scaled else ' N'}: "
                        f"{best[1]:.4g} {run.unit} at {best[2]:.4g} Hz", loc="right", color=ACCENT,
                        fontsize=8)


def plot_peaks(run, folder):
    family, limits = peaks_of(run)
    trace = trace_of(run)
    optimum = run.summary.get("optimum")
    positive = sum(peak[0] > 0 for peak in family)
    gaps = sum(peak[0] < 0 for peak in family)
    if positive + gaps + len(trace) < 2:
        return
    sides = ([-1] if gaps else []) + ([1] if positive or len(trace) else [])
    ratios = [max(gaps, 2) if side < 0 else max(positive, 4) for side in sides]
    figure, grid = plt.subplots(2, len(sides), figsize=(6.4, 4.8), layout="constrained",
                                sharex="col", sharey="row", squeeze=False,
                                gridspec_kw={"width_ratios": ratios, "height_ratios": [1.5, 1]})
    for i, side in enumerate(sides):
        column = grid[:, i]
        draw_peaks(column, run, family, trace, side)
        draw_limits(column, run, limits, named=i == len(sides) - 1)
        name = "preload scale [–]" if run.scaled else "preload [N]" if side > 0 else "gap: −preload [N]"
        column[1].set_xlabel(name)
    if optimum and optimum["found"] and optimum["parameter"] == "preload" and sides[-1] > 0:
        mark_optimum(grid[:, -1], run, optimum)
    grid[0, 0].set_ylabel(f"peak amplitude [{run.unit}]")
    grid[1, 0].set_ylabel("peak frequency [Hz]")
    figure.suptitle(run.summary.get("title", ""), x=0.01, ha="left", fontsize=9)
    save(figure, folder, "peak_against_preload")


def plot_parameter(run, folder):
    """Peak against a number of the scene that is not the preload."""
    trace = trace_in(os.path.join(run.folder, "peak_against_parameter.csv"), "value")
    optimum = run.summary.get("optimum")
    if len(trace) < 2 or not optimum:
        return
    figure, column = plt.subplots(2, 1, figsize=(6.4, 4.8), layout="constrained", sharex=True,
                                  height_ratios=[1.5, 1])
    for axes, values in zip(column, (trace[:, 2] / run.size, trace[:, 1])):
        axes.plot(trace[:, 0], values, color="0.35", linewidth=1.1, marker=".", markersize=4)
        axes.grid(True, which="major", color="0.92", linewidth=0.6)
        axes.set_axisbelow(True)
    if trace[0, 0] > 0 and trace[-1, 0] > 5 * trace[0, 0]:
        log_scale(column[0].xaxis)
    log_scale(column[0].yaxis)
    if optimum["found"]:
        best = (optimum["value"], optimum["amplitude_m"] / run.size, optimum["frequency_Hz"])
        for axes, value in zip(column, best[1:]):
            axes.scatter(best[0], value, marker="*", s=90, color=ACCENT, edgecolor="white",
                         linewidth=0.6, zorder=5)
        column[0].set_title(f"best {best[0]:.4g}: {best[1]:.4g} {run.unit} at {best[2]:.4g} Hz",
                            loc="right", fontsize=8, color=ACCENT)
    column[1].set_xlabel(f"{optimum['parameter']} [SI], preload {optimum['preload_N']:.4g} N")
    column[0].set_ylabel(f"peak amplitude [{run.unit}]")
    column[1].set_ylabel("peak frequency [Hz]")
    figure.suptitle(run.summary.get("title", ""), x=0.01, ha="left", fontsize=9)
    save(figure, folder, "peak_against_parameter")


def triangles_of(cells):
    """Corner numbers of triangles; quadrilaterals are cut in two."""
    if cells.shape[1] == 3:
        return cells
    return np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])


# Of the period (write_map.hpp); their zero lines bound the points that slip, that open, that touch at some time.
GUARDS = {"slip_guard": ("slips at times", "solid"), "smallest_load": ("open at times", "dashed"),
          "largest_load": ("open throughout", "dotted")}


def nearest_to_zero(values):
    """Of each row, without the entries that are NaN; NaN where all are."""
    size = np.where(np.isnan(values), np.inf, np.abs(values))
    return np.take_along_axis(values, size.argmin(axis=1)[:, None], axis=1)[:, 0]


class ContactMap:
    """One maps/NAME.h5, lengths of the patch in millimetres."""

    def __init__(self, path):
        with data_file(path) as file:
            self.frequency = file["frequency_Hz"][0]
            self.amplitude, self.stable = file["amplitude_m"][0], int(file["stable"][0])
            self.phase = file["phase_deg"][:]
            self.state = file["state"][:]
            self.weights = file["weights"][:]
            self.points = 1e3 * file["points"][:]
            vertices, cells = 1e3 * file["vertices"][:], file["cells"][:]
            self.energy = file["dissipated_energy_J_per_m2"][:]
            self.slip = 1e6 * file["slip_distance_m"][:]
            self.require_shapes(path, vertices, cells)
            self.cells = vertices[cells] if len(cells) else None
            self.starts, self.guards, self.vertex_state, self.lines = None, {}, None, set()
            if len(cells) and "vertex_state_starts_deg" in file:
                self.starts = np.split(file["vertex_state_starts_deg"][:], 5, axis=1)
                self.vertex_state = file["vertex_state"][:]
                self.guards = {name: file[f"vertex_{name}_Pa"][:] for name in GUARDS
                               if f"vertex_{name}_Pa" in file}
            self.triangles = triangles_of(cells) if len(cells) else None
        corners = vertices if self.cells is not None else self.points
        self.names = "p [mm]", "r [mm]"
        if np.ptp(corners[:, 1]) > np.ptp(corners[:, 0]):  # a long patch lies on its side
            corners, self.points = corners[:, ::-1], self.points[:, ::-1]
            self.cells = None if self.cells is None else self.cells[:, :, ::-1]
            self.names = self.names[::-1]
        self.corners = corners
        self.low, self.high = corners.min(axis=0), corners.max(axis=0)

    def require_shapes(self, path, vertices, cells):
        n = len(self.weights)
        require_shape(path, "points", self.points, (n, 2))
        require_shape(path, "state", self.state, (n, len(self.phase)))
        require_shape(path, "dissipated_energy_J_per_m2", self.energy, (n,))
        require_shape(path, "slip_distance_m", self.slip, (n,))
        if len(cells) and not (len(cells) == n and cells.min() >= 0 and cells.max() < len(vertices)):
            raise SystemExit(f"{shown(path)}: \"cells\" do not fit \"vertices\": {AGAIN}")

    def shares(self, phase):
        """Part of the area in stick, slip, separation."""
        weights = self.weights / self.weights.sum()
        state = self.state[:, phase]
        return (weights[state == 0].sum(), weights[np.isin(state, (1, 2, 4))].sum(),
                weights[state == 3].sum())

    def draw_zero_line(self, axes, values, chosen, **style):
        """Where values at the vertices vanish, interpolated in the chosen triangles. Whether they do."""
        at_corners = values[self.triangles[chosen]]
        if not at_corners.size or not np.min(at_corners) < 0 < np.max(at_corners):
            return False
        mesh = Triangulation(*self.corners.T, self.triangles[chosen])
        axes.tricontour(mesh, np.nan_to_num(values), levels=[0.0], **style)
        return True

    def draw_boundaries(self, axes, phase):
        """Boundaries of the states at one phase (its number), interpolated on guards: where a state begins, θ_k − θ,
        in triangles where it begins at every corner (and its angle does not leap around the period); the guards of
        the period in triangles where one corner slips, opens or touches now and another never does."""
        if self.starts is None:
            return
        style = {"colors": "black", "linewidths": 0.7}
        state = self.vertex_state[:, phase]
        for number, starts in enumerate(self.starts):
            ahead = nearest_to_zero((starts - self.phase[phase] + 180.0) % 360.0 - 180.0)
            at_corners = ahead[self.triangles]
            is_here = (state == number)[self.triangles]  # else the line parts two starts of the same state
            smooth = (np.isfinite(at_corners).all(axis=1) & (np.ptp(np.nan_to_num(at_corners), axis=1) < 90)
                      & is_here.any(axis=1) & ~is_here.all(axis=1))
            self.draw_zero_line(axes, ahead, smooth, **style)
        for name, values in self.guards.items():
            never, now = self.sides(name, state)
            mixed = never[self.triangles].any(axis=1) & now[self.triangles].any(axis=1)
            self.draw_zero_line(axes, values, mixed, **style)

    def sides(self, guard, state):
        """Vertices that never do what a guard is about, and those that do it now."""
        starts = [np.isfinite(of_state).any(axis=1) for of_state in self.starts]
        slips, opens = np.isin(state, (1, 2, 4)), state == 3
        if guard == "slip_guard":
            return ~(slips | opens | starts[1] | starts[2] | starts[4]), slips
        if guard == "smallest_load":
            return ~(opens | starts[3]), opens & starts[3]
        return opens & ~starts[3], ~opens

    def draw_guards(self, axes):
        """Boundaries of what occurs within the period, over any colour: white on black."""
        for name, values in self.guards.items():
            chosen = np.ones(len(self.triangles), dtype=bool)
            if name == "slip_guard" and "largest_load" in self.guards:  # what never touches does not slip
                chosen = (self.guards["largest_load"] > 0)[self.triangles].all(axis=1)
            for colour, width, style in (("black", 1.6, "solid"), ("white", 1.0, GUARDS[name][1])):
                if self.draw_zero_line(axes, values, chosen, colors=colour, linewidths=width, linestyles=style):
                    self.lines.add(name)

    def draw(self, axes, colours=None, values=None, cmap=None):
        """Cells in given colours, or coloured by values; lone points where there are no cells."""
        if self.cells is None:
            result = axes.scatter(self.points[:, 0], self.points[:, 1], s=22, marker="s",
                                  c=colours if values is None else values, cmap=cmap,
                                  edgecolor="0.6", linewidth=0.3)
        else:
            result = PolyCollection(self.cells, linewidth=0.25, cmap=cmap,
                                    facecolors=colours, edgecolors="face")
            if values is not None:
                result.set_array(values)
            axes.add_collection(result)
        pad = 0.02 * max(np.max(self.high - self.low), 1e-3)
        axes.set_xlim(self.low[0] - pad, self.high[0] + pad)
        axes.set_ylim(self.low[1] - pad, self.high[1] + pad)
        axes.set_aspect("equal")
        return result


def layout_of(contact):
    """Figure size for two columns of states and one of sums over the period."""
    width, height = np.maximum(contact.high - contact.low, 1e-3)
    ratio = max(height / width, 0.18)  # at most 1: the long side lies flat
    return 3 * 2.9 + 1.2, 2 * (2.9 * ratio + 0.6) + 0.8


def state_legend(figure, contact, lines=(), handles=()):
    present = set(np.unique(contact.state)) | {0, 1, 2, 3}
    patches = [Patch(facecolor=colour, edgecolor="0.6", linewidth=0.4, label=name)
               for value, name, colour in STATES if value in present]
    patches += [Line2D([], [], color="0.3", linewidth=1.0, linestyle=style, label=f"boundary: {name}")
                for guard, (name, style) in GUARDS.items() if guard in lines]
    legend_below(figure, patches + list(handles))


def draw_states(axes, contact, angle):
    """The patch at the phase nearest to an angle [deg]."""
    colour_of = {value: colour for value, _, colour in STATES}
    phase = int(np.argmin(np.abs((contact.phase - angle + 180) % 360 - 180)))
    contact.draw(axes, colours=[colour_of[int(s)] for s in contact.state[:, phase]])
    contact.draw_boundaries(axes, phase)
    stick, slip, apart = contact.shares(phase)
    axes.set_title(f"{contact.phase[phase]:.0f}°:  stick {100 * stick:.0f} %, slip "
                   f"{100 * slip:.0f} %, open {100 * apart:.0f} %", loc="left", fontsize=8)


def draw_sum(figure, axes, contact, values, name):
    """A sum over the period on the patch, from zero."""
    drawn = contact.draw(axes, values=values, cmap="cividis")
    if not values.max() > 0:  # a scale of nothing would invent one
        axes.set_title(f"{name}: 0", loc="left", fontsize=8)
        return
    contact.draw_guards(axes)
    drawn.set_clim(0.0, values.max())
    bar = figure.colorbar(drawn, cax=axes.inset_axes([1.03, 0.0, 0.05, 1.0]))
    bar.outline.set_linewidth(0.5)
    axes.set_title(name, loc="left", fontsize=8)


def plot_patch(contact):
    """States at four phases and what the period sums up to, over the plane of the patch."""
    figure, grid = plt.subplots(2, 3, figsize=layout_of(contact), layout="constrained", sharex=True,
                                sharey=True)
    for axes, angle in zip(grid[:, :2].flat, (0, 90, 180, 270)):
        draw_states(axes, contact, angle)
    draw_sum(figure, grid[0, 2], contact, contact.energy, "dissipated energy [J/m² per period]")
    draw_sum(figure, grid[1, 2], contact, contact.slip, "slip distance [µm per period]")
    for axes in grid.flat:
        axes.spines[:].set_visible(False)
        axes.tick_params(length=2)
    for axes in grid[1]:
        axes.set_xlabel(contact.names[0])
    for axes in grid[:, 0]:
        axes.set_ylabel(contact.names[1])
    figure.get_layout_engine().set(w_pad=0.1)
    return figure


def plot_row(contact):
    """Points in a row have no area to draw: their states over the period, one line per point."""
    n = len(contact.points)
    figure, (states, energy) = plt.subplots(
        1, 2, figsize=(7.2, min(1.6 + 0.22 * n, 7.0)), layout="constrained", sharey=True,
        gridspec_kw={"width_ratios": [3, 1]})
    colours = [colour for _, _, colour in STATES]
    edges = np.append(contact.phase, 360.0)
    states.pcolormesh(edges, np.arange(n + 1) + 0.5, contact.state, vmin=-0.5, vmax=4.5,
                      cmap=ListedColormap(colours))
    states.hlines(np.arange(1, n) + 0.5, 0, 360, color="white", linewidth=min(1.5, 20 / n))
    states.set_xticks(np.arange(0, 361, 90))
    states.set_xlabel("phase [°]")
    states.set_ylabel("contact point")
    if n <= 10:
        states.set_yticks(np.arange(1, n + 1))
    else:
        states.yaxis.set_major_locator(MaxNLocator(integer=True))
    energy.barh(np.arange(1, n + 1), contact.energy, color="0.4", height=0.6)
    energy.set_xlabel("dissipated energy\n[J/m² per period]")
    return figure


def plot_map(path, folder, title):
    import plot_bar  # which draws with what is defined here
    contact = ContactMap(path)
    name = os.path.splitext(os.path.basename(path))[0]
    run_folder = os.path.dirname(os.path.dirname(path))
    position = plot_bar.line_positions(run_folder) if contact.cells is None else None
    if position is not None:
        figure = plot_bar.plot_line(run_folder, name, position)
    else:
        row = contact.cells is None and np.min(contact.high - contact.low) == 0.0
        figure = plot_row(contact) if row else plot_patch(contact)
        state_legend(figure, contact, contact.lines)
    unit, size = length_unit(contact.amplitude)
    stability = {1: ", stable", 0: ", unstable"}.get(contact.stable, "")
    figure.suptitle(f"{title}, {contact.frequency:.6g} Hz, {contact.amplitude / size:.4g} {unit}{stability}", x=0.01,
                    ha="left", fontsize=9)
    save(figure, folder, "map_" + name)


def place_in_words(suffix):
    """peak, fold 2, solution 1: the frequency of "315Hz_1" stands in the title anyway."""
    first, _, rest = suffix.partition("_")
    return f"solution {rest}" if first.endswith("Hz") else suffix.replace("_", " ")


def maps_of(run):
    """(file, title) of every map the summary names."""
    for curve, _ in run.curves:
        for name in curve.get("maps", []):
            place = place_in_words(name[len(curve["name"]):].strip("_"))
            word = "preload scale" if run.scaled else "preload"
            title = f"{run.summary.get('title', '')}: {word} {run.label(load_of(curve))}, {place}"
            yield os.path.join(run.folder, "maps", name + ".h5"), title


def map_tasks(run, folder):
    """One call of plot_map per map that is there."""
    for path, title in maps_of(run):
        if os.path.exists(path):
            yield lambda path=path, title=title: plot_map(path, folder, title)


def missing_files(run):
    """Files the summary names and the folder lacks."""
    names = [path for path, _ in maps_of(run)] + [path[:-3] + ".pvd" for path, _ in maps_of(run)]
    for curve, _ in run.curves:
        stem = os.path.join(run.folder, "curves", curve["name"])
        names += [f"{stem}_detached_{i}.csv" for i in range(1, curve.get("detached_branches", 0) + 1)]
    return [path for path in names if not os.path.exists(path)]


def run_shared(tasks):
    """Shares the figures out to as many processes as there are cores. Plain forks: they end by
    themselves whatever happens to this process. False when one of them failed (it has said why)."""
    n_processes = min(len(os.sched_getaffinity(0)), len(tasks))
    children = []
    for first in range(n_processes):
        child = os.fork()
        if child == 0:
            code = 1
            try:
                for task in tasks[first::n_processes]:
                    task()
                code = 0
            except SystemExit as damage:
                print(damage, file=sys.stderr, flush=True)
            except BaseException:
                traceback.print_exc()
            os._exit(code)
        children.append(child)
    return all([os.waitpid(child, 0)[1] == 0 for child in children])


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__.strip())
        return 0 if len(sys.argv) == 2 else 1
    plt.rcParams.update(STYLE)
    run = Run(sys.argv[1])
    folder = os.path.join(sys.argv[1], "plots")
    os.makedirs(folder, exist_ok=True)
    tasks = [lambda: plot_peaks(run, folder), lambda: plot_parameter(run, folder), lambda: plot_curves(run, folder),
             *map_tasks(run, folder)]
    drawn = run_shared(tasks)
    missing = missing_files(run)
    if missing:  # what is there is drawn: maps are large, and may have been removed
        print(f"summary.json names files that are missing: {', '.join(map(shown, missing))}; run the scene again",
              file=sys.stderr)
    return 0 if drawn and not missing else 1


if __name__ == "__main__":
    sys.exit(main())
