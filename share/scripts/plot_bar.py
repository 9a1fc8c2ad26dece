#!/usr/bin/python3
"""Stick-slip boundaries along a line of contact points: states over position and phase, transition lines.

    plot_bar.py RUN_FOLDER [RUN_FOLDER …] [-o FILE]

One folder: a figure per contact map in RUN_FOLDER/plots (the report of a run makes the same). Several
folders, or -o: the transition lines of their first maps in one figure, to compare numbers of modes or forces.

The field is what the run wrote, at the phases of its map. The lines are found anew and finer: the motion is
interpolated as the trigonometric polynomial it is, and the sliders are marched over two periods; where that
friction differs from the one written (a law of another kind) no lines are drawn.
"""

import argparse
import os
import sys

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D

import plot_run

N_FINE = 3600  # instants per period of the march; transitions are interpolated between them
AGREEMENT = 0.02  # of the largest friction: a transition falls between two instants of the map at most
STICK, POSITIVE, NEGATIVE, OPEN = range(4)
KINDS = [
    ((STICK, POSITIVE), "stick to slip", "-"),
    ((STICK, NEGATIVE), "stick to slip", "-"),
    ((POSITIVE, STICK), "slip to stick", (0, (3, 1.5))),
    ((NEGATIVE, STICK), "slip to stick", (0, (3, 1.5))),
]


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


def interpolated(samples, n):
    """Periodic samples (points × m), made n a period by trigonometric interpolation; m divides by 2."""
    spectrum = np.fft.rfft(samples, axis=1)
    m = samples.shape[1]
    if m % 2 == 0:
        spectrum[:, -1] = 0.0  # the highest frequency has no phase
    return np.fft.irfft(spectrum, n, axis=1) * (n / m)


class LineMap:
    """One map of points on a line: the states written, and the steady cycle found again."""

    def __init__(self, folder, name, position):
        self.order = np.argsort(position)
        self.x = position[self.order]
        with plot_run.data_file(os.path.join(folder, "maps", name + ".h5")) as file:
            read = lambda key: file[key][:][self.order]
            self.frequency = file["frequency_Hz"][0]
            self.phase = file["phase_deg"][:]
            self.state = read("state")
            self.energy = read("dissipated_energy_J_per_m2")
            self.friction = read("friction_traction_Pa")
            self.u, self.v = read("relative_displacement_m"), read("approach_m")
            self.normal = read("normal_traction_Pa")
        with plot_run.data_file(os.path.join(folder, "model.h5")) as file:
            read = lambda key: file["contact/" + key][:][self.order]
            self.k_u, self.k_v = read("tangential_stiffness"), read("normal_stiffness")
            self.mu = read("friction_coefficient")

    def cycle(self):
        """(u, v, friction, bound) over one period, points × N_FINE: the second pass of the sliders."""
        u, v = interpolated(self.u, N_FINE), interpolated(self.v, N_FINE)
        row = np.arange(len(self.x))
        most = np.argmax(self.normal, axis=1)
        preload = self.normal[row, most] - self.k_v * self.v[row, most]
        bound = self.mu[:, None] * np.maximum(preload[:, None] + self.k_v[:, None] * v, 0.0)
        friction = np.empty_like(u)
        f = np.clip(self.k_u * u[:, 0], -bound[:, 0], bound[:, 0])
        for step in range(1, 2 * N_FINE + 1):
            i = step % N_FINE
            f = np.clip(f + self.k_u * (u[:, i] - u[:, i - 1]), -bound[:, i], bound[:, i])
            friction[:, i] = f
        return u, v, friction, bound

    def transitions(self):
        """Angles [deg] by kind, one per point, NaN where it has none; None where the law is another one or
        a point changes twice in the same way. Between two instants of the march, sticking ends where the
        stuck force meets its bound, and slipping where its drive k_u u ∓ μ k_v v turns."""
        u, v, friction, bound = self.cycle()
        at = np.round(self.phase / 360 * N_FINE).astype(int) % N_FINE
        largest = np.abs(self.friction).max()
        if largest == 0 or np.abs(friction[:, at] - self.friction).max() > AGREEMENT * largest:
            return None
        state = np.where(friction >= bound, POSITIVE, np.where(friction <= -bound, NEGATIVE, STICK))
        state[bound == 0] = OPEN
        angles = {}
        for (start, end), _, _ in KINDS:
            changes = (np.roll(state, 1, axis=1) == start) & (state == end)
            if (changes.sum(axis=1) > 1).any():
                return None
            first = np.argmax(changes, axis=1)  # the instant after the change
            sign = 1 if POSITIVE in (start, end) else -1
            if start == STICK:
                late = end_of_stick(sign * friction, bound, sign * self.k_u[:, None] * u, first)
            else:
                drive = sign * self.k_u[:, None] * u - (self.mu * self.k_v)[:, None] * v
                late = turn_before(drive, first)
            angle = (first - late) * 360 / N_FINE
            angles[start, end] = np.where(changes.any(axis=1), angle % 360, np.nan)
        return angles


def neighbours(values, column):
    """Values of each row at its column and the two before it, in order of time."""
    row = np.arange(len(values))
    return values[row, column - 2], values[row, column - 1], values[row, column]


def end_of_stick(force, bound, stuck, column):
    """Steps by which the instant `column` is later than the meeting of force and bound."""
    _, before, _ = neighbours(bound - force, column)  # room left
    _, bound_before, bound_after = neighbours(bound, column)
    _, stuck_before, stuck_after = neighbours(stuck, column)
    closing = (stuck_after - stuck_before) - (bound_after - bound_before)
    share = np.divide(before, closing, out=np.ones_like(before), where=closing > 0)
    return 1 - np.clip(share, 0, 1)


def turn_before(drive, column):
    """Steps by which the instant `column` is later than the maximum of the drive: a parabola."""
    first, middle, last = neighbours(drive, column)
    curvature = first - 2 * middle + last
    shift = np.divide(first - last, 2 * curvature, out=np.zeros_like(first), where=curvature < 0)
    return 1 - np.clip(shift, -1, 1)


def unwrapped(x, angle):
    """A line over x without the strokes across the picture where it leaves at 360° and returns at 0°."""
    jump = np.abs(np.diff(angle)) > 180
    at = np.flatnonzero(jump) + 1
    return np.insert(x, at, np.nan), np.insert(angle, at, np.nan)


def draw_transitions(axes, x, angles, colour):
    for kind, _, style in KINDS:
        axes.plot(*unwrapped(x, angles[kind]), color=colour, linewidth=1.2, linestyle=style)


def kind_handles(colour):
    return [Line2D([], [], color=colour, linewidth=1.2, linestyle="-", label="stick to slip"),
            Line2D([], [], color=colour, linewidth=1.2, linestyle=(0, (3, 1.5)),
                   label="slip to stick")]


def cell_edges(x):
    """Borders between points, and as far outside of the first and the last."""
    middle = 0.5 * (x[1:] + x[:-1])
    return np.concatenate([[2 * x[0] - middle[0]], middle, [2 * x[-1] - middle[-1]]])


def axes_of_phase(axes):
    axes.set_ylim(0, 360)
    axes.set_yticks(np.arange(0, 361, 90))
    axes.set_ylabel("phase θ [°]")


def plot_line(folder, name, position):
    """States over (x, θ) with the transition lines, and where along the line energy is lost."""
    line_map = LineMap(folder, name, position)
    figure, (field, energy) = plt.subplots(2, 1, figsize=(6.4, 5.2), layout="constrained", sharex=True,
                                           gridspec_kw={"height_ratios": [3.4, 1]})
    step = 360 / len(line_map.phase)
    edges = np.append(line_map.phase, 360.0) - 0.5 * step  # each instant in the middle of its stripe
    colours = [colour for _, _, colour in plot_run.STATES]
    for shift in (0, 360):  # the stripe at 0° is seen at both borders
        field.pcolormesh(cell_edges(line_map.x), edges + shift, line_map.state.T, vmin=-0.5, vmax=4.5,
                         cmap=ListedColormap(colours), rasterized=True)
    angles = line_map.transitions()
    axes_of_phase(field)
    most = line_map.energy.max()
    energy.fill_between(line_map.x, line_map.energy / (most if most > 0 else 1), color="0.4", linewidth=0)
    energy.set_ylim(bottom=0)
    energy.set_ylabel("energy lost,\nshare of the largest")
    energy.set_xlabel("position along the contact x [m]")
    energy.margins(x=0)
    plot_run.state_legend(figure, line_map)
    if angles is not None:
        draw_transitions(field, line_map.x, angles, "white")
        field.legend(handles=kind_handles("white"), loc="upper left", facecolor="#12355b",
                     labelcolor="white", frameon=True, framealpha=0.6, edgecolor="none")
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
    handles = kind_handles("0.3")
    low, high = np.inf, -np.inf
    for folder, colour in zip(folders, palette):
        line_map = first_map(folder)
        angles = line_map.transitions()
        if angles is None:
            raise SystemExit(f"{folder}: its transitions are not those of constant elastic Coulomb friction")
        draw_transitions(axes, line_map.x, angles, colour)
        enlarged.plot(*unwrapped(line_map.x, angles[POSITIVE, STICK]), color=colour, linewidth=1.2)
        handles.append(Line2D([], [], color=colour, linewidth=2.5, label=label_of(folder)))
        low, high = min(low, line_map.x[0]), max(high, line_map.x[-1])
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
