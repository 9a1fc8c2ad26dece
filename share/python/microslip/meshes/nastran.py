"""Bulk data of Nastran and OptiStruct (.bdf, .nas, .fem): GRID, solids, shells, SPC, SPC1, SET, PLOAD4.

meshio 5.0 is not used here: it takes coordinates of local systems for global ones, wants BEGIN BULK, follows no INCLUDE
and gives no names. A deck ends with ENDDATA: without it nothing tells a whole one from one that was cut off. In a file
that is included it ends that file alone.

Names: "PID 3" for the elements of property 3, "SPC 1" for the nodes that set 1 holds, "SET 2" for a set of nodes,
"PLOAD4 4" for the faces that carry pressure set 4; or what HyperMesh and Femap call them in their comments.
"""

from __future__ import annotations

import itertools
import os
import re
from typing import Iterable, Iterator, Optional, Sequence

import numpy as np

from .content import TYPES, Content, Refused, blocks_of, counted, leave_out, require
from .decks import open_deck

_SOLID = {"CTETRA": {4: "tetra", 10: "tetra10"}, "CHEXA": {8: "hexahedron", 20: "hexahedron20"},
          "CPENTA": {6: "wedge", 15: "wedge15"}, "CPYRAM": {5: "pyramid", 13: "pyramid13"}}
_SOLID["CPYRA"] = _SOLID["CPYRAM"]
_SHELL = {"CTRIA3": {3: "triangle"}, "CTRIAR": {3: "triangle"}, "CTRIA6": {6: "triangle6"},
          "CQUAD4": {4: "quad"}, "CQUADR": {4: "quad"}, "CQUAD8": {8: "quad8"}}
_ELEMENTS = {**_SOLID, **_SHELL}
# Nastran goes from the lower ring of edges to the upright ones, then to the upper ring.
_ORDER = {"hexahedron20": (*range(12), 16, 17, 18, 19, 12, 13, 14, 15), "wedge15": (*range(9), 12, 13, 14, 9, 10, 11)}
# They join nodes. RBE3 spreads a load, PLOTEL is a picture: nothing is lost with them.
_RIGID = re.compile(r"RBE[12]|RBAR|RROD|RTRPLT|RSPLINE|RJOINT|RSSCON|GENEL")
# Cards that begin with C and are no elements: coordinate systems, aerodynamics, heat, cyclic symmetry, control.
_NO_ELEMENT = re.compile(r"CORD\d|CAERO|CHBDY|CONV|CREEP|CY(AX|JOIN|SUP|SYM)|CLOAD|CMARPC|CSSCHD|CONT|CBARAO|CBUTT|CMETHOD|CSET|CAMPBLL|CSUP")
# What no case control holds.
_BULK = re.compile(r"(?:GRID|C(?:TETRA|HEXA|PENTA|PYRAM?|TRIA[36R]|QUAD[48R]))(?:[\s*,]|$)", re.I)
_NAMES = re.compile(r'\$\s*(?:HM(?:NAME|SET)\s+(?:(PROP|COMP)\s+)?(\d+)\s*(?:\d+\s*)?"([^"]+)"|'
                    r"Femap.*Property\s+(\d+)\s*:\s*(.+))", re.I)


def read(path: str) -> Content:
    """A Content. Raises Refused with file and line."""
    deck = _Deck(path)
    lines = deck.noted(_lines(path, os.path.dirname(os.path.abspath(path)), (), deck))
    head = []  # up to the bulk data, or the first of it where no line says that it begins
    for place, text in lines:
        head.append((place, text))
        deck.has_case_control = re.match(r"BEGIN\s+BULK\b", text, re.I) is not None
        if deck.has_case_control or _BULK.match(text):
            break
    for place, text in _statements(head if deck.has_case_control else []):
        deck.take_case(place, text)
    for place, words in _cards(itertools.chain([] if deck.has_case_control else head, lines)):
        try:
            deck.take(place, words)
        except Refused:
            deck.refuse_cut_off()  # which may be why
            raise
    deck.refuse_cut_off()
    return deck.content()


def _lines(path: str, folder: str, above: tuple[str, ...], deck: _Deck) -> Iterator[tuple[str, str]]:
    """Pairs (place, text) of a file and what it includes; comments go to the deck, which looks for names in them."""
    with open_deck(path, above, "INCLUDE") as file:
        for number, line in enumerate(file, 1):
            text = line.split("$", 1)[0].expandtabs(8).rstrip()
            if "$" in line:
                deck.take_comment(line)
            if re.match(r"\s*ENDDATA\b", text, re.I):
                deck.is_ended = not above
                return
            if re.match(r"INCLUDE\b", text, re.I):
                name = text[7:].strip().strip("'\"")
                yield from _lines(os.path.join(folder, name), folder, (*above, f"{path}:{number}"), deck)
            elif text:
                yield f"{path}:{number}", text


def _statements(lines: Iterable[tuple[str, str]]) -> Iterator[tuple[str, str]]:
    """Case control: a line that ends with a comma goes on."""
    begun = None
    for place, text in lines:
        place, text = (begun[0], begun[1] + text.strip()) if begun else (place, text.strip())
        begun = (place, text) if text.endswith(",") else None
        if not begun:
            yield place, text


def _fields(text: str) -> tuple[str, list[str]]:
    """The first field, and the 8 (of long ones 4) that follow it on a line."""
    if "," in text:
        name, *words = [word.strip() for word in text.split(",")]
        n = 4 if "*" in name else 8
        words = words[:n]
    else:
        n = 4 if "*" in text[:8] else 8
        name, words = text[:8].strip(), [text[i:i + 64 // n].strip() for i in range(8, min(len(text), 72), 64 // n)]
    return name.rstrip("*").upper(), words + [""] * (n - len(words))


def _cards(lines: Iterable[tuple[str, str]]) -> Iterator[tuple[str, list[str]]]:
    """Pairs (place, words) of bulk data. Lines that begin with +, * or nothing belong to the one before."""
    card = None
    for place, text in lines:
        name, words = _fields(text)
        if card and (name == "" or text[0] in "+*"):
            card[1].extend(words)
            continue
        if card:
            yield card
        card = (place, [name, *words])
    if card:
        yield card


def _whole(place: str, words: Sequence[str], index: int, what: str) -> int:
    word = words[index] if index < len(words) else ""
    require(word.isdigit(), f'{place}: {words[0]}: expected {what}, a whole number, found "{word}"')
    return int(word)


def _real(place: str, word: str) -> float:
    """Nastran may leave the E out: 1.5-3."""
    exponential = re.sub(r"(?<=[\d.])(?=[+-])", "E", word.upper().replace("D", "E"))
    try:
        return float(exponential or "0")
    except ValueError:
        raise Refused(f'{place}: expected a number, found "{word}"') from None


def _listed(place: str, words: Sequence[str]) -> np.ndarray:
    """Numbers of a list with THRU, BY and EXCEPT."""
    words = [word for word in words if word]
    numbers, without, i = [], False, 0
    while i < len(words):
        if words[i].upper() == "EXCEPT":
            without = True
            i += 1
            continue
        through = i + 2 < len(words) and words[i + 1].upper() == "THRU"
        by = through and i + 4 < len(words) and words[i + 3].upper() == "BY"
        step = int(words[i + 4]) if by and words[i + 4].isdigit() else 1
        ends = [words[i], words[i + 2]] if through else [words[i], words[i]]
        require(all(end.isdigit() for end in ends) and int(ends[1]) - int(ends[0]) <= 10**8,
                f'{place}: expected whole numbers, or "first THRU last", found "{" ".join(words[i:i + 3])[:40]}"')
        part = range(int(ends[0]), int(ends[1]) + 1, max(step, 1))
        numbers = [n for n in numbers if n not in part] if without else [*numbers, *part]
        i += 5 if by else 3 if through else 1
    return np.unique(np.array(numbers, dtype=np.int64))


class _Deck:
    def __init__(self, path: str) -> None:
        self.path = path
        self.is_ended = False   # by ENDDATA
        self.is_read = False    # to its last line
        self.last_place = None  # of the lines so far
        self.has_grid = False
        self.nodes, self.coordinates, self.turned = [], [], []
        self.turned_by_default, self.all_turned = [], False  # as GRDSET says
        self.places = {"node": {}, "element": {}}  # of each number
        self.elements = {}      # type → rows of element number and nodes
        self.properties = {}    # property → element numbers
        self.node_lists = {}    # kind and number → [(place, node numbers)]
        self.pressed = {}       # name → [(place, element, corner nodes on the face, corner node off it)]
        self.property_names, self.set_names = {}, {}
        self.left_out = []
        self.has_case_control = False
        self.selected = set()   # of MPC in case control, "K2GG" and its like for matrices
        self.constraints = []   # place, name and set of MPC and MPCADD; of DMIG its matrix
        self.methods = set()    # of METHOD in case control
        self.eigrl = {}         # its number → (V1, V2, ND) as written

    def noted(self, lines: Iterable[tuple[str, str]]) -> Iterator[tuple[str, str]]:
        """The same lines, and how far they are read."""
        for place, text in lines:
            self.last_place = place
            yield place, text
        self.is_read = True

    def refuse_cut_off(self) -> None:
        """Nothing but ENDDATA tells the end of a deck from where it was cut off."""
        if self.is_read and not self.is_ended and self.has_grid:
            raise Refused(f"{self.last_place}: {self.path} ends here without an ENDDATA of its own: it seems to be cut off. Copy it "
                          "once more; if it is whole, add a last line ENDDATA")

    def _note(self, kind: str, number: int, place: str) -> None:
        """At once: where one stands twice, hundreds of megabytes of it may follow."""
        before = self.places[kind].setdefault(number, place)
        require(before is place, f"{self.path}: {kind} {number} stands twice, at {before} and {place}; take one out")

    def take_comment(self, line: str) -> None:
        found = _NAMES.search(line)
        if found and found[3]:
            names = self.set_names if not found[1] else self.property_names if found[1].upper() == "PROP" else {}
            names[int(found[2])] = found[3].strip()
        elif found:
            self.property_names[int(found[4])] = found[5].strip()

    def take_case(self, place: str, text: str) -> None:
        found = re.match(r"SET\s+(\d+)\s*=\s*(.*)", text, re.I)
        if found and found[2].strip().upper() != "ALL":
            self._hold("SET", place, int(found[1]), _listed(place, re.split(r"[,\s]+", found[2].strip())))
        method = re.match(r"METH[A-Z]*(?:\s*\(.*\))?\s*=\s*(\d+)", text, re.I)
        if method:
            self.methods.add(int(method[1]))
        chosen = re.match(r"(?:MPC|[KMB]2(?:GG|PP))\s*=\s*(\w+)", text, re.I)
        if chosen:
            self.selected.add(chosen[1].upper())

    def take(self, place: str, words: Sequence[str]) -> None:
        name = words[0]
        if name == "GRID":
            self._take_node(place, words)
        elif name == "GRDSET":
            self._take_default(place, words)
        elif name in _ELEMENTS:
            self._take_element(place, words)
        elif name == "SPC1":
            self._hold("SPC", place, _whole(place, words, 1, "its set"), _listed(place, words[3:]))
        elif name == "SPC":
            nodes = [_whole(place, words, i, "a node") for i in (2, 5) if i < len(words) and words[i]]
            self._hold("SPC", place, _whole(place, words, 1, "its set"), np.array(nodes, dtype=np.int64))
        elif name == "SET1" or name == "SET" and words[2:3] == ["GRID"]:
            self._hold("SET", place, _whole(place, words, 1, "its number"), _listed(place, words[2 if name == "SET1" else 9:]))
        elif name == "PLOAD4":
            self._take_pressure(place, words)
        elif name in ("MPC", "MPCADD", "DMIG"):
            self.constraints.append((place, name, words[1].upper()))
        elif name.startswith("="):
            raise Refused(f"{place}: {words[0]}: cards that repeat the one before are not followed; write them out")
        elif name == "EIGRL":
            self.eigrl[words[1]] = words[2:5]
        else:
            is_element = re.fullmatch(r"C[A-Z]+\d*[A-Z]*", name) and not _NO_ELEMENT.match(name)
            if is_element or _RIGID.match(name):
                leave_out(self.left_out, place, name, f"bodies are {', '.join(list(_SOLID)[:4])}, shells on them name faces; take "
                                                      "it out of the file")

    def _hold(self, kind: str, place: str, number: int, nodes: np.ndarray) -> None:
        self.node_lists.setdefault((kind, number), []).append((place, nodes))

    def _take_node(self, place: str, words: Sequence[str]) -> None:
        self.has_grid = True
        number = _whole(place, words, 1, "its number")
        require(words[2] in ("", "0"),
                f"{place}: GRID {number} lies in coordinate system {words[2]}; write the mesh out in the basic system")
        self.nodes.append(number)
        self._note("node", number, place)
        axes = (words[6:7] or [""])[0]
        if not axes:
            self.turned_by_default.append(number)
        elif axes != "0":
            self.turned.append(number)
        self.coordinates.append([_real(place, word) for word in words[3:6]])

    def _take_default(self, place: str, words: Sequence[str]) -> None:
        """What GRID leaves empty."""
        require(words[2] in ("", "0"),
                f"{place}: GRDSET puts nodes into coordinate system {words[2]}; write the mesh out in the basic system")
        self.all_turned = (words[6:7] or [""])[0] not in ("", "0")

    def _take_element(self, place: str, words: Sequence[str]) -> None:
        number = _whole(place, words, 1, "its number")
        nodes = [word for word in words[3:] if word]
        kind = _ELEMENTS[words[0]]
        if words[0] in _SHELL:
            nodes = nodes[:max(n for n in kind)]  # thicknesses and angles follow
        require(len(nodes) in kind and all(word.isdigit() for word in nodes),
                f"{place}: {words[0]} {number} has {counted(len(nodes), 'node', 'nodes')}; expected {' or '.join(map(str, kind))}, all of one "
                "order and none left out")
        own = kind[len(nodes)]
        nodes = [int(word) for word in nodes]
        self._note("element", number, place)
        self.elements.setdefault(own, []).append([number, *(nodes[i] for i in _ORDER.get(own, range(len(nodes))))])
        self.properties.setdefault(int(words[2] or number), []).append(number)

    def _take_pressure(self, place: str, words: Sequence[str]) -> None:
        """The face of a solid is told by a corner on it and the opposite one, of a tetrahedron by the corner off it."""
        if words[7].upper() == "THRU" or not words[7]:
            return  # of shells, or of all faces of none in particular
        name = _whole(place, words, 1, "its set")
        corners = [_whole(place, words, i, "a corner") for i in (7, 8) if words[i]]
        self.pressed.setdefault(name, []).append((place, _whole(place, words, 2, "an element"), corners))

    def content(self) -> Content:
        require(self.nodes, f"{self.path}: no GRID in it: is it bulk data of Nastran?")
        for place, name, chosen in self.constraints:
            if chosen in self.selected or (name != "DMIG" and not self.has_case_control):
                leave_out(self.left_out, place, name, "take it out of the file")
        blocks = blocks_of(self.elements)
        require(blocks, f"{self.path}: no solid elements in it; bodies may be {', '.join(list(_SOLID)[:4])}")
        content = Content(np.array(self.nodes), np.array(self.coordinates), blocks, left_out=self.left_out,
                          turned_nodes=tuple(self.turned + self.turned_by_default * self.all_turned), modes_asked=self._modes_asked(),
                          places_of=lambda kind, wanted: [place for place in [self.places[kind].get(wanted)] if place])
        for number, elements in self.properties.items():
            content.element_sets[self.property_names.get(number, f"PID {number}")] = np.array(elements)
        self._name_nodes(content)
        for number, faces in self.pressed.items():
            content.surfaces[f"PLOAD4 {number}"] = _pressed_faces(content, faces)
        return content

    def _modes_asked(self) -> Optional[int]:
        """ND of the one EIGRL that is used, where no highest frequency V2 may make them fewer."""
        used = [asked for number, asked in self.eigrl.items() if not self.methods or number in map(str, self.methods)]
        if len(used) != 1:
            return None
        _, highest, count = used[0]
        return int(count) if count.isdigit() and not highest else None

    def _name_nodes(self, content: Content) -> None:
        for (kind, number), parts in self.node_lists.items():
            nodes = np.unique(np.concatenate([numbers for _, numbers in parts]))
            known = np.isin(nodes, content.node_numbers)
            if kind == "SPC":
                content.node_sets[f"SPC {number}"] = nodes
            elif known.all() and len(nodes):  # else it is a set of elements, or of something else
                for place, numbers in parts[1:]:
                    require(np.array_equal(np.unique(numbers), np.unique(parts[0][1])),
                            f"{place}: SET {number} is there already with other nodes, at {parts[0][0]}; renumber one")
                content.node_sets[self.set_names.get(number, f"SET {number}")] = nodes


def _pressed_faces(content: Content, faces: Sequence[tuple[str, int, list[int]]]) -> np.ndarray:
    rows = {}
    for block in content.blocks:
        rows.update((int(number), (block, row)) for row, number in enumerate(block.numbers))
    found = []
    for place, element, corners in faces:
        require(element in rows, f"{place}: PLOAD4: no element {element}")
        block, row = rows[element]
        nodes = block.nodes[row]
        off = corners[1:] if block.type.startswith("tetra") else []
        on = corners[:1] if off else corners
        matching = [i for i, face in enumerate(TYPES[block.type].faces)
                    if all(node in nodes[list(face)] for node in on) and not any(node in nodes[list(face)] for node in off)
                    and (off or len(on) > 1 or len(face) == 3)]
        require(len(matching) == 1, f"{place}: PLOAD4: the corners {corners} do not tell a face of element {element}")
        found.append((element, matching[0]))
    return np.array(found, dtype=np.int64)
