#!/usr/bin/env python3
"""Peaks as exact as was asked for: [accuracy] tolerance against references that are refined far beyond.

Every scene is run with tolerances; each peak is compared with that of the same scene with many harmonics, of a blade given
by its modes with the truth of their mesh that keeps every contact node (share/reference/truth_blade_10mm.csv), of one that is
meshed with finer elements and more contact points as well. The table tells what was asked for, the bar of the run, the true error and the
seconds of processor, beside those of the cheapest fixed settings whose error is as small: of a grid of harmonics, meshed blades
of element sizes as well, found with the reference in hand, which nobody has who asks. In CI a few lean scenes at two
tolerances, without the grid; all of them with MICROSLIP_CAMPAIGNS=whole, those whose name holds ASKED_ACCURACY_ONLY if
that is set, and asked_accuracy.csv in the work folder.

A budget of time is kept, and bad values of both are refused in a line.

usage: asked_accuracy.py MICROSLIP SOURCE WORK_FOLDER
"""
import csv
import json
import os
import re
import resource
import shutil
import statistics
import subprocess
import sys
import time
import unittest

import meshio
import numpy as np

from program_run import run_scene, whole_campaigns, without_plots

PROGRAM, SOURCE, WORK = sys.argv[1:4]
del sys.argv[1:]
BARE = ("response.maps=[]",)
MANY = ("response.harmonics=25",)
MANY_OF_BAR = (*MANY, "modes.count=80")  # ten are 0.5 % off, these 0.03 %
MESHED = ("model.element_size=10 mm",)
FINE = "fine"  # the reference has modes of small elements, without their error (extrapolated, as a tolerance has it)
FINE_MESH = (("model.element_size=2.5 mm", "model.edge_size=0.5 mm"), ("--tolerance", "50%"))
TRUTH = "truth"  # the reference is that of the coarse blade, by preload


def preload(*values):
    return f"response.preload=[{', '.join(str(value) for value in values)}]"


class Case:
    def __init__(self, file, settings=(), reference=MANY, in_ci=False, finest=0.0):
        self.file, self.settings, self.reference, self.in_ci = file, settings, reference, in_ci
        self.finest = finest  # tolerance that the reference can judge

    @property
    def is_blade(self):
        return self.file.startswith("blade")

    @property
    def is_meshed(self):
        return self.is_blade and self.reference != TRUTH

    def scene(self):
        return scene_of_modes(self.file, MESHED) if self.reference == TRUTH else scene(self.file)


# at 70 a solution beside the curve has a higher peak with more harmonics: no error of the curve's
CASES = {
    "chain, gap to stuck": Case("chain_3dof_normal", (preload(0, 50, 100, 600),), in_ci=True),
    "chain, constant load": Case("chain_2dof", (preload(10, 30, 100),), in_ci=True),
    "bar, slipping end": Case("bar_constant_1000", reference=MANY_OF_BAR, in_ci=True),
    "bar, larger force": Case("bar_constant_3100", reference=MANY_OF_BAR),
    "bar, uneven load": Case("bar_quadratic_1000", reference=MANY_OF_BAR),
    "bar, uneven, larger": Case("bar_quadratic_3100", reference=MANY_OF_BAR),
    "chain, open": Case("chain_3dof_normal", (preload(-20, -5),)),
    "chain, best preload": Case("chain_3dof_normal", (preload(70, 85, 100),), in_ci=True),
    "chain, low friction": Case("chain_3dof_normal", ("contact.points[0].friction_coefficient=0.1", preload(30, 60))),
    "patch with a moment": Case("chain_2dof_moment", (preload(50, 200),)),
    "rough block, two directions": Case("block_rough", (preload(10, 40),), ("response.harmonics=13",)),
    # to 1 % these take more than a quarter of an hour
    "meshed blade, slipping": Case("blade_to_ground", (*MESHED, preload(100)), FINE, finest=0.03),
    "meshed blade, nearly stuck": Case("blade_to_ground", (*MESHED, preload(1000)), FINE, finest=0.03),
    "meshed blade along y": Case("blade_to_ground_y", (*MESHED, preload(5)), FINE, finest=0.03),
    # what friction along r adds to the truth is known with nine harmonics: to 0.3 % it cannot judge
    **{f"blade along {force}, {load} N": Case(file, (preload(load),), TRUTH, in_ci=(force, load) == ("x", 500), finest=0.01)
       for force, file, loads in (("x", "blade_to_ground", (-500, 100, 267, 500, 3000)),
                                  ("y", "blade_to_ground_y", (-20, 2, 5, 10, 100)))
       for load in loads},
}
OUTSIDE = 3.0  # of what was asked for: no run may be
HARMONICS = (1, 3, 5, 7, 9, 13, 17)
SIZES = ("10 mm", "6 mm", "4 mm")
ONLY = os.environ.get("ASKED_ACCURACY_ONLY", "")
ASKED = (0.1, 0.03, 0.01, 0.003) if whole_campaigns() else (0.03, 0.003)


def scene(name):
    """A scene of the repository without its best value."""
    with open(os.path.join(SOURCE, "share", "scenes", name + ".toml"), encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("optimum")]
    path = os.path.join(WORK, name + ".toml")
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(lines)
    return path


def summary(folder):
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def peaks(folder):
    """(amplitude, frequency) of the highest point by curve."""
    highest = {}
    for curve in summary(folder)["curves"]:
        with open(os.path.join(folder, "curves", curve["name"] + ".csv"), encoding="utf-8") as file:
            rows = csv.DictReader(line for line in file if not line.startswith("#"))
            highest[curve["name"]] = max((float(row["amplitude_m"]), float(row["frequency_Hz"])) for row in rows)
    return highest


def truth(force, load):
    """(amplitude, frequency) with the most harmonics; what friction along r adds is that of the most that have it."""
    with open(os.path.join(SOURCE, "share", "reference", "truth_blade_10mm.csv"), encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["force"] == force and float(row["preload_N"]) == load]
    along = {directions: {int(row["harmonics"]): (float(row["peak_um"]), float(row["peak_Hz"]))
                          for row in rows if row["directions"] == directions} for directions in ("p", "pr")}
    amplitude, frequency = along["p"][max(along["p"])]
    both = max(along["pr"], default=None)
    added = [with_r / without for with_r, without in zip(along["pr"][both], along["p"][both])] if both else (1, 1)
    return 1e-6 * amplitude * added[0], frequency * added[1]


def scene_of_modes(name, mesh, options=()):
    """A scene of the blade by modes and static shapes of a mesh, as another code would give them: a tolerance cuts the elements of
    a mesh, and with them what a truth of that mesh judges."""
    path = os.path.join(WORK, name + "_of_" + "".join(filter(str.isalnum, "".join(mesh))))
    if not os.path.exists(path + ".toml"):
        folder = run_scene(PROGRAM, scene(name), path, *BARE, *mesh, "response.preload=['stuck']", "modes.count=25",
                           options=options)
        solved = meshio.read(os.path.join(folder, "modes.vtu"))
        modes = summary(folder)["modes"]
        shapes = np.array([solved.point_data[f"mode_{number}"] for number in range(1, len(modes) + 1)])
        frequency = np.array([mode["frequency_Hz"] for mode in modes])
        static = np.array([mode["kind"] == "attachment" for mode in modes])
        np.savez(path + ".npz", nodes=solved.points, frequency_Hz=frequency[~static], shapes=shapes[~static],
                 attachment_frequency_Hz=frequency[static], attachment_shapes=shapes[static])
        with open(scene(name), encoding="utf-8") as file:
            meshed = file.read()
        given = (f'[model]\nkind = "modes"\nfile = "{path}.npz"\nmesh = "{folder}/mesh.msh"\nmass_unit = "kg"\n'
                 '[modes]\nresidual = "attachment"\ndamping_ratio = "0.2 %"\n')
        with open(path + ".toml", "w", encoding="utf-8") as file:
            file.write(re.sub(r"\[model\].*(?=\[contact\])", lambda _: given, meshed, flags=re.DOTALL))
    return path + ".toml"


def processor_seconds():
    """Of all programs that have been run."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def measured(*arguments, **options):
    """The run folder, and what the run took."""
    before = processor_seconds()
    folder = run_scene(PROGRAM, *arguments, **options)
    return folder, processor_seconds() - before


def true_errors(folder, reference):
    """The larger one of amplitude and frequency, by curve."""
    return {curve: max(abs(amplitude / reference[curve][0] - 1), abs(frequency / reference[curve][1] - 1))
            for curve, (amplitude, frequency) in peaks(folder).items()}


def fixed_settings(case):
    """What somebody would try who knew the answer."""
    sizes = [(f"model.element_size={size}",) for size in SIZES] if case.is_meshed else [()]
    return [(*size, f"response.harmonics={n}") for size in sizes for n in HARMONICS]


def tried(case, reference):
    """(seconds, largest error) of each fixed setting."""
    results = []
    for fixed in fixed_settings(case):
        folder, seconds = measured(case.scene(), os.path.join(WORK, "fixed"), *BARE, *case.settings, *fixed,
                                   "accuracy.error_budget=off")
        results.append((seconds, max(true_errors(folder, reference).values())))
    return results


def cheapest(tries, asked):
    """Seconds of the cheapest one that is as exact; None: none is."""
    return min((seconds for seconds, error in tries if error <= asked), default=None)


def program(*arguments, environment=None):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300,
                          env=environment or without_plots())


class AskedAccuracy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)

    def reference_of(self, name, case):
        if case.reference == TRUTH:
            force, load = name.removeprefix("blade along ").removesuffix(" N").split(", ")
            return {f"preload_{load}": truth(force, float(load))}
        fine = scene_of_modes(case.file, *FINE_MESH) if case.is_meshed else case.scene()
        settings = (case.settings[-1], "contact.points=800", *MANY) if case.is_meshed else (*case.settings, *case.reference)
        return peaks(run_scene(PROGRAM, fine, os.path.join(WORK, "reference"), *BARE, *settings, "accuracy.error_budget=off"))

    def rows_of(self, name, case):
        """A row for every curve and every tolerance."""
        reference = self.reference_of(name, case)
        tries = tried(case, reference) if whole_campaigns() else []
        for asked in [one for one in ASKED if one >= case.finest]:
            folder, seconds = measured(case.scene(), os.path.join(WORK, "run"), *BARE, *case.settings,
                                       options=("--tolerance", str(asked)))
            result = summary(folder)
            self.assertLessEqual(result["accuracy"]["reached"], asked, name)
            told = {c["name"]: c["bar"] for c in result["curves"]}
            for curve, true in true_errors(folder, reference).items():
                self.assertIsNotNone(told[curve], (name, curve))
                yield {"scene": name, "curve": curve, "asked": asked, "told": told[curve]["peak_amplitude"], "true": true,
                       "seconds": seconds, "fixed_seconds": cheapest(tries, asked)}

    def test_peaks_are_as_exact_as_was_asked_for(self):
        print(f"{'scene':28} {'curve':12} {'asked':>7} {'told':>8} {'true':>8} {'run':>8} {'fixed':>8}")
        rows = []
        for name, case in CASES.items():
            if ONLY not in name or (not case.in_ci and not whole_campaigns()):
                continue
            for row in self.rows_of(name, case):
                fixed = f"{row['fixed_seconds']:6.1f} s" if row["fixed_seconds"] else ""
                print(f"{name:28} {row['curve']:12} {100 * row['asked']:6.2g}% {100 * row['told']:7.2g}% "
                      f"{100 * row['true']:7.2g}% {row['seconds']:6.1f} s {fixed}", flush=True)
                rows.append(row)
        with open(os.path.join(WORK, "asked_accuracy.csv"), "w", newline="", encoding="utf-8") as table:
            writer = csv.DictWriter(table, rows[0], lineterminator="\n")
            writer.writeheader()
            writer.writerows({key: f"{value:.3g}" if isinstance(value, float) else value for key, value in row.items()}
                             for row in rows)
        errors = [row["true"] / row["asked"] for row in rows]
        effectivities = [row["told"] / row["true"] for row in rows if row["true"] > 1e-6 and row["told"] > 1e-6]
        within = sum(error <= 1 for error in errors) / len(errors)
        print(f"within what was asked for: {100 * within:.1f} % of {len(errors)}, the worst {max(errors):.2f} of it; "
              f"told over true: median {statistics.median(effectivities):.2f}")
        ratios = {(row["scene"], row["asked"]): row["seconds"] / row["fixed_seconds"] for row in rows if row["fixed_seconds"]}
        if ratios:
            print(f"seconds over those of the cheapest fixed settings: median {statistics.median(ratios.values()):.2f}, "
                  f"at most 2 in {sum(ratio <= 2 for ratio in ratios.values())} of {len(ratios)} runs")
        self.assertGreaterEqual(within, 0.95)
        self.assertLessEqual(max(errors), OUTSIDE)

    def test_a_budget_is_kept(self):
        allowed = 4
        begin = time.monotonic()
        run = program("run", scene("chain_3dof_normal"), "-q", "-j1", "--tolerance", "2e-4", "--budget", f"{allowed} s",
                      "-o", os.path.join(WORK, "budget"), "--set", "response.maps=[]", "--set", "response.harmonics=1")
        seconds = time.monotonic() - begin
        result = summary(os.path.join(WORK, "budget"))
        self.assertEqual(run.returncode, 4, run.stderr)
        self.assertEqual(result["exit_code"], 4)
        self.assertLess(seconds, allowed + 2.0)
        self.assertIn("out of time", result["message"])
        self.assertTrue(all(curve["complete"] for curve in result["curves"]))
        self.assertGreater(result["accuracy"]["reached"], 2e-4)

    def test_a_mesh_and_modes_end_in_time(self):
        """The mesh is kept by the first command, so that the others have the whole budget for the modes: 160 of them are not begun;
        those of a rotating blade, which the forecast knows nothing of, are ended, in curves where the machine is fast."""
        environment = {**without_plots(), "MICROSLIP_CACHE": os.path.join(WORK, "cache")}
        sized = ("--set", "model.element_size=4 mm")
        mesh = program("mesh", scene("blade_to_ground"), *sized, "-o", os.path.join(WORK, "m.msh"), environment=environment)
        self.assertEqual(mesh.returncode, 0, mesh.stderr)
        rotating = ("--set", "static.axis={origin=[0,-0.3,0],direction=[0,0,1]}", "--set", "static.speed=314")
        for stages, budget, settings in ((("modes",), 4, (*sized, "--set", "modes.count=160")),
                                         (("modes", "contact", "curves", "accuracy", "report"), 4, (*sized, *rotating)),
                                         (("mesh",), 3, ("--set", "model.element_size=0.8 mm"))):
            with self.subTest(settings):
                folder = os.path.join(WORK, f"meshed_{len(settings)}")  # in that of an earlier run its summary would stay
                begin = time.monotonic()
                run = program("run", scene("blade_to_ground"), "-q", "-j1", "--budget", f"{budget} s", "-o", folder,
                              "--without", "plots", "--without", "maps", *settings, environment=environment)
                seconds = time.monotonic() - begin
                result = summary(folder)
                print(f"{budget} s, ended after {seconds:.1f} s in {result['stages'][-1]['name']}: {run.stderr.strip()}")
                self.assertEqual((run.returncode, result["exit_code"]), (4, 4), run.stderr)
                self.assertIn("out of time", result["message"])
                last = result["stages"][-1]["name"]
                self.assertIn(last, stages)
                if last in ("mesh", "modes"):
                    self.assertIn("larger elements", run.stderr)
                self.assertLess(seconds, budget + 2.0)

    def test_every_kind_of_run_ends_in_time(self):
        lean = ("--without", "plots", "--without", "maps")
        for name, allowed, settings in (
                ("block_rough", 4, ("response.harmonics=auto", "response.preload=[10, 40]")),
                ("chain_2dof", 1, ("response.harmonics=auto", "response.optimum=preload",
                                   'response.optimum_range=["10 N", "100 N"]')),
                ("chain_3dof_normal", 0.02, ('response.frequency=["24 Hz", "24 Hz"]', "response.preload=[10, 50]",
                                          "accuracy.tolerance=0.01"))):
            folder = os.path.join(WORK, "short")
            settings = [word for setting in settings for word in ("--set", setting)]
            command = ("run", scene(name), "-q", "-j1", "--budget", f"{allowed} s", "-o", folder, *lean, *settings)
            for _ in range(3):  # on a shared machine a step between two looks at the clock may wait for others
                shutil.rmtree(folder, ignore_errors=True)
                begin = time.monotonic()
                run = program(*command)
                seconds = time.monotonic() - begin
                if seconds < allowed + 2.0:
                    break
            result = summary(folder)
            self.assertEqual((run.returncode, result["exit_code"]), (4, 4), (name, run.stderr))
            if "out of time" not in result["message"]:  # the share of one of two curves may be over before the whole
                self.assertIn("its share of accuracy.budget", " ".join(curve["message"] for curve in result["curves"]), result)
            self.assertLess(seconds, allowed + 2.0, name)
            for curve in result["curves"]:  # what was not looked at is not called exact
                self.assertTrue(curve["bar"] is None or curve["bar"]["peak_amplitude"] > 0, (name, curve["bar"]))

    def test_bad_values_are_refused_in_a_line(self):
        chain = scene("chain_2dof")
        for arguments, said in ((("run", chain, "--tolerance", "-1%"), "accuracy.tolerance"),
                                (("run", chain, "--tolerance", "2 mm"), "accuracy.tolerance"),
                                (("run", chain, "--tolerance", "exact"), "off"),
                                (("run", chain, "--budget", "0 s"), "accuracy.budget"),
                                (("run", chain, "--tolerance", "1%", "--set", "accuracy.error_budget=off"), "error_budget"),
                                (("init", "chain", "--tolerance", "1%"), "--tolerance")):
            run = program(*arguments, *(("-o", os.path.join(WORK, "none")) if arguments[0] == "run" else ()))
            self.assertEqual(run.returncode, 1, arguments)
            self.assertIn(said, run.stderr)
            self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
