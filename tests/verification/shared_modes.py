#!/usr/bin/env python3
"""Mesh, modes, curves, their errors and best values are solved once for all runs that have the same, and make no difference
to them.

usage: shared_modes.py MICROSLIP SOURCE WORK_FOLDER
"""
import json
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


def run(name, *options, command="run", cache="cache", plots=False, **changes):
    """The log of a run of the blade."""
    words = [PROGRAM, command, BLADE, "-q", "-o", os.path.join(WORK, name), *options, *settings_of({**COARSE, **changes})]
    words += ["--without", "plots"] if command == "run" and not plots else []
    environment = {**(os.environ if plots else without_plots()), "MICROSLIP_CACHE": os.path.join(WORK, cache)}
    subprocess.run(words, env=environment, check=True, capture_output=True, timeout=300)
    return read(name, "log.txt").decode()


def points_scene(name, stiffness, residual):
    """A scene whose points share a load; in series with the residual flexibility their stiffness is 1e4."""
    folder = os.path.join(WORK, name)
    os.makedirs(folder, exist_ok=True)
    rows = [f"0.01,{stiffness},{stiffness},0.3,{2 + i / 100},{residual},{residual},{residual},0.8,0.1" for i in range(100)]
    with open(os.path.join(folder, "points.csv"), "w", encoding="ascii") as file:
        file.write("weight,tangential_stiffness,normal_stiffness,friction_coefficient,preload,"
                   "residual_p,residual_q,residual_r,phi_u_1,phi_v_1\n")
        file.write("\n".join(rows) + "\n")
    scene = os.path.join(folder, "scene.toml")
    with open(scene, "w", encoding="ascii") as file:
        file.write("""[model]
kind = "modal"
[modal]
frequency = [15.9]
damping_ratio = 0.01
force_sine = [1.0]
output = [0.9]
points = "points.csv"
[response]
frequency = ["12 Hz", "22 Hz"]
harmonics = 1
optimum = "preload"
optimum_range = [0.2, 20]
""")
    return scene


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
        self.assertEqual(len([name for name in self.kept() if name.startswith(("mesh", "modes"))]), 2, "a mesh and its modes")

    def test_what_is_damaged_is_made_again(self):
        for name in self.kept():
            if not name.startswith(("mesh", "modes")):
                continue
            os.truncate(os.path.join(WORK, "cache", name), 1000)
        log = run("mended", command="modes")
        self.assertEqual(log.count("damaged; it is made again"), 2)
        self.assertEqual(read("mended", "model.h5"), read("first", "model.h5"))
        self.assertIn(TAKEN[1], run("mended", command="modes"))

    def test_another_preload_is_solved_alone(self):
        study = {"response.harmonics": 3, "response.frequency": ["310 Hz", "335 Hz"],
                 "response.optimum": "preload", "response.optimum_range": [150, 600],
                 "accuracy.error_budget": "auto", "contact.points": 24}

        def taken(name, preloads, *options, **changes):
            log = run(name, "--without", "bracket", *options, cache="study_cache", **{**study, "response.preload": preloads, **changes})
            return {word for word in ("preload_150", "preload_300", "preload_600", "errors_preload_150", "errors_preload_300",
                                      "errors_preload_600", "best_value") if f" {word}: taken from an earlier run" in log}

        first = {"preload_150", "preload_300", "errors_preload_150", "errors_preload_300", "best_value"}
        self.assertEqual(taken("study", [150, 300]), set())
        self.assertEqual(taken("study_again", [300, 600, 150]), first)
        self.assertEqual(taken("study_refused", [150, 300, 600], "--no-cache"), set())
        for curve in ("preload_150", "preload_300", "preload_600"):
            for name in (f"curves/{curve}.csv", f"curves/{curve}.states.csv"):
                self.assertEqual(read("study_again", name), read("study_refused", name), name)
        best, refused = (json.loads(read(name, "summary.json"))["optimum"] for name in ("study_again", "study_refused"))
        for key in ("value", "amplitude_m", "frequency_Hz", "message", "trace"):
            self.assertEqual(best[key], refused[key], key)
        # What a curve follows from makes it another; what is asked for beside it does not.
        self.assertLessEqual({"preload_150", "best_value"}, taken("title", [150], title="another", **{"response.maps": ["peak"]}))
        self.assertLessEqual({"preload_150", "best_value"}, taken("no_maps", [150], **{"response.maps": ["peak"], "effects.maps": "off", "effects.wear": "off"}))
        # Motion at the peaks is drawn beside maps.
        self.assertTrue(os.path.isdir(os.path.join(WORK, "title", "motion")))
        self.assertFalse(os.path.exists(os.path.join(WORK, "no_maps", "motion")))
        self.assertEqual(taken("range", [150], **{"response.optimum_range": [200, 600], "accuracy.error_budget": "off"}), {"preload_150"})
        for key, value in (("contact.friction_coefficient", 0.41), ("response.harmonics", 2), ("contact.points", 30),
                           ("response.frequency", ["310 Hz", "336 Hz"]), ("effects.normal_motion", "off")):
            self.assertEqual(taken("other", [150], **{key: value, "response.optimum": None, "response.optimum_range": None,
                                                      "accuracy.error_budget": "off"}), set(), key)

    def test_curves_of_a_refined_model_are_taken_as_well(self):
        study = {"response.harmonics": 1, "response.frequency": ["310 Hz", "335 Hz"], "response.preload": [150, 300],
                 "accuracy.error_budget": "auto", "accuracy.tolerance": 0.2, "accuracy.extrapolation": "off", "contact.points": 24}

        def log_of(name, *options):
            return run(name, *options, cache="refined_cache", **study)

        first, again, refused = log_of("refined"), log_of("refined_again"), log_of("refined_refused", "--no-cache")
        for log in (first, again, refused):
            self.assertIn("now with harmonics", log)
        self.assertNotIn("preload_150: taken", first)
        self.assertEqual(again.count(" preload_150: taken from an earlier run"), 2, "before and after it was refined")
        for name in ("curves/preload_150.csv", "curves/preload_150.states.csv", "curves/preload_300.csv"):
            self.assertEqual(read("refined_again", name), read("refined_refused", name), name)

    def test_pictures_of_curves_that_did_not_change_are_not_drawn_again(self):
        study = {"response.maps": ["peak"], "response.harmonics": 3, "contact.points": 96, "response.frequency": ["310 Hz", "335 Hz"]}

        def drawn(name, preloads, *options, **changes):
            """Files of maps, motion and plots; curves of which the first two were taken."""
            log = run(name, *options, cache="pictures_cache", plots=True, **{**study, "response.preload": preloads, **changes})
            folders = [os.path.join(WORK, name, part) for part in ("maps", "motion", "plots")]
            files = {os.path.join(os.path.basename(folder), file): read(folder, file)
                     for folder in folders for file in sorted(os.listdir(folder))}
            return files, {load for load in preloads if f"maps_preload_{load}: taken from an earlier run" in log}

        def kept(kind="plot-"):
            return {name for name in os.listdir(os.path.join(WORK, "pictures_cache")) if name.startswith(kind)}

        first, taken = drawn("pictures", [600, 1000])
        self.assertEqual(taken, set())
        n_plots = sum(name.endswith(".svg") for name in first)
        self.assertEqual(len(kept()), n_plots)
        again, taken = drawn("pictures_again", [600, 1000])
        self.assertEqual((again, taken), (first, {600, 1000}))
        self.assertEqual(len(kept()), n_plots, "no figure was drawn again")
        self.assertEqual(len(kept("page-")), 2)
        self.assertEqual(*(read(name, "report.html").partition(b'id="data">')[2] for name in ("pictures", "pictures_again")))
        # One more curve: its map, and what shows all curves.
        more, taken = drawn("pictures", [600, 800, 1000])
        refused, _ = drawn("pictures_refused", [600, 800, 1000], "--no-cache")
        self.assertEqual((more, taken), (refused, {600, 1000}))
        of_all = [name for name in more if name.endswith(".svg") and "map_" not in name]
        self.assertEqual(len(kept()), n_plots + 1 + len(of_all))
        # A kept figure is taken as it is, a damaged one drawn again, other phases are other maps.
        for name in kept() | kept("page-"):
            os.truncate(os.path.join(WORK, "pictures_cache", name), 1000)
        self.assertEqual(drawn("pictures_mended", [600, 800, 1000])[0], more)
        self.assertEqual(drawn("pictures_phases", [600, 1000], **{"response.map_phases": 8})[1], set())

    def test_a_file_that_says_more_than_the_model_is_read_again(self):
        os.environ["MICROSLIP_CACHE"] = os.path.join(WORK, "points_cache")

        def solve(*given):
            run = microslip.run(points_scene("points", *given), folder=os.path.join(WORK, "points", "run"), without=["plots", "maps"],
                                program=PROGRAM)
            halved = [found for found in run.optimum["bracket"] if found["parameter"] == "contact_stiffness"][0]
            taken = ": taken from an earlier run" in read("points", "run", "log.txt").decode()
            return read("points", "run", "curves", "scale_1.csv"), halved["amplitude_m"], taken

        curve, amplitude, _ = solve(1e4, 0)
        self.assertEqual(solve(1e4, 0), (curve, amplitude, True))
        other_curve, other_amplitude, taken = solve(2e4, 5e-5)  # half of the flexibility is that of the bodies, which is known
        self.assertEqual((other_curve, taken), (curve, False))
        self.assertGreater(abs(other_amplitude / amplitude - 1), 0.01)

    def test_what_its_time_has_cut_short_is_not_taken(self):
        alone = {"response.harmonics": 3, "response.frequency": "320 Hz", "response.preload": [-500], "contact.points": 96,
                 "effects.coexistence": "on", "accuracy.error_budget": "auto"}
        run("hurried", cache="hurried_cache", **alone, **{"response.time_budget": "0.02 s"})  # over while others are looked for
        run("unhurried", cache="hurried_cache", **alone)
        run("unhurried_alone", "--no-cache", **alone)
        found, expected = (json.loads(read(name, "summary.json")) for name in ("unhurried", "unhurried_alone"))
        self.assertIsNotNone(expected["curves"][0]["harmonics"]["with_more"]["amplitude_m"])
        for key in ("bar", "digits"):
            self.assertEqual(found["curves"][0][key], expected["curves"][0][key], key)
        self.assertEqual(found["curves"][0]["harmonics"], expected["curves"][0]["harmonics"])

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
