"""How CalculiX integrates C3D15: one element, its matrices as CalculiX stores them, against wedge15 integrated here.

Shape functions and rules are written down anew. On a straight element grad N grad N has degree 4 in the triangle and 4 along it, N N likewise: six
points of the triangle times three along it are exact, which is the rule of the program. CalculiX takes 3 x 3, for the mass as
well: it has rank 27 = 3 x 9 there, so that 18 of 45 motions have no mass.

usage: calculix_wedges.py WORK_FOLDER
"""
import os
import shutil
import subprocess
import sys
import unittest

import numpy as np

WORK = sys.argv[1]
YOUNGS_MODULUS, POISSONS_RATIO, DENSITY = 2.1e11, 0.3, 7800.0
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], float) * [0.02, 0.015, 0.03]
EDGES = ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5))
STRAIGHT = np.vstack([CORNERS, [(CORNERS[a] + CORNERS[b]) / 2 for a, b in EDGES]])
CURVED = STRAIGHT + np.column_stack([np.zeros(15), 5 * STRAIGHT[:, 2] ** 2, 4 * STRAIGHT[:, 1] ** 2])
ROUNDING = 1e-12


def shapes(r, s, t):
    """N (15) and its derivatives by r, s and t (15 x 3)."""
    area, slope = np.array([1 - r - s, r, s]), np.array([[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]])
    n, d = np.zeros(15), np.zeros((15, 3))
    for k, side in ((0, -1.0), (1, 1.0)):
        half = 0.5 * (1 + side * t)
        for i, l in enumerate(area):
            n[i + 3 * k] = l * (2 * l - 1) * half - 0.5 * l * (1 - t * t)
            d[i + 3 * k] = *(((4 * l - 1) * half - 0.5 * (1 - t * t)) * slope[i]), l * (2 * l - 1) * 0.5 * side + l * t
        for j, (a, b) in enumerate(EDGES[:3]):
            n[6 + 3 * k + j] = 4 * area[a] * area[b] * half
            d[6 + 3 * k + j] = *(4 * half * (area[a] * slope[b] + area[b] * slope[a])), 2 * area[a] * area[b] * side
    for i, l in enumerate(area):
        n[12 + i] = l * (1 - t * t)
        d[12 + i] = *((1 - t * t) * slope[i]), -2 * t * l
    return n, d


def three_points():
    return [(1 / 6, 1 / 6, 1 / 6), (2 / 3, 1 / 6, 1 / 6), (1 / 6, 2 / 3, 1 / 6)]


def six_points():
    """Degree 4 (Strang and Fix)."""
    points = []
    for a, weight in ((0.445948490915965, 0.223381589678011 / 2), (0.091576213509771, 0.109951743655322 / 2)):
        points += [(a, a, weight), (1 - 2 * a, a, weight), (a, 1 - 2 * a, weight)]
    return points


def many_points():
    x, w = np.polynomial.legendre.leggauss(14)
    x, w = (x + 1) / 2, w / 2
    return [(a * (1 - b), b, u * v * (1 - b)) for a, u in zip(x, w) for b, v in zip(x, w)]


def matrices(nodes, triangle, n_along):
    lame, shear = YOUNGS_MODULUS * POISSONS_RATIO / (1 + POISSONS_RATIO) / (1 - 2 * POISSONS_RATIO), YOUNGS_MODULUS / 2 / (1 + POISSONS_RATIO)
    elastic = np.diag([2 * shear] * 3 + [shear] * 3)
    elastic[:3, :3] += lame
    K, M = np.zeros((45, 45)), np.zeros((45, 45))
    for t, along in zip(*np.polynomial.legendre.leggauss(n_along)):
        for r, s, weight in triangle:
            n, d = shapes(r, s, t)
            jacobian = nodes.T @ d
            volume = weight * along * np.linalg.det(jacobian)
            strain = np.zeros((6, 45))
            for i, (x, y, z) in enumerate(d @ np.linalg.inv(jacobian)):
                strain[:, 3 * i:3 * i + 3] = [[x, 0, 0], [0, y, 0], [0, 0, z], [y, x, 0], [z, 0, x], [0, z, y]]
            K += volume * strain.T @ elastic @ strain
            M += volume * DENSITY * np.kron(np.outer(n, n), np.eye(3))
    return K, M


def of_calculix(nodes):
    with open(os.path.join(WORK, "wedge.inp"), "w", encoding="ascii") as file:
        file.write("*NODE\n" + "".join(f"{i}, {x:.17g}, {y:.17g}, {z:.17g}\n" for i, (x, y, z) in enumerate(nodes, 1)))
        file.write("*ELEMENT, TYPE=C3D15, ELSET=E\n1, " + ", ".join(map(str, range(1, 16))) + "\n*MATERIAL, NAME=S\n*ELASTIC\n"
                   f"{YOUNGS_MODULUS}, {POISSONS_RATIO}\n*DENSITY\n{DENSITY}\n*SOLID SECTION, ELSET=E, MATERIAL=S\n"
                   "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n10\n*END STEP\n")
    subprocess.run(["ccx", "wedge"], cwd=WORK, capture_output=True)  # it stores them and exits with 201
    with open(os.path.join(WORK, "wedge.dof"), encoding="ascii") as file:
        places = [3 * int(node) + int(axis) - 4 for node, axis in (line.strip().split(".") for line in file)]
    stored = []
    for ending in ("sti", "mas"):
        matrix = np.zeros((45, 45))
        for row, column, value in np.loadtxt(os.path.join(WORK, "wedge." + ending)):
            i, j = places[int(row) - 1], places[int(column) - 1]
            matrix[i, j] = matrix[j, i] = value
        stored.append(matrix)
    return stored


def apart(a, b):
    return np.abs(a - b).max() / np.abs(b).max()


@unittest.skipIf(shutil.which("ccx") is None, "CalculiX (ccx, Debian package calculix-ccx) is not installed")
class Wedges(unittest.TestCase):
    def test_calculix_takes_nine_points(self):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)
        for shape, nodes in (("straight", STRAIGHT), ("curved", CURVED)):
            stored, exact = of_calculix(nodes), matrices(nodes, many_points(), 10)
            nine, eighteen = matrices(nodes, three_points(), 3), matrices(nodes, six_points(), 3)
            for i, name in enumerate(("K", "M")):
                print(f"wedge15 {shape}, {name}: CalculiX to 9 points {apart(stored[i], nine[i]):.1e}; to the exact integral: "
                      f"CalculiX {apart(stored[i], exact[i]):.1e}, 18 points {apart(eighteen[i], exact[i]):.1e}")
                self.assertLess(apart(stored[i], nine[i]), ROUNDING)
                self.assertGreater(apart(stored[i], exact[i]), 5e-3)
                self.assertLess(apart(eighteen[i], exact[i]), ROUNDING if shape == "straight" else 1e-3)
            masses = np.linalg.eigvalsh(stored[1])
            massless = int((masses < 1e-10 * masses.max()).sum())
            print(f"wedge15 {shape}: {massless} of 45 motions without mass in CalculiX")
            self.assertEqual(massless, 18)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
