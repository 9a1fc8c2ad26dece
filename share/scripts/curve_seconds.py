#!/usr/bin/python3
"""Seconds of one curve by harmonics, directions of friction and cores: the default blade with 10 mm elements.

    curve_seconds.py MICROSLIP [--preload N] [--points N] [--repeat N]

Prints a Markdown table. Each case is run as often as asked, without its error and without a cache; the
median is printed. One core: the process is bound to it.
"""
import argparse
import json
import os
import statistics
import subprocess
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCENE = os.path.join(ROOT, "share", "scenes", "blade_to_ground.toml")
ONE_CURVE = ['model.element_size="10 mm"', "response.optimum=", "response.optimum_range=", "response.maps=", "accuracy.error_budget=off"]
HARMONICS = [("1", ["response.harmonics=1"]), ("3", ["response.harmonics=3"]), ("5", ["response.harmonics=5"]),
             ("9", ["response.harmonics=9"]), ("chosen to 1 %", ["response.harmonics=auto"]),
             ("chosen to 0.1 %", ["response.harmonics=auto", "response.harmonic_tolerance=0.001"])]
DIRECTIONS = [("p", "off"), ("p and r", "on")]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program", metavar="MICROSLIP")
    parser.add_argument("--preload", type=float, default=267.0, help="N; negative: a gap (default %(default)s)")
    parser.add_argument("--points", type=int, help="contact points; default: as the scene has it")
    parser.add_argument("--repeat", type=int, default=3, help="runs of each case (default %(default)s)")
    return parser.parse_args()


def curve_of(options, settings, cores, folder):
    """The curve as summary.json has it."""
    own = [f"response.preload=[{options.preload}]"] + ([f"contact.points={options.points}"] if options.points else [])
    command = [options.program, "run", SCENE, "-q", f"-j{len(cores)}", "--without", "plots", "--without", "maps", "-o", folder]
    for setting in ONE_CURVE + own + settings:
        command += ["--set", setting]
    subprocess.run(command, check=True, env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "MICROSLIP_CACHE": "off"},
                   preexec_fn=lambda: os.sched_setaffinity(0, cores))
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file)["curves"][0]


def row(options, harmonics, directions, folder):
    """One line of the table."""
    settings = harmonics[1] + [f"effects.second_direction={directions[1]}"]
    machine = sorted(os.sched_getaffinity(0))
    seconds = []
    for cores in ({machine[0]}, set(machine[:2])):
        curves = [curve_of(options, settings, cores, folder) for _ in range(options.repeat)]
        seconds.append(statistics.median(curve["seconds"] for curve in curves))
    points = curves[0]["points"]
    return (f"| {harmonics[0]} | {directions[0]} | {points} | {curves[0]['contact_evaluations'] / points:.1f} | "
            f"{seconds[0]:.2g} | {seconds[1]:.2g} |")


def main():
    options = arguments()
    print("| harmonics | friction along | points of the curve | evaluations a point | one core [s] | two cores [s] |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for directions in DIRECTIONS:
            for harmonics in HARMONICS:
                print(row(options, harmonics, directions, folder), flush=True)


if __name__ == "__main__":
    main()
