"""What a scene pays for its effects: one scene per set of effects, from provably stuck to everything on, beside the full
model of the same scene. Processor seconds of the curves alone, and unknowns of a point.

    effect_sets.py MICROSLIP SOURCE_FOLDER RUN_FOLDER [--csv TABLE] [--repeat N] [--quick]
    share/scripts/plot_effect_sets.py TABLE -o PICTURE

The blade with 10 mm elements and 96 contact points at least, one preload a scene. *Full*: every switchable effect on, and
harmonics 1 to 9. The seconds are those of the curve as summary.json has them, without the checks of its peak, times the share
of a processor that the run had: the machine may be shared. Of several runs the shortest counts.
"""
import argparse
import csv
import glob
import json
import os
import resource
import subprocess
import sys
import time

OFF = ["response.optimum=", "response.optimum_range=", "response.maps=[]", "accuracy.error_budget=off",
       'model.element_size="10 mm"', "contact.points=96"]
CUBIC = 'contact.roughness={ law = "cubic", height = "0.2 um" }'
RATE = 'contact.friction_coefficient={ law = "hyperbolic", static = 0.4, rate = "2 s/m" }'
CONSTANT, ONE_WAY, BOTH = "effects.normal_motion=off", "effects.second_direction=off", "effects.second_direction=on"
FULL = ["response.harmonics=9", BOTH, "effects.nonlinearity=on", "effects.normal_motion=on"]
SETS = [  # name, preload, settings, what the full model has beside
    ("provably stuck", "300000", ["response.harmonics=9"], []),
    ("provably open", "-200000", ["response.harmonics=9"], []),
    ("constant load, one direction, 1 harmonic", "267", [CONSTANT, ONE_WAY, "response.harmonics=1"], []),
    ("constant load, one direction, 9 harmonics", "267", [CONSTANT, ONE_WAY, "response.harmonics=9"], []),
    ("load varies, one direction, 1 harmonic", "267", [ONE_WAY, "response.harmonics=1"], []),
    ("load varies, one direction, 9 harmonics", "267", [ONE_WAY, "response.harmonics=9"], []),
    ("a twentieth slips, one direction, 9 harmonics", "2250", [ONE_WAY, "response.harmonics=9"], []),
    ("load varies, two directions, 1 harmonic", "267", [BOTH, "response.harmonics=1"], []),
    ("rate-dependent friction, one direction, 9 harmonics", "267", [ONE_WAY, "response.harmonics=9", RATE], [RATE]),
    ("rough surfaces, one direction, 9 harmonics", "267", [ONE_WAY, "response.harmonics=9", CUBIC], [CUBIC]),
    ("everything on", "267", [*FULL, CUBIC, RATE], [CUBIC, RATE]),
]
QUICK = SETS[:2]  # proved linear
ALL_SLIP, FEW_SLIP = "load varies, one direction, 9 harmonics", "a twentieth slips, one direction, 9 harmonics"
COLUMNS = ["set", "seconds", "unknowns", "points", "slip_share", "full_seconds", "full_unknowns"]


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def largest_slip(path):
    with open(path, newline="", encoding="utf-8") as file:
        return max(float(row["slip_share"]) for row in csv.DictReader(file))


class Bench:
    def __init__(self, arguments):
        self.arguments = arguments
        self.known = {}

    def run(self, preload, settings):
        """Processor seconds of the shortest run, its summary, and how much slips."""
        key = (preload, *sorted(settings))
        if key not in self.known:
            self.known[key] = min((self.once(preload, settings) for _ in range(self.arguments.repeat)),
                                  key=lambda one: one[0])
        return self.known[key]

    def forget_curves(self):
        """Mesh and modes are taken from the run before, curves are solved."""
        for file in glob.glob(os.path.join(self.arguments.folder, "cache", "microslip", "preload_*.cached")):
            os.remove(file)

    def once(self, preload, settings):
        self.forget_curves()
        folder = os.path.join(self.arguments.folder, "run")
        line = [self.arguments.program, "run", os.path.join(self.arguments.source, "share", "scenes", "blade_to_ground.toml"),
                "-q", "-j", "1", "--without", "plots", "--without", "maps", "-o", folder]
        for one in [*OFF, f"response.preload=[{preload}]", *settings]:
            line += ["--set", one]
        begin, on_the_clock = processor_seconds(), time.monotonic()
        finished = subprocess.run(line, capture_output=True, text=True,
                                  env={**os.environ, "OPENBLAS_NUM_THREADS": "1",
                                       "XDG_CACHE_HOME": os.path.join(self.arguments.folder, "cache")})
        had = (processor_seconds() - begin) / (time.monotonic() - on_the_clock)
        if finished.returncode != 0:
            raise RuntimeError(f"{' '.join(line)} ended with {finished.returncode}: {finished.stderr}")
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
        curve = summary["curves"][0]
        return had * curve["seconds"], summary, largest_slip(os.path.join(folder, "curves", curve["name"] + ".csv"))

    def curve(self, preload, settings):
        """Of the curve alone: processor seconds, points, largest share of area and period that slips, unknowns of a point."""
        seconds, summary, slip = self.run(preload, settings)
        curve = summary["curves"][0]
        # A curve that is proved linear has a sine and a cosine of each mode, nothing else.
        per_mode = 2 if curve["certificate"] else 2 * curve["harmonics"]["most"] + (0 if CONSTANT in settings else 1)
        return seconds, curve["points"], slip, per_mode * len(summary["modes"])


def rows(bench, sets):
    for name, preload, settings, more in sets:
        seconds, points, slip, unknowns = bench.curve(preload, settings)
        full, _, _, full_unknowns = bench.curve(preload, [*FULL, *more])
        yield dict(zip(COLUMNS, [name, seconds, unknowns, points, slip, full, full_unknowns]))


def ratio_of(row):
    return row["full_seconds"] / row["seconds"]


def goals(table):
    """What is aimed at, as far as the sets at hand tell it: (goal, least or most, measured, met)."""
    of = {row["set"]: row for row in table}
    for row in table:
        least = 5.0 if row["set"].startswith("constant load") else 100.0 if row["set"].startswith("provably") else None
        if least:
            yield f"{row['set']}: faster than the full model", f">= {least:g}", ratio_of(row), ratio_of(row) >= least
    if FEW_SLIP in of and ALL_SLIP in of:
        share = of[FEW_SLIP]["seconds"] / of[ALL_SLIP]["seconds"]
        yield f"{FEW_SLIP}: of all slipping", "<= 0.2", share, share <= 0.2


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("source")
    parser.add_argument("folder", help="for runs and their cache")
    parser.add_argument("--csv", help="table to write")
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--quick", action="store_true", help="those that are proved linear alone")
    arguments = parser.parse_args()
    os.makedirs(arguments.folder, exist_ok=True)
    bench = Bench(arguments)
    table = []
    print(f"{'set of effects':54}{'s':>10}{'unknowns':>10}{'full, s':>9}{'unknowns':>10}{'ratio':>8}{'slips':>8}")
    for row in rows(bench, QUICK if arguments.quick else SETS):
        table.append(row)
        print(f"{row['set']:54}{row['seconds']:10.3g}{row['unknowns']:10}{row['full_seconds']:9.3g}{row['full_unknowns']:10}"
              f"{ratio_of(row):8.3g}{100 * row['slip_share']:6.0f} %", flush=True)
    print(f"\n{'goal':80}{'':>8}{'measured':>10}")
    for goal, bound, measured, met in goals(table):
        print(f"{goal:80}{bound:>8}{measured:10.3g}  {'met' if met else 'missed'}")
    if arguments.csv:
        with open(arguments.csv, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, COLUMNS, delimiter=";")
            writer.writeheader()
            writer.writerows(table)


if __name__ == "__main__":
    sys.exit(main())
