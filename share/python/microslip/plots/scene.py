"""A mesh and what a scene uses of it, drawn from two sides: no depth buffer, faces are painted from the back."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Sequence

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke

from microslip.plots.output import save_as
from microslip.plots.style import ACCENT, figure_title, legend_below, subplots

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FACE_COLOURS = {"clamped": "#3a6ea5", "contact": "#f4a259"}
TEXT_COLOURS = {"clamped": "#12355b", "contact": "#8a4b08"}
MARKS = {"force": (ACCENT, "^"), "output": ("#2a7f3f", "o"), "static force": ("#6a3d9a", "v"), "pressure": ("#6a3d9a", "s")}
BODY = "#d9dde2"
CREASE = np.cos(np.radians(30.0))  # neighbours that turn by more share an edge that is drawn
HALO = [withStroke(linewidth=2.5, foreground="white")]
LIGHT = np.array([0.3, 0.5, 0.81])  # in the axes of the view: right, up, to the eye


class Skin:
    """Outer faces of the mesh with their normals, and the edges where they turn."""

    def __init__(self, scene: Mapping[str, Any]) -> None:
        self.nodes = np.array(scene["nodes"], dtype=float)
        faces = np.array(scene["faces"], dtype=int)
        self.faces = np.where(faces < 0, faces[:, :1], faces)  # a triangle ends where it begins
        corners = self.nodes[self.faces]
        normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        triangle = faces[:, 3] < 0
        normals[triangle] = np.cross(corners[triangle, 1] - corners[triangle, 0],
                                     corners[triangle, 2] - corners[triangle, 0])
        self.normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        self.centres = corners.mean(axis=1)
        self.group = np.full(len(faces), "body", dtype=object)

    def mark(self, place: Mapping[str, Any]) -> None:
        """Faces whose corners all belong to a place are painted as such."""
        inside = np.zeros(len(self.nodes), dtype=bool)
        inside[place["nodes"]] = True
        self.group[inside[self.faces].all(axis=1)] = place["role"]

    def creases(self) -> Iterator[tuple[tuple[int, int], list[int]]]:
        """Node pairs where two faces meet at an angle, with a face each of them."""
        owners = {}
        for number, face in enumerate(self.faces.tolist()):
            for a, b in zip(face, face[1:] + face[:1]):
                if a != b:
                    owners.setdefault((min(a, b), max(a, b)), []).append(number)
        for edge, pair in owners.items():
            if len(pair) < 2 or self.normals[pair[0]] @ self.normals[pair[1]] < CREASE \
                    or self.group[pair[0]] != self.group[pair[1]]:
                yield edge, pair


def view_axes(up: np.ndarray, eye: np.ndarray) -> np.ndarray:
    """Rows: to the right, up, towards the eye."""
    eye = eye / np.linalg.norm(eye)
    right = np.cross(up, eye)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(eye, right), eye])


def two_views(skin: Skin, places: Sequence[Mapping[str, Any]]) -> list[np.ndarray]:
    """The first looks at the contact from above, the second from behind and below; the longest side stands upright."""
    up = np.zeros(3)
    longest = int(np.argmax(np.ptp(skin.nodes, axis=0)))
    up[longest] = 1.0
    fronts = [np.array(place["frame"][1]) for place in places if place["role"] == "contact"]
    front = fronts[0] if fronts else np.roll(up, 1)
    if abs(front @ up) > 0.8:
        front = np.roll(up, 1)
    side = np.cross(up, front)
    eye = front + 0.75 * side / np.linalg.norm(side) + 0.45 * up
    return [view_axes(up, eye), view_axes(up, -eye)]


def draw_skin(axes: Axes, skin: Skin, view: np.ndarray) -> np.ndarray:
    """Faces towards the eye, the farthest first, shaded by their angle to the light."""
    towards = skin.normals @ view[2] > 0.0
    order = np.flatnonzero(towards)[np.argsort((skin.centres @ view[2])[towards])]
    base = {name: np.array(to_rgb(colour)) for name, colour in {"body": BODY, **FACE_COLOURS}.items()}
    light = 0.68 + 0.32 * np.clip(skin.normals[order] @ view.T @ LIGHT, 0.0, 1.0)
    colours = [base[skin.group[face]] * share for face, share in zip(order, light)]
    flat = skin.nodes @ view[:2].T
    axes.add_collection(PolyCollection(flat[skin.faces[order]], facecolors=colours,
                                       edgecolors=colours, linewidths=0.3, rasterized=True))
    seen = [flat[list(edge)] for edge, pair in skin.creases() if any(towards[face] for face in pair)]
    axes.add_collection(LineCollection(seen, colors="0.25", linewidths=0.5, alpha=0.6))
    return flat


def arrow(axes: Axes, start: np.ndarray, step: np.ndarray, colour: str, text: str = "") -> None:
    """From a point along a projected vector; a vector towards the eye is a ring."""
    axes.annotate("", xy=start + step, xytext=start, zorder=6, annotation_clip=False,
                  arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 1.6, "shrinkA": 0,
                              "shrinkB": 0})
    if text:
        axes.annotate(text, xy=start + 1.2 * step, color=colour, ha="center", va="center", zorder=7, annotation_clip=False,
                      path_effects=HALO)


def draw_contact(axes: Axes, place: Mapping[str, Any], view: np.ndarray, length: float) -> None:
    """Axes p, q, r from the centroid."""
    start = view[:2] @ place["centre"]
    for name, axis in zip("pqr", place["frame"]):
        arrow(axes, start, length * view[:2] @ axis, TEXT_COLOURS["contact"], name)


def draw_marks(axes: Axes, places: Sequence[Mapping[str, Any]], view: np.ndarray, length: float, extent: np.ndarray) -> None:
    """Forces and output with arrows; names of places at one point stand below each other, outside the body."""
    taken = []
    for place in places:
        at = view[:2] @ place["centre"]
        colour, marker = MARKS.get(place["role"], (TEXT_COLOURS.get(place["role"]), ""))
        if place["role"] in MARKS:
            axes.plot(*at, marker=marker, color=colour, markersize=6, markeredgecolor="white", zorder=8)
            arrow(axes, at, length * view[:2] @ place["direction"], colour)
        side = 1.0 if at[0] >= extent[0].mean() else -1.0
        row = at[1]
        while any(s == side and abs(row - y) < 0.085 * extent[1].ptp() for s, y in taken):
            row -= 0.02 * extent[1].ptp()
        taken.append((side, row))
        edge = extent[0, 1 if side > 0 else 0] + side * 0.12 * extent[0].ptp()
        name = place["role"] if place["name"] == place["role"] else f"{place['role']}\n{place['name']}"
        axes.annotate(name, xy=at, xytext=(edge, row), color=colour,
                      ha="left" if side > 0 else "right", va="center", zorder=9, path_effects=HALO,
                      arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.6, "shrinkB": 4})


def draw_triad(axes: Axes, view: np.ndarray, extent: np.ndarray, length: float) -> None:
    """The axes x, y, z of the mesh in the corner."""
    corner = np.array([extent[0, 0] - 0.3 * extent[0].ptp(), extent[1, 0] - 0.12 * extent[1].ptp()])
    for name, axis in zip("xyz", np.eye(3)):
        arrow(axes, corner, 0.6 * length * view[:2] @ axis, "0.35", name)


def plot_scene(data: str, picture: str) -> None:
    with open(data, encoding="utf-8") as file:
        scene = json.load(file)
    skin, places = Skin(scene), scene["places"]
    for role in ("clamped", "contact"):
        for place in places:
            if place["role"] == role:
                skin.mark(place)
    figure, panels = subplots(1, 2, (9.0, 5.6))
    length = 0.16 * np.ptp(skin.nodes, axis=0).max()
    for axes, view, title in zip(panels, two_views(skin, places), ("towards the contact", "from behind and below")):
        flat = draw_skin(axes, skin, view)
        extent = np.array([flat.min(axis=0), flat.max(axis=0)]).T
        for place in places:
            if place["role"] == "contact":
                draw_contact(axes, place, view, length)
        draw_marks(axes, places, view, length, extent)
        draw_triad(axes, view, extent, length)
        axes.set_aspect("equal")
        axes.set_xlim(extent[0] + 0.3 * extent[0].ptp() * np.array([-1.0, 1.0]))
        axes.set_ylim(extent[1] + extent[1].ptp() * np.array([-0.15, 0.08]))
        axes.set_axis_off()
        axes.set_title(title, color="0.4")
    size = " × ".join(f"{1000.0 * side:.4g}" for side in np.ptp(skin.nodes, axis=0))
    figure_title(figure, f"{scene['title'] or 'scene'}: {size} mm")
    legend_below(figure, [Patch(facecolor=colour, label=name) for name, colour in FACE_COLOURS.items()]
                 + [Line2D([], [], color=colour, marker=marker, linestyle="", label=name)
                    for name, (colour, marker) in MARKS.items() if any(place["role"] == name for place in places)])
    save_as(figure, picture)
