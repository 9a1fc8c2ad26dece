#!/usr/bin/env python3
"""`microslip converge` on a coarse blade: every ladder is there, told errors are those that the ladder shows.

Errors of 0.5 % and more of harmonics, cells and fit agree with what the budget tells within a factor of two; the finest
value has no true error; cells converge; times grow up the ladder of harmonics.

usage: converge.py MICROSLIP SOURCE WORK_FOLDER
"""
import csv
import os
import shutil
import subprocess
import sys
import unittest

from program_run import without_plots

PROGRAM, SOURCE, WORK = sys.argv[1:4]
del sys.argv[1:]
SCENE = os.path.join(SOURCE, "share", "scenes", "blade_to_ground.toml")
LEAN = ("model.element_size=10 mm", "response.preload=[500]", "response.frequency=[326, 336]", "contact.points=8",
        "modes.count=3", "response.harmonics=1")
KNOBS = ("element_size", "modes", "attachment_degree", "cells", "fit", "second_direction", "harmonics")
HEADER = "value,seconds,cpu_seconds,peak_amplitude_m,peak_frequency_Hz,true_error,estimated_error,order,curve,runs,at"


def converge(scene, folder, *settings, repeat="0"):
    command = [PROGRAM, "converge", scene, "--repeat", repeat, "-o", folder]
    for setting in settings:
        command += ["--set", setting]
    return subprocess.run(command, capture_output=True, text=True, timeout=600, env=without_plots())


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

    def test_scenes_without_a_mesh_have_the_ladder_of_harmonics(self):
        folder = os.path.join(WORK, "chain")
        finished = converge(os.path.join(SOURCE, "share", "scenes", "chain_2dof.toml"), folder, "response.preload=[50]",
                            repeat="600")
        self.assertEqual(finished.returncode, 0, finished.stderr)
        self.assertEqual(os.listdir(os.path.join(folder, "converge")), ["harmonics.csv"])
        with self.subTest("times are the median of three runs, while there are seconds to spend"):
            self.assertIn("median of 3", finished.stdout)
            self.assertEqual({row["runs"] for row in table(folder, "harmonics")}, {"3"})

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
