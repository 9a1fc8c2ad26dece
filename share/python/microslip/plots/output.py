"""Figures to files, several at a time."""

from __future__ import annotations

import io
import os
import sys
import traceback
from typing import TYPE_CHECKING, Callable, Sequence

from microslip.files import MORE_ROOM, RoomError, RunError, write_whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure

EXHAUSTED = 4  # exit code, as of the program
# Neither the day nor the version of a library: the same run gives the same files.
METADATA = {"svg": {"Date": None}, "png": {"Software": None}}


def settle(figure: Figure) -> None:
    """Gives texts that are empty a place; else it is searched for in each pass, a third of the time of a figure."""
    for axes in figure.axes + [child for axes in figure.axes for child in axes.child_axes]:
        for axis in (axes.xaxis, axes.yaxis):
            if not axis.get_label_text():
                axis.set_label_coords(0.0, 0.0)
        if not any(axes.get_title(loc) for loc in ("left", "center", "right")):
            axes.set_title("", y=1.0)


def save(figure: Figure, folder: str, name: str) -> None:
    """FOLDER/NAME.svg and .png, each whole or not at all."""
    settle(figure)
    figure.get_layout_engine().execute(figure)
    figure.set_layout_engine(None)  # the layout is found; finding it again takes half of the time
    for extension, metadata in METADATA.items():
        buffer = io.BytesIO()
        figure.savefig(buffer, format=extension, metadata=metadata)
        path = os.path.join(folder, f"{name}.{extension}")
        write_whole(path, buffer.getvalue())


def save_as(figure: Figure, path: str) -> None:
    """One file in the format its name says."""
    figure.savefig(path, metadata=METADATA.get(os.path.splitext(path)[1][1:].lower()))


def run_shared(tasks: Sequence[Callable[[], object]]) -> bool:
    """Shares the figures out to as many processes as there are cores. Plain forks: they end by
    themselves whatever happens to this process. False when one of them failed (it has said why); RoomError where a
    figure had no room."""
    n_processes = min(len(os.sched_getaffinity(0)), len(tasks))
    children = []
    for first in range(n_processes):
        child = os.fork()
        if child == 0:
            code = 1
            try:
                for task in tasks[first::n_processes]:
                    task()
                code = 0
            except RunError as damage:
                print(damage, file=sys.stderr, flush=True)
                code = EXHAUSTED if isinstance(damage, RoomError) else 1
            except BaseException:
                traceback.print_exc()
            os._exit(code)
        children.append(child)
    codes = [os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) for child in children]
    if EXHAUSTED in codes:
        raise RoomError(f"not every figure can be written; {MORE_ROOM}")
    return not any(codes)
