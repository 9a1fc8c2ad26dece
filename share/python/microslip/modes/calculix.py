"""Results of CalculiX (.frd, in text) with *FREQUENCY.

Lines begin with a key: ` -1` node and numbers, ` -3` end of a block; `    2C` coordinates; `  100CL` a set of results,
with the frequency [cycles per unit of time] and, of modes, the word MODAL; ` -4  DISP` displacements; ` 9999` end of
the file. Numbers take 12 columns from the 14th on. After: CalculiX GraphiX manual, section "Result Format".
"""

from __future__ import annotations

from typing import Iterator, TextIO

import numpy as np

from microslip.meshes.content import Refused, counted, require
from microslip.meshes.decks import open_text

from .content import Modes

_KEY, _WIDTH = 13, 12


def read(path: str) -> Modes:
    with open_text(path) as file:
        lines = _Lines(path, file)
        numbers, coordinates, frequencies, shapes, is_ended = None, None, [], [], False
        for line in lines:
            is_ended = is_ended or line.split() == ["9999"]
            if line.startswith("    2C"):
                numbers, coordinates = lines.block()
            elif line.startswith("  100CL") and "MODAL" in line:
                frequency = lines.number(line[12:24])
            elif line.startswith("  100CL"):
                frequency = None
            elif line.startswith(" -4  DISP") and frequency is not None:
                require(line.split()[1] == "DISP", f"{lines.place}: results in real and imaginary parts (cyclic symmetry, "
                                                   "complex modes) are not read")
                own, shape = lines.block()
                n_nodes = 0 if numbers is None else len(numbers)
                require(len(own) == n_nodes, f"{lines.place}: mode {len(shapes) + 1} has displacements at {counted(len(own), 'node', 'nodes')}, "
                                             f"the file has {n_nodes}; ask for all: *NODE FILE without NSET")
                require(np.array_equal(own, numbers), f"{lines.place}: mode {len(shapes) + 1} has displacements at nodes of other numbers "
                                                      "than those of the file: is it damaged?")
                frequencies.append(frequency)
                shapes.append(shape)
    require(lines.number_of_line, f"{path}: the file is empty")
    require(shapes, f"{path}: there are no modes in it (a *FREQUENCY step with *NODE FILE, U)")
    require(is_ended, f"{lines.place}: the file ends here, after mode {len(shapes)}, without its last line 9999: it is cut off; copy "
                      "it once more, or let ccx run to its end")
    return Modes(coordinates, np.array(frequencies), np.array(shapes))


class _Lines:
    def __init__(self, path: str, file: TextIO) -> None:
        self.path, self.file, self.number_of_line = path, file, 0

    @property
    def place(self) -> str:
        return f"{self.path}:{self.number_of_line}"

    def __iter__(self) -> Iterator[str]:
        for line in self.file:
            self.number_of_line += 1
            yield line

    def number(self, text: str) -> float:
        try:
            return float(text)
        except ValueError:
            raise Refused(f'{self.place}: expected a number, found "{text.strip()[:20]}"') from None

    def block(self) -> tuple[np.ndarray, np.ndarray]:
        """Node numbers and three numbers each, up to the end of the block."""
        nodes, values = [], []
        for line in self:
            key = line[:3]
            if key == " -3":
                return np.array(nodes), np.array(values)
            if key == " -1":
                nodes.append(int(self.number(line[3:_KEY])))
                values.append([self.number(line[_KEY + _WIDTH * i:_KEY + _WIDTH * (i + 1)]) for i in range(3)])
        raise Refused(f"{self.path}: the file ends in the middle of a block, at line {self.number_of_line}")
