#!/usr/bin/python3
"""The same study on several element sizes: frequencies, peaks, best preload, time and memory.

    mesh_convergence.py SCENE --sizes 6mm 4mm 3mm [-o FOLDER] [--program MICROSLIP]

Runs `microslip run SCENE --set model.element_size=SIZE` once per size into FOLDER/SIZE, prints two
Markdown tables and writes FOLDER/convergence.{md,csv,svg,png}. A size that fails ends the series;
the tables show the sizes before it.
"""

import argparse
import csv
import io
import json
import os
import re
import subprocess
import sys
import time

SHARE = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
sys.path.insert(0, os.path.join(SHARE, "python"))


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n\n")[0], epilog=__doc__.split("\n\n")[2],
        formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("scene", help="scene file with model.element_size")
    parser.add_argument("--sizes", nargs="+", required=True, metavar="SIZE",
                        help='element sizes, coarse to fine, such as 6mm or "0.004 m"')
    parser.add_argument("-o", "--output", default="runs/mesh_convergence", help="folder for the runs")
    parser.add_argument("--program", default=os.path.join(os.path.dirname(SHARE), "build", "bin", "microslip"))
    parser.add_argument("--keep", action="store_true",
                        help="use the runs that are already complete in the output folder")
    return parser.parse_args()


def normalised(size):
    """'6mm' → '6 mm'; a bare number is in metres, as everywhere in a scene."""
    match = re.fullmatch(r"\s*([0-9.eE+-]+)\s*([a-zµ]*)\s*", size)
    if not match:
        sys.exit(f"--sizes: {size!r} is not a length such as 6mm")
    return f"{match[1]} {match[2] or 'm'}"


def finished(folder):
    path = os.path.join(folder, "summary.json")
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        summary = json.load(file)
    return summary if summary["exit_code"] in (0, 3) else None


def run(options, size):
    """The summary of one size; None when the program failed (it has said why)."""
    folder = os.path.join(options.output, size.replace(" ", ""))
    if options.keep and finished(folder):
        return finished(folder)
    print(f"{size}: running", file=sys.stderr, flush=True)
    begin = time.monotonic()
    code = subprocess.run([options.program, "run", options.scene, "-q", "-o", folder,
                           "--set", f'model.element_size="{size}"'], check=False).returncode
    print(f"{size}: exit code {code} after {time.monotonic() - begin:.1f} s", file=sys.stderr)
    return finished(folder) if code in (0, 3) else None


def row_of(size, summary):
    """One flat record per size: what the CSV holds."""
    row = {"element_size": size, "nodes": summary["mesh"]["nodes"],
           "elements": summary["mesh"]["elements"],
           "degrees_of_freedom": summary["mesh"]["degrees_of_freedom"]}
    for number, mode in enumerate(summary["modes"][:3], 1):
        row[f"frequency_{number}_Hz"] = mode["frequency_Hz"]
    for curve in summary["curves"]:
        peak = curve["peak"] or {"frequency_Hz": None, "amplitude_m": None}
        row[f"{curve['name']}_peak_Hz"] = peak["frequency_Hz"]
        row[f"{curve['name']}_peak_m"] = peak["amplitude_m"]
    optimum = summary.get("optimum")
    if optimum:
        row.update(optimum_preload_N=optimum["preload_N"], optimum_peak_m=optimum["amplitude_m"],
                   optimum_peak_Hz=optimum["frequency_Hz"])
    row["seconds"] = sum(stage["seconds"] for stage in summary["stages"])
    row["peak_memory_MB"] = max((s["peak_memory_MB"] for s in summary["stages"]), default=0.0)
    return row


def cell(value, form):
    return "–" if value is None else format(value, form)


def markdown(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---:|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def overview_table(rows):
    columns = [("element_size", "element size", "s"), ("degrees_of_freedom", "unknowns", "d"),
               ("frequency_1_Hz", "f₁ [Hz]", ".3f"), ("frequency_2_Hz", "f₂ [Hz]", ".3f"),
               ("frequency_3_Hz", "f₃ [Hz]", ".3f"),
               ("optimum_preload_N", "best preload [N]", ".5g"),
               ("optimum_peak_m", "peak there [m]", ".4e"),
               ("optimum_peak_Hz", "at [Hz]", ".3f"), ("seconds", "time [s]", ".1f"),
               ("peak_memory_MB", "memory [MB]", ".0f")]
    columns = [column for column in columns if column[0] in rows[0]]
    return markdown([title for _, title, _ in columns],
                    [[cell(row.get(key), form) for key, _, form in columns] for row in rows])


def curve_names(rows):
    return [key[:-len("_peak_Hz")] for key in rows[0]
            if key.endswith("_peak_Hz") and key != "optimum_peak_Hz"]


def curve_table(rows):
    header = ["curve"] + [f"{row['element_size']}: peak [Hz] | [m]" for row in rows]
    lines = []
    for name in curve_names(rows):
        line = [name]
        for row in rows:
            line.append(cell(row.get(name + "_peak_Hz"), ".3f"))
            line.append(cell(row.get(name + "_peak_m"), ".4e"))
        lines.append(line)
    return markdown(" | ".join(header).split(" | "), lines)


def plot(rows, folder, title):
    from matplotlib import rc_context  # here: a study of one size draws nothing
    from microslip.plots.convergence import plot_convergence
    from microslip.plots.style import STYLE
    with rc_context(STYLE):
        plot_convergence(rows, curve_names(rows), os.path.join(folder, "convergence"), title)


def write_whole(path, text):
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)


def csv_text(rows):
    names = list(dict.fromkeys(name for row in rows for name in row))
    text = io.StringIO()
    writer = csv.DictWriter(text, names, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def main():
    options = arguments()
    os.makedirs(options.output, exist_ok=True)
    rows, title, complete = [], "", True
    for size in map(normalised, options.sizes):
        summary = run(options, size)
        if summary is None or not summary["mesh"]:
            complete = False
            break
        title = summary.get("title", "")
        rows.append(row_of(size, summary))
    if not rows:
        return 1
    text = overview_table(rows) + "\n" + curve_table(rows)
    print(text, end="")
    write_whole(os.path.join(options.output, "convergence.md"), text)
    write_whole(os.path.join(options.output, "convergence.csv"), csv_text(rows))
    if len(rows) > 1:
        plot(rows, options.output, title)
    return 0 if complete else 1


if __name__ == "__main__":
    sys.exit(main())
