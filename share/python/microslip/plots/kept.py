"""Figures that earlier runs have drawn, by what they were drawn from; in the folder of results that the program keeps."""

from __future__ import annotations

import glob
import hashlib
import json
import os
import sys
from typing import Iterator, Optional

import matplotlib
import numpy as np

from microslip.files import write_whole
from microslip.plots.run_folder import Run

EXTENSIONS = ("svg", "png")
HEADER = b"microslip plot\n"
# What a run has taken, not what it has found: no figure shows it.
UNSEEN = ("seconds", "stages", "machine", "warnings", "message", "exit_code", "accuracy", "effects")


def digest(*parts: bytes) -> str:
    """Of all parts, each apart from the next."""
    return hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()


def bytes_in(path: str) -> bytes:
    """The content of a file; of one that is not there nothing."""
    if not os.path.exists(path):
        return b""
    with open(path, "rb") as file:
        return file.read()


def who_draws() -> bytes:
    """The sources of this package and the versions of what it draws with."""
    plots = os.path.dirname(os.path.abspath(__file__))
    sources = sorted(path for folder in (plots, os.path.dirname(plots))
                     for path in glob.glob(os.path.join(glob.escape(folder), "*.py")))
    return digest(f"{matplotlib.__version__} {np.__version__}".encode(), *map(bytes_in, sources)).encode()


def seen(summary: object) -> object:
    """A summary without what no figure shows."""
    if isinstance(summary, dict):
        return {key: seen(value) for key, value in summary.items() if key not in UNSEEN}
    return [seen(value) for value in summary] if isinstance(summary, list) else summary


def inputs_of_run(run: Run) -> bytes:
    """Of the figures of all curves: the summary and every table."""
    tables = sorted(glob.glob(os.path.join(glob.escape(run.folder), "curves", "*.csv"))
                    + glob.glob(os.path.join(glob.escape(run.folder), "peak_against_*.csv")))
    names = "\n".join(map(os.path.basename, tables))
    return digest(json.dumps(seen(run.summary)).encode(), names.encode(), *map(bytes_in, tables)).encode()


def inputs_of_map(run: Run, path: str, title: str) -> bytes:
    """Of the figure of one map: its file, where its points lie, what stands above."""
    return digest(bytes_in(path), bytes_in(os.path.join(run.folder, "model.h5")), title.encode()).encode()


class KeptFigures:
    """The folder; without one nothing is found and nothing kept."""

    def __init__(self, folder: Optional[str]) -> None:
        self.folder = folder if folder and os.path.isdir(folder) else None
        self.drawn_by = who_draws() if self.folder else b""

    def path_of(self, name: str, inputs: bytes) -> str:
        return os.path.join(self.folder or "", f"plot-{digest(self.drawn_by, name.encode(), inputs)[:32]}.cached")

    def restore(self, name: str, inputs: bytes, into: str) -> bool:
        """INTO/NAME.svg and .png as they were drawn before; False: they were not, or what is kept is damaged."""
        if not self.folder:
            return False
        path = self.path_of(name, inputs)
        images = images_of(bytes_in(path))
        if images is None:
            return False
        os.utime(path)  # what is used stays
        for extension, image in zip(EXTENSIONS, images):
            write_whole(os.path.join(into, f"{name}.{extension}"), image)
        return True

    def keep(self, name: str, inputs: bytes, into: str) -> None:
        """What is drawn; a figure that a run does not have is not kept."""
        paths = [os.path.join(into, f"{name}.{extension}") for extension in EXTENSIONS]
        if not self.folder or not all(map(os.path.exists, paths)):
            return
        try:
            write_whole(self.path_of(name, inputs), sealed(map(bytes_in, paths)))
        except OSError as error:
            print(f"plot {name}: not kept for later runs: {error}", file=sys.stderr)


def sealed(images: Iterator[bytes]) -> bytes:
    """Images with their sizes, and the digest of all."""
    content = b"".join(len(image).to_bytes(8, "little") + image for image in images)
    return HEADER + digest(content).encode() + content


def images_of(kept: bytes) -> Optional[list[bytes]]:
    """What sealed() was given; None where it is damaged."""
    start = len(HEADER) + 64
    content = kept[start:]
    if not kept.startswith(HEADER) or kept[len(HEADER):start] != digest(content).encode():
        return None
    images = []
    while content:
        size = int.from_bytes(content[:8], "little")
        images.append(content[8:8 + size])
        content = content[8 + size:]
    return images
