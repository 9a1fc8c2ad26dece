#!/usr/bin/env python3
"""Mesh and modes of a blade are solved once for all runs that have the same, and make no difference to them.

usage: shared_modes.py MICROSLIP SOURCE WORK_FOLDER
"""
import os
import shutil
import subprocess
import sys
import unittest

from program_run import without_plots

PROGRAM, SOURCE, WORK = sys.argv[1:4]
del sys.argv[1:]
sys.path.insert(0, os.path.join(SOURCE, "share", "python"))
sys.dont_write_bytecode = True

import microslip
from microslip.program import settings_of

BLADE = os.path.join(SOURCE, "share", "scenes", "blade_to_ground.toml")
COARSE = {"model.element_size": "12 mm", "response.harmonics": 1, "response.optimum": None, "response.optimum_range": None,
          "response.preload": [1000], "response.maps": [], "accuracy.error_budget": "off"}
TAKEN = ("mesh: taken from an earlier run", "modes: taken from an earlier run")


def read(*path):
    with open(os.path.join(WORK, *path), "rb") as file:
        return file.read()


def run(name, *options, command="run", cache="cache", **changes):
    """The log of a run of the blade."""
    words = [PROGRAM, command, BLADE, "-q", "-o", os.path.join(WORK, name), *options, *settings_of({**COARSE, **changes})]
    words += ["--without", "plots"] if command == "run" else []
    environment = {**without_plots(), "MICROSLIP_CACHE": os.path.join(WORK, cache)}
    subprocess.run(words, env=environment, check=True, capture_output=True, timeout=300)
    return read(name, "log.txt").decode()


class SharedModes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)
        cls.first = run("first")

    def kept(self):
        return [name for name in os.listdir(os.path.join(WORK, "cache")) if name.endswith(".cached")]

    def test_another_preload_takes_them_and_changes_no_bit(self):
        again = run("again", **{"response.preload": [2000]})
        for sentence in TAKEN:
            self.assertNotIn(sentence, self.first)
            self.assertIn(sentence, again)
        refused = run("refused", "--no-cache", **{"response.preload": [2000]})
        self.assertNotIn("earlier run", refused)
        for name in ("modes.csv", "model.h5", "curves/preload_2000.csv", "curves/preload_2000.states.csv"):
            self.assertEqual(read("again", name), read("refused", name), name)
        self.assertEqual(len(self.kept()), 2, "a mesh and its modes")

    def test_what_is_damaged_is_made_again(self):
        for name in self.kept():
            os.truncate(os.path.join(WORK, "cache", name), 1000)
        log = run("mended", command="modes")
        self.assertEqual(log.count("damaged; it is made again"), 2)
        self.assertEqual(read("mended", "model.h5"), read("first", "model.h5"))
        self.assertIn(TAKEN[1], run("mended", command="modes"))

    def test_no_folder_is_no_obstacle(self):
        open(os.path.join(WORK, "file"), "w").close()
        self.assertIn("nothing is taken from earlier runs", run("without", command="modes", cache="file"))

    def test_a_sweep_solves_them_once(self):
        os.environ["MICROSLIP_CACHE"] = os.path.join(WORK, "sweep_cache")
        sweep = microslip.sweep(BLADE, {"contact.friction_coefficient": [0.2, 0.4]}, overrides=COARSE, jobs=2,
                                folder=os.path.join(WORK, "sweep"), progress=False, program=PROGRAM)
        self.assertEqual(sweep.failed, [])
        logs = [read("sweep", f"run_{i:03d}", "log.txt").decode() for i in range(2)]
        for sentence in TAKEN:
            self.assertEqual(sum(sentence in log for log in logs), 1, sentence)
        self.assertNotEqual(*sweep.peaks["amplitude_m"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
