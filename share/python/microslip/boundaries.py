"""Boundaries of the states on a patch: zero lines of functions known at the corners of its cells.

States are known cell by cell; their boundaries are smoother than cells, and follow from when each corner changes its state."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Optional, Sequence, Tuple

import numpy as np

Polygon = Sequence[Sequence[float]]  # rows of shares of the corners of a triangle
Function = Tuple[Sequence[float], Optional[int]]  # at the corners, and the state that begins where it passes zero
SLIPPING, SEPARATED = (1, 2, 4), 3
# Of the period, at the vertices; their zero lines bound the points that slip, that open, that touch at some time.
GUARDS = ("slip_guard", "smallest_load", "largest_load")


@dataclass
class Vertices:
    """What is known at the corners of the cells of a patch.

    corners (n × 2), triangles (t × 3, numbers of corners), phase (m, deg), state (n × m); starts: per state the angles at which
    it begins (n × k, deg, NaN beyond the last); guards: of the period (n, Pa), by name."""

    corners: np.ndarray
    triangles: np.ndarray
    phase: np.ndarray
    state: np.ndarray
    starts: list
    guards: dict = field(default_factory=dict)


def starts_of_states(stored: np.ndarray) -> list[np.ndarray]:
    """`vertex_state_starts_deg` of a map by state; files have -1 where there is none."""
    return np.split(np.where(stored < 0, np.nan, stored), 5, axis=1)


def triangles_of(cells: np.ndarray) -> np.ndarray:
    """Corner numbers of triangles; quadrilaterals are cut in two."""
    if cells.shape[1] == 3:
        return cells
    return np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])


def zero_line(corners: np.ndarray, triangles: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Where values at the corners vanish, linear in each triangle: ends of segments, k × 2 × 2. A zero counts as above, so that
    two of the three edges of a triangle are crossed, or none."""
    at = values[triangles]
    above = at >= 0
    crossed = above != np.roll(above, -1, axis=1)  # edge from corner i to corner i + 1
    here = crossed.any(axis=1) & np.isfinite(at).all(axis=1)
    at, crossed, nodes = at[here], crossed[here], corners[triangles[here]]
    if not len(at):
        return np.zeros((0, 2, 2))
    following = np.roll(at, -1, axis=1)
    share = np.divide(at, at - following, out=np.zeros_like(at), where=crossed)[:, :, None]
    points = (1 - share) * nodes + share * np.roll(nodes, -1, axis=1)
    return points[crossed].reshape(-1, 2, 2)


def nearest_to_zero(values: np.ndarray) -> np.ndarray:
    """Of each row, without the entries that are NaN; NaN where all are."""
    size = np.where(np.isnan(values), np.inf, np.abs(values))
    return np.take_along_axis(values, size.argmin(axis=1)[:, None], axis=1)[:, 0]


def cuts(vertices: Vertices, phase: int) -> list[tuple[np.ndarray, np.ndarray, Optional[int]]]:
    """What parts the states at one phase (its number): triangles (a mask), a function at the corners of the cells whose zero line
    parts them there, and the state that begins where it passes zero downwards (None: a guard). That is θ_k − θ, where a state
    begins, in triangles where it begins at every corner (and its angle does not leap around the period); and the guards of the period in
    triangles where one corner slips, opens or touches now and another never does."""
    found, state = [], vertices.state[:, phase]
    for number, starts in enumerate(vertices.starts):
        ahead = nearest_to_zero((starts - vertices.phase[phase] + 180.0) % 360.0 - 180.0)
        at_corners = ahead[vertices.triangles]
        is_here = (state == number)[vertices.triangles]  # else the line parts two starts of the same state
        smooth = (np.isfinite(at_corners).all(axis=1) & (np.ptp(np.nan_to_num(at_corners), axis=1) < 90)
                  & is_here.any(axis=1) & ~is_here.all(axis=1))
        found.append((smooth, ahead, number))
    for name, values in vertices.guards.items():
        never, now = sides(vertices, name, state)
        mixed = never[vertices.triangles].any(axis=1) & now[vertices.triangles].any(axis=1)
        found.append((mixed, values, None))
    return found


def instant_boundaries(vertices: Vertices, phase: int) -> np.ndarray:
    """Boundaries of the states at one phase (its number), as zero_line() gives them."""
    lines = [zero_line(vertices.corners, vertices.triangles[here], values) for here, values, _ in cuts(vertices, phase)]
    return np.concatenate(lines) if lines else np.zeros((0, 2, 2))


def halves(polygon: Polygon, values: Sequence[float]) -> list[Polygon]:
    """A convex polygon (rows of shares of the corners of its triangle) parted by the zero line of a function that has these values at
    the corners: what is above, and what is below; a zero counts as above."""
    at = [sum(share * value for share, value in zip(row, values)) for row in polygon]
    above, below = [], []
    for i, row in enumerate(polygon):
        following = (i + 1) % len(polygon)
        (above if at[i] >= 0 else below).append(row)
        if (at[i] >= 0) != (at[following] >= 0):
            share = at[i] / (at[i] - at[following])
            crossing = [(1 - share) * x + share * y for x, y in zip(row, polygon[following])]
            above.append(crossing)
            below.append(crossing)
    return [part for part in (above, below) if len(part) > 2]


WHOLE = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]


def state_in(piece: Polygon, states: Sequence[int], functions: Sequence[Function]) -> Optional[int]:
    """Of a piece of a triangle: that of its corner; without one the state that has begun last. None: its corners disagree, or
    nothing tells."""
    own = {states[row.index(1.0)] for row in piece if 1.0 in row}
    if own:
        return own.pop() if len(own) == 1 else None
    centre = np.mean(piece, axis=0)
    begun = [(centre @ values, number) for values, number in functions if number is not None and centre @ values <= 0]
    return max(begun)[1] if begun else None


def pieces_in(corners: np.ndarray, states: Sequence[int], functions: Sequence[Function],
              cell_state: int) -> list[tuple[np.ndarray, int]]:
    """Polygons (k × 2) into which functions part a triangle, with their states; where nothing tells, that of the cell."""
    if not functions:
        return [(corners, cell_state)]
    pieces = [WHOLE]
    for values, _ in functions:
        pieces = [half for piece in pieces for half in halves(piece, values)]
    found = [state_in(piece, states, functions) for piece in pieces]
    return [(np.array(piece) @ corners, cell_state if own is None else int(own)) for piece, own in zip(pieces, found)]


def parted_cells(vertices: Vertices, phase: int,
                 cell_states: np.ndarray) -> tuple[list[int], list[np.ndarray], list[int]]:
    """Cells that boundaries of the states cross at one phase (its number): their numbers; the polygons (k × 2) into which they are
    parted, and the state of each."""
    states, n_cells, functions = vertices.state[:, phase], len(cell_states), {}
    for here, values, number in cuts(vertices, phase):
        at = values[vertices.triangles]
        for triangle in np.flatnonzero(here & (at >= 0).any(axis=1) & (at < 0).any(axis=1)):
            functions.setdefault(triangle, []).append((at[triangle].tolist(), number))
    parted = sorted({int(triangle) % n_cells for triangle in functions})
    found = []
    for triangle in np.flatnonzero(np.isin(np.arange(len(vertices.triangles)) % n_cells, parted)):
        corners = vertices.triangles[triangle]
        found += pieces_in(vertices.corners[corners], states[corners].tolist(), functions.get(triangle, []),
                           int(cell_states[triangle % n_cells]))
    return parted, [polygon for polygon, _ in found], [own for _, own in found]


def sides(vertices: Vertices, guard: str, state: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices that never do what a guard is about, and those that do it now."""
    starts = [np.isfinite(of_state).any(axis=1) for of_state in vertices.starts]
    slips, opens = np.isin(state, SLIPPING), state == SEPARATED
    if guard == "slip_guard":
        return ~(slips | opens | starts[1] | starts[2] | starts[4]), slips
    if guard == "smallest_load":
        return ~(opens | starts[3]), opens & starts[3]
    return opens & ~starts[3], ~opens


def period_boundaries(vertices: Vertices) -> dict[str, np.ndarray]:
    """Boundaries of what occurs within the period, by the name of the guard; those that are there."""
    lines = {}
    for name, values in vertices.guards.items():
        chosen = np.ones(len(vertices.triangles), dtype=bool)
        if name == "slip_guard" and "largest_load" in vertices.guards:  # what never touches does not slip
            chosen = (vertices.guards["largest_load"] > 0)[vertices.triangles].all(axis=1)
        segments = zero_line(vertices.corners, vertices.triangles[chosen], values)
        if len(segments):
            lines[name] = segments
    return lines
