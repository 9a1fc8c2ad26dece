"""What the command scripts share."""

from __future__ import annotations

import sys
from typing import Callable, Optional

from matplotlib import rc_context

from microslip.files import RunError
from microslip.plots.style import STYLE


def run_command(draw: Callable[..., object], *arguments: object) -> int:
    """Calls draw(*arguments) in the style of the plots. The exit code: 1 where it returns False, or where a run
    cannot be drawn (stderr says why)."""
    try:
        with rc_context(STYLE):
            return 1 if draw(*arguments) is False else 0
    except RunError as error:
        print(error, file=sys.stderr)
        return 1


def given(usage: str, n_least: int, n_most: Optional[int] = None) -> list[str]:
    """The arguments of a command without options; prints its usage and ends where they do not fit or -h is asked."""
    words = sys.argv[1:]
    asked = words[:1] in (["-h"], ["--help"])
    if asked or not n_least <= len(words) <= (n_most or len(words)):
        print(usage.strip())
        sys.exit(0 if asked else 1)
    return words
