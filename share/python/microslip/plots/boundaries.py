"""Boundaries of the states on a patch: zero lines of functions given at the corners of its cells."""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.tri import Triangulation

GUARD_LINES = {"slip_guard": ("slips at times", "solid"), "smallest_load": ("open at times", "dashed"),
               "largest_load": ("open throughout", "dotted")}


def nearest_to_zero(values):
    """Of each row, without the entries that are NaN; NaN where all are."""
    size = np.where(np.isnan(values), np.inf, np.abs(values))
    return np.take_along_axis(values, size.argmin(axis=1)[:, None], axis=1)[:, 0]


def draw_zero_line(axes, contact, values, chosen, **style):
    """Where values at the vertices vanish, interpolated in the chosen triangles. Whether they do."""
    at_corners = values[contact.triangles[chosen]]
    if not at_corners.size or not np.min(at_corners) < 0 < np.max(at_corners):
        return False
    mesh = Triangulation(*contact.corners.T, contact.triangles[chosen])
    axes.tricontour(mesh, np.nan_to_num(values), levels=[0.0], **style)
    return True


def draw_boundaries(axes, contact, phase):
    """Boundaries of the states at one phase (its number), interpolated on guards: where a state begins, θ_k − θ,
    in triangles where it begins at every corner (and its angle does not leap around the period); the guards of
    the period in triangles where one corner slips, opens or touches now and another never does."""
    if contact.starts is None:
        return
    style = {"colors": "black", "linewidths": 0.7}
    state = contact.vertex_state[:, phase]
    for number, starts in enumerate(contact.starts):
        ahead = nearest_to_zero((starts - contact.phase[phase] + 180.0) % 360.0 - 180.0)
        at_corners = ahead[contact.triangles]
        is_here = (state == number)[contact.triangles]  # else the line parts two starts of the same state
        smooth = (np.isfinite(at_corners).all(axis=1) & (np.ptp(np.nan_to_num(at_corners), axis=1) < 90)
                  & is_here.any(axis=1) & ~is_here.all(axis=1))
        draw_zero_line(axes, contact, ahead, smooth, **style)
    for name, values in contact.guards.items():
        never, now = sides(contact, name, state)
        mixed = never[contact.triangles].any(axis=1) & now[contact.triangles].any(axis=1)
        draw_zero_line(axes, contact, values, mixed, **style)


def sides(contact, guard, state):
    """Vertices that never do what a guard is about, and those that do it now."""
    starts = [np.isfinite(of_state).any(axis=1) for of_state in contact.starts]
    slips, opens = np.isin(state, (1, 2, 4)), state == 3
    if guard == "slip_guard":
        return ~(slips | opens | starts[1] | starts[2] | starts[4]), slips
    if guard == "smallest_load":
        return ~(opens | starts[3]), opens & starts[3]
    return opens & ~starts[3], ~opens


def draw_guards(axes, contact):
    """Boundaries of what occurs within the period, over any colour: white on black. Names of those there are."""
    drawn = set()
    for name, values in contact.guards.items():
        chosen = np.ones(len(contact.triangles), dtype=bool)
        if name == "slip_guard" and "largest_load" in contact.guards:  # what never touches does not slip
            chosen = (contact.guards["largest_load"] > 0)[contact.triangles].all(axis=1)
        for colour, width, style in (("black", 1.6, "solid"), ("white", 1.0, GUARD_LINES[name][1])):
            if draw_zero_line(axes, contact, values, chosen, colors=colour, linewidths=width, linestyles=style):
                drawn.add(name)
    return drawn


def guard_handles(names):
    """Entries of the legend for the guards drawn."""
    return [Line2D([], [], color="0.3", linewidth=1.0, linestyle=style, label=f"boundary: {name}")
            for guard, (name, style) in GUARD_LINES.items() if guard in names]
