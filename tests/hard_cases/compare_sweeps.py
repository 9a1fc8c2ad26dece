#!/usr/bin/env python3
"""Random scenes (random_runs.py) swept up, down and in five parts of their range: three walks that share no point.

Hard: a step to another part of a branch goes over folds, an even number of which no check of one walk tells.
Right: every fold of one is one of the others, and so is the highest peak. Parts begin at solutions of their own and may be on
another branch: what they alone have is told apart from what sweeps up and down do not agree on.

usage: compare_sweeps.py MICROSLIP WORK_FOLDER N SEED [LAW ...]      N scenes with these laws or, by default, all; friction in a plane,
whose scenes take long, is left out. Prints a line for each that differs, and the counts. Exit code 1: a sweep up and one down differ.
"""
import json
import os
import re
import shutil
import subprocess
import sys

from random_runs import CAP, scene_of
from program_run import without_plots  # found by random_runs

SAME = 1e-6  # relative, of folds and the highest peak
PARTS = 5


def ends_of(text):
    """Of the range of frequencies, and how it is written."""
    written = re.search(r"^frequency = (\[[^\]]*\])$", text.split("[response]")[1], re.M).group(1)
    return json.loads(written), written


def swept(program, folder, name, text, ends):
    """What the summary says of the curve; None: it is not complete within the time of a random run."""
    scene, run = os.path.join(folder, name + ".toml"), os.path.join(folder, name)
    head, tail = text.split("[response]")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(head + "[response]" + tail.replace(ends_of(text)[1], repr(ends)))
    code = subprocess.run([program, "run", scene, "-q", "-j", "1", "-o", run, "--without", "plots", "--set", f'response.time_budget="{CAP} s"'],
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=without_plots(), check=False).returncode
    if code != 0:
        return None
    with open(os.path.join(run, "summary.json"), encoding="utf-8") as file:
        return json.load(file)["curves"][0]


def lacks(curve, folds):
    """Folds that are none of the curve's."""
    own = list(curve["folds_Hz"])
    missing = []
    for fold in folds:
        near = next((one for one in own if abs(one - fold) <= SAME * fold), None)
        if near is None:
            missing.append(fold)
        else:
            own.remove(near)
    return missing


def highest(curve):
    return max((peak["amplitude_m"] for peak in curve["peaks"]), default=0.0)


def differences(program, folder, text):
    """Those of sweeps up and down, and what parts have more; None: one of the sweeps is not complete."""
    (begin, end), _ = ends_of(text)
    up, down = (swept(program, folder, *way) for way in (("up", text, [begin, end]), ("down", text, [end, begin])))
    if up is None or down is None:
        return None
    between = [f"{name} lacks folds at {missing} Hz" for name, missing in
               (("up", lacks(up, down["folds_Hz"])), ("down", lacks(down, up["folds_Hz"]))) if missing]
    if abs(highest(up) - highest(down)) > SAME * highest(up):
        between.append(f"highest peaks {highest(up)} and {highest(down)} m")
    cuts = [begin + (end - begin) * i / PARTS for i in range(PARTS + 1)]
    parts = [swept(program, folder, f"part_{i}", text, cuts[i:i + 2]) for i in range(PARTS)]
    known = {"folds_Hz": up["folds_Hz"] + lacks(up, down["folds_Hz"])}
    more = lacks(known, [fold for part in parts if part for fold in part["folds_Hz"]])
    return between, [f"parts have more folds at {more} Hz"] if more else []


def main(program, work, n, seed, laws):
    shutil.rmtree(work, ignore_errors=True)
    counts = dict.fromkeys(("compared", "not complete", "up and down differ", "parts have more"), 0)
    for number in range(n):
        (kind, law, harmonics), text, _ = scene_of(seed, number)
        if kind == "planar" or (laws and law not in laws):
            continue
        folder = os.path.join(work, str(number))
        os.makedirs(folder)
        found = differences(os.path.abspath(program), folder, text)
        counts["not complete" if found is None else "compared"] += 1
        between, more = found or ([], [])
        counts["up and down differ"] += bool(between)
        counts["parts have more"] += bool(more)
        if between or more:
            print(f"{seed}.{number} ({kind} {law} {harmonics}): " + "; ".join(between + more), flush=True)
        else:
            shutil.rmtree(folder)
    print(", ".join(f"{name} {count}" for name, count in counts.items()))
    return 1 if counts["up and down differ"] else 0


if __name__ == "__main__":
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:3], int(sys.argv[3]), int(sys.argv[4]), sys.argv[5:]))
