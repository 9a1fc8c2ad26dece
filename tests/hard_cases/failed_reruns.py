#!/usr/bin/env python3
"""A run that fails in the folder of an earlier run.

Hard: the results there are worth keeping, and a script reads exit_code in summary.json for the outcome of the run it
started. Right: the earlier results stay to the byte, summary.json has the exit code and the message of the run that failed,
and those of the earlier run under "earlier"; the next run that ends well takes its place.

usage: failed_reruns.py MICROSLIP WORK_FOLDER
"""
import json
import os
import resource
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "verification"))
from program_run import without_plots

PROGRAM, WORK = sys.argv[1:3]
SCENE = """
[model]
kind = "blade"
element_size = "25 mm"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["root"]
[modes]
count = 4
damping_ratio = 0.005
residual = "none"
[contact]
surface = "contact"
slip_direction = [0, 1, 0]
friction_coefficient = 0.4
normal_stiffness = "1e11 N/m^3"
tangential_stiffness = "1e11 N/m^3"
points = 20
[excitation]
forces = [ { at = "B", direction = [1, 0, 0], amplitude = "0.5 N" } ]
[response]
output = { at = "A", direction = [1, 0, 0] }
frequency = ["290 Hz", "350 Hz"]
harmonics = 1
preload = ["stuck"]
maps = []
[effects]
second_direction = "off"
"""


def settings(*changes):
    return [word for change in changes for word in ("--set", change)]


class FailedReruns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)
        with open(cls.path("scene.toml"), "w", encoding="utf-8") as stream:
            stream.write(SCENE)
        cls("run_it").run_it(0)
        os.rename(cls.path("run"), cls.path("earlier"))

    def setUp(self):
        shutil.rmtree(self.path("run"), ignore_errors=True)
        shutil.copytree(self.path("earlier"), self.path("run"))
        self.results = self.files()

    @staticmethod
    def path(*names):
        return os.path.join(WORK, *names)

    def run_it(self, code, *options, largest_file=resource.RLIM_INFINITY):
        finished = subprocess.run([PROGRAM, "run", "scene.toml", "-o", "run", "--without", "plots", "-q", *options], cwd=WORK,
                                  capture_output=True, text=True, env=without_plots(),
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file, largest_file)))
        self.assertEqual(finished.returncode, code, finished.stderr)
        return finished.stderr

    def files(self):
        """Of results, with their bytes."""
        found = {}
        for folder, _, names in os.walk(self.path("run")):
            for name in names:
                if name in ("summary.json", "log.txt", "files.txt"):
                    continue
                with open(os.path.join(folder, name), "rb") as stream:
                    found[os.path.relpath(os.path.join(folder, name), self.path("run"))] = stream.read()
        return found

    def summary(self):
        with open(self.path("run", "summary.json"), encoding="utf-8") as stream:
            return json.load(stream)

    def assert_failed(self, code, word):
        summary = self.summary()
        self.assertEqual(summary["exit_code"], code)
        self.assertIn(word, summary["message"])
        self.assertIn("what stands here is of an earlier run, which ended with exit code 0", summary["message"])
        self.assertEqual(summary["earlier"], {"exit_code": 0, "message": ""})
        self.assertEqual(len(summary["curves"]), 1)
        self.assertEqual(self.files(), self.results)

    def test_no_room_to_say_that_it_failed(self):
        """A limit of file size, below the size of summary.json."""
        for changes in ([], ['supports.clamped=["rot"]'], ["response.frequenzy=3"]):
            with self.subTest(changes):
                self.run_it(4, *settings(*changes), largest_file=4096)
                self.assert_failed(4, "no room")
                self.assertEqual(os.listdir(self.path("run", "checkpoint")), ["files.txt"])
        self.run_it(1, *settings('supports.clamped=["rot"]'))
        self.assert_failed(1, '"rot"')
        self.run_it(0)
        self.assertNotIn("earlier", self.summary())

    def test_no_room_for_a_result(self):
        """The user is told of the place that it is for, not of that where it was staged and is gone."""
        sizes = [os.path.getsize(self.path("run", name)) for name in ("modes.vtu", "model.h5")]
        for size in sizes:
            error = self.run_it(4, largest_file=size - 1)
            self.assertNotIn("staged", error)
            self.assertNotIn("staged", self.summary()["message"])
            self.assertRegex(error, r"microslip: run/[\w.]+: cannot be written: ")

    def test_a_name_that_the_mesh_does_not_have(self):
        self.run_it(1, *settings('supports.clamped=["rot"]'))
        self.assert_failed(1, 'nothing is named "rot"')

    def test_a_scene_that_cannot_be_read(self):
        self.run_it(1, *settings("response.frequenzy=3"))
        self.assert_failed(1, "frequenzy")

    def test_a_scene_without_a_response(self):
        self.run_it(1, *settings("response.output=", "response.frequency="))
        self.assert_failed(1, "response")

    def test_two_failures_one_after_the_other(self):
        self.run_it(1, *settings('supports.clamped=["rot"]'))
        self.run_it(1, *settings('supports.clamped=["rut"]'))
        self.assert_failed(1, '"rut"')

    def test_the_earlier_run_has_nothing_to_resume(self):
        self.run_it(1, *settings('supports.clamped=["rot"]'))
        self.assertIn("nothing to resume", self.run_it(0, "--resume"))

    def test_a_run_that_ends_well_tells_of_itself_alone(self):
        self.run_it(1, *settings('supports.clamped=["rot"]'))
        self.run_it(0)
        summary = self.summary()
        self.assertEqual((summary["exit_code"], summary["message"]), (0, ""))
        self.assertNotIn("earlier", summary)

    def test_a_check_is_no_run(self):
        self.run_it(1, "--dry-run", *settings('supports.clamped=["rot"]'))
        self.assertEqual(self.summary()["exit_code"], 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
