"""Universal files of I-deas, Salome and others (.unv): nodes, elements, groups, units.

meshio 5.0 has no reader; gmsh's takes groups of elements only, and no units.
"""

from __future__ import annotations

from typing import Any, Callable, Iterator, Sequence

import numpy as np

from .content import TYPES, Content, Refused, blocks_of, require
from .decks import open_text

# Number of the finite element → type. Nodes of parabolic ones go around each ring, corner, edge, corner, …
_TYPES = {111: "tetra", 118: "tetra10", 115: "hexahedron", 116: "hexahedron20", 112: "wedge", 113: "wedge15",
          41: "triangle", 51: "triangle", 61: "triangle", 74: "triangle", 81: "triangle", 91: "triangle",
          42: "triangle6", 52: "triangle6", 62: "triangle6", 72: "triangle6", 82: "triangle6", 92: "triangle6",
          44: "quad", 54: "quad", 64: "quad", 71: "quad", 84: "quad", 94: "quad",
          45: "quad8", 55: "quad8", 65: "quad8", 75: "quad8", 85: "quad8", 95: "quad8",
          11: "line", 21: "line", 22: "line3", 23: "line3", 24: "line3"}
_BEAMS = (11, 21, 22, 23, 24)  # have a record of their own
_ORDER = {"line3": (0, 2, 1), "triangle6": (0, 2, 4, 1, 3, 5), "quad8": (0, 2, 4, 6, 1, 3, 5, 7),
          "tetra10": (0, 2, 4, 9, 1, 3, 5, 6, 7, 8),
          "hexahedron20": (0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11),
          "wedge15": (0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8)}
_GROUPS = {2430: 2, 2432: 2, 2435: 4, 2452: 4, 2467: 4, 2477: 4}  # data set → numbers per member
_NODE, _ELEMENT = 7, 8


def read(path: str) -> Content:
    """A Content. Raises Refused with file and line."""
    with open_text(path) as file:
        lines = file.read().splitlines()
    reader = _Reader(path, lines)
    readers = {15: reader.nodes, 781: reader.nodes, 2411: reader.nodes, 2412: reader.elements, 780: reader.elements,
               164: reader.units, **{number: reader.groups for number in _GROUPS}}
    for number, begin, end in _data_sets(path, lines):
        if number in readers:
            readers[number](number, begin, end)
    return reader.content()


def _data_sets(path: str, lines: Sequence[str]) -> Iterator[tuple[int, int, int]]:
    """Number, first and last line of each, between lines of -1."""
    marks = [i for i, line in enumerate(lines) if line.strip() == "-1"]
    require(marks, f"{path}: no line of -1 in it: is it a universal file?")
    require(len(marks) % 2 == 0, f"{path}:{len(lines)}: the last data set has no end: the file is cut off")
    for begin, end in zip(marks[::2], marks[1::2]):
        number = lines[begin + 1].strip() if end > begin + 1 else ""
        require(number.isdigit(), f"{path}:{begin + 2}: expected the number of a data set")
        yield int(number), begin + 2, end


class _Reader:
    def __init__(self, path: str, lines: Sequence[str]) -> None:
        self.path, self.lines = path, lines
        self.node_numbers, self.coordinates = [], []
        self.lines_of = {"node": [], "element": []}  # number and line of each
        self.rows = {}
        self.node_sets, self.element_sets = {}, {}
        self.length_unit = None

    def _numbers(self, line: int, convert: Callable[[str], Any] = int) -> list[Any]:
        try:
            return [convert(word) for word in self.lines[line].replace("D", "E").replace("d", "e").split()]
        except ValueError:
            kind = "whole numbers" if convert is int else "numbers"
            raise Refused(f'{self.path}:{line + 1}: expected {kind}, found "{self.lines[line].strip()[:40]}"') from None

    def nodes(self, number: int, begin: int, end: int) -> None:
        step = 1 if number == 15 else 2
        require((end - begin) % step == 0, f"{self.path}:{end}: the last node has no coordinates")
        for line in range(begin, end, step):
            words = self._numbers(line, float)
            place = words[4:7] if step == 1 else self._numbers(line + 1, float)
            require(len(words) >= 2 and len(place) == 3, f"{self.path}:{line + step}: expected three coordinates")
            require(words[1] in (0, 1), f"{self.path}:{line + 1}: node {int(words[0])} lies in coordinate system "
                                        f"{int(words[1])}; write the mesh out in the global one")
            self.node_numbers.append(int(words[0]))
            self.lines_of["node"].append((int(words[0]), line + 1))
            self.coordinates.append(place)

    def elements(self, number: int, begin: int, end: int) -> None:
        line = begin
        while line < end:
            head = self._numbers(line)
            require(len(head) >= 6, f"{self.path}:{line + 1}: expected the six numbers of an element")
            own = _TYPES.get(head[1])
            require(own, f"{self.path}:{line + 1}: element {head[0]} is of type {head[1]}, which is not read; bodies may be "
                         "111, 118 (tetrahedra), 115, 116 (bricks), 112, 113 (wedges)")
            n_nodes = head[7] if number == 780 else head[5]
            first = line + (2 if head[1] in _BEAMS else 1)
            last = first + -(-n_nodes // 8)
            nodes = [node for at in range(first, min(last, end)) for node in self._numbers(at)]
            order = _ORDER.get(own, range(len(nodes)))
            require(len(nodes) == n_nodes == TYPES[own].n_nodes,
                    f"{self.path}:{line + 1}: element {head[0]} of type {head[1]} is said to have {n_nodes} nodes, and {len(nodes)} "
                    f"follow; expected {TYPES[own].n_nodes}")
            self.rows.setdefault(own, []).append([head[0], *(nodes[i] for i in order)])
            self.lines_of["element"].append((head[0], line + 1))
            line = last

    def groups(self, number: int, begin: int, end: int) -> None:
        width = _GROUPS[number]
        line = begin
        while line + 1 < end:
            head = self._numbers(line)
            require(len(head) >= 8, f"{self.path}:{line + 1}: expected the eight numbers of a group")
            name = self.lines[line + 1].strip() or f"group {head[0]}"
            members, last = [], line + 2
            while len(members) < head[7] * width and last < end:  # gmsh writes one member per line, others two
                members += self._numbers(last)
                last += 1
            require(len(members) == head[7] * width, f'{self.path}:{line + 1}: group "{name}": expected {head[7]} members')
            members = np.array(members, dtype=np.int64).reshape(-1, width)
            for kind, sets in ((_NODE, self.node_sets), (_ELEMENT, self.element_sets)):
                own = members[members[:, 0] == kind, 1]
                require(not (len(own) and name in sets), f'{self.path}:{line + 2}: group "{name}" is there already')
                if len(own):
                    sets[name] = own
            line = last

    def units(self, _number: int, begin: int, end: int) -> None:
        factors = self._numbers(begin + 1, float) if end > begin + 1 else []
        require(factors and factors[0] > 0, f"{self.path}:{begin + 2}: expected the factors of the units")
        self.length_unit = 1.0 / factors[0]  # to divide by for metres

    def content(self) -> Content:
        require(self.node_numbers, f"{self.path}: no nodes (data set 2411) in it")
        require(self.rows, f"{self.path}: no elements (data set 2412) in it")
        elements = [row[0] for rows in self.rows.values() for row in rows]
        for name, members in self.element_sets.items():  # groups may hold what is no element here: gmsh's points
            self.element_sets[name] = members[np.isin(members, elements)]
        return Content(np.array(self.node_numbers), np.array(self.coordinates), blocks_of(self.rows), self.node_sets, self.element_sets,
                       length_unit=self.length_unit, places_of=self._places_of)

    def _places_of(self, kind: str, wanted: int) -> list[str]:
        return [f"{self.path}:{line}" for number, line in self.lines_of[kind] if number == wanted]
