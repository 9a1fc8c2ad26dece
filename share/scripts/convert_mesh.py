#!/usr/bin/python3
"""A mesh of another code as a file of gmsh 2.2, which the program reads.

    convert_mesh.py INPUT OUTPUT.msh FACTS.json SECONDS MEGABYTES

The ending of INPUT tells its format: .inp, .bdf .nas .fem, .unv, .med, .vtu .vtk, .e .exo .ex2. FACTS.json says what a
.msh file has no place for: {"length_unit": metres, or null where the file does not say, "left_out": what holds the structure
together and is not read, as [{"place": "file:line", "what": "*TIE", "remedy": "…", "count": 1}]}. Limits itself to SECONDS of
processor time and MEGABYTES of address space. What is wrong is told in the last line of standard error: exit code 1.
"""
import dataclasses
import json
import os
import sys

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # its workers take address space, and nothing here needs them
sys.dont_write_bytecode = True  # a full disk cuts it off, and no later run could read it
sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))

from microslip.conversion import problem_of, run


def reader_of(ending):
    from microslip.meshes import abaqus, exodus, nastran, universal, with_meshio
    return {".inp": abaqus.read, ".bdf": nastran.read, ".nas": nastran.read, ".fem": nastran.read,
            ".unv": universal.read, ".med": with_meshio.read_med, ".vtu": with_meshio.read_vtk,
            ".vtk": with_meshio.read_vtk, ".e": exodus.read, ".exo": exodus.read, ".ex2": exodus.read}[ending.lower()]


def convert(source, output, facts):
    from microslip.meshes import gmsh_file
    content = reader_of(os.path.splitext(source)[1])(source)
    gmsh_file.write(content, source, output)
    with open(facts, "w", encoding="utf-8") as file:
        json.dump({"length_unit": content.length_unit, "left_out": [dataclasses.asdict(one) for one in content.left_out]}, file)


if __name__ == "__main__":
    if len(sys.argv) != 6:
        sys.exit(__doc__)
    sys.exit(run(convert, *sys.argv[1:]))
