#!/usr/bin/python3
"""Stiffness and mass that CalculiX stored, as files a scene of kind "modes" takes.

    calculix_matrices.py JOB FOLDER

JOB.inp was run with *FREQUENCY, SOLVER=MATRIXSTORAGE, which leaves JOB.sti, JOB.mas and JOB.dof. FOLDER gets
stiffness.mtx, mass.mtx (Matrix Market, symmetric) and nodes.csv: the nodes of JOB.inp with the rows of their displacements,
0 where they are held.
"""
import csv
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))

import numpy as np

from microslip.meshes import abaqus


def write_matrix(source, n, target):
    entries = [line.split() for line in open(source, encoding="ascii")]
    kept = [(column, row, value) for row, column, value in entries if float(value)]  # the lower half, as is usual
    with open(target, "w", encoding="ascii") as file:
        file.write(f"%%MatrixMarket matrix coordinate real symmetric\n{n} {n} {len(kept)}\n")
        file.writelines(f"{row} {column} {value}\n" for row, column, value in kept)


def main(job, folder):
    dofs = [line.strip().split(".") for line in open(job + ".dof", encoding="ascii")]
    row_of = {(int(node), int(axis)): row for row, (node, axis) in enumerate(dofs, 1)}
    content = abaqus.read(job + ".inp")
    os.makedirs(folder, exist_ok=True)
    for source, name in ((".sti", "stiffness.mtx"), (".mas", "mass.mtx")):
        write_matrix(job + source, len(dofs), os.path.join(folder, name))
    used = np.isin(content.node_numbers, np.concatenate([block.nodes.ravel() for block in content.blocks]))
    with open(os.path.join(folder, "nodes.csv"), "w", encoding="ascii", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(("id", "x", "y", "z", "ux", "uy", "uz"))
        for node, place in zip(content.node_numbers[used], content.coordinates[used]):
            rows.writerow((node, *(f"{x:.17g}" for x in place), *(row_of.get((int(node), axis), 0) for axis in (1, 2, 3))))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
