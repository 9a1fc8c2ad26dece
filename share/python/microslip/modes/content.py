"""Modes as a file of another code has them, in its units."""

from __future__ import annotations

import dataclasses

import numpy as np

from microslip.meshes.content import require

_RIGID = 1e-3  # of the next frequency


@dataclasses.dataclass
class Modes:
    coordinates: np.ndarray   # n × 3
    frequency_hz: np.ndarray  # one per mode, ascending; then those of the attachment shapes
    shapes: np.ndarray        # modes × n × 3; the last n_attachment are attachment shapes
    n_attachment: int = 0


def check(modes: Modes, source: str) -> None:
    """What no reader needs to check for itself. Rigid-body modes, whose frequencies come out small, get 0."""
    _settle_rigid_modes(modes.frequency_hz[:len(modes.frequency_hz) - modes.n_attachment])
    require(len(modes.frequency_hz) > modes.n_attachment, f"{source}: there are no modes in it")
    require(len(modes.coordinates), f"{source}: there are no nodes in it")
    require(np.isfinite(modes.coordinates).all(), f"{source}: a coordinate is not a finite number")
    for number, (frequency, shape) in enumerate(zip(modes.frequency_hz, modes.shapes), 1):
        require(np.isfinite(frequency) and frequency >= 0.0,
                f"{source}: mode {number}: its frequency is {frequency:g} Hz; expected 0 or more")
        require(np.isfinite(shape).all(), f"{source}: mode {number}: a displacement is not a finite number")
        require(np.any(shape), f"{source}: mode {number}: all displacements are 0")
    free = modes.frequency_hz[:len(modes.frequency_hz) - modes.n_attachment]
    for number in np.flatnonzero(np.diff(free) < 0.0)[:1] + 1:
        require(False, f"{source}: mode {number + 1} has {free[number]:g} Hz after {free[number - 1]:g} Hz of mode {number}; "
                       "expected ascending frequencies")
    require((modes.frequency_hz[len(free):] > 0.0).all(), f"{source}: an attachment shape has no frequency above 0")


def _settle_rigid_modes(frequencies: np.ndarray) -> None:
    """As the program counts its own."""
    for mode in range(len(frequencies) - 1, 0, -1):
        if abs(frequencies[mode - 1]) < _RIGID * frequencies[mode]:
            frequencies[:mode] = 0.0
            return
