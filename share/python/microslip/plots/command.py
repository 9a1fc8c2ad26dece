"""What the command scripts share."""

from __future__ import annotations

import mmap
import sys
from typing import Callable, Optional

import numpy as np
from matplotlib import rc_context

from microslip.files import RoomError, RunError
from microslip.plots.style import STYLE


ADDRESS_SPACE = 192  # MB: the buffers of OpenBLAS, and the figures


def require_address_space() -> None:
    """OpenBLAS asks for its buffers for ever where `ulimit -v` leaves no room: they are taken while there is some."""
    try:
        mmap.mmap(-1, ADDRESS_SPACE << 20, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS).close()
    except OSError:
        raise RunError(f"drawing takes {ADDRESS_SPACE} MB more of address space than the limit leaves (ulimit -v)") from None
    np.linalg.inv(np.eye(100)) @ np.eye(100)


def run_command(draw: Callable[..., object], *arguments: object) -> int:
    """Calls draw(*arguments) in the style of the plots. The exit code: 1 where it returns False, or where a run
    cannot be drawn (stderr says why), 4 where the figures have no room."""
    try:
        require_address_space()
        with rc_context(STYLE):
            return 1 if draw(*arguments) is False else 0
    except RunError as error:
        print(error, file=sys.stderr)
        return 4 if isinstance(error, RoomError) else 1


def given(usage: str, n_least: int, n_most: Optional[int] = None) -> list[str]:
    """The arguments of a command without options; prints its usage and ends where they do not fit or -h is asked."""
    words = sys.argv[1:]
    asked = words[:1] in (["-h"], ["--help"])
    if asked or not n_least <= len(words) <= (n_most or len(words)):
        print(usage.strip())
        sys.exit(0 if asked else 1)
    return words
