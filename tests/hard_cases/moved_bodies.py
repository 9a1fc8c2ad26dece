#!/usr/bin/env python3
"""A meshed scene turned, moved, of another size or in other units (cases 36, M1, M2).

Hard: a tolerance that is a length, a stiffness or a frequency, somewhere between file and curve, is right for a blade in
metres and wrong for a part of micrometres, or for a body a kilometre away from the origin.
Right: frequencies and peaks of the plate of share/scenes/plate turn, move and scale with it. Of a body s times as large of
the same material, under pressures that are the same, frequencies are 1/s times as high and amplitudes s times as large.

usage: moved_bodies.py MICROSLIP SOURCE WORK_FOLDER
"""
import json
import os
import shutil
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "verification"))
import numpy as np
from program_run import run_scene

PROGRAM, SOURCE, WORK = sys.argv[1:4]
del sys.argv[1:]
# The eigensolver leaves residuals of some 1e-10, the curve is solved to 1e-11; a resonance of damping ratio 0.002 turns an
# error of its frequency into one of 250 times that in the amplitude at a frequency, not in that of the peak.
TOLERANCE = 1e-8
# Where every number is multiplied by a power of two, and masses by one of four, all operations and roots round alike.
EXACT = 1e-12
SCENE = """
[model]
kind = "mesh"
file = "plate.inp"
length_unit = {unit!r}
[material]
youngs_modulus = 2.1e11
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["root"]
[modes]
count = 4
damping_ratio = 0.002
[contact]
surface = "contact"
slip_direction = {slip}
friction_coefficient = 0.4
normal_stiffness = {stiffness}
tangential_stiffness = {stiffness}
points = 20
[excitation]
forces = [ {{ at = "B", direction = {force}, amplitude = {amplitude} }} ]
[response]
output = {{ at = "A", direction = {force} }}
frequency = [{low}, {high}]
harmonics = 1
preload = [{preload}]
[effects]
second_direction = "off"
[accuracy]
error_budget = "off"
"""


def plate():
    """Lines of the file, and the coordinates that stand in some of them."""
    with open(os.path.join(SOURCE, "share", "scenes", "plate", "plate.inp"), encoding="utf-8") as file:
        lines = file.read().splitlines()
    begin = next(i for i, line in enumerate(lines) if line.startswith("*NODE")) + 1
    end = next(i for i in range(begin, len(lines)) if lines[i].startswith("*"))
    return lines, range(begin, end), np.array([[float(word) for word in line.split(",")[1:]] for line in lines[begin:end]])


def result_of(name, coordinates=lambda x: x, turn=np.eye(3), size=1.0, unit="mm"):
    """Frequencies of the modes, then frequency and amplitude of the peak, of a plate `size` times as large as that of the
    file; all in those of that plate."""
    lines, places, x = plate()
    for place, row in zip(places, coordinates(x)):
        lines[place] = ", ".join([lines[place].split(",")[0], *(repr(float(value)) for value in row)])
    folder = os.path.join(WORK, name)
    os.makedirs(folder)
    with open(os.path.join(folder, "plate.inp"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    text = SCENE.format(unit=unit, slip=list(map(float, turn @ [0.921, 0.0, -0.389])), force=list(map(float, turn @ [1.0, 0.0, 0.0])),
                        stiffness=1e9 / size, amplitude=2.0 * size**2, preload=20.0 * size**2, low=200.0 / size, high=500.0 / size)
    with open(os.path.join(folder, "scene.toml"), "w", encoding="utf-8") as file:
        file.write(text.replace("'", '"'))
    run_scene(PROGRAM, os.path.join(folder, "scene.toml"), os.path.join(folder, "run"))
    with open(os.path.join(folder, "run", "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    peak = summary["curves"][0]["peak"]
    return np.array([size * mode["frequency_Hz"] for mode in summary["modes"]]
                    + [size * peak["frequency_Hz"], peak["amplitude_m"] / size])


def rotation(axis, angle):
    x, y, z = np.asarray(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


class MovedBodies(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        cls.reference = result_of("reference")

    def compare(self, name, tolerance=TOLERANCE, **changes):
        found = result_of(name, **changes)
        worst = np.abs(found / self.reference - 1.0).max()
        print(f"{name}: frequencies and peak differ by {worst:.1e}")
        self.assertLess(worst, tolerance)

    def test_turned(self):
        turn = rotation((1, 2, -0.5), 1.1)
        self.compare("turned", coordinates=lambda x: x @ turn.T, turn=turn)

    def test_a_kilometre_away(self):  # 1e6 mm: coordinates keep ten digits of a millimetre
        self.compare("away", tolerance=1e-6, coordinates=lambda x: x + [1e6, -2e6, 5e5])

    def test_in_metres(self):
        self.compare("metres", coordinates=lambda x: 1e-3 * x, unit="m")

    def test_of_a_micrometre(self):
        size = 2.0**-16
        self.compare("small", tolerance=EXACT, size=size, coordinates=lambda x: x * size)

    def test_of_a_kilometre(self):
        size = 2.0**14
        self.compare("large", tolerance=EXACT, size=size, coordinates=lambda x: x * size)


if __name__ == "__main__":
    unittest.main()
