#!/usr/bin/env python3
"""A run whose n-th allocation, write, opening, renaming or making of a folder fails, for every n or for some.

Hard: each of these calls fails on somebody's machine, at the one place that nobody tried; after a failed allocation even
an error is hard to tell.
Right: exit code 4 (1: an input could not be opened) with words, or 0 where the run can do without; never a signal, code 5
or a hang. No file is torn: what stands in the folder is that of the undisturbed run, without `.part` and `.lock`, and
summary.json does not say 0 of a run that failed.

usage: failing_calls.py MICROSLIP LIBRARY WORK_FOLDER [N] [SEED]     LIBRARY: tests/support/fail_nth.c. Prints a table. Of each
kind of call N are made to fail, evenly spread and begun at random (10 by default), every second time with all that follow; where
MICROSLIP_CAMPAIGNS=whole all of them, of allocations 1000.
"""
import collections
import filecmp
import json
import os
import random
import resource
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "verification"))
from killed_runs import LEAN, files_of
from program_run import whole_campaigns, without_plots

# HDF5 1.10 follows a null pointer where an allocation of its own fails (H5F_open), and so does udunits 2.2 (utparse): not ours to mend.
SPARED = {"FAIL_NOT_IN": "libhdf5,libudunits2"}
CALLS = ("malloc", "open", "write", "rename", "mkdir")
SECONDS = 60  # of wall time: some twenty are one fifth of a second each
FEWER = LEAN.replace("0.5, 1, 2, 4, 8, 16", "1").replace("map_phases", "harmonics = 1\nmap_phases") + '[accuracy]\nerror_budget = "off"\n'


class Campaign:
    def __init__(self, program, interposer, work):
        self.program, self.interposer, self.work = program, interposer, work
        self.counts = collections.Counter()
        self.failures = []
        shutil.rmtree(work, ignore_errors=True)
        os.makedirs(work)
        with open(self.path("scene.toml"), "w", encoding="utf-8") as file:
            file.write(FEWER.format(low=10))
        code, words = self.run("reference", {})
        if code != 0:
            raise RuntimeError(f"undisturbed: {code}: {words}")

    def path(self, *names):
        return os.path.join(self.work, *names)

    def run(self, folder, failing):
        command = [self.program, "run", self.path("scene.toml"), "-q", "-j", "1", "--without", "plots", "-o", self.path(folder)]
        # Kernels that are chosen: the program does not start itself again with others, and without what fails its calls.
        environment = {"OPENBLAS_CORETYPE": "Prescott", **without_plots(), "OPENBLAS_NUM_THREADS": "1", **SPARED, **failing}
        try:
            finished = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=SECONDS, errors="replace")
        except subprocess.TimeoutExpired:
            return "hangs", ""
        return finished.returncode, finished.stderr

    def number_of(self, call):
        """How often an undisturbed run makes this call."""
        self.run("counted", {"LD_PRELOAD": self.interposer, "FAIL_CALL": call, "FAIL_COUNT": self.path("count")})
        shutil.rmtree(self.path("counted"))
        with open(self.path("count"), encoding="utf-8") as file:
            return int(file.read())

    def case(self, call, at, goes_on):
        failing = {"LD_PRELOAD": self.interposer, "FAIL_CALL": call, "FAIL_AT": str(at)} | ({"FAIL_ON": "1"} if goes_on else {})
        folder = "case"
        code, words = self.run(folder, failing)
        problems = list(self.problems(folder, code, words))
        self.counts[call, code] += 1
        if problems:
            self.counts[call, "WRONG"] += 1
            self.failures.append(f"{call} {at}{' and on' if goes_on else ''}: {'; '.join(problems)}")
        shutil.rmtree(self.path(folder), ignore_errors=True)

    def problems(self, folder, code, words):
        if code not in (0, 1, 4):
            yield f"ends with {code}: {words.strip()[-300:]}"
        if code != 0 and not words.strip():
            yield "no words"
        here, there = self.path(folder), self.path("reference")
        for name in sorted(files_of(here)):
            if not os.path.exists(os.path.join(there, name)) or not filecmp.cmp(os.path.join(here, name), os.path.join(there, name), shallow=False):
                yield f"{name} is torn"
        if code == 0 and files_of(here) != files_of(there):
            yield f"0, but without {', '.join(sorted(files_of(there) - files_of(here)))}"
        # Without memory nothing can be cleared away; the next run does, as after `kill -9`.
        left = [name for _, _, names in os.walk(here) for name in names if name.endswith(".part") or name == ".lock"]
        if left and "out of memory" not in words:
            yield f"left behind: {', '.join(left)}"
        yield from self.said(os.path.join(here, "summary.json"), code)

    @staticmethod
    def said(summary, code):
        if not os.path.exists(summary):
            return
        with open(summary, encoding="utf-8") as file:
            try:
                said = json.load(file)["exit_code"]
            except ValueError:
                yield "summary.json is torn"
                return
        if said == 0 and code != 0:
            yield f"summary.json says 0 of a run that ended with {code}"

    def report(self):
        codes = sorted({code for _, code in self.counts if code != "WRONG"}, key=str)
        print(f"{'':10s}" + "".join(f"{f'exit {code}':>10s}" for code in codes) + f"{'WRONG':>10s}")
        for call in CALLS:
            print(f"{call:10s}" + "".join(f"{self.counts[call, code]:10d}" for code in [*codes, "WRONG"]))
        print("\n".join(self.failures))
        return 1 if self.failures else 0


def main(program, interposer, work, n, seed):
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    campaign = Campaign(program, interposer, work)
    draw = random.Random(seed)
    for call in CALLS:
        total = campaign.number_of(call)
        tried = min(total, n.get(call, total))
        begin = draw.random()
        for i in range(tried):
            campaign.case(call, 1 + int((i + begin) * total / tried), i % 2 == 1)
        print(f"{call}: {tried} of {total}", flush=True)
    return campaign.report()


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    asked = [int(word) for word in sys.argv[4:]]
    whole = whole_campaigns() and not asked
    of_each = {"malloc": 1000} if whole else dict.fromkeys(CALLS, asked[0] if asked else 10)
    sys.exit(main(*sys.argv[1:4], of_each, asked[1] if len(asked) > 1 else 1))
