#!/usr/bin/env python3
"""The program on several MPI ranks: the results of one rank, one log, and no rank that stays behind.

usage: mpi_ranks.py MICROSLIP SOURCE WORK_FOLDER
"""
import csv
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest

from program_run import without_plots

PROGRAM, SOURCE, WORK = sys.argv[1:4]
del sys.argv[1:4]
sys.path.insert(0, os.path.join(SOURCE, "tests", "support"))
from plate_model import plate_model

SCENES = os.path.join(SOURCE, "share", "scenes")
BLADE = os.path.join(SCENES, "blade_to_ground.toml")
NUMPY = os.path.join(SCENES, "plate_numpy.toml")
PLATE = os.path.join(SCENES, "plate_matrices.toml")
COARSE = ["--set", "model.element_size=10 mm", "--set", "response.harmonics=1", "--set", "response.optimum=", "--set",
          "response.optimum_range=", "--set", "response.preload=[300]", "--set", "response.maps=[]", "--set",
          "accuracy.error_budget=off", "--without", "plots"]
SEVERAL = ["--set", "response.preload=[9, 10]", "--set", "response.maps=[]", "--without", "plots"]
# Four curves of some seconds each; of those below none takes less than five on one core.
SLOW = [*COARSE, "--set", "response.harmonics=15", "--set", "response.preload=[100, 200, 300, 500]"]
LONG = [*SEVERAL, "--set", "response.harmonics=41", "--set", "response.preload=[7, 8, 9, 10]"]
ENVIRONMENT = {**without_plots(), "MICROSLIP_CACHE": "off", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
SOLVED = 1e-9  # of a sum in another order, after the solver's tolerance
MPIRUN = shutil.which("mpirun")


def path(name):
    return os.path.join(WORK, name)


def on_ranks(n, *words):
    return ([MPIRUN, "--oversubscribe", "-n", str(n)] if n > 1 else []) + [PROGRAM, *words]


def call(command, code=0):
    """Standard error of a command, which must end with this code; one that hangs fails."""
    ended = subprocess.run(command, capture_output=True, text=True, env=ENVIRONMENT, timeout=120)
    assert ended.returncode == code, f"{command}: {ended.returncode}\n{ended.stdout}\n{ended.stderr}"
    return ended.stderr


def summary(folder):
    with open(os.path.join(path(folder), "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def children_of(pid):
    found = []
    for task in os.listdir(f"/proc/{pid}/task"):
        with open(f"/proc/{pid}/task/{task}/children", encoding="utf-8") as file:
            found += file.read().split()
    return found


def rank_of(pid):
    with open(f"/proc/{pid}/environ", encoding="utf-8", errors="replace") as file:
        return next(int(entry[21:]) for entry in file.read().split("\0") if entry.startswith("OMPI_COMM_WORLD_RANK="))


def starve(process, rank, spare=0):
    """Of mpirun's, this one may not grow any more, but for some spare bytes."""
    pid = next(int(pid) for pid in children_of(process.pid) if rank_of(pid) == rank)
    with open(f"/proc/{pid}/statm", encoding="utf-8") as file:
        size = int(file.read().split()[0]) * resource.getpagesize() + spare
    resource.prlimit(pid, resource.RLIMIT_AS, (size, size))


def history(folder):
    with open(path(f"{folder}/history.csv"), encoding="utf-8") as file:
        return list(csv.reader(file))[1:]


def started(folder, scene, *options, command="run"):
    """On two ranks."""
    return subprocess.Popen(on_ranks(2, command, scene, *options, "-q", "-o", path(folder)), env=ENVIRONMENT,
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def await_file(name):
    while not os.path.exists(path(name)):
        time.sleep(0.02)


def table(*names):
    with open(path(os.path.join(*names)), encoding="utf-8") as file:
        return [[float(value) for value in row] for row in list(csv.reader(file))[1:]]


@unittest.skipUnless(MPIRUN, "mpirun is not installed: apt-get install openmpi-bin")
class Ranks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)

    def near(self, found, expected):
        self.assertLess(abs(found / expected - 1.0), SOLVED, f"{found} against {expected}")

    def compare(self, scene, *options):
        for n in (1, 2):
            self.error = call(on_ranks(n, "run", scene, *options, "-o", path(f"on_{n}")))
        one, two = summary("on_1"), summary("on_2")
        self.assertEqual(len(two["modes"]), len(one["modes"]))
        for found, expected in zip(two["modes"], one["modes"]):
            self.near(found["frequency_Hz"], expected["frequency_Hz"])
        for found, expected in zip(two["curves"], one["curves"]):
            for key in ("frequency_Hz", "amplitude_m"):
                self.near(found["peak"][key], expected["peak"][key])

    def test_the_blade_is_that_of_one_rank_and_the_log_comes_once(self):
        self.compare(BLADE, *COARSE)
        self.assertEqual(self.error.count("mode  1:"), 1)
        self.assertEqual(self.error.count("2 MPI ranks"), 1)

    def test_matrices_of_another_code(self):
        self.compare(PLATE, "--set", "response.preload=[20]", "--set", "response.maps=[]", "--set", "accuracy.error_budget=off",
                     "--without", "plots")

    def test_curves_are_shared_and_the_same_to_the_last_bit(self):
        """Of given modes, which do not depend on the ranks; at first and where the accuracy asked for has them solved again."""
        for n in (1, 2):
            error = call(on_ranks(n, "run", NUMPY, *SEVERAL, "--set", "contact.points=24", "--tolerance", "0.2%", "-o", path(f"shared_{n}")))
        shares = re.findall(r"curves solved on each MPI rank: (\d+), (\d+)", error)
        self.assertEqual(shares, [("1", "1")] * 2, error)
        names = sorted(os.listdir(path("shared_1/curves")))
        self.assertEqual(sorted(os.listdir(path("shared_2/curves"))), names)
        for name in names:
            with open(path(f"shared_1/curves/{name}"), "rb") as one, open(path(f"shared_2/curves/{name}"), "rb") as two:
                self.assertTrue(one.read() == two.read(), f"{name} differs")
        self.assertEqual(sorted(row[:9] for row in history("shared_2")), sorted(row[:9] for row in history("shared_1")))

    def test_a_budget_ends_all(self):
        """Of given modes: on a busy machine those of the blade alone may take the whole budget."""
        for n in (1, 2):
            begin = time.monotonic()
            error = call(on_ranks(n, "run", NUMPY, *LONG, "--budget", "4s", "-o", path(f"late_{n}")), code=4)
            self.assertLess(time.monotonic() - begin, 15.0)
            # Which one is told: whether the time is over when the curves have used up their shares.
            self.assertRegex(error, "out of time|its share of accuracy.budget, [0-9.]+ s, is over")
            self.assertNotIn("was ended", error)  # every curve has ended by itself
            self.assertEqual(len(summary(f"late_{n}")["curves"]), 4)

    @unittest.skipIf("ASAN_OPTIONS" in os.environ, "AddressSanitizer ends what may not grow")
    def test_a_curve_that_fails_on_another_rank_fails_the_run(self):
        """Rank 1 has memory to read the scene, which rank 0 still does, and not for so many harmonics."""
        process = started("unlucky", NUMPY, *SEVERAL, "--set", "response.harmonics=25")
        await_file("unlucky/summary.json")
        starve(process, 1, spare=8_000_000)
        error = process.communicate(timeout=100)[1]
        self.assertEqual(process.returncode, 4, error)
        self.assertEqual(summary("unlucky")["exit_code"], 4)
        self.assertIn("memory", summary("unlucky")["message"])

    def test_an_interrupt_within_curves_ends_all_and_keeps_points(self):
        process = started("stopped_in_curves", BLADE, *SLOW)
        await_file("stopped_in_curves/history.csv")
        while len({row[0] for row in history("stopped_in_curves")}) < 2:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)
        self.assertNotEqual(process.returncode, 0)
        self.assertEqual(summary("stopped_in_curves")["exit_code"], 3)
        self.assertIn("interrupted", summary("stopped_in_curves")["message"])
        curves = summary("stopped_in_curves")["curves"]
        self.assertGreaterEqual(len(curves), 2)
        self.assertFalse(any(curve["complete"] for curve in curves))

    def test_speeds_one_after_the_other(self):
        scene = path("rotating.toml")
        with open(scene, "w", encoding="utf-8") as file:
            file.write(plate_model(f"{SCENES}/plate/coarse.inp") +
                       '[static]\naxis = { origin = [0, "-200 mm", 0], direction = [0, 0, 1] }\n[modes]\ncount = 4\n')
        for n in (1, 2):
            call(on_ranks(n, "campbell", scene, "--speeds", "0", "3000 rpm", "3", "-q", "-o", path(f"speeds_{n}")))
        for found, expected in zip(*(table(f"speeds_{n}", "campbell", "frequencies.csv") for n in (2, 1))):
            for value, reference in zip(found[1:], expected[1:]):
                self.near(value, reference)

    def test_commands_that_solve_nothing_answer_once(self):
        ended = subprocess.run(on_ranks(2, "--version"), capture_output=True, text=True, env=ENVIRONMENT, timeout=60, check=True)
        self.assertEqual(ended.stdout.count("microslip "), 1)

    def test_what_is_wrong_is_told_once_and_all_leave(self):
        error = call(on_ranks(2, "run", PLATE, "--set", 'contact.surface="contract"', "-o", path("wrong")), code=1)
        self.assertEqual(error.count('no surface is named "contract"'), 1)
        self.assertEqual(call(on_ranks(2, "fly"), code=1).count("unknown command"), 1)

    def test_what_all_ranks_refuse_is_told_once(self):
        error = call(on_ranks(2, "modes", PLATE, "--set", "modes.count=100000", "-o", path("refused")), code=1)
        self.assertEqual(error.count("microslip: "), 1)

    @unittest.skipIf("ASAN_OPTIONS" in os.environ, "AddressSanitizer ends what may not grow")
    def test_what_fails_on_one_rank_alone_ends_all(self):
        """Rank 1 may not grow any more while rank 0 still meshes: it fails within what both solve."""
        process = started("starved", BLADE, "--set", "model.element_size=6 mm", command="modes")
        await_file("starved/summary.json")
        starve(process, 1)
        error = process.communicate(timeout=100)[1]
        self.assertEqual(process.returncode, 4, error)

    def test_an_interrupt_ends_all_and_leaves_a_summary(self):
        process = started("stopped", BLADE)
        await_file("stopped/summary.json")
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)
        self.assertNotEqual(process.returncode, 0)
        self.assertEqual(summary("stopped")["exit_code"], 3)
        self.assertIn("interrupted", summary("stopped")["message"])

    def test_more_ranks_than_cores_are_warned_of(self):
        n = os.cpu_count() + 1
        self.assertIn(f"{n} MPI ranks share {n - 1} cores", call(on_ranks(n, "modes", PLATE, "-o", path("crowd"))))


if __name__ == "__main__":
    unittest.main(verbosity=2)
