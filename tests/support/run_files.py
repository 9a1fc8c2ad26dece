"""A finished run as its folder has it, written without a program: a blade at several preloads, one harmonic, its best preload
with other contact data, errors of every source."""
import json
import os

SIZES = {"harmonics": -0.12, "mesh": 0.05, "cells": 4e-4, "second_direction": -2e-5, "basis": 3e-6, "newton": 4e-16}
GOALS = {"peak_amplitude": 1.0, "peak_frequency": -0.1, "dissipated_energy": -1.5, "optimum": 2.0}
KINDS = {"harmonics": "solved", "mesh": "solved"}


def rows_of(name, goals, factor):
    """Rows of the error budget of a curve or of the best value."""
    return [{"curve": name, "goal": goal, "source": source, "effect": factor * GOALS[goal] * size, "kind": KINDS.get(source, "estimated"),
             "seconds": 0.0 if source == "newton" else 0.02, "gain_per_second": 0.0 if source == "newton" else abs(factor * GOALS[goal] * size) / 0.02}
            for source, size in SIZES.items() for goal in goals]


def bar_of(rows):
    bar = {}
    for row in rows:
        bar[row["goal"]] = bar.get(row["goal"], 0.0) + abs(row["effect"])
    return {"dissipated_energy": None, **bar, "not_known": [], "left_out": []}


def curve_of(name, preload, frequency, amplitude, factor):
    energy = 0.0 if isinstance(preload, str) else 0.00192486
    peak = {"frequency_Hz": frequency, "amplitude_m": amplitude, "dissipated_energy_J": energy, "at": "peak"}
    goals = ["peak_amplitude", "peak_frequency"] + (["dissipated_energy"] if energy else [])
    rows = rows_of(name, goals, factor)
    more = {"highest": 9, "frequency_Hz": 0.998 * frequency, "amplitude_m": 0.9 * amplitude}
    return {"name": name, "preload_N": preload, "gap_m": 8.4e-6 if name.startswith("preload_-") else None, "preload_scale": None,
            "complete": True, "diagnosis": "complete", "message": "", "peak": peak, "peaks": [peak], "points": 3,
            "folds_Hz": [1.0009876543 * frequency, 0.9951234567 * frequency], "seconds": 0.1, "maps": [], "detached_branches": 0,
            "harmonics": {"most": 1, "largest_left_out": 0.1, "with_more": more}, "bar": bar_of(rows)}, rows


def best_value():
    best = {"preload_N": 251.58728879831145, "value": 251.58728879831145, "amplitude_m": 0.0005175721862368852,
            "frequency_Hz": 333.38761575968704, "at": "peak", "found": True, "objection": "", "flat": None}
    others = [{**best, "value": factor * best["value"], "parameter": parameter, "factor": factor, "range": [30.0, 6000.0], "range_widened": True}
              for factor in (0.5, 2.0) for parameter in ("friction_coefficient", "contact_stiffness")]
    rows = rows_of("optimum", GOALS, 1.2)
    return {**best, "parameter": "preload", "message": "settled", "dissipated_energy_J": 0.0013, "bar": bar_of(rows), "error_budget": rows,
            "bracket": others, "bracket_left_out": [], "trace": []}


def summary_of(loads=("free", -500, 60, 100, "stuck")):
    curves, budget = [], []
    for i, load in enumerate(loads):
        name = load if isinstance(load, str) else f"preload_{load}"
        curve, rows = curve_of(name, load, 304.498409178142 + 7.0 * i, 0.0029952845074750923 / (1 + i), 1.0 + 0.5 * i)
        curves.append(curve)
        budget += rows
    return {"program": "microslip", "version": "1", "machine": {"processor": "one", "blas": "none"}, "scene": "blade.toml", "title": "Blade",
            "exit_code": 0, "message": "", "warnings": [], "stages": [{"name": "curves", "seconds": 1.0, "peak_memory_MB": 80.0}],
            "mesh": {"nodes": 9, "elements": 1, "degrees_of_freedom": 27, "volume_m3": 1.0, "mass_kg": 0.1},
            "modes": [{"frequency_Hz": 304.4997813889993, "damping_ratio": 0.002, "residual": 1e-9, "kind": "free"}], "curves": curves,
            "optimum": best_value(), "effects": [{"name": "normal_motion", "simulated": True, "setting": "auto", "reason": "", "quantity": "",
                                                  "indicator": 0.2, "threshold": 0.1, "seconds": 1.0, "bound": 0.1, "bound_along": 0.2}],
            "error_budget": budget, "accuracy": {"asked": 0.02, "reached": 0.03, "not_known": [], "refined": []}}


def write_summary(folder, summary):
    with open(os.path.join(folder, "summary.json"), "w", encoding="utf-8") as file:
        json.dump(summary, file)


def write_run(folder, summary):
    """The folder of a run: its summary, a curve of three points each, the peaks its search went over."""
    os.makedirs(os.path.join(folder, "curves"), exist_ok=True)
    write_summary(folder, summary)
    for curve in summary["curves"]:
        frequency, amplitude = curve["peak"]["frequency_Hz"], curve["peak"]["amplitude_m"]
        with open(os.path.join(folder, "curves", curve["name"] + ".csv"), "w", encoding="utf-8") as file:
            file.write("frequency_Hz,amplitude_m,phase_deg,stable,slip_share,separated_share,mark\n" + "".join(
                f"{share * frequency!r},{height * amplitude!r},{phase},1,0.1,0,{mark}\n"
                for share, height, phase, mark in ((0.97, 0.3, -10, ""), (1.0, 1.0, -90, "peak"), (1.02, 0.4, -170, ""))))
    with open(os.path.join(folder, "peak_against_preload.csv"), "w", encoding="utf-8") as file:
        file.write("preload_N,frequency_Hz,amplitude_m\n60,320,0.0009\n250,333,0.0005\n1000,337,0.001\n")
