#!/usr/bin/python3
"""The same study on several element sizes: peaks, their errors against the finest size, order and time.

    mesh_convergence.py SCENE --sizes 6mm 4mm 3mm [-o FOLDER] [--program MICROSLIP]

Runs `microslip converge SCENE --knobs element_size --sizes SIZES`, prints a Markdown table for each curve and writes
FOLDER/convergence.md; FOLDER/converge has the numbers (element_size.csv) and a plot of error against time. A size that
fails ends the series; the tables show the sizes before it.
"""

import argparse
import csv
import os
import re
import subprocess
import sys

SHARE = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n\n")[0], epilog=__doc__.split("\n\n")[2],
        formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("scene", help="scene file with model.element_size")
    parser.add_argument("--sizes", nargs="+", required=True, metavar="SIZE",
                        help='element sizes, coarse to fine, such as 6mm or "0.004 m"')
    parser.add_argument("-o", "--output", default="runs/mesh_convergence", help="folder for the tables")
    parser.add_argument("--program", default=os.path.join(os.path.dirname(SHARE), "build", "bin", "microslip"))
    parser.add_argument("--keep", action="store_true",
                        help="use the table that is in the output folder, if it has these sizes")
    return parser.parse_args()


def normalised(size):
    """'6mm' → '6 mm'; a bare number is in metres, as everywhere in a scene."""
    match = re.fullmatch(r"\s*([0-9.eE+-]+)\s*([a-zµ]*)\s*", size)
    if not match:
        sys.exit(f"--sizes: {size!r} is not a length such as 6mm")
    return f"{match[1]} {match[2] or 'm'}"


def table_in(folder):
    """Rows of the ladder; none where there is no table."""
    path = os.path.join(folder, "converge", "element_size.csv")
    if not os.path.exists(path):
        return []
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def sizes_of(rows):
    return list(dict.fromkeys(row["value"] for row in rows))


def asked_sizes(options):
    """As the table has them, in metres; none where a unit is not known here."""
    metres = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "in": 0.0254}
    parts = [normalised(size).split() for size in options.sizes]
    return [f"{float(number) * metres[unit]:.4g}" for number, unit in parts if unit in metres]


def climb(options):
    """Exit code of the program, which has said why where it is not 0."""
    path = os.path.join(options.output, "converge", "element_size.csv")
    if os.path.exists(path):
        os.remove(path)  # of other sizes
    return subprocess.run([options.program, "converge", options.scene, "-q", "--repeat", "0", "-o", options.output,
                           "--knobs", "element_size", "--sizes", *map(normalised, options.sizes)],
                          check=False).returncode


def cell(text, form):
    return format(float(text), form) if text else "–"


def curve_table(rows):
    header = ["element size [m]", "peak [Hz]", "peak [m]", "error", "order", "time [s]"]
    lines = ["| " + " | ".join(header) + " |", "|" + "---:|" * len(header)]
    for row in rows:
        cells = [row["value"], cell(row["peak_frequency_Hz"], ".3f"), cell(row["peak_amplitude_m"], ".4e"),
                 cell(row["true_error"], "+.2%"), cell(row["order"], ".1f"), cell(row["seconds"], ".1f")]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def text_of(rows):
    tables = []
    for name in dict.fromkeys(row["curve"] for row in rows):
        tables.append(f"{name}\n\n" + curve_table([row for row in rows if row["curve"] == name]))
    return "\n".join(tables)


def write_whole(path, text):
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)


def main():
    options = arguments()
    kept = options.keep and sizes_of(table_in(options.output)) == asked_sizes(options)
    code = 0 if kept else climb(options)
    rows = table_in(options.output)
    if not rows:
        return 1
    text = text_of(rows)
    print(text, end="")
    write_whole(os.path.join(options.output, "convergence.md"), text)
    return 0 if code == 0 and len(sizes_of(rows)) == len(options.sizes) else 1


if __name__ == "__main__":
    sys.exit(main())
