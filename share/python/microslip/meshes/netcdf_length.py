"""How long a classic NetCDF file has to be. The library reads zeros behind the end of one that was cut off."""

from __future__ import annotations

import math
import os
from typing import BinaryIO

from .content import Refused

_DIMENSION, _VARIABLE, _ATTRIBUTE = 10, 11, 12
_SIZES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8, 7: 1, 8: 2, 9: 4, 10: 8, 11: 8}  # bytes of a value, by type
_PADDING = 4


def require_whole(path: str) -> None:
    """Raises Refused where data are missing; says nothing of files of another kind (NetCDF 4 is HDF5, which knows its end)."""
    with open(path, "rb") as file:
        magic = file.read(4)
        if magic[:3] != b"CDF" or magic[3] not in (1, 2, 5):
            return
        try:
            expected = _Header(file, magic[3]).end_of_data()
        except (EOFError, KeyError, IndexError) as error:
            raise Refused(f"{path}: its header is cut off or damaged: write it once more") from error
    there = os.path.getsize(path)
    if there < expected:
        raise Refused(f"{path}: {there} bytes, {expected} by its header: it was cut off; copy or write it once more")


class _Header:
    """After "NetCDF Classic Format Specification". Version 1 has offsets of 4 bytes, 5 has counts of 8."""

    def __init__(self, file: BinaryIO, version: int) -> None:
        self.file = file
        self.wide = 8 if version == 5 else 4
        self.offset = 4 if version == 1 else 8

    def end_of_data(self) -> int:
        """Without the padding of what comes last."""
        n_records = self._number(self.wide)
        lengths = [self._dimension() for _ in range(self._count(_DIMENSION))]
        self._attributes()
        variables = [self._variable() for _ in range(self._count(_VARIABLE))]
        ends, records = [0], []
        for places, size, begin in variables:
            n_bytes = size * math.prod(lengths[place] for place in places if lengths[place])
            if any(lengths[place] == 0 for place in places[:1]):
                records.append((begin, n_bytes))
            else:
                ends.append(begin + n_bytes)
        streaming = n_records == 256**self.wide - 1  # as many as there are
        if records and n_records and not streaming:
            one = sum(-(-n_bytes // _PADDING) * _PADDING for _, n_bytes in records) if len(records) > 1 else records[0][1]
            ends += [begin + (n_records - 1) * one + n_bytes for begin, n_bytes in records]
        return max(ends)

    def _number(self, width: int) -> int:
        data = self.file.read(width)
        if len(data) < width:
            raise EOFError
        return int.from_bytes(data, "big")

    def _skip(self, n_bytes: int) -> None:
        if len(self.file.read(-(-n_bytes // _PADDING) * _PADDING)) < n_bytes:
            raise EOFError

    def _count(self, kind: int) -> int:
        tag, count = self._number(4), self._number(self.wide)
        if count and tag != kind:
            raise KeyError(tag)
        return count

    def _name(self) -> None:
        self._skip(self._number(self.wide))

    def _dimension(self) -> int:
        self._name()
        return self._number(self.wide)

    def _attributes(self) -> None:
        for _ in range(self._count(_ATTRIBUTE)):
            self._name()
            size = _SIZES[self._number(4)]
            self._skip(size * self._number(self.wide))

    def _variable(self) -> tuple[list[int], int, int]:
        """Its dimensions, bytes of a value, where its data begin."""
        self._name()
        places = [self._number(self.wide) for _ in range(self._number(self.wide))]
        self._attributes()
        size = _SIZES[self._number(4)]
        self._number(self.wide)  # its length, which two writers tell differently
        return places, size, self._number(self.offset)
