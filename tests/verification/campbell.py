#!/usr/bin/env python3
"""`microslip campbell` and a scene that rotates, on the plate of share/scenes/plate in three elements.

usage: campbell.py MICROSLIP SOURCE WORK_FOLDER
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
sys.path.insert(0, os.path.join(SOURCE, "tests", "support"))
from plate_model import plate_model

PLATE = os.path.join(SOURCE, "share", "scenes", "plate", "coarse.inp")
AXIS = 'axis = { origin = [0, "-200 mm", 0], direction = [0, 0, 1] }'


def scene(name, static=AXIS, clamped=("root",)):
    path = os.path.join(WORK, name + ".toml")
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(plate_model(PLATE, clamped) + f"[static]\n{static}\n[modes]\ncount = 4\n")
    return path


def run(*words, plots=False):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=120,
                          env=None if plots else without_plots())


def table(*path):
    with open(os.path.join(WORK, *path), newline="", encoding="utf-8") as stream:
        return [{key: float(value) for key, value in row.items() if key != "kind" and value} for row in csv.DictReader(stream)]


def modes(name, *settings):
    finished = run("modes", scene(name), "-o", os.path.join(WORK, name), *settings)
    assert finished.returncode == 0, finished.stderr
    return [row["frequency_Hz"] for row in table(name, "modes.csv")], finished.stdout + finished.stderr


class Campbell(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)

    def test_diagram(self):
        finished = run("campbell", scene("plate"), "--speeds", "0", "12000 rpm", "5", "--engine-orders", "4", "-o",
                       os.path.join(WORK, "plate"), plots=True)
        self.assertEqual(finished.returncode, 0, finished.stderr)
        rows = table("plate", "campbell", "frequencies.csv")
        self.assertEqual(len(rows), 5 * 4)
        first = [row["frequency_Hz"] for row in rows if row["mode"] == 1]
        self.assertEqual(first, sorted(first))
        for speed, found in ((0, rows[:4]), (12000, rows[-4:])):
            expected, _ = modes(f"modes_{speed}", "--set", f'static.speed="{speed} rpm"')
            for row, frequency in zip(found, expected):
                self.assertAlmostEqual(row["frequency_Hz"] / frequency, 1.0, delta=1e-9)
        met = table("plate", "campbell", "crossings.csv")
        self.assertGreater(len(met), 0)
        for row in met:
            self.assertAlmostEqual(row["frequency_Hz"], row["engine_order"] * row["speed_rpm"] / 60.0, places=6)
            speed = row["speed_rpm"]
            exact, _ = modes("crossing", "--set", f'static.speed="{speed} rpm"')
            self.assertAlmostEqual(exact[int(row["mode"]) - 1] / row["frequency_Hz"], 1.0, delta=1e-4)
        for name in ("campbell.png", "campbell.svg"):
            self.assertGreater(os.path.getsize(os.path.join(WORK, "plate", "campbell", name)), 5000)

    def test_a_run_says_that_it_rotates(self):
        _, text = modes("said", "--set", 'static.speed="200 Hz"')
        self.assertIn("rotating at 12000 rpm: the static displacement is at most", text)
        checked = run("check", scene("checked"), "--set", "static.speed=100")
        self.assertIn("rotation: 954.93 rpm about (0, 0, 1) through (0, -0.2, 0) m", checked.stdout)

    def test_a_speed_no_blade_stands_is_questioned(self):
        checked = run("check", scene("fast"), "--set", "static.speed=9000")
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertRegex(checked.stdout, r"static.speed: the speed of the outermost point is 2\d\d\d m/s \(0.3\d* m off the axis")
        usual = run("check", scene("usual"), "--set", 'static.speed="9000 rpm"')
        self.assertNotIn("outermost", usual.stdout)

    def refused(self, code, words, *command):
        finished = run(*command)
        self.assertEqual(finished.returncode, code, finished.stderr)
        for word in words:
            self.assertIn(word, finished.stderr)

    def test_speeds_before_one_without_equilibrium_are_kept(self):
        inward = 'axis = { origin = [0, "300 mm", 0], direction = [0, 0, 1] }'
        self.refused(2, ["the first 3 of 4 speeds are written", "lower the speed"], "campbell", scene("part", inward),
                     "--speeds", "0", "12000 rpm", "4", "-o", os.path.join(WORK, "part"))
        rows = table("part", "campbell", "frequencies.csv")
        self.assertEqual([round(row["speed_rpm"]) for row in rows if row["mode"] == 1], [0, 4000, 8000])

    def test_bad_input(self):
        no_axis = scene("no_axis", "")
        self.refused(1, ["static.axis", "is missing"], "campbell", no_axis, "--speeds", "0", "10", "3")
        self.refused(1, ["no_axis.toml", "static.axis"], "campbell", no_axis, "--speeds", "0", "10", "3")
        self.refused(1, ["static.speed", "static.axis"], "modes", scene("speed_alone", "speed = 3"))
        good = scene("good")
        self.refused(1, ["lower speed first"], "campbell", good, "--speeds", "20 rpm", "10 rpm", "3")
        self.refused(1, ["number of speeds", "2 to"], "campbell", good, "--speeds", "0", "10", "1")
        self.refused(1, ["--speeds", "furlong"], "campbell", good, "--speeds", "0", "10 furlong", "3")
        self.refused(1, ["--speeds"], "campbell", good)
        chain = os.path.join(SOURCE, "share", "scenes", "chain_2dof.toml")
        self.refused(1, ["model.kind", "chain"], "campbell", chain, "--speeds", "0", "10", "3")

    def test_physics_that_has_no_answer(self):
        self.refused(2, ["rigid-body modes", "clamp"], "modes", scene("free", AXIS + "\nspeed = 100", ()))
        inward = 'axis = { origin = [0, "300 mm", 0], direction = [0, 0, 1] }\nspeed = "40000 rpm"'
        self.refused(2, ["40000 rpm", "lower the speed"], "modes", scene("inward", inward))


if __name__ == "__main__":
    unittest.main(verbosity=2)
