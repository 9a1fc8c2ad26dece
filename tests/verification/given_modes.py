#!/usr/bin/env python3
"""Modes of other codes give the curve that the program's own modes give.

Rows 57, 58. Hard: matrices and modes of another code, of other units and another normalisation.
Met in: exports of CalculiX and Nastran.
Right: rescaled and told, or refused; the same peaks.

Reference: the mesh of share/scenes/plate/plate.inp, as .msh, solved here. Its modes and attachment shapes, written in full,
come back as .npz, .csv and .med: peaks agree to the solver's tolerance. Nastran punches eight digits of an eigenvalue and
seven of a displacement: 1e-6. CalculiX integrates hex20 with the same 27 points;
plate.frd prints ten digits of a frequency and six of a displacement, so that frequencies agree to the 1e-6 that its
eigensolver is asked for, peaks to a few 1e-6. K and M that CalculiX stored have fourteen digits; its mass takes 27 points, ours is exact on twisted
bricks as well: that is 2e-7 here (3e-9 without the twist, where both are exact).

usage: given_modes.py MICROSLIP SOURCE WORK_FOLDER
"""
import csv
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import unittest

import meshio
import numpy as np

from program_run import run_scene, without_plots

PROGRAM, SOURCE, WORK = sys.argv[1:4]
del sys.argv[1:]
sys.path.insert(0, os.path.join(SOURCE, "tests", "support"))
import mesh_files
from plate_model import plate_model

PLATE = os.path.join(SOURCE, "share", "scenes", "plate")
PRINTED = 5e-6
PUNCHED = 1e-6
SOLVED = 1e-9
MATRICES = 1e-6

SCENE = """
{model}
[modes]
damping_ratio = 0.002
{modes}
[contact]
surface = "contact"
slip_direction = [0.921, 0, -0.389]
friction_coefficient = 0.4
normal_stiffness = "1e9 N/m^3"
tangential_stiffness = "1e9 N/m^3"
points = 40
[excitation]
forces = [ {{ at = "B", direction = [1, 0, 0], amplitude = "2 N" }} ]
[response]
output = {{ at = "A", direction = [1, 0, 0] }}
frequency = ["200 Hz", "500 Hz"]
harmonics = 1
preload = [20]
[effects]
second_direction = "off"
[accuracy]
error_budget = "off"
"""
OWN_PLATE = plate_model(os.path.join(WORK, "plate.msh"))


def path(name):
    return os.path.join(WORK, name)


def write_scene(name, model, modes):
    with open(path(name), "w", encoding="utf-8") as stream:
        stream.write(SCENE.format(model=model, modes=modes))
    return path(name)


def result_of(name, model, modes="", own=False):
    return numbers_of(name, write_scene(name + ".toml", model, ("count = 6\n" if own else "") + modes))


def numbers_of(name, scene):
    """Frequencies and the peak of a run."""
    run_scene(PROGRAM, scene, path(name))
    with open(os.path.join(path(name), "summary.json"), encoding="utf-8") as stream:
        summary = json.load(stream)
    peak = summary["curves"][0]["peak"]
    return np.array([mode["frequency_Hz"] for mode in summary["modes"]] + [peak["frequency_Hz"], peak["amplitude_m"]])


def given(file, more="", density="density = 7800"):
    return f'[model]\nkind = "modes"\nfile = "{file}"\nmesh = "{PLATE}/plate.inp"\nlength_unit = "mm"\n{more}\n[material]\n{density}'


def refusal(model, modes=""):
    """What `check` says of a scene it refuses."""
    finished = subprocess.run([PROGRAM, "check", write_scene("refused.toml", model, modes)], capture_output=True, text=True)
    assert finished.returncode == 1, finished.stdout + finished.stderr
    return finished.stderr


class GivenModes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)
        subprocess.run([os.path.join(SOURCE, "share", "scripts", "convert_mesh.py"), os.path.join(PLATE, "plate.inp"),
                        path("plate.msh"), path("facts.json"), "60", "4000"], check=True)
        cls.mesh = mesh_files.from_gmsh(path("plate.msh"))
        cls.none = result_of("own_none", OWN_PLATE, 'residual = "none"', own=True)
        cls.attached = result_of("own_attached", OWN_PLATE, 'residual = "attachment"\nattachment_degree = 0', own=True)
        solved = meshio.read(os.path.join(path("own_attached"), "modes.vtu"))
        names = sorted((name for name in solved.point_data if re.fullmatch(r"mode_\d+", name)), key=lambda n: int(n[5:]))
        shapes = np.array([solved.point_data[name] for name in names])
        frequency = cls.attached[:len(shapes)]
        order = np.random.default_rng(1).permutation(len(solved.points))  # another order of nodes is none of another mesh
        cls.arrays = {"nodes": 1e3 * solved.points[order], "frequency_Hz": frequency[:6], "shapes": shapes[:6, order]}
        cls.attachment = {"attachment_frequency_Hz": frequency[6:], "attachment_shapes": shapes[6:, order]}
        np.savez(path("modes.npz"), **cls.arrays)
        np.savez(path("attached.npz"), **cls.arrays, **cls.attachment)

    def compare(self, name, found, expected, tolerance):
        worst = np.abs(found / expected - 1.0).max()
        print(f"{name}: frequencies and peak differ by {worst:.1e} from those of modes solved here")
        self.assertLess(worst, tolerance)

    def test_numpy(self):
        self.compare("npz", result_of("npz", given(path("modes.npz"), 'mass_unit = "kg"')), self.none, SOLVED)

    def test_numpy_with_attachment_shapes(self):
        found = result_of("attached", given(path("attached.npz"), 'mass_unit = "kg"'), 'residual = "attachment"')
        self.assertGreater(len(found), len(self.none))
        self.compare("npz with attachment shapes", found, self.attached, SOLVED)

    def test_table(self):
        with open(path("modes.csv"), "w", encoding="utf-8", newline="") as stream:
            rows = csv.writer(stream)
            rows.writerow(("mode", "frequency_Hz", "node", "x", "y", "z", "ux", "uy", "uz"))
            for mode, (frequency, shape) in enumerate(zip(self.arrays["frequency_Hz"], self.arrays["shapes"]), 1):
                for node, (place, u) in enumerate(zip(self.arrays["nodes"], shape), 1):
                    rows.writerow((mode, repr(float(frequency)), node, *map(float, place), *map(float, u)))
        model = given(path("modes.csv"), 'mass_unit = "kg"')
        self.compare("csv", result_of("csv", model), self.none, SOLVED)
        with open(path("modes.csv"), encoding="utf-8") as stream:
            lines = stream.readlines()

        def cut(n_lines, modes=""):
            with open(path("modes.csv"), "w", encoding="utf-8") as stream:
                stream.writelines(lines[:n_lines])
            return refusal(model, modes)

        self.assertIn("mode 6, the last one, has 119 rows, mode 1 has 127: the table was cut off", cut(len(lines) - 8))
        self.assertIn("modes.count: 6 modes are asked for", cut(1 + 5 * 127, "count = 6"))  # what else a table says of its end

    def on_mesh(self):
        """Modes in the order of the nodes of the .msh file."""
        solved = {tuple(np.round(place, 3)): row for row, place in enumerate(self.arrays["nodes"])}
        rows = [solved[tuple(np.round(place, 3))] for place in self.mesh.nodes]
        return self.arrays["frequency_Hz"], self.arrays["shapes"][:, rows]

    def test_code_aster(self):
        """The file of the modes is that of the mesh as well."""
        if importlib.util.find_spec("h5py") is None:
            self.skipTest("h5py is not installed: .med cannot be read")
        mesh_files.write_med(self.mesh, path("modes.med"))
        frequency, shapes = self.on_mesh()
        mesh_files.add_med_modes(path("modes.med"), "modes___DEPL", frequency, shapes)
        model = f'[model]\nkind = "modes"\nfile = "{path("modes.med")}"\nlength_unit = "mm"\nmass_unit = "kg"\n[material]\ndensity = 7800'
        self.compare("med", result_of("med", model), self.none, SOLVED)

        def changed(change):
            shutil.copy(path("modes.med"), path("bad.med"))
            with h5py.File(path("bad.med"), "r+") as file:
                change(file["CHA"])
            return refusal(bad)

        import h5py
        bad = model.replace("modes.med", "bad.med").replace("length_unit", f'mesh = "{path("plate.msh")}"\nlength_unit')
        self.assertIn("no field has the components DX, DY, DZ; fields are: none", changed(lambda fields: fields.clear()))
        step = f"modes___DEPL/{2:020d}{-1:020d}"

        def cut(fields):
            values = fields[step + "/NOE/MED_NO_PROFILE_INTERNAL/CO"][:-1]
            del fields[step + "/NOE/MED_NO_PROFILE_INTERNAL/CO"]
            fields[step + "/NOE/MED_NO_PROFILE_INTERNAL"].create_dataset("CO", data=values)

        self.assertIn("mode 2 of modes___DEPL has 380 values at 127 nodes", changed(cut))
        self.assertIn("mode 2 of modes___DEPL has displacements at a part of the nodes (root)",
                      changed(lambda fields: fields.move(step + "/NOE/MED_NO_PROFILE_INTERNAL", step + "/NOE/root")))
        self.assertIn("which are the modes? again, modes___DEPL", changed(lambda fields: fields.copy("modes___DEPL", "again")))
        with open(path("modes.med"), "rb") as stream:
            whole = stream.read()
        with open(path("bad.med"), "wb") as stream:
            stream.write(whole[:len(whole) // 2])
        self.assertIn("bad.med: no MED file", refusal(bad))

    def test_nastran_punch(self):
        frequency, shapes = self.on_mesh()
        mesh_files.write_bdf(self.mesh, path("punched.bdf"), pressed=("contact",))
        mesh_files.write_punch(path("punched.pch"), frequency, shapes)
        points = list(self.mesh.points)
        names = {'"contact"': '"PLOAD4 1"', **{f'"{name}"': f'"SET {points.index(name) + 1}"' for name in "AB"}}
        model = f'[model]\nkind = "modes"\nfile = "{path("punched.pch")}"\nlength_unit = "mm"\nmass_unit = "kg"\n{{}}[material]\ndensity = 7800'

        def scene(name, more=""):
            text = SCENE.format(model=model.format(more), modes="")
            for old, new in names.items():
                text = text.replace(old, new)
            with open(path(name + ".toml"), "w", encoding="utf-8") as stream:
                stream.write(text)
            return path(name + ".toml")

        self.compare("pch", numbers_of("pch", scene("pch")), self.none, PUNCHED)
        with open(path("punched.pch"), encoding="ascii") as stream:
            lines = stream.readlines()
        with open(path("punched.bdf"), encoding="ascii") as stream:
            deck = stream.read()

        def told(changed=None, other_deck=None, more=""):
            for file, text in (("punched.pch", "".join(changed or lines)), ("punched.bdf", other_deck or deck)):
                with open(path(file), "w", encoding="ascii") as stream:
                    stream.write(text)
            finished = subprocess.run([PROGRAM, "check", scene("refused", more)], capture_output=True, text=True)
            self.assertEqual(finished.returncode, 1, finished.stdout)
            return finished.stderr

        per_mode = len(lines) // 6
        self.assertIn("mode 6 has displacements at 120 nodes, mode 1 at 127: the file was cut off", told(lines[:-16]))
        asked = deck.replace("BEGIN BULK\n", "BEGIN BULK\nEIGRL,1,,,6\n")
        five = lines[:5 * per_mode]
        self.assertIn("punched.pch: 5 modes are there, EIGRL of ", told(five, asked))
        for other in (asked.replace(",,,6", ",,2000.,6"), asked.replace(",,,6", ",,,5"),  # a highest frequency makes them fewer
                      asked.replace("SUBCASE 1", "SUBCASE 1\n  METHOD = 2").replace("EIGRL,1", "EIGRL,2,,,5\nEIGRL,1"), deck):
            for file, text in (("punched.pch", "".join(five)), ("punched.bdf", other)):
                with open(path(file), "w", encoding="ascii") as stream:
                    stream.write(text)
            finished = subprocess.run([PROGRAM, "check", scene("five")], capture_output=True, text=True)
            self.assertEqual(finished.returncode, 0, finished.stderr)
        self.assertIn("expected a number, found \"\": was the file cut off?", told([*lines[:-4], lines[-4][:40]]))
        self.assertIn("the line ends within the third displacement", told([*lines[:-4], lines[-4][:66]]))
        self.assertIn("mode 3 where mode 2 is expected: one is missing", told(lines[:per_mode] + lines[2 * per_mode:]))
        self.assertIn("there are no modes in it", told(lines[:4]))
        self.assertIn("punched.pch:5: real-imaginary output: complex modes are not read",
                      told([line.replace("$REAL OUTPUT", "$REAL-IMAGINARY OUTPUT") for line in lines]))
        self.assertIn("GRID 5 tells its displacements in a coordinate system of its own",
                      told(other_deck=re.sub(r"(GRID\* +5 .*\n\* {7}.{16})", r"\g<1>               3", deck)))
        self.assertIn("mode 2 has displacements of node 126 where mode 1 has those of node 999",
                      told("".join(lines).replace("       126       G", "       999       G", 1).splitlines(True)))
        self.assertIn("node 999 is not in", told([line.replace("       127       G", "       999       G") for line in lines]))
        self.assertIn("expected the deck these modes were computed with", told(more=f'mesh = "{path("plate.msh")}"\n'))
        mesh_files.write_punch(path("punched.pch"), frequency, 3 * shapes)
        with open(path("punched.pch"), encoding="ascii") as stream:
            self.assertIn("mass-normalised modes have 1 kg", told(stream.readlines()))

    def test_check_asks_what_the_modes_tell(self):
        """They are read, so that a range without any of them is told before a run."""
        frequency = self.arrays["frequency_Hz"]
        scene = write_scene("asked.toml", given(path("modes.npz"), 'mass_unit = "kg"'), "")

        def checked(low, high):
            finished = subprocess.run([PROGRAM, "check", scene, "--set", f"response.frequency=[{low}, {high}]"],
                                      capture_output=True, text=True)
            self.assertEqual(finished.returncode, 0, finished.stderr)
            return finished.stdout

        last = frequency.max()
        self.assertIn("response.frequency: the number of modes is 0 between", checked(0.1 * frequency[0], 0.2 * frequency[0]))
        self.assertIn("% of the last natural frequency", checked(10.0 * last, 11.0 * last))
        usual = checked(0.9 * frequency[0], 1.1 * frequency[0])
        self.assertNotIn("response.frequency:", usual)
        self.assertIn("which knows the curves: how large the amplitude is", usual)

    def test_two_nodes_in_one_place(self):
        """They may be one that is written twice; where they move apart nothing tells which is meant."""
        arrays = {key: np.array(values) for key, values in self.arrays.items()}
        twice = {"nodes": np.concatenate([arrays["nodes"], arrays["nodes"][:1]]), "frequency_Hz": arrays["frequency_Hz"],
                 "shapes": np.concatenate([arrays["shapes"], arrays["shapes"][:, :1]], axis=1)}
        np.savez(path("twice.npz"), **twice)
        model = given(path("twice.npz"), 'mass_unit = "kg"')
        subprocess.run([PROGRAM, "check", write_scene("twice.toml", model, "")], check=True, capture_output=True)
        twice["shapes"][:, -1] = np.abs(arrays["shapes"]).max(axis=(1, 2))[:, None]
        np.savez(path("twice.npz"), **twice)
        self.assertIn("two nodes of twice.npz lie at (", refusal(model))

    def test_op2_is_told_what_to_do_instead(self):
        self.assertIn("VECTOR(PUNCH)=ALL", refusal(given(path("modes.op2"))))

    def test_calculix(self):
        self.compare("frd", result_of("frd", given(os.path.join(PLATE, "plate.frd"))), self.none, PRINTED)

    def test_a_run_of_calculix_gives_the_file_of_the_scene(self):
        if shutil.which("ccx") is None:
            self.skipTest("CalculiX (ccx, Debian package calculix-ccx) is not installed: plate.frd is not made anew")
        shutil.copy(os.path.join(PLATE, "plate.inp"), WORK)
        subprocess.run(["ccx", "plate"], cwd=WORK, check=True, capture_output=True)
        self.compare("ccx", result_of("ccx", given(path("plate.frd"))), self.none, PRINTED)

    @staticmethod
    def matrices(**changed):
        files = {"stiffness": "stiffness.mtx", "mass": "mass.mtx", "nodes": "nodes.csv", "mesh": "coarse.inp"}
        keys = [f'{key} = "{changed.get(key, os.path.join(PLATE, name))}"' for key, name in files.items()]
        return "\n".join(['[model]', 'kind = "modes"', 'length_unit = "mm"', *keys])

    def test_matrices(self):
        own = plate_model(os.path.join(PLATE, "coarse.inp"))
        for residual in ("none", "stiffness", "attachment"):
            modes = f'count = 4\nresidual = "{residual}"'
            found, expected = result_of("matrices", self.matrices(), modes), result_of("coarse", own, modes)
            kept = [0, 1, 2, 3, -2, -1]  # attachment shapes have shorter waves: their frequencies differ by 3e-6
            self.compare(f"matrices, {residual}", found[kept], expected[kept], MATRICES)
            self.assertEqual(len(found), len(expected))

    def test_a_node_held_in_one_direction(self):
        """Of the root only x and y of all nodes and z of one are held: neither free nor whole nodes."""
        with open(os.path.join(PLATE, "coarse.inp"), encoding="ascii") as stream:
            deck = stream.read()
        if shutil.which("ccx") is None:
            self.skipTest("CalculiX (ccx, Debian package calculix-ccx) is not installed: no other matrices")
        deck = deck.replace("root, 1, 3", "root, 1, 2\n2, 3, 3")
        solved = deck.replace(", SOLVER=MATRIXSTORAGE", "").replace("*END STEP", "*NODE FILE\nU\n*END STEP")
        for name, text in (("stored", deck), ("solved", solved)):
            with open(path(name + ".inp"), "w", encoding="ascii") as stream:
                stream.write(text)
            subprocess.run(["ccx", name], cwd=WORK, check=True, capture_output=True)
        subprocess.run([os.path.join(SOURCE, "share", "scripts", "calculix_matrices.py"), path("stored"), path("stored")],
                       check=True)
        files = {key: os.path.join(path("stored"), name) for key, name in
                 (("stiffness", "stiffness.mtx"), ("mass", "mass.mtx"), ("nodes", "nodes.csv"))}
        by_matrices = result_of("by_matrices", self.matrices(**files), 'count = 4\nresidual = "none"')
        by_modes = result_of("by_modes", given(path("solved.frd")).replace("plate.inp", "coarse.inp"), "count = 4")
        self.compare("matrices of nodes held in part, against modes by ccx", by_matrices, by_modes, PRINTED)

    def test_matrices_that_do_not_fit_are_refused(self):
        with open(os.path.join(PLATE, "nodes.csv"), encoding="ascii") as stream:
            lines = stream.readlines()

        def changed(line, old, new):
            with open(path("nodes.csv"), "w", encoding="ascii") as stream:
                stream.writelines([*lines[:line], lines[line].replace(old, new), *lines[line + 1:]])
            return refusal(self.matrices(nodes=path("nodes.csv")))

        last = len(lines) - 1
        row = lines[last].rsplit(",", 1)[1].strip()
        self.assertIn(f"nodes.csv:{last + 1}: uz: 900 is no row of the matrices", changed(last, f",{row}\n", ",900\n"))
        self.assertIn(f"row {row} of the matrices belongs to no node", changed(last, f",{row}\n", ",0\n"))
        self.assertIn("uz: row 1 is that of another displacement already", changed(last, f",{row}\n", ",1\n"))
        self.assertIn("1 of the 44 nodes of the mesh has no place", changed(1, "1,-2,", "1,-3,"))
        self.assertIn("stiffness.mtx", refusal(self.matrices(mass="missing.mtx", stiffness="stiffness.mtx")))

    @staticmethod
    def changed_matrix(name, change):
        """Entries (row, column, value) of a matrix, changed."""
        with open(os.path.join(PLATE, name), encoding="ascii") as stream:
            header, size, *lines = stream.readlines()
        entries = [change(int(row), int(column), float(value)) for row, column, value in map(str.split, lines)]
        with open(path("changed_" + name), "w", encoding="ascii") as stream:
            stream.writelines([header, size, *(f"{row} {column} {value!r}\n" for row, column, value in entries)])
        return path("changed_" + name)

    def exchanged_columns(self, *order):
        """The table of nodes with other directions: ux, uy, uz are its last columns."""
        with open(os.path.join(PLATE, "nodes.csv"), encoding="ascii") as stream:
            header, *rows = [line.strip().split(",") for line in stream]
        with open(path("nodes.csv"), "w", encoding="ascii") as stream:
            stream.write("\n".join(",".join(row) for row in [header, *(row[:4] + [row[4 + i] for i in order] for row in rows)]))
        return refusal(self.matrices(nodes=path("nodes.csv")))

    def test_matrices_that_are_none_of_a_body_are_refused(self):
        for name in ("stiffness", "mass"):
            for sign in (-1.0, 0.0):
                wrong = self.changed_matrix(name + ".mtx", lambda i, j, value: (i, j, sign * value if i == j == 5 else value))
                text = refusal(self.matrices(**{name: wrong}))
                self.assertIn(f"{name}.mtx: the diagonal entry of u", text)
                self.assertIn(" of the node at (", text)
        for order in ((0, 2, 1), (1, 0, 2), (1, 2, 0)):
            self.assertIn("do ux, uy, uz stand for the directions", self.exchanged_columns(*order))
        self.assertIn("are stiffness and mass exchanged?", refusal(self.matrices(
            stiffness=os.path.join(PLATE, "mass.mtx"), mass=os.path.join(PLATE, "stiffness.mtx"))))
        heavy = self.changed_matrix("mass.mtx", lambda i, j, value: (i, j, 3.0 * value if i == j and i % 3 == 1 else value))
        self.assertIn("the mass of all free nodes is", refusal(self.matrices(mass=heavy)))

    def test_init_begins_with_the_mesh_beside_the_modes(self):
        for name in ("plate.frd", "plate.inp"):
            shutil.copy(os.path.join(PLATE, name), path(name))
        scene = path("begun.toml")
        if os.path.exists(scene):
            os.remove(scene)
        subprocess.run([PROGRAM, "init", "modes", path("plate.frd"), "-o", scene], check=True)
        with open(scene, encoding="utf-8") as file:
            text = file.read()
        for line in ('kind = "modes"', 'file = "plate.frd"', 'mesh = "plate.inp"', 'surface = "contact"'):
            self.assertIn("\n" + line, text)
        checked = subprocess.run([PROGRAM, "check", scene], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn("modal masses of plate.frd are 0.999998 to 1 kg; 1 kg is expected", checked.stdout)  # no question where all is right
        self.assertNotIn("is material.density", checked.stdout)

    def begun(self, folder, *words):
        """`init modes WORDS`: exit code, and the scene or what is said."""
        finished = subprocess.run([PROGRAM, "init", "modes", *words], cwd=folder, capture_output=True, text=True)
        return finished.returncode, finished.stdout or finished.stderr

    def test_init_finds_the_mesh_of_modes_of_any_name(self):
        """A .npz file and a table have no deck of their own: the only mesh there, or the one of their name, or one that is named."""
        folder = path("any")
        os.makedirs(folder)
        np.savez(os.path.join(folder, "modes.npz"), **self.arrays)
        self.assertEqual(self.begun(folder, "modes.npz")[0], 1)
        self.assertIn("no mesh lies beside it", self.begun(folder, "modes.npz")[1])
        shutil.copy(os.path.join(PLATE, "plate.inp"), folder)
        self.assertIn('\nmesh = "plate.inp"', self.begun(folder, "modes.npz")[1])
        shutil.copy(os.path.join(PLATE, "coarse.inp"), folder)
        self.assertIn("which is its mesh? In ", self.begun(folder, "modes.npz")[1])
        self.assertIn("are coarse.inp and plate.inp; name it: `microslip init modes modes.npz coarse.inp`", self.begun(folder, "modes.npz")[1])
        self.assertIn('\nmesh = "plate.inp"', self.begun(folder, "modes.npz", "plate.inp")[1])
        self.assertIn("meshes are read from files that end in", self.begun(folder, "modes.npz", "plate.txt")[1])
        shutil.copy(os.path.join(PLATE, "plate.inp"), os.path.join(folder, "modes.inp"))
        self.assertIn('\nmesh = "modes.inp"', self.begun(folder, "modes.npz")[1])

    def test_init_writes_the_unit_that_the_mesh_tells(self):
        """The modes are in it too, and kind = "modes" asks for it."""
        folder = path("unit")
        os.makedirs(folder)
        in_millimetres = mesh_files.Mesh(1e3 * self.mesh.nodes if self.mesh.nodes.max() < 1 else self.mesh.nodes, self.mesh.blocks,
                                         self.mesh.surfaces, self.mesh.points)
        mesh_files.write_unv(in_millimetres, os.path.join(folder, "plate.unv"), millimetres=True)
        np.savez(os.path.join(folder, "modes.npz"), **self.arrays)
        code, scene = self.begun(folder, "modes.npz")
        self.assertEqual(code, 0, scene)
        self.assertIn('\nlength_unit = "mm"', scene)
        with open(os.path.join(folder, "scene.toml"), "w", encoding="utf-8") as stream:
            stream.write(scene.replace('length_unit = "mm"', 'length_unit = "mm"\nmass_unit = "kg"'))
        checked = subprocess.run([PROGRAM, "check", "scene.toml"], cwd=folder, capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_init_begins_with_matrices(self):
        job = path("job")
        os.makedirs(os.path.join(job, "matrices"), exist_ok=True)
        for name in ("stiffness.mtx", "mass.mtx"):
            shutil.copy(os.path.join(PLATE, name), os.path.join(job, "matrices"))
        stiffness = os.path.join(job, "matrices", "stiffness.mtx")

        def begun(*more):
            return subprocess.run([PROGRAM, "init", "modes", stiffness, *more], capture_output=True, text=True)

        self.assertIn("nodes.csv does not lie beside it", begun().stderr)
        shutil.copy(os.path.join(PLATE, "nodes.csv"), os.path.join(job, "matrices"))
        self.assertIn("no mesh lies beside it", begun().stderr)
        shutil.copy(os.path.join(PLATE, "coarse.inp"), job)
        scene = os.path.join(job, "scene.toml")
        self.assertEqual(begun("-o", scene).returncode, 0)
        with open(scene, encoding="utf-8") as file:
            text = file.read()
        for line in ('stiffness = "matrices/stiffness.mtx"', 'nodes = "matrices/nodes.csv"', 'mesh = "coarse.inp"',
                     'residual = "attachment"', "# file ="):
            self.assertIn("\n" + line, text)
        checked = subprocess.run([PROGRAM, "check", scene], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        shutil.copy(os.path.join(PLATE, "plate.inp"), job)
        self.assertIn("which is its mesh?", begun().stderr)

    def test_init_tells_where_the_mesh_is_missing(self):
        os.makedirs(path("alone"))
        shutil.copy(os.path.join(PLATE, "plate.frd"), path("alone/alone.frd"))
        self.assertEqual(self.begun(path("alone"), "alone.frd")[0], 1)
        self.assertIn("alone.frd: no mesh lies beside it", self.begun(path("alone"), "alone.frd")[1])

    def test_a_stiffness_that_is_not_positive_definite_is_told(self):
        """Off the diagonal, so that only the eigensolver sees it."""
        wrong = self.changed_matrix("stiffness.mtx", lambda i, j, value: (i, j, 40.0 * value if (i, j) == (2, 1) else value))
        scene = write_scene("indefinite.toml", self.matrices(stiffness=wrong), "count = 4")
        finished = subprocess.run([PROGRAM, "modes", scene, "-o", path("indefinite")], capture_output=True, text=True)
        self.assertEqual(finished.returncode, 2, finished.stdout + finished.stderr)
        self.assertIn("not positive definite: look in", finished.stderr)

    def test_a_mass_in_another_unit_is_questioned(self):
        scene = write_scene("mass.toml", self.matrices() + '\nmass_unit = "kg"', "count = 4")
        finished = subprocess.run([PROGRAM, "check", scene], capture_output=True, text=True, check=True)
        self.assertRegex(finished.stdout, r"warning: model.mass_unit: what is free to move has .* 7\.2\d kg/m\^3")
        scene = write_scene("mass.toml", self.matrices(), "count = 4")
        finished = subprocess.run([PROGRAM, "check", scene], capture_output=True, text=True, check=True)
        self.assertNotIn("model.mass_unit", finished.stdout)

    def test_all_nodes_held_in_one_direction(self):
        """What moves along x and y weighs what it weighs: half of the element at the root is held."""
        with open(os.path.join(PLATE, "nodes.csv"), encoding="ascii") as stream:
            header, *rows = [line.strip().split(",") for line in stream]
        kept = sorted(int(row[column]) for row in rows for column in (4, 5) if row[column] != "0")
        number = {old: new for new, old in enumerate(kept, 1)}
        for row in rows:
            row[4:] = [str(number[int(row[4])]), str(number[int(row[5])]), "0"] if row[4] != "0" else ["0", "0", "0"]
        with open(path("plane.csv"), "w", encoding="ascii") as stream:
            stream.write("\n".join(map(",".join, [header, *rows])))
        files = {"nodes": path("plane.csv")}
        for name in ("stiffness", "mass"):
            with open(os.path.join(PLATE, name + ".mtx"), encoding="ascii") as stream:
                entries = [line.split() for line in stream.readlines()[2:]]
            entries = [f"{number[int(i)]} {number[int(j)]} {value}\n" for i, j, value in entries
                       if int(i) in number and int(j) in number]
            files[name] = path(f"plane_{name}.mtx")
            with open(files[name], "w", encoding="ascii") as stream:
                stream.writelines(["%%MatrixMarket matrix coordinate real symmetric\n",
                                   f"{len(kept)} {len(kept)} {len(entries)}\n", *entries])
        masses = []
        for matrices in (self.matrices(), self.matrices(**files)):
            finished = subprocess.run([PROGRAM, "check", write_scene("plane.toml", matrices, "count = 4")], capture_output=True,
                                      text=True)
            self.assertEqual(finished.returncode, 0, finished.stderr)
            self.assertNotIn("model.mass_unit", finished.stdout)
            masses.append(float(re.search(r"by the matrix: (\S+) kg", finished.stdout)[1]))
        self.assertGreater(masses[0], 0.01)
        self.assertAlmostEqual(masses[1], masses[0], delta=1e-5 * masses[0])

    def test_a_matrix_that_is_a_pipe_is_not_waited_for(self):
        os.mkfifo(path("pipe.mtx"))
        self.assertIn("pipe.mtx: not a file", refusal(self.matrices(stiffness=path("pipe.mtx"))))

    def test_other_normalisation_is_rescaled(self):
        scaled = {**self.arrays, "shapes": self.arrays["shapes"] * np.array([1, 7, 0.1, 3, 2, 5])[:, None, None]}
        np.savez(path("scaled.npz"), **scaled)
        text = refusal(given(path("scaled.npz"), 'mass_unit = "kg"'))
        self.assertIn("modal masses of scaled.npz are 0.01 to 49 kg", text)
        self.assertIn('normalisation = "other"', text)
        found = result_of("scaled", given(path("scaled.npz"), 'mass_unit = "kg"\nnormalisation = "other"'))
        self.compare("rescaled", found, self.none, SOLVED)
        self.assertIn('"other" needs material.density',
                      refusal(given(path("scaled.npz"), 'normalisation = "other"', density="")))

    def test_without_density_the_modes_are_taken_on_trust(self):
        scene = write_scene("trust.toml", given(path("modes.npz"), 'mass_unit = "kg"', density=""), "")
        finished = subprocess.run([PROGRAM, "check", scene], capture_output=True, text=True, check=True)
        self.assertIn("give material.density", finished.stdout)
        self.assertIn('modes.residual = "none": nothing stands for the modes beyond the 6 given', finished.stdout)

    def test_files_that_cannot_be_used_are_refused(self):
        def changed(**arrays):
            np.savez(path("bad.npz"), **{**self.arrays, **arrays})
            return refusal(given(path("bad.npz"), 'mass_unit = "kg"'))

        frequency, nodes, shapes = (self.arrays[name] for name in ("frequency_Hz", "nodes", "shapes"))
        np.save(path("bare.npy"), shapes)
        os.replace(path("bare.npy"), path("bare.npz"))
        self.assertIn("bare.npz: one array without a name, as numpy.save writes", refusal(given(path("bare.npz"), 'mass_unit = "kg"')))
        self.assertIn("mode 2 has 258.9", changed(frequency_Hz=frequency[[1, 0, 2, 3, 4, 5]]))
        self.assertIn("mode 1: its frequency is -3 Hz", changed(frequency_Hz=np.append(-3.0, frequency[1:])))
        self.assertIn('array "shapes" is 5 x 127 x 3; expected 6 x 127 x 3', changed(shapes=shapes[:5]))
        self.assertIn("mode 4: all displacements are 0", changed(shapes=shapes * (np.arange(6) != 3)[:, None, None]))
        self.assertIn("126 of the 127 nodes of the mesh have no place", changed(nodes=25.4 * nodes))
        self.assertIn("two modes of bad.npz are not orthogonal",
                      subprocess.run([PROGRAM, "check", self.mixed(shapes)], capture_output=True, text=True).stdout)
        self.assertIn("modes.count: 9 modes are asked for", refusal(given(path("modes.npz"), 'mass_unit = "kg"'), "count = 9"))
        self.assertIn("has no attachment shapes", refusal(given(path("modes.npz"), 'mass_unit = "kg"'), 'residual = "attachment"'))
        self.assertIn("modal masses", refusal(given(os.path.join(PLATE, "plate.frd"), 'mass_unit = "kg"')))
        self.assertIn("With 7800 kg/m^3 they would have it: is material.density that of the body?",
                      refusal(given(os.path.join(PLATE, "plate.frd"), density="density = 3000")))

    def test_shapes_that_do_not_belong_to_their_frequencies(self):
        """Exchanged nodes or directions, radians per second: the strain energy tells."""
        def scene(**arrays):
            np.savez(path("energy.npz"), **{**self.arrays, **arrays})
            return given(path("energy.npz"), 'mass_unit = "kg"')

        frequency, shapes = self.arrays["frequency_Hz"], self.arrays["shapes"]
        self.assertIn("are the frequencies in Hz? In rad/s they are 6.28 times as large",
                      refusal(scene(frequency_Hz=2 * np.pi * frequency)))
        self.assertIn("nodes or directions mixed up", refusal(scene(shapes=shapes[:, :, [0, 2, 1]])))
        exchanged = shapes.copy()
        exchanged[:, [5, 60]] = shapes[:, [60, 5]]
        self.assertIn("nodes or directions mixed up", refusal(scene(shapes=exchanged)))
        stretched = frequency * np.array([1, 1, 1.1, 1.05, 1.02, 1.01])
        written = write_scene("energy.toml", scene(frequency_Hz=stretched), "")
        finished = subprocess.run([PROGRAM, "check", written], capture_output=True, text=True, check=True)
        self.assertRegex(finished.stdout, r"warning: frequencies, shapes and density of energy.npz tell a Young's modulus of 2\.1")
        coupled = shapes.copy()
        coupled[1] = (shapes[1] + 0.3 * shapes[0]) / np.sqrt(1.09)
        written = write_scene("energy.toml", scene(shapes=coupled), "")  # no error alone: so are those of two densities
        finished = subprocess.run([PROGRAM, "check", written], capture_output=True, text=True, check=True)
        self.assertRegex(finished.stdout, r"warning: two modes of energy.npz are not orthogonal: their common mass is 2[89] %")

    def test_constraints_of_the_deck_belong_to_the_modes(self):
        with open(os.path.join(PLATE, "plate.inp"), encoding="ascii") as stream:
            deck = stream.read().replace("*STEP", "*EQUATION\n2\n127, 3, 1., 29, 3, -1.\n*STEP")
        with open(path("joined.inp"), "w", encoding="ascii") as stream:
            stream.write(deck)
        model = given(os.path.join(PLATE, "plate.frd")).replace(f"{PLATE}/plate.inp", path("joined.inp"))
        finished = subprocess.run([PROGRAM, "check", write_scene("joined.toml", model, "")], capture_output=True, text=True)
        self.assertEqual(finished.returncode, 0, finished.stderr)
        self.assertIn(f'warning: {path("joined.inp")}:173: *EQUATION is no part of the mesh', finished.stdout)
        self.assertIn("joined.inp:173: *EQUATION is not read: without it this is another structure",
                      refusal(plate_model(path("joined.inp"))))

    def test_a_body_of_two_densities(self):
        """Its tip weighs fifteen times as much: by the mass of one density its modes are not orthogonal."""
        if shutil.which("ccx") is None:
            self.skipTest("CalculiX (ccx, Debian package calculix-ccx) is not installed: no modes of two densities")
        with open(os.path.join(PLATE, "plate.inp"), encoding="ascii") as stream:
            deck = stream.read()
        deck = deck.replace("*SOLID SECTION, ELSET=all, MATERIAL=steel", """*ELSET, ELSET=tip, GENERATE
9, 12
*ELSET, ELSET=rest, GENERATE
1, 8
*MATERIAL, NAME=heavy
*ELASTIC
210000, 0.3
*DENSITY
1.17e-7
*SOLID SECTION, ELSET=tip, MATERIAL=heavy
*SOLID SECTION, ELSET=rest, MATERIAL=steel""")
        with open(path("heavy.inp"), "w", encoding="ascii") as stream:
            stream.write(deck)
        subprocess.run(["ccx", "heavy"], cwd=WORK, check=True, capture_output=True)
        scene = write_scene("heavy.toml", given(path("heavy.frd"), 'normalisation = "other"'), "")
        finished = subprocess.run([PROGRAM, "check", scene], capture_output=True, text=True)
        self.assertEqual(finished.returncode, 0, finished.stderr)
        found = re.search(r"warning: two modes of heavy.frd are not orthogonal: their common mass is (\d+) %", finished.stdout)
        self.assertGreater(int(found[1]), 20)

    def mixed(self, shapes):
        """A scene whose second mode has some of the first in it."""
        wrong = shapes.copy()
        wrong[1] = shapes[1] + 0.1 * shapes[0]
        np.savez(path("bad.npz"), **{**self.arrays, "shapes": wrong})
        return write_scene("mixed.toml", given(path("bad.npz"), 'mass_unit = "kg"'), "")

    def test_truncated_results_are_refused(self):
        with open(os.path.join(PLATE, "plate.frd"), encoding="latin-1") as stream:
            lines = stream.readlines()
        with open(path("cut.frd"), "w", encoding="latin-1") as stream:
            stream.writelines(lines[:250])
        self.assertIn("cut.frd: the file ends in the middle of a block, at line 250", refusal(given(path("cut.frd"))))
        begins = [i for i, line in enumerate(lines) if line.startswith("    1PSTEP")]
        with open(path("modes.frd"), "w", encoding="latin-1") as stream:
            stream.writelines(lines[:begins[3]])
        self.assertIn(f"modes.frd:{begins[3]}: the file ends here, after mode 3", refusal(given(path("modes.frd"))))
        with open(path("none.frd"), "w", encoding="latin-1") as stream:
            stream.writelines(lines[:180])
        self.assertIn("none.frd: there are no modes in it", refusal(given(path("none.frd"))))
        with open(path("word.frd"), "w", encoding="latin-1") as stream:
            stream.writelines([*lines[:200], lines[200].replace("E", "X"), *lines[201:]])
        self.assertIn("word.frd:201: expected a number", refusal(given(path("word.frd"))))
        with open(path("whole.frd"), "w", encoding="latin-1") as stream:
            stream.writelines([*lines, "\n", "\n"])  # of an editor
        scene = write_scene("whole.toml", given(path("whole.frd")), "")
        self.assertEqual(subprocess.run([PROGRAM, "check", scene], capture_output=True).returncode, 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
