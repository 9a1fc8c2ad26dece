"""Modes as a table (.csv): one row for each node of each mode, columns mode, frequency_Hz, x, y, z, ux, uy, uz and any
others, in any order; what a script writes that walks through the frames of an Abaqus .odb. Lines that begin with # are
comments, but for one with these names, as numpy.savetxt writes it."""

from __future__ import annotations

import csv
from typing import Iterator, Sequence

import numpy as np

from microslip.meshes.content import Refused, counted, require

from .content import Modes

_COLUMNS = ("mode", "frequency_Hz", "x", "y", "z", "ux", "uy", "uz")


def read(path: str) -> Modes:
    with open(path, encoding="utf-8-sig", errors="replace", newline="") as file:
        rows = csv.reader(file)
        header = _header(rows)
        for name in _COLUMNS:
            require(name in header, f'{path}:{rows.line_num}: column "{name}" is missing; there are: {", ".join(header) or "none"}')
        places = [header.index(name) for name in _COLUMNS]
        table = np.array([_numbers(path, rows.line_num, row, header, places) for row in rows if row and not _is_comment(row)])
    require(len(table), f"{path}: there are no rows in it")
    modes, starts = np.unique(table[:, 0], return_index=True)
    blocks = [table[table[:, 0] == mode] for mode in modes]
    for mode, block in zip(modes, blocks):
        require(len(block) == len(blocks[0]) or mode != table[-1, 0],
                f"{path}: mode {mode:g}, the last one, has {len(block)} rows, mode {modes[0]:g} has {len(blocks[0])}: the table was cut "
                "off, or more nodes were written of one of them")
        require(np.array_equal(block[:, 2:5], blocks[0][:, 2:5]),
                f"{path}: mode {mode:g} has other nodes than mode {modes[0]:g}, or in another order")
        require(np.ptp(block[:, 1]) == 0.0, f"{path}: mode {mode:g} has several frequencies")
    return Modes(blocks[0][:, 2:5], table[starts, 1], np.array([block[:, 5:8] for block in blocks]))


def _is_comment(row: Sequence[str]) -> bool:
    return bool(row) and row[0].lstrip().startswith("#")


def _header(rows: Iterator[Sequence[str]]) -> list[str]:
    for row in rows:
        names = [name.strip().lstrip("#").strip() for name in row]
        if row and (not _is_comment(row) or set(_COLUMNS) <= set(names)):
            return names
    return []


def _numbers(path: str, line: int, row: Sequence[str], header: Sequence[str], places: Sequence[int]) -> list[float]:
    require(len(row) == len(header), f"{path}:{line}: {counted(len(row), 'cell', 'cells')}, the header has {len(header)}")
    try:
        return [float(row[place]) for place in places]
    except ValueError as error:
        raise Refused(f"{path}:{line}: expected numbers: {error}") from None
