"""A response curve between its points: cubics that leave every point along the tangent the solver has found there.

Two tangents that meet make an arc, the parabola that touches both: it stays between them and the chord, and errs by the
fourth power of its length. Elsewhere the branch has an inflection, and each end a handle that stays in the box of the
two points: there the third power. Nothing is drawn beyond what the points say: every peak and fold is a point of its own.
"""
from __future__ import annotations

from typing import Any, Mapping

import numpy as np

# (column, its slope, whether it is drawn over a logarithmic axis)
AMPLITUDE = ("amplitude_m", "amplitude_slope_m_per_Hz", True)
PHASE = ("phase_deg", "phase_slope_deg_per_Hz", False)
TURN = 180.0  # [deg]: a phase that changes by more has come round


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def drawn_values(table: Mapping[str, Any], quantity: tuple[str, str, bool]) -> tuple[np.ndarray, np.ndarray]:
    """Heights and slopes as the axis shows them: of logarithms where it has them. NaN: unknown, or not to be shown."""
    column, slope, log = quantity
    values = np.asarray(table[column], dtype=float)
    slopes = np.asarray(table[slope], dtype=float) if slope in table else np.full(values.shape, np.nan)
    if not log:
        return values, slopes
    positive = np.where(values > 0, values, np.nan)
    return np.log(positive), slopes / positive


def directions(way: np.ndarray, slopes: np.ndarray, is_fold: np.ndarray) -> np.ndarray:
    """Of the branch at one end of each interval, as it is walked; NaN where it is not known."""
    along = np.sign(way[:, 0])[:, None] * np.column_stack([np.ones(len(way)), slopes])
    upright = np.column_stack([np.zeros(len(way)), np.sign(way[:, 1])])
    return np.where(is_fold[:, None], upright, along)


def handles(way: np.ndarray, tangent: np.ndarray) -> np.ndarray:
    """From an end of an interval with an inflection: a third of the way, and no higher than the other end."""
    size = np.abs(tangent)
    inside = np.where(np.sign(tangent[:, 1]) == np.sign(way[:, 1]), 1.0, 1.0 / 3.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        reach = np.fmin(np.abs(way[:, 0]) / 3.0 / size[:, 0], inside * np.abs(way[:, 1]) / size[:, 1])
        handle = reach[:, None] * tangent
    return np.where(np.isfinite(handle).all(axis=1)[:, None], handle, way / 3.0)


def control_points(way: np.ndarray, first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """Both inner control points of each cubic, from its first point."""
    with np.errstate(divide="ignore", invalid="ignore"):
        meeting = (cross(way, last) / cross(first, last))[:, None] * first
        forward = meeting[:, 0] * np.sign(way[:, 0])
        ahead = np.einsum("ij,ij->i", meeting, first) > 0
        behind = np.einsum("ij,ij->i", way - meeting, last) > 0
    is_arc = ahead & behind & (forward >= 0) & (forward <= np.abs(way[:, 0]))
    arc = np.stack([2.0 / 3.0 * meeting, way + 2.0 / 3.0 * (meeting - way)], axis=1)
    bent = np.stack([handles(way, first), way - handles(way, last)], axis=1)
    return np.where(is_arc[:, None, None], arc, bent)


def hidden_peaks(way: np.ndarray, first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """Intervals that rise at their begin and fall at their end: no point tells how high they go."""
    return (first[:, 1] > 0) & (last[:, 1] < 0)


def jumps(curve: Mapping[str, Any], table: Mapping[str, Any]) -> np.ndarray:
    """Intervals without a branch: where the walk went on along another one, and about a resonance without bound."""
    frequency, heights = np.asarray(table["frequency_Hz"]), drawn_values(table, AMPLITUDE)[0]
    steps = np.abs(np.diff(heights))
    apart = np.zeros(len(steps), dtype=bool)
    for remedy in curve.get("remedies") or []:
        if remedy["remedy"] != "other-branch" or not len(steps):
            continue
        row = int(np.argmin(np.abs(frequency - remedy["frequency_Hz"])))
        beside = [i for i in (row - 1, row) if 0 <= i < len(steps)]
        apart[max(beside, key=lambda i: steps[i])] = True
    if curve.get("diagnosis") == "unbounded":
        apart |= hidden_peaks(*ends(table, AMPLITUDE)[1:])
    return apart


def ends(table: Mapping[str, Any], quantity: tuple[str, str, bool]) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Points as the axes show them, and of each interval between them the way and the tangents at both ends."""
    heights, slopes = drawn_values(table, quantity)
    is_fold = np.array([mark == "fold" for mark in table["mark"]], dtype=bool)
    points = np.column_stack([np.asarray(table["frequency_Hz"], dtype=float), heights])
    way = np.diff(points, axis=0)
    return points, way, directions(way, slopes[:-1], is_fold[:-1]), directions(way, slopes[1:], is_fold[1:])


def cubics(curve: Mapping[str, Any], table: Mapping[str, Any], quantity: tuple[str, str, bool]) -> np.ndarray:
    """Four control points of every interval (n − 1 × 4 × 2): frequency [Hz] and value, on a line where no tangents
    are known, NaN where there is a gap. `curve` is the entry of summary.json, `table` its file."""
    points, way, first, last = ends(table, quantity)
    line = np.stack([way / 3.0, way * 2.0 / 3.0], axis=1)
    inner = control_points(way, first, last)
    straight = ~np.isfinite(inner).all(axis=(1, 2)) | (way[:, 0] == 0)
    gap = jumps(curve, table)
    if quantity is AMPLITUDE:
        straight |= hidden_peaks(way, first, last)
    else:
        gap |= np.abs(way[:, 1]) > TURN
    inner = points[:-1, None, :] + np.where(straight[:, None, None], line, inner)
    inner[gap] = np.nan
    all_four = np.concatenate([points[:-1, None, :], inner, points[1:, None, :]], axis=1)
    if quantity[2]:
        all_four[..., 1] = np.exp(all_four[..., 1])
    return all_four


def polyline(pieces: np.ndarray, log: bool, n: int = 12) -> np.ndarray:
    """Points close together along cubics one after the other, m × 2; NaN in a gap. n: steps of each."""
    places = pieces.copy()
    if log:
        places[..., 1] = np.log(places[..., 1])
    u = np.linspace(0.0, 1.0, n + 1)[:, None]
    weights = np.hstack([(1 - u) ** 3, 3 * u * (1 - u) ** 2, 3 * u**2 * (1 - u), u**3])
    line = np.einsum("uk,ikc->iuc", weights, places).reshape(-1, 2)
    if log:
        line[:, 1] = np.exp(line[:, 1])
    return line
