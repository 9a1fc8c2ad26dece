"""Exodus II files of Cubit, Sierra, MOOSE (.e, .exo, .ex2): element blocks, node sets, side sets and their names.

meshio 5.0 is not used here: it takes hex20 nodes in VTK's order, knows no TET10, and gives no side sets.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .content import TYPES, Block, Content, Refused, require
from .decks import text_of
from .netcdf_length import require_whole

if TYPE_CHECKING:
    import netCDF4

_FAMILIES = {"TET": {4: "tetra", 10: "tetra10"}, "HEX": {8: "hexahedron", 20: "hexahedron20"},
             "WED": {6: "wedge", 15: "wedge15"}, "PYR": {5: "pyramid", 13: "pyramid13"},
             "TRI": {3: "triangle", 6: "triangle6"}, "QUA": {4: "quad", 8: "quad8"},
             "SHE": {3: "triangle", 6: "triangle6", 4: "quad", 8: "quad8"},
             "BAR": {2: "line", 3: "line3"}, "BEA": {2: "line", 3: "line3"}, "TRU": {2: "line", 3: "line3"},
             "EDG": {2: "line", 3: "line3"}, "SPH": {1: "vertex"}, "NOD": {1: "vertex"}}
# Upright edges come before those of the upper ring.
_ORDER = {"hexahedron20": (*range(12), 16, 17, 18, 19, 12, 13, 14, 15), "wedge15": (*range(9), 12, 13, 14, 9, 10, 11)}
# Our face for each side, in the order of the Exodus manual, table "side ordering".
_SIDES = {"tetra": (1, 2, 3, 0), "hexahedron": (2, 3, 4, 5, 0, 1), "wedge": (2, 3, 4, 0, 1), "pyramid": (1, 2, 3, 4, 0)}


def read(path: str) -> Content:
    """A Content. Raises Refused with the block or set."""
    import netCDF4
    require_whole(path)
    try:
        file = netCDF4.Dataset(path)
    except OSError as error:
        raise Refused(f"{path}: no Exodus file: {error.strerror or error}. It may be cut off or damaged: write it once more") from None
    with file:
        file.set_auto_mask(False)
        return _content(path, file)


def _content(path: str, file: netCDF4.Dataset) -> Content:
    require("num_nodes" in file.dimensions, f"{path}: no num_nodes in it: is it an Exodus file?")
    n_nodes = len(file.dimensions["num_nodes"])
    content = Content(np.arange(1, n_nodes + 1), _coordinates(path, file), [])
    first = 1
    for i, name in enumerate(_names(file, "eb_names", "num_el_blk", "block"), 1):
        if f"connect{i}" not in file.variables:
            continue  # an empty block
        block = _block(path, name, file.variables[f"connect{i}"], first)
        content.blocks.append(block)
        content.element_sets[name] = block.numbers
        first += len(block.numbers)
    for i, name in enumerate(_names(file, "ns_names", "num_node_sets", "node set"), 1):
        if f"node_ns{i}" in file.variables:
            _name(content.node_sets, path, "node set", name, file.variables[f"node_ns{i}"][:].astype(np.int64))
    for i, name in enumerate(_names(file, "ss_names", "num_side_sets", "side set"), 1):
        if f"elem_ss{i}" in file.variables:
            sides = np.column_stack([file.variables[f"{part}_ss{i}"][:] for part in ("elem", "side")]).astype(np.int64)
            _name(content.surfaces, path, "side set", name, _faces(path, name, content, sides))
    return content


def _name(sets: dict[str, np.ndarray], path: str, kind: str, name: str, members: np.ndarray) -> None:
    require(name not in sets, f'{path}: two {kind}s are named "{name}"; rename one')
    sets[name] = members


def _coordinates(path: str, file: netCDF4.Dataset) -> np.ndarray:
    if "coord" in file.variables:
        return np.asarray(file.variables["coord"][:], dtype=float).T
    require("coordz" in file.variables, f"{path}: no coordz in it: the mesh is not three-dimensional")
    return np.column_stack([file.variables[f"coord{axis}"][:] for axis in "xyz"]).astype(float)


def _names(file: netCDF4.Dataset, variable: str, dimension: str, kind: str) -> list[str]:
    """Of all blocks or sets; "block 3" for number 3 where there are none."""
    if dimension not in file.dimensions:
        return []
    n = len(file.dimensions[dimension])
    numbers = {"block": "eb_prop1", "node set": "ns_prop1", "side set": "ss_prop1"}[kind]
    numbers = file.variables[numbers][:] if numbers in file.variables else range(1, n + 1)
    given = [text_of(b"".join(row).split(b"\0")[0]).strip() for row in file.variables[variable][:]] \
        if variable in file.variables else [""] * n
    return [name or f"{kind} {number}" for name, number in zip(given, numbers)]


def _block(path: str, name: str, connect: netCDF4.Variable, first: int) -> Block:
    kind = getattr(connect, "elem_type", "").upper()
    nodes = np.asarray(connect[:], dtype=np.int64)
    own = _FAMILIES.get(kind[:3], {}).get(nodes.shape[1])
    require(own, f'{path}: block "{name}": elements {kind or "without a type"} of {nodes.shape[1]} nodes are not read; bodies may be TETRA, '
                 "TETRA10, HEX, HEX20, WEDGE, WEDGE15, PYRAMID, PYRAMID13")
    nodes = nodes[:, _ORDER[own]] if own in _ORDER else nodes
    return Block(own, np.arange(first, first + len(nodes)), nodes)


def _faces(path: str, name: str, content: Content, sides: np.ndarray) -> np.ndarray:
    faces = np.full(len(sides), -1)
    for block in content.blocks:
        own = np.isin(sides[:, 0], block.numbers)
        table = np.array(_SIDES.get(block.type.rstrip("0123456789"), (0, 0)))
        require((sides[own, 1] >= 1).all() and (sides[own, 1] <= len(table)).all(),
                f'{path}: side set "{name}": an element has no side of that number')
        faces[own] = table[sides[own, 1] - 1] if TYPES[block.type].dimension > 1 else -1
    require((faces >= 0).all(), f'{path}: side set "{name}" speaks of elements that are not there: is the file cut off?')
    return np.column_stack([sides[:, 0], faces])
