#!/usr/bin/env python3
"""Modes of other codes give the curve that the program's own modes give.

Reference: the mesh of share/scenes/plate/plate.inp solved here. Its modes and attachment shapes, written in full, come
back as .npz and .csv: peaks agree to the solver's tolerance. CalculiX integrates hex20 with the same 27 points;
plate.frd prints ten digits of a frequency and six of a displacement, so that frequencies agree to the 1e-6 that its
eigensolver is asked for, peaks to a few 1e-6. K and M that CalculiX stored have fourteen digits; its mass takes 27 points, ours is exact on twisted
bricks as well: that is 2e-7 here (3e-9 without the twist, where both are exact).

usage: given_modes.py MICROSLIP SOURCE WORK_FOLDER
"""
import csv
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
PLATE = os.path.join(SOURCE, "share", "scenes", "plate")
PRINTED = 5e-6
SOLVED = 1e-9
MATRICES = 1e-6

SCENE = """
[model]
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
"""
OWN = """kind = "mesh"
file = "{}"
length_unit = "mm"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["root"]"""
OWN_PLATE = OWN.format(os.path.join(PLATE, "plate.inp"))


def path(name):
    return os.path.join(WORK, name)


def write_scene(name, model, modes):
    with open(path(name), "w", encoding="utf-8") as stream:
        stream.write(SCENE.format(model=model, modes=modes))
    return path(name)


def result_of(name, model, modes="", own=False):
    """Frequencies and the peak of a run."""
    run_scene(PROGRAM, write_scene(name + ".toml", model, ("count = 6\n" if own else "") + modes), path(name))
    with open(os.path.join(path(name), "summary.json"), encoding="utf-8") as stream:
        summary = json.load(stream)
    peak = summary["curves"][0]["peak"]
    return np.array([mode["frequency_Hz"] for mode in summary["modes"]] + [peak["frequency_Hz"], peak["amplitude_m"]])


def given(file, more="", density="density = 7800"):
    return f'kind = "modes"\nfile = "{file}"\nmesh = "{PLATE}/plate.inp"\nlength_unit = "mm"\n{more}\n[material]\n{density}'


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
        self.compare("csv", result_of("csv", given(path("modes.csv"), 'mass_unit = "kg"')), self.none, SOLVED)

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
        return "\n".join(['kind = "modes"', 'length_unit = "mm"', *keys])

    def test_matrices(self):
        own = OWN.format(os.path.join(PLATE, "coarse.inp"))
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
        self.assertIn("1 of the 44 nodes of the mesh have no place", changed(1, "1,-2,", "1,-3,"))
        self.assertIn("stiffness.mtx", refusal(self.matrices(mass="missing.mtx", stiffness="stiffness.mtx")))

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

    def mixed(self, shapes):
        """A scene whose second mode has some of the first in it."""
        wrong = shapes.copy()
        wrong[1] = 0.8 * shapes[1] + 0.6 * shapes[0]
        np.savez(path("bad.npz"), **{**self.arrays, "shapes": wrong})
        return write_scene("mixed.toml", given(path("bad.npz"), 'mass_unit = "kg"'), "")

    def test_truncated_results_are_refused(self):
        with open(os.path.join(PLATE, "plate.frd"), encoding="latin-1") as stream:
            lines = stream.readlines()
        with open(path("cut.frd"), "w", encoding="latin-1") as stream:
            stream.writelines(lines[:250])
        self.assertIn("cut.frd: the file ends in the middle of a block, at line 250", refusal(given(path("cut.frd"))))
        with open(path("none.frd"), "w", encoding="latin-1") as stream:
            stream.writelines(lines[:180])
        self.assertIn("none.frd: there are no modes in it", refusal(given(path("none.frd"))))
        with open(path("word.frd"), "w", encoding="latin-1") as stream:
            stream.writelines([*lines[:200], lines[200].replace("E", "X"), *lines[201:]])
        self.assertIn("word.frd:201: expected a number", refusal(given(path("word.frd"))))


if __name__ == "__main__":
    unittest.main(verbosity=2)
