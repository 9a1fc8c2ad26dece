#!/usr/bin/env python3
"""The same blade in every mesh format gives the same frequencies and the same peak.

The parametric blade is meshed once, coarsely; its mesh is written as .inp (faces, and node sets in place of faces),
.bdf, .unv (with units), .med, .vtu, .vtk and Exodus by tests/support/mesh_files.py. Coordinates are doubles in every
format but Nastran's, which has ten digits: frequencies differ by rounding there and by 1e-9 here. Newton's method ends
at residuals of 1e-10 or less of the force, so that a peak agrees to 1e-6 by a wide margin.

usage: mesh_formats.py MICROSLIP SOURCE WORK_FOLDER
"""
import importlib.util
import json
import os
import resource
import shutil
import subprocess
import sys
import unittest

import numpy as np

from program_run import run_scene, without_plots

PROGRAM, SOURCE, WORK = sys.argv[1:4]
del sys.argv[1:]
sys.path.insert(0, os.path.join(SOURCE, "tests", "support"))
import mesh_files

TOLERANCE = 1e-6
SCENE = """
[model]
kind = "mesh"
file = "{file}"
{unit}
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["{root}"]
[modes]
count = 4
damping_ratio = 0.005
residual = "none"
[contact]
surface = "{contact}"
slip_direction = [0, 1, 0]
friction_coefficient = 0.4
normal_stiffness = "1e11 N/m^3"
tangential_stiffness = "1e11 N/m^3"
points = 40
[excitation]
forces = [ {{ at = "{B}", direction = [1, 0, 0], amplitude = "0.5 N" }} ]
[response]
output = {{ at = "{A}", direction = [1, 0, 0] }}
frequency = ["290 Hz", "350 Hz"]
harmonics = 1
preload = [100]
[effects]
second_direction = "off"
"""
PLAIN = {"root": "root", "contact": "contact", "A": "A", "B": "B"}


def result_of(file, names, unit="m"):
    """Frequencies and the peak of a run with this mesh."""
    scene = os.path.join(WORK, "scene.toml")
    with open(scene, "w", encoding="utf-8") as stream:
        stream.write(SCENE.format(file=file, unit=f'length_unit = "{unit}"' if unit else "", **names))
    folder = os.path.join(WORK, file + ".run")
    run_scene(PROGRAM, scene, folder)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as stream:
        summary = json.load(stream)
    peak = summary["curves"][0]["peak"]
    return [mode["frequency_Hz"] for mode in summary["modes"]] + [peak["frequency_Hz"], peak["amplitude_m"]]


class Formats(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)
        subprocess.run([PROGRAM, "mesh", os.path.join(SOURCE, "share", "scenes", "blade_to_ground.toml"), "-q",
                        "--set", 'model.element_size="20 mm"', "-o", cls.path("blade.msh")], check=True, env=without_plots())
        cls.mesh = mesh_files.from_gmsh(cls.path("blade.msh"))
        cls.expected = result_of("blade.msh", PLAIN, unit=None)

    @staticmethod
    def path(name):
        return os.path.join(WORK, name)

    def check(self, file, names=None, unit="m"):
        found = result_of(file, names or PLAIN, unit)
        worst = max(abs(a / b - 1.0) for a, b in zip(found, self.expected, strict=True))
        print(f"{file}: frequencies and peak differ by {worst:.1e} from those of the .msh file")
        self.assertLess(worst, TOLERANCE)

    def test_abaqus_surfaces(self):
        mesh_files.write_inp(self.mesh, self.path("faces.inp"))
        self.check("faces.inp")

    def test_abaqus_node_sets(self):
        mesh_files.write_inp(self.mesh, self.path("sets.inp"), node_surfaces=("root", "contact"))
        self.check("sets.inp")

    def test_surfaces_command(self):
        mesh_files.write_inp(self.mesh, self.path("names.inp"), node_surfaces=("contact",))
        listed = self.surfaces("names.inp")
        self.assertIsNone(listed["length_unit"])
        by_name = {entry["name"]: entry for entry in listed["surfaces"]}
        for name, kind, area, normal in (("root", "surface", 0.0066 * 0.05, (0, -1, 0)),
                                         ("contact", "node set", 0.01 * 0.06, (1, 0, 0))):
            entry = by_name[name]
            self.assertEqual((entry["kind"], entry["faces"]), (kind, len(self.mesh.surfaces[name])))
            self.assertAlmostEqual(entry["area"], area, delta=1e-12)
            self.assertLess(max(abs(a - b) for a, b in zip(entry["normal"], normal)), 1e-9)
            self.assertLess(entry["flatness"], 1e-9)
        self.assertAlmostEqual(by_name["contact"]["centre"][0], 0.03, delta=1e-12)
        self.assertEqual((by_name["A"]["kind"], by_name["A"]["faces"]), ("point", 0))

    def surfaces(self, file):
        finished = subprocess.run([PROGRAM, "surfaces", self.path(file), "--json"], capture_output=True, text=True, check=True)
        return json.loads(finished.stdout.splitlines()[-1])

    def scene_of(self, file, held=True, told="complete and consistent"):
        """What init makes of it, after check found it complete, or that nothing is held yet."""
        scene = self.path(file + ".toml")
        subprocess.run([PROGRAM, "init", "mesh", self.path(file), "-o", scene], check=True)
        checked = subprocess.run([PROGRAM, "check", scene], capture_output=True, text=True)
        if held:
            self.assertIn(told, checked.stdout, checked.stderr)
        else:
            self.assertIn("name the clamped surfaces in [supports] clamped", checked.stderr)
        with open(scene, encoding="utf-8") as stream:
            return stream.read()

    def test_init_takes_names_size_and_unit_of_the_file(self):
        in_millimetres = mesh_files.Mesh(1e3 * self.mesh.nodes, self.mesh.blocks, self.mesh.surfaces, self.mesh.points)
        mesh_files.write_inp(in_millimetres, self.path("begin.inp"))
        scene = self.scene_of("begin.inp")
        for line in ('file = "begin.inp"', 'length_unit = "mm"', 'clamped = ["root"]', 'surface = "contact"',
                     "slip_direction = [0, 1, 0]", 'output = { at = "tip"'):
            self.assertIn("\n" + line, scene)
        mesh_files.write_unv(in_millimetres, self.path("begin.unv"), millimetres=True)
        self.assertNotIn("\nlength_unit", self.scene_of("begin.unv"))

    def test_another_unit_than_that_of_the_file_is_questioned(self):
        """By check and by run, in one line; where they say the same nothing is asked."""
        in_millimetres = mesh_files.Mesh(1e3 * self.mesh.nodes, self.mesh.blocks, self.mesh.surfaces, self.mesh.points)
        mesh_files.write_unv(in_millimetres, self.path("told.unv"), millimetres=True)
        scene = self.path("told.toml")
        for unit, question in (("mm", None), ("cm", "warning: model.length_unit: 0.01 m is written, and told.unv says 0.001 m")):
            with open(scene, "w", encoding="utf-8") as stream:
                stream.write(SCENE.format(file="told.unv", unit=f'length_unit = "{unit}"', **PLAIN))
            for _ in range(2):  # the second with modes of an earlier run
                checked = subprocess.run([PROGRAM, "check", scene], capture_output=True, text=True, env=without_plots())
                self.assertEqual(checked.returncode, 0, checked.stderr)
                self.assertEqual(checked.stdout.count("model.length_unit"), 1 if question else 0)
                self.assertIn(question or "", checked.stdout)
            if question:
                ran = subprocess.run([PROGRAM, "run", scene, "-o", self.path("told.run"), "--set", "response.frequency=[30, 31]"],
                                     capture_output=True, text=True, env=without_plots())
                self.assertIn(question, ran.stdout + ran.stderr)

    def test_init_does_not_take_salome_at_its_word(self):
        """It writes metre into .unv files, whatever it draws in."""
        in_millimetres = mesh_files.Mesh(1e3 * self.mesh.nodes, self.mesh.blocks, self.mesh.surfaces, self.mesh.points)
        mesh_files.write_unv(in_millimetres, self.path("salome.unv"), millimetres=True)
        with open(self.path("salome.unv"), encoding="ascii") as stream:
            text = stream.read()
        factor = text.splitlines()[3].split()[0]  # of data set 164, to divide by for metres
        with open(self.path("salome.unv"), "w", encoding="ascii") as stream:
            stream.write(text.replace(factor, factor.replace("D+03", "D+00").replace("E+03", "E+00").replace("1000.0", "1.0"), 1))
        scene = self.scene_of("salome.unv")
        self.assertIn('\nlength_unit = "mm"', scene)
        self.assertIn("CHECK: the file says metre", scene)

    def test_init_writes_the_order_of_the_file(self):
        """Written otherwise it is questioned: the file counts."""
        mesh_files.write_inp(self.mesh, self.path("curved.inp"))
        self.assertIn("\norder = 2", self.scene_of("curved.inp"))
        corners = {"tetra": connectivity[:, :4] for connectivity in self.mesh.blocks.values()}
        used = np.unique(corners["tetra"])
        number = np.full(len(self.mesh.nodes), -1)
        number[used] = np.arange(len(used))
        surfaces = {name: number[np.array(self.mesh.surfaces[name])] for name in ("root", "contact")}
        mesh_files.write_inp(mesh_files.Mesh(self.mesh.nodes[used], {"tetra": number[corners["tetra"]]}, surfaces, {}),
                             self.path("straight.inp"))
        self.assertIn("\norder = 1", self.scene_of("straight.inp", told="too high, by tet4 elements of this size"))
        told = subprocess.run([PROGRAM, "check", self.path("straight.inp.toml"), "--set", "model.order=2"],
                              capture_output=True, text=True).stdout
        self.assertIn("model.order: 2 is written, the elements of straight.inp are of order 1 (tet4)", told)
        self.assertNotIn("model.order", subprocess.run([PROGRAM, "check", self.path("straight.inp.toml")],
                                                       capture_output=True, text=True).stdout)

    def test_init_prints_a_scene_for_the_working_folder(self):
        mesh_files.write_inp(self.mesh, self.path("printed.inp"))
        printed = subprocess.run([PROGRAM, "init", "mesh", "printed.inp"], cwd=WORK, capture_output=True, text=True)
        self.assertIn('\nfile = "printed.inp"', printed.stdout, printed.stderr)

    def test_init_leaves_open_what_cannot_be_known(self):
        nameless = mesh_files.Mesh(self.mesh.nodes, self.mesh.blocks, {}, {"P1": self.mesh.points["A"]})
        mesh_files.write_inp(nameless, self.path("nameless.inp"))
        scene = self.scene_of("nameless.inp", held=False)
        for line in ("clamped = []", "# [contact]", '# surface = "contact"', '# preload =', "# CHOOSE what is held"):
            self.assertIn("\n" + line, scene)

    def test_init_guesses_by_the_shape_where_names_tell_nothing(self):
        """The larger end is held, what lies along the blade rubs, the force acts far from both; each is to be chosen."""
        numbered = {"tip": "F1", "contact": "F2", "root": "F3"}
        surfaces = {numbered[name]: self.mesh.surfaces[name] for name in numbered}
        mesh_files.write_inp(mesh_files.Mesh(self.mesh.nodes, self.mesh.blocks, surfaces, {}), self.path("numbered.inp"))
        scene = self.scene_of("numbered.inp")
        for line in ('clamped = ["F3"]', 'surface = "F2"', '  { at = "F1"', 'output = { at = "F1"'):
            self.assertIn("\n" + line, scene)
        self.assertEqual(scene.count("# CHOOSE"), 2)

    def test_init_takes_a_curved_face_that_is_named_as_the_contact(self):
        """Though another one is plane."""
        bent = self.mesh.nodes.copy()
        bent[:, 0] += 5.0 * bent[:, 2] ** 2
        mesh_files.write_inp(mesh_files.Mesh(bent, self.mesh.blocks, self.mesh.surfaces, self.mesh.points), self.path("bent.inp"))
        self.assertIn('\nsurface = "contact"', self.scene_of("bent.inp"))

    def test_a_disk_without_room_is_no_fault_of_the_file(self):
        """Exit 4, and nothing left behind: files may grow to a kilobyte."""
        mesh_files.write_inp(self.mesh, self.path("room.inp"))
        blade = os.path.join(SOURCE, "share", "scenes")
        for command in (["surfaces", "room.inp"], ["init", "mesh", "room.inp", "-o", "room.toml"],
                        ["faces", os.path.join(blade, "blade.step")], ["init", "step", os.path.join(blade, "blade.step"), "-o", "room.toml"],
                        ["mesh", os.path.join(blade, "blade_to_ground.toml"), "--set", 'model.element_size="20 mm"', "--no-cache", "-o", "room.msh"]):
            with self.subTest(command=command):
                # Standard error is a pipe: a file would be as short.
                finished = subprocess.run([PROGRAM, *command], cwd=WORK, capture_output=True, text=True,
                                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1024, 1024)))
                self.assertEqual(finished.returncode, 4, finished.stderr)
                self.assertIn("cannot be written", finished.stderr)
                self.assertFalse([name for name in os.listdir(WORK) if name.startswith("room") and name != "room.inp"])

    def test_init_puts_no_force_on_the_contact_for_the_load_in_its_name(self):
        mesh_files.write_bdf(self.mesh, self.path("loads.bdf"), held=("root",), pressed=("contact",))
        scene = self.scene_of("loads.bdf")
        self.assertIn('\nsurface = "PLOAD4 1"', scene)
        self.assertNotIn('  { at = "PLOAD4 1"', scene)

    def test_init_takes_coordinates_where_no_place_is_left_for_the_force(self):
        in_millimetres = mesh_files.Mesh(1e3 * self.mesh.nodes, self.mesh.blocks,
                                         {name: self.mesh.surfaces[name] for name in ("root", "contact")}, {})
        mesh_files.write_inp(in_millimetres, self.path("two.inp"))
        scene = self.scene_of("two.inp")
        height = in_millimetres.nodes[:, 1].max()
        self.assertRegex(scene, rf'\n  {{ at = \["\S+ mm", "{height:.6g} mm", "\S+ mm"\], direction')
        mesh_files.write_inp(mesh_files.Mesh(self.mesh.nodes, self.mesh.blocks), self.path("none.inp"))
        refused = subprocess.run([PROGRAM, "init", "mesh", self.path("none.inp")], capture_output=True, text=True)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("names no surface and no set of nodes", refused.stderr)

    def test_nastran(self):
        mesh_files.write_bdf(self.mesh, self.path("blade.bdf"), held=("root",), pressed=("contact",))
        points = list(self.mesh.points)
        self.check("blade.bdf", {"root": "SPC 1", "contact": "PLOAD4 1", "A": f"SET {points.index('A') + 1}",
                                 "B": f"SET {points.index('B') + 1}"})

    def test_a_force_on_a_face_is_the_same_by_its_faces_and_by_its_nodes(self):
        """A set of nodes that are those of whole faces is the face."""
        at = {**PLAIN, "B": "tip"}
        expected = result_of("blade.msh", at, unit=None)
        for name, write in (("tip.med", mesh_files.write_med), ("tip.vtu", mesh_files.write_vtk),
                            ("tip.inp", lambda mesh, path: mesh_files.write_inp(mesh, path, node_surfaces=("tip",)))):
            with self.subTest(name):
                write(self.mesh, self.path(name))
                worst = max(abs(a / b - 1.0) for a, b in zip(result_of(name, at), expected, strict=True))
                print(f"{name}: frequencies and peak differ by {worst:.1e}")
                self.assertLess(worst, TOLERANCE)

    def test_universal_with_units(self):
        in_millimetres = mesh_files.Mesh(1e3 * self.mesh.nodes, self.mesh.blocks, self.mesh.surfaces, self.mesh.points)
        mesh_files.write_unv(in_millimetres, self.path("blade.unv"), millimetres=True)
        self.check("blade.unv", unit=None)

    def test_vtk(self):
        for file in ("blade.vtu", "blade.vtk"):
            mesh_files.write_vtk(self.mesh, self.path(file))
            self.check(file)

    def test_med(self):
        if importlib.util.find_spec("h5py") is None:
            self.skipTest("h5py is not installed: .med cannot be read")
        mesh_files.write_med(self.mesh, self.path("blade.med"))
        self.check("blade.med")

    def test_exodus(self):
        if importlib.util.find_spec("netCDF4") is None:
            self.skipTest("netCDF4 is not installed: Exodus files cannot be read")
        mesh_files.write_exodus(self.mesh, self.path("blade.e"))
        self.check("blade.e")


if __name__ == "__main__":
    unittest.main(verbosity=2)
