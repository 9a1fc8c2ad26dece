"""microslip in Python: runs the program, reads what a run has written, draws it.

    import microslip
    run = microslip.run("blade.toml", {"contact.friction_coefficient": 0.3})   # or microslip.open("runs/blade")
    run.peaks.frame()                      # pandas; run.curves["free"]["amplitude_m"] is a NumPy array
    run.plot_curves().savefig("curves.png")
    microslip.sweep("blade.toml", {"contact.friction_coefficient": [0.2, 0.3, 0.4]}).frame()

share/doc/python.md tells it all. The converters and plot scripts of the program live in the same package, and need
nothing of what is named here: it is imported when it is first asked for.
"""
from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from microslip.files import RunError
    from microslip.program import BadInput, Exhausted, Incomplete, ProgramError, Refused
    from microslip.results import ContactMap, Curve, Run, RunWarning
    from microslip.results import Run as open
    from microslip.running import Sweep, run, sweep
    from microslip.tables import MissingPackage, Table

HOME = {"run": "running", "sweep": "running", "Sweep": "running", "Run": "results", "Curve": "results",
        "ContactMap": "results", "RunWarning": "results", "RunError": "files", "Table": "tables",
        "MissingPackage": "tables", "ProgramError": "program", "BadInput": "program", "Refused": "program",
        "Incomplete": "program", "Exhausted": "program"}
__all__ = ["open", *HOME]


def __getattr__(name: str) -> Any:
    if name == "open":
        return importlib.import_module("microslip.results").Run
    if name not in HOME:
        raise AttributeError(f"module 'microslip' has no attribute '{name}'")
    return getattr(importlib.import_module(f"microslip.{HOME[name]}"), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
