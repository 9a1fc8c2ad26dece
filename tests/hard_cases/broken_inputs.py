#!/usr/bin/env python3
"""Broken files of every kind, through the command line.

Hard: whoever makes a file by hand, by script or by another program gets it wrong in ways nobody lists: bytes lost in a
copy, the wrong encoding, a table with a short row, a count that does not fit, a gigabyte of zeros.
Right: exit code 1 (2 where it can be read but not computed) within 2 s of processor time, memory of a small multiple of
the file, and a message of a few lines that names the file and the line, key or entity. Never a signal, code 5, words of a
library, or silence: what is listed by hand below must be refused, unless it says otherwise; what is damaged at random may
be read, where the damage happens to make sense.

usage: broken_inputs.py MICROSLIP SOURCE WORK_FOLDER [N] [SEED]     prints a table; N cases damaged at random beside those
listed: 1500 where MICROSLIP_CAMPAIGNS=whole, else 30 beside a tenth of the list; the seed is 1 by default.
"""
import collections
import dataclasses
import io
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "verification"))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import mesh_files
from program_run import whole_campaigns, without_plots

SECONDS = 2.0  # of processor time, until an input is refused
ACCEPTED = 4.0  # where none of it is broken: modes read by other programs, a whole forecast
HANGS = 30.0  # of wall time, on a machine that does other things
MEGABYTES = 400  # and so many times the file:
TIMES_FILE = 30
LINES, CHARACTERS = 6, 1600
RAW = re.compile(r"std::|toml::|basic_string|vector::|bad_alloc|\bstoi|what\(\)|_M_|regex|Traceback|NoneType|object has no")
# A line or byte of the file, a key of the scene, or an entity of the mesh.
PLACE = re.compile(r":\d+|byte \d|\w+\.\w+: |node|element|section|column|empty|folder|such file|bytes|not a file|symbolic|"
                   r"no \w+|cannot|nothing|--set")

MODAL = """[model]
kind = "modal"
[modal]
frequency = [15.9, 41.4]
damping_ratio = 0.01
force_sine = [0.0, 0.3]
output = [0.9, 0.35]
points = [ { weight = 1, tangential_stiffness = 1e4, normal_stiffness = 1e4, friction_coefficient = 0.3, preload = 2, \
phi_u_1 = 0.8, phi_u_2 = -0.5, phi_v_1 = 0.1 } ]
[response]
frequency = [10, 30]
harmonics = 1
"""
POINTS = ("weight,tangential_stiffness,normal_stiffness,friction_coefficient,preload,phi_u_1,phi_u_2\n"
          "1,1e4,1e4,0.3,2,0.8,-0.5\n1,1e4,1e4,0.3,2,0.7,-0.4\n")
TABLE_SCENE = re.sub(r"points = \[.*\]\n", 'points = "points.csv"\n', MODAL)
CYCLES = ("tangential_stiffness,normal_stiffness,friction_coefficient,preload,u_sin,u_cos,v_mean,v_sin,v_cos\n"
          "1,1,0.3,1,1,0,0,0.5,0.1\n1,1,0.3,1,2,0,0,0.5,0.1\n")
MESH_SCENE = """[model]
kind = "mesh"
file = "mesh.inp"
length_unit = "m"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["left"]
[contact]
surface = "right"
slip_direction = [0, 0, 1]
friction_coefficient = 0.4
normal_stiffness = 1e11
tangential_stiffness = 1e11
[excitation]
forces = [ { at = "tip", direction = [1, 0, 0], amplitude = 1 } ]
[response]
output = { at = "tip", direction = [1, 0, 0] }
frequency = [100, 200]
harmonics = 1
preload = [100]
"""
BAD_NUMBERS = ("nan", "inf", "-inf", "1e400", "-1e400", "1e200", "99999999999999999999", "true", '""', '"x"', '"5 parsec"',
               '"1 kg"', '"1e999 m"', "[]", "{}", "[[]]", '[1, "a"]', "[nan, 2]", "1979-05-27", '"\\u0000"', "{ a = 1 }")


@dataclasses.dataclass
class Case:
    kind: str
    name: str
    files: dict  # name: bytes, text, or a function of its path that makes it
    arguments: list
    must_refuse: bool = True
    says: str = ""  # a part of the message


def large(make):
    """Content that is made when its case comes: memory of this process counts as that of the program it starts."""
    return lambda path: write(path, make())


def scene_case(name, text, **more):
    return Case("scene", name, {"scene.toml": text}, ["check", "scene.toml"], **more)


def encodings():
    """One text in ways other programs write it."""
    yield scene_case("UTF-16", MODAL.encode("utf-16"))
    yield scene_case("UTF-16 without a mark", MODAL.encode("utf-16-le"))
    yield scene_case("Latin-1", ('title = "Sch\xe4ufel"\n' + MODAL).encode("latin-1"))
    yield scene_case("byte order mark", b"\xef\xbb\xbf" + MODAL.encode(), must_refuse=False)
    yield scene_case("carriage returns", MODAL.replace("\n", "\r\n"), must_refuse=False)
    yield scene_case("old carriage returns", MODAL.replace("\n", "\r"))
    yield scene_case("tabs", MODAL.replace(" = ", "\t=\t"), must_refuse=False)
    yield scene_case("a byte of value 0", MODAL.replace("kind", "ki\0nd"))
    yield scene_case("decimal commas", MODAL.replace("0.01", "0,01"))
    yield scene_case("typographic quotes", MODAL.replace('"modal"', "\u201cmodal\u201d"))
    yield scene_case("no-break space", MODAL.replace("[10, 30]", "[10,\u00a030]"))


def no_files():
    """What is no file, or none that holds anything."""
    yield scene_case("empty", "")
    yield scene_case("a line feed", "\n")
    yield scene_case("only a comment", "# nothing\n")
    yield scene_case("a folder", os.mkdir)
    yield scene_case("a loop of links", lambda path: os.symlink(path, path))
    yield scene_case("a link to nowhere", lambda path: os.symlink("gone", path))
    yield scene_case("zeros", sparse(1 << 30))
    yield Case("scene", "a name of 4000 letters", {}, ["check", 4000 * "x" + ".toml"])
    yield Case("scene", "no such file", {}, ["check", "gone.toml"], says="gone.toml")
    yield Case("scene", "an empty name", {}, ["check", ""])
    yield Case("scene", "a device without end", {}, ["check", "/dev/zero"])
    yield scene_case("letters without end", lambda path: repeat(path, b"a", 300))


def repeat(path, piece, megabytes):
    with open(path, "wb") as file:
        for _ in range(megabytes):
            file.write(piece * (1000000 // len(piece)))


def sparse(size):
    def make(path):
        with open(path, "wb") as file:
            file.truncate(size)
    return make


def zeros_behind(begin, size):
    """A begin that is right, and behind it what a lost block of a disk leaves."""
    def make(path):
        write(path, begin)
        os.truncate(path, size)
    return make


def structures():
    """Keys, sections and types."""
    for section in ("model", "modal", "response"):
        yield scene_case(f"without [{section}]", re.sub(rf"\[{section}\]\n([^\[\n].*\n)*", "", MODAL), says=section,
                         must_refuse=section != "response")
        yield scene_case(f"[{section}] twice", MODAL + f"[{section}]\n", says="scene.toml:")
        yield scene_case(f"[[{section}]]", MODAL.replace(f"[{section}]", f"[[{section}]]"), says=section)
        yield scene_case(f"{section} a number", f"{section} = 3\n" + MODAL)
    for key in ("kind", "frequency", "damping_ratio", "force_sine", "output", "weight", "phi_u_1", "harmonics"):
        line = next(line for line in MODAL.splitlines() if key + " = " in line)
        yield scene_case(f"{key} misspelt", MODAL.replace(key + " = ", key[:-1] + "z = ", 1), says="scene.toml:")
        if line.startswith(key):
            yield scene_case(f"{key} twice", MODAL.replace(line, line + "\n" + line, 1), says="scene.toml:")
            yield scene_case(f"{key} without a value", MODAL.replace(line, key + " =", 1), says=key)
    yield scene_case("an unclosed text", MODAL.replace('"modal"', '"modal'))
    yield scene_case("an unclosed list", MODAL.replace("[10, 30]", "[10, 30"))
    yield scene_case("an unclosed table", MODAL.replace("} ]", "]"))
    yield scene_case("an unclosed section", MODAL.replace("[modal]", "[modal"))
    yield scene_case("an unclosed long text", MODAL.replace('"modal"', '"""modal'))
    yield scene_case("10 000 brackets", MODAL.replace("[10, 30]", 10000 * "[" + 10000 * "]"))
    yield scene_case("10 000 tables", MODAL.replace("[10, 30]", 10000 * "{a=" + "1" + 10000 * "}"))
    yield scene_case("a key of 40 000 parts", MODAL + ".".join(40000 * "a") + " = 1\n")
    yield scene_case("100 000 unknown keys", large(lambda: MODAL + "".join(f"k{i} = 1\n" for i in range(100000))))
    yield scene_case("a list of a million", large(lambda: MODAL.replace("[10, 30]", "[" + 1000000 * "1," + "]")))
    yield scene_case("another list of a million", large(lambda: MODAL.replace("[0.0, 0.3]", "[" + 1000000 * "1," + "]")))
    yield scene_case("a key of a million letters", MODAL + 1000000 * "k" + " = 1\n")
    yield scene_case("a value of a million letters", MODAL.replace('"modal"', '"' + 1000000 * "m" + '"'))


def values():
    """Every number of a scene, replaced."""
    for key in ("frequency", "damping_ratio", "force_sine", "output", "harmonics", "weight", "tangential_stiffness",
                "normal_stiffness", "friction_coefficient", "preload", "phi_u_1"):
        for value in BAD_NUMBERS:
            text = re.sub(rf"\b{key} = (\[[^\]]*\]|[^,\n ]+)", lambda _: f"{key} = {value}", MODAL, count=1)
            yield scene_case(f"{key} = {value}", text, says="scene.toml")
    for change in ("response.frequency=[0, 0, 0]", "response.frequency=[-1, 5]", "response.frequency=[]",
                   "modal.damping_ratio=-0.1", "modal.frequency=[-1, 5]", "modal.output=[1, 2, 3]",
                   "response.harmonics=0", "response.harmonics=-1", "response.harmonics=1e9", "response.harmonics=1.5",
                   "response.harmonics=[]", "response.preload_scale=[]",
                   "response.preload_scale=[\"x\"]", "response.maps=[\"peaks\"]", "response.maps=[-3]", "response.map_phases=1e12",
                   "response.search_starts=1e9", "modal.attachment=7", "response.method=\"time\"x", "response.optimum=\"gone.key\"",
                   "a", "=", "a=", "modal.=1", "..=1", "modal.points[9].weight=1", "modal.points[-1].weight=1",
                   "modal.points[99999999999999999999].weight=1", "modal.frequency[0]=nan", "modal.points=\"/dev/zero\"",
                   "modal.points=\"scene.toml\"", "modal.points=\"/\"", "modal.points=\"\"", 20000 * "a." + "a=1"):
        yield Case("scene", f"--set {change[:60]}", {"scene.toml": MODAL}, ["check", "scene.toml", "--set", change])


def table_case(name, text, **more):
    return Case("table", name, {"scene.toml": TABLE_SCENE, "points.csv": text}, ["check", "scene.toml"],
                **{"says": "points.csv", **more})


def cycle_case(name, text, **more):
    return Case("table", "cycle: " + name, {"cycle.csv": text}, ["cycle", "cycle.csv"], **{"says": "cycle.csv", **more})


def tables():
    for make, table in ((table_case, POINTS), (cycle_case, CYCLES)):
        header, row, *_ = table.splitlines()
        first = row.split(",")[1]
        yield make("empty", "")
        yield make("a folder", os.mkdir)
        yield make("zeros", sparse(1 << 30))
        yield make("UTF-16", table.encode("utf-16"))
        yield make("two megabytes of one cell", header + "\n" + 2000000 * "1")
        yield make("a line that does not end", lambda path: repeat(path, b"1,", 200))
        yield make("semicolons", table.replace(",", ";"))
        yield make("tabs", table.replace(",", "\t"))
        yield make("no header", "\n".join(table.splitlines()[1:]))
        yield make("a short row", header + "\n" + row.rsplit(",", 1)[0] + "\n", says=".csv:2")
        yield make("a long row", header + "\n" + row + ",1\n", says=".csv:2")
        yield make("a column twice", header + ",weight,weight\n" + row + ",1,1\n", says=".csv:1")
        yield make("an unknown column", header + ",colour\n" + row + ",1\n", says="colour")
        yield make("a column without a name", header + ",\n" + row + ",1\n", says=".csv:1")
        yield make("an open quote", header + '\n"' + row + "\n", says=".csv:2")
        yield make("100 000 columns", ",".join(f"c{i}" for i in range(100000)) + "\n")
        yield make("binary", random.Random(1).randbytes(5000))
        for value in ("nan", "inf", "-inf", "1e400", "1e200", "", "x", "1 e4", "0x10", "1,5", "--1", "1e", "-1", "1.2.3"):
            yield make(f"a cell {value!r}", table.replace("," + first + ",", "," + value + ",", 1), says=".csv:2")
        yield make("a byte order mark", b"\xef\xbb\xbf" + table.encode(), must_refuse=False, says="")
        yield make("carriage returns", table.replace("\n", "\r\n"), must_refuse=False, says="")


def bar():
    """Two bricks along x with names, in the formats of other codes."""
    import numpy as np
    nodes = np.array([[x, y, z] for z in (0.0, 1.0) for y in (0.0, 1.0) for x in (0.0, 1.0, 2.0)])
    bricks = np.array([[0, 1, 4, 3, 6, 7, 10, 9], [1, 2, 5, 4, 7, 8, 11, 10]])
    return mesh_files.Mesh(nodes, {"hexahedron": bricks}, {"left": [[0, 6, 9, 3]], "right": [[2, 5, 11, 8]]}, {"tip": [11]})


def sound_meshes(program, folder):
    """{ending: bytes} of files that are read."""
    made = {}
    for ending, writer in ((".inp", mesh_files.write_inp), (".bdf", mesh_files.write_bdf), (".unv", mesh_files.write_unv),
                           (".vtu", mesh_files.write_vtk), (".vtk", mesh_files.write_vtk), (".med", mesh_files.write_med),
                           (".e", mesh_files.write_exodus)):
        path = os.path.join(folder, "sound" + ending)
        try:
            writer(bar(), path)
        except ModuleNotFoundError as missing:
            print(f"skipped: {ending}: {missing}")
            continue
        with open(path, "rb") as file:
            made[ending] = file.read()
    made[" 2.2.msh"] = GMSH_2.encode()
    made[" 4.1.msh"] = GMSH_4.encode()
    made[" binary.msh"] = blade_of(program, folder)
    return made


def blade_of(program, folder):
    scene = os.path.join(folder, "blade.toml")
    write(scene, '[model]\nkind = "blade"\nelement_size = "20 mm"\n[material]\nyoungs_modulus = 2e11\npoissons_ratio = 0.3\n'
                 "density = 7800\n")
    subprocess.run([program, "mesh", scene, "-o", os.path.join(folder, "blade.msh")], check=True, capture_output=True)
    with open(os.path.join(folder, "blade.msh"), "rb") as file:
        return file.read()


GMSH_2 = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "left"
3 2 "body"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 1 1 1
$EndNodes
$Elements
3
1 2 2 1 1 1 2 3
2 4 2 2 1 1 2 3 4
3 4 2 2 1 2 3 4 5
$EndElements
"""
GMSH_4 = """$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "left"
3 2 "body"
$EndPhysicalNames
$Entities
0 0 1 1
1 0 0 0 1 1 0 1 1 0
1 0 0 0 1 1 1 1 2 1 1
$EndEntities
$Nodes
1 5 1 5
3 1 0 5
1
2
3
4
5
0 0 0
1 0 0
0 1 0
0 0 1
1 1 1
$EndNodes
$Elements
2 3 1 3
2 1 2 1
1 1 2 3
3 1 4 2
2 1 2 3 4
3 2 3 4 5
$EndElements
"""


BEGINS = {".inp": "*NODE\n1,0.,0.,0.\n", ".bdf": "BEGIN BULK\nGRID,1,,0.,0.,0.\n", ".unv": "    -1\n  2411\n",
          ".vtu": '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid">\n', ".vtk": "# vtk DataFile Version 3.0\n",
          " 2.2.msh": "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n", " 4.1.msh": "$MeshFormat\n"}


def mesh_case(kind, name, content, **more):
    file = "mesh" + re.sub(r".*\.", ".", kind)
    return Case("mesh" + kind, name, {file: content}, ["surfaces", file], **more)


def meshes(sound):
    for kind, content in sound.items():
        yield mesh_case(kind, "sound", content, must_refuse=False, says="")
        yield mesh_case(kind, "empty", b"")
        yield mesh_case(kind, "a folder", os.mkdir)
        yield mesh_case(kind, "zeros", sparse(1 << 30))
        yield mesh_case(kind, "a scene", MODAL)
        if begin := BEGINS.get(kind):
            yield mesh_case(kind, "zeros behind its begin", zeros_behind(begin, 1 << 30), says="value 0")
        yield mesh_case(kind, "half of it", content[:len(content) // 2], must_refuse=kind != ".inp")
    for version, text in (("2.2", GMSH_2), ("4.1", GMSH_4)):
        binary = f"$MeshFormat\n{version} 1 8\n\1\0\0\0\n$EndMeshFormat\n"
        for begin in (binary, binary + "$Nodes\n", binary + "$Nodes\n30000000\n"):
            yield mesh_case(f" binary {version}.msh", f"zeros behind {len(begin)} bytes", zeros_behind(begin, 1 << 30), says="byte ")

        def changed(name, old, new, count=1, **more):
            assert old in text, (name, old)
            return mesh_case(f" {version}.msh", name, text.replace(old, new, count), **more)
        yield changed("another version", version + " 0 8", "3.0 0 8")
        yield changed("a version of 1e400", version + " 0 8", "1e400 0 8")
        yield changed("numbers of four bytes", "0 8", "0 4")
        yield changed("said to be binary", version + " 0 8", version + " 1 8")
        yield changed("no nodes", "$Nodes", "$Knoten")
        yield changed("no elements", "$Elements", "$Elemente")
        yield changed("an unknown node", "2 3 4 5\n", "2 3 4 77\n", says="77")
        yield changed("an element on one node", "2 3 4 5\n", "2 2 2 2\n")
        yield changed("a flat element", "0 0 1\n", "1 1 0\n", says="mesh.msh")
        yield changed("a coordinate nan", "0 1 0\n", "0 nan 0\n")
        yield changed("a coordinate 1e400", "0 1 0\n", "0 1e400 0\n")
        yield changed("a coordinate 1e300", "0 1 0\n", "0 1e300 0\n")
        yield changed("a coordinate that is a word", "0 1 0\n", "0 one 0\n")
        yield changed("two surfaces of one name", '$PhysicalNames\n2\n', '$PhysicalNames\n3\n2 7 "left"\n', says="1 and 7")
        yield changed("a name without quotes", '"left"', "left")
        yield changed("a carriage return in each line", "\n", "\r\n", -1, must_refuse=False)
        for count in ("-1", "0", "2147483648", "9223372036854775807", "18446744073709551616", "1e3"):
            yield changed(f"{count} nodes", "$Nodes\n5" if version == "2.2" else "3 1 0 5",
                          "$Nodes\n" + count if version == "2.2" else "3 1 0 " + count)
            yield changed(f"{count} elements", "$Elements\n3" if version == "2.2" else "3 1 4 2",
                          "$Elements\n" + count if version == "2.2" else "3 1 4 " + count)
            yield changed(f"{count} names", "$PhysicalNames\n2", "$PhysicalNames\n" + count, must_refuse=count != "0")
        for tag in ("0", "-5", "2147483648", "9223372036854775807", "4"):
            node = "5 1 1 1\n" if version == "2.2" else "\n5\n0 0 0"
            yield changed(f"node {tag}", node, node.replace("5", tag, 1))
    for kind, begin, line in ((".inp", BEGINS[".inp"], "1, 0.5, 0.25, 0.125\n"),
                              (".inp", BEGINS[".inp"] + "*ELEMENT, TYPE=C3D4\n", "1, 1, 2, 3, 4\n")):
        def repeated(path, begin=begin, line=line):
            write(path, begin)
            with open(path, "ab") as file:
                for _ in range(200):  # piece by piece: memory of this process counts as that of the program
                    file.write(line.encode() * (1_000_000 // len(line)))
        yield mesh_case(kind, "200 MB of one " + ("element" if "ELEMENT" in begin else "node"), repeated, says="stands twice")
    yield Case("mesh", "an unknown ending", {"mesh.xyz": GMSH_2}, ["surfaces", "mesh.xyz"])
    yield Case("mesh", "no such file", {}, ["surfaces", "gone.msh"])


def mesh_scenes(sound):
    """Sound meshes, scenes that do not fit to them."""
    def made(name, old, new, **more):
        assert old in MESH_SCENE, old
        return Case("scene of a mesh", name, {"scene.toml": MESH_SCENE.replace(old, new), "mesh.inp": sound[".inp"]},
                    ["check", "scene.toml"], **{"says": "scene.toml:", **more})
    yield made("sound", "", "", must_refuse=False, says="")
    yield made("no such support", '["left"]', '["lft"]')
    yield made("a support on a place", '["left"]', "[3]")
    yield made("no such surface", '"right"', '"rght"')
    yield made("a surface that is a node", 'surface = "right"', 'surface = "tip"')
    yield made("no such node", 'at = "tip", direction = [1, 0, 0], a', 'at = "tap", direction = [1, 0, 0], a')
    yield made("no direction", "direction = [1, 0, 0], a", "direction = [0, 0, 0], a")
    yield made("a direction of two", "direction = [1, 0, 0], a", "direction = [0, 1], a")
    yield made("slip along the normal", "slip_direction = [0, 0, 1]", "slip_direction = [1, 0, 0]")
    yield made("the contact clamped", 'surface = "right"', 'surface = "left"', must_refuse=False, says="")
    for value in ("0", "-1", "nan", "1e-99", "1e99", "1e150", '"1 kg"'):
        yield made(f"density {value}", "density = 7800", "density = " + value, says="material.density")
        yield made(f"E {value}", '"210 GPa"', value, says="material.youngs_modulus")
    for value in ("0.5", "0.6", "-1", "nan"):
        yield made(f"Poisson's ratio {value}", "poissons_ratio = 0.3", "poissons_ratio = " + value, says="poissons_ratio")
    for value in ("1e-60", "1e60"):
        yield made(f"length unit {value}", 'length_unit = "m"', "length_unit = " + value, says="length_unit")
    for value in ("0", "-1", "nan", '"1 s"', '"parsek"'):
        yield made(f"length unit {value}", 'length_unit = "m"', "length_unit = " + value, says="length_unit")
    yield made("no mesh", '"mesh.inp"', '"gone.inp"', says="gone.inp")
    yield made("a mesh that is a scene", '"mesh.inp"', '"scene.toml"', says="scene.toml")
    yield made("clamped nowhere", 'clamped = ["left"]', "clamped = []", must_refuse=False)


def other_codes(source):
    """Modes and matrices of other codes, with a line, a byte or an end that is wrong."""
    import numpy as np
    plate = os.path.join(source, "share", "scenes", "plate")
    sound = {}
    for name in os.listdir(plate):
        with open(os.path.join(plate, name), "rb") as file:
            sound["plate/" + name] = file.read()
    scenes = {}
    for scene in ("plate_calculix", "plate_matrices", "plate_numpy", "plate_med", "plate_nastran"):
        with open(os.path.join(source, "share", "scenes", scene + ".toml"), encoding="utf-8") as file:
            scenes[scene] = file.read()

    def made(scene, file, name, content, **more):
        return Case("modes of other codes", f"{file}: {name}", {"scene.toml": scenes[scene], **sound, "plate/" + file: content},
                    ["check", "scene.toml"], **{"says": file, **more})
    matrix = sound["plate/stiffness.mtx"].decode()
    header, size, entry, *_ = matrix.splitlines()
    for name, old, new in (("another header", header, "%%MatrixMarket matrix array real general"), ("a size of 2^31", size, "3000000000 3000000000 5"),
                           ("not square", size, "3 4 5"), ("a negative size", size, "-1 -1 5"), ("a huge count", size, size.rsplit(" ", 1)[0] + " 999999999999"),
                           ("nan", entry, entry.rsplit(" ", 1)[0] + " nan"), ("an entry outside", entry, "9999 1 1.0"),
                           ("row 0", entry, "0 1 1.0"), ("a word", entry, "1 1 one")):
        yield made("plate_matrices", "stiffness.mtx", name, matrix.replace(old, new, 1))
    for file in ("stiffness.mtx", "mass.mtx", "nodes.csv"):
        for name, content in (("empty", b""), ("zeros", sparse(1 << 30)), ("half of it", sound["plate/" + file][:len(sound["plate/" + file]) // 2])):
            yield made("plate_matrices", file, name, content)
    modes = sound["plate/plate.frd"]
    yield made("plate_nastran", "plate.pch", "zeros behind its begin", zeros_behind("$TITLE\n", 1 << 30), says="value 0")
    for name, content in (("empty", b""), ("zeros", sparse(1 << 30)), ("a scene", MODAL),
                          ("zeros behind its begin", zeros_behind("    1C\n", 1 << 30))):
        yield made("plate_calculix", "plate.frd", name, content)
    for share in range(5, 100, 20):
        yield made("plate_calculix", "plate.frd", f"{share} %", modes[:len(modes) * share // 100], says="")
    for scene, file in (("plate_numpy", "plate.npz"), ("plate_med", "plate.med"), ("plate_nastran", "plate.pch"), ("plate_nastran", "plate.bdf")):
        for name, content in (("empty", b""), ("zeros", sparse(1 << 30)), ("a scene", MODAL)):
            yield made(scene, file, name, content)
        whole = sound["plate/" + file]
        for share in (*range(10, 100, 20), 99):
            yield made(scene, file, f"{share} %", whole[:len(whole) * share // 100])
    punched = sound["plate/plate.pch"].splitlines(keepends=True)
    begins = [i for i, line in enumerate(punched) if line.startswith(b"$TITLE")]
    yield made("plate_nastran", "plate.pch", "ends between two modes", b"".join(punched[:begins[-1]]))
    scenes["npz"] = scenes["plate_calculix"].replace("plate/plate.frd", "plate/modes.npz")
    for name, arrays in (("without its arrays", {"x": np.zeros(3)}), ("objects", {"frequency_Hz": np.array([{}], dtype=object)}),
                         ("wrong shapes", {"frequency_Hz": np.ones(3), "coordinates": np.ones((2, 2)), "shapes": np.ones(5)})):
        stream = io.BytesIO()
        np.savez(stream, **arrays)
        yield made("npz", "modes.npz", name, stream.getvalue())
    yield made("npz", "modes.npz", "no archive", b"PK\x03\x04 nothing")
    yield made("npz", "modes.npz", "a bomb", bomb())


def steps(source):
    """Statements of a STEP file; OpenCASCADE searches for minutes for what is not there."""
    with open(os.path.join(source, "share", "scenes", "blade.step"), encoding="utf-8") as file:
        sound = file.read()

    def case(name, old, new, **more):
        return Case("STEP", name, {"b.step": sound.replace(old, new, 1)}, ["faces", "b.step"], **{"says": "b.step", **more})

    yield Case("STEP", "zeros", {"b.step": sparse(1 << 30)}, ["faces", "b.step"], says="not a STEP file")
    for arguments in (["faces", "b.step"], ["init", "mesh", "b.step"]):
        yield Case("STEP", f"{arguments[0]}: zeros behind its begin", {"b.step": zeros_behind("ISO-10303-21;\n", 1 << 30)}, arguments,
                   says="value 0")
    face = re.search(r"#(\d+) ?= ?ADVANCED_FACE", sound)
    yield case("a statement is lost", face[0], "#999999 = ADVANCED_FACE", says=f"#{face[1]}")
    yield case("a statement twice", face[0], "#1 = ADVANCED_FACE", says="twice")
    yield case("no number", "CARTESIAN_POINT('',(", "CARTESIAN_POINT('',(NaN,", says="NaN")
    yield case("a number beyond a double", "CARTESIAN_POINT('',(", "CARTESIAN_POINT('',(1e999,", says="1e999")
    yield case("a parenthesis open", "CARTESIAN_POINT('',(", "CARTESIAN_POINT('',((", says="parenthesis")
    yield case("100 000 parentheses", "CARTESIAN_POINT('',(", 100000 * "(", says="deep")
    yield case("a string without end", "CARTESIAN_POINT(''", "CARTESIAN_POINT('")
    yield case("a comment without end", "DATA;", "DATA; /*", says="not closed")
    yield case("cut off", sound[len(sound) // 2:], "", says="cut off")
    yield case("a foreign begin", "ISO-10303-21;", "solid", says="not a STEP file")


def bomb():
    """An archive of some kilobytes that unfolds to 4 GB."""
    import zipfile
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive, archive.open("frequency_Hz.npy", "w", force_zip64=True) as file:
        file.write(b"\x93NUMPY\x01\x00F\x00" + b"{'descr': '<f8', 'fortran_order': False, 'shape': (500000000,), }".ljust(69) + b"\n")
        for _ in range(40):
            file.write(bytes(1000000))
    return stream.getvalue()


def damaged(content, random_):
    """Bytes lost, doubled, changed or foreign, or an early end. What it did, and the outcome."""
    at = random_.randrange(len(content))
    n = min(1 + random_.randrange(40), len(content) - at)
    ways = {"cut at": lambda: content[:at], "lost": lambda: content[:at] + content[at + n:],
            "doubled": lambda: content[:at + n] + content[at:], "zeros": lambda: content[:at] + bytes(n) + content[at + n:],
            "bit": lambda: content[:at] + bytes([content[at] ^ (1 << random_.randrange(8))]) + content[at + 1:],
            "digits": lambda: content[:at] + random_.choice((b"9999999999", b"-1", b"nan", b"1e999", b"0")) + content[at + 1:],
            "ones": lambda: content[:at] + 8 * b"\xff" + content[at + 8:]}
    way = random_.choice(sorted(ways))
    return f"{way} {at}", ways[way]()


# Of share/scenes: a scene, the file in it that is damaged, the others that it needs.
OTHER_CODES = {"frd": ("plate_calculix", "plate.frd", ["plate.inp"]), "pch": ("plate_nastran", "plate.pch", ["plate.bdf"]),
               "deck": ("plate_nastran", "plate.bdf", ["plate.pch"]), "npz": ("plate_numpy", "plate.npz", ["plate.inp"]),
               "modes med": ("plate_med", "plate.med", []),
               "csv": ("plate_table", "plate.csv", ["plate.inp"]),
               "mtx": ("plate_matrices", "stiffness.mtx", ["mass.mtx", "nodes.csv", "coarse.inp"]),
               "nodes": ("plate_matrices", "nodes.csv", ["stiffness.mtx", "mass.mtx", "coarse.inp"])}


def other_code_files(source, kind):
    """{name: bytes} of a scene, and the name of the file to damage."""
    scene, damaged_one, others = OTHER_CODES[kind]
    files = {}
    for name, place in (("scene.toml", scene + ".toml"), *(("plate/" + one, "plate/" + one) for one in [damaged_one, *others])):
        with open(os.path.join(source, "share", "scenes", place), "rb") as file:
            files[name] = file.read()
    return files, "plate/" + damaged_one


def run_of(program, folder):
    """summary.json of a run, which `report` reads."""
    scene = os.path.join(folder, "run.toml")
    write(scene, MODAL)
    subprocess.run([program, "run", scene, "-o", os.path.join(folder, "run"), "--without", "plots", "-q"], check=True,
                   capture_output=True)
    with open(os.path.join(folder, "run", "summary.json"), "rb") as file:
        return file.read()


def random_cases(sound, source, summary, n, seed):
    random_ = random.Random(seed)
    others = {kind: other_code_files(source, kind) for kind in OTHER_CODES}
    kinds = ["scene", "table", "cycle", "summary", *others, *sound]
    for number in range(n):
        kind = kinds[number % len(kinds)]
        more = {"must_refuse": False, "says": ""}
        if kind in sound:
            name, content = damaged(sound[kind], random_)
            yield mesh_case(kind, f"{seed}.{number} {name}", content, **more)
        elif kind in others:
            files, place = others[kind]
            name, content = damaged(files[place], random_)
            yield Case("modes of other codes", f"{seed}.{number} {kind} {name}", {**files, place: content}, ["check", "scene.toml"],
                       **more)
        elif kind == "summary":
            name, content = damaged(summary, random_)
            yield Case("summary", f"{seed}.{number} {name}", {"run/summary.json": content}, ["report", "run"], **more)
        else:
            text, make = {"scene": (MODAL, scene_case), "table": (POINTS, table_case), "cycle": (CYCLES, cycle_case)}[kind]
            name, content = damaged(text.encode(), random_)
            yield make(f"{seed}.{number} {name}", content, **more)


def write(path, content):
    with open(path, "wb") as file:
        file.write(content.encode() if isinstance(content, str) else content)


class Campaign:
    def __init__(self, program, work):
        self.program, self.work = program, work
        self.counts = collections.Counter()
        self.failures = []
        shutil.rmtree(work, ignore_errors=True)
        os.makedirs(work)

    def case(self, number, case):
        folder = os.path.join(self.work, f"case_{number}")
        os.mkdir(folder)
        for name, content in case.files.items():
            path = os.path.join(folder, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            content(path) if callable(content) else write(path, content)
        outcome = self.run(case, folder)
        problems = list(self.problems(case, folder, *outcome))
        code = outcome[0]
        self.counts[case.kind, "refused" if code in (1, 2) else "accepted" if code == 0 else "other"] += 1
        if problems:
            self.counts[case.kind, "wrong"] += 1
            self.failures.append(f"{case.kind}: {case.name}: {'; '.join(problems)}")
        shutil.rmtree(folder)

    def run(self, case, folder):
        """Exit code (negative: a signal), message, seconds of processor time, megabytes. What takes too long is asked twice
        more: on a shared machine, processor time counts what other programs take from its caches and cores."""
        outcome = self.run_once(case, folder)
        for _ in range(2):
            if outcome[2] > SECONDS:
                outcome = min(outcome, self.run_once(case, folder), key=lambda run: run[2])
        return outcome

    def run_once(self, case, folder):
        with open(os.path.join(folder, ".message"), "w+b") as message:
            process = subprocess.Popen([self.program, *case.arguments], cwd=folder, stdout=subprocess.DEVNULL, stderr=message,
                                       env=without_plots(), start_new_session=True)
            watch = threading.Timer(HANGS, os.killpg, (process.pid, signal.SIGKILL))
            watch.start()
            _, status, used = os.wait4(process.pid, 0)
            watch.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
            message.seek(0)
            return process.returncode, message.read().decode(errors="replace"), used.ru_utime + used.ru_stime, used.ru_maxrss / 1e3

    @staticmethod
    def problems(case, folder, code, message, seconds, megabytes):
        size = sum(os.path.getsize(os.path.join(folder, name)) for name in case.files if os.path.isfile(os.path.join(folder, name)))
        if code < 0:
            yield f"ended by signal {-code}"
        elif code not in (0, 1, 2):
            yield f"exit code {code}: {message[:300]}"
        elif code == 0 and case.must_refuse:
            yield "accepted"
        if seconds > (ACCEPTED if code == 0 else SECONDS):
            yield f"{seconds:.1f} s"
        if megabytes > MEGABYTES + TIMES_FILE * min(size, 10_000_000) / 1e6:
            yield f"{megabytes:.0f} MB for a file of {size / 1e6:.1f} MB"
        if code in (1, 2):
            yield from Campaign.unclear(case, message)

    @staticmethod
    def unclear(case, message):
        if message.count("\n") > LINES or len(message) > CHARACTERS:
            yield f"a message of {message.count(chr(10))} lines, {len(message)} letters: {message[:200]}"
        if RAW.search(message):
            yield f"raw words: {message[:300]}"
        if case.says not in message:
            yield f"does not say {case.says!r}: {message[:300]}"
        if not PLACE.search(message):
            yield f"names no place: {message[:300]}"

    def report(self):
        outcomes = ("refused", "accepted", "other", "wrong")
        print(f"{'':24s}" + "".join(f"{outcome:>10s}" for outcome in outcomes))
        for kind in sorted({kind for kind, _ in self.counts}):
            print(f"{kind:24s}" + "".join(f"{self.counts[kind, outcome]:10d}" for outcome in outcomes))
        print(f"{len(self.failures)} wrong")
        print("\n".join(self.failures))
        return 1 if self.failures else 0


def main(program, source, work, n, seed, whole):
    began = time.monotonic()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    campaign = Campaign(program, work)
    sound = sound_meshes(program, work)
    listed = [*encodings(), *no_files(), *structures(), *values(), *tables(), *meshes(sound), *mesh_scenes(sound),
              *other_codes(source), *steps(source)]
    if not whole:
        listed = listed[::10]
    cases = [*listed, *random_cases(sound, source, run_of(program, work), n, seed)]
    for number, case in enumerate(cases):
        campaign.case(number, case)
    print(f"{len(cases)} broken inputs in {time.monotonic() - began:.0f} s, {n} of them damaged at random from seed {seed}:")
    return campaign.report()


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    asked = [int(word) for word in sys.argv[4:]]
    all_of_them = whole_campaigns() or bool(asked)
    sys.exit(main(*sys.argv[1:4], asked[0] if asked else 1500 if all_of_them else 30, asked[1] if len(asked) > 1 else 1, all_of_them))
