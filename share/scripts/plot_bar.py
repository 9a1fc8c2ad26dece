#!/usr/bin/python3
"""Stick-slip boundaries along a line of contact points: states over position and phase, transition lines.

    plot_bar.py RUN_FOLDER [RUN_FOLDER …] [-o FILE]

One folder: a figure per contact map in RUN_FOLDER/plots (the report of a run makes the same). Several
folders, or -o: the transition lines of their first maps in one figure, to compare numbers of modes or forces.

Field and lines are the instants at which each state begins, as the run wrote them: both show the same boundaries,
which are not bound to the phases of the map. Between two points that go through the same states boundaries are
straight; where slip ends along the line it closes at the zero of its guard. Maps of older versions have sampled
states alone: their field is drawn, without lines.
"""

import argparse
import os
import sys

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

import plot_run

STICK, POSITIVE, NEGATIVE, OPEN, SLIP = range(5)
COLOURS = [colour for _, _, colour in plot_run.STATES]
DASHES, DOTS = (0, (3, 1.5)), (0, (1, 1.2))
KINDS = [("stick to slip", "-"), ("slip to stick", DASHES), ("contact opens or closes", DOTS)]


def kind_of(start, end):
    """Which of KINDS a change of state is."""
    if OPEN in (start, end):
        return 2
    return 1 if end == STICK else 0


def line_positions(folder):
    """Coordinate p or r [m] of contact points on a line; None where they lie otherwise, or nowhere."""
    with plot_run.data_file(os.path.join(folder, "model.h5")) as file:
        if "contact/points" not in file or len(file["contact/points"]) < 3:
            return None
        local = file["contact/points"][:] @ file["contact/frame"][:].T
    extent = np.ptp(local, axis=0)
    along = int(np.argmax(extent))
    if extent[along] <= 0 or np.delete(extent, along).max() > 1e-9 * extent[along]:
        return None
    return local[:, along]


class LineMap:
    """One map of points on a line, in order of position, with the changes of state within the period."""

    def __init__(self, folder, name, position):
        self.order = np.argsort(position)
        self.x = position[self.order]
        path = os.path.join(folder, "maps", name + ".h5")
        with plot_run.data_file(path) as file:
            read = lambda key: file[key][:][self.order]
            plot_run.require_shape(path, "weights", file["weights"][:], self.x.shape)
            self.frequency = file["frequency_Hz"][0]
            self.phase = file["phase_deg"][:]
            self.state = read("state")
            self.energy = read("dissipated_energy_J_per_m2")
            plot_run.require_shape(path, "state", self.state, (len(self.x), len(self.phase)))
            self.guard = read("slip_guard_Pa") if "slip_guard_Pa" in file else None
            starts = read("state_starts_deg") if "state_starts_deg" in file else None
        self.cycles = None if starts is None else [cycle_of(row.reshape(5, -1)) for row in starts]

    def transitions(self, start, end):
        """Angles [deg] of one change of state, one per point, NaN where it has none; of several the first."""
        angles = np.full(len(self.x), np.nan)
        for point, cycle in enumerate(self.cycles):
            states = [state for state, _ in cycle]
            for i, (state, angle) in enumerate(cycle):
                if (states[i - 1], state) == (start, end) and not angles[point] <= angle:
                    angles[point] = angle
        return angles

    def apex(self, slips, sticks):
        """Where between two neighbours slip dies out: the zero of its guard, else the middle."""
        if self.guard is not None and self.guard[slips] > 0 > self.guard[sticks]:
            share = self.guard[slips] / (self.guard[slips] - self.guard[sticks])
        else:
            share = 0.5
        return self.x[slips] + share * (self.x[sticks] - self.x[slips])


def cycle_of(starts):
    """[(state, angle at which it begins [deg]), …] in order of time; empty: one state all the time."""
    return sorted(((state, angle) for state, row in enumerate(starts) for angle in row if np.isfinite(angle)),
                  key=lambda change: change[1])


def near(angle, other):
    """An angle, turned by whole periods to lie within half of one from another."""
    return angle + 360.0 * np.round((other - angle) / 360.0)


def aligned(cycle, other):
    """The other cycle from the change that matches the first of this one, with angles near those of this one;
    None where it goes through other states."""
    n = len(cycle)
    if n != len(other) or n == 0:
        return None
    best, least = None, np.inf
    for shift in range(n):
        turned = other[shift:] + other[:shift]
        if any(a[0] != b[0] for a, b in zip(cycle, turned)):
            continue
        angles = [near(b[1], a[1]) for a, b in zip(cycle, turned)]
        distance = sum(abs(angle - a[1]) for angle, a in zip(angles, cycle))
        if distance < least:
            best, least = [(state, angle) for (state, _), angle in zip(turned, angles)], distance
    return best


def spans(cycle):
    """(state, begin, end) of each part of a cycle, end after begin."""
    n = len(cycle)
    for i, (state, begin) in enumerate(cycle):
        end = cycle[(i + 1) % n][1]
        yield state, begin, end if n > 1 and end > begin else end + 360.0


class Field:
    """Areas of one state over (x, θ), and the lines between them."""

    def __init__(self, line_map):
        self.polygons, self.colours = [], []
        self.lines = []  # (kind, [x], [angle])
        self.map = line_map
        self.edges = cell_edges(line_map.x)
        self.add_end(0, self.edges[0])
        for point in range(len(line_map.x) - 1):
            self.add_pair(point, point + 1)
        self.add_end(len(line_map.x) - 1, self.edges[-1])

    def area(self, state, corners):
        for shift in (-360.0, 0.0, 360.0):
            self.polygons.append([(x, angle + shift) for x, angle in corners])
            self.colours.append(COLOURS[int(state)])

    def line(self, kind, x, angle):
        """A piece of a line: joined to one that ends where it begins."""
        for other, xs, angles in self.lines:
            if other == kind and xs[-1] == x[0] and abs(near(angle[0], angles[-1]) - angles[-1]) < 1e-9:
                xs.append(x[1])
                angles.append(near(angle[1], angles[-1]))
                return
        self.lines.append((kind, list(x), list(angle)))

    def whole(self, point, x0, x1):
        """One state all the time."""
        self.area(self.map.state[point, 0], [(x0, 0), (x1, 0), (x1, 360), (x0, 360)])

    def strip(self, first, second, x0, x1):
        """Between two positions whose cycles match."""
        for i, ((state, a0, a1), (_, b0, b1)) in enumerate(zip(spans(first), spans(second))):
            self.area(state, [(x0, a0), (x1, b0), (x1, near(b1, a1)), (x0, a1)])
            self.line(kind_of(first[i - 1][0], state), (x0, x1), (a0, b0))

    def add_end(self, point, edge):
        """The outer half of the first and the last cell, as the point in it."""
        cycle, x0, x1 = self.map.cycles[point], *sorted((self.map.x[point], edge))
        if cycle:
            self.strip(cycle, cycle, x0, x1)
        else:
            self.whole(point, x0, x1)

    def add_pair(self, left, right):
        x0, x1 = self.map.x[left], self.map.x[right]
        first, second = self.map.cycles[left], self.map.cycles[right]
        match = aligned(first, second)
        if match is not None:
            self.strip(first, match, x0, x1)
        elif not first and not second and self.map.state[left, 0] == self.map.state[right, 0]:
            self.whole(left, x0, x1)
        elif not second and self.map.state[right, 0] == STICK:
            self.close(left, right)
        elif not first and self.map.state[left, 0] == STICK:
            self.close(right, left)
        else:
            middle = 0.5 * (x0 + x1)
            self.add_end(left, middle)
            self.add_end(right, middle)

    def close(self, slips, sticks):
        """Between a point that slips at times and one that never does: each slip shrinks towards its end."""
        cycle, x, x_end = self.map.cycles[slips], self.map.x[slips], self.map.apex(slips, sticks)
        self.whole(sticks, *sorted((x, self.map.x[sticks])))
        for i, (state, begin, end) in enumerate(spans(cycle)):
            if state != STICK:
                self.area(state, [(x, begin), (x, end), (x_end, near(self.tip_of(cycle, i), end))])
        for i, (state, begin) in enumerate(cycle):
            self.line_to_tip(kind_of(cycle[i - 1][0], state), (x, begin), (x_end, self.tip_of(cycle, i)))

    @staticmethod
    def tip_of(cycle, i):
        """The angle at which the slip that a change belongs to dies out: where stick comes next."""
        if cycle[i][0] == STICK:
            return cycle[i][1]
        for ahead in range(1, len(cycle)):
            state, angle = cycle[(i + ahead) % len(cycle)]
            if state == STICK:
                return angle if angle > cycle[i][1] else angle + 360.0
        return cycle[i][1]

    def line_to_tip(self, kind, at, tip):
        pieces = sorted((at, tip))
        self.line(kind, *zip(*pieces))

    def draw(self, axes):
        axes.add_collection(PolyCollection(self.polygons, facecolors=self.colours, linewidth=0, antialiased=False,
                                           rasterized=True))


def cell_edges(x):
    """Borders between points, and as far outside of the first and the last."""
    middle = 0.5 * (x[1:] + x[:-1])
    return np.concatenate([[2 * x[0] - middle[0]], middle, [2 * x[-1] - middle[-1]]])


def unwrapped(x, angle):
    """A line over x without the strokes across the picture where it leaves at 360° and returns at 0°."""
    jump = np.abs(np.diff(angle)) > 180
    at = np.flatnonzero(jump) + 1
    return np.insert(x, at, np.nan), np.insert(angle, at, np.nan)


def axes_of_phase(axes):
    axes.set_ylim(0, 360)
    axes.set_yticks(np.arange(0, 361, 90))
    axes.set_ylabel("phase θ [°]")


def draw_lines(axes, field, colour, outline=None):
    for kind, x, angle in field.lines:
        for shift in (-360, 0, 360):
            axes.plot(x, np.add(angle, shift), color=colour, linewidth=1.2, linestyle=KINDS[kind][1],
                      path_effects=[withStroke(linewidth=2.2, foreground=outline)] if outline else None)


def line_handles(fields):
    """Of the kinds of lines there are."""
    present = {kind for field in fields for kind, _, _ in field.lines}
    return [Line2D([], [], color="0.2", linewidth=1.2, linestyle=style, label=name)
            for kind, (name, style) in enumerate(KINDS) if kind in present]


def draw_samples(axes, line_map):
    """The field at the phases of the map, for maps that have nothing else."""
    step = 360 / len(line_map.phase)
    edges = np.append(line_map.phase, 360.0) - 0.5 * step  # each instant in the middle of its stripe
    for shift in (0, 360):  # the stripe at 0° is seen at both borders
        axes.pcolormesh(cell_edges(line_map.x), edges + shift, line_map.state.T, vmin=-0.5, vmax=4.5,
                        cmap=ListedColormap(COLOURS), rasterized=True)


def plot_line(folder, name, position):
    """States over (x, θ) with their boundaries, and where along the line energy is lost."""
    line_map = LineMap(folder, name, position)
    figure, (axes, energy) = plt.subplots(2, 1, figsize=(6.4, 5.2), layout="constrained", sharex=True,
                                          gridspec_kw={"height_ratios": [3.4, 1]})
    fields = []
    if line_map.cycles is None:
        draw_samples(axes, line_map)
    else:
        fields = [Field(line_map)]
        fields[0].draw(axes)
        draw_lines(axes, fields[0], "white", "0.15")
    axes_of_phase(axes)
    edges = cell_edges(line_map.x)
    axes.set_xlim(edges[0], edges[-1])
    most = line_map.energy.max()
    lost = np.pad(line_map.energy, 1, mode="edge") / (most if most > 0 else 1)
    energy.fill_between(np.concatenate([edges[:1], line_map.x, edges[-1:]]), lost, color="0.4", linewidth=0)
    energy.set_ylim(bottom=0)
    energy.set_ylabel("energy lost\n/ largest")
    energy.set_xlabel("position along the contact x [m]")
    plot_run.state_legend(figure, line_map, handles=line_handles(fields))
    return figure


def label_of(folder):
    """Modes and title of a run, as far as they are known."""
    summary = plot_run.Run(folder).summary
    n_modes = len(summary["modes"])
    return f"{n_modes} mode{'s' if n_modes > 1 else ''} ({os.path.basename(os.path.normpath(folder))})"


def first_map(folder):
    names = [name for curve in plot_run.Run(folder).summary["curves"] for name in curve["maps"]]
    if not names:
        raise SystemExit(f"{folder}: no contact maps; give the scene [response] maps")
    position = line_positions(folder)
    if position is None:
        raise SystemExit(f"{folder}: its contact points do not lie on a line")
    return LineMap(folder, names[0], position)


def plot_comparison(folders, path):
    """Transition lines of several runs, and the slip-to-stick line of the first half-cycle enlarged."""
    figure, (axes, enlarged) = plt.subplots(2, 1, figsize=(7.2, 6.0), layout="constrained", sharex=True,
                                            gridspec_kw={"height_ratios": [2, 1]})
    palette = plt.cm.viridis(np.linspace(0, 0.85, len(folders)))
    handles, fields = [], []
    low, high = np.inf, -np.inf
    for folder, colour in zip(folders, palette):
        line_map = first_map(folder)
        if line_map.cycles is None:
            raise SystemExit(f"{folder}: its map was written by an older version; run the scene again")
        fields.append(Field(line_map))
        draw_lines(axes, fields[-1], colour)
        enlarged.plot(*unwrapped(line_map.x, line_map.transitions(POSITIVE, STICK)), color=colour, linewidth=1.2)
        handles.append(Line2D([], [], color=colour, linewidth=2.5, label=label_of(folder)))
        low, high = min(low, fields[-1].edges[0]), max(high, fields[-1].edges[-1])
    handles = line_handles(fields) + handles
    axes.set_xlim(low, high)
    axes_of_phase(axes)
    enlarged.set_ylabel("positive slip to stick,\nenlarged: θ [°]")
    enlarged.set_xlabel("position along the contact x [m]")
    axes.set_title(plot_run.Run(folders[0]).summary.get("title", ""), loc="left")
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.02))
    figure.savefig(path, metadata={"Software": None} if path.endswith(".png") else None)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folders", nargs="+", metavar="RUN_FOLDER")
    parser.add_argument("-o", "--output", help="picture to write (.png, .svg, .pdf)")
    arguments = parser.parse_args()
    plt.rcParams.update(plot_run.STYLE)
    if arguments.output:
        plot_comparison(arguments.folders, arguments.output)
        return 0
    if len(arguments.folders) > 1:
        parser.error("several folders are compared in one picture: name it with -o")
    folder = arguments.folders[0]
    plots = os.path.join(folder, "plots")
    os.makedirs(plots, exist_ok=True)
    for task in plot_run.map_tasks(plot_run.Run(folder), plots):
        task()
    return 0


if __name__ == "__main__":
    sys.exit(main())
