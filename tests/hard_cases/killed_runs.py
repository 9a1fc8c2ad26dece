#!/usr/bin/env python3
"""A run that is killed at any instant, and resumed.

Hard: SIGKILL cannot be answered. What stands in the folder at that instant is all that --resume has, and all that
a user sees until then: it must neither claim to be complete nor have cost an earlier run's results or a file of the
user's own.
Right: summary.json never says 0 of a run that was killed, nothing is torn, and --resume (killed again a few times)
gives the curves, modes and maps of the undisturbed run byte for byte. Interrupts (SIGINT) leave exit code 3, a
summary and no lock.

usage: killed_runs.py MICROSLIP WORK_FOLDER [N] [SEED] [SCENE]     prints a table; N random kills, 40 by default, 1000 where
MICROSLIP_CAMPAIGNS=whole; the seed is 1 by default. SCENE is lean (modes and points in the file, by default) or blade: meshed
by a process of its own, modes, attachment shapes, curves with three harmonics and maps.
"""
import collections
import filecmp
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "verification"))
from program_run import whole_campaigns, without_plots

LEAN = """
title = "lean"
[model]
kind = "modal"
[modal]
frequency = [15.9, 41.4]
damping_ratio = 0.01
force_sine = [0.0, 0.3]
output = [0.9, 0.35]
points = [ {{ weight = 1, tangential_stiffness = 1e4, normal_stiffness = 1e4, friction_coefficient = 0.3, preload = 2, \
phi_u_1 = 0.8, phi_u_2 = -0.5, phi_v_1 = 0.1 }} ]
[response]
frequency = [{low}, 30]
preload_scale = [0.5, 1, 2, 4, 8, 16]
maps = ["peak"]
map_phases = 4
"""
BLADE = """
title = "blade"
[model]
kind = "blade"
element_size = "12 mm"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["root"]
[modes]
count = 6
damping_ratio = 0.002
[contact]
surface = "contact"
slip_direction = [0, 1, 0]
friction_coefficient = 0.4
normal_stiffness = 1e11
tangential_stiffness = 1e11
[excitation]
forces = [ {{ at = "B", direction = [1, 0, 0], amplitude = 0.5 }} ]
[response]
output = {{ at = "A", direction = [1, 0, 0] }}
frequency = ["{low} Hz", "345 Hz"]
harmonics = 3
preload = [-500, 100, 300, 1000, "stuck"]
maps = ["peak"]
map_phases = 4
[accuracy]
error_budget = "off"
"""
# Text, two begins of the range, of the scene and of an earlier run, and how long a run may take [s].
SCENES = {"lean": (LEAN, (10, 11), 60), "blade": (BLADE, (290, 291), 900)}
COMPARED = ("curves", "maps", "modes.csv", "model.h5", "scene.toml")
OWN = {"curves/mine.csv": "mine", "plots/mine.txt": "mine too"}


def files_of(folder):
    """Those that must be equal, relative to the folder."""
    found = set()
    for name in COMPARED:
        path = os.path.join(folder, name)
        for inside, _, names in os.walk(path):
            found |= {os.path.relpath(os.path.join(inside, file), folder) for file in names}
        if os.path.isfile(path):
            found.add(name)
    return found - set(OWN)


def differences(folder, reference):
    """Files that are missing, too many or other."""
    here, there = files_of(folder), files_of(reference)
    other = {name for name in here & there
             if not filecmp.cmp(os.path.join(folder, name), os.path.join(reference, name), shallow=False)}
    return sorted((here ^ there) | other)


class Campaign:
    def __init__(self, program, work, seed, scene):
        self.program, self.work = program, work
        text, begins, self.patience = SCENES[scene]
        self.random = random.Random(seed)
        self.counts = collections.Counter()
        self.failures = []
        shutil.rmtree(work, ignore_errors=True)
        os.makedirs(work)
        for name, low in zip(("scene", "earlier"), begins):
            with open(self.path(name + ".toml"), "w", encoding="utf-8") as file:
                file.write(text.format(low=low))
        begin = time.monotonic()
        self.complete("scene", "reference")
        self.duration = time.monotonic() - begin
        self.complete("earlier", "earlier")

    def path(self, *names):
        return os.path.join(self.work, *names)

    def command(self, scene, folder, *options):
        return [self.program, "run", self.path(scene + ".toml"), "-q", "-j", "2", "-o", self.path(folder), *options]

    def complete(self, scene, folder, *options):
        finished = subprocess.run(self.command(scene, folder, *options), capture_output=True, text=True,
                                  timeout=self.patience, env=without_plots())
        if finished.returncode != 0:
            raise RuntimeError(f"run {scene}, {options} ended with {finished.returncode}: {finished.stderr}")

    def stop(self, folder, stopping, *options):
        """Starts a run and sends it a signal after a random time. The exit code; negative: of the signal."""
        process = subprocess.Popen(self.command("scene", folder, *options), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, env=without_plots())
        time.sleep(self.random.uniform(0.0, 1.1 * self.duration))
        process.send_signal(stopping)
        return process.wait(timeout=self.patience)

    def look(self, folder, code):
        """What a stopped run may look like."""
        summary = self.path(folder, "summary.json")
        if not os.path.exists(summary):
            return "not begun"
        with open(summary, encoding="utf-8") as file:
            said = json.load(file)
        if said["exit_code"] == 0:
            if not differences(self.path(folder), self.path("reference")):
                return "ended before"
            if differences(self.path(folder), self.path("earlier")):
                raise AssertionError("summary.json says 0 of a run that was stopped")
            return "not begun"
        if code >= 0 and os.path.exists(self.path(folder, ".lock")):
            raise AssertionError("a lock is left")
        return "interrupted" if code == 3 else "killed"

    def case(self, number):
        folder = f"case_{number}"
        over_earlier = self.random.random() < 0.5
        if over_earlier:
            shutil.copytree(self.path("earlier"), self.path(folder))
            for name, text in OWN.items():
                os.makedirs(os.path.dirname(self.path(folder, name)), exist_ok=True)
                with open(self.path(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
        stopping = signal.SIGINT if self.random.random() < 0.2 else signal.SIGKILL
        before = len(files_of(self.path(folder)))
        outcome = "not begun"
        options = ()
        for _ in range(self.random.randint(1, 3)):
            code = self.stop(folder, stopping, *options)
            if over_earlier and not os.path.exists(self.path(folder, "summary.json")):
                outcome = "killed"
            else:
                outcome = self.look(folder, code)
            if over_earlier and len(files_of(self.path(folder))) < before:
                raise AssertionError("files of the earlier run are gone")
            if outcome == "ended before":
                break
            options = self.going_on(folder)
        self.counts[outcome + (", over an earlier run" if over_earlier else "")] += 1
        self.complete("scene", folder, *self.going_on(folder))
        other = differences(self.path(folder), self.path("reference"))
        if other:
            raise AssertionError(f"other than the undisturbed run: {', '.join(other[:5])}")
        for name, text in OWN.items() if over_earlier else ():
            with open(self.path(folder, name), encoding="utf-8") as file:
                if file.read() != text:
                    raise AssertionError(f"{name} is not what it was")
        shutil.rmtree(self.path(folder))

    def going_on(self, folder):
        """--resume, where a run of this scene has begun; a new run elsewhere."""
        return ("--resume",) if os.path.exists(self.path(folder, "checkpoint", "scene.toml")) else ()

    def run(self, n):
        for number in range(n):
            try:
                self.case(number)
            except (AssertionError, RuntimeError, subprocess.TimeoutExpired) as failure:
                self.failures.append(f"case {number}: {failure}")
        print(f"{n} runs stopped within {1.1 * self.duration:.2f} s of their start, then resumed:")
        for outcome, count in sorted(self.counts.items()):
            print(f"  {outcome:40s} {count:6d}")
        print(f"  {'not as the undisturbed run':40s} {len(self.failures):6d}")
        print("\n".join(self.failures))
        return 1 if self.failures else 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    asked = [int(word) for word in sys.argv[3:5]]
    cases = asked[0] if asked else 1000 if whole_campaigns() else 40
    scene = sys.argv[5] if len(sys.argv) > 5 else "lean"
    sys.exit(Campaign(sys.argv[1], sys.argv[2], asked[1] if len(asked) > 1 else 1, scene).run(cases))
