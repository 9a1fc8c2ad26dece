"""Peaks on more and more contact cells converge as the area of the cells.

Scene: the blade of blade_to_ground.toml on a coarse mesh, friction along p. One point per cell: the force errs where
slip begins and where the mode shapes vary, in proportion to the area of a cell. So the change from one number of
cells to four times as many falls fourfold, a third of it is what is left (Richardson), and the limits extrapolated
from different pairs agree far better than the peaks do.

usage: quadrature_converges.py MICROSLIP SOURCE_FOLDER RUN_FOLDER
"""
import json
import os
import sys
import unittest

from program_run import run_scene, whole_campaigns

PROGRAM, SOURCE, FOLDER = sys.argv[1:4]
SCENE = os.path.join(FOLDER, "blade_to_ground.toml")
PRELOADS = (100, 300)                 # N: with folds, and the best preload's neighbourhood
CELLS = (300, 1200, 4800, 19200) if whole_campaigns() else (300, 1200, 4800)


def write_scene():
    """The scene without its search for the best preload: the curves alone are compared."""
    os.makedirs(FOLDER, exist_ok=True)
    with open(os.path.join(SOURCE, "share", "scenes", "blade_to_ground.toml"), encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("optimum")]
    with open(SCENE, "w", encoding="utf-8") as file:
        file.writelines(lines)


def run(name, *settings):
    folder = os.path.join(FOLDER, name)
    fixed = ("model.element_size=0.008", "response.harmonics=1", "response.maps=[]",
             "effects.second_direction=off", "accuracy.error_budget=off", f"response.preload={list(PRELOADS)}")
    run_scene(PROGRAM, SCENE, folder, *fixed, *settings, options=("-j", "1"))
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file)["curves"]


class Quadrature(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        write_scene()
        cls.cells = {n: run(f"cells_{n}", f"contact.points={n}") for n in CELLS}

    def test_peaks_converge_as_the_area_of_a_cell(self):
        for i, preload in enumerate(PRELOADS):
            peaks = [self.cells[n][i]["peak"]["amplitude_m"] for n in CELLS]
            changes = [after - before for before, after in zip(peaks, peaks[1:])]
            limits = [after + change / 3.0 for after, change in zip(peaks[1:], changes)]
            print(f"preload {preload} N: limit {limits[-1]:.9e} m")
            for n, peak in zip(CELLS, peaks):
                print(f"  {n:6d} cells: peak off by {peak / limits[-1] - 1.0:.2e}, "
                      f"{self.cells[n][i]['seconds']:.2f} s")
            # Cells of the default number are good for a thousandth.
            self.assertLess(abs(peaks[0] / limits[-1] - 1.0), 1e-3)
            # Fourfold: lines of slip cross cells anew at every size, so not to the digit.
            for coarse, fine in zip(changes, changes[1:]):
                self.assertGreater(coarse / fine, 3.0)
                self.assertLess(coarse / fine, 5.5)
            self.assertLess(abs(limits[-1] / limits[-2] - 1.0), 0.1 * abs(peaks[-2] / limits[-1] - 1.0) + 1e-9)

    def test_curves_are_the_same_otherwise(self):
        for coarse, fine in zip(self.cells[CELLS[0]], self.cells[CELLS[-1]]):
            self.assertTrue(coarse["complete"])
            self.assertEqual(len(coarse["peaks"]), len(fine["peaks"]))
            self.assertEqual(len(coarse["folds_Hz"]), len(fine["folds_Hz"]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
