"""Figures that earlier runs have drawn: what each is drawn from, where it is kept."""

from __future__ import annotations

import glob
import json
import os
from typing import Optional

import matplotlib
import numpy as np

from microslip.files import write_whole
from microslip.kept import Kept, bytes_in, digest, sources_in
from microslip.plots.run_folder import Run

EXTENSIONS = ("svg", "png")
# What a run has taken, not what it has found: no figure shows it.
UNSEEN = ("seconds", "stages", "machine", "warnings", "message", "exit_code", "accuracy", "effects")


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
    return digest(json.dumps(seen(run.summary)).encode(), names.encode(), *map(bytes_in, tables))


def inputs_of_map(run: Run, path: str, title: object) -> bytes:
    """Of the figure of one map: its file, where its points lie, what stands above."""
    return digest(bytes_in(path), bytes_in(os.path.join(run.folder, "model.h5")), repr(title).encode())


class KeptFigures:
    """In the folder of a cache, or none."""

    def __init__(self, cache: Optional[str]) -> None:
        self.kept = Kept(cache, "plot")
        versions = f"{matplotlib.__version__} {np.__version__}".encode()
        self.drawn_by = digest(versions, sources_in("plots")) if cache else b""

    def restore(self, name: str, inputs: bytes, into: str) -> bool:
        """INTO/NAME.svg and .png as they were drawn before; False: they were not."""
        images = self.kept.find(digest(self.drawn_by, name.encode(), inputs))
        for extension, image in zip(EXTENSIONS, images or []):
            write_whole(os.path.join(into, f"{name}.{extension}"), image)
        return images is not None

    def keep(self, name: str, inputs: bytes, into: str) -> None:
        """What is drawn; a figure that a run does not have is not kept."""
        paths = [os.path.join(into, f"{name}.{extension}") for extension in EXTENSIONS]
        if all(map(os.path.exists, paths)):
            self.kept.keep(digest(self.drawn_by, name.encode(), inputs), [bytes_in(path) for path in paths])
