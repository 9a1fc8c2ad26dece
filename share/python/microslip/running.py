"""Runs and sweeps: the program called once, or once for every combination of values, several at a time."""
from __future__ import annotations

import concurrent.futures
import dataclasses
import itertools
import os
import sys
import tempfile
import threading
from typing import Any, Iterable, Iterator, Mapping, Optional, Sequence

from microslip.files import RunError
from microslip.program import Call, Exhausted, Incomplete, Overrides, Path, ProgramError, find_program, words_of
from microslip.results import Run, peak_row
from microslip.tables import Table, table_of

ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}


def run(scene: Path, overrides: Optional[Overrides] = None, *, folder: Optional[Path] = None,
        jobs: Optional[int] = None, resume: bool = False, without: Sequence[str] = (), show: bool = False,
        program: Optional[Path] = None) -> Run:
    """Solves a scene: `microslip run SCENE`.

    overrides  values by key, {"contact.friction_coefficient": 0.3}; None takes a key away.
    folder     of the run; runs/SCENE where not given.
    jobs       curves at the same time; all cores where not given.
    without    parts to leave out: "plots", "maps", "bracket".
    show       progress goes to standard error.
    program    the program; else the environment variable MICROSLIP, else the PATH.

    Raises ProgramError, by exit code BadInput, Refused, Incomplete or Exhausted, with the program's message.
    """
    words = words_of(scene, overrides, folder, jobs, resume, without)
    return Run(Call(words, program=program, show=show).answer()["output"])


@dataclasses.dataclass
class Point:
    """One run of a sweep: the values it had, its folder, and how it ended. `run` is None where it left nothing."""

    values: Mapping[str, Any]
    folder: str
    run: Optional[Run] = None
    error: Optional[Exception] = None


class Sweep(Sequence[Point]):
    """The points of a sweep, in the order of the values, the last key fastest."""

    def __init__(self, points: Sequence[Point]) -> None:
        self.points = list(points)

    def __getitem__(self, i: Any) -> Any:
        return self.points[i]

    def __len__(self) -> int:
        return len(self.points)

    def __iter__(self) -> Iterator[Point]:
        return iter(self.points)

    def __repr__(self) -> str:
        return f"<Sweep: {len(self)} runs, {len(self.failed)} failed>"

    @property
    def failed(self) -> list[Point]:
        """Those that did not end well; point.error carries the program's message."""
        return [point for point in self if point.error]

    @property
    def peaks(self) -> Table:
        """One row per run and curve: the swept values, then the columns of Run.peaks."""
        return table_of([{**point.values, **peak_row(curve.summary)}
                         for point in self if point.run for curve in point.run.curves.values()])

    def frame(self) -> Any:
        """`peaks` as pandas has it."""
        return self.peaks.frame()


class Bar:
    """A line of progress on standard error: redrawn on a terminal, a line per run elsewhere; silent where not asked."""

    def __init__(self, n: int, shown: bool) -> None:
        self.n, self.done, self.failed, self.shown = n, 0, 0, shown
        self.again = sys.stderr.isatty() or "ipykernel" in sys.modules

    def step(self, point: Point) -> None:
        self.done += 1
        self.failed += point.error is not None
        if not self.shown:
            return
        width = 30
        filled = width * self.done // self.n
        text = f"sweep [{'#' * filled}{'.' * (width - filled)}] {self.done}/{self.n}"
        text += f", {self.failed} failed" if self.failed else ""
        end = "" if self.again and self.done < self.n else "\n"
        print(("\r" if self.again else "") + text, end=end, file=sys.stderr, flush=True)


class Sweeping:
    """The runs that go on, so that an interrupt ends them all."""

    def __init__(self, program: str, scene: Path, overrides: Overrides, without: Sequence[str]) -> None:
        self.program, self.scene, self.overrides, self.without = program, scene, overrides, without
        self.lock, self.stopped = threading.Lock(), False
        self.calls: set[Call] = set()

    def solve(self, point: Point) -> Point:
        """Runs a point on one core. What goes wrong is kept in it: the others go on."""
        words = words_of(self.scene, {**self.overrides, **point.values}, point.folder, 1, False, self.without)
        with self.lock:
            if self.stopped:
                return point
            call = Call(words, program=self.program, environment=ONE_THREAD)
            self.calls.add(call)
        try:
            call.answer()
        except ProgramError as error:
            point.error = error
        finally:
            self.calls.discard(call)
        try:
            if point.error is None or isinstance(point.error, (Incomplete, Exhausted)):
                point.run = Run(point.folder)
        except RunError as error:
            point.error = point.error or error
        return point

    def stop(self) -> None:
        with self.lock:
            self.stopped = True
            calls = list(self.calls)
        for call in calls:
            call.process.terminate()


def sweep(scene: Path, values: Mapping[str, Sequence[Any]], *, overrides: Optional[Overrides] = None,
          folder: Optional[Path] = None, jobs: Optional[int] = None, without: Sequence[str] = ("plots", "maps", "bracket"),
          progress: bool = True, program: Optional[Path] = None) -> Sweep:
    """Solves a scene for every combination of values, `jobs` runs at a time (all cores where not given).

        sweep("blade.toml", {"contact.friction_coefficient": [0.2, 0.3, 0.4]})

    overrides hold for all runs. folder takes run_000, run_001, …; a temporary one where not given. A run that fails
    leaves its message in point.error and the others go on. ProgramError only where the program is not found, ValueError
    where a key has one value in place of a list. without=[] has pictures, maps and bracket as well, which a sweep leaves out.
    """
    for key, several in values.items():
        if isinstance(several, str) or not isinstance(several, Iterable):
            raise ValueError(f"values of {key}: expected a list, found {several!r}; what holds for all runs belongs to overrides=")
    found = find_program(program)
    place = tempfile.mkdtemp(prefix="microslip_sweep_") if folder is None else os.path.abspath(os.fspath(folder))
    chosen = [dict(zip(values, combination)) for combination in itertools.product(*values.values())]
    points = [Point(chosen_values, os.path.join(place, f"run_{i:03d}")) for i, chosen_values in enumerate(chosen)]
    sweeping = Sweeping(found, scene, overrides or {}, without)
    bar = Bar(len(points), progress)
    with concurrent.futures.ThreadPoolExecutor(jobs or len(os.sched_getaffinity(0))) as pool:
        futures = [pool.submit(sweeping.solve, point) for point in points]
        try:
            for future in concurrent.futures.as_completed(futures):
                bar.step(future.result())
        except BaseException:
            sweeping.stop()
            raise
    return Sweep(points)
