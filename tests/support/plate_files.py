#!/usr/bin/env python3
"""Makes the files of the plate scenes in the formats of codes that were not at hand: the mesh of share/scenes/plate/plate.inp,
and the modes that a run of CalculiX left in plate.frd. No run of Nastran or Code_Aster stands behind them.

    plate.npz              as numpy.savez_compressed writes it
    plate.csv              a table, as a script writes it that walks through the frames of Abaqus
    plate.med              mesh with groups and field of modes, as Code_Aster's IMPR_RESU lays them out
    plate.pch, plate.bdf   the first four modes as Nastran punches them, and a deck of the same mesh
    plate.unv, plate.vtu   the mesh alone, as Salome and ParaView have it

All digits of the .frd file (six of a displacement) are in each. usage: plate_files.py [FOLDER = share/scenes/plate]
"""
import os
import subprocess
import sys
import tempfile

import numpy as np

import mesh_files

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
PLATE = os.path.join(ROOT, "share", "scenes", "plate")
N_PUNCHED = 4  # of the six: 80 kB
sys.path.insert(0, os.path.join(ROOT, "share", "python"))
from microslip.modes import calculix


def mesh_of(deck):
    """Through gmsh's format, in the order of the deck."""
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "plate.msh")
        subprocess.run([os.path.join(ROOT, "share", "scripts", "convert_mesh.py"), deck, file,
                        os.path.join(folder, "facts.json"), "60", "4000"], check=True)
        return mesh_files.from_gmsh(file)


def modes_on(mesh):
    """Frequencies [Hz], shapes [1/√t] at the nodes of the mesh."""
    modes = calculix.read(os.path.join(PLATE, "plate.frd"))
    distances = np.linalg.norm(mesh.nodes[:, None] - modes.coordinates[None], axis=2)
    if distances.min(axis=1).max() > 1e-4:
        raise ValueError("plate.frd has other nodes than plate.inp")
    return modes.frequency_hz, modes.shapes[:, distances.argmin(axis=1)]


def write_table(path, nodes, frequencies, shapes):
    with open(path, "w", encoding="ascii") as table:
        table.write("mode,frequency_Hz,x,y,z,ux,uy,uz\n")
        for mode, (frequency, shape) in enumerate(zip(frequencies.tolist(), shapes.tolist()), 1):
            for place, displacement in zip(nodes.tolist(), shape):
                table.write(",".join([str(mode), *(f"{number:.15g}" for number in (frequency, *place, *displacement))]) + "\n")


def write(folder):
    mesh = mesh_of(os.path.join(PLATE, "plate.inp"))
    frequencies, shapes = modes_on(mesh)
    np.savez_compressed(os.path.join(folder, "plate.npz"), nodes=mesh.nodes, frequency_Hz=frequencies, shapes=shapes)
    write_table(os.path.join(folder, "plate.csv"), mesh.nodes, frequencies, shapes)
    mesh_files.write_med(mesh, os.path.join(folder, "plate.med"))
    mesh_files.add_med_modes(os.path.join(folder, "plate.med"), "modes___DEPL", frequencies, shapes, compression="gzip")
    mesh_files.write_unv(mesh, os.path.join(folder, "plate.unv"), millimetres=True)
    mesh_files.write_vtk(mesh, os.path.join(folder, "plate.vtu"))
    mesh_files.write_bdf(mesh, os.path.join(folder, "plate.bdf"), held=("root",), pressed=("contact",), n_modes=N_PUNCHED,
                         title="twisted plate, in mm, N, s, t", material="2.1+5           .3      7.8-9")
    mesh_files.write_punch(os.path.join(folder, "plate.pch"), frequencies[:N_PUNCHED], shapes[:N_PUNCHED],
                           title="MODES OF CALCULIX IN THE FORM OF A PUNCH FILE", with_scalar_point=False)


if __name__ == "__main__":
    write(sys.argv[1] if len(sys.argv) > 1 else PLATE)
