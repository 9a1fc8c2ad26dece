"""Numbers as the page prints them, and tables of them."""

from __future__ import annotations

from html import escape
from typing import Any, Mapping, Optional, Sequence

from microslip.plots.numbers import LENGTHS, is_number, plain

Row = Sequence[str]  # cells
LENGTH = dict(LENGTHS)


def table(head: Optional[Row], rows: Sequence[Row], right: Sequence[int] = (), kind: str = "") -> str:
    """An HTML table of cells that are HTML already; numbers of the columns that are set right; its name in page.css."""
    def cells(row: Row, tag: str) -> str:
        return "".join(f'<{tag}{" class=n" if i in right else ""}>{cell}</{tag}>' for i, cell in enumerate(row))
    top = f"<thead><tr>{cells(head, 'th')}</tr></thead>" if head else ""
    body = "".join(f"<tr>{cells(row, 'td')}</tr>" for row in rows)
    return f'<div class="wide {kind}"><table>{top}<tbody>{body}</tbody></table></div>'


def number(value: Any, digits: int = 5) -> str:
    return plain(float(f"{value:.{digits}g}")) if is_number(value) else "–"


def percent(value: Any, digits: int = 2) -> str:
    if not is_number(value):
        return "–"
    return f"{number(100 * value, digits)} %" if value >= 1e-5 else "< 0.001 %"


def preload_text(curve: Mapping[str, Any], unit: str = "") -> str:
    """Force or scale; the unit stands behind a force."""
    scale = curve.get("preload_scale")
    value = curve.get("preload_N") if scale is None else scale
    if not is_number(value):
        return escape(str(value if value is not None else "–"))
    gap = curve.get("gap_m")
    return number(value) + (unit if scale is None else "") + (f" (gap {number(1e6 * gap, 3)} µm)" if gap else "")
