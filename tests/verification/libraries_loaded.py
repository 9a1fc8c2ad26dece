"""PETSc and SLEPc are loaded where a scene has finite elements, and nowhere else: a hundred libraries, 0.1 s of every start.

usage: libraries_loaded.py MICROSLIP SOURCE_FOLDER RUN_FOLDER
"""
import os
import subprocess
import sys
import unittest

from program_run import without_plots

PROGRAM, SOURCE, FOLDER = sys.argv[1:4]
SCENES = os.path.join(SOURCE, "share", "scenes")


def loaded(*arguments):
    """File names that the dynamic loader has opened."""
    finished = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=100,
                              env={**without_plots(), "LD_DEBUG": "files"})
    if finished.returncode != 0:
        raise RuntimeError(f"{' '.join(arguments)} ended with {finished.returncode}: {finished.stderr[-2000:]}")
    return {word.split(";")[0] for line in finished.stderr.splitlines() if "calling init" in line
            for word in [os.path.basename(line.split()[-1])]}


def of_petsc(names):
    return sorted(name for name in names if name.startswith(("libpetsc", "libslepc")))


class Libraries(unittest.TestCase):
    def test_a_scene_without_finite_elements_loads_no_solver_of_them(self):
        run = os.path.join(FOLDER, "chain")
        names = loaded("run", os.path.join(SCENES, "chain_2dof.toml"), "-q", "-o", run)
        self.assertTrue(any(name.startswith("libvtk") for name in names), names)  # the loader has told
        self.assertEqual(of_petsc(names), [])

    def test_a_mesh_does(self):
        names = loaded("modes", os.path.join(SCENES, "plate_mesh.toml"), "-q", "-o", os.path.join(FOLDER, "plate"))
        self.assertEqual(len(of_petsc(names)), 2, names)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
