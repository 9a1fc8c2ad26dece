#!/usr/bin/env python3
"""Contacts a million times stiffer than the modes, next to no damping: hairpins of the branch within 0.03 Hz, a kink at which
both frequency and amplitude turn, and one at which the amplitude alone does, by nearly 180 degrees.

Hard: a fold may be lost between two points, or behind a peak at the same place; from a kink the part that was walked is as near
as the part ahead, and a row on it looks like two more folds.
From: three modes, two points, damping 8e-6, tangential stiffness 1e10 (hard case 69).
Right: complete from end to end; a branch that does so turns back as often as it turns forth, so that the number of its folds is
even; there are as many folds as turns, within two rows of each, and no row lies on a part walked before or after.

usage: hairpins.py MICROSLIP WORK_FOLDER
"""
import csv
import json
import os
import shutil
import subprocess
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "verification"))
from program_run import without_plots

SCENE = """[model]
kind = "modal"
[modal]
frequency = [100.0, 197.2395115883597, 514.2512302728612]
damping_ratio = 8e-6
force_sine = [-0.12673685659697287, -0.5071065871166878, -0.23921109178055522]
output = [1.0, 1.0, 1.0]
[[modal.points]]
weight = 1.0
tangential_stiffness = 1e10
normal_stiffness = 1e6
friction_coefficient = 0.3
preload = 12.404770536148337
phi_u_1 = -0.25013652378796336
phi_u_2 = 0.2160727927839059
phi_u_3 = -0.6598174185959966
phi_v_1 = -0.31086587416068134
phi_v_2 = -0.4660733683391636
phi_v_3 = -0.34104270306109696
[[modal.points]]
weight = 1.0
tangential_stiffness = 1e10
normal_stiffness = 1e10
friction_coefficient = 0.3
preload = 0.8386405956830569
phi_u_1 = 0.9808093452869635
phi_u_2 = 0.5277588901347132
phi_u_3 = -0.1985206272707427
phi_v_1 = 0.8671007396697654
phi_v_2 = -0.8312612097256011
phi_v_3 = -0.02298246114210145
[response]
frequency = [80.0, 668.5265993547196]
harmonics = 1
[accuracy]
error_budget = "off"
"""
RESOLUTION = 1e-8  # of the frequency: below it the walk along a kink goes to and fro by rounding


def turns(frequency):
    """Rows at which the frequency turns, and which way."""
    places, way = [], 0
    for i in range(1, len(frequency)):
        step = frequency[i] - frequency[i - 1]
        if abs(step) <= RESOLUTION * frequency[i]:
            continue
        now = 1 if step > 0.0 else -1
        if way and now != way:
            places.append((i - 1, way))
        way = now
    return places


def on_another_part(states):
    """Rows whose motion is that of a part two rows away or more, between two of its rows, at the same frequency: closer than a
    hundredth of the way along the branch to there."""
    frequency, q = states[:, 0], states[:, 1:]
    found = []
    for i, here in enumerate(frequency):
        for j in range(len(frequency) - 1):
            if i - 2 <= j <= i + 1 or (frequency[j] - here) * (frequency[j + 1] - here) >= 0.0:
                continue
            share = (here - frequency[j]) / (frequency[j + 1] - frequency[j])
            apart = np.linalg.norm(q[j] + share * (q[j + 1] - q[j]) - q[i])
            way = np.linalg.norm(q[min(i, j):max(i, j) + 2] - q[i], axis=1).max()
            if apart < 0.01 * way:
                found.append((i, j))
    return found


def main(program, folder):
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    path, run = os.path.join(folder, "scene.toml"), os.path.join(folder, "run")
    with open(path, "w", encoding="utf-8") as file:
        file.write(SCENE)
    subprocess.run([program, "run", path, "-q", "-j", "1", "-o", run, "--without", "plots"], timeout=100, env=without_plots(), check=True)
    with open(os.path.join(run, "summary.json"), encoding="utf-8") as file:
        curve, = json.load(file)["curves"]
    with open(os.path.join(run, "curves", "scale_1.csv"), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    states = np.loadtxt(os.path.join(run, "curves", "scale_1.states.csv"), delimiter=",", skiprows=1)
    folds = [i for i, row in enumerate(rows) if row["mark"] == "fold"]
    places = turns([float(row["frequency_Hz"]) for row in rows])
    print(f"{len(rows)} points, {len(folds)} folds, {len(places)} turns")
    assert curve["complete"], curve["message"]
    assert not on_another_part(states), on_another_part(states)
    assert len(places) >= 6 and len(folds) == len(places), (folds, places)
    assert len(folds) % 2 == 0, folds
    for row, _ in places:
        assert any(abs(fold - row) <= 2 for fold in folds), (row, folds)


if __name__ == "__main__":
    main(*sys.argv[1:3])
