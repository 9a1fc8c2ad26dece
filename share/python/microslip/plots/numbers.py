"""Numbers and units as people write them."""

from __future__ import annotations

import math
from typing import Any, Mapping, Optional, Sequence

LENGTHS = (("m", 1.0), ("mm", 1e-3), ("µm", 1e-6), ("nm", 1e-9))
MOST_DIGITS = 8  # of any number that is told
DIGITS_NOT_COUNTED = 3  # where a bar leaves a source out
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


def _size(value: float) -> int:
    return math.floor(math.log10(abs(value)))


def _decimals(value: float, bar: float, most: int) -> int:
    """Up to where a half width, bar × |value|, lets a value be told: to its first digit, to two where that is a one; at least one
    digit of the value, and not more than `most`."""
    half_width = abs(value) * bar
    decade = _size(half_width)
    decimals = (1 if half_width / 10.0**decade < 1.95 else 0) - decade
    return min(max(decimals, -_size(value)), most - 1 - _size(value))


def _texts(value: float, bar: Optional[float], digits: int, most: int) -> tuple[str, str, str]:
    """A value, its half width and a power of ten of both; what is empty is not told."""
    if not (bar and value and 1e-12 < bar < math.inf):
        return plain(float(f"{value:.{min(digits, most)}g}")), "", ""
    size, decimals = _size(value), _decimals(value, bar, most)
    power = 0 if -5 <= size <= 6 else size
    both = [_rounded(number / 10.0**power, decimals + power).replace("-", "−") for number in (value, abs(value) * bar)]
    return both[0], both[1] if float(both[1]) else "", f"·10{_raised(power)}" if power else ""


def with_half_width(value: float, bar: Optional[float], digits: int = 5, most: int = MOST_DIGITS) -> str:
    """A value and its half width, bar × |value|, to the digits that the bar allows; without a bar to `digits`."""
    text, half_width, power = _texts(value, bar, digits, most)
    if not half_width:
        return text + power
    return f"({text} ± {half_width}){power}" if power else f"{text} ± {half_width}"


def most_digits(bar: Mapping[str, Any]) -> int:
    """What a bar does not count may be larger."""
    return DIGITS_NOT_COUNTED if bar.get("not_known") else MOST_DIGITS


def digits_without_bar(goal: str) -> int:
    return 4 if goal == "peak_frequency" else 3


def told_with(bar: Mapping[str, Any], goal: str, value: Any) -> str:
    """A value of a goal with its half width; ≈ and few digits where the bar of the goal is not known."""
    if not is_number(value):
        return "–"
    if not is_number(bar.get(goal)):
        return "≈ " + plain(float(f"{value:.{digits_without_bar(goal)}g}"))
    return with_half_width(value, bar[goal], 6, most_digits(bar))


def told_like(bar: Mapping[str, Any], goal: str, value: Any) -> str:
    """The same digits, without the half width."""
    if not is_number(value) or not is_number(bar.get(goal)):
        return told_with(bar, goal, value)
    text, _, power = _texts(value, bar[goal], 6, most_digits(bar))
    return text + power


def digits_told(bar: Mapping[str, Any], goal: str, value: float) -> int:
    """How many significant digits a value of a goal has in told_with()."""
    width = bar.get(goal)
    if not is_number(width):
        return digits_without_bar(goal)
    if not (value and 1e-12 < width < math.inf):
        return min(6, most_digits(bar))
    return _decimals(value, width, most_digits(bar)) + 1 + _size(value)


def change_in_percent(value: float, width: Optional[float], reference: float, reference_width: Optional[float]) -> str:
    """Of a value against another, both with relative half widths, to one decimal at most; whole where a half width is not known, and
    to one digit where it is as large as the change."""
    change, decimals = 100.0 * (value / reference - 1.0), 0
    if is_number(width) and is_number(reference_width):
        half_width = 100.0 * value / reference * (width + reference_width)
        decimals = min(1, -_size(half_width)) if half_width > 0.0 else 1
        decimals = max(decimals, -_size(change)) if abs(change) >= 1.0 else decimals
    text = _rounded(change, decimals)
    return f"{'' if float(text) <= 0 else '+'}{text} %".replace("-0 %", "0 %").replace("-", "−")


def signed_percent(share: float) -> str:
    """A relative effect to two digits: +0.12 %, −13 %; < 0.001 % where it is less."""
    if abs(share) < 1e-5:
        return "< 0.001 %"
    return f"{'−' if share < 0 else '+'}{plain(float(f'{abs(100.0 * share):.2g}'))} %"
