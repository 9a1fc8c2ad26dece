"""The contact map of points on a line: where each stands, and when its states begin."""

from __future__ import annotations

import os
from typing import List, Optional, Tuple

import numpy as np

from microslip.files import data_file, require_shape

Cycle = List[Tuple[int, float]]  # states in order of time, each with the angle at which it begins [deg]
STICK, POSITIVE, NEGATIVE, OPEN, SLIP = range(5)


def line_positions(folder: str) -> Optional[np.ndarray]:
    """Coordinate p or r [m] of contact points on a line; None where they lie otherwise, or nowhere."""
    with data_file(os.path.join(folder, "model.h5")) as file:
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

    def __init__(self, folder: str, name: str, position: np.ndarray) -> None:
        self.order = np.argsort(position)
        self.x = position[self.order]
        path = os.path.join(folder, "maps", name + ".h5")
        with data_file(path) as file:
            read = lambda key: file[key][:][self.order]
            require_shape(path, "weights", file["weights"][:], self.x.shape)
            self.frequency = file["frequency_Hz"][0]
            self.phase = file["phase_deg"][:]
            self.state = read("state")
            self.energy = read("dissipated_energy_J_per_m2")
            require_shape(path, "state", self.state, (len(self.x), len(self.phase)))
            self.guard = read("slip_guard_Pa") if "slip_guard_Pa" in file else None
            starts = read("state_starts_deg") if "state_starts_deg" in file else None
        self.cycles = None if starts is None else [cycle_of(row.reshape(5, -1)) for row in starts]

    def transitions(self, start: int, end: int) -> np.ndarray:
        """Angles [deg] of one change of state, one per point, NaN where it has none; of several the first."""
        angles = np.full(len(self.x), np.nan)
        for point, cycle in enumerate(self.cycles):
            states = [state for state, _ in cycle]
            for i, (state, angle) in enumerate(cycle):
                if (states[i - 1], state) == (start, end) and not angles[point] <= angle:
                    angles[point] = angle
        return angles

    def apex(self, slips: int, sticks: int) -> float:
        """Where between two neighbours slip dies out: the zero of its guard, else the middle."""
        if self.guard is not None and self.guard[slips] > 0 > self.guard[sticks]:
            share = self.guard[slips] / (self.guard[slips] - self.guard[sticks])
        else:
            share = 0.5
        return self.x[slips] + share * (self.x[sticks] - self.x[slips])


def cycle_of(starts: np.ndarray) -> Cycle:
    """[(state, angle at which it begins [deg]), …] in order of time; empty: one state all the time."""
    return sorted(((state, angle) for state, row in enumerate(starts) for angle in row if angle >= 0),
                  key=lambda change: change[1])


def cell_edges(x: np.ndarray) -> np.ndarray:
    """Borders between points, and as far outside of the first and the last."""
    middle = 0.5 * (x[1:] + x[:-1])
    return np.concatenate([[2 * x[0] - middle[0]], middle, [2 * x[-1] - middle[-1]]])
