"""What the command scripts share."""

import sys

from matplotlib import rc_context

from microslip.files import RunError
from microslip.plots.style import STYLE


def run_command(draw, *arguments):
    """Calls draw(*arguments) in the style of the plots. The exit code: 1 where it returns False, or where a run
    cannot be drawn (stderr says why)."""
    try:
        with rc_context(STYLE):
            return 1 if draw(*arguments) is False else 0
    except RunError as error:
        print(error, file=sys.stderr)
        return 1


def given(usage, n_least, n_most=None):
    """The arguments of a command without options; prints its usage and ends where they do not fit or -h is asked."""
    words = sys.argv[1:]
    asked = words[:1] in (["-h"], ["--help"])
    if asked or not n_least <= len(words) <= (n_most or len(words)):
        print(usage.strip())
        sys.exit(0 if asked else 1)
    return words
