#!/usr/bin/env python3
"""`microslip converge` on a coarse blade: every ladder is there, told errors are those that the ladder shows.

Errors of 0.5 % and more of harmonics, cells and fit agree with what the budget tells within a factor of two; the finest
value has no true error; cells converge; times grow up the ladder of harmonics. Mesh files are rungs as sizes are.

usage: converge.py MICROSLIP SOURCE WORK_FOLDER
"""
import csv
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

from program_run import without_plots

PROGRAM, SOURCE, WORK = sys.argv[1:4]
del sys.argv[1:]
SCENE = os.path.join(SOURCE, "share", "scenes", "blade_to_ground.toml")
LEAN = ("model.element_size=10 mm", "response.preload=[500]", "response.frequency=[326, 336]", "contact.points=8",
        "modes.count=3", "response.harmonics=1")
SCRIPT = os.path.join(SOURCE, "share", "scripts", "mesh_convergence.py")
PLATE = os.path.join(SOURCE, "share", "scenes", "plate_mesh.toml")
SAME = 1e-6  # of peaks on the same mesh, in a file and made anew
KNOBS = ("element_size", "modes", "residual", "attachment_degree", "cells", "fit", "second_direction", "harmonics")
HEADER = "value,seconds,cpu_seconds,peak_amplitude_m,peak_frequency_Hz,true_error,estimated_error,order,curve,runs,at"


def converge(scene, folder, *settings, repeat="0", options=()):
    command = [PROGRAM, "converge", scene, "--repeat", repeat, "-o", folder, *options]
    for setting in settings:
        command += ["--set", setting]
    return subprocess.run(command, capture_output=True, text=True, timeout=600, env=without_plots())


def meshed(name, size):
    """The blade in a file of its own, with elements of that size; the names in it are those of kind "blade"."""
    place = os.path.join(WORK, name)
    subprocess.run([PROGRAM, "mesh", SCENE, "-q", "-o", place, "--set", f"model.element_size={size}"], check=True,
                   capture_output=True, timeout=300, env=without_plots())
    return place


def scene_of_mesh(file):
    """blade_to_ground.toml with a mesh in place of its geometry."""
    with open(SCENE, encoding="utf-8") as stream:
        text = stream.read()
    begin = text.index("[model]")
    place = os.path.join(WORK, "mesh.toml")
    with open(place, "w", encoding="utf-8") as stream:
        stream.write(f'[model]\nkind = "mesh"\nfile = "{os.path.abspath(file)}"\nlength_unit = "m"\n\n' + text[text.index("[material]", begin):])
    return place


def lean_scene():
    """The blade as LEAN has it, in a file."""
    with open(SCENE, encoding="utf-8") as stream:
        text = stream.read()
    for key, value in (("preload", "[500]"), ("frequency", '["310 Hz", "360 Hz"]'), ("count", "3"), ("harmonics", "1")):
        text, n = re.subn(rf"(?m)^{key} = .*$", f"{key} = {value}", text)
        assert n == 1, key
    place = os.path.join(WORK, "lean.toml")
    with open(place, "w", encoding="utf-8") as stream:
        stream.write(text.replace("[contact]", "[contact]\npoints = 8"))
    return place


def tables_in(folder):
    return sorted(name[:-4] for name in os.listdir(os.path.join(folder, "converge")) if name.endswith(".csv"))


def table(folder, knob):
    with open(os.path.join(folder, "converge", knob + ".csv"), encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Converge(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)
        cls.blade = os.path.join(WORK, "blade")
        cls.finished = converge(SCENE, cls.blade, *LEAN)

    def test_every_ladder_is_there(self):
        self.assertEqual(self.finished.returncode, 0, self.finished.stderr)
        for knob in KNOBS:
            with self.subTest(knob=knob):
                with open(os.path.join(self.blade, "converge", knob + ".csv"), encoding="utf-8") as file:
                    self.assertEqual(next(file).rstrip("\n"), HEADER)
                rows = table(self.blade, knob)
                self.assertGreaterEqual(len(rows), 2)
                self.assertEqual(rows[-1]["true_error"], "")
                self.assertIn(knob, self.finished.stdout)
                self.assertEqual(len({row["value"] for row in rows}), len(rows))
                for row in rows:
                    self.assertGreater(float(row["seconds"]), 0.0)
                    self.assertGreater(float(row["cpu_seconds"]), 0.0)
                    self.assertIn(row["runs"], ("1", "2", "3"))

    def test_nothing_is_timed_again_without_seconds_to_spend(self):
        self.assertIn("median of 1", self.finished.stdout)
        knobs = [name[:-4] for name in os.listdir(os.path.join(self.blade, "converge")) if name.endswith(".csv")]
        self.assertEqual({row["runs"] for knob in knobs for row in table(self.blade, knob)}, {"1"})

    def test_told_errors_are_the_true_ones(self):
        judged = 0
        for knob in ("harmonics", "cells", "fit"):
            for row in table(self.blade, knob):
                if not row["true_error"] or abs(float(row["true_error"])) < 5e-3:
                    continue
                judged += 1
                ratio = float(row["estimated_error"]) / float(row["true_error"])
                self.assertTrue(0.5 < ratio < 2.0, (knob, row))
        self.assertGreaterEqual(judged, 3)

    def test_cells_converge_and_harmonics_cost(self):
        errors = [abs(float(row["true_error"])) for row in table(self.blade, "cells")[:-1]]
        self.assertEqual(errors, sorted(errors, reverse=True))
        seconds = [float(row["cpu_seconds"]) for row in table(self.blade, "harmonics")]
        self.assertGreater(seconds[-1], seconds[0])

    def test_scenes_without_a_mesh_have_the_ladders_of_harmonics_and_method(self):
        folder = os.path.join(WORK, "chain")
        finished = converge(os.path.join(SOURCE, "share", "scenes", "chain_2dof.toml"), folder, "response.preload=[50]",
                            repeat="600")
        self.assertEqual(finished.returncode, 0, finished.stderr)
        self.assertEqual(sorted(os.listdir(os.path.join(folder, "converge"))), ["harmonics.csv", "method.csv"])
        with self.subTest("nine harmonics are within 0.1 % of time integration, as the scene says"):
            self.assertLess(abs(float(table(folder, "method")[0]["true_error"])), 1e-3)
        with self.subTest("times are the median of three runs, while there are seconds to spend"):
            self.assertIn("median of 3", finished.stdout)
            self.assertEqual({row["runs"] for row in table(folder, "harmonics")}, {"3"})

    def compare(self, rows, others):
        self.assertEqual(len(rows), len(others))
        for row, other in zip(rows, others):
            for key in ("peak_amplitude_m", "peak_frequency_Hz", "true_error", "at"):
                with self.subTest(row=row["value"], key=key):
                    if key == "at" or not row[key]:
                        self.assertEqual(row[key], other[key])
                    else:
                        self.assertAlmostEqual(float(row[key]) / float(other[key]), 1.0, delta=SAME)

    def test_mesh_files_are_what_their_sizes_are(self):
        sizes = ("20 mm", "14 mm", "10 mm")
        files = [meshed(f"{size[:2]},mm.msh", size) for size in sizes]
        folder = os.path.join(WORK, "files")
        wide = [*LEAN[1:], "response.frequency=[310, 360]"]
        finished = converge(scene_of_mesh(files[1]), folder, *wide,
                            options=("--knobs", "mesh_file", "harmonics", "--meshes", *files))
        self.assertEqual(finished.returncode, 0, finished.stderr)
        self.assertEqual(tables_in(folder), ["harmonics", "mesh_file"])
        rows = table(folder, "mesh_file")
        self.assertEqual([row["value"] for row in rows], ["20,mm.msh", "14,mm.msh", "10,mm.msh"])
        self.assertEqual({row["at"] for row in rows}, {"peak"})
        self.assertGreater(float(rows[1]["order"]), 0.5)
        self.assertEqual((rows[0]["order"], rows[2]["order"], rows[2]["true_error"]), ("", "", ""))
        made_here = os.path.join(WORK, "sizes")
        converge(SCENE, made_here, *LEAN, "response.frequency=[310, 360]",
                 options=("--knobs", "element_size", "--sizes", *sizes))
        self.compare(rows, table(made_here, "element_size"))

    def test_what_is_asked_for_is_looked_at_first(self):
        mesh = meshed("one.msh", "20 mm")
        scene = scene_of_mesh(mesh)
        for scene, options, complaint in (
                (scene, ("--meshes", mesh), "one mesh does not converge"),
                (scene, ("--meshes", mesh, mesh), "expected from coarse to fine"),
                (SCENE, ("--meshes", mesh, mesh), 'is of kind "blade"'),
                (scene, ("--sizes", "6mm", "4mm"), "give --meshes"),
                (SCENE, ("--sizes", "6 N", "4mm"), "--sizes: "),
                (SCENE, ("--knobs", "harmonic"), 'did you mean "harmonics"?')):
            for dry in ((), ("--dry-run",)):
                with self.subTest(complaint=complaint, dry=dry):
                    finished = converge(scene, os.path.join(WORK, "refused"), *LEAN[1:], options=(*options, *dry))
                    self.assertEqual(finished.returncode, 1, finished.stderr)
                    self.assertIn(complaint, finished.stderr)
                    self.assertEqual(finished.stderr.count("\n"), 1, finished.stderr)
        self.assertFalse(os.path.exists(os.path.join(WORK, "refused", "converge")))

    def test_a_mesh_file_is_set_against_itself_with_its_elements_halved(self):
        folder = os.path.join(WORK, "halved")
        finished = converge(PLATE, folder, "response.preload=[20]", options=("--knobs", "refinement"))
        self.assertEqual(finished.returncode, 0, finished.stderr)
        given, halved = table(folder, "refinement")
        self.assertEqual((given["value"], halved["value"]), ("given", "halved"))
        self.assertEqual((given["at"], halved["at"]), ("peak", "peak"))
        self.assertLess(float(halved["peak_frequency_Hz"]), float(given["peak_frequency_Hz"]))
        self.assertGreater(float(halved["peak_frequency_Hz"]), 0.9 * float(given["peak_frequency_Hz"]))
        self.assertNotEqual(given["true_error"], "")

    def test_an_interrupt_leaves_the_rungs_that_were_climbed(self):
        folder = os.path.join(WORK, "interrupted")
        place = os.path.join(folder, "converge", "element_size.csv")
        command = [PROGRAM, "converge", SCENE, "--repeat", "0", "-o", folder, "--knobs", "element_size", "harmonics"]
        for setting in (*LEAN, "response.harmonics=9"):
            command += ["--set", setting]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=without_plots()) as process:
            end = time.monotonic() + 300
            while not os.path.exists(place) and process.poll() is None and time.monotonic() < end:
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate(timeout=300)
        self.assertNotEqual(process.returncode, 0)
        self.assertIn("interrupted", errors)
        rows = table(folder, "element_size")
        self.assertEqual(rows[0]["value"], "0.04")
        self.assertLess(len(rows), 4)

    def test_the_script_of_mesh_convergence_is_a_use_of_it(self):
        folder = os.path.join(WORK, "script")
        environment = {"MICROSLIP_CACHE": "off", **os.environ}  # in which Python runs
        command = [SCRIPT, lean_scene(), "--sizes", "20mm", "0.014", "-o", folder, "--program", PROGRAM]
        finished = subprocess.run(command, capture_output=True, text=True, timeout=300, env=environment)
        self.assertEqual(finished.returncode, 0, finished.stderr)
        rows = table(folder, "element_size")
        self.assertEqual([row["value"] for row in rows], ["0.02", "0.014"])
        for row in rows:
            self.assertIn(f"| {float(row['peak_frequency_Hz']):.3f} | {float(row['peak_amplitude_m']):.4e} |", finished.stdout)
        with open(os.path.join(folder, "convergence.md"), encoding="utf-8") as stream:
            self.assertEqual(stream.read(), finished.stdout)
        with self.subTest("a table of these sizes is used again where that is asked for"):
            kept = subprocess.run([*command, "--keep", "--program", "/bin/false"], capture_output=True, text=True,
                                  timeout=300, env=environment)
            self.assertEqual((kept.returncode, kept.stdout), (0, finished.stdout), kept.stderr)

    def test_a_scene_without_response_is_refused(self):
        scene = os.path.join(WORK, "free.toml")
        with open(SCENE, encoding="utf-8") as file:
            text = file.read()
        with open(scene, "w", encoding="utf-8") as file:
            file.write(text[:text.index("[response]")])
        finished = converge(scene, os.path.join(WORK, "free"))
        self.assertEqual(finished.returncode, 1, finished.stderr)
        self.assertIn("response", finished.stderr)


if __name__ == "__main__":
    unittest.main()
