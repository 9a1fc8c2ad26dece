"""Figure of a contact map: states at four phases and sums over the period; points in a row over the phase."""

from __future__ import annotations

from typing import TYPE_CHECKING, Optional

import numpy as np
from matplotlib.collections import Collection, PolyCollection
from matplotlib.colors import ListedColormap, to_rgba_array
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from microslip.arrows import arrows_at
from microslip.plots.boundaries import draw_areas, draw_boundaries, draw_guards, guard_handles, instant_handle
from microslip.plots.style import STATE_COLOURS, state_legend, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from microslip.plots.contact_map import ContactMap

STATE_RGBA = to_rgba_array(STATE_COLOURS)
ARROW = Line2D([], [], color="white", markeredgecolor="black", markeredgewidth=0.4, marker=r"$\rightarrow$", markersize=12,
               linestyle="none", label="direction and speed of slip")


def frame_patch(axes: Axes, contact: ContactMap) -> None:
    """Leaves a little room about the patch, in its own proportions."""
    pad = 0.02 * max(np.max(contact.high - contact.low), 1e-3)
    axes.set_xlim(contact.low[0] - pad, contact.high[0] + pad)
    axes.set_ylim(contact.low[1] - pad, contact.high[1] + pad)
    axes.set_aspect("equal")


def draw_patch(axes: Axes, contact: ContactMap, colours: Optional[np.ndarray] = None, values: Optional[np.ndarray] = None,
               cmap: Optional[str] = None) -> Collection:
    """Cells coloured by values; lone points, where there are no cells, so or in given colours."""
    if contact.cells is None:
        result = axes.scatter(contact.points[:, 0], contact.points[:, 1], s=22, marker="s",
                              c=colours if values is None else values, cmap=cmap,
                              edgecolor="0.6", linewidth=0.3)
    else:
        result = PolyCollection(contact.cells, linewidth=0.6, cmap=cmap, edgecolors="face", joinstyle="round")  # thinner: white shows
        result.set_array(values)
        axes.add_collection(result)
    frame_patch(axes, contact)
    return result


def layout_of(contact: ContactMap) -> tuple[float, float]:
    """Figure size for two columns of states and one of sums over the period."""
    width, height = np.maximum(contact.high - contact.low, 1e-3)
    ratio = max(height / width, 0.18)  # at most 1: the long side lies flat
    return 3 * 2.9 + 1.2, 2 * (2.9 * ratio + 0.6) + 0.8


def draw_states(axes: Axes, contact: ContactMap, angle: float) -> list[Line2D]:
    """The patch at the phase nearest to an angle [deg]. Entries of the legend for what lies over the cells."""
    phase = contact.phase_near(angle)
    states = contact.state[:, phase].astype(int)
    if contact.cells is None:
        draw_patch(axes, contact, colours=STATE_RGBA[states])
    else:
        draw_areas(axes, contact.cells, states, contact.vertices, phase, STATE_RGBA)
        frame_patch(axes, contact)
    has_lines = contact.vertices is not None and draw_boundaries(axes, contact.vertices, phase)
    has_arrows = contact.slider is not None and draw_arrows(axes, contact, phase)
    stick, slip, apart = contact.shares(phase)
    axes.set_title(f"{contact.phase[phase]:.0f}°:  stick {100 * stick:.0f} %, slip "
                   f"{100 * slip:.0f} %, open {100 * apart:.0f} %", loc="left", fontsize=8, y=1.0)
    return ([instant_handle()] if has_lines else []) + ([ARROW] if has_arrows else [])


def draw_arrows(axes: Axes, contact: ContactMap, phase: int) -> bool:
    """Slip in two directions: where to, and how fast against the fastest of the period. Whether there is any."""
    arrows = arrows_at(contact.points, contact.slider, contact.state, phase)
    if len(arrows):
        axes.quiver(*arrows.T, angles="xy", scale_units="xy", scale=1, color="white", edgecolor="black", linewidth=0.4,
                    width=0.005, headwidth=3, headlength=3, headaxislength=3, zorder=3)
    return len(arrows) > 0


def draw_sum(figure: Figure, axes: Axes, contact: ContactMap, values: np.ndarray, name: str) -> set[str]:
    """A sum over the period on the patch, from zero. Names of the guards drawn."""
    drawn = draw_patch(axes, contact, values=values, cmap="cividis")
    if not values.max() > 0:  # a scale of nothing would invent one
        axes.set_title(f"{name}: 0", loc="left", fontsize=8)
        return set()
    guards = draw_guards(axes, contact.vertices) if contact.vertices is not None else set()
    drawn.set_clim(0.0, values.max())
    bar = figure.colorbar(drawn, cax=axes.inset_axes([1.03, 0.0, 0.05, 1.0]))
    bar.outline.set_linewidth(0.5)
    axes.set_title(name, loc="left", fontsize=8)
    return guards


def patch_figure(contact: ContactMap) -> Figure:
    """States at four phases and what the period sums up to, over the plane of the patch."""
    figure, grid = subplots(2, 3, layout_of(contact), sharex=True, sharey=True)
    over = {handle.get_label(): handle for axes, angle in zip(grid[:, :2].flat, (0, 90, 180, 270))
            for handle in draw_states(axes, contact, angle)}
    guards = draw_sum(figure, grid[0, 2], contact, contact.energy, "dissipated energy [J/m² per period]")
    guards |= draw_sum(figure, grid[1, 2], contact, contact.slip, "slip distance [µm per period]")
    for axes in grid.flat:
        axes.spines[:].set_visible(False)
        axes.tick_params(length=2)
    for axes in grid[1]:
        axes.set_xlabel(contact.names[0])
    for axes in grid[:, 0]:
        axes.set_ylabel(contact.names[1])
    figure.get_layout_engine().set(w_pad=0.1)
    state_legend(figure, np.unique(contact.state), [*over.values(), *guard_handles(guards)])
    return figure


def row_figure(contact: ContactMap) -> Figure:
    """Points in a row have no area to draw: their states over the period, one line per point."""
    n = len(contact.points)
    figure, (states, energy) = subplots(1, 2, (7.2, min(1.6 + 0.22 * n, 7.0)), sharey=True,
                                        gridspec_kw={"width_ratios": [3, 1]})
    edges = np.append(contact.phase, 360.0)
    states.pcolormesh(edges, np.arange(n + 1) + 0.5, contact.state, vmin=-0.5, vmax=4.5,
                      cmap=ListedColormap(STATE_COLOURS))
    states.hlines(np.arange(1, n) + 0.5, 0, 360, color="white", linewidth=min(1.5, 20 / n))
    states.set_xticks(np.arange(0, 361, 90))
    states.set_xlabel("phase [°]")
    states.set_ylabel("contact point")
    if n <= 10:
        states.set_yticks(np.arange(1, n + 1))
    else:
        states.yaxis.set_major_locator(MaxNLocator(integer=True))
    energy.barh(np.arange(1, n + 1), contact.energy, color="0.4", height=0.6)
    energy.set_xlabel("dissipated energy\n[J/m² per period]")
    state_legend(figure, np.unique(contact.state))
    return figure
