#!/usr/bin/env python3
"""48 points that slip nearly all the time: what they drive is a hundred times their friction, and they stick for 0.2 % of
a period, less than the time between two instants where forces are sampled.

Hard: a sampled force is not smooth there; the curve had twenty folds where it has none, and took a minute.
From: a random scene, its points divided so that there are enough to be sampled.
Right: sums over instants count a stick as long as it is; in a plane and with friction by the rate the error is seen and the
curve traced again with more instants, along a line with located events where these are as cheap. A peak, no fold, proved in every row, and the peak that located events give.

usage: short_stick.py MICROSLIP WORK_FOLDER
"""
import csv
import json
import os
import shutil
import subprocess
import sys

# Weight, load and shapes of twelve points under five modes.
POINTS = [
    (0.520356, 0.0892278, (0.0933973, 0.363728, -0.78928, -0.0762664, 0.691031)),
    (0.835583, 0.145225, (-0.704693, -0.692559, 0.245833, -0.0118956, 0.740876)),
    (1.01785, 0.074827, (0.676994, 0.35659, -0.241188, -0.0877251, -0.639689)),
    (1.33821, 0.080585, (-0.0376386, 0.614199, -0.102317, -0.555391, -0.539046)),
    (0.653805, 0.112973, (-0.711066, -0.953743, 0.174921, 0.724796, -0.274041)),
    (1.30948, 0.0688545, (-0.593617, 0.81583, -0.881455, 0.0179629, -0.442633)),
    (1.32903, 0.113479, (0.183014, -0.680724, 0.258107, 0.959561, -0.899702)),
    (1.13722, 0.0907029, (0.639802, 0.291264, 0.477485, -0.757195, 0.830117)),
    (1.36126, 0.150263, (-0.387457, -0.864626, 0.484636, -0.264288, -0.471381)),
    (0.838583, 0.0870847, (0.730158, 0.192104, -0.868062, -0.99332, -0.948785)),
    (1.03483, 0.128494, (-0.395712, -0.106555, 0.0697428, -0.836024, -0.482388)),
    (1.02303, 0.14571, (-0.42015, -0.182602, -0.0616807, -0.127837, 0.789928)),
]
PARTS = 4  # of each point, loads of 0.8 to 1.2
SCENE = """
[model]
kind = "modal"
[modal]
frequency = [2.5834, 6.49256, 14.980712, 31.8073536, 76.25647]
damping_ratio = 0.000204
force_sine = [0.79074, 0.243105, -0.52498, -0.264383, 1.105035]
force_cosine = [-0.47053, -0.544456, 0.359611, -0.613869, 0.1898176]
output = [-0.988248, -0.215928, -0.887982, -0.872405, -0.47808]
points = [
%s
]
[response]
frequency = ["6 Hz", "7 Hz"]
harmonics = 3
"""
RATE = """[contact]
friction_law = { law = "exponential", static = 0.132815, kinetic = 0.1, rate = 0.01 }
"""


def table():
    rows = []
    for part in range(PARTS):
        for weight, load, shapes in POINTS:
            shape = ", ".join(f"phi_u_{i + 1} = {value}" for i, value in enumerate(shapes))
            rows.append(f"  {{ weight = {weight / PARTS}, tangential_stiffness = 801.206, normal_stiffness = 0, "
                        f"friction_coefficient = 0.132815, preload = {load * (0.8 + 0.4 * part / (PARTS - 1))}, {shape} }},")
    return "\n".join(rows)


def along_both(lines):
    """The same points moved along r too: their shapes in another order, a third of the size."""
    for line, (_, _, shapes) in zip(lines, PARTS * POINTS):
        along_r = ", ".join(f"phi_w_{i + 1} = {0.3 * value}" for i, value in enumerate(reversed(shapes)))
        yield line.replace(" },", f", {along_r} }},")


def solved(program, folder, scene):
    os.makedirs(folder)
    name = os.path.join(folder, "scene.toml")
    with open(name, "w", encoding="utf-8") as file:
        file.write(scene)
    run = os.path.join(folder, "run")
    subprocess.run([program, "run", name, "-q", "--without", "plots", "--without", "maps", "-o", run], check=True, timeout=100)
    with open(os.path.join(run, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    curve, = summary["curves"]
    assert curve["complete"], curve
    with open(os.path.join(run, "curves", curve["name"] + ".csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert not [row for row in rows if row["mark"] == "fold"]
    assert len([row for row in rows if row["mark"] == "peak"]) == 1
    assert len(rows) < 150, len(rows)
    for row in rows:
        assert float(row["residual"]) < 1e-9 and float(row["energy_imbalance"]) < 1e-7, row
    assert max(float(row["slip_share"]) for row in rows) > 0.99
    located = {row["goal"]: row["effect"] for row in summary["error_budget"] if row["source"] == "instants" and not row["goal"].startswith("marked")}
    assert len(located) == 3 and max(map(abs, located.values())) < 1e-5, located
    remedies = [one["remedy"] for one in curve["remedies"]]
    print(f"{os.path.basename(folder)}: {len(rows)} points, {curve['seconds']:.2f} s, located events: {located}, {remedies}")
    return remedies


def main():
    program, folder = sys.argv[1:3]
    shutil.rmtree(folder, ignore_errors=True)
    line = table()
    assert not solved(program, os.path.join(folder, "line"), SCENE % line)
    plane = "\n".join(along_both(line.split("\n")))
    assert set(solved(program, os.path.join(folder, "plane"), SCENE % plane)) == {"more-instants"}
    by_rate = (SCENE % line).replace("[response]", RATE + "[response]")
    assert set(solved(program, os.path.join(folder, "rate"), by_rate)) == {"more-instants", "located-events"}


if __name__ == "__main__":
    main()
