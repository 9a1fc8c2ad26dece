#!/usr/bin/env python3
"""The preload of static loads from the scene to the files: what `check` prints is what a run uses.

share/scenes/blade_static_preload.toml with large elements. Its contact carries, in model.h5, the force that is told and is
open where it is told; the curve "static" is the curve of that many newtons, to rounding; half the loads are half the preload
where the rotor stands still. A scene whose loads lift the contact off is refused with exit code 2.

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


if __name__ == "__main__":
    unittest.main(verbosity=2)
