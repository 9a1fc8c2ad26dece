"""The sections of the page that are read: tables, and the places where the script draws."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Optional, Sequence

from microslip.files import RunError
from microslip.plots.numbers import change_in_percent, in_unit, is_number, told_like, told_with
from microslip.report.cells import LENGTH, number, percent, preload_text, table
from microslip.report.errors import budget

if TYPE_CHECKING:
    from microslip.results import Run

Data = Mapping[str, Any]  # what the script draws

UNITS = {"youngs_modulus": "Pa", "density": "kg/m³", "element_size": "m", "length": "m", "area": "m²", "amplitude": "N",
         "phase": "°", "normal_stiffness": "N/m³", "tangential_stiffness": "N/m³", "tangential_stiffness_r": "N/m³",
         "wear_coefficient": "m²/N", "frequency": "Hz", "preload": "N", "optimum_range": "SI", "masses": "kg",
         "springs": "N/m", "preload_moment": "N·m", "end_stiffness": "N/m", "length_unit": "m"}
# Keys a reader asks for first; the rest of the scene is folded away.
FIRST = {"model": ("kind", "file", "element_size", "order", "masses", "springs"), "material": ("youngs_modulus", "poissons_ratio", "density"),
         "supports": ("clamped",), "modes": ("count", "damping_ratio", "residual"),
         "contact": ("surface", "points", "slip_direction", "friction_coefficient", "normal_stiffness", "tangential_stiffness",
                     "roughness", "wear_coefficient"),
         "excitation": ("forces",),
         "response": ("output", "frequency", "method", "harmonics", "preload", "preload_scale", "optimum",
                      "optimum_range")}
LONGEST = 300  # characters of a value


def value_text(value: Any, unit: str = "") -> str:
    """A value of the scene in words: tables as key value, …; the unit of its numbers behind a list of numbers, or behind each."""
    if isinstance(value, list) and unit and not all(map(is_number, value)):
        return ", ".join(value_text(item, unit) for item in value)
    if unit and is_number(value) or isinstance(value, list) and unit:
        return value_text(value) + unit
    if isinstance(value, dict):
        return ", ".join(f"{key.replace('_', ' ')} {value_text(item)}" for key, item in value.items())
    if isinstance(value, list):
        plain_list = not any(isinstance(item, dict) for item in value)
        return (", " if plain_list else "; ").join(map(value_text, value))
    return number(value, 7) if is_number(value) and not isinstance(value, bool) else str(value)


def setting_row(key: str, value: Any) -> list[str]:
    text = value_text(value, f" {UNITS[key]}" if key in UNITS else "")
    text = text if len(text) <= LONGEST else f"{len(value) if isinstance(value, list) else 'many'} entries (scene.toml)"
    return [escape(key.replace("_", " ")), escape(text)]


def parts_of(scene: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """(name, table) of the sections; [[contact]] one by one."""
    for name, content in scene.items():
        if isinstance(content, dict):
            yield name, content
        elif isinstance(content, list) and all(isinstance(item, dict) for item in content):
            yield from ((f"{name} {item.get('name', i + 1)}", item) for i, item in enumerate(content))


def harmonics_used(run: Run) -> str:
    """What the curves were solved with."""
    most = max(((entry.get("harmonics") or {}).get("most") or 0 for entry in run.summary["curves"]), default=0)
    return f"{most} at most" if most else ""


def asked(run: Run, data: Data) -> str:
    try:
        scene = run.scene
    except RunError as error:
        return f"<p class=note>{escape(str(error))}</p>"
    rows, folded = [], []
    for name, content in parts_of(scene):
        first = FIRST.get(name.split()[0], ())
        part = [setting_row(key, content[key]) for key in first if key in content]
        rows += [[f"<b>{escape(name)}</b>" if i == 0 else "", *row] for i, row in enumerate(part)]
        folded += [[escape(name), *setting_row(key, value)] for key, value in content.items() if key not in first]
    used = harmonics_used(run)
    rows += [["<b>solved with</b>", "harmonics", used]] if used else []
    rest = f"<details><summary>every other key</summary>{table(None, folded)}</details>" if folded else ""
    return (table(None, rows) + rest +
            "<p class=note>SI units. A force is F sin(θ + phase), θ = ωt: at 0° the excitation passes zero upwards. The phase of "
            "the response is atan2(y<sub>c</sub>, y<sub>s</sub>) of its first harmonic: 0° moves with the force, −90° is a "
            "quarter of a period late.</p>")


def told(value: Any, digits: int = 2) -> str:
    """An indicator: a number, "infinite", or nothing."""
    return "∞" if value == "infinite" else number(value, digits)


def bound_text(bound: Any, along: Any) -> str:
    """Of the peaks, and of any amplitude where that is more."""
    more = is_number(bound) and is_number(along) and along > bound
    return f"{percent(bound)}, {percent(along)} along a curve" if more else percent(bound)


def effect_row(row: Mapping[str, Any]) -> list[str]:
    simulated = {True: "yes", False: "no"}.get(row.get("simulated"), "not decided")
    bound, why = row.get("bound"), escape(str(row.get("reason", "")))
    if row.get("objection"):
        why += f"; <b>but {escape(str(row['objection']))}</b>"
    measured = f'<span title="{escape(str(row.get("quantity", "")))}">{told(row.get("indicator"))}</span>'
    seconds = row.get("seconds")
    return [escape(str(row.get("name", "")).replace("_", " ")), simulated, escape(str(row.get("setting", ""))), measured,
            told(row.get("threshold")), f"{number(seconds, 2)} s" if is_number(seconds) else "–",
            "peak not found" if bound == "infinite" else bound_text(bound, row.get("bound_along")), why]


def effects(run: Run, data: Data) -> str:
    rows = [effect_row(row) for row in run.summary.get("effects") or []]
    head = ["effect", "simulated", "setting", "indicator", "limit", "cost", "bound", "why"]
    return "" if not rows else (table(head, rows, (3, 4, 5, 6), "effects") +
                     "<p class=note>Above its limit an indicator, told from the linear limits before the run, calls for the "
                     "effect; point at it to read what it is. Cost: what curves, their errors, a best value and its bracket take "
                     "longer, forecast; –: not told apart. Bound: what having the effect changes the highest peaks by, at most; "
                     "along a curve an amplitude at its frequency, over the highest, the largest of a sample.</p>")


def state_of(curve: Mapping[str, Any]) -> str:
    """Complete or not, and what of its stability is not known."""
    parts = ["complete" if curve.get("complete") else f"<b>incomplete</b>: {escape(str(curve.get('diagnosis', '')))}"]
    if curve.get("detached_branches"):
        parts.append(f"{curve['detached_branches']} more branches beside it")
    return "; ".join(parts)


def unjudged(data: Data, name: str) -> str:
    """How many solutions of a curve have a stability nobody has judged; at a fold there is none to judge."""
    entry = next((entry for entry in data["curves"] if entry["name"] == name), {"stable": [], "mark": []})
    stable = [value for value, mark in zip(entry["stable"], entry["mark"]) if mark != "fold"]
    missing = sum(value < 0 for value in stable)
    return f"{missing} of {len(stable)}" if missing else "0"


def free_curve(run: Run) -> Optional[Mapping[str, Any]]:
    """That has a peak."""
    return next((curve for curve in run.summary["curves"] if curve.get("preload_N") == "free" and curve.get("peak")), None)


def against_free(curve: Mapping[str, Any], free: Optional[Mapping[str, Any]]) -> str:
    peak = curve.get("largest")
    if not free or not peak:
        return "–"
    widths = [(entry.get("bar") or {}).get("peak_amplitude") for entry in (curve, free)]
    return change_in_percent(peak["amplitude_m"], widths[0], free["peak"]["amplitude_m"], widths[1])


def width_text(curve: Mapping[str, Any]) -> str:
    width = (curve.get("bar") or {}).get("peak_amplitude")
    return percent(width) if is_number(width) else "no bar"


def note_on_digits(rows: Sequence[Sequence[str]]) -> str:
    """How numbers are rounded, and what ≈ is where it stands."""
    unknown = any("≈" in cell for row in rows for cell in row)
    return ("<p class=note>Digits end where the half width begins; folds have those of the peak frequency."
            + (" ≈: no bar is known; three digits of an amplitude, four of a frequency." if unknown else "") + "</p>")


def peaks(run: Run, data: Data) -> str:
    free, size = free_curve(run), LENGTH[data["unit"]]
    rows = []
    for curve in run.summary["curves"]:
        peak, bar = curve.get("largest") or {}, curve.get("bar") or {}
        end = " (end of the range)" if peak.get("at") == "range_end" else ""
        rows.append([preload_text(curve), told_with(bar, "peak_frequency", peak.get("frequency_Hz")) + end,
                     told_with(bar, "peak_amplitude", in_unit(peak.get("amplitude_m"), size)),
                     width_text(curve), against_free(curve, free),
                     ", ".join(told_like(bar, "peak_frequency", fold) for fold in curve.get("folds_Hz") or []) or "–",
                     unjudged(data, curve["name"]), state_of(curve)])
    head = ["preload scale" if data["scaled"] else "preload [N]", "peak [Hz]", f"peak [{data['unit']}]", "peak ±",
            "against free", "folds [Hz]", "stability not judged", "state"]
    return table(head, rows, (0, 1, 2, 3, 4, 6), "peaks") + note_on_digits(rows) if rows else ""


def bracket_row(entry: Mapping[str, Any], best: Mapping[str, Any], unit: str) -> list[str]:
    """A best value in the digits of the one with the data as given."""
    bar = best.get("bar") or {}
    label = "as given" if entry is best else f"{entry['parameter'].replace('_', ' ')} × {number(entry['factor'])}"
    label += f" with {entry['harmonics']} harmonics" if entry is not best and entry.get("harmonics") else ""
    wider = entry.get("range") if entry.get("range_widened") else None
    label += f" (searched wider: {number(wider[0])} … {number(wider[1])})" if wider else ""
    objection = entry.get("objection") or "not found"
    label += "" if entry.get("found") else f" (lowest{', ' if objection == 'not found' else ': '}{objection})"
    value = " … ".join(told_like(bar, "optimum", one) for one in entry.get("flat") or [entry["value"]])
    amplitude = told_like(bar, "peak_amplitude", in_unit(entry["amplitude_m"], LENGTH[unit]))
    return [escape(label), value, amplitude + (" (end of the range)" if entry.get("at") == "range_end" else ""),
            told_like(bar, "peak_frequency", entry["frequency_Hz"])]


def bracket(best: Mapping[str, Any], unit: str) -> str:
    """The best value once more with other contact data; empty where that was not searched."""
    entries = best.get("bracket") or []
    left_out = "".join(f"<p class=note>Not varied: {escape(reason)}.</p>" for reason in best.get("bracket_left_out") or [])
    if not entries:
        return left_out
    value = "preload [N]" if best["parameter"] == "preload" else f"{escape(best['parameter'])} (SI)"
    rows = [bracket_row(entry, best, unit) for entry in (best, *entries)]
    if any(entry.get("harmonics") for entry in entries):
        left_out += ("<p class=note>Rows with few harmonics tell how the best value moves: compare them with one another, "
                     "not with the row as given.</p>")
    return table(["contact data", f"best {value}", f"peak [{unit}]", "at [Hz]"], rows, (1, 2, 3)) + left_out


def optimum(run: Run, data: Data) -> str:
    best = run.optimum
    if not best:
        return ""
    if not best.get("found"):
        return f"<p class=best>Best {escape(best['parameter'])} not found: {escape(best.get('message') or '')}.</p>"
    unit, bar = " N" if best["parameter"] == "preload" else " (SI)", best.get("bar") or {}
    amplitude = best["amplitude_m"] / LENGTH[data["unit"]]
    return (f"<p class=best>Best {escape(best['parameter'])}: <b>{told_with(bar, 'optimum', best['value'])}{unit}</b>, "
            f"peak {told_with(bar, 'peak_amplitude', amplitude)} {data['unit']} at "
            f"{told_with(bar, 'peak_frequency', best['frequency_Hz'])} Hz.</p>" + bracket(best, data["unit"]))


def response(run: Run, data: Data) -> str:
    if not data["curves"]:
        return ""
    chart = ('<div class=tools data-tools=curves></div><div class=chart data-chart=curves></div>'
             '<p class=note><span class=hands>Drag to zoom, double-click for the whole range, point at a curve for its numbers, click a '
             'name to hide it. </span>Solid: stable; dashed: unstable; dotted and pale: stability not judged. ● peak, ◇ fold, ☆ the peak with more '
             'harmonics, ✕ ends here; crosses: error of the peak.</p>')
    many = any(len(set(entry["frequency"])) > 1 for entry in data["curves"])
    return optimum(run, data) + (chart if many else "") + peaks(run, data)


def against(run: Run, data: Data) -> str:
    """Peak against preload, or against what a search has varied."""
    family = [peak for peak in data["peaks"] if peak["preload"] is not None]
    if len(family) + len((data["trace"] or {}).get("value", ())) < 2:
        return ""
    return "<div class=charts data-chart=peaks></div>"


def maps(run: Run, data: Data) -> str:
    if not data["maps"]:
        return ""
    return ('<div class=tools data-tools=maps></div><div class=map data-chart=maps></div>'
            '<p class=note><span class=hands>The slider goes over one period; </span>0° is where the excitation passes zero upwards.</p>'
            '<h3 data-title="point-loop"></h3><div class=loop data-chart="point-loop"></div>'
            '<p class=note>The point with the ring: at first where most energy is dissipated<span class=hands>; click on the map for '
            'another</span>.</p>'
            '<h3>Hysteresis of the whole patch</h3><div class=loop data-chart=loop></div>'
            '<p class=note>Friction force over the mean relative displacement, both along p, at the phases of the map; the point is '
            'where the slider stands. Where the whole face moves alike, the area of the loop is the energy of a period.</p>')


def natural_frequency(run: Run, value: Any) -> str:
    """To what the mesh does to the frequencies of peaks; four digits where that is not known."""
    told = [abs(row["effect"]) for row in run.summary["error_budget"] if (row["source"], row["goal"]) == ("mesh", "peak_frequency")]
    return told_like({"peak_frequency": max(told)}, "peak_frequency", value) if told else number(value, 4)


def structure(run: Run, data: Data) -> str:
    mesh = run.summary.get("mesh")
    text = ""
    if mesh:
        text = (f"<p>{mesh['nodes']} nodes, {mesh['elements']} elements, {mesh['degrees_of_freedom']} degrees of freedom, "
                f"{number(mesh['mass_kg'])} kg.</p>")
    rows = [[str(i + 1), natural_frequency(run, mode["frequency_Hz"]), number(mode["damping_ratio"]), escape(mode.get("kind") or "")]
            for i, mode in enumerate(run.summary.get("modes") or [])]
    return text + table(["mode", "frequency [Hz]", "damping ratio", "kind"], rows, (0, 1, 2))


def cost(run: Run, data: Data) -> str:
    stages = run.summary.get("stages") or []
    rows = [[escape(stage["name"]), *(f"{stage[key]:.{decimals}f}" if is_number(stage[key]) else "–"
                                      for key, decimals in (("seconds", 2), ("peak_memory_MB", 0)))]
            for stage in stages if stage["name"] != "report"]  # this page is part of it
    machine = run.summary.get("machine") or {}
    words = ", ".join(str(machine[key]) for key in ("processor", "blas") if machine.get(key))
    return table(["stage", "seconds", "memory [MB]"], rows, (1, 2)) + f"<p class=note>{escape(words)}</p>"


SECTIONS = [("Response", response), ("Peak against preload", against), ("Contact maps", maps),
            ("How far the peaks can be trusted", budget), ("What was asked", asked), ("Effects", effects),
            ("Structure", structure), ("Cost", cost)]


def problems_of(run: Run, damage: Sequence[str]) -> str:
    """What a reader must know before anything else."""
    lines = []
    if run.exit_code:
        lines.append(f"<b>Exit code {run.exit_code}.</b> {escape(run.message)}")
    lines += [f"{preload_text(curve, ' N')}: incomplete: {escape(str(curve.get('diagnosis', '')))}"
              for curve in run.summary["curves"] if not curve.get("complete")]
    lines += [escape(text) for text in [*run.warnings, *damage]]
    if not lines:
        return ""
    items = "".join(f"<li>{line}</li>" for line in lines)
    return f'<section id="warnings" class=warnings><h2>Warnings</h2><ul>{items}</ul></section>\n'
