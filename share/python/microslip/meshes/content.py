"""A mesh as a file of another code has it: numbers of its own, names of its own, node orders already those of VTK."""

from __future__ import annotations

import dataclasses
from typing import Callable, Mapping, Optional, Sequence

import numpy as np


class Refused(Exception):
    """What is wrong with a file: where, what is there, what to do."""


@dataclasses.dataclass(frozen=True)
class ElementType:
    """Node order: corners, then edges, as VTK has it. `faces`: corners of each, a shell is one itself."""
    dimension: int
    n_nodes: int
    n_corners: int
    gmsh: int           # number in gmsh's files
    gmsh_order: tuple[int, ...]  # gmsh's list in places of this one; () if it is the same
    faces: tuple[tuple[int, ...], ...] = ()


_TETRAHEDRON = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))
_HEXAHEDRON = ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))
_WEDGE = ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0))
_PYRAMID = ((0, 1, 2, 3), (0, 4, 1), (1, 4, 2), (2, 4, 3), (3, 4, 0))

# Faces are numbered as by Abaqus and CalculiX: S1 is the first. Orders: gmsh's manual, "Node ordering".
TYPES = {
    "vertex": ElementType(0, 1, 1, 15, ()),
    "line": ElementType(1, 2, 2, 1, ()),
    "line3": ElementType(1, 3, 2, 8, ()),
    "triangle": ElementType(2, 3, 3, 2, (), ((0, 1, 2),)),
    "triangle6": ElementType(2, 6, 3, 9, (), ((0, 1, 2),)),
    "quad": ElementType(2, 4, 4, 3, (), ((0, 1, 2, 3),)),
    "quad8": ElementType(2, 8, 4, 16, (), ((0, 1, 2, 3),)),
    "tetra": ElementType(3, 4, 4, 4, (), _TETRAHEDRON),
    "tetra10": ElementType(3, 10, 4, 11, (0, 1, 2, 3, 4, 5, 6, 7, 9, 8), _TETRAHEDRON),
    "hexahedron": ElementType(3, 8, 8, 5, (), _HEXAHEDRON),
    "hexahedron20": ElementType(3, 20, 8, 17,
                                (0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14), _HEXAHEDRON),
    "wedge": ElementType(3, 6, 6, 6, (), _WEDGE),
    "wedge15": ElementType(3, 15, 6, 18, (0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10), _WEDGE),
    "pyramid": ElementType(3, 5, 5, 7, (), _PYRAMID),
    "pyramid13": ElementType(3, 13, 5, 19, (0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12), _PYRAMID),
}

# The other hand: the same element seen in a mirror, numbered along its edges in the same way.
_MIRRORED = {
    "tetra": (0, 2, 1, 3), "tetra10": (0, 2, 1, 3, 6, 5, 4, 7, 9, 8),
    "hexahedron": (0, 3, 2, 1, 4, 7, 6, 5),
    "hexahedron20": (0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17),
    "wedge": (0, 2, 1, 3, 5, 4), "wedge15": (0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13),
    "pyramid": (0, 3, 2, 1, 4), "pyramid13": (0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10),
}


@dataclasses.dataclass
class Block:
    """Elements of one type."""
    type: str
    numbers: np.ndarray  # of the elements, as the file has them
    nodes: np.ndarray    # numbers of their nodes, n × nodes per element, order of VTK


@dataclasses.dataclass
class LeftOut:
    """What holds the structure together and is not read: without it the body is another one, unless its modes are given."""
    place: str   # file and line of the first
    what: str    # e.g. *TIE
    remedy: str
    count: int = 1


@dataclasses.dataclass
class Content:
    """What a reader gives: all by the numbers of the file."""
    node_numbers: np.ndarray
    coordinates: np.ndarray                           # n × 3, in the unit of the file
    blocks: list[Block]
    node_sets: dict[str, np.ndarray] = dataclasses.field(default_factory=dict)     # name → node numbers
    element_sets: dict[str, np.ndarray] = dataclasses.field(default_factory=dict)  # name → element numbers
    surfaces: dict[str, np.ndarray] = dataclasses.field(default_factory=dict)      # name → elements and their faces from 0, n × 2
    length_unit: Optional[float] = None               # metres; None: the file does not say
    turned_nodes: tuple[int, ...] = ()  # numbers of those that tell displacements in axes of their own
    either_hand: bool = False           # whole blocks of elements may be numbered as seen in a mirror
    modes_asked: Optional[int] = None   # how many the deck asks for, whatever their frequencies; None: it does not say
    left_out: list[LeftOut] = dataclasses.field(default_factory=list)  # one of each kind
    places_of: Callable[[str, int], list[str]] = lambda kind, number: []  # "file:line" of each "node" or "element"


_LARGEST_NUMBER = 2_000_000_000  # of a node or element: numbers of 32 bits, those of faces behind them


def require(condition: object, message: str) -> None:
    if not condition:
        raise Refused(message)


def counted(n: int, one: str, many: str) -> str:
    """1 and what follows it, or another count and what follows that."""
    return f"{n} {one if n == 1 else many}"


def leave_out(left_out: list[LeftOut], place: str, what: str, remedy: str, count: int = 1) -> None:
    """One more of its kind."""
    for known in left_out:
        if known.what == what:
            known.count += count
            return
    left_out.append(LeftOut(place, what, remedy, count))


def volumes(content: Content) -> list[Block]:
    return [block for block in content.blocks if TYPES[block.type].dimension == 3]


def blocks_of(rows: Mapping[str, Sequence[Sequence[int]]]) -> list[Block]:
    """Blocks of {type: rows of an element's number and nodes}."""
    tables = {name: np.array(table, dtype=np.int64) for name, table in rows.items()}
    return [Block(name, table[:, 0], table[:, 1:]) for name, table in tables.items()]


def check(content: Content, source: str) -> None:
    """What no reader needs to check for itself. Raises Refused with the number of the node or element."""
    require(len(content.node_numbers) > 0, f"{source}: there are no nodes in it")
    require(volumes(content), f"{source}: there are no volume elements in it: tetrahedra, hexahedra, wedges or pyramids "
                              "are read")
    bad = content.node_numbers[~np.isfinite(content.coordinates).all(axis=1)]
    require(not len(bad), f"{source}: node {_first(bad)}: a coordinate is not a finite number")
    for kind, numbers in (("node", content.node_numbers), ("element", np.concatenate([block.numbers for block in content.blocks]))):
        large = numbers[np.abs(numbers) > _LARGEST_NUMBER]
        require(not len(large), f"{source}: {kind} {_first(large)}: expected numbers of at most {_LARGEST_NUMBER}; renumber")
    refuse_twice(source, "node", content.node_numbers, content.places_of)
    refuse_twice(source, "element", np.concatenate([block.numbers for block in content.blocks]), content.places_of)
    for block in content.blocks:
        missing = ~np.isin(block.nodes, content.node_numbers)
        for row in np.flatnonzero(missing.any(axis=1))[:1]:
            raise Refused(f"{source}: element {block.numbers[row]} uses node {block.nodes[row][missing[row]][0]}, which is "
                          "not there")
    elements = np.concatenate([block.numbers for block in content.blocks])
    for kind, sets, there in (("node", content.node_sets, content.node_numbers), ("element", content.element_sets, elements)):
        for name, members in sets.items():
            missing = np.setdiff1d(members, there)
            require(not len(missing), f'{source}: {kind} set "{name}" holds {kind} {_first(missing)}, which is not there')


def _first(numbers: np.ndarray) -> Optional[int]:
    return numbers[0] if len(numbers) else None


def refuse_twice(source: str, kind: str, numbers: np.ndarray, places_of: Callable[[str, int], list[str]]) -> None:
    """Raises Refused where two of the numbers are the same."""
    unique, counts = np.unique(numbers, return_counts=True)
    for number in unique[counts > 1][:1]:
        places = places_of(kind, number)
        where = f", at {' and '.join(places[:2])}; take one out" if places else ""
        raise Refused(f"{source}: {kind} {number} stands twice{where}")


def turn_blocks(content: Content) -> None:
    """Renumbers blocks of elements that are numbered by the other hand throughout, as MED has all of its elements and
    VTK its wedges. Blocks of which some elements are turned are left for the checks of the program, which refuses them."""
    order = np.argsort(content.node_numbers)
    for block in content.blocks:
        if block.type not in _MIRRORED:
            continue
        places = order[np.searchsorted(content.node_numbers[order], block.nodes)]
        if (_handedness(block.type, content.coordinates[places]) < 0.0).all():
            block.nodes = block.nodes[:, _MIRRORED[block.type]]


def _handedness(type_name: str, corners: np.ndarray) -> np.ndarray:
    """Sign of the volume between the first face and the middle of all corners, per element."""
    face = TYPES[type_name].faces[0]
    ring = corners[:, face]
    area = sum(np.cross(ring[:, i] - ring[:, 0], ring[:, i + 1] - ring[:, 0]) for i in range(1, len(face) - 1))
    inward = corners[:, :TYPES[type_name].n_corners].mean(axis=1) - ring.mean(axis=1)
    return np.einsum("ij,ij->i", area, inward)


def corners_of_faces(content: Content) -> np.ndarray:
    """Sorted corners of all faces of volume elements, n × 4; the fourth of a triangle is -1."""
    return np.concatenate([four_sorted(block.nodes[:, face]) for block in volumes(content) for face in TYPES[block.type].faces])


def four_sorted(nodes: np.ndarray) -> np.ndarray:
    return np.sort(np.pad(nodes, ((0, 0), (0, 4 - nodes.shape[1])), constant_values=-1), axis=1)


def ends_of_edges(content: Content) -> np.ndarray:
    """Sorted corners of all edges of volume elements, n × 2."""
    return np.concatenate([np.sort(block.nodes[:, (face[i - 1], face[i])], axis=1) for block in volumes(content)
                           for face in TYPES[block.type].faces for i in range(len(face))])


def rows_in(rows: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Which of the rows are among the others."""
    kind = [("", np.int64)] * rows.shape[1]
    return np.isin(*(np.ascontiguousarray(table, dtype=np.int64).view(kind).ravel() for table in (rows, others)))


def faces_of(content: Content, elements_and_faces: np.ndarray) -> list[np.ndarray]:
    """Corner nodes of faces, by their number: [n × 3, m × 4] arrays."""
    triangles, quadrilaterals = [], []
    for block in content.blocks:
        faces = TYPES[block.type].faces
        order = np.argsort(block.numbers)
        for number, corners in enumerate(faces):
            wanted = elements_and_faces[elements_and_faces[:, 1] == number, 0]
            own = wanted[np.isin(wanted, block.numbers)]
            rows = order[np.searchsorted(block.numbers[order], own)]
            (triangles if len(corners) == 3 else quadrilaterals).append(block.nodes[np.ix_(rows, corners)])
    empty = np.empty((0, 0), dtype=np.int64)
    return [np.concatenate(part) if part else empty for part in (triangles, quadrilaterals)]


def boundary_faces(content: Content) -> np.ndarray:
    """All faces that one volume element has: element numbers and faces, n × 2."""
    keys, places = [], []
    for block in volumes(content):
        for number, corners in enumerate(TYPES[block.type].faces):
            key = np.full((len(block.numbers), 4), -1, dtype=np.int64)
            key[:, :len(corners)] = block.nodes[:, corners]
            keys.append(np.sort(key, axis=1))
            places.append(np.column_stack([block.numbers, np.full(len(block.numbers), number)]))
    _, which, counts = np.unique(np.concatenate(keys), axis=0, return_inverse=True, return_counts=True)
    return np.concatenate(places)[counts[which] == 1]
