"""The blade study shows what paper A shows (Cigeroglu, An & Menq 2007, section 4.2).

Runs both scenes with the program and asserts, from the run folders alone:
  frequency of the peak grows with preload and tends to the stuck one; an optimum preload exists and is
  found as such; low preload softens and jumps, a gap hardens and jumps, with two folds and an unstable
  branch between; x forcing answers an order of magnitude above y forcing, and under y forcing the stuck
  peak is above the free one; stick, slip and separation coexist; before the jump the patch is open most of
  the time, after it slip governs; every written point is certified to 1e-10. All of this with one harmonic, as the
paper; softening, hardening, their jumps and the level of the best preload once more with the nine of the scene.

In every run of the tests on 100 contact cells and with half of the preloads, the second scene on a coarser mesh and
nothing varied around the best preload; as they are given where campaigns are run whole.

usage: blade_study.py MICROSLIP SOURCE_FOLDER RUN_FOLDER
"""
import csv
import json
import os
import sys
import unittest

from program_run import run_scene, whole_campaigns

PROGRAM, SOURCE, FOLDER = sys.argv[1:4]
ONE = "response.harmonics=1"


def run(name, scene, *settings, plots=True, options=()):
    path = os.path.join(SOURCE, "share", "scenes", scene + ".toml")
    return Run(run_scene(PROGRAM, path, os.path.join(FOLDER, name), *settings, plots=plots, options=options))


class Run:
    def __init__(self, folder):
        self.folder = folder
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            self.summary = json.load(file)
        self.curves = {c["preload_N"]: c for c in self.summary["curves"]}

    def table(self, load):
        path = os.path.join(self.folder, "curves", self.curves[load]["name"] + ".csv")
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def tables(self):
        return {load: self.table(load) for load in self.curves}

    def peak(self, load):
        return self.curves[load]["peak"]

    def loads(self):
        return sorted(load for load in self.curves if isinstance(load, (int, float)))


def column(table, name):
    return [float(row[name]) for row in table]


class BladeStudy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if whole_campaigns():
            cls.nine = run("nine", "blade_to_ground")
            cls.x, cls.y = (run(name, name, ONE) for name in ("blade_to_ground", "blade_to_ground_y"))
            return
        lean = {"plots": False, "options": ("--without", "bracket")}
        cells = "contact.points=100"
        coarse = (cells, "model.element_size=0.006", "response.maps=[]")
        cls.nine = run("nine", "blade_to_ground", *coarse, "response.preload=[-500, 100, 300, 1000]", "response.optimum=",
                       "response.optimum_range=", **lean)
        unjudged = "accuracy.error_budget=off"  # of one harmonic: nothing below reads its bars
        cls.x = run("x", "blade_to_ground", ONE, cells, unjudged,
                    'response.preload=["free", -500, 100, 300, 1000, 3000, "stuck"]', **lean)
        cls.y = run("y", "blade_to_ground_y", ONE, unjudged, *coarse,
                    'response.preload=["free", -100, 2, 6, 20, 100, "stuck"]', **lean)

    def test_every_curve_is_complete(self):
        for study in (self.x, self.y):
            self.assertEqual(study.summary["exit_code"], 0)
            for curve in study.summary["curves"]:
                self.assertTrue(curve["complete"], curve)

    def test_mesh_is_large_enough_to_mean_something(self):
        self.assertGreaterEqual(self.x.summary["mesh"]["degrees_of_freedom"], 60000)

    def test_first_resonance_of_the_free_blade_lies_near_296_hz(self):
        self.assertAlmostEqual(self.x.summary["modes"][0]["frequency_Hz"], 296.0, delta=1.0)
        self.assertEqual(sum(mode["kind"] == "free" for mode in self.x.summary["modes"]), 10)

    def test_every_point_is_certified(self):
        for study in (self.x, self.y):
            for load, table in study.tables().items():
                for name in ("residual", "energy_imbalance", "dissipation_mismatch"):
                    self.assertLessEqual(max(column(table, name)), 1e-10, f"{name} at {load}")

    def test_shares_sum_to_one(self):
        for table in self.x.tables().values():
            for row in table:
                total = sum(float(row[k]) for k in ("stick_share", "slip_share", "separated_share"))
                self.assertAlmostEqual(total, 1.0, places=9)

    def test_peak_frequency_grows_with_preload_and_tends_to_the_stuck_one(self):
        for study in (self.x, self.y):
            loads = study.loads()
            frequencies = [study.peak(load)["frequency_Hz"] for load in loads]
            self.assertEqual(frequencies, sorted(frequencies))
            free, stuck = (study.peak(k)["frequency_Hz"] for k in ("free", "stuck"))
            self.assertLess(free, frequencies[0])
            self.assertLess(abs(frequencies[-1] - stuck), 0.01 * (stuck - free))

    def test_an_optimum_preload_exists(self):
        for study in (self.x, self.y):
            optimum = study.summary["optimum"]
            self.assertTrue(optimum["found"])
            for load in study.loads():
                self.assertLess(optimum["amplitude_m"], study.peak(load)["amplitude_m"])
            positive = [load for load in study.loads() if load > 0]
            self.assertLess(positive[0], optimum["preload_N"])
            self.assertLess(optimum["preload_N"], positive[-1])
            free, stuck = (study.peak(k)["amplitude_m"] for k in ("free", "stuck"))
            self.assertLess(optimum["amplitude_m"], 0.25 * min(free, stuck))

    def jump(self, study, load):
        """Folds in branch order and the stability between them."""
        table = study.table(load)
        at = [i for i, row in enumerate(table) if row["mark"] == "fold"]
        self.assertEqual(len(at), 2, f"folds at {load} N")
        between = table[at[0] + 1:at[1]]
        self.assertTrue(between)
        self.assertTrue(all(row["stable"] == "0" for row in between))
        self.assertEqual(table[at[0] - 1]["stable"], "1")
        self.assertEqual(table[at[1] + 1]["stable"], "1")
        return [float(table[i]["frequency_Hz"]) for i in at]

    def test_low_preload_softens_and_jumps(self):
        first, second = self.jump(self.x, 100)
        self.assertGreater(first, second)
        self.assertLess(second, self.x.peak(100)["frequency_Hz"])
        # Softening: the resonance leans to lower frequencies, the upper branch starts at the lower fold.
        table = self.x.table(100)
        at = {round(float(r["frequency_Hz"]), 9): float(r["amplitude_m"]) for r in table if r["mark"] == "fold"}
        self.assertGreater(at[round(second, 9)], at[round(first, 9)])

    def test_a_gap_hardens_and_jumps(self):
        first, second = self.jump(self.x, -500)
        self.assertGreater(first, second)
        table = self.x.table(-500)
        at = [float(r["amplitude_m"]) for r in table if r["mark"] == "fold"]
        self.assertGreater(at[0], at[1])  # falls at the upper fold
        self.assertLess(self.x.peak("free")["frequency_Hz"], self.x.peak(-500)["frequency_Hz"])

    def test_x_forcing_is_an_order_of_magnitude_above_y(self):
        ratio = self.x.peak("free")["amplitude_m"] / self.y.peak("free")["amplitude_m"]
        self.assertGreater(ratio, 10.0)
        self.assertLess(ratio, 40.0)

    def test_stuck_peak_is_above_the_free_one_under_y_forcing(self):
        self.assertGreater(self.y.peak("stuck")["amplitude_m"], self.y.peak("free")["amplitude_m"])
        self.assertLess(self.x.peak("stuck")["amplitude_m"], self.x.peak("free")["amplitude_m"])

    def folds(self, study, load):
        return [row for row in study.table(load) if row["mark"] == "fold"]

    def test_nine_harmonics_show_it_too(self):
        frequencies = [self.nine.peak(load)["frequency_Hz"] for load in (-500, 100, 300, 1000)]
        self.assertEqual(frequencies, sorted(frequencies))
        for load in (-500, 100):
            folds = self.folds(self.nine, load)
            self.assertGreaterEqual(len(folds), 2)
            self.assertEqual(len(folds) % 2, 0)
            self.assertTrue(any(row["stable"] == "0" for row in self.nine.table(load)))
        # Hardening: the highest solution falls at a frequency above that of the lowest; softening: below.
        for load, sign in ((-500, 1.0), (100, -1.0)):
            highest = max(self.folds(self.nine, load), key=lambda row: float(row["amplitude_m"]))
            lowest = min(self.folds(self.nine, load), key=lambda row: float(row["amplitude_m"]))
            self.assertGreater(sign * (float(highest["frequency_Hz"]) - float(lowest["frequency_Hz"])), 0.0)
        amplitude = {load: self.nine.peak(load)["amplitude_m"] for load in (-500, 100, 300, 1000)}
        self.assertEqual(min(amplitude, key=amplitude.get), 300)

    def test_nine_harmonics_are_told_what_they_lack(self):
        for load in (-500, 100, 300):
            rows = [row for row in self.nine.summary["error_budget"]
                    if row["curve"] == self.nine.curves[load]["name"] and row["source"] == "harmonics"]
            self.assertTrue(rows)
            self.assertLess(max(abs(row["effect"]) for row in rows), 0.1)

    def test_every_sampled_point_is_certified(self):
        for load, table in self.nine.tables().items():
            self.assertLessEqual(max(column(table, "residual")), 1e-9, load)
            self.assertLessEqual(max(column(table, "energy_imbalance")), 1e-6, load)

    def test_stick_slip_and_separation_coexist(self):
        self.assertGreater(max(column(self.x.table(100), "three_states_share")), 0.05)

    def test_maps_before_and_after_the_jump(self):
        import h5py
        curve = self.x.curves[100]
        self.assertEqual(len(curve["maps"]), 3)  # lower, unstable and upper solution at one frequency
        shares = []
        for name in curve["maps"]:
            with h5py.File(os.path.join(self.x.folder, "maps", name + ".h5"), "r") as file:
                state, weights = file["state"][:], file["weights"][:]
                phases = set(file["phase_deg"][:].round(6))
            self.assertTrue({0.0, 90.0, 180.0, 270.0} <= phases)
            share = [(weights[:, None] * (state == k)).sum() / weights.sum() / state.shape[1] for k in range(4)]
            shares.append((share[0], share[1] + share[2], share[3]))
        after, _, before = shares  # the branch comes from low frequency along the small amplitudes
        self.assertGreater(before[2], 0.5, "open most of the time")
        self.assertGreater(after[1], 0.5, "slip governs")
        self.assertLess(after[2], 0.05)

    def test_time_and_memory_stay_in_bounds(self):
        stages = self.x.summary["stages"]
        self.assertLessEqual(max(s["peak_memory_MB"] for s in stages), 3000)
        print("seconds:", {s["name"]: round(s["seconds"], 2) for s in stages}, file=sys.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
