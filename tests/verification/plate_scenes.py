#!/usr/bin/env python3
"""The plate of share/scenes/plate, its modes from each format of other codes, gives the curves of plate_calculix.toml.

All files hold the modes that CalculiX left in plate.frd, with its six digits of a displacement and ten of a frequency: NumPy,
a table and MED in doubles, so that curves agree to rounding (MED numbers elements in a mirror, which moves sums over the face);
Nastran's form has seven digits of a displacement, which loses nothing, and eight of an eigenvalue: 2.5e-8 of a frequency,
and of an amplitude at resonance as much. Places of the deck have ten digits.

plate_mesh.toml solves the same mesh here. In every format of its header it gives the same curves: to rounding, by the ten digits of
Nastran's places to 1e-7.

usage: plate_scenes.py MICROSLIP SOURCE WORK_FOLDER
"""
import importlib.util
import json
import os
import re
import shutil
import sys
import unittest

import numpy as np

from program_run import run_scene

PROGRAM, SOURCE, WORK = sys.argv[1:4]
del sys.argv[1:]
sys.path.insert(0, os.path.join(SOURCE, "tests", "support"))
import plate_files

SCENES = os.path.join(SOURCE, "share", "scenes")
DOUBLES = 1e-9
PUNCHED = 1e-7


def peaks(scene, *settings):
    """Frequency and amplitude of the peak of every curve, by its name."""
    folder = os.path.join(WORK, re.sub(r"[^\w=.]", "_", "-".join([scene, *settings[:1]])))
    run_scene(PROGRAM, os.path.join(SCENES, scene + ".toml"), folder, *settings, "accuracy.error_budget=off", "response.maps=[]")
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as stream:
        curves = json.load(stream)["curves"]
    return {curve["name"]: np.array([curve["peak"]["frequency_Hz"], curve["peak"]["amplitude_m"]]) for curve in curves}


class PlateScenes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)

    def compare(self, scene, expected, tolerance, *settings):
        found = peaks(scene, *settings)
        self.assertEqual(list(found), list(expected))
        worst = max(np.abs(found[name] / expected[name] - 1.0).max() for name in expected)
        print(f"{' '.join([scene, *settings])}: peaks of {', '.join(found)} differ by {worst:.1e}")
        self.assertLess(worst, tolerance)

    @staticmethod
    def commented_table():
        """As numpy.savetxt writes names: behind a #, below a line of its own."""
        place = os.path.join(os.path.abspath(WORK), "commented.csv")
        with open(os.path.join(plate_files.PLATE, "plate.csv"), encoding="ascii") as table, open(place, "w", encoding="ascii") as commented:
            commented.write("# modes of a plate\n# " + table.read())
        return place

    def test_numpy_table_and_med(self):
        expected = peaks("plate_calculix")
        self.assertEqual(len(expected), 5)
        self.compare("plate_numpy", expected, DOUBLES)
        self.compare("plate_table", expected, DOUBLES)
        self.compare("plate_table", expected, DOUBLES, f"model.file={self.commented_table()}")
        if importlib.util.find_spec("h5py") is None:
            self.skipTest("h5py is not installed: .med cannot be read")
        self.compare("plate_med", expected, DOUBLES)

    def test_nastran_punches_four_modes(self):
        expected = peaks("plate_calculix", "modes.count=4")
        self.compare("plate_nastran", expected, PUNCHED)

    def test_the_mesh_in_every_format(self):
        one = "response.preload=[20]"
        expected = peaks("plate_mesh", one)
        for ending in ("med", "vtu", "unv"):
            if ending == "med" and importlib.util.find_spec("h5py") is None:
                continue
            self.compare("plate_mesh", expected, DOUBLES, f"model.file=plate/plate.{ending}", one)
        self.compare("plate_mesh", expected, PUNCHED, "model.file=plate/plate.bdf", one, 'supports.clamped=["SPC 1"]',
                     'contact.surface="PLOAD4 1"', 'excitation.forces[0].at="SET 3"', 'response.output.at="SET 2"')

    def test_the_files_are_made_of_those_of_calculix(self):
        plate_files.write(WORK)

        def text(folder, name):
            with open(os.path.join(folder, name), encoding="ascii") as stream:
                return stream.read()

        for name in ("plate.bdf", "plate.csv", "plate.pch", "plate.unv"):
            self.assertEqual(text(WORK, name), text(plate_files.PLATE, name), name)
        with np.load(os.path.join(WORK, "plate.npz")) as made, np.load(os.path.join(plate_files.PLATE, "plate.npz")) as kept:
            self.assertEqual(made.files, kept.files)
            for name in made.files:
                self.assertTrue(np.array_equal(made[name], kept[name]), name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
