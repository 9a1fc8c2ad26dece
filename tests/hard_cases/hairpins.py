#!/usr/bin/env python3
"""Contacts a million times stiffer than the modes, next to no damping: hairpins of the branch within 1e-4 Hz, and a kink at which
both frequency and amplitude turn.

Hard: a fold may be lost between two points, or behind a peak at the same place.
From: three modes, two points, damping 8e-6, tangential stiffness 1e10 (hard case 69).
Right: complete from end to end; a branch that does so turns back as often as it turns forth, so that the number of its folds is
even; there are as many folds as turns, within two rows of each.

usage: hairpins.py MICROSLIP WORK_FOLDER
"""
import csv
import json
import os
import shutil
import subprocess
import sys

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
    folds = [i for i, row in enumerate(rows) if row["mark"] == "fold"]
    places = turns([float(row["frequency_Hz"]) for row in rows])
    print(f"{len(rows)} points, {len(folds)} folds, {len(places)} turns")
    assert curve["complete"], curve["message"]
    assert len(places) >= 8 and len(folds) == len(places), (folds, places)
    assert len(folds) % 2 == 0, folds
    for row, _ in places:
        assert any(abs(fold - row) <= 2 for fold in folds), (row, folds)


if __name__ == "__main__":
    main(*sys.argv[1:3])
