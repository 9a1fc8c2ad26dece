#!/usr/bin/env python3
"""share/scripts/convert_mesh.py: node orders, names, bad input.

Row 56. Hard: every code has an order of nodes of its own, and a straight element hides a wrong one.
Met in: decks of Abaqus, Nastran and others.
Right: one curved element of each type keeps its volume.

Files are written by tests/support/mesh_files.py, from the manuals of the codes; what comes out is put in order by
meshio's table of gmsh's orders, which knows nothing of ours. Node orders: one curved element of every type, so that an edge node
in another's place is 0.01 or more away.

usage: mesh_conversion.py SOURCE
"""
import importlib.util
import json
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest

import meshio
import meshio.gmsh.common as gmsh_tables
import numpy as np

SOURCE = sys.argv.pop(1)
sys.path.insert(0, os.path.join(SOURCE, "tests", "support"))
import mesh_files

SCRIPT = os.path.join(SOURCE, "share", "scripts", "convert_mesh.py")
spec = importlib.util.spec_from_file_location("convert_mesh", SCRIPT)
convert_mesh = importlib.util.module_from_spec(spec)
spec.loader.exec_module(convert_mesh)
from microslip.meshes import abaqus
meshio._mesh.topological_dimension.update(wedge15=3, pyramid13=3)  # or meshio 5.0 ends on them
ALL = ("tetra", "tetra10", "hexahedron", "hexahedron20", "wedge", "wedge15", "pyramid", "pyramid13")
WITHOUT_PYRAMIDS = ALL[:6]
FORMATS = {".inp": (mesh_files.write_inp, ALL), ".bdf": (mesh_files.write_bdf, ALL), ".unv": (mesh_files.write_unv, WITHOUT_PYRAMIDS),
           ".med": (mesh_files.write_med, ALL), ".vtu": (mesh_files.write_vtk, ALL), ".vtk": (mesh_files.write_vtk, ALL),
           ".e": (mesh_files.write_exodus, ALL)}
TOLERANCE = {".bdf": 1e-9}  # ten digits in a field; the others hold doubles
NEEDS = {".e": "netCDF4", ".med": "h5py"}

# A bar of two bricks along x, 1 x 1 each.
BAR = """*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 2, 0, 0
4, 0, 1, 0
5, 1, 1, 0
6, 2, 1, 0
*NODE
11, 0, 0, 1
12, 1, 0, 1
13, 2, 0, 1
14, 0, 1, 1
15, 1, 1, 1
16, 2, 1, 1
*ELEMENT, TYPE=C3D8, ELSET=left
7, 1, 2, 5, 4, 11, 12, 15, 14
*ELEMENT, TYPE=C3D8, ELSET=right
8, 2, 3, 6, 5, 12,
13, 16, 15
"""


class Converted:
    """What the script makes of a file, or says; without a process of its own, which takes a second to start."""

    def __init__(self, path):
        with tempfile.TemporaryDirectory() as folder:
            output, facts = os.path.join(folder, "mesh.msh"), os.path.join(folder, "facts.json")
            self.code, self.message = 0, ""
            try:
                convert_mesh.convert(path, output, facts)
            except Exception as error:  # as main() does
                self.code, self.message = 1, convert_mesh.problem_of(path, error)
                return
            with open(facts, encoding="utf-8") as file:
                facts = json.load(file)
            self.length_unit, self.left_out = facts["length_unit"], facts["left_out"]
            self._read(output)

    def _read(self, path):
        """gmsh 2.2, binary. meshio's reader of it wants nodes numbered without gaps; its tables of types and node orders
        are right."""
        with open(path, "rb") as file:
            lines, names = iter(file.readline, b""), {}
            while next(lines) != b"$PhysicalNames\n":
                pass
            for _ in range(int(next(lines))):
                dimension, tag, name = next(lines).decode().strip().split(" ", 2)
                names[int(tag), int(dimension)] = name.strip('"')
            while next(lines) != b"$Nodes\n":
                pass
            nodes = np.fromfile(file, np.dtype([("number", "<i4"), ("place", "<f8", 3)]), int(next(lines)))
            places = dict(zip(nodes["number"].tolist(), nodes["place"]))
            while next(lines) != b"$Elements\n":
                pass
            self.elements, self.surfaces, self.sets = [], {name: [] for (_, dim), name in names.items() if dim == 2}, {}
            left = int(next(lines))
            while left:
                number, n, n_tags = np.fromfile(file, "<i4", 3)
                kind = gmsh_tables._gmsh_to_meshio_type[number]
                rows = np.fromfile(file, "<i4", n * (1 + n_tags + meshio._mesh.num_nodes_per_cell[kind])).reshape(n, -1)
                for tag, row in zip(rows[:, 1], gmsh_tables._gmsh_to_meshio_order(kind, rows[:, 1 + n_tags:])):
                    self._take(kind, names, int(tag), np.array([places[node] for node in row]))
                left -= n

    def _take(self, kind, names, tag, row):
        if kind in ("triangle", "quad"):
            self.surfaces[names[tag, 2]].append(_places(row))
        elif kind == "vertex":
            self.sets.setdefault(names[tag, 0], []).append(tuple(row[0]))
        else:
            self.elements.append((kind, row))


def _places(rows):
    return {tuple(float(x) for x in row) for row in rows}


class Conversion(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def deck(self, text, name="deck.inp"):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return Converted(self.path(name))

    def refused(self, text, *words, name="deck.inp"):
        result = self.deck(text, name)
        self.assertEqual(result.code, 1, "read without complaint")
        for word in words:
            self.assertIn(word, result.message)

    def left_out(self, text, name="deck.inp"):
        """Lines and what stands there that another structure would be without, how many of it."""
        result = self.deck(text, name)
        self.assertEqual(result.code, 0, result.message)
        return [(entry["place"].removeprefix(self.path(name) + ":"), entry["what"], entry["count"]) for entry in result.left_out]

    def assert_names(self, result, surfaces, sets):
        self.assertEqual(result.code, 0, result.message)
        self.assertEqual({name: len(rows) for name, rows in result.surfaces.items()}, surfaces)
        self.assertEqual({name: len(rows) for name, rows in result.sets.items()}, sets)


class NodeOrders(Conversion):
    def check(self, ending):
        if ending in NEEDS and importlib.util.find_spec(NEEDS[ending]) is None:
            self.skipTest(f"{NEEDS[ending]} is not installed: {ending} cannot be read")
        write, types = FORMATS[ending]
        for kind in types:
            with self.subTest(type=kind):
                mesh = mesh_files.curved_element(kind)
                write(mesh, self.path("one" + ending))
                result = Converted(self.path("one" + ending))
                self.assertEqual(result.code, 0, result.message)
                (found, nodes), = result.elements
                self.assertEqual(found, kind)
                np.testing.assert_allclose(nodes, mesh.nodes, rtol=0, atol=TOLERANCE.get(ending, 0))


for ending in FORMATS:
    setattr(NodeOrders, f"test_curved_elements_{ending[1:]}", lambda self, ending=ending: self.check(ending))


class AbaqusDecks(Conversion):
    def test_several_blocks_of_nodes_and_elements(self):
        result = self.deck(BAR)
        self.assert_names(result, {}, {"left": 8, "right": 8})
        self.assertEqual(len(result.elements), 2)

    def test_sets_of_sets_generated_sets_and_overlapping_names(self):
        result = self.deck(BAR + "*NSET, NSET=foot, GENERATE\n1, 11, 10\n4, 14, 10\n*nset, nset=both\nfoot, 13\n"
                           "*NSET, NSET=Foot\n2\n*ELSET, ELSET=foot\nleft\n*SURFACE, NAME=foot\nRIGHT, S4\n")
        self.assert_names(result, {"foot": 1}, {"foot": 5, "both": 6, "left": 8, "right": 8})
        self.assertEqual(result.surfaces["foot"], [_places([(2, 0, 0), (2, 1, 0), (2, 1, 1), (2, 0, 1)])])

    def test_surfaces_of_elements_faces_and_nodes(self):
        result = self.deck(BAR + "*SURFACE, NAME=top, TYPE=ELEMENT\nleft, S2\n8, S2\n*SURFACE, NAME=skin\nright,\n"
                           "*SURFACE, NAME=end, TYPE=NODE\n3, 1.\n6\n13\n16\n")
        self.assert_names(result, {"top": 2, "skin": 5}, {"end": 4, "left": 8, "right": 8})

    def test_every_face_of_every_element(self):
        for kind in ALL:
            mesh = mesh_files.curved_element(kind)
            corners = [[int(digit) - 1 for digit in face] for face in mesh_files.ABAQUS_FACES[kind.rstrip("0123456789")]]
            mesh.surfaces = {f"face {i}": [face] for i, face in enumerate(corners, 1)}
            mesh_files.write_inp(mesh, self.path("faces.inp"))
            result = Converted(self.path("faces.inp"))
            for i, face in enumerate(corners, 1):
                with self.subTest(type=kind, face=i):
                    self.assertEqual(result.surfaces[f"face {i}"], [_places(mesh.nodes[face])])

    def test_names_in_utf_8_and_latin_1(self):
        for encoding in ("utf-8", "latin-1", "utf-8-sig"):
            with open(self.path("deck.inp"), "w", encoding=encoding) as file:
                file.write(BAR + "*NSET, NSET=Schaufelfuß\n1, 4\n")
            with self.subTest(encoding=encoding):
                self.assertIn("Schaufelfuß", Converted(self.path("deck.inp")).sets)

    def test_data_lines_in_a_file_of_their_own(self):
        for card, file in (("*NODE\n11,", "nodes.txt"), ("*ELEMENT, TYPE=C3D8, ELSET=right\n8", "bricks.txt")):
            keyword = card.split("\n")[0]
            before, after = BAR.split(card)
            data = card.split("\n")[1] + after
            data, rest = data.split("*", 1) if "*" in data else (data, None)
            with open(self.path(file), "w", encoding="utf-8") as stream:
                stream.write(data)
            result = self.deck(before + keyword + f", INPUT={file}\n" + ("*" + rest if rest else ""))
            with self.subTest(keyword=keyword):
                self.assertEqual(result.code, 0, result.message)
                self.assertEqual(len(result.elements), 2)
        self.refused(BAR.replace("ELSET=left", "ELSET=left, INPUT=nowhere.txt"), "deck.inp:15: ", "nowhere.txt cannot be read")
        self.refused(BAR.replace("ELSET=left", "ELSET=left,\nINPUT=nowhere.txt"), "deck.inp:16: ", "nowhere.txt cannot be read")

    def test_numbers_beyond_32_bits(self):
        self.refused(BAR.replace("7, 1, 2", "3000000000, 1, 2"), "deck.inp: element 3000000000", "at most 2000000000")
        self.refused(BAR.replace("\n6, 2, 1", "\n5000000006, 2, 1").replace("3, 6, 5", "3, 5000000006, 5"), "node 5000000006")

    def test_a_deck_that_includes_itself(self):
        self.refused(BAR + "*INCLUDE, INPUT=deck.inp\n", "deck.inp:20: *INCLUDE", "which includes this file")

    def test_included_files(self):
        with open(self.path("mesh of it.inp"), "w", encoding="utf-8") as file:
            file.write(BAR)
        result = self.deck("*HEADING\n*INCLUDE, INPUT=mesh of it.inp\n*NSET, NSET=a\n1\n")
        self.assert_names(result, {}, {"a": 1, "left": 8, "right": 8})
        self.refused("*INCLUDE, INPUT=gone.inp\n", "deck.inp:1", "gone.inp cannot be read")
        self.refused("*INCLUDE, INPUT=deck.inp\n", "which includes this file")

    def test_trusses_and_shells_that_name_edges_and_faces(self):
        """As gmsh writes them."""
        result = self.deck(BAR + "*ELEMENT, TYPE=T3D2, ELSET=edge\n99, 1, 2\n*ELEMENT, TYPE=S4, ELSET=skin\n98, 1, 4, 5, 2\n")
        self.assert_names(result, {"skin": 1}, {"edge": 2, "left": 8, "right": 8})

    def test_what_holds_the_structure_together_is_told(self):
        for deck, told in (("*MPC\nBEAM, 1, 2\n*TIE, NAME=t\na, b\n*MPC\nBEAM, 2, 3\n", [("20", "*MPC", 2), ("22", "*TIE", 1)]),
                           ("*ELEMENT, TYPE=B31H, ELSET=beam\n99, 1, 12\n", [("20", "*ELEMENT, TYPE=B31H (beams)", 1)]),
                           ("*ELEMENT, TYPE=S4\n98, 1, 4, 5, 2\n99, 1, 2, 6, 3\n",
                            [("22", "element 99, a shell that lies on no face of a solid", 1)]),
                           ("*ELEMENT, TYPE=T3D2\n97, 1, 2\n98, 1, 12\n99, 1, 15\n",
                            [("22", "element 98, a truss that lies on no edge of a solid", 2)]),
                           ("*ELEMENT, TYPE=T3D2, ELSET=wire\n97, 1, 2\n*SOLID SECTION, ELSET=wire, MATERIAL=m\n0.5\n",
                            [("22", 'the cross-section of trusses in "wire"', 1)]),
                           ("*SOLID SECTION, ELSET=left, MATERIAL=m\n1.\n", [])):
            with self.subTest(deck=deck):
                self.assertEqual(self.left_out(BAR + deck), told)

    def test_an_instance_where_its_part_lies(self):
        assembly = ("*PART, NAME=Blade\n" + BAR + "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=Blade-1, PART=Blade\n{}"
                    "*END INSTANCE\n*NSET, NSET=tip, INSTANCE=Blade-1\n3, 6\n*ELSET, ELSET=_f, INTERNAL, INSTANCE=Blade-1\n 8,\n"
                    "*SURFACE, NAME=end\n_f, S4\n*NSET, NSET=same\nBlade-1.13\n*SURFACE, NAME=free\nBlade-1.left\n*END ASSEMBLY\n")
        self.assert_names(self.deck(assembly.format("")), {"end": 1, "free": 5}, {"tip": 2, "same": 1, "left": 8, "right": 8})
        self.refused(assembly.format("0., 0., z\n"), "deck.inp:24", "expected a translation of 3 numbers, found 0., 0., z")
        self.refused(assembly.format("0., 0., 5.\n0., 0., 0., 0., 0., 0., 90.\n"), "deck.inp:25", "the two points of the axis are one")
        self.refused(assembly.format("0., 0., 5.\n0., 0., 0., 0., 0., 1., 90.\n1., 2., 3.\n"), "deck.inp:26", "no third line")
        self.refused(assembly.format("*END INSTANCE\n*INSTANCE, NAME=Blade-2, PART=Blade\n"), "deck.inp:25", "one instance")

    def test_an_instance_that_is_moved_and_turned(self):
        """First moved, then turned, as the manual has it."""
        assembly = ("*PART, NAME=Blade\n" + BAR + "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=Blade-1, PART=Blade\n{}"
                    "*END INSTANCE\n*END ASSEMBLY\n")

        def corners(lines):
            return np.concatenate([row for _, row in self.deck(assembly.format(lines)).elements])

        here = corners("")
        np.testing.assert_allclose(corners("0., 0., 5.\n"), here + [0, 0, 5])
        turned = corners("1., 0., 0.\n2., 0., 0., 2., 0., 1., 90.\n")
        x, y, z = (here + [1, 0, 0]).T  # about the line x = 2, y = 0
        np.testing.assert_allclose(turned, np.column_stack([2 - y, x - 2, z]), atol=1e-14)

    def test_what_is_wrong_is_told_by_its_line(self):
        self.refused("solid cube", "deck.inp: no *NODE")
        self.refused(BAR.replace("C3D8, ELSET=right", "C3D27, ELSET=right"), "deck.inp:17", "C3D27")
        self.refused(BAR.replace("13, 16, 15\n", "13, 16\n"), "deck.inp:18", "element 8")
        self.refused(BAR.replace("13, 16, 15\n", "13, 16, 99\n"), "element 8 uses node 99")
        self.refused(BAR.replace("6, 2, 1, 0", "5, 2, 1, 0"), "deck.inp: node 5 stands twice", "deck.inp:6 and ", "deck.inp:7;")
        self.refused(BAR.replace("\n8, 2", "\n7, 2"), "deck.inp: element 7 stands twice", "deck.inp:16 and ", "deck.inp:18;")
        self.refused(BAR.replace("6, 2, 1, 0", "6, two, 1, 0"), "deck.inp:7", '"two"')
        self.refused(BAR.replace("6, 2, 1, 0", "6, nan, 1, 0"), "node 6", "finite")
        self.refused(BAR + "*NSET, NSET=a\nfeet\n", "deck.inp:21", '"feet"')
        self.refused(BAR + "*NSET, NSET=a\n77\n", '"a" holds node 77')
        self.refused(BAR + "*NSET, NSET=a\nb\n*NSET, NSET=b\na\n", "made of itself")
        self.refused(BAR + "*SURFACE, NAME=s\nleft, S7\n", "deck.inp:21", "S7")
        self.refused(BAR + "*SURFACE, NAME=s\nup, S1\n", "deck.inp:21", '"up"', "left, right")
        self.refused(BAR + "*SURFACE, NAME=s\nleft, S1\n*SURFACE, NAME=S\nleft, S2\n", "deck.inp:22", "deck.inp:20")
        self.refused(BAR + "*SURFACE, NAME=s\nleft, S1\n77, S1\n", "deck.inp:22", 'surface "s": element 77 is not there')
        self.refused(BAR.replace("C3D8, ELSET=left", "C3D8") + "*ELEMENT, TYPE=C3D4\n9, 1, 2, 4, 11\n*SURFACE, NAME=s\n9, S5\n",
                     "deck.inp:23", "element 9, a tetra, has no face S5")
        self.assertEqual(self.deck(BAR + "*NSET, NSET=a\n11, 12").code, 0)  # the last line needs no end
        self.refused(BAR + "*NGEN\n1, 3, 1\n", "deck.inp:20", "node by node")
        self.refused(BAR + "*NSET, NSET=Foot\n1\n*SURFACE, NAME=foot\nleft, S1\n", "deck.inp:22", '"foot"', '"Foot"', "case")
        self.refused(BAR.replace("*NODE\n1,", "*NODE, SYSTEM=C\n1,"), "deck.inp:1", "rectangular")

    def test_decimal_commas(self):
        for nodes in ("1, 0,5, 2,0, 3,5", "1, 2, 0,5, 3,0", "1, 0,5, 2,25, 3"):
            self.refused(f"*NODE\n{nodes}\n", "deck.inp:2: *NODE: ", "decimal commas")
        self.refused("*NODE\n1; 0,5; 2,0; 3,5\n", "deck.inp:2: *NODE: ", "parted by commas")
        normals = BAR.replace("\n1, 0, 0, 0\n", "\n1, 0, 0, 0, 0, 0, -1\n").replace("\n2, 1, 0, 0\n", "\n2, 1, 0, 0, 0, 0, 0\n")
        self.assertEqual(self.deck(normals).code, 0)
        self.assertEqual(self.deck(normals.replace("0, 0, -1", "0., 0., -2.")).code, 0)

    def test_one_thing_without_end_is_told_early(self):
        """Not at the end of 120 MB: hundreds of them took minutes."""
        heads = {"node": "*NODE\n", "element": BAR + "*ELEMENT, TYPE=C3D8\n", "node in": "*NODE\n", "node of": "*PART, NAME=p\n*NODE\n"}
        for what, line in (("node", "1, 0, 0, 0\n"), ("element", "9, 1, 2, 5, 4, 11, 12, 15, 14\n"), ("node in", "1, 0, 0, 0\n*NODE\n"),
                           ("node of", "1, 0, 0, 0\n2, 0, 0, 1\n")):
            with self.subTest(what), open(self.path("deck.inp"), "w", encoding="utf-8") as file:
                file.write(heads[what])
                for _ in range(120):
                    file.write(line * (1_000_000 // len(line)))
                file.flush()
                began = time.process_time()
                message = Converted(self.path("deck.inp")).message
                self.assertLess(time.process_time() - began, 2.0)
                self.assertIn(f"{what.split()[0]} {line[0]} stands twice, at ", message)

    def test_a_long_table_is_read_as_a_short_one(self):
        """Longer than is read at a time, with lines of one element on either side of the joint."""
        n = 3 * (abaqus._PIECE // 2) + 1
        nodes = "".join(f"{i}, {i // 4}, {i // 2 % 2}, {i % 2}\n" for i in range(4 * n + 4))
        bricks = "".join(f"{9 + i}, {4 * i}, {4 * i + 4}, {4 * i + 6}, {4 * i + 2}, {4 * i + 1},\n{4 * i + 5}, {4 * i + 7}, {4 * i + 3}\n"
                         for i in range(n))
        deck = f"*NODE\n0, 0, 0, 0\n*NODE\n{nodes.split(chr(10), 1)[1]}*ELEMENT, TYPE=C3D8\n{bricks}"
        elements = self.deck(deck).elements
        self.assertEqual(len(elements), n)
        last = elements[-1][1]
        np.testing.assert_array_equal([last.min(axis=0), last.max(axis=0)], [[n - 1, 0, 0], [n, 1, 1]])
        again = deck.replace(f"\n{8 + n}, {4 * n - 4}, ", f"\n9, {4 * n - 4}, ")
        lines = deck.split("\n")
        first = lines.index("*ELEMENT, TYPE=C3D8") + 2
        self.refused(again, f"element 9 stands twice, at {self.path('deck.inp')}:{first} and ", f"deck.inp:{len(lines) - 2};")


NASTRAN = """SOL 103
CEND
SET 4 = 1 THRU 4,
 11
BEGIN BULK
$HMSET        4        1 "tip nodes"
$HMNAME PROP                   3"steel" 4
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID    4               0.      1.      0.
GRID*                 11                              0.              0.*
*                    1.0
GRID,3,,.2-1,-1.+0,0.
CTETRA  8       3       1       2       4       11
CTETRA,9,7,1,3,2,
,11
SPC1,1,123,1,THRU,4,EXCEPT,3
PLOAD4,6,8,1.,,,,1,11
ENDDATA
"""


class NastranDecks(Conversion):
    def test_fields_free_and_fixed_and_names(self):
        result = self.deck(NASTRAN, "deck.bdf")
        self.assert_names(result, {"PLOAD4 6": 1}, {"SPC 1": 3, "steel": 4, "PID 7": 4})
        self.assertIn((0.02, -1.0, 0.0), {tuple(node) for _, nodes in result.elements for node in nodes})
        self.assertEqual(result.surfaces["PLOAD4 6"], [_places([(0, 0, 0), (1, 0, 0), (0, 1, 0)])])

    def test_what_holds_the_structure_together_is_told(self):
        for name in ("CBAR", "CFOO", "CONM2", "CELAS1", "CBUSH1D", "CTRIAX6", "RBE2", "RBAR"):
            card = f"{name},3,1,1,2\n"
            self.assertEqual(self.left_out(NASTRAN.replace("ENDDATA", 2 * card + "ENDDATA"), "deck.bdf"), [("19", name, 2)])

        for name in ("RSPLINE,3,.1,1,2", "RJOINT,3,1,2", "RSSCON,3,GRID,1,2"):
            self.assertEqual(self.left_out(NASTRAN.replace("ENDDATA", name + "\nENDDATA"), "deck.bdf"), [("19", name.split(",")[0], 1)])

    def test_what_case_control_selects_is_told(self):
        """Equations and matrices; without case control nothing tells that they are not."""
        equation, matrix = "MPC,5,1,1,1.,2,1,-1.\nENDDATA", "DMIG,KADD,0,6,1,0\nENDDATA"
        for card, statement, told in ((equation, "", []), (equation, "MPC = 5\n", [("20", "MPC", 1)]), (equation, "MPC = 6\n", []),
                                      (matrix, "", []), (matrix, "K2GG = KADD\n", [("20", "DMIG", 1)])):
            with self.subTest(card=card[:4], statement=statement):
                deck = NASTRAN.replace("ENDDATA", card).replace("CEND\n", "CEND\n" + statement)
                self.assertEqual(self.left_out(deck, "deck.bdf"), told)
        alone = NASTRAN.replace("ENDDATA", equation).split("BULK\n")[1]
        self.assertEqual([what for _, what, _ in self.left_out(alone, "deck.nas")], ["MPC"])

    def test_cards_that_are_no_elements_are_passed_over(self):
        for card in ("CBARAO,9,FR,0.5", "CORD2R,5,,0.,0.,0.,0.,0.,1.\n+,1.,0.,0.", "RBE3,9,,4,123,1.,123,1,2", "PLOTEL,7,1,2"):
            self.assertEqual(self.left_out(NASTRAN.replace("ENDDATA", card + "\nENDDATA"), "deck.bdf"), [], card)

    def test_bulk_data_alone(self):
        self.assertEqual(self.deck(NASTRAN.split("BULK\n")[1], "deck.nas").code, 0)

    def test_what_is_wrong_is_told_by_its_line(self):
        self.refused("solid cube", "deck.bdf: no GRID", name="deck.bdf")
        self.refused(NASTRAN.replace("GRID,1,,", "GRID,1,5,"), "deck.bdf:8", "coordinate system 5", name="deck.bdf")
        self.refused(NASTRAN.replace(",9,7,1,3,2,", ",9,7,1,3,"), "deck.bdf:15", "has 3 nodes", name="deck.bdf")
        self.refused(NASTRAN.replace("GRID,2,,1.", "GRID,2,,one"), "deck.bdf:9", '"one"', name="deck.bdf")
        self.refused(NASTRAN.replace("GRID,3,", "GRID,2,"), "deck.bdf: node 2 stands twice, at ", "deck.bdf:9 and ", "deck.bdf:13;",
                     name="deck.bdf")
        self.refused(NASTRAN.replace("CTETRA,9", "CTETRA,8"), "deck.bdf: element 8 stands twice, at ", "deck.bdf:14 and ",
                     "deck.bdf:15;", name="deck.bdf")
        self.refused(NASTRAN.replace("GRID,3,", "GRID,33,"), "element 9 uses node 3", name="deck.bdf")
        self.refused(NASTRAN.replace("ENDDATA", "GRID,90,,0.,0.,0.\n=,*1,=,*1.,==\nENDDATA"), "deck.bdf:20", "write them out",
                     name="deck.bdf")
        self.refused(NASTRAN.replace("GRID,1,,", "GRDSET,,6\nGRID,1,,"), "deck.bdf:8", "GRDSET", "coordinate system 6", name="deck.bdf")

    def test_an_empty_default_of_nodes(self):
        self.assertEqual(self.deck(NASTRAN.replace("GRID,1,,", "GRDSET,,0,,,,,456\nGRID,1,,"), "deck.bdf").code, 0)

    def test_one_thing_without_end_is_told_early(self):
        for kind, head, line in (("node 1", "", "GRID,1,,0.,0.,0.\n"), ("node 1", "SOL 103\nCEND\nBEGIN BULK\n", "GRID,1,,0.,0.,0.\n"),
                                 ("element 8", "GRID,1,,0.,0.,0.\n", "CTETRA,8,3,1,2,4,11\n")):
            with self.subTest(kind), open(self.path("deck.bdf"), "w", encoding="utf-8") as file:
                file.write(head)
                for _ in range(60):
                    file.write(line * (1_000_000 // len(line)))
                file.flush()
                began = time.process_time()
                message = Converted(self.path("deck.bdf")).message
                self.assertLess(time.process_time() - began, 2.0)
                self.assertIn(f"{kind} stands twice, at ", message)

    def test_two_sets_of_one_number(self):
        """Once more the same is no harm, as in several subcases; cards of one SPC set add up."""
        self.refused(NASTRAN.replace("ENDDATA", "SET1,4,1,2\nENDDATA"), "deck.bdf:19: SET 4 is there already with other nodes", "deck.bdf:3",
                     name="deck.bdf")
        again = NASTRAN.replace("ENDDATA", "SET1,4,1,2,3,4,11\nSPC1,1,123,11\nENDDATA")
        result = self.deck(again, "deck.bdf")
        self.assertEqual(result.code, 0, result.message)

    def test_a_deck_that_is_cut_off(self):
        """Between two cards, within one, within a word: every element that is left would be read as it stands."""
        whole = NASTRAN.replace("ENDDATA\n", "")
        for text in (whole, whole.split("CTETRA,9")[0], whole.split(",11\nSPC1")[0], NASTRAN[:-3]):
            with self.subTest(end=text[-20:]):
                self.refused(text, f"deck.bdf:{len(text.splitlines())}: ", "cut off", "ENDDATA", name="deck.bdf")

    def test_the_end_of_a_file_that_is_included_is_not_that_of_the_deck(self):
        with open(self.path("bulk.bdf"), "w", encoding="utf-8") as file:
            file.write(NASTRAN.split("BULK\n")[1])
        deck = "SOL 103\nCEND\nBEGIN BULK\nINCLUDE 'bulk.bdf'\n"
        self.refused(deck, "deck.bdf ends here without an ENDDATA of its own", name="deck.bdf")
        self.assertEqual(self.deck(deck + "ENDDATA\n", "deck.bdf").code, 0)
        self.refused("INCLUDE 'gone.bdf'\n", "deck.bdf:1", "gone.bdf cannot be read", name="deck.bdf")
        self.refused("INCLUDE 'deck.bdf'\n", "deck.bdf:1: INCLUDE", "which includes this file", name="deck.bdf")


class UniversalFiles(Conversion):
    def write(self, change=lambda text: text, **options):
        mesh_files.write_unv(mesh_files.curved_element("tetra10"), self.path("one.unv"), **options)
        with open(self.path("one.unv"), encoding="utf-8") as file:
            return self.deck(change(file.read()), "one.unv")

    def test_groups_and_units(self):
        self.assert_names(self.write(), {}, {"tip": 1, "bottom": 6})
        self.assertEqual(self.write(millimetres=True).length_unit, 1e-3)
        self.assertIsNone(self.write().length_unit)

    def test_groups_as_gmsh_writes_them(self):
        """One member per line; points are elements of theirs that the file does not have."""
        member = "         7         4         0         0"
        self.assert_names(self.write(lambda text: text.replace(
            "         1\ntip\n" + member, "         2\ntip\n" + member + "\n" + member.replace("7", "8").replace("4", "9"))),
            {}, {"tip": 1, "bottom": 6})

    def test_what_is_wrong_is_told_by_its_line(self):
        for change, words in ((lambda text: "solid cube", ("no line of -1",)),
                              (lambda text: text[:400], ("cut off",)),
                              (lambda text: text.replace("       118", "       199"), ("one.unv:26", "element 1", "199")),
                              (lambda text: text.replace("\ntip\n", "\nbottom\n"), ("bottom", "already")),
                              (lambda text: text.replace("D+00", "X+00", 1), ("one.unv:4",)),
                              (lambda text: re.sub(r"( 118( +\d+){3} +)10\n", r"\g<1>9\n", text),
                               ("one.unv:26", "is said to have 9 nodes", "expected 10")),
                              (lambda text: text.replace("\n         2 ", "\n         1 ", 1),
                               ("one.unv: node 1 stands twice, at ", "one.unv:3 and ", "one.unv:5;"))):
            result = self.write(change)
            self.assertEqual(result.code, 1)
            for word in words:
                self.assertIn(word, result.message)


class OtherFiles(Conversion):
    def test_a_file_that_is_not_what_its_ending_says(self):
        for ending in (".med", ".vtu", ".vtk", ".e"):
            if ending in NEEDS and importlib.util.find_spec(NEEDS[ending]) is None:
                continue
            with self.subTest(ending=ending):
                self.refused(BAR, "deck" + ending + ": no ", name="deck" + ending)
                self.refused("", "deck" + ending + ": no ", name="deck" + ending)

    def test_truncated_files(self):
        """A message of the file: never a traceback, nor a mesh of what is left, but of a deck of Abaqus, which has no last line."""
        for ending, (write, _) in FORMATS.items():
            if ending in NEEDS and importlib.util.find_spec(NEEDS[ending]) is None:
                continue
            write(mesh_files.curved_element("tetra10"), self.path("whole" + ending))
            with open(self.path("whole" + ending), "rb") as file:
                content = file.read()
            for share in (0.3, 0.6, 0.9):
                with open(self.path("part" + ending), "wb") as file:
                    file.write(content[:int(share * len(content))])
                result = Converted(self.path("part" + ending))
                with self.subTest(ending=ending, share=share):
                    if ending == ".inp" and result.code == 0:
                        continue
                    self.assertEqual(result.code, 1, "read without complaint")
                    self.assertTrue(result.message.startswith(self.path("part" + ending)), result.message)
                    if ending != ".inp":
                        self.assertIn("cut off", result.message)

    def test_vtk_arrays_of_one_name(self):
        mesh = mesh_files.curved_element("tetra10")
        mesh.points = {"first": [0], "other": [1], "first'": [2]}
        for ending in (".vtu", ".vtk"):
            mesh_files.write_vtk(mesh, self.path("two" + ending))
            self.assertEqual(Converted(self.path("two" + ending)).code, 0)
            with open(self.path("two" + ending), "rb") as file:
                content = file.read()
            with open(self.path("two" + ending), "wb") as file:
                file.write(content.replace(b"other", b"first"))
            with self.subTest(ending=ending):
                self.assertIn('two arrays are named "first"; rename one', Converted(self.path("two" + ending)).message)

    def test_vtu_of_two_pieces(self):
        """Of several pieces meshio keeps the last. In one a list of arrays that is empty has no end tag; those of its neighbour are
        no part of it."""
        def piece(lists, x):
            return ('<Piece NumberOfPoints="4" NumberOfCells="1"><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">'
                    f'{x} 0 0 {x + 1} 0 0 {x} 1 0 {x} 0 1</DataArray></Points><Cells><DataArray type="Int64" Name="connectivity" '
                    'format="ascii">0 1 2 3</DataArray><DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>'
                    f'<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>{lists}</Piece>')
        cells = '<CellData><DataArray type="Int32" Name="A" format="ascii">1</DataArray></CellData>'
        for points in ("<PointData/>", "<PointData></PointData>"):
            def file_of(*pieces):
                return ('<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>'
                        f'{"".join(pieces)}</UnstructuredGrid></VTKFile>')
            self.assertEqual(self.deck(file_of(piece(points + cells, 0)), "deck.vtu").code, 0)
            self.refused(file_of(piece(points + cells, 0), piece(cells + "<PointData></PointData>", 5)), "in 2 pieces", "one of them",
                         name="deck.vtu")

    def test_vtk_elements_of_an_unknown_type(self):
        """meshio leaves them out and goes on: a body with a hole."""
        def cell(kind, nodes):
            return ('<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>'
                    '<Piece NumberOfPoints="4" NumberOfCells="2"><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">'
                    '0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells><DataArray type="Int64" Name="connectivity" format="ascii">'
                    f'0 1 2 3 {nodes}</DataArray><DataArray type="Int64" Name="offsets" format="ascii">4 {4 + len(nodes.split())}</DataArray>'
                    f'<DataArray type="UInt8" Name="types" format="ascii">10 {kind}</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>')
        self.assertEqual(self.deck(cell(5, "0 1 2"), "deck.vtu").code, 0)
        self.refused(cell(99, "0 1 2"), "deck.vtu: elements of VTK's type 99 are not read", "10, 24", name="deck.vtu")

    def test_med_elements_of_an_unknown_type(self):
        if importlib.util.find_spec("h5py") is None:
            self.skipTest("h5py is not installed: .med cannot be read")
        import h5py
        mesh_files.write_med(mesh_files.curved_element("hexahedron20"), self.path("brick.med"))
        with h5py.File(self.path("brick.med"), "r+") as file:
            mesh = next(iter(file["ENS_MAA"].values()))
            next(iter(mesh.values()))["MAI"].move("H20", "H99")
        self.assertIn("brick.med: elements of type H99 are not read; bodies may be TE4", Converted(self.path("brick.med")).message)

    def med_with(self, change):
        """A brick of 20 nodes with groups, its file changed."""
        if importlib.util.find_spec("h5py") is None:
            self.skipTest("h5py is not installed: .med cannot be read")
        import h5py
        mesh_files.write_med(mesh_files.curved_element("hexahedron20"), self.path("brick.med"))
        with h5py.File(self.path("brick.med"), "r+") as file:
            change(file, next(iter(next(iter(file["ENS_MAA"].values())).values())))
        return Converted(self.path("brick.med"))

    def test_med_nodes_of_a_family_that_is_not_there(self):
        """They would be missing in a group without a word."""
        def change(_, mesh):
            mesh["NOE/FAM"][3] = 77
        self.assertIn("brick.med: nodes are in family 77, which is not there", self.med_with(change).message)

    def test_med_family_without_a_group(self):
        def change(file, mesh):
            families = next(iter(file["FAS"].values()))["NOEUD"]
            families.create_group("FAM_9").attrs.create("NUM", 9)
            mesh["NOE/FAM"][3] = 9
        result = self.med_with(change)
        self.assertEqual(result.code, 0, result.message)

    def test_exodus_cut_off(self):
        """The library reads zeros behind the end: places of nodes that are cut off would be another body."""
        if importlib.util.find_spec("netCDF4") is None:
            self.skipTest("netCDF4 is not installed: Exodus files cannot be read")
        import netCDF4
        for kind in ("NETCDF3_CLASSIC", "NETCDF3_64BIT_OFFSET", "NETCDF3_64BIT_DATA", "NETCDF4"):
            with netCDF4.Dataset(self.path("whole.e"), "w", format=kind) as file:
                for name, n in (("time_step", None), ("num_nodes", 5), ("num_el_blk", 1), ("num_el_in_blk1", 1), ("four", 4)):
                    file.createDimension(name, n)
                file.title = "five bytes and more"
                connect = file.createVariable("connect1", "i4", ("num_el_in_blk1", "four"))
                connect.elem_type = "TETRA"
                connect[:] = [[1, 2, 3, 4]]
                for axis, values in zip("xyz", ((0, 1, 0, 0, 7), (0, 0, 1, 0, 7), (0, 0, 0, 1, 7))):
                    file.createVariable(f"coord{axis}", "f8", ("num_nodes",))[:] = values
                file.createVariable("time_whole", "f8", ("time_step",))[:] = [1.0, 2.0]
                file.createVariable("flag", "S1", ("time_step", "four"))[:] = np.full((2, 4), "x", dtype="S1")
            whole = Converted(self.path("whole.e"))
            self.assertEqual(whole.code, 0, whole.message)
            with open(self.path("whole.e"), "rb") as file:
                content = file.read()
            for length in (4, 30, len(content) // 2, len(content) - 30, len(content) - 4):
                with open(self.path("part.e"), "wb") as file:
                    file.write(content[:length])
                with self.subTest(kind=kind, length=length):
                    result = Converted(self.path("part.e"))
                    self.assertEqual(result.code, 1)
                    self.assertIn("cut off", result.message)

    def test_vtk_arrays_of_one_component(self):
        """Legacy SCALARS, as gmsh and ParaView write them, and NumberOfComponents="1" of XML: a column, not a row."""
        mesh = mesh_files.curved_element("tetra")
        places = "\n".join(" ".join(map(str, place)) for place in mesh.nodes.tolist())
        self.assert_names(self.deck("# vtk DataFile Version 3.0\nbar\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                                    f"POINTS 4 double\n{places}\nCELLS 3 13\n4 0 1 2 3\n3 0 1 2\n3 0 1 3\nCELL_TYPES 3\n10\n5\n5\n"
                                    "CELL_DATA 3\nSCALARS held int 1\nLOOKUP_TABLE default\n0\n1\n0\n"
                                    "SCALARS face int\nLOOKUP_TABLE default\n0\n0\n3\n"
                                    "POINT_DATA 4\nSCALARS A int 1\nLOOKUP_TABLE default\n0\n0\n0\n1\n", "deck.vtk"),
                          {"held": 1, "face 3": 1}, {"A": 1})
        self.assert_names(self.deck('<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>'
                                    '<Piece NumberOfPoints="4" NumberOfCells="1"><Points><DataArray type="Float64" '
                                    f'NumberOfComponents="3" format="ascii">\n{places}\n</DataArray></Points><Cells>'
                                    '<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>'
                                    '<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>'
                                    '<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells><PointData>'
                                    '<DataArray type="Int32" Name="A" NumberOfComponents="1" format="ascii">0 0 0 1</DataArray>'
                                    "</PointData></Piece></UnstructuredGrid></VTKFile>", "deck.vtu"), {}, {"A": 1})

    def test_exodus_side_sets(self):
        if importlib.util.find_spec("netCDF4") is None:
            self.skipTest("netCDF4 is not installed: Exodus files cannot be read")
        for kind in ALL:
            mesh = mesh_files.curved_element(kind)
            corners = [[int(digit) - 1 for digit in face] for face in mesh_files.EXODUS_FACES[kind.rstrip("0123456789")]]
            mesh.surfaces = {f"side {i}": [face] for i, face in enumerate(corners, 1)}
            mesh_files.write_exodus(mesh, self.path("sides.e"))
            result = Converted(self.path("sides.e"))
            for i, face in enumerate(corners, 1):
                with self.subTest(type=kind, side=i):
                    self.assertEqual(result.surfaces[f"side {i}"], [_places(mesh.nodes[face])])


class Limits(Conversion):
    """The script with a meshio that misbehaves in place of the real one."""

    def run_with(self, body, seconds=20, megabytes=3000):
        mesh_files.write_vtk(mesh_files.curved_element("tetra"), self.path("one.vtu"))
        with open(self.path("without_meshio.py"), "w", encoding="utf-8") as file:
            file.write(f"import runpy, sys, types\nmeshio = types.ModuleType('meshio')\n"
                       f"def read(_):\n    {body}\nmeshio.vtu = types.SimpleNamespace(read=read)\nmeshio._mesh = types.SimpleNamespace("
                       f"topological_dimension={{}})\nsys.modules['meshio'] = meshio\n"
                       f"sys.argv[0] = {SCRIPT!r}\nrunpy.run_path({SCRIPT!r}, run_name='__main__')\n")
        command = ["/usr/bin/python3", "-I", self.path("without_meshio.py"), self.path("one.vtu"), self.path("mesh.msh"),
                   self.path("facts.json"), str(seconds), str(megabytes)]
        finished = subprocess.run(command, capture_output=True, text=True, timeout=60)
        return finished.returncode, finished.stderr.strip().split("\n")[-1]

    def test_memory(self):
        code, message = self.run_with("return bytearray(10**10)")
        self.assertEqual(code, 1)
        self.assertIn("memory", message)

    def test_time(self):
        self.assertLess(self.run_with("while True: pass", seconds=1)[0], 0, "ended by a signal")

    def test_a_reader_that_leaves(self):
        code, message = self.run_with("sys.exit(1)")
        self.assertEqual(code, 1)
        self.assertIn("one.vtu: no vtu file", message)

    def test_a_missing_package_is_named(self):
        self.assertIn("python3-h5py", self.run_with("raise ModuleNotFoundError(name='h5py')")[1])

    def test_a_package_that_another_needs_is_named(self):
        code, message = self.run_with("import gone.console")
        self.assertEqual(code, 1)
        self.assertRegex(message, "one.vtu: this format needs the Python module gone, .*python3-meshio.*apt-get")

    def test_a_package_of_which_a_folder_is_left_is_named(self):
        os.mkdir(self.path("h5py"))
        message = self.run_with(f"sys.path[:] = [{self.folder!r}]; import h5py; h5py.is_hdf5('one.vtu')")[1]
        self.assertIn("one.vtu: this format needs the Debian package python3-h5py: apt-get", message)

    def test_a_package_that_cannot_be_loaded(self):
        cause = "ImportError('libgone.so: cannot open shared object file')"
        message = self.run_with(f"raise ImportError('\\n'.join(['please read this'] * 50)) from {cause}")[1]
        self.assertRegex(message, r"one.vtu: this format needs python3-numpy .*\(libgone.so: cannot open .*\): apt-get")


if __name__ == "__main__":
    unittest.main(verbosity=2)
