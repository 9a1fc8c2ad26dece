#!/usr/bin/python3
"""A mesh of another code as a file of gmsh 2.2, which the program reads.

    convert_mesh.py INPUT OUTPUT.msh FACTS.json SECONDS MEGABYTES

The ending of INPUT tells its format: .inp, .bdf .nas .fem, .unv, .med, .vtu .vtk, .e .exo .ex2. FACTS.json says what a
.msh file has no place for: {"length_unit": metres, or null where the file does not say}. Limits itself to SECONDS of
processor time and MEGABYTES of address space. What is wrong is told in the last line of standard error: exit code 1.
"""
import json
import os
import resource
import sys

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # its workers take address space, and nothing here needs them
sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))

PACKAGES = {"numpy": "python3-numpy", "meshio": "python3-meshio", "h5py": "python3-h5py", "netCDF4": "python3-netcdf4"}


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
        json.dump({"length_unit": content.length_unit}, file)


def problem_of(source, error):
    """A sentence for the user."""
    if isinstance(error, MemoryError):
        return f"{source}: reading it needs more memory than is allowed"
    if isinstance(error, ModuleNotFoundError) and error.name in PACKAGES:
        package = PACKAGES[error.name]
        return f"{source}: this format needs the Debian package {package}: apt-get install {package}"
    if type(error).__name__ == "Refused":
        return str(error)
    return f"{source}: reading it failed: {type(error).__name__}: {' '.join(str(error).split())}"


def main(source, output, facts, seconds, megabytes):
    resource.setrlimit(resource.RLIMIT_CPU, (int(float(seconds)) + 1,) * 2)
    resource.setrlimit(resource.RLIMIT_AS, (int(float(megabytes) * 1e6),) * 2)
    try:
        convert(source, output, facts)
    except Exception as error:  # whatever a library throws at a damaged file
        print(problem_of(source, error), file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 6:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
