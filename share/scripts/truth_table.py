#!/usr/bin/python3
"""Signed errors of the program's choices against the truth of the coarse default blade.

The truth (share/reference/truth_blade_10mm.csv) is printed by build/tests/truth_blade, a program of its
own that keeps every contact node. Two commands:

  truth_table.py compare RUN_FOLDER …              errors of every curve of given run folders
  truth_table.py table MICROSLIP [-o FILE.md] [--only WORD,…] [--force x,y] [--work FOLDER] [--limit SECONDS]
                                                   runs the program over its choices and writes the table
  truth_table.py time                              the truth integrated in time beside its balance

Two errors stand in each row, in per cent of the peak amplitude and of its frequency. "alone" compares with
the truth of the same harmonics and directions: what the choice of this row does by itself. "in all"
compares with the truth of the most harmonics and both directions that is stored: what a user gets.
Runs are kept in the work folder and not repeated; a run that takes longer than the limit is said to.
"""
import argparse
import csv
import json
import os
import re
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
REFERENCE = os.path.join(ROOT, "share", "reference", "truth_blade_10mm.csv")
IN_TIME = os.path.join(ROOT, "share", "reference", "truth_time_10mm.csv")
PRELOADS = {"x": [-500, 100, 267, 500, 3000], "y": [-20, 2, 5, 10, 100]}
SCENES = {"x": "blade_to_ground", "y": "blade_to_ground_y"}

INTRODUCTION = """\
# The program against the truth of the coarse default blade

    share/scripts/truth_table.py table build/bin/microslip -o share/doc/truth.md     # rewrites this page, in half an hour

The truth keeps every contact node (`tests/verification/truth/`, printed by `build/tests/truth_blade`, stored in
`share/reference/truth_blade_10mm.csv`). A part is computed anew and compared in every test run (`ctest -V -R truth_compared`).

Errors are those of the peak, amplitude / frequency in per cent. *Alone*: against the truth with as many harmonics and
directions, what the choice of a row does by itself. *In all*: against the truth of the most harmonics, what a user gets.
Unless a row says otherwise there are ten modes, attachment shapes, one harmonic, friction along p alone, elements of 10 mm."""
NOT_KNOWN = """
## What the tables say

* With as many harmonics as the truth the program errs by less than 0.5 %, frequencies by less than 0.03 %: attachment shapes, cells, fit and
  sampling together. What is left of the error is the number of harmonics.
* Without static shapes (`none`) or with paper A's row sum (`stiffness`) ten modes err by up to 7 and 12 %.
* With harmonics chosen to 0.25 %, for which those up to 40 are asked and as many modes solved for as they reach, the peak errs by 0.14 % at most along x, its
  frequency by 0.005 %. With ten modes these are 1.0 and 0.05 %, and 30 harmonics with 26 modes are 0.7 % low at −500 N: what comes next resonates.
* With harmonics chosen to 1 % the peak errs by 1.2 % at most and its frequency by 0.06 %, along x and along y, against the truth of 21 or 41. Nine
  harmonics do as well along x; along y they are 5 % off at 5 N and 2 % at 2 N.
* Convergence is not monotone: at a gap of −500 N the truth is 1305 µm with 9 harmonics, 1232 with 11, 1242 with 13, 1339 with 15, 1320 with 17 and
  1316 with 41; swept in time it is 1310 µm ([theory, section 22](theory.md#22-which-harmonics-matter)).
* Integrated in time, without any harmonics, the truth agrees with its balance to 0.05 % where that has enough of them, which at 100 N are 31: 21 are 1.1 % too
  high. At 150 N nine are 5 % too high (in time the amplitude there still falls by 0.3 % in ten periods, after 300), at 60 N 0.8 %. Integrated are the motions of
  every shape, attachment shapes as well, from the peak of the balance with nine harmonics, at three and more frequencies (`build/tests/truth_blade --harmonics 9
  --periods 300 --steps 512`; four to ten minutes a row).
* Why integration in time and balance with 21 harmonics differ by 2 % at 267 N and 330.58 Hz is in the same section: attachment shapes
  resonate at harmonics 22 to 41.
* At 267 N with nine harmonics the branch turns back and forth many times between 328 and 330 Hz: an internal resonance with the second
  mode, near three times the frequency."""


def read_truth(path=REFERENCE):
    """{(force, preload, directions, harmonics): row} of the complete curves."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["complete"] == "1"]
    return {(r["force"], float(r["preload_N"]), r["directions"], int(r["harmonics"])): r for r in rows}


def best_truth(truth, force, preload):
    """The row of most harmonics; with both directions if that was computed with as many."""
    keys = [k for k in truth if k[:2] == (force, preload)]
    return truth[max(keys, key=lambda k: (k[3], k[2] == "pr"))] if keys else None


def errors(peak, row):
    """Signed relative errors (amplitude, frequency), None without a reference."""
    if row is None or peak is None:
        return None
    return (1e6 * peak["amplitude_m"] / float(row["peak_um"]) - 1.0,
            peak["frequency_Hz"] / float(row["peak_Hz"]) - 1.0)


def solved_peak(curve):
    """None where the largest value lies at an end of the range."""
    peak = curve.get("peak")
    return None if peak and peak.get("at") == "range_end" else peak


def read_run(folder):
    """(force, {preload: peak}, harmonics, directions) of a run folder."""
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    with open(os.path.join(folder, "scene.toml"), encoding="utf-8") as file:
        scene = file.read()
    found = re.search(r'at = "B", direction = \[([^\]]*)\]', scene)
    along_y = bool(found) and float(found.group(1).split(",")[1]) != 0.0
    harmonics = re.search(r"^harmonics = (\d+)", scene, re.M)
    second = re.search(r'^second_direction = "(\w+)"', scene, re.M)
    peaks = {float(c["preload_N"]): solved_peak(c) for c in summary["curves"]
             if isinstance(c["preload_N"], (int, float))}
    return ("y" if along_y else "x", peaks, int(harmonics.group(1)) if harmonics else None,
            "pr" if second and second.group(1) == "on" else "p")


def percent(pair):
    return "–" if pair is None else f"{100 * pair[0]:+.2f} / {100 * pair[1]:+.3f}"


def compare(folders):
    truth = read_truth()
    print("run, preload [N]: peak; error of amplitude / frequency [%]: alone; in all")
    for folder in folders:
        force, peaks, harmonics, directions = read_run(folder)
        for preload, peak in sorted(peaks.items()):
            if peak is None:
                continue
            alone = errors(peak, truth.get((force, preload, directions, harmonics)))
            in_all = errors(peak, best_truth(truth, force, preload))
            print(f"{folder} {preload:g}: {1e6 * peak['amplitude_m']:.2f} um at "
                  f"{peak['frequency_Hz']:.3f} Hz; {percent(alone)}; {percent(in_all)}")


def cases():
    """[(group, label, settings)]: what is varied, the rest as in `base`."""
    result = [("default", "nine harmonics, as `blade_to_ground.toml` has", {"response.harmonics": 9}),
              ("default", "harmonics chosen to 1 %", {"response.harmonics": '"auto"', "response.harmonic_tolerance": 0.01}),
              ("default", "harmonics chosen to 0.25 %", {"response.harmonics": '"auto"', "response.harmonic_tolerance": 0.0025})]
    for residual in ("none", "stiffness", "attachment"):
        for count in (5, 10, 20, 40, 80):
            result.append(("modes", f"{count} modes, {residual}",
                           {"modes.count": count, "modes.residual": f'"{residual}"'}))
    for degree in (0, 1, 2, 3):
        result.append(("degree", f"attachment degree {degree}", {"modes.attachment_degree": degree}))
    for harmonics in (1, 3, 5, 7, 9, 13):
        result.append(("harmonics", f"{harmonics} harmonics", {"response.harmonics": harmonics}))
    for points in (96, 384, 1536, 6144):
        result.append(("cells", f"at least {points} cells", {"contact.points": points}))
    for fit in ("none", "auto", 2, 4, 6):
        value = f'"{fit}"' if isinstance(fit, str) else fit
        result.append(("fit", f"fit {fit}", {"contact.fit": value}))
    for harmonics in (1, 9):
        result.append(("directions", f"both directions, {harmonics} harmonics",
                       {"effects.second_direction": '"on"', "response.harmonics": harmonics}))
    for size in ("10 mm", "6 mm"):
        result.append(("mesh", f"elements of {size}", {"model.element_size": f'"{size}"'}))
    return result


BASE = {"model.element_size": '"10 mm"', "modes.residual": '"attachment"', "modes.count": 10,
        "response.harmonics": 1, "effects.second_direction": '"off"', "response.maps": "[]",
        "accuracy.error_budget": '"off"'}


def scene_text(force):
    """The scene of the blade without its search of the best preload, with the preloads of the truth."""
    path = os.path.join(ROOT, "share", "scenes", SCENES[force] + ".toml")
    with open(path, encoding="utf-8") as file:
        text = file.read()
    text = re.sub(r"^(optimum|optimum_range)\s*=.*\n", "", text, flags=re.M)
    return re.sub(r"^preload\s*=.*$", f"preload = {PRELOADS[force]}", text, flags=re.M)


def run_folder(work, force, settings):
    return os.path.join(work, force + "".join(
        "_" + re.sub(r"\W", "", f"{k.split('.')[1]}{v}") for k, v in sorted(settings.items())))


def run_case(program, work, force, settings, limit):
    """Folder, seconds and a word on what happened."""
    folder = run_folder(work, force, settings)
    note = os.path.join(folder, "truth_note.json")
    if os.path.exists(note):
        with open(note, encoding="utf-8") as file:
            return folder, *json.load(file)
    os.makedirs(work, exist_ok=True)
    scene = os.path.join(work, SCENES[force] + ".toml")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(scene_text(force))
    command = [program, "run", scene, "-q", "--without", "plots", "-o", folder]
    for key, value in {**BASE, **settings}.items():
        command += ["--set", f"{key}={value}"]
    start = time.monotonic()
    try:
        ended = subprocess.run(command, capture_output=True, text=True, timeout=limit, check=False)
        lines = ended.stderr.strip().splitlines()
        word = "" if ended.returncode == 0 else f"exit {ended.returncode}: {lines[-1] if lines else ''}"
    except subprocess.TimeoutExpired:
        word = f"stopped after {limit:.0f} s"
    seconds = time.monotonic() - start
    os.makedirs(folder, exist_ok=True)
    with open(note, "w", encoding="utf-8") as file:
        json.dump([seconds, word], file)
    return folder, seconds, word


def table_rows(folder, label, settings, force, seconds, word, truth):
    try:
        _, peaks, _, _ = read_run(folder)
    except (OSError, ValueError, KeyError):
        return [f"| {label} | {word or 'no result'} |" + " |" * (2 * len(PRELOADS[force])) + f" {seconds:.0f} |"]
    merged = {**BASE, **settings}
    harmonics = merged["response.harmonics"]
    directions = "pr" if merged["effects.second_direction"] == '"on"' else "p"
    cells = []
    for preload in PRELOADS[force]:
        peak = peaks.get(float(preload))
        cells.append(percent(errors(peak, truth.get((force, float(preload), directions, harmonics)))))
    for preload in PRELOADS[force]:
        cells.append(percent(errors(peaks.get(float(preload)), best_truth(truth, force, float(preload)))))
    return [f"| {label} | " + " | ".join(cells) + f" | {seconds:.0f} |"]


def truth_block(truth, force):
    lines = ["", f"## Truth, force along {force}", "",
             "Peak [µm] at [Hz]; p: friction along p alone, pr: along both.", ""]
    keys = sorted({(k[2], k[3]) for k in truth if k[0] == force})
    lines.append("| preload [N] | " + " | ".join(f"{d}, {h}" for d, h in keys) + " |")
    lines.append("|---|" + "---|" * len(keys))
    for preload in PRELOADS[force]:
        cells = []
        for d, h in keys:
            row = truth.get((force, float(preload), d, h))
            cells.append(f"{float(row['peak_um']):.1f} at {float(row['peak_Hz']):.2f}" if row else "–")
        lines.append(f"| {preload} | " + " | ".join(cells) + " |")
    return lines


def time_lines(truth):
    """The truth integrated in time (share/reference/truth_time_10mm.csv) beside its balance with the most harmonics."""
    with open(IN_TIME, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["complete"] == "1"]
    balances = dict(truth)
    for row in rows:
        balances[row["force"], float(row["preload_N"]), row["directions"], int(row["harmonics"])] = row
    lines = ["", "## The truth in time", "",
             "| force, preload [N] | begun from harmonics | in time, peak [µm] at [Hz] | last change | balance, most harmonics: peak [µm] at [Hz] | "
             "balance over time, % |", "|---|---|---|---|---|---|"]
    for row in rows:
        if not float(row["time_um"]):
            continue
        key = row["force"], float(row["preload_N"]), row["directions"]
        most = max(k[3] for k in balances if k[:3] == key)
        best = balances[(*key, most)]
        ratio = float(best["peak_um"]) / float(row["time_um"]) - 1.0
        lines.append(f"| {row['force']}, {float(row['preload_N']):g} | {row['harmonics']} | {float(row['time_um']):.1f} at "
                     f"{float(row['time_Hz']):.2f} | {float(row['time_change']):.0e} | {most}: {float(best['peak_um']):.1f} at "
                     f"{float(best['peak_Hz']):.2f} | {100 * ratio:+.2f} |")
    return lines


def table(arguments):
    truth = read_truth()
    lines = INTRODUCTION.splitlines()
    forces = arguments.force.split(",")
    for force in forces:
        lines += truth_block(truth, force)
    lines += time_lines(truth)
    for force in forces:
        lines += ["", f"## The program beside it, force along {force}"]
        for line in error_lines(arguments, force, truth):
            lines.append(line)
            print(line, flush=True)
    lines += NOT_KNOWN.splitlines()
    if arguments.output:
        with open(arguments.output, "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")
    return 0


def error_lines(arguments, force, truth):
    """One table a group of choices, a line at a time."""
    only = arguments.only.split(",") if arguments.only else None
    loads = [f"{p} N" for p in PRELOADS[force]]
    group = None
    for group_name, label, settings in cases():
        if only and group_name not in only:
            continue
        if group_name != group:
            group = group_name
            yield from ("", "| " + group_name + " | " + " | ".join(f"{p} alone" for p in loads) + " | " +
                        " | ".join(f"{p} in all" for p in loads) + " | seconds |", "|---|" + "---|" * (2 * len(loads) + 1))
        folder, seconds, word = run_case(arguments.program, arguments.work, force, settings, arguments.limit)
        yield from table_rows(folder, label, settings, force, seconds, word, truth)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("compare")
    one.add_argument("folders", nargs="+")
    many = commands.add_parser("table")
    many.add_argument("program")
    many.add_argument("-o", "--output")
    many.add_argument("--only", help="default, modes, degree, harmonics, cells, fit, directions, mesh")
    many.add_argument("--force", default="x,y")
    many.add_argument("--work", default=os.path.join(ROOT, "runs", "truth"))
    many.add_argument("--limit", type=float, default=900.0)
    commands.add_parser("time")
    arguments = parser.parse_args()
    if arguments.command == "time":
        print("\n".join(time_lines(read_truth())[1:]))
        return 0
    if arguments.command == "compare":
        return compare(arguments.folders)
    return table(arguments)


if __name__ == "__main__":
    sys.exit(main())
