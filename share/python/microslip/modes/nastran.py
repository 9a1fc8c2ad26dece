"""Real eigenvectors that Nastran punched (.pch, in text): VECTOR(PUNCH)=ALL in SOL 103.

Lines that begin with $ say what follows: `$EIGENVECTOR`, `$REAL OUTPUT`, `$SUBCASE ID =`, `$EIGENVALUE = λ  MODE = n`,
λ = ω². Then two lines a node: its number in 10 columns, G (a grid point) or S (a scalar one), three displacements of 18
columns each from the 19th on; `-CONT-` and three rotations. Columns 73 to 80 number the lines. Seven digits. Where the
nodes are stands in the deck alone. After: MSC Nastran, Quick Reference Guide, case control command DISPLACEMENT.
"""

from __future__ import annotations

import re
from typing import Iterator, Optional, Sequence

import numpy as np

from microslip.meshes import nastran
from microslip.meshes.content import Content, Refused, require
from microslip.meshes.decks import open_text

from .content import Modes

_FIRST, _WIDTH = 18, 18
_EIGENVALUE = re.compile(r"\$EIGENVALUE =\s*(\S+)\s+MODE =\s*(\d+)")


def read(path: str, deck: str) -> Modes:
    modes = list(_modes(path))
    require(modes, f"{path}: there are no modes in it; expected $EIGENVECTOR with $REAL OUTPUT, as VECTOR(PUNCH)=ALL gives")
    for number, mode in enumerate(modes, 1):
        require(mode.number == number, f"{mode.place}: mode {mode.number} where mode {number} is expected: one is missing, or "
                                       "there are several subcases")
        _require_same_nodes(path, number, mode.nodes, modes[0].nodes)
    squares = np.array([mode.eigenvalue for mode in modes])
    frequencies = np.sign(squares) * np.sqrt(np.abs(squares)) / (2 * np.pi)
    content = nastran.read(deck)
    _require_all(path, deck, len(modes), content.modes_asked)
    return Modes(_places(path, deck, content, modes[0].nodes), frequencies, np.array([mode.shape for mode in modes]))


def _require_same_nodes(path: str, number: int, nodes: Sequence[int], first: Sequence[int]) -> None:
    require(len(nodes) == len(first), f"{path}: mode {number} has displacements at {len(nodes)} nodes, mode 1 at {len(first)}: the file was "
                                      "cut off, or modes were asked for at different nodes")
    other = next((pair for pair in zip(nodes, first) if pair[0] != pair[1]), None)
    require(not other, f"{path}: mode {number} has displacements of node {other and other[0]} where mode 1 has those of node "
                       f"{other and other[1]}: is the file damaged?")


def _require_all(path: str, deck: str, n_modes: int, asked: Optional[int]) -> None:
    """A punch file does not say how many modes follow, and has no last line: where it was cut off between two, the deck
    alone tells."""
    require(asked is None or n_modes >= asked,
            f"{path}: {n_modes} modes are there, EIGRL of {deck} asks for {asked}: the file was cut off after mode {n_modes}; copy it "
            f"once more, or say {n_modes} in EIGRL if these are all there are")


class _Mode:
    def __init__(self, place: str, eigenvalue: float, number: int) -> None:
        self.place, self.eigenvalue, self.number = place, eigenvalue, number
        self.nodes, self.shape = [], []


def _modes(path: str) -> Iterator[_Mode]:
    mode, is_vector = None, False
    with open_text(path) as file:
        for line_number, line in enumerate(file, 1):
            place, text = f"{path}:{line_number}", line[:72].rstrip()
            if text.startswith("$TITLE"):
                if mode:
                    yield mode
                mode, is_vector = None, False
            elif text.startswith("$EIGENVECTOR"):
                is_vector = True
            elif is_vector and text.startswith("$") and "OUTPUT" in text:
                require(text == "$REAL OUTPUT", f"{place}: {text[1:].lower()}: complex modes are not read")
            elif is_vector and text.startswith("$POINT ID"):
                raise Refused(f"{place}: sorted by nodes; ask for VECTOR(SORT1,PUNCH)=ALL")
            elif is_vector and text.startswith("$EIGENVALUE"):
                found = _EIGENVALUE.match(text)
                require(found, f'{place}: expected "$EIGENVALUE = number MODE = number", found "{text[:60]}"')
                mode = _Mode(place, _number(place, found[1]), int(found[2]))
            elif mode and text and text[0] not in "$-":
                _take_node(place, text, mode)
    if mode:
        yield mode


def _take_node(place: str, text: str, mode: _Mode) -> None:
    if text[10:_FIRST].strip() == "S":
        return
    words = [text[:10], *(text[_FIRST + _WIDTH * i:_FIRST + _WIDTH * (i + 1)] for i in range(3))]
    mode.nodes.append(int(_number(place, words[0])))
    mode.shape.append([_number(place, word) for word in words[1:]])
    require(len(text) == _FIRST + 3 * _WIDTH, f"{place}: the line ends within the third displacement: was the file cut off?")


def _number(place: str, word: str) -> float:
    try:
        return float(word)
    except ValueError:
        raise Refused(f'{place}: expected a number, found "{word.strip()[:20]}": was the file cut off?') from None


def _places(path: str, deck: str, content: Content, nodes: Sequence[int]) -> np.ndarray:
    """Coordinates of nodes by their number."""
    missing = np.setdiff1d(nodes, content.node_numbers)
    require(not len(missing), f"{path}: node {next(iter(missing), None)} is not in {deck}: {len(missing)} of {len(nodes)} are missing; is it "
                              "the deck these modes were computed with?")
    turned = np.intersect1d(nodes, content.turned_nodes)
    require(not len(turned), f"{deck}: GRID {next(iter(turned), None)} tells its displacements in a coordinate system of its own (CD); "
                             "leave that field empty and compute the modes again")
    order = np.argsort(content.node_numbers)
    return content.coordinates[order[np.searchsorted(content.node_numbers[order], nodes)]]
