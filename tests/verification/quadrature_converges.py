"""Peaks on more and more contact cells converge to those of the quadrature fitted to the lines of slip.

Scene: the blade of blade_to_ground.toml on a coarse mesh, friction along p. With one point per cell the force
errs with the size of the cells, where slip begins and where the mode shapes vary; fitted, it is told to be within
1e-8 of what the next fit would give. So the distance between the two must fall as the cells get smaller, and the
fitted peak must be nearer to that on the finest cells than the peak on the default 300 cells is.

usage: quadrature_converges.py MICROSLIP SOURCE_FOLDER RUN_FOLDER
"""
import json
import os
import subprocess
import sys
import unittest

PROGRAM, SOURCE, FOLDER = sys.argv[1:4]
SCENE = os.path.join(FOLDER, "blade_to_ground.toml")
PRELOADS = (100, 300)                 # N: with folds, and the best preload's neighbourhood
CELLS = (300, 1200, 4800, 19200)
# Of the peak on 19200 cells: a fourth of the error on 4800, where cells err as their area.
FINEST = 2e-5


def write_scene():
    """The scene without its search for the best preload: the curves alone are compared."""
    os.makedirs(FOLDER, exist_ok=True)
    with open(os.path.join(SOURCE, "share", "scenes", "blade_to_ground.toml"), encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("optimum")]
    with open(SCENE, "w", encoding="utf-8") as file:
        file.writelines(lines)


def run(name, *settings):
    folder = os.path.join(FOLDER, name)
    command = [PROGRAM, "run", SCENE, "-q", "-j", "1", "-o", folder]
    fixed = ("model.element_size=0.008", "response.maps=[]", "effects.second_direction=off", f"response.preload={list(PRELOADS)}")
    for setting in (*fixed, *settings):
        command += ["--set", setting]
    finished = subprocess.run(command, capture_output=True, text=True, timeout=600)
    if finished.returncode != 0:
        raise RuntimeError(f"{' '.join(command)} ended with {finished.returncode}: {finished.stderr}")
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file)["curves"]


def distance(a, b):
    """Largest relative difference of the peaks' amplitudes and frequencies."""
    keys = ("amplitude_m", "frequency_Hz")
    return max(abs(a["peak"][key] / b["peak"][key] - 1) for key in keys)


class Quadrature(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        write_scene()
        cls.fitted = run("fitted", "contact.quadrature=fitted")
        cls.cells = {n: run(f"cells_{n}", f"contact.points={n}") for n in CELLS}

    def test_cells_converge_to_the_fitted_peak(self):
        for i, preload in enumerate(PRELOADS):
            fitted = self.fitted[i]
            print(f"preload {preload} N: fitted {fitted['peak']['amplitude_m']:.9e} m at "
                  f"{fitted['peak']['frequency_Hz']:.9f} Hz, {fitted['seconds']:.2f} s, "
                  f"last change of the force {fitted['largest_quadrature_change']:.1e}")
            error = {n: distance(self.cells[n][i], fitted) for n in CELLS}
            for n in CELLS:
                print(f"  {n:6d} cells: peak off by {error[n]:.2e}, {self.cells[n][i]['seconds']:.2f} s")
            finest = self.cells[CELLS[-1]][i]
            self.assertLess(distance(fitted, finest), distance(self.cells[300][i], finest))
            self.assertLess(error[CELLS[-1]], 0.25 * error[300])
            self.assertLess(error[CELLS[-1]], FINEST)

    def test_curves_are_the_same_otherwise(self):
        finest = self.cells[CELLS[-1]]
        for fitted, cells in zip(self.fitted, finest):
            self.assertTrue(fitted["complete"])
            self.assertEqual(len(fitted["peaks"]), len(cells["peaks"]))
            self.assertEqual(len(fitted["folds_Hz"]), len(cells["folds_Hz"]))
            for one, other in zip(fitted["folds_Hz"], cells["folds_Hz"]):
                self.assertAlmostEqual(one / other, 1.0, delta=FINEST)
            self.assertLessEqual(fitted["largest_quadrature_change"], 1e-8)

    def test_what_the_fitted_rule_does_not_know_is_refused(self):
        for setting in ("contact.fit=none", "response.method=time", "response.harmonics=3",
                        'contact.preload_moment=["1 N*m", 0]', "response.search_starts=3"):
            finished = subprocess.run(
                [PROGRAM, "check", SCENE, "--set", "contact.quadrature=fitted", "--set", setting],
                capture_output=True, text=True, timeout=100)
            self.assertEqual(finished.returncode, 1, setting)
            self.assertIn("contact.quadrature", finished.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
