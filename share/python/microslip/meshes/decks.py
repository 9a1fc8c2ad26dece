"""Files of decks that include others."""
from .content import Refused, require

_DEEPEST = 20  # files within files


def open_deck(path, above, keyword):
    """The file, to be read.

    above    places of the lines that include it, one within another; none for the deck itself.
    keyword  that includes a file.

    Raises Refused where it cannot be opened, or seems to include itself."""
    require(len(above) < _DEEPEST, f"{path}: {keyword} goes {_DEEPEST} files deep: does it include itself?")
    try:
        return open(path, encoding="latin-1")
    except OSError as error:
        raise Refused(f"{above[-1] if above else path}: {path} cannot be read: {error.strerror}") from None
