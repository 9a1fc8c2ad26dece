"""A `Content` as a file of gmsh 2.2, binary, for the program to read.

What becomes a name: surfaces and sets of shell elements become surfaces; node sets, and sets of elements along lines or
of volume elements (all their nodes), become sets of nodes. Sets of all nodes or all volume elements (Nall, Eall) name nothing.
"""

from __future__ import annotations

from typing import BinaryIO

import numpy as np

from .content import TYPES, Content, Refused, check, faces_of, turn_blocks, volumes

_POINT = TYPES["vertex"].gmsh
_FACES = {3: TYPES["triangle"].gmsh, 4: TYPES["quad"].gmsh}


class _Groups:
    """Physical groups and their elements, as records (type, nodes)."""

    def __init__(self) -> None:
        self.names = {}    # (dimension, name) → number
        self.records = []  # (gmsh type, group, nodes)

    def add(self, dimension: int, gmsh_type: int, name: str, nodes: np.ndarray) -> None:
        group = self.names.setdefault((dimension, name), len(self.names) + 1)
        if len(nodes):
            self.records.append((gmsh_type, group, nodes))

    def has(self, dimension: int, name: str) -> bool:
        return (dimension, name) in self.names


def write(content: Content, source: str, path: str) -> None:
    """Writes `path`. Raises Refused where the content does not hold together; `source` is what messages call it."""
    check(content, source)
    if content.either_hand:
        turn_blocks(content)
    groups = _groups(content, source)
    with open(path, "wb") as file:
        file.write(b"$MeshFormat\n2.2 1 8\n" + np.int32(1).tobytes() + b"\n$EndMeshFormat\n$PhysicalNames\n")
        file.write(f"{len(groups.names)}\n".encode())
        for (dimension, name), number in groups.names.items():
            file.write(f'{dimension} {number} "{name}"\n'.encode())
        file.write(b"$EndPhysicalNames\n")
        _write_nodes(content, file)
        _write_elements(content, groups, file)


def _groups(content: Content, source: str) -> _Groups:
    groups = _Groups()
    for name, faces in content.surfaces.items():
        _add_surface(groups, content, source, name, faces)
    bodies = volumes(content)
    n_nodes = len(np.unique(np.concatenate([block.nodes.ravel() for block in bodies])))
    n_volumes = sum(len(block.numbers) for block in bodies)
    for name, nodes in content.node_sets.items():
        nodes = np.unique(nodes)
        if len(nodes) < n_nodes:
            groups.add(0, _POINT, name, nodes[:, None])
    for name, elements in content.element_sets.items():
        _add_element_set(groups, content, name, np.unique(elements), n_volumes)
    return groups


def _add_surface(groups: _Groups, content: Content, source: str, name: str, faces: np.ndarray) -> None:
    triangles, quadrilaterals = faces_of(content, faces)
    if len(triangles) + len(quadrilaterals) < len(faces):
        raise Refused(f'{source}: surface "{name}": some of its faces are not of volume elements that have them')
    groups.add(2, _FACES[3], name, triangles)
    groups.add(2, _FACES[4], name, quadrilaterals)


def _add_element_set(groups: _Groups, content: Content, name: str, elements: np.ndarray, n_volumes: int) -> None:
    """The nodes of volume elements and lines, the faces of shells. Names there are already stand as they are."""
    faces_are_named, nodes_are_named = groups.has(2, name), groups.has(0, name)
    for block in content.blocks:
        own = block.nodes[np.isin(block.numbers, elements)]
        dimension = TYPES[block.type].dimension
        if dimension == 2 and not faces_are_named and len(own):
            corners = TYPES[block.type].n_corners
            groups.add(2, _FACES[corners], name, own[:, :corners])
        elif dimension != 2 and not nodes_are_named and not (dimension == 3 and len(elements) >= n_volumes) and len(own):
            groups.add(0, _POINT, name, np.unique(own)[:, None])


def _write_nodes(content: Content, file: BinaryIO) -> None:
    record = np.dtype([("number", "<i4"), ("place", "<f8", 3)])
    nodes = np.empty(len(content.node_numbers), dtype=record)
    nodes["number"] = content.node_numbers
    nodes["place"] = content.coordinates
    file.write(f"$Nodes\n{len(nodes)}\n".encode() + nodes.tobytes() + b"\n$EndNodes\n")


def _write_elements(content: Content, groups: _Groups, file: BinaryIO) -> None:
    records = [(TYPES[block.type].gmsh, 0, block.numbers,
                block.nodes[:, TYPES[block.type].gmsh_order] if TYPES[block.type].gmsh_order else block.nodes)
               for block in volumes(content)]
    next_number = 1 + max(int(numbers.max()) for _, _, numbers, _ in records)
    for gmsh_type, group, nodes in groups.records:
        records.append((gmsh_type, group, np.arange(next_number, next_number + len(nodes)), nodes))
        next_number += len(nodes)
    n_elements = sum(len(numbers) for _, _, numbers, _ in records)
    file.write(f"$Elements\n{n_elements}\n".encode())
    for gmsh_type, group, numbers, nodes in records:
        table = np.column_stack([numbers, np.full((len(numbers), 2), group), nodes])
        file.write(np.array([gmsh_type, len(numbers), 2], dtype="<i4").tobytes() + table.astype("<i4").tobytes())
    file.write(b"\n$EndElements\n")
