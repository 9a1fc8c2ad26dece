#!/usr/bin/env python3
"""A bar of wedges, or of wedges, pyramids and hexahedra, rubs as one of hexahedra does.

A cantilever of square section, in quadratic elements: hexahedra; wedges, triangles extruded across the bar; columns of
hexahedra, of wedges and of pyramids around the middle of each brick, in turn. It is rubbed once on its upper face,
where all have quadrilaterals, once on the face wedges were extruded to, where they have triangles. By symmetry
hexahedra give the same on both. Peaks of the free, the stuck and a sliding bar agree with those of hexahedra to the error of the mesh, which
is told by a mesh of hexahedra twice as fine.

usage: wedges_and_pyramids.py MICROSLIP SOURCE WORK_FOLDER
"""
import csv
import json
import os
import shutil
import sys

from program_run import run_scene

CELLS = (12, 2, 2)
SIZE = (0.1, 0.02, 0.02)

# gmsh's manual, "Node ordering": type of the file, edges.
KINDS = {
    "hexahedron": (17, "01 03 04 12 15 23 26 37 45 47 56 67"),
    "wedge": (18, "01 02 03 12 14 25 34 35 45"),
    "pyramid": (19, "01 03 04 12 14 23 24 34"),
    "triangle": (9, "01 12 20"),
    "quadrilateral": (16, "01 12 23 30"),
}
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
FACES = {"bottom": (0, 3, 2, 1), "side": (4, 5, 6, 7), "front": (0, 1, 5, 4), "end": (1, 2, 6, 5), "top": (2, 3, 7, 6),
         "root": (3, 0, 4, 7)}

SCENE = """
[model]
kind = "mesh"
file = "{mesh}.msh"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["root"]
[modes]
count = 6
damping_ratio = 0.005
[contact]
surface = "{face}"
slip_direction = {along}
friction_coefficient = 0.4
normal_stiffness = "5e9 N/m^3"
tangential_stiffness = "5e9 N/m^3"
[excitation]
forces = [ {{ at = "tip", direction = {force}, amplitude = "10 N" }} ]
[response]
output = {{ at = "tip", direction = {along} }}
frequency = ["1500 Hz", "3000 Hz"]
preload = ["free", 100, "stuck"]
maps = ["peak"]
map_phases = 4
harmonics = 1
[effects]
second_direction = "off"
[accuracy]
error_budget = "off"
"""
DIRECTIONS = {"top": ("[0, 0, 1]", "[0, 0.4, 1]"), "side": ("[0, 1, 0]", "[0, 1, 0.4]")}  # slip, force


def kind_in(mesh, column):
    return ("hexahedron", "wedge", "pyramid")[column % 3] if mesh == "mixed" else mesh


def parts_of(kind, brick):
    """(kind, corners) of the elements in a brick."""
    if kind == "wedge":
        return [("wedge", [brick[i] for i in half]) for half in ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))]
    if kind == "pyramid":
        middle = tuple((brick[0][d] + brick[6][d]) // 2 for d in range(3))
        return [("pyramid", [brick[i] for i in reversed(face)] + [middle]) for face in FACES.values()]
    return [("hexahedron", brick)]


def faces_of(kind, name, brick):
    """The part of a brick's surface named, in the faces of its elements."""
    face = [brick[i] for i in FACES[name]]
    if kind == "wedge" and name == "side":
        return [("triangle", [face[0], face[1], face[2]]), ("triangle", [face[0], face[2], face[3]])]
    return [("quadrilateral", face)]


class Mesh:
    """Nodes by their place in quarters of a cell, so that middles of edges and bricks are whole numbers."""

    def __init__(self):
        self.nodes = {}
        self.elements = []

    def node(self, place):
        return self.nodes.setdefault(place, len(self.nodes) + 1)

    def add(self, kind, group, corners):
        number, edges = KINDS[kind]
        nodes = [self.node(corner) for corner in corners]
        for a, b in edges.split():
            ends = corners[int(a)], corners[int(b)]
            nodes.append(self.node(tuple((ends[0][d] + ends[1][d]) // 2 for d in range(3))))
        self.elements.append((number, group, nodes))

    def write(self, path, cells):
        names = [(3, "body"), (2, "root"), (2, "top"), (2, "side"), (0, "tip")]
        with open(path, "w", encoding="ascii") as out:
            out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n%d\n" % len(names))
            out.writelines('%d %d "%s"\n' % (d, i, n) for i, (d, n) in enumerate(names, start=1))
            out.write("$EndPhysicalNames\n$Nodes\n%d\n" % len(self.nodes))
            for place, number in self.nodes.items():
                out.write("%d %.17g %.17g %.17g\n" % (number, *(SIZE[d] * place[d] / (4 * cells[d]) for d in range(3))))
            out.write("$EndNodes\n$Elements\n%d\n" % len(self.elements))
            for number, (kind, group, nodes) in enumerate(self.elements, start=1):
                out.write("%d %d 2 %d %d %s\n" % (number, kind, group, group, " ".join(map(str, nodes))))
            out.write("$EndElements\n")


def write_bar(path, kinds, cells):
    mesh = Mesh()
    for k in range(cells[2]):
        for j in range(cells[1]):
            for i in range(cells[0]):
                brick = [tuple(4 * (index + c) for index, c in zip((i, j, k), corner)) for corner in CORNERS]
                kind = kind_in(kinds, i)
                for part, corners in parts_of(kind, brick):
                    mesh.add(part, 1, corners)
                outer = {"root": i == 0, "top": j == cells[1] - 1 and 2 * i >= cells[0],
                         "side": k == cells[2] - 1 and 2 * i >= cells[0]}
                for group, name in enumerate(("root", "top", "side"), start=2):
                    for part, corners in faces_of(kind, name, brick) if outer[name] else []:
                        mesh.add(part, group, corners)
    mesh.elements.append((15, 5, [mesh.node(tuple(4 * c // (1 if d == 0 else 2) for d, c in enumerate(cells)))]))
    mesh.write(path, cells)


def curves(folder):
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as text:
        found = {curve["name"]: curve for curve in json.load(text)["curves"]}
    assert all(curve["complete"] and curve["peak"] for curve in found.values()), folder
    return {name: (curve["peak"]["frequency_Hz"], curve["peak"]["amplitude_m"]) for name, curve in found.items()}


def frequencies(folder):
    with open(os.path.join(folder, "modes.csv"), encoding="utf-8") as lines:
        return [float(row["frequency_Hz"]) for row in csv.DictReader(lines) if row["kind"] == "free"]


def difference(one, other):
    """Largest of frequencies of modes; of frequencies and of amplitudes of peaks."""
    modes = max(abs(a / b - 1) for a, b in zip(one[0], other[0]))
    peaks = [max(abs(one[1][name][i] / other[1][name][i] - 1) for name in other[1]) for i in (0, 1)]
    return [modes, *peaks]


def main():
    program, _, folder = sys.argv[1:4]
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    fine = tuple(2 * n for n in CELLS)
    for name, kinds, cells in (("hexahedron", "hexahedron", CELLS), ("wedge", "wedge", CELLS),
                               ("mixed", "mixed", CELLS), ("fine", "hexahedron", fine)):
        write_bar(os.path.join(folder, name + ".msh"), kinds, cells)

    def solved(mesh, face):
        along, force = DIRECTIONS[face]
        scene = os.path.join(folder, f"{mesh}_{face}.toml")
        with open(scene, "w", encoding="utf-8") as out:
            out.write(SCENE.format(mesh=mesh, face=face, along=along, force=force))
        run = run_scene(program, scene, scene[:-len(".toml")], options=("-j1",))
        return frequencies(run), curves(run)

    hexahedra = {face: solved("hexahedron", face) for face in DIRECTIONS}
    assert max(difference(hexahedra["top"], hexahedra["side"])) < 1e-6, difference(hexahedra["top"], hexahedra["side"])
    of_mesh = difference(hexahedra["top"], solved("fine", "top"))
    print("hexahedra against finer ones: modes %.1e, peaks %.1e, amplitudes %.1e" % tuple(of_mesh))
    for mesh in ("wedge", "mixed"):
        for face in DIRECTIONS:
            found = difference(solved(mesh, face), hexahedra[face])
            print("%s, rubbed on the %s: modes %.1e, peaks %.1e, amplitudes %.1e" % (mesh, face, *found))
            for error, allowed in zip(found, of_mesh):
                assert error < allowed, (mesh, face, found, of_mesh)


if __name__ == "__main__":
    main()
