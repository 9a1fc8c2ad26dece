#!/usr/bin/env python3
"""The preload of static loads from the scene to the files: what `check` prints is what a run uses.

share/scenes/blade_static_preload.toml with large elements. Its contact carries, in model.h5, the force that is told and is
open where it is told; the curve "static" is the curve of that many newtons, to rounding; half the loads are half the preload
where the rotor stands still. A scene whose loads lift the contact off is refused with exit code 2.

share/scenes/plate_matrices.toml, whose K is CalculiX's: the pressures of model.h5 are put on that K as it stands in the file,
with shape functions written anew here, and the displacements it answers with must be those that make these pressures: of
a layer of springs, of rough surfaces. The same plate of our own finite elements carries as much. The
file has fourteen digits of K; its condition number takes five.

usage: static_preload.py MICROSLIP SOURCE WORK_FOLDER
"""
import json
import os
import re
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np

from program_run import run_scene, without_plots

PROGRAM, SOURCE, WORK = sys.argv[1:4]
del sys.argv[1:]
sys.path.insert(0, os.path.join(SOURCE, "tests", "support"))
from plate_model import plate_model

SCENE = os.path.join(SOURCE, "share", "scenes", "blade_static_preload.toml")
COARSE = ["model.element_size=20 mm", "modes.count=3", "contact.points=100", "response.maps=[]", "accuracy.error_budget=off",
          "effects.second_direction=off"]
TOLD = re.compile(r"static preload contact: (\S+) N, pressure (\S+) to (\S+) Pa, (?:(\S+) % of the area open by up to (\S+) m|"
                  r"closed everywhere)")


def path(name):
    return os.path.join(WORK, name)


def check(*values, code=0):
    settings = [word for value in [*COARSE, *values] for word in ("--set", value)]
    finished = subprocess.run([PROGRAM, "check", SCENE, *settings], capture_output=True, text=True, env=without_plots())
    assert finished.returncode == code, finished.stdout + finished.stderr
    return finished.stdout if code == 0 else finished.stderr


def told_by(text):
    """Force, least and largest pressure, open percentage and largest gap."""
    found = TOLD.search(text)
    assert found, text
    return [float(word) if word else 0.0 for word in found.groups()]


class StaticPreload(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)

    def test_a_run_uses_what_check_tells(self):
        force, least, largest, open_part, gap = told_by(check())
        self.assertEqual(least, 0.0)
        run_scene(PROGRAM, SCENE, path("run"), *COARSE, f'response.preload=["static", {force}]')
        with open(os.path.join(path("run"), "summary.json"), encoding="utf-8") as stream:
            static, newtons = json.load(stream)["curves"]
        self.assertEqual((static["name"], newtons["name"]), ("preload_static", f"preload_{force:g}"))
        self.assertAlmostEqual(static["preload_N"] / force, 1.0, delta=1e-5)  # as many digits as are printed
        for goal in ("frequency_Hz", "amplitude_m"):
            self.assertAlmostEqual(static["peak"][goal] / newtons["peak"][goal], 1.0, delta=1e-4)
        with h5py.File(os.path.join(path("run"), "model.h5"), "r") as model:
            weights, preload, stiffness = (np.array(model["contact"][name]) for name in ("weights", "preload", "normal_stiffness"))
        self.assertAlmostEqual(weights @ np.maximum(preload, 0.0), 1.0, delta=1e-12)
        self.assertAlmostEqual(force * preload.max() / largest, 1.0, delta=0.01)
        self.assertAlmostEqual(100.0 * weights @ (preload <= 0.0) / weights.sum(), open_part, delta=0.06)
        self.assertAlmostEqual(force * (-preload / stiffness).max() / gap, 1.0, delta=0.01)

    def test_preload_grows_with_the_loads(self):
        still = "static.speed=0"
        full, half = (told_by(check(still, f"static.forces[0].amplitude={size}"))[0] for size in (100, 50))
        self.assertAlmostEqual(full / half, 2.0, delta=1e-5)
        self.assertLess(full, 100.0)  # the root takes the rest

    def test_loads_that_lift_the_contact_off_are_refused(self):
        message = check("static.speed=0", "static.forces[0].direction=[-1, 0, 0]", code=2)
        for words in ("contact.preload: the static loads press no contact", "m away", "static"):
            self.assertIn(words, message)


MATRICES = os.path.join(SOURCE, "share", "scenes", "plate_matrices.toml")
PLATE = os.path.join(SOURCE, "share", "scenes", "plate")
PULL, SUCTION, GAP, SPRING = 60.0, 20e6, 9e-6, 1e11
STATIC = ['contact.preload="static"', f'static.forces=[{{ at = "A", direction = [0, 1, 0], amplitude = {PULL} }}]',
          f'static.pressure=[{{ surface = "contact", value = {-SUCTION} }}]', f"contact.gap={GAP}", 'response.preload=["static"]', "response.maps=[]", "accuracy.error_budget=off",
          f"contact.normal_stiffness={SPRING}", f"contact.tangential_stiffness={SPRING}"]
CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))


def contact_of(folder):
    """Places, areas and pressures under the static loads [m, m², Pa]; not above 0: open."""
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as stream:
        (curve,) = json.load(stream)["curves"]
    with h5py.File(os.path.join(folder, "model.h5"), "r") as model:
        points, weights, preload = (np.array(model["contact"][name]) for name in ("points", "weights", "preload"))
    return points, weights, curve["preload_N"] * preload


def stiffness_of_the_file():
    """K [N/m] of the file, and of every node its place [m] and rows, -1 where it is held."""
    nodes = np.genfromtxt(os.path.join(PLATE, "nodes.csv"), delimiter=",", names=True)
    with open(os.path.join(PLATE, "stiffness.mtx"), encoding="ascii") as stream:
        lines = [line for line in stream if not line.startswith("%")]
    n = int(lines[0].split()[0])
    K = np.zeros((n, n))
    for line in lines[1:]:
        i, j, value = line.split()
        K[int(i) - 1, int(j) - 1] = K[int(j) - 1, int(i) - 1] = 1e3 * float(value)
    places = 1e-3 * np.column_stack([nodes[axis] for axis in "xyz"])
    return K, places, np.column_stack([nodes["u" + axis] for axis in "xyz"]).astype(int) - 1


def eight_node_shapes(s, t):
    """Of a face with corners at (±1, ±1) and nodes in the middle of its sides."""
    corners = [(1 + s * a) * (1 + t * b) * (s * a + t * b - 1) / 4 for a, b in CORNERS]
    sides = [(1 - s * s) * (1 - t) / 2, (1 - t * t) * (1 + s) / 2, (1 - s * s) * (1 + t) / 2, (1 - t * t) * (1 - s) / 2]
    return np.column_stack([*corners, *sides])


class OfMatrices(unittest.TestCase):
    """The contact is the end y = 120 mm of the plate, one face of eight nodes, a rectangle; its normal is y."""

    @classmethod
    def setUpClass(cls):
        os.makedirs(WORK, exist_ok=True)
        cls.K, cls.places, cls.rows = stiffness_of_the_file()
        face = np.flatnonzero(np.isclose(cls.places[:, 1], 0.12))
        assert len(face) == 8
        flat = cls.places[face][:, [0, 2]]
        cls.centre = flat.mean(axis=0)
        corners = flat[np.argsort(np.linalg.norm(flat - cls.centre, axis=1))[-4:]]
        corners = corners[np.argsort(np.arctan2(*(corners - cls.centre).T))]
        # (s, t) of a place: the centre plus s and t times half sides.
        half = np.column_stack([(corners[1] - corners[0]) / 2, (corners[3] - corners[0]) / 2])
        cls.inverse = np.linalg.inv(half)
        local = cls.local(flat)
        middles = ((0, -1), (1, 0), (0, 1), (-1, 0))
        order = [int(np.argmin(np.linalg.norm(local - place, axis=1))) for place in (*CORNERS, *middles)]
        cls.face = face[order]

    @classmethod
    def local(cls, flat):
        return (flat - cls.centre) @ cls.inverse.T

    def settled(self, name, *settings):
        """Pressures, and the approach that they leave, of a run."""
        folder = run_scene(PROGRAM, MATRICES, path(name), *STATIC, *settings)
        points, weights, rest_load = contact_of(folder)
        pressure = np.maximum(rest_load, 0.0)
        N = eight_node_shapes(*self.local(points[:, [0, 2]]).T)
        along_y = self.rows[self.face, 1]
        load = np.zeros(len(self.K))
        load[self.rows[np.argmin(np.linalg.norm(self.places - [8.07281546e-3, 0.12, 13.9581392e-3], axis=1)), 1]] = PULL
        load[along_y] += SUCTION * weights.sum() * np.array([-1 / 12] * 4 + [1 / 3] * 4)  # evenly over eight nodes
        load[along_y] -= N.T @ (weights * pressure)
        return pressure, N @ np.linalg.solve(self.K, load)[along_y] - GAP, weights

    def test_springs(self):
        pressure, approach, weights = self.settled("springs")
        print(f"springs: {weights @ pressure:.4f} N, {np.mean(pressure == 0.0):.2f} of the points open, off by "
              f"{np.abs(pressure - SPRING * np.maximum(approach, 0.0)).max() / pressure.max():.1e}")
        np.testing.assert_allclose(pressure, SPRING * np.maximum(approach, 0.0), rtol=0.0, atol=1e-7 * pressure.max())
        self.assertTrue(0.1 < np.mean(pressure == 0.0) < 0.9)

    def test_rough_surfaces(self):
        R = 3e-6
        pressure, approach, weights = self.settled("rough", f'contact.roughness={{ law = "cubic", height = {R} }}')
        x = np.maximum(approach, 0.0) / R
        expected = SPRING * R * np.where(x < 1.0, x**3 - x**4 / 2, x - 0.5)
        print(f"rough: {weights @ pressure:.4f} N, {np.mean((x > 0) & (x < 1)):.2f} of the points within the heights, off by "
              f"{np.abs(pressure - expected).max() / pressure.max():.1e}")
        np.testing.assert_allclose(pressure, expected, rtol=0.0, atol=1e-7 * pressure.max())
        self.assertGreater(np.mean((x > 0) & (x < 1)), 0.2)

    def test_our_own_elements_carry_as_much(self):
        with open(MATRICES, encoding="utf-8") as stream:
            text = stream.read()
        begin, end = text.index("[model]"), text.index("[modes]")
        own = text[:begin] + plate_model(os.path.join(PLATE, "coarse.inp")) + text[end:]
        with open(path("own.toml"), "w", encoding="utf-8") as stream:
            stream.write(own)
        found = contact_of(run_scene(PROGRAM, MATRICES, path("by_matrices"), *STATIC))[2]
        expected = contact_of(run_scene(PROGRAM, path("own.toml"), path("own"), *STATIC))[2]
        print(f"rest loads by matrices and by our own elements differ by "
              f"{np.abs(found - expected).max() / expected.max():.1e} of the largest")
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-6 * expected.max())

    def test_modes_of_a_file_are_refused(self):
        finished = subprocess.run([PROGRAM, "check", os.path.join(SOURCE, "share", "scenes", "plate_calculix.toml"),
                                   *(word for value in STATIC for word in ("--set", value))], capture_output=True, text=True)
        self.assertEqual(finished.returncode, 1, finished.stdout)
        self.assertIn("modes of a file leave most of it out", finished.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
