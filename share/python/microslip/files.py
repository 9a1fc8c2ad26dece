"""Files of a run folder, read with care: whatever is missing or damaged is named by file, line and column."""

from __future__ import annotations

import contextlib
import csv
import errno
import fcntl
import json
import math
import os
import re
from typing import Any, Iterator, Mapping, Optional, Sequence

import numpy as np

from microslip.tables import package

MARKS = ("", "peak", "fold", "optimum", "flat")
MAY_LACK = ("amplitude_slope_m_per_Hz", "phase_slope_deg_per_Hz")  # an empty cell is NaN
AGAIN = "the file is damaged; run the scene again"
NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
MORE_ROOM = "check free space and limits of file size (ulimit -f)"


class RunError(Exception):
    """A file of a run is missing, cut off or not what the program wrote, or lacks what is asked: the message says it."""


class RoomError(RunError, OSError):
    """What is drawn of a run has no room: a full disk, a limit of file size."""


def shown(path: str) -> str:
    """A file of the run as messages call it: with the folder it stands in."""
    return os.path.join(*path.split(os.sep)[-2:])


def is_held(folder: str) -> bool:
    """Whether a run is writing there, on this machine: it keeps its lock as long as it lives."""
    try:
        with open(os.path.join(folder, ".lock"), "rb") as lock:
            fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:  # no lock, or one that cannot be asked
        return False
    return False


def read_summary(path: str) -> dict[str, Any]:
    """summary.json, with what runs of older versions left unsaid."""
    try:
        with open(path, encoding="utf-8") as file:
            summary = json.load(file)
    except (FileNotFoundError, NotADirectoryError):
        raise RunError(f"{shown(path)} is missing; is this the folder of a run?") from None
    except json.JSONDecodeError as error:
        raise RunError(f"{shown(path)}:{error.lineno}:{error.colno}: cannot be read as JSON: {AGAIN}") from None
    except (OSError, ValueError):
        raise RunError(f"{shown(path)}: cannot be read as JSON: {AGAIN}") from None
    if not isinstance(summary, dict) or not isinstance(summary.get("curves"), list):
        raise RunError(f"{shown(path)}: holds no list of \"curves\": it is no summary of a run")
    for i, curve in enumerate(summary["curves"]):
        if not isinstance(curve, dict) or not {"name", "points", "complete"} <= curve.keys():
            raise RunError(f"{shown(path)}: curves[{i}] lacks its name, points or complete: {AGAIN}")
        peak = curve.get("peak")
        if not has_numbers(peak, "frequency_Hz", "amplitude_m"):
            peak = curve["peak"] = None
        curve["largest"] = peak
        if peak and peak.get("at") == "range_end":  # a peak is one that was solved for
            curve["peak"] = None
    optimum = summary.get("optimum")
    if optimum:
        summary["optimum"] = {"found": True, "parameter": "preload",
                              "value": optimum.get("preload_N"), **optimum}
        forget_what_has_no_number(summary["optimum"])
    summary["error_budget"] = told_effects(summary)
    return summary


def has_numbers(entry: Any, *keys: str) -> bool:
    return isinstance(entry, dict) and all(isinstance(entry.get(key), (int, float)) for key in keys)


def told_effects(budget: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Rows of an error budget that have a number: what is not finite is null in JSON, and tells no effect."""
    return [row for row in budget.get("error_budget") or [] if has_numbers(row, "effect")]


def forget_what_has_no_number(optimum: dict[str, Any]) -> None:
    """A best value is one that was solved for."""
    optimum["error_budget"] = told_effects(optimum)
    if optimum["found"] and not has_numbers(optimum, "value", "amplitude_m", "frequency_Hz"):
        optimum.update(found=False, message=optimum.get("message") or "its peak is not known")


def read_table(path: str, needed: Sequence[str] = ()) -> dict[str, Any]:
    """Columns of a CSV file by name: finite numbers, NaN where one may lack, `mark` and `at` as text. RunError where a row, a needed
    column or a number is missing."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            lines = csv.reader(file)
            names = next(lines, [])
            rows = [(lines.line_num, row) for row in lines if row]
    except FileNotFoundError:
        raise RunError(f"{shown(path)} is missing; run the scene again") from None
    except (OSError, UnicodeDecodeError, csv.Error):
        raise RunError(f"{shown(path)}: cannot be read as a table: {AGAIN}") from None
    for name in needed:
        if name not in names:
            raise RunError(f"{shown(path)}:1: column \"{name}\" is missing: {AGAIN}")
    for line, row in rows:
        if len(row) != len(names):
            raise RunError(f"{shown(path)}:{line}: {len(row)} values under {len(names)} column names: {AGAIN}")
    return {name: column_in([(line, row[i]) for line, row in rows], path, name)
            for i, name in enumerate(names)}


def trace_in(path: str, name: str) -> np.ndarray:
    """Parameter, frequency and amplitude of the peaks a search went over; no rows without a file."""
    if not os.path.exists(path):
        return np.empty((0, 3))
    table = read_table(path, (name, "frequency_Hz", "amplitude_m"))
    return np.column_stack([table[name], table["frequency_Hz"], table["amplitude_m"]])


def write_whole(path: str, content: bytes) -> None:
    """A file of bytes, whole or not at all. RoomError where it has no room."""
    folder, name = os.path.split(path)
    part = os.path.join(folder, f".{name}.{os.getpid()}.part")  # a run removes what a killed one leaves by this name
    try:
        with open(part, "wb") as file:
            file.write(content)
        os.replace(part, path)
    except BaseException as error:
        with contextlib.suppress(OSError):
            os.unlink(part)
        if isinstance(error, OSError) and error.errno in NO_ROOM:
            raise RoomError(f"{path}: cannot be written: {error.strerror}; {MORE_ROOM}") from None
        raise


def column_in(cells: Sequence[tuple[int, str]], path: str, name: str) -> Any:
    """The cells of one column, each with its line, as numbers or marks."""
    if name == "at":
        return [text for _, text in cells]
    if name in MAY_LACK:
        return np.array([number_in(text, path, line, name) if text else math.nan for line, text in cells])
    if name != "mark":
        return np.array([number_in(text, path, line, name) for line, text in cells])
    for line, text in cells:
        if text not in MARKS:
            raise RunError(f"{shown(path)}:{line}: mark: '{text}' is no mark: {AGAIN}")
    return [text for _, text in cells]


def number_in(text: str, path: str, line: int, name: str) -> float:
    """A finite number; RunError names the cell that holds none."""
    try:
        value = float(text)
        if math.isfinite(value):
            return value
        fault = f"'{text}' is not finite"
    except ValueError:
        fault = f"'{text}' is no number" if text.strip() else "the value is missing"
    raise RunError(f"{shown(path)}:{line}: {name}: {fault}: {AGAIN}")


@contextlib.contextmanager
def data_file(path: str) -> Iterator[Any]:
    """An HDF5 file of the run, open for reading. RunError where it, or something in it, is missing or damaged."""
    h5py = package("h5py", "curves, peaks, best value and error budget are there")
    if not os.path.exists(path):
        raise RunError(f"{shown(path)} is missing; run the scene again")
    try:
        with h5py.File(path, "r") as file:
            yield file
    except KeyError as error:
        name = re.search(r"object '([^']*)' doesn't exist", str(error))
        what = f"\"{name[1]}\" is missing in it" if name else "a part of it cannot be found"
        raise RunError(f"{shown(path)}: {what}: {AGAIN}") from None
    except (OSError, RuntimeError):
        raise RunError(f"{shown(path)}: is cut off or no HDF5 file: {AGAIN}") from None


def require_shape(path: str, name: str, values: np.ndarray, shape: Sequence[Optional[int]]) -> None:
    """RunError where an array of a data file does not have its shape."""
    if values.shape != shape:
        raise RunError(f"{shown(path)}: \"{name}\" holds {' × '.join(map(str, values.shape))} values where "
                         f"{' × '.join(map(str, shape))} belong: {AGAIN}")
