#!/usr/bin/python3
"""Modes of another code as plain numbers, which the program reads.

    convert_modes.py INPUT OUTPUT FACTS.json SECONDS MEGABYTES [DECK]

The ending of INPUT tells its format: .frd (CalculiX), .pch (Nastran; DECK has its nodes), .med (Code_Aster), .npz (NumPy),
.csv (a table). OUTPUT gets doubles, in the units
of the file: the coordinates of every node, x y z, then their displacements, mode after mode, attachment shapes last.
FACTS.json says {"n_nodes": n, "frequency_Hz": [one per mode and attachment shape], "n_attachment": m}. Limits itself to
SECONDS of processor time and MEGABYTES of address space. What is wrong is told in the last line of standard error: exit
code 1.
"""
import importlib
import json
import os
import sys

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # its workers take address space, and nothing here needs them
sys.dont_write_bytecode = True  # a full disk cuts it off, and no later run could read it
sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))

from microslip.conversion import run


READERS = {".frd": "calculix", ".pch": "nastran", ".med": "med", ".npz": "numpy_file", ".csv": "table"}


def convert(source, output, facts, *deck):
    from microslip.modes import content
    reader = importlib.import_module("microslip.modes." + READERS[os.path.splitext(source)[1].lower()])
    modes = reader.read(source, *deck)
    content.check(modes, source)
    with open(output, "wb") as file:
        for numbers in (modes.coordinates, modes.shapes):
            file.write(numbers.astype("<f8").tobytes())
    with open(facts, "w", encoding="utf-8") as file:
        json.dump({"n_nodes": len(modes.coordinates), "frequency_Hz": modes.frequency_hz.tolist(),
                   "n_attachment": modes.n_attachment}, file)


if __name__ == "__main__":
    if len(sys.argv) not in (6, 7):
        sys.exit(__doc__)
    sys.exit(run(lambda *files: convert(*files, *sys.argv[6:]), *sys.argv[1:6]))
