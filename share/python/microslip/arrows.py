"""Arrows of slip in two directions: where the slider of a point moves at an instant, and how fast."""

from __future__ import annotations

from typing import Sequence

import numpy as np

BOTH_DIRECTIONS = 4  # the state, as files count them
MOST_ARROWS = 150  # more would hide the map


def slip_rates(slider: np.ndarray) -> np.ndarray:
    """Of positions of the slider (n × m, over a period that repeats), per step of the phase."""
    return 0.5 * (np.roll(slider, -1, axis=1) - np.roll(slider, 1, axis=1))


def arrows_at(points: np.ndarray, slider: Sequence[np.ndarray], state: np.ndarray, phase: int) -> np.ndarray:
    """Begin and components of arrows at one phase (its number), k × 4, in the unit of the points (n × 2).

    slider: its positions along both axes (n × m each); state (n × m). The fastest slip of the period has an arrow as long as points
    with arrows are apart."""
    rates = np.stack([slip_rates(part) for part in slider], axis=2)
    slips = state == BOTH_DIRECTIONS
    fastest = np.linalg.norm(rates, axis=2)[slips].max(initial=0.0)
    if not fastest > 0:
        return np.zeros((0, 4))
    every = -(-len(points) // MOST_ARROWS)
    chosen = np.flatnonzero(slips[:, phase])
    chosen = chosen[chosen % every == 0]
    apart = 1.3 * np.sqrt(np.prod(np.ptp(points, axis=0)) * every / len(points))
    return np.column_stack([points[chosen], apart / fastest * rates[chosen, phase]])
