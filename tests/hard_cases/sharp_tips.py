#!/usr/bin/env python3
"""A branch that comes back beside itself: where slip or contact of a point begins or ends, two parts of it meet in a tip of
a few degrees, and a step goes from one to the other as if straight on.

Hard: walked on in the same direction the second part leads back to the tip, and from there the branch is walked again from
where it came, for ever or out of the range at its begin. What looks like a tip may be no tip: where another branch crosses
at a kink, the branch goes on with a bend. And a walk that stalls on its way against the range is not to be begun again
behind that place. Where a motion that changes sign after half a period begins to slip, two events meet, and the determinant may
change its sign where the branch turns back.
At the limit of a stuck point whose friction falls with the speed four events meet, and the regime straight on is not the one
in which the branch goes on. Where folds are sought behind a kink Newton's method may find the part that was walked.
From: random scenes, 53.54 (five points with gaps, friction in a plane), 83.15 (friction that falls with the speed: a branch
point in a bend), 29.163 (hyperbolic law: a stall on the way against the range; with 5 % damping two events at once), 113.83 (a chain
that parts: a step from before a kink to the part beyond it, which comes back), 113.225 (exponential law: four events at once),
127.215 (friction in a plane: a point that sticks with a load of the mean begins to slip, two folds and one on the part walked before),
501.30 (hyperbolic law: a step over three pairs of folds to a part of the branch beside the one it came by),
a scene of two points that slide in a plane, whose branch turns in a hairpin of 3e-6 Hz from which walks came back,
and share/scenes/block_rough.toml at 80 N, with so few cells that events are located (pairs of folds 2e-5 and 1e-8 Hz apart, into
which short steps lead and long ones do not: tips at which slip in a plane begins, the other part of which bends at once, so that they
looked like branch points, of eight cells and of four).
Right: complete, no fold is passed twice, from end to end they are even in number, and a part of the range has none more.

usage: sharp_tips.py MICROSLIP WORK_FOLDER
"""
import json
import os
import shutil
import subprocess
import sys

from random_runs import scene_of
from program_run import without_plots  # found by random_runs


BLOCK = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "share", "scenes", "block_rough.toml")


HAIRPIN = """
[model]
kind = "modal"
[modal]
frequency = [20.0, 26.0, 47.0]
damping_ratio = [0.01, 0.015, 0.01]
force_sine = [1.0, 0.3, 0.2]
force_cosine = [0.0, 0.8, 0.1]
force_static = [0.5, 0, 0]
output = [0.9, 0.35, 0.2]
[[modal.points]]
weight = 1
tangential_stiffness = 2e4
normal_stiffness = 1e4
friction_coefficient = 0.3
preload = 8
phi_u_1 = 0.8
phi_u_2 = -0.5
phi_u_3 = 0.3
phi_v_1 = 0.1
phi_v_2 = 0.2
phi_v_3 = 0.5
phi_w_1 = 0.3
phi_w_2 = 0.6
phi_w_3 = 0.1
[[modal.points]]
weight = 1
tangential_stiffness = 1e4
normal_stiffness = 1e4
friction_coefficient = 0.5
preload = 2
phi_u_1 = 0.5
phi_u_2 = 0.5
phi_u_3 = -0.3
phi_v_1 = 0.1
phi_v_2 = -0.2
phi_v_3 = 0.5
phi_w_1 = -0.3
phi_w_2 = 0.4
phi_w_3 = 0.1
[response]
frequency = ["14 Hz", "40 Hz"]
harmonics = 1
[accuracy]
tolerance = "off"
"""


def solved(program, folder, scene, *settings):
    """Exit code and what the summary says of the curve."""
    os.makedirs(folder)
    path = os.path.join(folder, "scene.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(scene_of(*scene)[1])
    return run_of(program, path, os.path.join(folder, "run"), *settings)


def run_of(program, path, run, *settings, seconds=60):
    words = [word for setting in settings for word in ("--set", setting)]
    code = subprocess.run([program, "run", path, "-q", "-j", "1", "-o", run, "--without", "plots", *words, "--set",
                           f'response.time_budget="{seconds} s"'], timeout=seconds + 40, env=without_plots(), check=False).returncode
    with open(os.path.join(run, "summary.json"), encoding="utf-8") as file:
        curve, = json.load(file)["curves"]
    return code, curve


def passed_twice(folds):
    return [one for i, one in enumerate(folds) if any(abs(one - other) < 1e-11 * one for other in folds[:i])]


def main(program, folder):
    shutil.rmtree(folder, ignore_errors=True)
    code, curve = solved(program, os.path.join(folder, "tips"), (53, 54), "response.harmonics=1", "response.frequency=[60.0, 33.0]")
    print(f"53.54 with one harmonic: {curve['points']} points, {len(curve['folds_Hz'])} folds, {curve['diagnosis'] or 'complete'}")
    assert code == 0 and curve["complete"], curve["message"]
    assert len(curve["folds_Hz"]) > 10 and not passed_twice(curve["folds_Hz"]), curve["folds_Hz"]

    for scene, *settings in (((83, 15),), ((29, 163),), ((29, 163), "modal.damping_ratio=0.05"), ((113, 83),), ((113, 225),)):
        name = ".".join(map(str, scene)) + "".join(f" with {setting}" for setting in settings)
        code, curve = solved(program, os.path.join(folder, name), scene, *settings)
        print(f"{name}: {curve['points']} points, {len(curve['folds_Hz'])} folds, {curve['diagnosis'] or 'complete'}")
        assert code == 0 and curve["complete"], curve["message"]
        assert curve["folds_Hz"] and not passed_twice(curve["folds_Hz"]), curve["folds_Hz"]
        anew = {step["remedy"] for step in curve["remedies"]} & {"fixed-frequency", "homotopy", "other-branch"}
        assert anew or len(curve["folds_Hz"]) % 2 == 0, curve["folds_Hz"]

    code, curve = solved(program, os.path.join(folder, "beside"), (127, 215), "response.frequency=[6.75, 6.9]")
    print(f"127.215 from 6.75 to 6.9 Hz: {curve['points']} points, folds at {curve['folds_Hz']}")
    assert code == 0 and len(curve["folds_Hz"]) == 2, curve["folds_Hz"]

    _, part = solved(program, os.path.join(folder, "part"), (501, 30), "response.frequency=[5.2, 4.4]")
    code, curve = solved(program, os.path.join(folder, "whole"), (501, 30))
    print(f"501.30: {curve['points']} points, {len(curve['folds_Hz'])} folds, of which from 5.2 to 4.4 Hz {len(part['folds_Hz'])}")
    assert code == 0 and curve["complete"], curve["message"]
    assert len(part["folds_Hz"]) == 6, part["folds_Hz"]
    lacks = [one for one in part["folds_Hz"] if all(abs(one - other) > 1e-9 * one for other in curve["folds_Hz"])]
    assert not lacks, lacks

    path = os.path.join(folder, "hairpin.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(HAIRPIN)
    code, curve = run_of(program, path, os.path.join(folder, "hairpin"), 'accuracy.error_budget="off"')
    print(f"two points in a plane: {curve['points']} points, folds at {curve['folds_Hz']}, {curve['diagnosis'] or 'complete'}")
    assert code == 0 and curve["complete"], curve["message"]
    beyond = [peak for peak in curve["peaks"] if 32.0 < peak["frequency_Hz"] < 34.0]
    assert beyond, curve["peaks"]
    assert len(curve["folds_Hz"]) % 2 == 0 and not passed_twice(curve["folds_Hz"]), curve["folds_Hz"]

    block = ("response.preload=[80]", "response.maps=[]", 'accuracy.error_budget="off"', "effects.coexistence=off")
    code, curve = run_of(program, BLOCK, os.path.join(folder, "four"), "contact.cells=[2, 2]", *block, seconds=200)
    print(f"rough block of four cells at 80 N: {curve['points']} points, folds at {curve['folds_Hz']}, {curve['diagnosis'] or 'complete'}")
    assert code == 0 and curve["complete"], curve["message"]
    assert len(curve["folds_Hz"]) % 2 == 0 and not passed_twice(curve["folds_Hz"]), curve["folds_Hz"]

    code, curve = run_of(program, BLOCK, os.path.join(folder, "block"), "contact.cells=[4, 2]", *block, seconds=200)
    remedies = sorted({step["remedy"] for step in curve["remedies"]})
    print(f"rough block of eight cells at 80 N: {curve['points']} points, {curve['diagnosis'] or 'complete'}, {remedies}")
    assert code == 0 and curve["complete"], curve["message"]
    assert len(curve["folds_Hz"]) % 2 == 0 and not passed_twice(curve["folds_Hz"]), curve["folds_Hz"]
    assert "past-loop" not in remedies, remedies


if __name__ == "__main__":
    main(*sys.argv[1:3])
