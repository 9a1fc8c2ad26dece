"""The program `microslip` as a child process: where it is, what it is told, what it answers."""
from __future__ import annotations

import json
import os
import shutil
import subprocess
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np

Path = Union[str, "os.PathLike[str]"]
Overrides = Mapping[str, Any]


class ProgramError(Exception):
    """The program ended with an exit code above 0. str() is its message, `exit_code` the code, `folder` the run folder
    where it says one."""

    def __init__(self, message: str, exit_code: int = 5, folder: Optional[str] = None) -> None:
        super().__init__(message)
        self.exit_code = exit_code
        self.folder = folder

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (str(self), self.exit_code, self.folder)


class BadInput(ProgramError):
    """Exit code 1: the scene, or a file it names, cannot be read so."""


class Refused(ProgramError):
    """Exit code 2: refused on physical grounds."""


class Incomplete(ProgramError):
    """Exit code 3: a curve is incomplete. What is there is valid: `microslip.open(error.folder)`."""


class Exhausted(ProgramError):
    """Exit code 4: out of time, memory or disk."""


ERRORS = {1: BadInput, 2: Refused, 3: Incomplete, 4: Exhausted}


def find_program(program: Optional[Path] = None) -> str:
    """The program: as given, else the environment variable MICROSLIP, else on the PATH. BadInput where it is not."""
    asked = program or os.environ.get("MICROSLIP") or "microslip"
    found = shutil.which(os.fspath(asked))
    if found:
        return os.path.abspath(found)
    source = "program=" if program else "MICROSLIP=" if os.environ.get("MICROSLIP") else "on the PATH: "
    raise BadInput(f"{source}{asked}: no such program. Build it (README.md), then give program=\"build/bin/microslip\", "
                   "set the environment variable MICROSLIP, or put its folder on the PATH", 1)


def toml_of(value: Any) -> str:
    """A Python or NumPy value as TOML writes it. TypeError for what TOML has no word for."""
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{toml_of(str(key))} = {toml_of(item)}" for key, item in value.items()) + " }"
    if isinstance(value, Sequence):
        return "[" + ", ".join(toml_of(item) for item in value) + "]"
    raise TypeError(f"{value!r}: a scene holds numbers, texts, truth values, lists and tables")


def settings_of(overrides: Optional[Overrides]) -> list[str]:
    """Options --set of the program; None takes the key away."""
    words = []
    for key, value in (overrides or {}).items():
        words += ["--set", f"{key}={'' if value is None else toml_of(value)}"]
    return words


def answer_of(output: str) -> dict[str, Any]:
    """The object --json leaves in the last line; empty where the program was ended before it could write one."""
    try:
        answer = json.loads((output.strip().splitlines() or [""])[-1])
    except ValueError:
        return {}
    return answer if isinstance(answer, dict) else {}


def failure_of(code: int, answer: Mapping[str, Any], diagnostics: str) -> ProgramError:
    """What an exit code above 0 means, in the program's words."""
    message = answer.get("message") or "\n".join(f"{curve['name']}: {curve['diagnosis']}"
                                                 for curve in answer.get("curves", ()) if not curve["complete"])
    if not message:
        ended = f"the program was ended by signal {-code}" if code < 0 else f"the program ended with exit code {code}"
        message = diagnostics.strip() or ended
    return ERRORS.get(code, ProgramError)(message, code, answer.get("output"))


class Call:
    """One call of the program; ends with it, whatever ends the wait."""

    def __init__(self, words: Sequence[str], *, program: Optional[Path] = None, show: bool = False,
                 environment: Optional[Mapping[str, str]] = None) -> None:
        """show: progress and warnings go to standard error as they come."""
        self.process = subprocess.Popen(
            [find_program(program), *words, "--json"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
            stderr=None if show else subprocess.PIPE, encoding="utf-8", errors="replace",
            env={**os.environ, **(environment or {})})

    def answer(self) -> dict[str, Any]:
        """What the program answers, once it has ended. ProgramError where it failed."""
        try:
            output, diagnostics = self.process.communicate()
        except BaseException:  # an interrupt: the program ends within a second, its folder in order
            self.end()
            raise
        answer = answer_of(output)
        if self.process.returncode:
            raise failure_of(self.process.returncode, answer, diagnostics or "")
        return answer

    def end(self) -> None:
        self.process.terminate()
        self.process.wait()


def words_of(scene: Path, overrides: Optional[Overrides], folder: Optional[Path], jobs: Optional[int], resume: bool,
             without: Sequence[str]) -> list[str]:
    """The command line of a run."""
    words = ["run", os.fspath(scene), *settings_of(overrides)]
    words += [] if folder is None else ["-o", os.fspath(folder)]
    words += [] if jobs is None else ["-j", str(jobs)]
    words += ["--resume"] if resume else []
    return words + [word for part in without for word in ("--without", part)]
