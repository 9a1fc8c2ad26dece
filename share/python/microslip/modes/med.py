"""Modes in a MED file (.med) of Code_Aster or Salome: a field of displacements at nodes, one step for each mode, whose
value (MED's PDT) is the frequency in Hz. That is what IMPR_RESU(FORMAT="MED") writes of a MODE_MECA and its DEPL.

A MED file is HDF5: /ENS_MAA/mesh/step/NOE/COO, coordinates; /CHA/field with NOM, the names of its components in 16 letters
each, and in it a group for each step with PDT, and NOE/profile/CO, values, component after component; profile
MED_NO_PROFILE_INTERNAL: at all nodes. After: the MED file of SALOME 9, "Le modèle de données MED".
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from microslip.meshes.content import Refused, require

from .content import Modes

if TYPE_CHECKING:
    import h5py

_COMPONENTS = ["DX", "DY", "DZ"]
_ALL_NODES = "MED_NO_PROFILE_INTERNAL"


def read(path: str) -> Modes:
    import h5py
    require(h5py.is_hdf5(path), f"{path}: no MED file: it is not HDF5")
    try:
        with h5py.File(path, "r") as file:
            return _modes(path, file)
    except (KeyError, OSError, ValueError) as error:
        raise Refused(f"{path}: no MED file of modes: {' '.join(str(error).split())}") from None


def _modes(path: str, file: h5py.File) -> Modes:
    coordinates = _coordinates(path, file)
    name, field = _displacements(path, file)
    steps = sorted(field.values(), key=lambda step: (int(step.attrs["NDT"]), int(step.attrs["NOR"])))
    shapes = [_shape(path, name, number, step, len(coordinates)) for number, step in enumerate(steps, 1)]
    return Modes(coordinates, np.array([float(step.attrs["PDT"]) for step in steps]), np.array(shapes))


def _coordinates(path: str, file: h5py.File) -> np.ndarray:
    meshes = file["ENS_MAA"]
    require(len(meshes) == 1, f"{path}: expected one mesh, there are {len(meshes)}: {', '.join(meshes)}")
    mesh = next(iter(meshes.values()))
    require(int(mesh.attrs["ESP"]) == 3, f"{path}: the mesh is not three-dimensional")
    if "NOE" not in mesh:  # one step, as of meshes that do not change
        mesh = next(iter(mesh.values()))
    return mesh["NOE"]["COO"][()].reshape(3, -1).T.astype(float)


def _displacements(path: str, file: h5py.File) -> tuple[str, h5py.Group]:
    """The one field at nodes with components DX, DY, DZ first."""
    fields = {name: field for name, field in file.get("CHA", {}).items() if _names(field)[:3] == _COMPONENTS}
    require(fields, f"{path}: there are no modes in it: no field has the components DX, DY, DZ; fields are: "
                    f"{', '.join(file.get('CHA', {})) or 'none'}")
    require(len(fields) == 1, f"{path}: which are the modes? {', '.join(fields)} have components DX, DY, DZ; write a file with "
                              "one of them")
    return next(iter(fields.items()))


def _names(field: h5py.Group) -> list[str]:
    text = field.attrs["NOM"]
    text = text.decode("latin-1") if isinstance(text, bytes) else str(text)
    return [text[i:i + 16].strip(" \0") for i in range(0, len(text), 16)]


def _shape(path: str, name: str, number: int, step: h5py.Group, n_nodes: int) -> np.ndarray:
    where = f"{path}: mode {number} of {name}"
    require("NOE" in step, f"{where} has no displacements at nodes")
    profiles = list(step["NOE"])
    require(profiles == [_ALL_NODES], f"{where} has displacements at a part of the nodes ({', '.join(profiles)}); write all: "
                                      "IMPR_RESU without GROUP_NO and GROUP_MA")
    values = step["NOE"][_ALL_NODES]["CO"][()]
    require(len(values) and len(values) % n_nodes == 0,
            f"{where} has {len(values)} values at {n_nodes} nodes: is the file cut off?")
    return values.reshape(-1, n_nodes)[:3].T.astype(float)
