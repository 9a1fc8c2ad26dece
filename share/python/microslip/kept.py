"""What earlier runs have drawn, by what it was drawn from; in the folder of results that the program keeps."""

from __future__ import annotations

import glob
import hashlib
import os
import sys
from typing import Optional, Sequence

from microslip.files import write_whole

HEADER = b"microslip drawn\n"


def digest(*parts: bytes) -> bytes:
    """Of all parts, each apart from the next, in hexadecimal digits."""
    return hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest().encode()


def bytes_in(path: str) -> bytes:
    """The content of a file; of one that is not there nothing."""
    if not os.path.exists(path):
        return b""
    with open(path, "rb") as file:
        return file.read()


def sources_in(*drawers: str) -> bytes:
    """Digest of the modules of this package and of those in some of its folders."""
    package = os.path.dirname(os.path.abspath(__file__))
    folders = [package] + [os.path.join(package, drawer) for drawer in drawers]
    return digest(*[bytes_in(path) for folder in folders for path in sorted(glob.glob(os.path.join(glob.escape(folder), "*.py")))])


class Kept:
    """Results of one kind in a folder; without a folder nothing is found and nothing kept."""

    def __init__(self, folder: Optional[str], kind: str) -> None:
        self.folder = folder if folder and os.path.isdir(folder) else None
        self.kind = kind

    def path_of(self, inputs: bytes) -> str:
        return os.path.join(self.folder or "", f"{self.kind}-{digest(inputs)[:32].decode()}.cached")

    def find(self, inputs: bytes) -> Optional[list[bytes]]:
        """What keep() was given; None: nothing, or what is kept is damaged."""
        if not self.folder:
            return None
        path = self.path_of(inputs)
        parts = parts_of(bytes_in(path))
        if parts is not None:
            os.utime(path)  # what is used stays
        return parts

    def keep(self, inputs: bytes, parts: Sequence[bytes]) -> None:
        if not self.folder:
            return
        try:
            write_whole(self.path_of(inputs), sealed(parts))
        except OSError as error:
            print(f"{self.kind}: not kept for later runs: {error}", file=sys.stderr)


def sealed(parts: Sequence[bytes]) -> bytes:
    """Parts with their sizes, and the digest of all."""
    content = b"".join(len(part).to_bytes(8, "little") + part for part in parts)
    return HEADER + digest(content) + content


def parts_of(kept: bytes) -> Optional[list[bytes]]:
    """What sealed() was given; None where it is damaged."""
    start = len(HEADER) + 64
    content = kept[start:]
    if not kept.startswith(HEADER) or kept[len(HEADER):start] != digest(content):
        return None
    parts, at = [], 0
    while at < len(content):
        end = at + 8 + int.from_bytes(content[at:at + 8], "little")
        parts.append(content[at + 8:end])
        at = end
    return parts
