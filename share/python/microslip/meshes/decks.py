"""Files of text: decks, some of which include others."""

from __future__ import annotations

import codecs
import os
from typing import Sequence, TextIO

from .content import Refused, require

_DEEPEST = 20  # files within files

codecs.register_error("as-latin-1", lambda error: (error.object[error.start:error.end].decode("latin-1"), error.end))


def text_of(raw: bytes) -> str:
    """Bytes as text: UTF-8, in which names of today are written; what is none of it as Latin-1."""
    return raw.decode("utf-8", "as-latin-1")


def open_text(path: str) -> TextIO:
    """The file, to be read as `text_of` reads bytes, without the mark of UTF-8 at its begin."""
    return open(path, encoding="utf-8-sig", errors="as-latin-1")


def open_deck(path: str, above: Sequence[str], keyword: str) -> TextIO:
    """The file, to be read.

    above    places of the lines that include it, one within another; none for the deck itself.
    keyword  that includes a file.

    Raises Refused where it cannot be opened, or includes itself."""
    require(len(above) < _DEEPEST, f"{path}: {keyword} goes {_DEEPEST} files deep: does it include itself?")
    for place in above:
        file = place.rpartition(":")[0]
        require(not (os.path.exists(path) and os.path.samefile(file, path)), f"{above[-1]}: {keyword} of {path}, which includes this file")
    try:
        return open_text(path)
    except OSError as error:
        raise Refused(f"{above[-1] if above else path}: {path} cannot be read: {error.strerror}") from None
