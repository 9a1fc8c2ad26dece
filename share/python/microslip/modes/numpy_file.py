"""Modes in a .npz file of NumPy: arrays `nodes` (n × 3), `frequency_Hz` (m), `shapes` (m × n × 3); for static shapes that
stand for omitted modes, `attachment_frequency_Hz` (k) and `attachment_shapes` (k × n × 3), M-orthonormal with the modes."""

from __future__ import annotations

import zipfile
import zlib
from typing import Mapping, Optional

import numpy as np

from microslip.meshes.content import Refused, require

from .content import Modes


def read(path: str) -> Modes:
    try:
        arrays = np.load(path, allow_pickle=False)
        require(isinstance(arrays, np.lib.npyio.NpzFile), f"{path}: one array without a name, as numpy.save writes; write all of them "
                                                          "with their names: numpy.savez(file, nodes=…, frequency_Hz=…, shapes=…)")
        with arrays:
            given = {name: arrays[name] for name in arrays.files}
    except (ValueError, OSError, EOFError, zipfile.BadZipFile, zlib.error) as error:
        raise Refused(f"{path}: it is no .npz file of numbers, or it is cut off: {error}; write it once more") from None
    nodes = _array(path, given, "nodes", (None, 3))
    frequency, shapes = _shapes(path, given, "", len(nodes))
    n_attachment = 0
    if "attachment_shapes" in given:
        more, attachment = _shapes(path, given, "attachment_", len(nodes))
        n_attachment = len(more)
        frequency, shapes = np.concatenate([frequency, more]), np.concatenate([shapes, attachment])
    return Modes(nodes, frequency, shapes, n_attachment)


def _shapes(path: str, given: Mapping[str, np.ndarray], kind: str, n_nodes: int) -> tuple[np.ndarray, np.ndarray]:
    frequency = _array(path, given, kind + "frequency_Hz", (None,))
    return frequency, _array(path, given, kind + "shapes", (len(frequency), n_nodes, 3))


def _array(path: str, given: Mapping[str, np.ndarray], name: str, size: tuple[Optional[int], ...]) -> np.ndarray:
    require(name in given, f'{path}: array "{name}" is missing; there are: {", ".join(given) or "none"}')
    array = given[name]
    wanted = " x ".join("n" if n is None else str(n) for n in size)
    fits = array.ndim == len(size) and all(n in (None, m) for n, m in zip(size, array.shape))
    require(fits, f'{path}: array "{name}" is {" x ".join(map(str, array.shape)) or "one number"}; expected {wanted}')
    require(array.dtype.kind in "fiu", f'{path}: array "{name}" holds {array.dtype}; expected real numbers')
    return array.astype(float)
