"""Decks of Abaqus and CalculiX (.inp): nodes, elements, *NSET, *ELSET, *SURFACE, *INCLUDE, one *INSTANCE.

meshio 5.0 is not used here: it forgets all but the last *NODE block, the numbers of elements, sets made of sets, what
*NODE and *ELEMENT say of sets, and *SURFACE.
"""

from __future__ import annotations

import math
import os
import re
from typing import Callable, Iterable, Iterator, Optional, Sequence, Tuple, Union

import numpy as np

from .content import (TYPES, Block, Content, Refused, boundary_faces, corners_of_faces, ends_of_edges, four_sorted, leave_out,
                      refuse_twice, require, rows_in, volumes)
from .decks import open_deck

Where = Tuple[str, int]  # file and line
_SOLID = {"4": "tetra", "10": "tetra10", "8": "hexahedron", "20": "hexahedron20", "6": "wedge", "15": "wedge15",
          "5": "pyramid", "13": "pyramid13"}
_SHELL = {"3": "triangle", "6": "triangle6", "4": "quad", "8": "quad8"}
_LINE = {"T3D2": "line", "T3D3": "line3", "T2D2": "line", "T2D3": "line3", "B31": "line", "B32": "line3", "B33": "line"}
_FACES = {"SPOS": 0, "SNEG": 0, **{f"S{i}": i - 1 for i in range(1, 7)}}  # the two sides of a shell are one face here
_COPIES = ("NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM")
# Trusses are what gmsh writes of named edges, beams are not.
_BEAM = re.compile(r"B3[123]", re.I)
_TIES = ("MPC", "EQUATION", "TIE", "RIGID BODY", "KINEMATIC", "KINEMATIC COUPLING", "EMBEDDED ELEMENT", "SHELL TO SOLID COUPLING",
         "FASTENER", "CYCLIC SYMMETRY MODEL")
# They weigh, pull and join, and have no mesh.
_POINTLIKE = re.compile(r"MASS|ROTARYI|SPRING[12A]|DASHPOT[12A]|CONN3D2|DCOUP3D|GAP[A-Z]+", re.I)
_NUMBERS = {"NODE": float, "ELEMENT": int}  # what data lines of a table hold
_PIECE = 20_000  # data lines of a table that are text at a time
_MANY = 4_000  # nodes or elements in cards of their own
_WITH_INPUT = re.compile(r"\*\s*(?:NODE|ELEMENT|NSET|ELSET|SURFACE)\s*,.*\bINPUT\s*=\s*([^,]+)", re.I)


def read(path: str) -> Content:
    """A Content. Raises Refused with file and line."""
    deck = _Deck(path)
    for card in _cards(_lines(path, os.path.dirname(os.path.abspath(path)), ())):
        deck.take(card)
    return deck.content()


def _type(name: str) -> Optional[str]:
    """Ours for theirs: C3D10MH is a tetra10, S4R a quad; None for what is no plain body, skin or line."""
    upper = name.upper()
    solid = re.fullmatch(r"C3D(\d+)[A-Z]*", upper)
    if solid:
        return _SOLID.get(solid[1])
    shell = re.fullmatch(r"(?:S|DS|STRI|CPS|CPE|M3D|SFM3D|R3D)(\d+)[A-Z]*\d?", upper)
    if shell:
        return "triangle6" if upper == "STRI65" else _SHELL.get(shell[1])
    line = re.fullmatch(r"([TB]\d+D?\d?)[A-Z]*", upper)
    return _LINE.get(line[1]) if line else None


def _lines(path: str, folder: str, above: tuple[str, ...]) -> Iterator[tuple[Where, str]]:
    """Pairs (place, text) of a file and what it includes, without comments and blank lines."""
    keyword = ""  # that began on this line or one before
    with open_deck(path, above, "*INCLUDE") as file:
        for number, text in enumerate(file, 1):
            text = text.strip()
            if not text or text.startswith("**"):
                continue
            if text[0] == "*" and re.match(r"\*\s*INCLUDE\b", text, re.I):
                place = f"{path}:{number}"
                name = re.search(r"INPUT\s*=\s*(.+)", text, re.I)
                require(name, f"{place}: *INCLUDE without INPUT=")
                yield from _included(name[1], folder, (*above, place))
                continue
            yield (path, number), text
            keyword = keyword + text if keyword.endswith(",") else text if text[0] == "*" else ""
            data = _WITH_INPUT.match(keyword)
            if data and not keyword.endswith(","):
                keyword = ""
                yield from _included(data[1], folder, (*above, f"{path}:{number}"))


def _included(name: str, folder: str, above: tuple[str, ...]) -> Iterator[tuple[Where, str]]:
    return _lines(os.path.join(folder, name.strip().strip('"')), folder, above)


class _Card:
    """A keyword with its parameters and data lines."""

    def __init__(self, where: Where, text: str) -> None:
        words = [word.strip() for word in text[1:].split(",")]
        self.place = f"{where[0]}:{where[1]}"
        self.keyword = " ".join(words[0].upper().split())
        self.parameters = {}
        for word in filter(None, words[1:]):
            key, _, value = word.partition("=")
            self.parameters[key.strip().upper()] = value.strip().strip('"')
        self.data = []  # (where, text)
        # Whatever else *ELEMENT may tell of, bodies, skins and lines are told in numbers.
        self._is_table = self.keyword == "NODE" or self.keyword == "ELEMENT" and _type(self.get("TYPE")) is not None
        self._pieces = []  # of data that are numbers by now: (file, lines, numbers, how many each line has)
        self.has_points = False  # decimal ones, known for a table when its numbers are
        self._n_watched = 0  # data lines

    def add(self, where: Where, text: str) -> None:
        """A data line. A long table becomes numbers piece by piece: as text it takes ten times the memory."""
        if self._is_table and self.data and (len(self.data) >= _PIECE or where[0] != self.data[0][0][0]):
            self._settle()
            self._refuse_endless()
        self.data.append((where, text))

    def _settle(self) -> None:
        if self.data:
            self._pieces.append((self.data[0][0][0], np.array([line for (_, line), _ in self.data]), *self._numbers_of_data()))
            self.data = []

    def _refuse_endless(self) -> None:
        """What says one thing over and over, told before hundreds of megabytes of it are read: asked whenever the lines
        have doubled."""
        n_lines = sum(len(piece[1]) for piece in self._pieces)
        if n_lines < max(_PIECE, 2 * self._n_watched):
            return
        self._n_watched = n_lines
        numbers, lines = self._first_numbers()
        refuse_twice(self.place.rpartition(":")[0], self.keyword.lower(), numbers,
                     lambda _, wanted: [self.place_of(line) for line in lines[numbers == wanted]])

    def _first_numbers(self) -> tuple[np.ndarray, np.ndarray]:
        """Those of nodes or of elements that are complete so far, and the data lines they stand on."""
        values, counts = self.numbers()
        ends = np.cumsum(counts)
        if self.keyword == "NODE":
            return values[ends - counts].astype(np.int64), np.arange(len(counts))
        width = TYPES[_type(self.get("TYPE"))].n_nodes + 1
        begins = np.arange(0, len(values) // width * width, width)
        return values[begins], np.searchsorted(ends, begins, side="right")

    def has(self, key: str) -> bool:
        return key in self.parameters

    def get(self, key: str, preset: str = "") -> str:
        return self.parameters.get(key, preset)

    def name(self, key: str) -> str:
        require(self.get(key), f"{self.place}: *{self.keyword} without {key}=")
        return self.get(key)

    def place_of(self, line: int) -> str:
        """Of a data line of a table."""
        self._settle()
        for path, lines, _, _ in self._pieces:
            if line < len(lines):
                return f"{path}:{lines[line]}"
            line -= len(lines)
        raise IndexError(line)

    def rows(self) -> Iterator[tuple[str, list[str]]]:
        """Place and words of every data line."""
        for where, text in self.data:
            yield f"{where[0]}:{where[1]}", [word.strip() for word in text.rstrip(",").split(",")]

    def numbers(self) -> tuple[np.ndarray, np.ndarray]:
        """All numbers of a table and how many each data line has; no lines: none. Raises Refused at the line that holds no
        number."""
        self._settle()
        values = [piece[2] for piece in self._pieces]
        counts = [piece[3] for piece in self._pieces]
        return (np.concatenate(values), np.concatenate(counts)) if values else (np.empty(0), np.empty(0, dtype=np.int64))

    def _numbers_of_data(self) -> tuple[np.ndarray, np.ndarray]:
        convert = _NUMBERS[self.keyword]
        texts = [text.rstrip(", \t") for _, text in self.data]
        joined = ",".join(texts)
        self.has_points = self.has_points or "." in joined
        try:
            return np.array(list(map(convert, joined.split(",")))), \
                np.array([text.count(",") + 1 for text in texts])
        except ValueError:
            for place, words in self.rows():
                for word in words:
                    try:
                        convert(word)
                    except ValueError:
                        hint = "; numbers are parted by commas, and decimals by points" if re.search(r"[;\t ]", word) else ""
                        raise Refused(f'{place}: *{self.keyword}: expected a number, found "{word[:40]}"{hint}') from None
            raise


def _cards(lines: Iterable[tuple[Where, str]]) -> Iterator[_Card]:
    card = None
    continued = None
    for where, text in lines:
        if continued:  # a keyword line that ended with a comma
            text, where, continued = continued[1] + text, continued[0], None
        if text[0] != "*":
            if card:
                card.add(where, text)
            continue
        if text.endswith(","):
            continued = (where, text)
            continue
        if card:
            yield card
        card = _Card(where, text)
    if card:
        yield card


class _Sets:
    """Sets of numbers that may be made of other sets, named without regard to case; the first spelling stays."""

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self._parts = {}    # upper-case name → [(place, numbers or a name)]
        self._spelling = {}
        self._hidden = set()
        self._ready = {}

    def add(self, name: str, place: str, part: Union[str, np.ndarray], hidden: bool = False) -> None:
        key = name.upper()
        self._spelling.setdefault(key, name)
        if hidden:
            self._hidden.add(key)
        self._parts.setdefault(key, []).append((place, part))

    def __contains__(self, name: str) -> bool:
        return name.upper() in self._parts

    def get(self, name: str, place: str, above: tuple[str, ...] = ()) -> np.ndarray:
        key = name.upper()
        if key not in self._parts:
            raise Refused(f'{place}: no {self.kind} set is named "{name}"; there are: '
                          f'{", ".join(self._spelling.values()) or "none"}')
        require(key not in above, f'{place}: {self.kind} set "{name}" is made of itself')
        if key not in self._ready:
            parts = [self.get(part, at, (*above, key)) if isinstance(part, str) else part
                     for at, part in self._parts[key]]
            self._ready[key] = np.unique(np.concatenate(parts).astype(np.int64))
        return self._ready[key]

    def spelling(self, name: str) -> Optional[str]:
        """That of the file, None where there is no such set to be named."""
        key = name.upper()
        return None if key in self._hidden else self._spelling.get(key)

    def named(self) -> dict[str, np.ndarray]:
        return {self._spelling[key]: self.get(key, "") for key in self._parts if key not in self._hidden}


class _Deck:
    def __init__(self, path: str) -> None:
        self.path = path
        self.nodes, self.coordinates, self.blocks = [], [], []
        self.origins = {"node": [], "element": []}  # (numbers, card, data line of each)
        self.n_taken = {"node": 0, "element": 0}
        self.next_watch = {"node": _MANY, "element": _MANY}
        self.node_sets, self.element_sets = _Sets("node"), _Sets("element")
        self.surfaces = {}   # upper-case name → card
        self.instances = []
        self.instanced = None  # part of the instance
        self.move = None       # of the part to where its instance lies: coordinates → coordinates
        self.inside = None     # the part or instance a card stands in
        self.parts = {}        # part → cards, until it is known which of them is used
        self.left_out = []
        self.sections = []     # cards *SOLID SECTION
        self.later = []        # cards of the assembly: they speak of its parts

    def take(self, card: _Card) -> None:
        if card.keyword in ("PART", "INSTANCE"):
            self._open(card)
        elif card.keyword in ("END PART", "END INSTANCE"):
            self.inside = None
        elif self.inside is not None:
            self.parts[self.inside].append(card)
        elif self.parts:
            self.later.append(card)
        else:
            self._take(card)

    def _open(self, card: _Card) -> None:
        self.inside = f"{card.keyword} {card.name('NAME').upper()}"
        require(self.inside not in self.parts, f"{card.place}: *{card.keyword} {card.get('NAME')} stands twice")
        self.parts[self.inside] = []
        if card.keyword == "INSTANCE":
            self._place_instance(card)

    def _place_instance(self, card: _Card) -> None:
        """Only one."""
        self.instances.append(card)
        first = self.instances[0]
        require(len(self.instances) == 1,
                f"{card.place}: instance \"{card.get('NAME')}\" beside \"{first.get('NAME')}\": a body of one instance is "
                "read; merge them, or write the part out alone")
        self.move = _move_of(card)
        for part in (f"INSTANCE {card.name('NAME').upper()}", f"PART {card.get('PART', '').upper()}"):
            self.instanced = (self.instanced or []) + [part]

    def _take(self, card: _Card) -> None:
        if card.keyword in _COPIES:
            raise Refused(f"{card.place}: *{card.keyword} is not followed; write the mesh out node by node")
        if card.keyword in _TIES:
            leave_out(self.left_out, card.place, f"*{card.keyword}", "join the nodes, or take it out of the file")
        if card.keyword == "NODE":
            self._take_nodes(card)
        elif card.keyword == "ELEMENT":
            self._take_elements(card)
        elif card.keyword == "NSET":
            self._take_set(card, self.node_sets, "NSET")
        elif card.keyword == "ELSET":
            self._take_set(card, self.element_sets, "ELSET")
        elif card.keyword == "SURFACE":
            self._take_surface(card)
        elif card.keyword == "SOLID SECTION":
            self.sections.append(card)

    def _take_nodes(self, card: _Card) -> None:
        require(card.get("SYSTEM", "R").upper() == "R",
                f"{card.place}: *NODE, SYSTEM={card.get('SYSTEM')}: only rectangular coordinates are read")
        values, counts = card.numbers()
        if not len(counts):
            return
        starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
        for line in np.flatnonzero((counts < 2) | (counts > 7))[:1]:
            self._refuse_node(card, line, counts)
        for line in () if card.has_points else np.flatnonzero(counts > 4):
            length = np.linalg.norm(values[starts[line] + 4:starts[line] + counts[line]])  # that of a normal is 1
            if length != 0.0 and abs(length - 1.0) > 1e-3:
                self._refuse_node(card, line, counts)
        places = np.zeros((len(counts), 3))
        for axis in range(3):
            has = counts > axis + 1
            places[has, axis] = values[starts[has] + axis + 1]
        numbers = values[starts].astype(np.int64)
        self._note("node", numbers, card, np.arange(len(numbers)))
        self.nodes.append(numbers)
        self.coordinates.append(places)
        if card.get("NSET"):
            self.node_sets.add(card.get("NSET"), card.place, numbers)

    @staticmethod
    def _refuse_node(card: _Card, line: int, counts: np.ndarray) -> None:
        commas = "" if card.has_points else "; if these are decimal commas, write points"
        raise Refused(f"{card.place_of(line)}: *NODE: expected a number and three coordinates, found {counts[line]} numbers{commas}")

    def _note(self, kind: str, numbers: np.ndarray, card: _Card, lines: np.ndarray) -> None:
        """Where they stand. What stands twice is told early, as within a card, where there is no end of cards."""
        self.origins[kind].append((numbers, card, lines))
        self.n_taken[kind] += len(numbers)
        if self.n_taken[kind] >= self.next_watch[kind]:
            self.next_watch[kind] = 2 * self.n_taken[kind]
            refuse_twice(self.path, kind, np.concatenate([known for known, _, _ in self.origins[kind]]), self.places_of)

    def places_of(self, kind: str, wanted: int) -> list[str]:
        return [card.place_of(lines[row]) for numbers, card, lines in self.origins[kind]
                for row in np.flatnonzero(numbers == wanted)]

    def _take_elements(self, card: _Card) -> None:
        given = card.name("TYPE")
        own = _type(given)
        if _BEAM.match(given):
            leave_out(self.left_out, card.place, f"*ELEMENT, TYPE={given} (beams)",
                      "take them out of the file, or name edges by trusses (T3D2) or node sets")
        if _POINTLIKE.fullmatch(given):
            leave_out(self.left_out, card.place, f"*ELEMENT, TYPE={given}", "take them out of the file")
            return
        require(own, f"{card.place}: elements of type {given} are not read; bodies may be C3D4, C3D10, C3D8, C3D20, C3D6, "
                     "C3D15, C3D5, C3D13 with any letters behind")
        values, counts = card.numbers()
        if not len(counts):
            return
        width = TYPES[own].n_nodes + 1
        ends = np.cumsum(counts)
        wanted = np.arange(width, ends[-1] + width, width)
        wrong = np.flatnonzero(~np.isin(wanted, ends))
        if len(wrong):
            begin = width * wrong[0]
            line = np.searchsorted(ends, begin, side="right")
            raise Refused(f"{card.place_of(line)}: element {values[begin]} does not have the {width - 1} nodes of a "
                          f"{given}: the lines hold fewer or more")
        table = values.reshape(-1, width)
        lines = np.searchsorted(ends, np.arange(0, len(values), width), side="right")
        self._note("element", table[:, 0], card, lines)
        self.blocks.append(Block(own, table[:, 0], table[:, 1:]))
        if card.get("ELSET"):
            self.element_sets.add(card.get("ELSET"), card.place, table[:, 0])

    def _take_set(self, card: _Card, sets: _Sets, key: str) -> None:
        name, hidden = card.name(key), card.has("INTERNAL")
        sets.add(name, card.place, np.empty(0, dtype=np.int64), hidden)
        if card.has("GENERATE"):
            for place, words in card.rows():
                sets.add(name, place, _generated(place, words), hidden)
            return
        if key == "NSET" and card.get("ELSET"):
            sets.add(name, card.place, self._nodes_of(card.get("ELSET"), card.place))
        numbers = []
        for place, words in card.rows():
            for word in filter(None, words):
                if word.isdigit():
                    numbers.append(int(word))
                else:
                    sets.add(name, place, self._own_name(word), hidden)
        sets.add(name, card.place, np.array(numbers, dtype=np.int64), hidden)

    def _nodes_of(self, element_set: str, place: str) -> np.ndarray:
        elements = self.element_sets.get(element_set, place)
        return np.concatenate([block.nodes[np.isin(block.numbers, elements)].ravel() for block in self.blocks])

    def _own_name(self, word: str) -> Union[str, np.ndarray]:
        """A name, or a number, said with the instance before it."""
        word = word.strip('"')
        for instance in self.instances:
            if word.upper().startswith(instance.name("NAME").upper() + "."):
                word = word[len(instance.name("NAME")) + 1:]
        return np.array([int(word)]) if word.isdigit() else word

    def _take_surface(self, card: _Card) -> None:
        name = card.name("NAME")
        before = self.surfaces.setdefault(name.upper(), card)
        require(before is card, f'{card.place}: surface "{name}" is there already, at {before.place}')
        require(not card.has("COMBINE"), f'{card.place}: surface "{name}": COMBINE is not followed')

    def content(self) -> Content:
        self._settle_parts()
        require(self.nodes, f"{self.path}: no *NODE with coordinates in it: is it a deck of Abaqus or CalculiX?")
        require(self.blocks, f"{self.path}: no *ELEMENT with data in it")
        content = Content(np.concatenate(self.nodes), np.concatenate(self.coordinates), self.blocks, places_of=self.places_of)
        require(volumes(content), f"{self.path}: no solid elements in it")
        self._leave_out_loose(content)
        self._leave_out_sections(content)
        content.left_out = self.left_out
        self._refuse_names_of_other_case()
        outer = None
        for card in self.surfaces.values():
            if card.get("TYPE", "ELEMENT").upper() == "NODE":
                self._add_node_surface(card)
                continue
            if outer is None:
                outer = boundary_faces(content)
            if not card.has("INTERNAL"):
                content.surfaces[card.name("NAME")] = self._faces(card, content, outer)
        content.node_sets = self.node_sets.named()
        content.element_sets = self.element_sets.named()
        return content

    def _leave_out_loose(self, content: Content) -> None:
        """Shells on a face of a solid name it, trusses on an edge; others hold something together."""
        for block in content.blocks:
            kind = TYPES[block.type]
            if kind.dimension == 2:
                loose = ~rows_in(four_sorted(block.nodes[:, :kind.n_corners]), corners_of_faces(content))
                self._leave_out(block.numbers[loose], "a shell that lies on no face of a solid")
            elif kind.dimension == 1:
                pairs = [np.sort(block.nodes[:, pair], axis=1) for pair in ((0, 1), (0, 2), (1, 2)) if max(pair) < kind.n_nodes]
                on_edge = np.any([rows_in(pair, ends_of_edges(content)) for pair in pairs], axis=0)
                self._leave_out(block.numbers[~on_edge], "a truss that lies on no edge of a solid")

    def _leave_out(self, elements: np.ndarray, what: str) -> None:
        beams = [numbers for numbers, card, _ in self.origins["element"] if _BEAM.match(card.get("TYPE"))]
        elements = np.setdiff1d(elements, np.concatenate(beams)) if beams else elements  # these are left out already
        if len(elements):
            leave_out(self.left_out, self.places_of("element", elements[0])[0], f"element {elements[0]}, {what}",
                      "take it out of the file", len(elements))

    def _leave_out_sections(self, content: Content) -> None:
        """A truss with a cross-section carries load, on an edge as well."""
        trusses = [block.numbers for block in content.blocks if TYPES[block.type].dimension == 1]
        for card in self.sections if trusses else ():
            name = card.get("ELSET", "")
            area = next(([word for word in words if word] for _, words in card.rows()), [])
            if area and name in self.element_sets and np.isin(np.concatenate(trusses), self.element_sets.get(name, card.place)).any():
                leave_out(self.left_out, card.place, f'the cross-section of trusses in "{name}"',
                          "take it out of the file, where they only name edges")

    def _refuse_names_of_other_case(self) -> None:
        """For Abaqus names of other case are one, here two; a set and a surface may share one name."""
        for card in self.surfaces.values():
            name = card.name("NAME")
            other = self.node_sets.spelling(name) or self.element_sets.spelling(name)
            require(other in (None, name), f'{card.place}: surface "{name}" and the set "{other}" differ in case alone, which Abaqus '
                                           "ignores; rename one")

    def _settle_parts(self) -> None:
        """Of several parts the one that the instance is of."""
        used = self.instanced or [name for name in self.parts if name.startswith("PART ")]
        require(self.instanced or len(used) <= 1,
                f"{self.path}: {len(used)} parts and no *INSTANCE that tells which of them is meant")
        for card in (card for part in used for card in self.parts.get(part, [])):
            self._take(card)
        if self.move:
            self.coordinates = [self.move(places) for places in self.coordinates]
        for card in self.later:  # nodes of the assembly lie where they lie
            self._take(card)

    def _add_node_surface(self, card: _Card) -> None:
        name = card.name("NAME")
        for place, words in card.rows():
            part = self._own_name(words[0])
            if not (isinstance(part, str) and part.upper() == name.upper()):
                require(name not in self.node_sets or not isinstance(part, str)
                        or np.array_equal(self.node_sets.get(name, place), self.node_sets.get(part, place)),
                        f'{place}: surface "{name}" and a node set of that name hold other nodes; rename one')
                self.node_sets.add(name, place, part)

    def _faces(self, card: _Card, content: Content, outer: np.ndarray) -> np.ndarray:
        """Elements and faces of *SURFACE, TYPE=ELEMENT: lines "elements, S3", or "elements" for what is free of them."""
        found = [np.empty((0, 2), dtype=np.int64)]
        for place, words in card.rows():
            part = self._own_name(words[0])
            elements = self.element_sets.get(part, place) if isinstance(part, str) else part
            face = words[1].upper() if len(words) > 1 else ""
            self._require_faces(card, place, content, elements, _FACES.get(face, 0))
            if not face:
                found.append(outer[np.isin(outer[:, 0], elements)])
            else:
                require(face in _FACES, f'{place}: surface "{card.name("NAME")}": face "{words[1]}" is not read; expected S1 '
                                        "to S6, SPOS, SNEG, or nothing for all free faces")
                found.append(np.column_stack([elements, np.full(len(elements), _FACES[face])]))
        return np.unique(np.concatenate(found), axis=0)

    @staticmethod
    def _require_faces(card: _Card, place: str, content: Content, elements: np.ndarray, face: int) -> None:
        """Of every element the face of that number."""
        surface = f'{place}: surface "{card.name("NAME")}"'
        missing = np.setdiff1d(elements, np.concatenate([block.numbers for block in content.blocks]))
        require(not len(missing), f"{surface}: element {next(iter(missing), None)} is not there")
        for block in content.blocks:
            without = np.intersect1d(elements, block.numbers) if face >= len(TYPES[block.type].faces) else ()
            require(not len(without), f"{surface}: element {next(iter(without), None)}, a {block.type}, has no face S{face + 1}")


def _move_of(card: _Card) -> Optional[Callable[[np.ndarray], np.ndarray]]:
    """What *INSTANCE does to its part: a line moves it, a second one turns it about an axis through two points by degrees."""
    steps = []
    for place, words in card.rows():
        what = "a translation of 3 numbers" if not steps else "a rotation: two points and an angle, 7 numbers"
        count = 3 if not steps else 7
        try:
            numbers = [float(word or 0) for word in words]
        except ValueError:
            numbers = []
        require(len(steps) < 2 and 0 < len(numbers) <= count and all(map(math.isfinite, numbers)),
                f"{place}: *INSTANCE: expected {'no third line' if len(steps) == 2 else what}, found {', '.join(words)}")
        steps.append(np.array(numbers + [0.0] * (count - len(numbers))))
        if len(steps) == 2:
            require(np.linalg.norm(steps[1][3:6] - steps[1][:3]) > 0.0, f"{place}: *INSTANCE: the two points of the axis are one")
    if not any(step.any() for step in steps):
        return None
    return lambda places: _moved(places, steps)


def _moved(places: np.ndarray, steps: Sequence[np.ndarray]) -> np.ndarray:
    moved = places + steps[0]
    if len(steps) == 1:
        return moved
    origin, end, angle = steps[1][:3], steps[1][3:6], np.radians(steps[1][6])
    axis = (end - origin) / np.linalg.norm(end - origin)
    arm = moved - origin
    return origin + np.cos(angle) * arm + np.sin(angle) * np.cross(axis, arm) + (1 - np.cos(angle)) * np.outer(arm @ axis, axis)


def _generated(place: str, words: list[str]) -> np.ndarray:
    try:
        first, last, step = [int(word) for word in words + ["1"] * (3 - len(words))]
    except ValueError:
        raise Refused(f"{place}: GENERATE: expected first, last and step, found {', '.join(words)[:40]}") from None
    require(step > 0 and 0 <= last - first <= 10**8, f"{place}: GENERATE: from {first} to {last} by {step}")
    return np.arange(first, last + 1, step)
