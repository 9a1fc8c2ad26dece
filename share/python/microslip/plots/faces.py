"""Numbered faces of a body, drawn from two sides: no depth buffer, triangles are painted from the back."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Mapping, Optional

import numpy as np
from matplotlib import colormaps
from matplotlib.collections import PolyCollection

from microslip.plots.output import save_as
from microslip.plots.scene import HALO, LIGHT, draw_triad, view_axes
from microslip.plots.style import figure_title, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLOURS = colormaps["tab20"].colors


class Body:
    """Triangles with their faces, normals and areas."""

    def __init__(self, data: Mapping[str, Any]) -> None:
        self.corners = np.array(data["nodes"], dtype=float)[np.array(data["triangles"], dtype=int)]
        self.face = np.array(data["face"], dtype=int)
        cross = np.cross(self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0])
        self.areas = 0.5 * np.linalg.norm(cross, axis=1)
        self.normals = cross / np.maximum(2.0 * self.areas, np.finfo(float).tiny)[:, None]
        self.centres = self.corners.mean(axis=1)

    def extent(self) -> np.ndarray:
        return np.ptp(self.corners.reshape(-1, 3), axis=0)


def two_views(body: Body) -> list[np.ndarray]:
    """The longest side stands upright; the second looks at the back, from below."""
    up = np.eye(3)[int(np.argmax(body.extent()))]
    eye = np.roll(up, 1) + 0.75 * np.roll(up, 2) + 0.5 * up
    return [view_axes(up, eye), view_axes(up, -eye)]


def paint(axes: Axes, body: Body, view: np.ndarray) -> None:
    """Triangles towards the eye, the farthest first, shaded by their angle to the light."""
    seen = np.flatnonzero(body.normals @ view[2] > 0.0)
    seen = seen[np.argsort(body.centres[seen] @ view[2])]
    light = 0.7 + 0.3 * np.clip(body.normals[seen] @ view.T @ LIGHT, 0.0, 1.0)
    colours = [np.array(COLOURS[(face - 1) % len(COLOURS)]) * share
               for face, share in zip(body.face[seen], light)]
    axes.add_collection(PolyCollection(body.corners[seen] @ view[:2].T, facecolors=colours,
                                       edgecolors=colours, linewidths=0.3, rasterized=True))


class Seen:
    """The triangles as they lie in a view."""

    def __init__(self, body: Body, view: np.ndarray) -> None:
        self.body, self.view = body, view
        self.flat = body.corners @ view[:2].T
        self.depth = body.centres @ view[2]
        self.low, self.high = self.flat.min(axis=1), self.flat.max(axis=1)
        self.margin = 1e-3 * np.max(body.extent())

    def hidden(self, triangle: int) -> bool:
        """Whether another triangle lies between this one's centre and the eye."""
        at = self.view[:2] @ self.body.centres[triangle]
        around = (self.low <= at).all(axis=1) & (self.high >= at).all(axis=1)
        a, b, c = self.flat[around & (self.depth > self.depth[triangle] + self.margin)].transpose(1, 0, 2)
        side = [np.sign(np.cross(q - p, at - p)) for p, q in ((a, b), (b, c), (c, a))]
        return bool(np.any((side[0] == side[1]) & (side[1] == side[2])))


def place_of_number(body: Body, face: int, seen_from: Seen) -> Optional[int]:
    """The triangle of a face in the middle of what can be seen of it; None: nothing can."""
    own = np.flatnonzero((body.face == face) & (body.normals @ seen_from.view[2] > 0.05))
    seen = [triangle for triangle in own[::max(1, own.size // 60)] if not seen_from.hidden(triangle)]
    if not seen:
        return None
    middle = np.average(body.centres[seen], axis=0, weights=np.maximum(body.areas[seen], 1e-300))
    return seen[int(np.argmin(np.linalg.norm(body.centres[seen] - middle, axis=1)))]


def plot_faces(data: str, picture: str) -> None:
    with open(data, encoding="utf-8") as file:
        faces = json.load(file)
    body = Body(faces)
    figure, panels = subplots(1, 2, (9.0, 6.0))
    for axes, view in zip(panels, two_views(body)):
        paint(axes, body, view)
        flat = body.corners.reshape(-1, 3) @ view[:2].T
        extent = np.array([flat.min(axis=0), flat.max(axis=0)]).T
        seen_from = Seen(body, view)
        for face in np.unique(body.face):
            triangle = place_of_number(body, face, seen_from)
            if triangle is not None:
                axes.text(*(view[:2] @ body.centres[triangle]), str(face), ha="center", va="center",
                          fontsize=8, zorder=9, path_effects=HALO)
        draw_triad(axes, view, extent, 0.16 * np.max(body.extent()))
        axes.set_aspect("equal")
        axes.set_xlim(extent[0] + 0.2 * extent[0].ptp() * np.array([-2.0, 1.0]))
        axes.set_ylim(extent[1] + extent[1].ptp() * np.array([-0.15, 0.05]))
        axes.set_axis_off()
    size = " × ".join(f"{1000.0 * side:.4g}" for side in body.extent())
    figure_title(figure, f"{faces['title']}; {size} mm, {len(np.unique(body.face))} faces")
    save_as(figure, picture)
