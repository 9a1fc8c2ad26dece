"""The scenes of papers A and B show what the papers state about them.

A: Cigeroglu, An & Menq 2007, section 4.1, the bar with end spring (figures 4 to 8).
   Constant load: slip starts at the right end and spreads left. Quadratic load: it starts around the middle,
   reaches the right end first, then the left. One mode: all slip-to-stick angles are equal; three and ten modes
   nearly alike, one visibly different; several modes: a small phase spread of the slip-to-stick line.
B: the paper on 3D contact of rough surfaces: chains of figures 8 to 10. 30 N gives the lowest peak of the loads
   listed; free and stuck exceed all others. With normal motion: jumps at 25, 30 and 50 N and only there, as
   two stable solutions over a band. With a preload moment: a higher peak at 50 N.

Everything is read from the run folders alone.

usage: paper_scenes.py MICROSLIP SOURCE_FOLDER RUN_FOLDER
"""
import csv
import functools
import json
import os
import subprocess
import sys
import unittest

import h5py
import numpy as np

from program_run import run_scene, whole_campaigns

PROGRAM, SOURCE, FOLDER = sys.argv[1:4]


@functools.cache
def run(scene, name, *settings, plots=False):
    return run_scene(PROGRAM, os.path.join(SOURCE, "share", "scenes", scene + ".toml"), os.path.join(FOLDER, name),
                     *settings, plots=plots)


def summary_of(folder):
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def rows_of(folder, name):
    with open(os.path.join(folder, "curves", name + ".csv"), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class BarCycle:
    """Who slips along the bar, and the angle of its slip-to-stick transition (load constant in time).

    u = Im(U e^(iθ)), U = Σ φ_n A_n: a point slips when k|U| > μn, and sticks again at the maximum of u,
    θ = atan2(Re U, Im U). The half-period later transition is the same line shifted.
    """

    def __init__(self, scene, frequency, force, modes, maps="[]"):
        name = f"{scene}_{frequency}_{force}_{modes}".replace("=", "").replace("[", "").replace("]", "")
        drawn = maps != "[]"
        folder = run(f"bar_{scene}_{frequency}", name + ("_drawn" if drawn else ""), f"excitation.force={force}",
                     f"modes.{modes}", f"response.maps={maps}", plots=drawn)
        self.folder = folder
        (curve,) = summary_of(folder)["curves"]
        self.preload = curve["preload_N"]
        (row,) = rows_of(folder, curve["name"] + ".states")
        (self.point,) = rows_of(folder, curve["name"])
        n = sum(key.startswith("q_sin1_") for key in row)
        amplitudes = np.array([complex(float(row[f"q_sin1_{i}"]), float(row[f"q_cos1_{i}"]))
                               for i in range(1, n + 1)])
        with h5py.File(os.path.join(folder, "model.h5"), "r") as file:
            contact = file["contact"]
            U = contact["phi_u"][:] @ amplitudes
            force_limit = contact["friction_coefficient"][:] * contact["preload"][:]
            self.slips = contact["tangential_stiffness"][:] * np.abs(U) > force_limit
            self.x = contact["points"][:, 0]
            self.weights = contact["weights"][:]
        self.angle = np.degrees(np.arctan2(U.real, U.imag)) % 180  # the same for both halves of the cycle

    def slipping(self):
        return self.x[self.slips]

    def spread(self):
        return np.ptp(self.angle[self.slips])


LENGTH = 1.03  # m
END = 0.01     # m: nearer to an end than two of the 200 cells of 5 mm


class Bar(unittest.TestCase):
    def spreads_left_from_the_right_end(self, forces):
        left = [LENGTH]
        for force in forces:
            cycle = BarCycle("constant", 1000, force, "count=10")
            x = cycle.slipping()
            self.assertGreater(x.max(), LENGTH - END)
            self.assertLess(x.min(), left[-1])
            self.assertAlmostEqual(np.diff(x).max(), np.diff(x).min(), places=9, msg="one piece")
            left.append(x.min())
        return left[1:]

    def test_constant_load_slips_from_the_right_end_leftwards(self):
        left = self.spreads_left_from_the_right_end((350, 400, 450, 500))
        self.assertGreater(left[0], 0.9 * LENGTH)
        self.assertLess(left[-1], 0.3 * LENGTH)

    def test_quadratic_load_slips_from_the_middle_to_the_right_then_to_the_left(self):
        pieces = [BarCycle("quadratic", 1000, force, "count=10").slipping()
                  for force in (120, 150, 200, 250, 300)]
        self.assertLess(abs(0.5 * (pieces[0].min() + pieces[0].max()) - 0.5 * LENGTH), 0.1 * LENGTH)
        for smaller, larger in zip(pieces, pieces[1:]):
            self.assertLess(larger.min(), smaller.min())
            self.assertGreaterEqual(larger.max(), smaller.max())
        at_right = [x.max() > LENGTH - END for x in pieces]
        at_left = [x.min() < END for x in pieces]
        self.assertEqual(at_right, [False, False, False, True, True])
        self.assertEqual(at_left, [False, False, False, False, True])

    def test_one_mode_sticks_again_everywhere_at_once(self):
        for scene, frequency, force in (("constant", 1000, 450), ("quadratic", 3100, 250)):
            alone = "which=[1]" if frequency == 1000 else "which=[2]"
            cycle = BarCycle(scene, frequency, force, alone)
            self.assertTrue(cycle.slips.any())
            self.assertLess(cycle.spread(), 1e-9)  # degrees; the angle is that of one complex number

    def test_several_modes_spread_the_line_a_little(self):
        for scene, force in (("constant", 450), ("quadratic", 200)):
            for modes in ("count=3", "count=10"):
                spread = BarCycle(scene, 1000, force, modes).spread()
                self.assertGreater(spread, 0.1)
                self.assertLess(spread, 5.0)  # "zoomed into a very small range of θ"

    def test_three_and_ten_modes_are_alike_and_one_is_not(self):
        for scene, force in (("constant", 400), ("quadratic", 150)):
            one, three, ten = (BarCycle(scene, 1000, force, m)
                               for m in ("which=[1]", "count=3", "count=10"))
            common = one.slips & three.slips & ten.slips
            distance = lambda a: np.abs(a.angle - ten.angle)[common].max()
            self.assertLess(distance(three), 0.3 * distance(one), scene)

    def test_at_350_N_only_ten_modes_slip(self):
        slips = {m: BarCycle("constant", 1000, 350, m).slips.any()
                 for m in ("which=[1]", "count=3", "count=10")}
        self.assertEqual(slips, {"which=[1]": False, "count=3": False, "count=10": True})

    def test_single_mode_is_the_one_nearest_to_the_excitation(self):
        self.assertFalse(BarCycle("constant", 3100, 450, "which=[1]").slips.any())
        self.assertTrue(BarCycle("constant", 3100, 450, "which=[2]").slips.any())

    def test_preload_is_the_sum_of_the_load(self):
        self.assertAlmostEqual(BarCycle("constant", 1000, 450, "count=3").preload, 2000 * LENGTH, places=9)
        # ∫ 2000 [0.2 + 0.8 (2x/L − 1)²] dx = 2000 L (0.2 + 0.8/3); midpoints of 200 cells err by 1/200².
        exact = 2000 * LENGTH * (0.2 + 0.8 / 3)
        self.assertAlmostEqual(BarCycle("quadratic", 1000, 200, "count=3").preload / exact, 1, delta=2.5e-5)

    def test_the_report_draws_the_boundaries(self):
        sys.path.insert(0, os.path.join(SOURCE, "share", "python"))
        from microslip.plots.line_map import POSITIVE, STICK, LineMap, line_positions
        cycle = BarCycle("quadratic", 1000, 150, "count=10", maps="['1000 Hz']")
        self.assertTrue(os.path.exists(os.path.join(cycle.folder, "plots", "map_scale_1_1000Hz_1.png")))
        position = line_positions(cycle.folder)
        line_map = LineMap(cycle.folder, "scale_1_1000Hz_1", position)
        drawn = line_map.transitions(POSITIVE, STICK)
        np.testing.assert_array_equal(~np.isnan(drawn), cycle.slips)
        # Both are the angle of one complex number: rounding of states written with 17 digits, in degrees.
        self.assertLess(np.abs(drawn - cycle.angle)[cycle.slips].max(), 1e-6)
        begins = line_map.transitions(STICK, POSITIVE)
        for point in np.flatnonzero(cycle.slips):  # the state written at 90° is the one drawn there
            slipping = begins[point] < 90 < drawn[point]
            self.assertEqual(line_map.state[point, np.argmin(np.abs(line_map.phase - 90))], int(slipping))

    def test_field_and_lines_of_a_bar_are_one_drawing(self):
        """What is drawn at an instant of the map is the state written there."""
        sys.path.insert(0, os.path.join(SOURCE, "share", "python"))
        from microslip.plots.line_field import KINDS, Field
        from microslip.plots.line_map import LineMap, line_positions
        from microslip.plots.style import STATE_COLOURS
        from matplotlib.path import Path
        cycle = BarCycle("quadratic", 1000, 150, "count=10", maps="['1000 Hz']")
        line_map = LineMap(cycle.folder, "scale_1_1000Hz_1", line_positions(cycle.folder))
        field = Field(line_map)
        areas = [(Path(corners), colour) for corners, colour in zip(field.polygons, field.colours)]
        names = {"stick to slip", "slip to stick"}
        self.assertEqual({KINDS[kind][0] for kind, _, _ in field.lines}, names)
        for point in range(0, len(line_map.x), 7):
            for phase in range(0, len(line_map.phase), 5):
                at = (line_map.x[point] + 1e-6, line_map.phase[phase] + 0.01)  # off the borders of areas
                colours = [colour for area, colour in areas if area.contains_point(at)]
                starts = np.array([angle for _, angle in line_map.cycles[point]])
                if starts.size and np.abs((starts - at[1] + 180) % 360 - 180).min() < 0.5:
                    continue
                self.assertEqual(colours[-1], STATE_COLOURS[line_map.state[point, phase]], at)  # the one on top

    def test_points_are_certified(self):
        point = BarCycle("quadratic", 3100, 250, "count=10").point
        for name in ("residual", "energy_imbalance", "dissipation_mismatch"):
            self.assertLessEqual(float(point[name]), 1e-10)


# Under a constant load peaks with five harmonics are those with the nine of the scene within a thousandth.
CONSTANT_LOAD = () if whole_campaigns() else ("response.harmonics=5",)


class Chain:
    def __init__(self, scene, *settings):
        self.folder = run(scene, scene, "response.maps=[]", *settings)
        self.summary = summary_of(self.folder)
        self.curves = {curve["preload_N"]: curve for curve in self.summary["curves"]}
        self.loads = sorted(load for load in self.curves if not isinstance(load, str))

    def highest(self, load):
        return max(float(row["amplitude_m"]) for row in rows_of(self.folder, self.curves[load]["name"]))

    def solutions_at(self, load, frequency_hz):
        """Crossings of one frequency along the branch: (stable, amplitude) each."""
        rows = rows_of(self.folder, self.curves[load]["name"])
        found = []
        for before, after in zip(rows, rows[1:]):
            left, right = (float(r["frequency_Hz"]) - frequency_hz for r in (before, after))
            if left * right < 0:
                flags = {r["stable"] for r in (before, after) if r["mark"] != "fold"}
                found.append((flags == {"1"}, float(before["amplitude_m"])))
        return found


class Chains(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.plain = Chain("chain_2dof", *CONSTANT_LOAD)
        cls.normal = Chain("chain_3dof_normal")
        cls.moment = Chain("chain_2dof_moment")

    def test_every_curve_is_complete_and_named_by_its_load(self):
        for chain in (self.plain, self.normal, self.moment):
            for load, curve in chain.curves.items():
                self.assertTrue(curve["complete"], curve)
                self.assertIsNone(curve["preload_scale"])
                self.assertEqual(curve["name"], load if isinstance(load, str) else f"preload_{load:g}")

    def test_free_frequencies_are_those_of_the_paper(self):
        for chain in (self.plain, self.normal, self.moment):
            hz = [mode["frequency_Hz"] for mode in chain.summary["modes"]]
            self.assertAlmostEqual(hz[0], 20.0, delta=0.05)  # printed with one decimal
            self.assertAlmostEqual(hz[1], 52.4, delta=0.05)

    def test_30_N_gives_the_lowest_peak_and_the_limits_are_above_all(self):
        peaks = {load: self.plain.highest(load) for load in self.plain.loads}
        self.assertEqual(min(peaks, key=peaks.get), 30)
        for limit in ("free", "stuck"):
            for load in (10, 20, 30, 50, 100, 200):
                self.assertGreater(self.plain.highest(limit), peaks[load])
        optimum = self.plain.summary["optimum"]
        self.assertTrue(optimum["found"])
        self.assertLess(30, optimum["preload_N"])
        self.assertLess(optimum["preload_N"], 50)

    def test_the_best_friction_coefficient_gives_the_best_friction_force(self):
        """Under a constant load only μ n counts: μ* 30 N = 0.5 n*; the amplitude agrees to the square of the
        1e-4 to which the searches place their minima."""
        folder = run("chain_2dof", "chain_2dof_mu", "response.optimum=contact.points[0].friction_coefficient",
                     "response.optimum_range=[0.1, 2]", "response.optimum_at=30", "response.preload=[30]",
                     *CONSTANT_LOAD)
        friction, preload = summary_of(folder)["optimum"], self.plain.summary["optimum"]
        self.assertTrue(friction["found"])
        self.assertEqual(friction["parameter"], "contact.points[0].friction_coefficient")
        self.assertEqual(friction["preload_N"], 30)
        self.assertAlmostEqual(friction["value"] * 30 / (0.5 * preload["preload_N"]), 1, delta=1e-3)
        self.assertAlmostEqual(friction["amplitude_m"] / preload["amplitude_m"], 1, delta=1e-6)
        self.assertEqual([entry["parameter"] for entry in friction["bracket"]], ["contact_stiffness"] * 2)

    def test_half_the_friction_coefficient_doubles_the_best_preload(self):
        optimum = self.plain.summary["optimum"]
        rows = {(e["parameter"], e["factor"]): e for e in optimum["bracket"] if e["found"]}
        half = rows["friction_coefficient", 0.5]
        self.assertAlmostEqual(half["preload_N"] / (2 * optimum["preload_N"]), 1, delta=1e-3)
        self.assertAlmostEqual(half["amplitude_m"] / optimum["amplitude_m"], 1, delta=1e-6)
        self.assertLess(rows["contact_stiffness", 2.0]["amplitude_m"], optimum["amplitude_m"])

    def test_peaks_are_those_of_time_integration(self):
        """Half peak-to-peak of m2 by fourth-order Runge-Kutta with slider memory, 1000 steps a period, 50
        periods, at 21.7 Hz and 23.0 Hz: an own integration outside of the program; the transient of 50
        periods leaves exp(−2π·0.02·50) = 0.2 %."""
        for load, expected in ((30, 0.0022331522566), (50, 0.0024531423257)):
            self.assertAlmostEqual(self.plain.highest(load) / expected, 1, delta=2e-3)

    def test_600_N_never_slips(self):
        self.assertAlmostEqual(self.plain.highest(600) / self.plain.highest("stuck"), 1, places=9)

    def test_normal_motion_jumps_at_25_30_and_50_N_only(self):
        for load in self.normal.loads:
            folds = self.normal.curves[load]["folds_Hz"]
            if load not in (25, 30, 50):
                self.assertEqual(folds, [], load)
                continue
            band = max(folds) - min(folds)
            self.assertGreater(band, 0.3, load)
            middle = self.normal.solutions_at(load, min(folds) + 0.5 * band)
            self.assertEqual([stable for stable, _ in middle], [True, False, True], load)
            amplitudes = [amplitude for _, amplitude in middle]
            self.assertGreater(max(amplitudes[0], amplitudes[2]), 1.2 * min(amplitudes[0], amplitudes[2]))

    def test_normal_motion_lets_curves_leave_the_limits(self):
        between = rows_of(self.normal.folder, self.normal.curves[25]["name"])
        free, stuck = (rows_of(self.normal.folder, name) for name in ("free", "stuck"))
        at = lambda rows, hz: np.interp(hz, [float(r["frequency_Hz"]) for r in rows],
                                        [float(r["amplitude_m"]) for r in rows])
        above = [float(r["amplitude_m"]) > max(at(free, float(r["frequency_Hz"])),
                                               at(stuck, float(r["frequency_Hz"]))) for r in between]
        self.assertTrue(any(above))

    def test_normal_motion_matters_most_between_10_and_100_N(self):
        change = {load: abs(self.normal.highest(load) / self.plain.highest(load) - 1)
                  for load in (10, 30, 50, 100, 200)}
        self.assertGreater(change[30], 0.3)
        self.assertGreater(change[50], 0.3)

    def test_a_moment_raises_the_peak_at_50_N(self):
        self.assertGreater(self.moment.highest(50), 1.1 * self.plain.highest(50))

    def test_a_moment_below_48_N_lifts_cells_off(self):
        """At 30 N two of the four rows carry, 25 N and 5 N: 8 of 16 cells stay open all the time."""
        folder = run("chain_2dof_moment", "lifted", "response.preload=[47.9, 30]", "response.maps=[]")
        for load, share in ((30, 8 / 16), (47.9, 4 / 16)):
            for row in rows_of(folder, f"preload_{load:g}"):
                self.assertAlmostEqual(float(row["separated_share"]), share, places=12)

    def test_a_moment_without_equilibrium_is_refused(self):
        """The resultant leaves the cell centres at 1 N m / 37.5 mm = 26.67 N."""
        command = [PROGRAM, "run", os.path.join(SOURCE, "share", "scenes", "chain_2dof_moment.toml"), "-q",
                   "-o", os.path.join(FOLDER, "refused"), "--set", "response.preload=[26.6]"]
        finished = subprocess.run(command, capture_output=True, text=True, timeout=60)
        self.assertEqual(finished.returncode, 2, finished.stderr)
        self.assertIn("more than 26.6667 N", finished.stderr)

    def test_points_are_certified(self):
        for chain in (self.plain, self.normal, self.moment):
            for curve in chain.curves.values():
                for name in ("largest_residual", "largest_energy_imbalance",
                             "largest_dissipation_mismatch"):
                    self.assertLessEqual(curve[name], 1e-10, (curve["name"], name))


class Oscillator(unittest.TestCase):
    """Paper B, figure 6, as far as one harmonic carries; the four plots need many, or time integration."""

    def test_without_friction_it_is_the_linear_oscillator(self):
        for eta in (0.75, 0.5, 0.25, 0.15):
            folder = run("oscillator_1dof", f"oscillator_{eta}", "response.method=harmonic_balance",
                         "response.harmonics=1", f"response.frequency={eta}", "response.maps=[]",
                         "response.preload=[\"free\"]")
            (row,) = rows_of(folder, "free")
            expected = abs(1 / complex(1 - eta**2, 2 * 0.05 * eta))
            self.assertAlmostEqual(float(row["amplitude_m"]) / expected, 1, places=12)

    def test_near_resonance_practically_all_is_slip_and_slow_motion_sticks(self):
        shares = {}
        for eta in (0.75, 0.15):
            folder = run("oscillator_1dof", f"oscillator_friction_{eta}", f"response.frequency={eta}",
                         "response.method=harmonic_balance", "response.harmonics=1", "response.maps=[]")
            (row,) = rows_of(folder, "preload_1")
            self.assertLess(float(row["amplitude_m"]), abs(1 / complex(1 - eta**2, 2 * 0.05 * eta)))
            shares[eta] = float(row["slip_share"])
        self.assertGreater(shares[0.75], 0.9)
        self.assertLess(shares[0.15], shares[0.75])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
