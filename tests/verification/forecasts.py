"""What `check` forecasts against what `run` takes, in processor seconds: sets of effects from one to all.

The model is right to a factor of two; what other programs leave of the machine changes between forecast and run, so that four is
asked for, of the median of three where the first is beyond it. Below half a second, of start and files, nothing is told.

usage: forecasts.py MICROSLIP SOURCE_FOLDER RUN_FOLDER          (MICROSLIP_CAMPAIGNS=whole: every scene, minutes)
"""
import json
import os
import resource
import statistics
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "hard_cases"))
from program_run import whole_campaigns, without_plots
from random_runs import scene_of

PROGRAM, SOURCE, FOLDER = sys.argv[1:4]
SCENES = os.path.join(SOURCE, "share", "scenes")
LEAST = 0.5
FACTOR = 4.0
NO_SEARCH = ["response.optimum=", "response.optimum_range="]
CUBIC = 'contact.roughness={ law = "cubic", height = "1 um" }'


def chain(*settings):
    return f"{SCENES}/chain_2dof.toml", list(settings)


def blade(harmonics, preload, *settings, size=10, search=False):
    return f"{SCENES}/blade_to_ground.toml", [
        f'model.element_size="{size} mm"', f"response.harmonics={harmonics}", f"response.preload={preload}", "response.maps=[]",
        *(['response.optimum_range=["60 N", "1000 N"]'] if search else NO_SEARCH), *settings]


def block(preload, harmonics, *settings):
    law = 'contact.friction_coefficient={ law = "exponential", static = 0.5, kinetic = 0.4, rate = 2 }'
    return f"{SCENES}/block_rough.toml", [law, f"response.harmonics={harmonics}", f"response.preload={preload}", "response.maps=[]", *settings]


def drawn(seed, number):
    """A scene of random_runs.py."""
    os.makedirs(FOLDER, exist_ok=True)
    path = os.path.join(FOLDER, f"{seed}_{number}.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(scene_of(seed, number)[1])
    return path, []


BOTH = "effects.second_direction=on"
FEW = {
    "area, 9 harmonics": (f"{SCENES}/chain_2dof_moment.toml", ["response.maps=[]"]),
    "chain, auto": chain("response.harmonics=auto", *NO_SEARCH),
    # Multipliers of periods in which the load varies take most of it.
    "point that opens, 9": (f"{SCENES}/chain_3dof_normal.toml", ["response.harmonics=9", "response.preload=[5, 10, 20, 35, 50, 80]"]),
    "chain, in time": chain("response.method=time", "response.preload=[50]", *NO_SEARCH),
    "chain, best value": chain("response.harmonics=5"),
    "blade, 3 harmonics": blade(3, "[100, 500]"),
    "blade, 3, both directions": blade(3, "[100]", BOTH),
    # Events located at sixteen points, where most slip; the check of what is off.
    "block, rough, by speed, both": block("[80]", 1, 'response.frequency=["32.6 Hz", "40 Hz"]'),
    "block, rough, by speed, r off": block("[20]", 1, "effects.second_direction=off"),
    # Three times what constants say of a curve, and more: folds, and friction in a plane.
    "901.36, exponential, 5": drawn(901, 36),
    "901.40, in a plane, 5": drawn(901, 40),
    "blade, 3, three effects off": blade(3, "[100, 500]", *(f"effects.{name}=off" for name in ("roughness", "moments", "residual")), CUBIC),
}
REST = {
    "chain, 9 harmonics, best value": chain(),
    "block, rough, both": (f"{SCENES}/block_rough.toml", ["response.maps=[]"]),
    "blade, 1 harmonic": blade(1, "[100, 500]"),
    "blade, 9 harmonics": blade(9, "[100, 500]"),
    "blade, auto": blade("auto", "[100, 500]"),
    "blade, 1, both directions": blade(1, "[100]", BOTH),
    "blade, 9, both directions": blade(9, "[100]", BOTH),
    "blade, 3, rough": blade(3, "[100]", CUBIC),
    "blade, 9, one point": blade(9, "[100, 500]", "effects.moments=off"),
    "blade, 9, free modes alone": blade(9, "[100, 500]", "effects.residual=off"),
    "blade, 9, stability not judged": blade(9, "[100, 500]", "effects.stability=off"),
    "blade, 1, best value": blade(1, "[100]", search=True),
    "blade of 6 mm, 1 harmonic": blade(1, "[100, 500]", size=6),
    "blade of 6 mm, iterative modes": blade(1, "[100, 500]", "modes.solver=iterative", size=6),
    "901.20, a chain, 5": drawn(901, 20),
    "901.29, exponential, 3": drawn(901, 29),
    "STEP file, 1 harmonic": (f"{SCENES}/step_blade.toml", ["response.preload=[100, 300]", "response.maps=[]"]),
}


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def asked(command, path, settings, *options):
    """Standard output."""
    line = [PROGRAM, command, path, *options] + [word for one in settings for word in ("--set", one)]
    finished = subprocess.run(line, capture_output=True, text=True, timeout=1500, env=without_plots())
    if finished.returncode != 0:
        raise RuntimeError(f"{' '.join(line)} ended with {finished.returncode}: {finished.stderr}")
    return finished.stdout


def forecast(path, settings):
    told = json.loads(asked("check", path, settings, "--json").splitlines()[-1])["forecast"]
    return sum(told[stage + "_seconds"] for stage in ("modes", "curves", "errors", "best_value"))


def taken(name, path, settings):
    begin = processor_seconds()
    asked("run", path, settings, "-q", "-j", "1", "--no-cache", "--without", "plots", "--without", "maps", "--without", "bracket", "-o",
          os.path.join(FOLDER, name.replace(" ", "_").replace(",", "")))
    return processor_seconds() - begin


def measured_ratio(name, path, settings):
    told, used = forecast(path, settings), taken(name, path, settings)
    ratio = max(told, LEAST) / max(used, LEAST)
    print(f"{name:32}{told:8.1f} s{used:6.1f} s  {ratio:.2f}", flush=True)
    return ratio


def is_beyond(ratio):
    return not 1 / FACTOR < ratio < FACTOR


class Forecasts(unittest.TestCase):
    def test_are_what_a_run_takes(self):
        os.makedirs(FOLDER, exist_ok=True)
        print(f"{'scene':32}{'forecast':>10}{'taken':>8}  ratio")
        for name, (path, settings) in {**FEW, **(REST if whole_campaigns() else {})}.items():
            with self.subTest(name):
                ratio = measured_ratio(name, path, settings)
                if is_beyond(ratio):
                    ratio = statistics.median([ratio, *(measured_ratio(name, path, settings) for _ in range(2))])
                self.assertFalse(is_beyond(ratio), f"{ratio:.2f}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
