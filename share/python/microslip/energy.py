"""Energies of a period along a curve, from the modal motion of its solutions.

With q_m(θ) = Σ_h (s_mh sin hθ + c_mh cos hθ), modal forces S_m sin θ + C_m cos θ, θ = ωt:

  W_exc  = π Σ_m (C_m s_m1 − S_m c_m1)                        work of the excitation     (1)
  W_damp = 2π ω Σ_m ζ_m ω_m Σ_h h² (s_mh² + c_mh²)            modal damping              (2)
  W_fric = W_exc − W_damp                                     friction; closes to the column energy_imbalance (3)
  ζ_eq   = W_exc / (2π ω² Σ_m Σ_h h² (s_mh² + c_mh²))         loss factor / 2            (4)

(4) is W / (4π E) with E twice the mean kinetic energy: a free mode alone has ζ_eq = ζ ω_m/ω.
"""
from __future__ import annotations

import os
import re
from typing import Any, Mapping

import numpy as np

from microslip.files import AGAIN, RunError, data_file, read_table, shown


def squares_of(states: Mapping[str, Any], n_modes: int) -> np.ndarray:
    """Σ_h h² (s² + c²) of every mode: (n_rows × n_modes)."""
    squares = np.zeros((len(states["frequency_Hz"]), n_modes))
    for name, values in states.items():
        part = re.fullmatch(r"q_(?:sin|cos)(\d+)_(\d+)", name)
        if part:
            squares[:, int(part[2]) - 1] += int(part[1]) ** 2 * values ** 2
    return squares


def energies(folder: str, name: str) -> dict[str, np.ndarray]:
    """Columns dissipated_energy_J (W_fric) and equivalent_damping_ratio (ζ_eq, NaN where nothing moves) of a curve of
    the run in `folder`. RunError where model.h5 or the states of the curve are missing or damaged."""
    with data_file(os.path.join(folder, "model.h5")) as file:
        angular, damping = 2 * np.pi * file["frequency_Hz"][:], file["damping_ratio"][:]
        sine, cosine = file["force_sine"][:], file["force_cosine"][:]
    n_modes = len(angular)
    path = os.path.join(folder, "curves", name + ".states.csv")
    needed = [f"q_{part}1_{mode + 1}" for part in ("sin", "cos") for mode in range(n_modes)]
    states = read_table(path, ["frequency_Hz", *needed])
    if any(int(column.rpartition("_")[2]) > n_modes for column in states if column.startswith("q_")):
        raise RunError(f"{shown(path)}: more modes than model.h5 has: {AGAIN}")
    first = {part: np.column_stack([states[f"q_{part}1_{mode + 1}"] for mode in range(n_modes)])
             for part in ("sin", "cos")}
    omega = 2 * np.pi * states["frequency_Hz"]
    squares = squares_of(states, n_modes)
    excitation = np.pi * (first["sin"] @ cosine - first["cos"] @ sine)
    damped = 2 * np.pi * omega * (squares @ (damping * angular))
    moving = squares.sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        equivalent = np.where(moving > 0, excitation / (2 * np.pi * omega ** 2 * moving), np.nan)
    return {"dissipated_energy_J": excitation - damped, "equivalent_damping_ratio": equivalent}
