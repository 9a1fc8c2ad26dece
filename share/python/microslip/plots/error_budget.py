"""What every choice of the discretisation does to the highest peak: of the curves that are least certain, and at the best value,
a waterfall of signed effects, the largest first, and the half width they make together."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, List, Mapping, NamedTuple, Optional, Sequence, Tuple

from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from microslip.plots.numbers import is_number, signed_percent
from microslip.plots.run_folder import Run, load_of
from microslip.plots.style import ACCENT, figure_title, legend_below, light_grid, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_PANELS = 6
RAISES, LOWERS, TOGETHER = "#c44e52", "#4c72b0", "0.75"
ROW_INCHES = 0.19
SMALLEST = 1e-3  # %, half of the shortest axis: what is less is told in words alone
Steps = List[Tuple[str, float]]  # (source, effect [%]), the largest first


class Waterfall(NamedTuple):
    """One panel."""

    name: str
    steps: Steps
    bar: Optional[float]  # half width [%]: the sum of the sizes; None where a source that outweighs others is not known
    unknown: Sequence[str]  # sources without an effect

    @property
    def size(self) -> float:
        return sum(abs(effect) for _, effect in self.steps)


def waterfall_of(name: str, entry: Mapping[str, Any], rows: Sequence[Mapping[str, Any]]) -> Optional[Waterfall]:
    """Of the amplitude of a peak, entry its curve or the best value; None without rows."""
    steps = [(row["source"].replace("_", " "), 100.0 * row["effect"]) for row in rows if row["goal"] == "peak_amplitude"]
    bar = entry.get("bar") or {"not_known": ["harmonics"]}  # without them there is no bar
    half_width = bar.get("peak_amplitude")
    unknown = [source.replace("_", " ") for source in bar.get("not_known") or []]
    return Waterfall(name, sorted(steps, key=lambda step: -abs(step[1])),
                     100.0 * half_width if is_number(half_width) else None, unknown) if steps else None


def waterfalls_of(run: Run) -> list[Waterfall]:
    """Of the curves that are least certain, in the order of the run, then of the best value."""
    best, budget = run.summary.get("optimum") or {}, run.summary["error_budget"]
    last = waterfall_of("best value", best, best.get("error_budget") or []) if best.get("found") else None
    told = [waterfall_of(run.label(load_of(curve)), curve, [row for row in budget if row["curve"] == curve["name"]])
            for curve, _ in run.curves]
    curves = [waterfall for waterfall in told if waterfall]
    room = MOST_PANELS - (1 if last else 0)
    chosen = sorted(curves, key=lambda waterfall: -waterfall.size)[:room]
    return [waterfall for waterfall in curves if waterfall in chosen] + ([last] if last else [])


def draw_steps(axes: Axes, steps: Steps) -> float:
    """Each from where the one before has ended. Where the last ends."""
    total = 0.0
    for row, (_, effect) in enumerate(steps):
        axes.barh(row, effect, 0.62, left=total, color=RAISES if effect > 0 else LOWERS, edgecolor="none", zorder=3)
        total += effect
        axes.plot([total, total], [row, row + 1], color="0.45", linewidth=0.7, zorder=2)
    return total


def half_width_text(bar: Optional[float]) -> str:
    if bar is None:
        return "not known"
    return signed_percent(bar / 100.0).replace("+", "± ")


def draw_waterfall(axes: Axes, waterfall: Waterfall) -> None:
    """Sources downwards, what each does in words at the right, all together in the last row."""
    total, last = draw_steps(axes, waterfall.steps), len(waterfall.steps)
    words = [signed_percent(effect / 100.0) for _, effect in waterfall.steps]
    if waterfall.bar is not None:
        axes.barh(last, 2 * waterfall.bar, 0.62, left=-waterfall.bar, color=TOGETHER, edgecolor="none", zorder=1)
    axes.plot([total, total], [last - 0.31, last + 0.31], color="black", linewidth=1.4, zorder=4)
    words.append(half_width_text(waterfall.bar))
    names = [source for source, _ in waterfall.steps] + ["all together", *waterfall.unknown]
    words += ["not known"] * len(waterfall.unknown)
    for row, text in enumerate(words):
        axes.text(1.02, row, text, transform=axes.get_yaxis_transform(), va="center", fontsize=7,
                  color="0.45" if text == "not known" else "black")
    axes.set_yticks(range(len(names)), names, fontsize=7)


def finish_panel(axes: Axes, waterfall: Waterfall, n_rows: int) -> None:
    reach = 1.05 * max(waterfall.bar or 0.0, waterfall.size, SMALLEST)
    axes.set_xlim(-reach, reach)
    axes.set_ylim(n_rows - 0.4, -0.6)  # panels of one height have rows of one height
    axes.axvline(0.0, color="0.3", linewidth=0.7, zorder=2)
    axes.xaxis.set_major_locator(MaxNLocator(4, symmetric=True))
    axes.tick_params(axis="y", length=0)
    axes.tick_params(axis="x", labelsize=7)
    axes.set_title(waterfall.name, loc="left", fontsize=8, color=ACCENT if waterfall.name == "best value" else "black")
    light_grid(axes)


def legend(figure: Figure) -> None:
    legend_below(figure, [Patch(color=RAISES, label="refined, it raises the peak"), Patch(color=LOWERS, label="lowers it"),
                          Patch(color=TOGETHER, label="± the sum of the sizes"),
                          Line2D([], [], color="black", linewidth=1.4, label="sum with signs")])


def error_budget_figure(run: Run) -> Optional[Figure]:
    """None without a budget."""
    waterfalls = waterfalls_of(run)
    if not waterfalls:
        return None
    n_columns = min(3, len(waterfalls)) if len(waterfalls) != 4 else 2
    n_lines = -(-len(waterfalls) // n_columns)
    n_rows = max(len(waterfall.steps) + 1 + len(waterfall.unknown) for waterfall in waterfalls)
    height = 0.75 + n_lines * (0.65 + ROW_INCHES * n_rows)
    figure, grid = subplots(n_lines, n_columns, (max(1.2 + 3.0 * n_columns, 5.4), height), squeeze=False)
    for axes, waterfall in zip(grid.flat, waterfalls):
        draw_waterfall(axes, waterfall)
        finish_panel(axes, waterfall, n_rows)
    for axes in grid.flat[len(waterfalls):]:
        axes.set_axis_off()
    for axes in grid.flat[max(0, len(waterfalls) - n_columns):len(waterfalls)]:
        axes.set_xlabel("effect on the amplitude of the peak [%]", fontsize=8)
    figure_title(figure, run.title)
    legend(figure)
    return figure
