"""How far the peaks can be trusted: bars, and a table with a row for every source of error."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any, Mapping, NamedTuple, Sequence

from microslip.plots.numbers import is_number, signed_percent, told_with
from microslip.report.cells import number, percent, preload_text, table

if TYPE_CHECKING:
    from microslip.results import Run

HEADS = {"optimum": "best value", "peak_amplitude": "peak amplitude", "peak_frequency": "peak frequency",
         "dissipated_energy": "dissipated energy"}  # by goal
KINDS = {"borrowed": "as of another curve"}
NOTE = ("<p class=note>With its sign: what refining the source to its end would add. Solved: with a richer model; estimated: by one step "
        "of it. Seconds: what telling it took; gain: the effect on the peak amplitude over these seconds; –: does not apply, as it was "
        "told at no cost or not at all.</p>")


def bars_of(rows: Sequence[Mapping[str, Any]]) -> str:
    """Effects on one goal of one curve, the largest first, as bars from a hundredth of a percent."""
    worst = max(abs(row["effect"]) for row in rows) or 1.0
    lines = ""
    for row in sorted(rows, key=lambda row: -abs(row["effect"])):
        lines += (f'<div class=bar><span>{escape(row["source"].replace("_", " "))}</span>'
                  f'<i style="--share:{abs(row["effect"]) / worst:.3f}"></i>'
                  f'<em>{signed_percent(row["effect"])} {escape(row.get("kind", ""))}</em></div>')
    return lines


def asked_accuracy(run: Run) -> str:
    """What was asked for, what was reached and by what; empty without a tolerance."""
    accuracy = run.summary.get("accuracy")
    if not accuracy:
        return ""
    reached = accuracy.get("reached")
    words = [f"Asked for {percent(accuracy['asked'])} of every peak",
             f"reached {percent(reached)}" if is_number(reached) else "what is reached is not known",
             *(f"then with {escape(step)}" for step in accuracy.get("refined") or [])]
    return f"<p>{'; '.join(words)}.</p>"


def energy_bars(curve: Mapping[str, Any], rows: Sequence[Mapping[str, Any]]) -> str:
    """What the highest peak dissipates in a period, with what makes its half width."""
    energy, bar = (curve.get("peak") or {}).get("dissipated_energy_J"), curve["bar"].get("dissipated_energy")
    if not is_number(energy):
        return ""
    if not is_number(bar):
        return "<p class=note>friction dissipates nothing at the peak</p>"
    return f"<h3>dissipated {told_with(curve['bar'], 'dissipated_energy', energy)} J (± {percent(bar)})</h3>" + (bars_of(rows) if rows else "")


class Budget(NamedTuple):
    """Of one curve, or of the best value."""

    name: str
    entry: Mapping[str, Any]
    rows: Sequence[Mapping[str, Any]]

    @property
    def bar(self) -> Mapping[str, Any]:
        """Without harmonics there is no bar."""
        return self.entry.get("bar") or {"not_known": ["harmonics"]}

    @property
    def size(self) -> float:
        """What is told of the amplitude, all together."""
        return sum(abs(row["effect"]) for row in self.rows if row["goal"] == "peak_amplitude")


def budgets_of(run: Run) -> list[Budget]:
    """Of every curve that has rows, then of the best value."""
    every, best = run.summary["error_budget"], run.optimum or {}
    told = [Budget(preload_text(curve, " N"), curve, [row for row in every if row["curve"] == curve["name"]])
            for curve in run.summary["curves"]]
    told.append(Budget("best value", best, best.get("error_budget") or []))
    return [one for one in told if one.rows]


def by_source(rows: Sequence[Mapping[str, Any]]) -> dict[str, dict[str, Mapping[str, Any]]]:
    """Source, then goal; what does most to the amplitude first."""
    sources: dict[str, dict[str, Mapping[str, Any]]] = {}
    for row in rows:
        sources.setdefault(row["source"], {})[row["goal"]] = row
    return dict(sorted(sources.items(), key=lambda item: -abs(item[1].get("peak_amplitude", {}).get("effect", 0.0))))


def source_row(source: str, rows: Mapping[str, Mapping[str, Any]], goals: Mapping[str, str]) -> list[str]:
    """goals: with what their cell says where the source has no row of it."""
    one = rows.get("peak_amplitude") or next(iter(rows.values()))
    seconds, gain = one.get("seconds"), one.get("gain_per_second")
    kinds = dict.fromkeys(KINDS.get(row.get("kind", ""), row.get("kind") or "not told") for row in rows.values())
    effects = [signed_percent(rows[goal]["effect"]) if goal in rows else missing for goal, missing in goals.items()]
    return [escape(source.replace("_", " ")), *effects, escape(", ".join(kinds)), number(seconds, 2),
            f"{number(100.0 * gain, 2)}" if seconds and is_number(gain) else "–"]


def last_row(budget: Budget, goals: Mapping[str, str]) -> list[str]:
    """The half widths: of all that is known, together."""
    seconds = sum({row["source"]: row.get("seconds") or 0.0 for row in budget.rows}.values())
    bars = [f"± {percent(budget.bar[goal])}" if is_number(budget.bar.get(goal)) else missing for goal, missing in goals.items()]
    return [f"<b>{cell}</b>" for cell in ("all together", *bars, "sum of sizes", number(seconds, 2), "–")]


def source_table(budget: Budget, told: Sequence[str]) -> str:
    """One row per source, those that are not known too. told: goals that the run tells anything of."""
    nothing = "nothing dissipated" if not any(row["goal"] == "dissipated_energy" for row in budget.rows) else "not known"
    goals = {goal: nothing if goal == "dissipated_energy" else "not known" for goal in HEADS if goal in told}
    sources = by_source(budget.rows)
    rows = [source_row(source, of_source, goals) for source, of_source in sources.items()]
    rows += [[escape(source.replace("_", " ")), *["not known"] * len(goals), "not known", "–", "–"]
             for source in budget.bar.get("not_known") or [] if source not in sources]
    head = ["source", *(HEADS[goal] for goal in goals), "kind", "seconds", "gain [%/s]"]
    return table(head, [*rows, last_row(budget, goals)], (*range(1, len(goals) + 1), len(goals) + 2, len(goals) + 3), "sources")


def source_tables(run: Run) -> str:
    """A table per curve and of the best value; that of the curve that is least certain and of the best value are open."""
    budgets = budgets_of(run)
    if not budgets:
        return ""
    told = [goal for goal in HEADS if goal != "optimum" and any(row["goal"] == goal for one in budgets for row in one.rows)]
    worst = max(budgets, key=lambda one: (one.name != "best value", one.size))
    text = ""
    for one in budgets:
        least = f", the {'least certain curve' if len(budgets) > 1 else 'curve'}" if one is worst else ""
        is_open = " open" if one is worst or one.name == "best value" else ""
        text += (f"<details{is_open}><summary>{one.name}{least}: {half_widths(one)}</summary>"
                 + source_table(one, [*told, "optimum"] if one.name == "best value" else told) + "</details>")
    return text + NOTE


def half_widths(budget: Budget) -> str:
    if not is_number(budget.bar.get("peak_amplitude")):
        return "no bar, as harmonics are not known"
    return f"amplitude ± {percent(budget.bar['peak_amplitude'])}, frequency ± {percent(budget.bar.get('peak_frequency'))}"


def budget(run: Run, _: Mapping[str, Any]) -> str:
    text = ""
    for curve in run.summary["curves"]:
        rows, of_energy = ([row for row in run.summary.get("error_budget") or []
                            if (row["curve"], row["goal"]) == (curve["name"], goal) and abs(row["effect"]) >= 1e-5]
                           for goal in ("peak_amplitude", "dissipated_energy"))
        bar = curve.get("bar")
        if not bar:
            continue
        unknown = ", ".join(bar.get("not_known") or [])
        text += (f'<div class=budget><h3>{preload_text(curve, " N")}: '
                 f'amplitude ± {percent(bar.get("peak_amplitude"))}, frequency ± {percent(bar.get("peak_frequency"))}</h3>'
                 + (bars_of(rows) if rows else "<p class=note>no effect above 0.001 %</p>")
                 + energy_bars(curve, of_energy)
                 + (f"<p class=note>not known: {escape(unknown)}</p>" if unknown else "") + "</div>")
    tables = source_tables(run)
    bars = text and f"<details><summary>amplitude and dissipated energy as bars</summary><div class=budgets>{text}</div></details>"
    return tables and (asked_accuracy(run) + "<p>What each choice of the discretisation does to the highest peak, if it were refined to its end.</p>"
                       + tables + bars)
