"""Effects that `auto` leaves out were rightly left out: over small scenes the peaks agree with those of everything on, within
the bound that the run states; and scenes built to fool the indicators are told by the run, not passed over.

The bound of a peak is its bar, of harmonics above all, together with the bounds of the effects left out. 0.1 % is added for
what both runs leave open alike (the tolerance of a chosen set of harmonics is ten times that).

usage: effects_chosen.py MICROSLIP SOURCE_FOLDER RUN_FOLDER          (MICROSLIP_CAMPAIGNS=whole: thirty scenes)
"""
import csv
import functools
import json
import math
import os
import random
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

from program_run import whole_campaigns, without_plots

PROGRAM, SOURCE, FOLDER = sys.argv[1:4]
SCENES = os.path.join(SOURCE, "share", "scenes")
SLACK = 1e-3
MANY = "response.harmonics=13"
NO_ERRORS = "accuracy.error_budget=off"  # of what is compared with alone

# Two modes and one point, which slips.
MODAL = """[model]
kind = "modal"
[modal]
frequency = [20, 52]
damping_ratio = 0.01
force_sine = [7, 0.5]
force_static = [{static}, 0]
output = [0.75, 0.5]
[[modal.points]]
weight = 1
tangential_stiffness = 4e4
normal_stiffness = 4e4
friction_coefficient = 0.5
preload = {preload}
phi_u_1 = 0.5
phi_u_2 = -0.8
phi_v_1 = {normal}
phi_w_1 = {across}
phi_w_2 = {across}
[response]
frequency = [19, 28]
"""


def scene(name, **values):
    """A file. Without other values a point that slips under a constant load."""
    path = os.path.join(FOLDER, name + ".toml")
    os.makedirs(FOLDER, exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(MODAL.format(**{"static": 0, "preload": 30, "normal": 0, "across": 0, **values}))
    return path


@functools.cache
def run(name, path, *settings, cache="off"):
    """summary.json and the warnings of a run. `cache`: a folder of meshes, modes and curves that runs share."""
    command = [PROGRAM, "run", path, "-q", "--without", "bracket", "-o", os.path.join(FOLDER, name)]
    for setting in settings:
        command += ["--set", setting]
    finished = subprocess.run(command, capture_output=True, text=True, timeout=300,
                              env={**without_plots(), **({} if cache == "off" else {"MICROSLIP_CACHE": cache})})
    if finished.returncode != 0:
        raise RuntimeError(f"{' '.join(command)} ended with {finished.returncode}: {finished.stderr}")
    with open(os.path.join(FOLDER, name, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def effect(summary, name):
    (row,) = [row for row in summary["effects"] if row["name"] == name]
    return row


def peaks(summary):
    return {curve["name"]: curve["peak"]["amplitude_m"] for curve in summary["curves"] if curve["peak"]}


def bounds(summary):
    """What may be missing of each peak, relative."""
    left_out = sum(row["bound"] for row in summary["effects"] if row["simulated"] is False and row["bound"])
    return {curve["name"]: SLACK + left_out + ((curve.get("bar") or {}).get("peak_amplitude") or 0.0)
            for curve in summary["curves"]}


NORMAL, ALONG_R = "effects.normal_motion=on", "effects.second_direction=on"
SURFACES = ["effects.roughness=on", "effects.rate_dependence=on"]


def surfaces(height=0, rate=0):
    """Settings of a point that is compressed by 0.75 mm at rest, and vibrates by some mm at some m/s."""
    rough = [f'contact.roughness={{ law = "cubic", height = {height} }}'] if height else []
    law = [f'contact.friction_law={{ law = "exponential", static = 0.5, kinetic = 0.4, rate = {rate} }}'] if rate else []
    return rough + law


# Scene, its settings, and what everything on is beside harmonics up to 13 and no proof of linearity.
CASES = {
    "chain": (f"{SCENES}/chain_2dof.toml", ["response.harmonics=auto", "response.optimum=", "response.optimum_range=",
                                            "response.preload=[50]"], []),
    "stuck": (f"{SCENES}/chain_2dof.toml", ["response.harmonics=auto", "response.optimum=", "response.optimum_range=",
                                            "response.preload=[2000]"], []),
    "normal": (f"{SCENES}/chain_3dof_normal.toml", ["response.harmonics=auto", "response.preload=[50]"], [NORMAL]),
    "area": (f"{SCENES}/chain_2dof_moment.toml", ["response.harmonics=auto", "response.preload=[50]", "response.maps=[]"], []),
    "oscillator": (f"{SCENES}/oscillator_1dof.toml", ["response.method=harmonic_balance", "response.harmonics=auto",
                                                      "response.frequency=[0.8, 1.6]", "response.maps=[]"], []),
    "faint_normal": ("faint_normal", [], [NORMAL]),
    "faint_across": ("faint_across", [], [ALONG_R]),
    "both_ways": ("both_ways", [], [ALONG_R, NORMAL]),
    "pulled": ("pulled", [], [NORMAL]),
    # The second mode stands at three times the peak, and only there.
    "third": ("third", ["modal.frequency=[20, 63]", "modal.damping_ratio=[0.01, 0.0005]"], []),
    # Along p and along r the point moves with two modes that meet where it slips a little: the orbit turns elliptic.
    "veering": ("veering", ["modal.frequency=[20, 20.6]", "modal.points[0].phi_u_2=0.1", "modal.points[0].phi_w_1=0.02",
                            "modal.points[0].phi_w_2=0.35"], [ALONG_R]),
    # A mode along r below the range, which contact lifts into it.
    "outside": ("outside", ["modal.frequency=[20, 18.5]", "modal.points[0].phi_u_2=0", "modal.points[0].phi_w_1=0",
                            "modal.points[0].phi_w_2=0.5"], [ALONG_R]),
    # Rough surfaces and friction by speed, below their limits and above.
    "smoother": ("smoother", surfaces(height=5e-5), [NORMAL, SURFACES[0]]),
    "rougher": ("rougher", surfaces(height=5e-4), [NORMAL, SURFACES[0]]),
    "slower": ("slower", surfaces(rate=0.001), [SURFACES[1]]),
    "faster": ("faster", surfaces(rate=2), [SURFACES[1]]),
    "both_laws": ("both_laws", surfaces(height=2e-5, rate=3e-4), [NORMAL, *SURFACES]),
    # Cells that are open at rest.
    "corner": (f"{SCENES}/chain_2dof_moment.toml", ["response.harmonics=auto", "response.preload=[30]", "response.maps=[]"], []),
}
REST = () if whole_campaigns() else ("faint_across", "outside")  # of both directions, as two others
VALUES = {"third": {"preload": 12}, "veering": {}, "outside": {}, "faint_normal": {"normal": 1e-6}, "faint_across": {"across": 1e-11},
          "both_ways": {"across": 0.3, "normal": 0.2}, "smoother": {"normal": 0.3}, "rougher": {"normal": 0.3}, "slower": {}, "faster": {},
          "both_laws": {"normal": 0.3}, "pulled": {"normal": 0.3, "static": -200}}


def random_case(seed):
    """Two modes and a point, from touching to pressed, with and without normal motion, motion along r and a static force."""
    draw = random.Random(seed)
    name = f"random_{seed}"
    VALUES[name] = {"preload": round(draw.uniform(5, 80), 2), "normal": draw.choice([0, 1e-6, 0.05, 0.3]),
                    "across": draw.choice([0, 0, 0.2]), "static": draw.choice([0, 0, -100, 100])}
    on = ([NORMAL] if VALUES[name]["normal"] else []) + ([ALONG_R] if VALUES[name]["across"] else [])
    return name, [f"modal.frequency=[20, {draw.uniform(30, 70):.3f}]", f"modal.points[0].phi_u_2={draw.uniform(-0.9, 0.9):.3f}"], on


class AutoAgreesWithEverythingOn(unittest.TestCase):
    def test_over_scenes(self):
        n_random = 17 if whole_campaigns() else 2
        cases = {**CASES, **{name: (name, *rest) for name, *rest in map(random_case, range(n_random))}}
        for name in cases.keys() - REST:
            path, settings, on = cases[name]
            with self.subTest(name):
                path = scene(name, **VALUES[name]) if name in VALUES else path
                auto = run(name + "_auto", path, *settings)
                kept = [setting for setting in settings if not setting.startswith("response.harmonics=")]
                whole = run(name + "_on", path, *kept, MANY, "effects.nonlinearity=on", NO_ERRORS, *on)
                bound = bounds(auto)
                self.assertEqual(peaks(auto).keys(), peaks(whole).keys())
                for curve, amplitude in peaks(whole).items():
                    change = abs(peaks(auto)[curve] / amplitude - 1)
                    print(f"{name:13} {curve:12} differs by {100 * change:.4f} %, stated {100 * bound[curve]:.3f} %")
                    self.assertLessEqual(change, bound[curve])

    def test_what_is_left_out_is_so_by_its_indicator(self):
        # Else the comparison above compares a scene with itself.
        faint = run("faint_normal_auto", scene("faint_normal", normal=1e-6))
        row = effect(faint, "normal_motion")
        self.assertIs(row["simulated"], False)
        self.assertLess(row["indicator"], row["threshold"])
        self.assertLess(row["bound"], 1e-6)
        for name, settings, values in (("roughness", surfaces(height=5e-5), {"normal": 0.3}), ("rate_dependence", surfaces(rate=0.001), {})):
            path = scene(f"little_{name}", **values)
            little, whole = run(f"little_{name}", path, *settings), run(f"little_{name}_on", path, *settings, f"effects.{name}=on")
            row = effect(little, name)
            change = abs(peaks(whole)["scale_1"] / peaks(little)["scale_1"] - 1)
            print(f"{name}: indicator {row['indicator']:.4f}, left out changes the peak by {100 * change:.5f} %, stated {100 * row['bound']:.5f} %")
            self.assertEqual((row["simulated"], row["setting"], row["objection"]), (False, "auto", ""))
            self.assertLess(row["indicator"], row["threshold"])
            self.assertLess(row["bound"], 0.005)
            self.assertLessEqual(change, row["bound"] + 1e-6)  # what both solve to
            self.assertIs(effect(whole, name)["simulated"], True)
        proved = effect(run("stuck_auto", *CASES["stuck"][:1], *CASES["stuck"][1]), "nonlinearity")
        self.assertEqual((proved["simulated"], proved["bound"]), (False, 0.0))
        self.assertNotIn("no bound", proved["reason"])


class IndicatorsAreFooled(unittest.TestCase):
    """Every one of these is told: simulated after all, or a bound above the tolerance with a warning."""

    def assertWarned(self, summary, words):
        self.assertTrue([line for line in summary["warnings"] if words in line], summary["warnings"])

    def test_a_slow_drift_opens_the_contact(self):
        path = scene("drift", normal=0.3, static=-300)
        self.assertIs(effect(run("drift", path), "normal_motion")["simulated"], True)
        forbidden = run("drift_off", path, "effects.normal_motion=off", "response.harmonics=3")
        row = effect(forbidden, "normal_motion")
        self.assertIs(row["simulated"], False)
        self.assertGreater(row["indicator"], 1)
        self.assertWarned(forbidden, "effects.normal_motion: left out")

    def test_forbidden_friction_along_r(self):
        path = scene("across", across=0.4)
        self.assertIs(effect(run("across", path), "second_direction")["simulated"], True)
        forbidden = run("across_off", path, "effects.second_direction=off", "response.harmonics=3")
        self.assertGreater(effect(forbidden, "second_direction")["bound"], 0.02)
        self.assertWarned(forbidden, "effects.second_direction: left out")

    def test_what_is_left_out_stands_beside_every_bar(self):
        # A user who reads the accuracy that was reached alone, or the bar of a curve, is told.
        summary = run("across_asked", scene("across", across=0.4), "effects.second_direction=off", "response.harmonics=3", "accuracy.tolerance=2 %")
        bound = effect(summary, "second_direction")["bound"]
        self.assertGreater(bound, 0.02)
        self.assertLess(summary["accuracy"]["reached"], 0.02)
        told = {"effect": "second_direction", "change": bound}
        self.assertIn(told, summary["accuracy"]["left_out"])
        self.assertEqual([told in curve["bar"]["left_out"] for curve in summary["curves"] if curve["bar"]], [True])
        words = f"left out: second_direction (would change peaks by up to {float(f'{100 * bound:.2g}'):g} %)"
        for file, lines in (("log.txt", ("reached", "peak ±")), ("report.md", ("reached", "| scale_1 |"))):
            with open(os.path.join(FOLDER, "across_asked", file), encoding="utf-8") as text:
                of_bars = [line for line in text if any(key in line for key in lines) and "±" + " |" not in line]
            self.assertGreaterEqual(len(of_bars), 2)
            for line in of_bars:
                self.assertIn(words, line)
        # What is left to the program and simulated stands in none.
        self.assertEqual(run("across", scene("across", across=0.4))["curves"][0]["bar"]["left_out"], [])

    def test_friction_along_r_of_modes_that_meet_or_stand_beside_the_range(self):
        for name in ("veering", "outside"):
            with self.subTest(name):
                path, settings = scene(name, **VALUES[name]), [*CASES[name][1], "response.harmonics=3"]
                self.assertIs(effect(run(name + "_given", path, *settings), "second_direction")["simulated"], True)
                with_it, without = run(name + "_given", path, *settings), run(name + "_off", path, *settings, "effects.second_direction=off")
                row = effect(without, "second_direction")
                change = abs(peaks(with_it)["scale_1"] / peaks(without)["scale_1"] - 1)
                print(f"{name}: friction along r changes the peak by {100 * change:.2f} %, stated {100 * row['bound']:.2f} %")
                self.assertGreater(change, 0.02)
                self.assertGreaterEqual(row["bound"], (1 - 1e-5) * change)
                self.assertWarned(without, "effects.second_direction: left out")

    def test_a_lower_peak_that_an_effect_moves(self):
        # The highest peak moves along p alone and hardly changes; the load of the second one varies.
        path, settings = scene("lower", across=0), ["modal.frequency=[20, 27]", "modal.force_sine=[7, 0.7]", "modal.points[0].phi_u_2=0.1",
                                                    "modal.points[0].phi_v_2=0.2", "response.harmonics=3", "response.frequency=[19, 36]"]
        with_it, without = run("lower", path, *settings), run("lower_off", path, *settings, "effects.normal_motion=off")
        self.assertIs(effect(with_it, "normal_motion")["simulated"], True)
        self.assertLess(abs(peaks(without)["scale_1"] / peaks(with_it)["scale_1"] - 1), 0.01)
        self.assertGreater(effect(without, "normal_motion")["bound"], 0.02)
        self.assertWarned(without, "effects.normal_motion: left out, and having it")

    def test_a_multiple_of_the_frequency_meets_a_mode_and_one_harmonic_is_asked_for(self):
        # The second mode stands at three times the resonance, and only there: off the peak nothing is to be seen.
        summary = run("third", scene("third", preload=12), "response.harmonics=1", "modal.frequency=[20, 63]",
                      "modal.damping_ratio=[0.01, 0.0005]")
        row = effect(summary, "higher_harmonics")
        self.assertIs(row["simulated"], False)
        self.assertNotIn("response.harmonics = 1", row["reason"])
        self.assertIn("without it", row["reason"])
        self.assertGreater(row["bound"], 0.02)
        self.assertWarned(summary, "harmonics up to")

    def test_a_corner_that_is_open_at_rest(self):
        summary = run("corner", f"{SCENES}/chain_2dof_moment.toml", "response.preload=[30]", "response.harmonics=1",
                      "response.maps=[]")
        self.assertGreater(effect(summary, "moments")["indicator"], effect(summary, "moments")["threshold"])
        self.assertIs(effect(summary, "nonlinearity")["simulated"], True)
        without = run("corner_off", f"{SCENES}/chain_2dof_moment.toml", "response.preload=[30]", "response.harmonics=1",
                      "response.maps=[]", "effects.moments=off")
        changes = [abs(amplitude / peaks(without)[name] - 1) for name, amplitude in peaks(summary).items()]
        self.assertGreater(max(changes), 0.02)
        self.assertLess(abs(effect(without, "moments")["bound"] - max(changes)), 0.1 * max(changes))

    def test_a_single_frequency_beside_a_gap(self):
        path = scene("gap", preload=-60, normal=0.5)
        searched = run("gap", path, "response.frequency=22", "response.harmonics=1")
        row = effect(searched, "coexistence")
        self.assertIs(row["simulated"], True)
        self.assertGreater(row["indicator"], row["threshold"])
        self.assertIn("starts found 2 beside", row["reason"])  # the bent resonance, and the unstable one between
        self.assertEqual([curve["detached_branches"] for curve in searched["curves"] if curve["name"] == "scale_1"], [2])
        unsearched = run("gap_off", path, "response.frequency=22", "response.harmonics=1", "effects.coexistence=off")
        self.assertWarned(unsearched, "effects.coexistence: left out")


class WhatMattersIsPutBack(unittest.TestCase):
    """The third harmonic of friction meets a second mode that hardly moves in the linear limits: its normal motion is below the
    limit of the indicator, changes the peak by more than 2 % all the same, and is simulated after all."""

    HIDDEN = ["modal.frequency=[20, 65.58]", "modal.damping_ratio=[0.01, 1e-6]", "modal.force_sine=[7, 0]", "modal.output=[0.75, 0]",
              "modal.points[0].phi_u_2=0.007", "modal.points[0].phi_v_2=0.06", "response.harmonics=3", "response.frequency=[21.5, 22.5]"]

    def runs(self, name, *settings):
        return run(name, scene(name), *self.HIDDEN, *settings)

    def test_what_auto_leaves_out_and_should_not(self):
        auto, on, off = self.runs("hidden"), self.runs("hidden_on", NORMAL), self.runs("hidden_off", "effects.normal_motion=off")
        row = effect(auto, "normal_motion")
        self.assertLess(row["indicator"], row["threshold"])  # before the run nothing was to be seen
        self.assertIs(row["simulated"], True)
        self.assertEqual(row["setting"], "auto")
        self.assertIn("switched on after the run", row["reason"])
        without, with_it = peaks(off)["scale_1"], peaks(on)["scale_1"]
        self.assertLess(abs(row["switched_on"] - abs(without / with_it - 1)), 1e-5)
        self.assertEqual(row["objection"], "")
        for name in ("separation", "mean_coupling"):
            self.assertIs(effect(auto, name)["simulated"], True)
        for curve, amplitude in peaks(on).items():
            if curve in ("free", "stuck"):
                continue
            self.assertLess(abs(peaks(auto)[curve] / amplitude - 1), 1e-6)  # the same equations, solved from another start
            self.assertGreater(abs(peaks(off)[curve] / amplitude - 1), 0.02)
            print(f"{curve}: without normal motion {100 * (peaks(off)[curve] / amplitude - 1):+.2f} %")
        self.assertEqual(len(auto["error_budget"]), len(on["error_budget"]))  # none is left of the curves without

    def test_roughness_of_a_point_that_carries_little_and_matters(self):
        # Nearly all of the load presses a point that hardly moves along the normal: the compression of all, 37 mm, says nothing
        # of the other one, whose surfaces are pressed by 0.08 mm with a height of 1 mm.
        path = scene("uneven", preload=3, normal=0.1)
        with open(path, "a", encoding="utf-8") as file:
            file.write("""[[modal.points]]
weight = 1
tangential_stiffness = 4e4
normal_stiffness = 4e4
friction_coefficient = 0.5
preload = 3000
phi_u_1 = 0.01
phi_u_2 = -0.01
""")
        settings = [*surfaces(height=1e-3), "response.harmonics=3", "modal.force_sine=[3, 0.2]"]
        auto, on, off = (run(f"uneven{name}", path, *settings, *more) for name, more in (
            ("", []), ("_on", ["effects.roughness=on"]), ("_off", ["effects.roughness=off"])))
        row = effect(auto, "roughness")
        self.assertLess(row["indicator"], row["threshold"])
        self.assertEqual((row["simulated"], row["setting"], row["objection"]), (True, "auto", ""))
        self.assertIn("switched on after the run", row["reason"])
        without, with_it = peaks(off)["scale_1"], peaks(on)["scale_1"]
        print(f"uneven: without roughness {100 * (without / with_it - 1):+.2f} %, told {100 * row['switched_on']:.2f} %")
        self.assertGreater(abs(without / with_it - 1), 0.02)
        self.assertLess(abs(row["switched_on"] - abs(without / with_it - 1)), 1e-3)
        self.assertLess(abs(peaks(auto)["scale_1"] / with_it - 1), 1e-5)

    def test_a_motion_in_time(self):
        # One frequency beside the resonance; the force on the second mode nearly balances the stuck contact there.
        settings = ["response.method=time", "response.frequency=21.862", "modal.points[0].phi_u_2=0.017",
                    "modal.force_sine=[7, 0.17]", "modal.damping_ratio=[0.01, 3.5e-4]",
                    "response.steps_per_period=100"]  # thousands of periods, for which located changes take six times as long
        auto, on = self.runs("hidden_time", *settings), self.runs("hidden_time_on", *settings, NORMAL)
        row = effect(auto, "normal_motion")
        self.assertLess(row["indicator"], row["threshold"])
        self.assertIs(row["simulated"], True)
        self.assertGreater(row["switched_on"], 0.02)
        self.assertIn("switched on after the run", row["reason"])
        self.assertLess(abs(peaks(auto)["scale_1"] / peaks(on)["scale_1"] - 1), 1e-5)  # begun with another motion

    def test_what_matters_on_the_refined_model_alone(self):
        # With one harmonic nothing meets the second mode, and leaving its normal motion out is right.
        coarse = self.runs("hidden_coarse", "response.harmonics=1")
        self.assertIs(effect(coarse, "normal_motion")["simulated"], False)
        self.assertLess(effect(coarse, "normal_motion")["bound"], 1e-4)
        refined = self.runs("hidden_refined", "response.harmonics=1", 'accuracy.tolerance="1 %"')
        self.assertTrue(refined["accuracy"]["refined"])
        row = effect(refined, "normal_motion")
        self.assertIs(row["simulated"], True)
        self.assertGreater(row["switched_on"], 0.02)
        self.assertEqual(refined["accuracy"]["message"], "")
        self.assertLessEqual(refined["accuracy"]["reached"], 0.01)

    def test_a_switch_of_the_user_is_obeyed(self):
        self.assertIsNone(effect(self.runs("hidden_on", NORMAL), "normal_motion")["switched_on"])
        off = self.runs("hidden_off", "effects.normal_motion=off")
        row = effect(off, "normal_motion")
        self.assertIs(row["simulated"], False)
        self.assertIsNone(row["switched_on"])
        self.assertTrue([line for line in off["warnings"] if "effects.normal_motion: left out" in line], off["warnings"])

    def test_nothing_is_put_back_where_nothing_is_asked_of_the_errors(self):
        unasked = self.runs("hidden_unasked", "accuracy.error_budget=off")
        self.assertIs(effect(unasked, "normal_motion")["simulated"], False)


class SlipTurnsAPatch(unittest.TestCase):
    """A block driven along p on an area that is loaded unevenly along r: every spring is the same, so that neither linear limit
    turns it about the normal, and the indicator of friction along r is rounding. Where it slips friction turns it, near the
    resonance of turning above all: each of these is seen by another check after the run, and friction along r put back."""

    CURVE = "preload_20"

    def settings(self, turning_hz, moment, to_hz):
        stiffness = 0.003 * (2 * math.pi * turning_hz) ** 2  # inertia about q times its frequency squared
        return ["contact.roughness=", "contact.cells=[2, 2]", 'excitation.forces=[{ at = [0, "-30 mm", 0], force = ["5 N", 0, 0] }]',
                f'contact.preload_moment=["{moment} N*m", 0]', f"model.rotational_stiffness=[90, {stiffness}, 110]",
                "response.harmonics=1", "response.maps=[]", "response.preload=[20]", f'response.frequency=["18 Hz", "{to_hz} Hz"]']

    def compare(self, name, *values):
        """The rows of friction along r: `auto`, and switched off."""
        settings = self.settings(*values)
        auto, off, on = (run(f"{name}_{setting}", f"{SCENES}/block_rough.toml", *settings, f"effects.second_direction={setting}")
                         for setting in ("auto", "off", "on"))
        row, without = effect(auto, "second_direction"), effect(off, "second_direction")
        self.assertLess(row["indicator"], row["threshold"])
        self.assertIs(row["simulated"], True)
        self.assertGreater(row["switched_on"], 0.02)
        self.assertEqual(peaks(auto).keys(), peaks(on).keys())
        for curve, amplitude in peaks(on).items():
            self.assertLess(abs(peaks(auto)[curve] / amplitude - 1), 1e-6)
        change = self.largest_change(f"{name}_off", f"{name}_on")
        print(f"{name}: friction along r changes the peak by {100 * abs(peaks(off)[self.CURVE] / peaks(on)[self.CURVE] - 1):.2f} %, "
              f"the curve somewhere by {100 * change:.1f} % of it; told {100 * row['switched_on']:.1f} %")
        self.assertGreater(change, 0.02)
        self.assertTrue([line for line in off["warnings"] if "effects.second_direction: left out" in line], off["warnings"])
        return row, without

    def curve(self, name):
        with open(os.path.join(FOLDER, name, "curves", self.CURVE + ".csv"), encoding="utf-8") as file:
            return [(float(row["frequency_Hz"]), float(row["amplitude_m"])) for row in csv.DictReader(file)]

    def largest_change(self, one, other):
        """Of amplitudes at a frequency, over the highest; neither curve folds."""
        points, line = self.curve(one), self.curve(other)
        largest = 0.0
        for frequency, amplitude in points:
            for (f0, a0), (f1, a1) in zip(line, line[1:]):
                if f0 <= frequency <= f1 and f0 < f1:
                    largest = max(largest, abs(a0 + (a1 - a0) * (frequency - f0) / (f1 - f0) - amplitude))
        return largest / max(amplitude for _, amplitude in points)

    def test_the_peaks_tell(self):
        _, without = self.compare("turning_peaks", 23, 0.2, 30)
        self.assertGreater(without["bound"], 0.02)

    def test_a_solution_point_tells_though_no_peak_does(self):
        _, without = self.compare("turning_point", 24, 0.1, 34)
        self.assertLess(without["bound"], 0.01)
        self.assertIn("solution points of a curve the one that seems to change most", without["objection"])

    def test_a_solution_point_tells_though_the_peak_leaves_the_range(self):
        _, without = self.compare("turning_outside", 24, 0.1, 29.9)
        self.assertIsNone(without["bound"])
        self.assertIn("its height is not compared", without["reason"])


class WhatOtherKeysGiveIsSwitchedOff(unittest.TestCase):
    """An effect that other keys give, "off": the curves are those without, and the bound is what having it changes."""

    LAW = 'contact.friction_law={ law = "exponential", static = 0.5, kinetic = 0.4, rate = 2 }'
    ROUGH = 'contact.roughness={ law = "cubic", height = "1 mm" }'
    # The third "mode" is a static shape that stands for omitted ones.
    SHAPE = ["modal.frequency=[20, 52, 300]", "modal.attachment=1", "modal.force_sine=[7, 0.5, 0]", "modal.output=[0.75, 0.5, 0]",
             "modal.force_static=[0, 0, 0]", "modal.points[0].phi_u_3=0.6"]
    BLADE = ['model.element_size="15 mm"', "response.harmonics=1",
             'response.preload=["static"]', 'response.frequency=["330 Hz", "430 Hz"]', 'static.speed="2000 rpm"', "response.maps=[]"]

    @classmethod
    def setUpClass(cls):
        # Blades share mesh and modes; a curve taken for that of another scene would not differ from it.
        cls.blades = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.blades.cleanup)

    def compare(self, name, path, settings, without):
        """@param without  settings under which no other key gives the effect; None: no scene is without."""
        settings = [*settings, "response.harmonics=3"] if "response.harmonics=1" not in settings else settings
        cache = self.blades.name if "blade_" in path else "off"
        off = run(name + "_off", path, *settings, f"effects.{name}=off", cache=cache)
        on = run(name + "_given", path, *settings, NO_ERRORS, cache=cache)
        if without is not None:
            gone = run(name + "_gone", path, *without, "response.harmonics=3", NO_ERRORS)
            self.assertEqual(peaks(off), peaks(gone))
        row = effect(off, name)
        self.assertIs(row["simulated"], False)
        self.assertIs(effect(on, name)["simulated"], True)
        self.assertIn(f'effects.{name} = "off" leaves out', row["reason"])
        solved = [curve for curve in peaks(off) if curve not in ("free", "stuck")]
        change = max(abs(peaks(on)[curve] / peaks(off)[curve] - 1) for curve in solved)
        print(f"{name:16} changes the peak by {100 * change:.3f} %, stated {100 * row['bound']:.3f} %, indicator {row['indicator']}")
        self.assertGreater(change, 1e-3)  # else nothing is compared
        self.assertGreaterEqual(row["bound"], (1 - 1e-5) * change)
        self.assertLess(row["bound"], 1.2 * change + 0.02)  # frequencies count as well
        self.assertEqual(row["objection"] != "", row["bound"] > 0.02)
        if name in ("roughness", "rate_dependence"):  # looked at again at every solution point
            self.assertGreater(float(str(row["along_curves"]["indicator"]).replace("infinite", "inf")), 0.0)
            self.assertIn(row["along_curves"]["curve"], solved)
        return off

    def test_roughness(self):
        self.compare("roughness", scene("rough", normal=0.2), [self.ROUGH], [])

    def test_a_law_of_the_speed(self):
        off = self.compare("rate_dependence", scene("law"), [self.LAW], [])
        self.assertGreater(effect(off, "rate_dependence")["indicator"], 0.01)

    def test_static_shapes(self):
        self.compare("residual", scene("shape"), self.SHAPE, [])

    def test_moments(self):
        path, settings = f"{SCENES}/chain_2dof_moment.toml", ["response.preload=[50]", "response.maps=[]"]
        off = self.compare("moments", path, settings, None)
        row = effect(off, "moments")
        self.assertGreater(row["indicator"], row["threshold"])

    def test_moments_of_a_motion_that_turns_the_area(self):
        block = run("block", f"{SCENES}/block_rough.toml", "response.harmonics=1", "response.preload=[40]", "response.maps=[]",
                    "effects.moments=off", "effects.roughness=off")
        along = effect(block, "moments")["along_curves"]
        self.assertGreater(along["indicator"], 0.0)
        self.assertTrue(18.0 <= along["frequency_Hz"] <= 40.0)

    def test_the_shape_of_a_static_preload(self):
        off = self.compare("static_preload", f"{SCENES}/blade_static_preload.toml", self.BLADE, None)
        self.assertGreater(effect(off, "static_preload")["indicator"], 0.1)

    def test_rotation(self):
        off = self.compare("centrifugal", f"{SCENES}/blade_static_preload.toml", [s.replace("2000", "500").replace("330 Hz", "300 Hz") for s in self.BLADE], None)
        self.assertGreater(effect(off, "centrifugal")["indicator"], 1e-4)

    def test_a_range_that_only_the_rotating_blade_has_a_peak_in(self):
        path, settings = f"{SCENES}/blade_static_preload.toml", ['model.element_size="20 mm"', "response.harmonics=1", "response.maps=[]",
                                                                 'response.preload=["static"]', "contact.points=96"]
        cache = self.blades.name
        off, on = run("still", path, *settings, "effects.centrifugal=off", cache=cache), run("turning", path, *settings, NO_ERRORS, cache=cache)
        self.assertGreater(peaks(on)["preload_static"], 5 * peaks(off)["preload_static"])
        row = effect(off, "centrifugal")
        self.assertIsNone(row["bound"])
        self.assertIn("no peak within its range to compare: the resonance nearest to the range changes by +21 %", row["reason"])
        self.assertTrue([line for line in off["warnings"] if "effects.centrifugal: left out" in line], off["warnings"])
        limits = run("limits", path, *settings, "effects.centrifugal=off", 'response.preload=["free", "stuck"]', cache=cache)
        self.assertIn("+21 %", effect(limits, "centrifugal")["reason"])
        self.assertIn("no bound was made of what it would change: no curve under a load", effect(limits, "nonlinearity")["reason"])

    def test_check_tells_indicators_of_what_a_mesh_leaves_out(self):
        settings = ['model.element_size="20 mm"', "response.harmonics=1", "response.maps=[]", "contact.points=96",
                    "response.preload=[100]", "response.optimum=", "response.optimum_range="]

        def told(*off):
            command = [PROGRAM, "check", f"{SCENES}/blade_to_ground.toml"]
            for setting in settings + [f"effects.{name}=off" for name in off]:
                command += ["--set", setting]
            text = subprocess.run(command, capture_output=True, text=True, check=True,
                                  env={**without_plots(), "MICROSLIP_CACHE": self.blades.name}).stdout
            rows = [line.split() for line in text.splitlines() if line.startswith("  ")]
            return {words[0]: (words[1], words[3]) for words in rows if len(words) > 6}

        given = told()
        for name in ("moments", "residual"):
            (there, indicator), (gone, the_same) = given[name], told(name)[name]
            self.assertEqual((there, gone), ("yes", "no"))
            self.assertNotEqual(indicator, "-")
            self.assertEqual(the_same, indicator)

    def test_where_errors_are_not_asked_for_it_is_said_that_there_is_no_bound(self):
        summary = run("unbounded", scene("law"), self.LAW, "response.harmonics=3", "effects.rate_dependence=off", NO_ERRORS)
        row = effect(summary, "rate_dependence")
        self.assertIsNone(row["bound"])
        self.assertIn('no bound was made of what it would change: accuracy.error_budget = "off"', row["reason"])

    def test_a_motion_in_time_has_a_bound(self):
        settings = ["response.method=time", "response.frequency=22", "effects.normal_motion=off"]
        off, on = run("time_off", scene("time", normal=0.3), *settings), run("time_on", scene("time", normal=0.3), *settings[:2])
        row = effect(off, "normal_motion")
        self.assertAlmostEqual(row["bound"], abs(peaks(on)["scale_1"] / peaks(off)["scale_1"] - 1), delta=1e-4)
        self.assertNotEqual(row["objection"], "")

    def test_the_mean_alone(self):
        # A static force presses, or pulls: the load that the vibration meets is another one.
        for static in (-60, 200):
            with self.subTest(static):
                path = scene(f"mean_{abs(static)}", normal=0.3, static=static)
                off = run(f"mean_off_{abs(static)}", path, "response.harmonics=3", "effects.mean_coupling=off")
                on = run(f"mean_on_{abs(static)}", path, "response.harmonics=3")
                row = effect(off, "mean_coupling")
                true = abs(peaks(on)["scale_1"] / peaks(off)["scale_1"] - 1)
                print(f"static force {static}: the mean changes the peak by {100 * true:.2f} %, stated {100 * row['bound']:.2f} %")
                self.assertIs(row["simulated"], False)
                self.assertGreater(true, 0.02)
                self.assertGreaterEqual(row["bound"], (1 - 1e-5) * true)
                self.assertGreater(row["indicator"], row["threshold"])
                self.assertGreater(row["along_curves"]["indicator"], row["threshold"])
                self.assertTrue([line for line in off["warnings"] if "effects.mean_coupling: left out" in line], off["warnings"])
        still = effect(run("mean_still", scene("mean_still", normal=0.01), NORMAL, "response.harmonics=3", "effects.mean_coupling=off"),
                       "mean_coupling")
        self.assertLess(still["bound"], 1e-3)
        self.assertEqual(still["objection"], "")

    def test_effects_that_hide_each_other(self):
        path = scene("both_off", normal=0.2, across=0.3)
        off = run("both_off", path, "response.harmonics=3", "effects.normal_motion=off", "effects.second_direction=off")
        on = run("both_on", path, "response.harmonics=3")
        true = abs(peaks(on)["scale_1"] / peaks(off)["scale_1"] - 1)
        for name in ("normal_motion", "second_direction"):
            row = effect(off, name)
            self.assertGreaterEqual(row["bound_together"], (1 - 1e-5) * true)
            self.assertGreater(abs(row["bound_together"] - row["bound"]), 0.01)
        self.assertIn("with normal_motion + second_direction put back together", effect(off, "normal_motion")["reason"])

    def test_stability_wear_and_maps_change_no_curve(self):
        path, given = scene("told_off"), ['response.maps=["peak"]', "response.limits=true", "contact.wear_coefficient=1e-13", "response.harmonics=3"]
        on = run("told_given", path, *given)
        off = run("told_off", path, *given, "effects.stability=off", "effects.wear=off", "effects.maps=off")
        self.assertEqual(peaks(off), peaks(on))
        for name in ("stability", "wear", "maps"):
            self.assertIs(effect(on, name)["simulated"], True)
            self.assertIs(effect(off, name)["simulated"], False)
        verdicts = {name: self.column(name, "scale_1", "stable") for name in ("told_given", "told_off")}
        self.assertEqual(set(verdicts["told_off"]), {"-1"})
        self.assertIn("1", verdicts["told_given"])
        self.assertEqual(len(verdicts["told_off"]), len(verdicts["told_given"]))
        self.assertEqual(set(self.column("told_off", "stuck", "stable")), {"-1"})
        self.assertTrue(os.listdir(os.path.join(FOLDER, "told_given", "maps")))
        self.assertFalse(os.path.exists(os.path.join(FOLDER, "told_off", "maps")))

    def test_results_that_are_kept_are_those_of_the_same_scene(self):
        settings = ['model.element_size="15 mm"', "response.harmonics=3", "response.preload=[100]", "response.optimum=",
                    "response.optimum_range=", "response.maps=[]", NO_ERRORS, 'contact.roughness={ law = "cubic", height = "20 um" }']

        def kept(number, setting):
            return run(f"kept_{number}", f"{SCENES}/blade_to_ground.toml", *settings, f"effects.roughness={setting}")["curves"][0]

        with tempfile.TemporaryDirectory() as cache, unittest.mock.patch.dict(os.environ, MICROSLIP_CACHE=cache):
            first, off, again = kept(1, "on"), kept(2, "off"), kept(3, "on")
        self.assertEqual(again["seconds"], first["seconds"])  # as it took when it was solved
        self.assertEqual(again["peak"], first["peak"])
        self.assertGreater(abs(off["peak"]["amplitude_m"] / first["peak"]["amplitude_m"] - 1), 0.02)

    def column(self, run_name, curve, name):
        with open(os.path.join(FOLDER, run_name, "curves", curve + ".csv"), encoding="utf-8") as file:
            return [row[name] for row in csv.DictReader(file)]

    def test_separation_that_does_not_come_changes_nothing(self):
        summary = run("closed", scene("closed", normal=0.01), "effects.separation=off", "response.harmonics=3", NORMAL)
        row = effect(summary, "separation")
        self.assertIs(row["simulated"], False)
        self.assertEqual(row["bound"], 0)


# What the scene has no key for: a short reason, and nothing is lost.
NOT_GIVEN = {"roughness", "rate_dependence", "moments", "residual", "local_frames", "static_preload", "centrifugal", "wear"}


class NothingIsHidden(unittest.TestCase):
    def test_what_is_left_out_has_a_cost_or_the_reason_why_none(self):
        told = subprocess.run([PROGRAM, "check", "--json", scene("costs", normal=0.01, across=0.1), "--set", "response.harmonics=3",
                               "--set", "effects.normal_motion=off", "--set", "effects.second_direction=off"], capture_output=True, text=True,
                              check=True, env=without_plots())
        rows = json.loads(told.stdout.splitlines()[-1])["effects"]
        left_out = [row for row in rows if row["simulated"] is False]
        self.assertGreater(len(left_out), 5)
        for row in left_out:
            if row["name"] not in NOT_GIVEN:
                self.assertEqual(row["seconds"] is None, "no cost is told: " in row["reason"], row)

    def test_no_effect_stays_undecided_and_none_that_is_left_out_is_without_its_loss(self):
        summary = run("told", scene("told", normal=0.01, across=0.1), "response.maps=[\"peak\"]", "effects.normal_motion=off",
                      "effects.second_direction=off")
        for row in summary["effects"]:
            self.assertIsNotNone(row["simulated"], row)
            if row["name"] in NOT_GIVEN:
                self.assertNotIn("; without it", row["reason"])
            elif not row["simulated"]:
                self.assertIn("; without it", row["reason"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
