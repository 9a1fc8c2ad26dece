"""The program beside the truth of the coarse default blade, and the stored truth beside the program that prints it.

Truth (tests/verification/truth/) keeps every contact node and shares nothing with contact/ and solver/. With as many
harmonics, what is left is the error of basis, cells, fit and sampling. A few curves of three harmonics, open and
slipping, along x and y, are traced anew by both; MICROSLIP_CAMPAIGNS=whole takes more preloads and nine harmonics as well.
The truth itself is integrated in time from one of its peaks: what all its harmonics leave out.

usage: truth_compared.py MICROSLIP SOURCE_FOLDER WORK_FOLDER TRUTH_PROGRAM
"""
import csv
import json
import os
import re
import subprocess
import sys
import unittest

from program_run import run_scene, whole_campaigns

PROGRAM, SOURCE, WORK, TRUTH = sys.argv[1:5]
SCENES = {"x": "blade_to_ground.toml", "y": "blade_to_ground_y.toml"}
PRELOADS = {"x": (-500, 267, 500), "y": (2, 10)} if whole_campaigns() else {"x": (-500, 267), "y": (10,)}
AMPLITUDE, FREQUENCY = 3e-3, 2e-4  # of the program; the largest found are 1.5e-3 and 6e-5
PRINTED = 2e-5                     # digits of the stored table, and the tolerance of its curves


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return {(r["force"], float(r["preload_N"]), r["directions"], int(r["harmonics"])): r
                for r in csv.DictReader(file) if r["complete"] == "1"}


STORED = rows_of(os.path.join(SOURCE, "share", "reference", "truth_blade_10mm.csv"))
STORED_IN_TIME = rows_of(os.path.join(SOURCE, "share", "reference", "truth_time_10mm.csv"))


def program_peaks(force, harmonics):
    """{preload: (amplitude, frequency)} of curves without a search for the best preload."""
    with open(os.path.join(SOURCE, "share", "scenes", SCENES[force]), encoding="utf-8") as file:
        text = re.sub(r"^optimum.*\n", "", file.read(), flags=re.M)
    scene = os.path.join(WORK, SCENES[force])
    with open(scene, "w", encoding="utf-8") as file:
        file.write(text)
    folder = run_scene(PROGRAM, scene, os.path.join(WORK, f"run_{force}_{harmonics}"), "model.element_size=10 mm",
                       f"response.harmonics={harmonics}", "response.maps=[]", "effects.second_direction=off",
                       "accuracy.error_budget=off", f"response.preload={list(PRELOADS[force])}")
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        curves = json.load(file)["curves"]
    return {curve["preload_N"]: (1e6 * curve["peak"]["amplitude_m"], curve["peak"]["frequency_Hz"]) for curve in curves}


def truth_peaks(force, harmonics):
    table = os.path.join(WORK, f"truth_{force}_{harmonics}.csv")
    subprocess.run([TRUTH, "--force", force, "--harmonics", str(harmonics), "--directions", "p", "--csv", table,
                    "--preloads", ",".join(str(preload) for preload in PRELOADS[force])],
                   check=True, stdout=subprocess.DEVNULL, timeout=3600)
    return {key[1]: (float(row["peak_um"]), float(row["peak_Hz"])) for key, row in rows_of(table).items()}


class Truth(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.makedirs(WORK, exist_ok=True)

    def test_the_program_is_right_with_the_harmonics_of_the_truth(self):
        for force in ("x", "y"):
            for harmonics in (3, 9) if whole_campaigns() else (3,):
                found, truth = program_peaks(force, harmonics), truth_peaks(force, harmonics)
                for preload in PRELOADS[force]:
                    with self.subTest(force=force, preload=preload, harmonics=harmonics):
                        self.compare(found[preload], truth[preload], (force, float(preload), "p", harmonics))

    def compare(self, found, truth, key):
        errors = [a / b - 1.0 for a, b in zip(found, truth)]
        print(f"force along {key[0]}, {key[1]:g} N, {key[3]} harmonics: truth {truth[0]:.2f} um at {truth[1]:.3f} Hz; "
              f"program {100 * errors[0]:+.3f} %, {100 * errors[1]:+.4f} %", flush=True)
        self.assertLess(abs(errors[0]), AMPLITUDE)
        self.assertLess(abs(errors[1]), FREQUENCY)
        stored = STORED[key]
        self.assertAlmostEqual(truth[0] / float(stored["peak_um"]), 1, delta=PRINTED)
        self.assertAlmostEqual(truth[1] / float(stored["peak_Hz"]), 1, delta=PRINTED)

    @unittest.skipUnless(whole_campaigns(), "a minute; a face of one node: verification.truth_in_time")
    def test_the_truth_integrated_in_time_is_that_of_many_harmonics(self):
        table = os.path.join(WORK, "truth_in_time.csv")
        subprocess.run([TRUTH, "--preloads", "500", "--harmonics", "7", "--instants", "256", "--steps", "512", "--from", "300",
                        "--to", "333", "--periods", "200", "--csv", table], check=True, stdout=subprocess.DEVNULL, timeout=600)
        row = rows_of(table)["x", 500.0, "p", 7]
        stored = STORED_IN_TIME["x", 500.0, "p", 9]
        seven, in_time = float(row["peak_um"]), float(row["time_um"])
        many = STORED["x", 500.0, "p", 21]
        print(f"500 N: balance with 7 harmonics {seven:.2f} um, from there in time {in_time:.2f} um; stored: with 21 "
              f"{many['peak_um']} um, in time from 9 {stored['time_um']} um", flush=True)
        self.assertAlmostEqual(in_time / float(stored["time_um"]), 1, delta=5e-4)
        self.assertAlmostEqual(float(many["peak_um"]) / float(stored["time_um"]), 1, delta=1e-3)
        self.assertGreater(abs(seven / in_time - 1), 3e-3)  # harmonics are missed, and time tells


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
