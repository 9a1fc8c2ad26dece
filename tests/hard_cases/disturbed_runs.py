#!/usr/bin/env python3
"""Runs whose machine is taken from under them (cases 34, 59, 60, 76).

Hard: the folder is deleted while a run writes there; a laptop sleeps; a run is killed while its plots are drawn, after all
results are there; damping of 50 % leaves no resonance to speak of. Right: a deleted folder is a named stop with exit code 4; a
run that slept has the bytes of one that did not; a summary says 0 of a run that ended alone, and --resume ends it; strong
damping is a curve like any other. From: the list of hard cases of this project.

usage: disturbed_runs.py MICROSLIP WORK_FOLDER
"""
import glob
import json
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest

PROGRAM, WORK = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
SCENE = """
title = "disturbed"
[model]
kind = "modal"
[modal]
frequency = [15.9, 41.4]
damping_ratio = {damping}
force_sine = [0.0, 0.3]
output = [0.9, 0.35]
points = [ {{ weight = 1, tangential_stiffness = 1e4, normal_stiffness = 1e4, friction_coefficient = 0.3, preload = 2, \
phi_u_1 = 0.8, phi_u_2 = -0.5, phi_v_1 = 0.1 }} ]
[response]
frequency = [15, 25]
harmonics = 15
preload_scale = [0.8, 0.9, 1, 1.1, 1.2, 1.3, 1.4, 1.5]
"""
PATIENCE = 240.0  # [s]


def is_drawing(process):
    """Python has begun to draw plots for it."""
    for stat in glob.glob("/proc/[0-9]*/stat"):
        try:
            with open(stat, encoding="utf-8") as stream:
                name, _, rest = stream.read().partition("(")[2].rpartition(")")
        except OSError:
            continue
        if name.startswith("python") and int(rest.split()[1]) == process.pid:
            return True
    return False


class DisturbedRuns(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)
        cls.write("scene", damping="0.01")
        begin = time.monotonic()
        cls.complete("scene", "undisturbed", "--without", "plots")
        cls.duration = time.monotonic() - begin

    @staticmethod
    def path(*names):
        return os.path.join(WORK, *names)

    @classmethod
    def write(cls, name, damping):
        with open(cls.path(name + ".toml"), "w", encoding="utf-8") as stream:
            stream.write(SCENE.format(damping=damping))

    @classmethod
    def command(cls, scene, folder, *options):
        return [PROGRAM, "run", cls.path(scene + ".toml"), "-o", cls.path(folder), "-q", "-j", "1", "--no-cache", *options]

    @classmethod
    def start(cls, scene, folder, *options):
        return subprocess.Popen(cls.command(scene, folder, *options), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    @classmethod
    def complete(cls, scene, folder, *options):
        finished = subprocess.run(cls.command(scene, folder, *options), capture_output=True, text=True, timeout=PATIENCE)
        if finished.returncode != 0:
            raise AssertionError(f"{scene} in {folder} ended with {finished.returncode}: {finished.stderr}")

    def wait_until(self, process, is_so):
        end = time.monotonic() + PATIENCE
        while not is_so():
            self.assertIsNone(process.poll(), "it ended before it was disturbed")
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)

    def curves(self, folder):
        found = {}
        for path in glob.glob(self.path(folder, "curves", "*.csv")):
            with open(path, "rb") as stream:
                found[os.path.basename(path)] = stream.read()
        self.assertTrue(found)
        return found

    def said(self, folder):
        with open(self.path(folder, "summary.json"), encoding="utf-8") as stream:
            return json.load(stream)

    def test_a_folder_that_is_deleted(self):
        process = self.start("scene", "deleted", "--without", "plots")
        self.wait_until(process, lambda: os.path.exists(self.path("deleted", "summary.json")))
        shutil.rmtree(self.path("deleted"), ignore_errors=True)
        _, error = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 4, error)
        self.assertIn("deleted", error)
        self.assertLessEqual(len(error.splitlines()), 4, error)

    def test_sleep(self):
        process = self.start("scene", "asleep", "--without", "plots")
        self.wait_until(process, lambda: os.path.exists(self.path("asleep", "summary.json")))
        for _ in range(3):
            time.sleep(0.1 * self.duration)
            process.send_signal(signal.SIGSTOP)
            time.sleep(0.5)
            process.send_signal(signal.SIGCONT)
        _, error = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 0, error)
        self.assertEqual(self.curves("asleep"), self.curves("undisturbed"))

    def test_killed_while_plots_are_drawn(self):
        process = self.start("scene", "killed")
        self.wait_until(process, lambda: is_drawing(process))
        process.kill()
        process.communicate(timeout=PATIENCE)
        self.assertNotEqual(self.said("killed")["exit_code"], 0)
        self.complete("scene", "killed", "--resume")
        self.assertEqual(self.said("killed")["exit_code"], 0)
        self.assertEqual(self.curves("killed"), self.curves("undisturbed"))
        self.assertTrue(os.path.exists(self.path("killed", "plots", "curves.png")))

    def test_damping_of_half_and_more(self):
        for damping in ("0.5", "1.0", "2.0"):
            self.write("damped", damping)
            self.complete("damped", "damped", "--without", "plots")
            for curve in self.said("damped")["curves"]:
                self.assertTrue(curve["complete"], f"{damping}: {curve['message']}")
                self.assertLess(curve["largest_energy_imbalance"], 1e-6, damping)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
