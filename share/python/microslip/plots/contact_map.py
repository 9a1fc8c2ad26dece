"""The contact map of a patch as a run wrote it."""

from __future__ import annotations

import numpy as np

from microslip.boundaries import GUARDS, Vertices, starts_of_states, triangles_of
from microslip.files import AGAIN, RunError, data_file, require_shape, shown

class ContactMap:
    """One maps/NAME.h5: n points with their states at m phases, lengths of the patch in millimetres.

    points (n × 2), state (n × m), weights [m²], energy [J/m² per period], slip [µm per period]; with cells also what is known at
    their corners (vertices). Where points slip in two directions, slider: its positions along the two axes drawn (n × m each) [m].
    """

    def __init__(self, path: str) -> None:
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
            self.slider = (file["slip_m"][:], file["slip_r_m"][:]) if "slip_r_m" in file else None
            self.vertices = None
            if len(cells) and "vertex_state_starts_deg" in file:
                guards = {name: file[f"vertex_{name}_Pa"][:] for name in GUARDS if f"vertex_{name}_Pa" in file}
                self.vertices = Vertices(vertices, triangles_of(cells), self.phase, file["vertex_state"][:],
                                         starts_of_states(file["vertex_state_starts_deg"][:]), guards)
        self.lay_flat(vertices if self.cells is not None else self.points)

    def lay_flat(self, corners: np.ndarray) -> None:
        """A long patch lies on its side."""
        self.names = "p [mm]", "r [mm]"
        if np.ptp(corners[:, 1]) > np.ptp(corners[:, 0]):
            corners, self.points = corners[:, ::-1], self.points[:, ::-1]
            self.cells = None if self.cells is None else self.cells[:, :, ::-1]
            self.slider = None if self.slider is None else self.slider[::-1]
            self.names = self.names[::-1]
        if self.vertices is not None:
            self.vertices.corners = corners
        self.low, self.high = corners.min(axis=0), corners.max(axis=0)

    def require_shapes(self, path: str, vertices: np.ndarray, cells: np.ndarray) -> None:
        n = len(self.weights)
        require_shape(path, "points", self.points, (n, 2))
        require_shape(path, "state", self.state, (n, len(self.phase)))
        require_shape(path, "dissipated_energy_J_per_m2", self.energy, (n,))
        require_shape(path, "slip_distance_m", self.slip, (n,))
        if len(cells) and not (len(cells) == n and cells.min() >= 0 and cells.max() < len(vertices)):
            raise RunError(f"{shown(path)}: \"cells\" do not fit \"vertices\": {AGAIN}")

    def phase_near(self, angle: float) -> int:
        """Number of the phase nearest to an angle [deg]."""
        return int(np.argmin(np.abs((self.phase - angle + 180) % 360 - 180)))

    def shares(self, phase: int) -> tuple[float, float, float]:
        """Part of the area in stick, slip, separation."""
        weights = self.weights / self.weights.sum()
        state = self.state[:, phase]
        return (weights[state == 0].sum(), weights[np.isin(state, (1, 2, 4))].sum(),
                weights[state == 3].sum())
