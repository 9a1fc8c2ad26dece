"""States of a line of contact points over position and phase: areas of one state, and the lines between them.

Field and lines are the instants at which each state begins, as the run wrote them: both show the same boundaries,
which are not bound to the phases of the map. Between two points that go through the same states boundaries are
straight; where slip ends along the line it closes at the zero of its guard.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Iterator, Optional, Sequence

import numpy as np
from matplotlib.collections import PolyCollection

from microslip.plots.line_map import OPEN, STICK, Cycle, LineMap, cell_edges
from microslip.plots.style import STATE_COLOURS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

DASHES, DOTS = (0, (3, 1.5)), (0, (1, 1.2))
KINDS = [("stick to slip", "-"), ("slip to stick", DASHES), ("contact opens or closes", DOTS)]


def kind_of(start: int, end: int) -> int:
    """Which of KINDS a change of state is."""
    if OPEN in (start, end):
        return 2
    return 1 if end == STICK else 0


def near(angle: float, other: float) -> float:
    """An angle, turned by whole periods to lie within half of one from another."""
    return angle + 360.0 * np.round((other - angle) / 360.0)


def aligned(cycle: Cycle, other: Cycle) -> Optional[Cycle]:
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


def spans(cycle: Cycle) -> Iterator[tuple[int, float, float]]:
    """(state, begin, end) of each part of a cycle, end after begin."""
    n = len(cycle)
    for i, (state, begin) in enumerate(cycle):
        end = cycle[(i + 1) % n][1]
        yield state, begin, end if n > 1 and end > begin else end + 360.0


class Field:
    """Areas of one state over (x, θ), and the lines between them."""

    def __init__(self, line_map: LineMap) -> None:
        self.polygons, self.colours = [], []
        self.lines = []  # (kind, [x], [angle])
        self.map = line_map
        self.edges = cell_edges(line_map.x)
        self.add_end(0, self.edges[0])
        for point in range(len(line_map.x) - 1):
            self.add_pair(point, point + 1)
        self.add_end(len(line_map.x) - 1, self.edges[-1])

    def area(self, state: int, corners: Sequence[tuple[float, float]]) -> None:
        for shift in (-360.0, 0.0, 360.0):
            self.polygons.append([(x, angle + shift) for x, angle in corners])
            self.colours.append(STATE_COLOURS[int(state)])

    def line(self, kind: int, x: Sequence[float], angle: Sequence[float]) -> None:
        """A piece of a line: joined to one that ends where it begins."""
        for other, xs, angles in self.lines:
            if other == kind and xs[-1] == x[0] and abs(near(angle[0], angles[-1]) - angles[-1]) < 1e-9:
                xs.append(x[1])
                angles.append(near(angle[1], angles[-1]))
                return
        self.lines.append((kind, list(x), list(angle)))

    def whole(self, point: int, x0: float, x1: float) -> None:
        """One state all the time."""
        self.area(self.map.state[point, 0], [(x0, 0), (x1, 0), (x1, 360), (x0, 360)])

    def strip(self, first: Cycle, second: Cycle, x0: float, x1: float) -> None:
        """Between two positions whose cycles match."""
        for i, ((state, a0, a1), (_, b0, b1)) in enumerate(zip(spans(first), spans(second))):
            self.area(state, [(x0, a0), (x1, b0), (x1, near(b1, a1)), (x0, a1)])
            self.line(kind_of(first[i - 1][0], state), (x0, x1), (a0, b0))

    def add_end(self, point: int, edge: float) -> None:
        """The outer half of the first and the last cell, as the point in it."""
        cycle, x0, x1 = self.map.cycles[point], *sorted((self.map.x[point], edge))
        if cycle:
            self.strip(cycle, cycle, x0, x1)
        else:
            self.whole(point, x0, x1)

    def add_pair(self, left: int, right: int) -> None:
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

    def close(self, slips: int, sticks: int) -> None:
        """Between a point that slips at times and one that never does: each slip shrinks towards its end."""
        cycle, x, x_end = self.map.cycles[slips], self.map.x[slips], self.map.apex(slips, sticks)
        self.whole(sticks, *sorted((x, self.map.x[sticks])))
        for i, (state, begin, end) in enumerate(spans(cycle)):
            if state != STICK:
                self.area(state, [(x, begin), (x, end), (x_end, near(self.tip_of(cycle, i), end))])
        for i, (state, begin) in enumerate(cycle):
            self.line_to_tip(kind_of(cycle[i - 1][0], state), (x, begin), (x_end, self.tip_of(cycle, i)))

    @staticmethod
    def tip_of(cycle: Cycle, i: int) -> float:
        """The angle at which the slip that a change belongs to dies out: where stick comes next."""
        if cycle[i][0] == STICK:
            return cycle[i][1]
        for ahead in range(1, len(cycle)):
            state, angle = cycle[(i + ahead) % len(cycle)]
            if state == STICK:
                return angle if angle > cycle[i][1] else angle + 360.0
        return cycle[i][1]

    def line_to_tip(self, kind: int, at: tuple[float, float], tip: tuple[float, float]) -> None:
        pieces = sorted((at, tip))
        self.line(kind, *zip(*pieces))

    def draw(self, axes: Axes) -> None:
        axes.add_collection(PolyCollection(self.polygons, facecolors=self.colours, linewidth=0, antialiased=False,
                                           rasterized=True))
