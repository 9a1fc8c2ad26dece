"""The page: sections in order, warnings first, and the data its script draws."""

from __future__ import annotations

import html
import json
import os
from typing import TYPE_CHECKING, Any, Optional

from microslip.files import write_whole
from microslip.report.drawn import drawn
from microslip.report.sections import SECTIONS, problems_of

if TYPE_CHECKING:
    from microslip.results import Run

HERE = os.path.dirname(os.path.abspath(__file__))
# Nothing is loaded from anywhere, whatever a title or a message may say.
POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:"


def part(name: str) -> str:
    with open(os.path.join(HERE, name), encoding="utf-8") as file:
        return file.read()


def data_text(data: Any) -> str:
    """JSON that may stand in a page: no text in it ends the script."""
    return json.dumps(data, separators=(",", ":"), allow_nan=False).replace("</", "<\\/").replace("<!--", "<\\!--")


def page(run: Run, cache: Optional[str] = None) -> str:
    """The whole text of report.html."""
    damage = []
    data = drawn(run, damage, cache)
    title = html.escape(run.title or "microslip run")
    body = problems_of(run, list(dict.fromkeys(damage)))
    for heading, section in SECTIONS:
        content = section(run, data)
        if content:
            name = heading.lower().replace(" ", "-")
            body += f'<section id="{name}"><h2>{heading}</h2>\n{content}\n</section>\n'
    return (f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>\n'
            f'<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n<style>\n{part("page.css")}</style></head>\n'
            f'<body><main><header><h1>{title}</h1>'
            f'<p>{html.escape(run.summary.get("scene", ""))}, solved by microslip '
            f'{html.escape(run.summary.get("version", ""))}</p></header>\n{body}</main>\n'
            f'<script type="application/json" id="data">{data_text(data)}</script>\n'
            f'<script>\n{part("chart.js")}{part("page.js")}</script></body></html>\n')


def write_page(run: Run, path: str, cache: Optional[str] = None) -> None:
    """report.html, whole or not at all."""
    write_whole(path, page(run, cache).encode("utf-8"))
