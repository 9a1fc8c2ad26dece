"""Numbers and units as people write them."""

from __future__ import annotations

import math
from typing import Any, Optional, Sequence

LENGTHS = (("m", 1.0), ("mm", 1e-3), ("µm", 1e-6), ("nm", 1e-9))
PRESSURES = (("GPa", 1e9), ("MPa", 1e6), ("kPa", 1e3), ("Pa", 1.0))


def unit_for(largest: float, units: Sequence[tuple[str, float]]) -> tuple[str, float]:
    """The first unit of which there is at least one, else the last: (name, size in SI)."""
    return next((unit for unit in units if largest >= unit[1]), units[-1])


def length_unit(largest: float) -> tuple[str, float]:
    """Unit in which a length reads well: (name, size in metres)."""
    return unit_for(largest, LENGTHS)


def pressure_unit(largest: float) -> tuple[str, float]:
    """Unit in which a pressure reads well: (name, size in pascal)."""
    return unit_for(largest, PRESSURES)


def is_number(value: Any) -> bool:
    """Whether a preload is a number, and not the name of a limit."""
    return isinstance(value, (int, float))


def in_unit(value: Any, size: float) -> Optional[float]:
    """A length in a unit; None where there is none."""
    return value / size if is_number(value) else None


def _raised(power: int) -> str:
    return str(power).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def plain(value: float) -> str:
    """20000000 as 2·10⁷, 50 as 50; a real minus sign."""
    text = f"{value:.6g}"
    if "e" in text:
        mantissa, exponent = text.split("e")
        power = _raised(int(exponent))
        text = f"10{power}" if mantissa == "1" else f"{mantissa}·10{power}"
    return text.replace("-", "−")


def _rounded(value: float, decimals: int) -> str:
    """To so many decimals, halves away from 0, as pipelines/text/rounded.cpp does; fewer than none: to tens, hundreds …"""
    unit = 10.0**-decimals
    return f"{math.copysign(math.floor(abs(value) / unit + 0.5) * unit, value):.{max(decimals, 0)}f}"


def with_half_width(value: float, bar: Optional[float], digits: int = 5) -> str:
    """A value and its half width, bar × |value|, to the digits that the bar allows; without a bar to `digits`."""
    half_width = abs(value) * (bar or 0.0)
    if not (bar and bar > 1e-12 and 0.0 < half_width < math.inf):
        return plain(float(f"{value:.{digits}g}"))
    decade = math.floor(math.log10(half_width))
    decimals = (1 if half_width / 10.0**decade < 1.95 else 0) - decade  # two digits of the half width where it begins with a one
    size = math.floor(math.log10(abs(value)))
    if -5 <= size <= 6:
        return " ± ".join(_rounded(number, decimals) for number in (value, half_width)).replace("-", "−")
    both = " ± ".join(_rounded(number / 10.0**size, decimals + size) for number in (value, half_width)).replace("-", "−")
    return f"({both})·10{_raised(size)}"


def signed_percent(share: float) -> str:
    """A relative effect to two digits: +0.12 %, −13 %; < 0.001 % where it is less."""
    if abs(share) < 1e-5:
        return "< 0.001 %"
    return f"{'−' if share < 0 else '+'}{plain(float(f'{abs(100.0 * share):.2g}'))} %"
