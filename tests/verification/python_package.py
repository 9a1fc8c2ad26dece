"""The Python package as a user meets it: runs, results, sweeps, errors, what is missing; the examples of
share/doc/python.md and the notebook run as they stand; report.html holds what the run holds.

usage: python_package.py PROGRAM SOURCE_FOLDER WORKING_FOLDER
"""
import base64
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import warnings
from unittest import mock

PROGRAM, SOURCE, WORK = sys.argv[1:4]
del sys.argv[1:4]
sys.path.insert(0, os.path.join(SOURCE, "share", "python"))
sys.dont_write_bytecode = True

import numpy as np

import microslip

CHAIN = os.path.join(SOURCE, "share", "scenes", "chain_2dof.toml")
ONE_CURVE = {"response.harmonics": 1, "response.preload": [50], "response.optimum": None, "response.optimum_range": None}
BLADE = os.path.join(SOURCE, "share", "scenes", "blade_to_ground.toml")
# Six curves, one after the other, all but the first of a second or more.
SLOW = ["-j", "1", "--no-cache", *(word for setting in (
    "model.element_size=10 mm", "response.harmonics=9", "response.optimum=", "response.optimum_range=",
    'response.preload=["free", 60, 100, 150, 300, 500]') for word in ("--set", setting))]
ENVIRONMENT = {**os.environ, "MICROSLIP": PROGRAM, "PYTHONPATH": os.path.join(SOURCE, "share", "python"),
               "MPLBACKEND": "agg", "PYTHONDONTWRITEBYTECODE": "1"}


def have(package):
    return importlib.util.find_spec(package) is not None


def fresh(name):
    folder = os.path.join(WORK, name)
    shutil.rmtree(folder, ignore_errors=True)
    return folder


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.makedirs(WORK, exist_ok=True)
        os.environ["MICROSLIP"] = PROGRAM
        if not hasattr(Case, "run_"):  # one run, plots and page included, serves all
            Case.run_ = microslip.run(CHAIN, {"response.harmonics": 1, "response.maps": ["peak"],
                                             "response.preload": ["free", 50, 100, "stuck"]}, folder=fresh("chain"))

    def copy(self, name):
        """The folder of the run, to be damaged."""
        return shutil.copytree(self.run_.folder, fresh(name))


class Results(Case):
    def test_curves_are_those_of_the_files(self):
        curve = self.run_.curves["preload_50"]
        with open(os.path.join(self.run_.folder, "curves", "preload_50.csv"), encoding="utf-8") as file:
            head, *rows = file.read().splitlines()
        column = head.split(",").index("amplitude_m")
        np.testing.assert_array_equal(curve["amplitude_m"], [float(row.split(",")[column]) for row in rows])
        self.assertEqual(curve.preload, 50.0)
        self.assertEqual(list(curve.peaks["amplitude_m"]), [curve.peak["amplitude_m"]])
        with self.assertRaisesRegex(KeyError, "amplitude_m"):
            curve["amplitude"]

    def test_peaks_optimum_and_budget_are_those_of_the_summary(self):
        with open(os.path.join(self.run_.folder, "summary.json"), encoding="utf-8") as file:
            summary = json.load(file)
        peaks = self.run_.peaks
        self.assertEqual(list(peaks["amplitude_m"]), [curve["peak"]["amplitude_m"] for curve in summary["curves"]])
        self.assertTrue(np.isnan(peaks["preload_N"][peaks["curve"].index("free")]))
        self.assertEqual(self.run_.optimum["value"], summary["optimum"]["value"])
        self.assertEqual(list(self.run_.budget["effect"]), [row["effect"] for row in summary["error_budget"]])
        self.assertEqual(self.run_.scene["response"]["harmonics"], 1)

    def test_peaks_have_what_they_dissipate_and_its_bar(self):
        peaks = self.run_.peaks
        for name in ("preload_50", "preload_100"):
            row, curve = peaks["curve"].index(name), self.run_.curves[name]
            at_peak = np.argmax(curve["amplitude_m"])
            self.assertAlmostEqual(peaks["dissipated_energy_J"][row] / curve.energy["dissipated_energy_J"][at_peak], 1, delta=1e-6)
            rows = [row for row in self.run_.summary["error_budget"] if (row["curve"], row["goal"]) == (name, "dissipated_energy")]
            self.assertAlmostEqual(peaks["energy_bar"][row], sum(abs(row["effect"]) for row in rows), delta=1e-12)
            self.assertGreater(peaks["energy_bar"][row], 1e-6)

    def test_the_energy_of_the_motion_is_that_of_the_map(self):
        curve, contact = self.run_.curves["preload_50"], self.run_.maps["preload_50_peak"]
        at_peak = np.array(curve["mark"]) == "peak"
        of_map = np.sum(contact["weights"] * contact["dissipated_energy_J_per_m2"])
        np.testing.assert_allclose(curve.energy["dissipated_energy_J"][at_peak], of_map, rtol=1e-6)

    def test_a_free_structure_has_its_modal_damping(self):
        curve = self.run_.curves["free"]  # near the first of two modes: 20.0 and 52.4 Hz
        at = int(np.argmax(curve["amplitude_m"]))
        self.assertAlmostEqual(curve.energy["equivalent_damping_ratio"][at], 0.02, delta=2e-4)
        self.assertLess(np.abs(curve.energy["dissipated_energy_J"]).max(), 1e-9)  # of some 0.4 J of the excitation

    @unittest.skipUnless(have("pandas") and have("xarray"), "pandas and xarray are not installed")
    def test_pandas_and_xarray(self):
        frame = self.run_.peaks.frame()
        self.assertEqual(len(frame), len(self.run_.curves))
        data = self.run_.maps["preload_50_peak"].dataset()
        self.assertEqual(dict(data.sizes), {"point": 1, "phase_deg": len(data["phase_deg"])})
        self.assertEqual(self.run_.curves["free"].dataset().sizes["row"], self.run_.curves["free"].n_rows)

    def test_figures_are_those_of_the_report(self):
        for figure in (self.run_.plot_curves(), self.run_.plot_peaks(), self.run_.plot_error_budget(), self.run_.plot_map()):
            self.assertTrue(figure.axes)
        lines = self.run_.curves["preload_50"].plot().lines
        self.assertGreater(max(len(line.get_xdata()) for line in lines), 20)
        with self.assertRaisesRegex(microslip.RunError, "no search"):
            self.run_.plot_parameter()

    def test_the_loop_of_the_page_holds_the_energy_of_the_map(self):
        from microslip.report.drawn import loop_of
        contact = self.run_.maps["preload_50_peak"]
        loop = loop_of(contact)  # of 24 phases: the corners of the loop are cut off
        area = abs(np.trapz(loop["y"], 1e-6 * np.array(loop["x"])))
        self.assertAlmostEqual(area / np.sum(contact["weights"] * contact["dissipated_energy_J_per_m2"]), 1.0, delta=0.05)

    def blade(self):
        if not hasattr(Case, "blade_"):
            Case.blade_ = microslip.run(BLADE,
                                        {"model.element_size": "20 mm", "modes.count": 2, "response.preload": [300],
                                         "response.harmonics": 1, "response.optimum": None, "response.maps": ["peak"],
                                         "response.optimum_range": None, "accuracy.error_budget": "off"},
                                        folder=fresh("blade"), without=["plots"])
        return Case.blade_

    def test_a_structure_with_a_mesh_has_shapes_and_cells(self):
        run = self.blade()
        mesh = run.modes.mesh()
        self.assertEqual(mesh.point_data["mode_1"].shape, (len(mesh.points), 3))
        (contact,) = run.maps.values()
        cells = contact.mesh(90.0)
        phase = list(contact["phase_deg"]).index(90.0)
        np.testing.assert_array_equal(cells.cell_data["state"][0], contact["state"][:, phase])
        self.assertAlmostEqual(contact["weights"].sum(), 6e-4, places=8)  # 60 × 10 mm
        corners = cells.points[cells.cells[0].data]
        areas = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        np.testing.assert_allclose(areas, contact["weights"], rtol=1e-6)

    def picture_of_paraview(self, phase):
        """Red, green, blue of 700 × 1600 pixels; skips the test where there is no ParaView."""
        pvbatch = os.environ.get("PVBATCH") or os.environ.get("DISPLAY") and shutil.which("pvbatch")
        if not pvbatch:
            self.skipTest("PVBATCH names no pvbatch, nor is one on the PATH and a display there: share/doc/paraview.md")
        picture = os.path.join(WORK, "paraview.png")
        ended = subprocess.run([pvbatch, os.path.join(SOURCE, "share", "paraview", "open_run.py"), self.blade().folder,
                                next(iter(self.blade().maps)), picture, str(phase)], capture_output=True, text=True, timeout=200)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        from matplotlib.image import imread
        return (imread(picture)[:, :, :3] * 255).round().astype(int)

    def test_paraview_shows_the_states_in_their_colours_beside_the_moved_blade(self):
        picture = self.picture_of_paraview(60)
        from microslip.states import STATES
        (contact,) = self.blade().maps.values()
        states = contact["state"][:, np.abs(contact["phase_deg"] - 60.0).argmin()]
        cells = np.array([np.sum(states == value) for value, _, _ in STATES])
        self.assertGreater(np.count_nonzero(cells), 1)
        colours = [[int(colour[i:i + 2], 16) for i in (1, 3, 5)] for _, _, colour in STATES]
        pixels = np.array([np.sum(np.abs(picture[:, 800:] - colour).max(axis=2) <= 2) for colour in colours])
        self.assertGreater(pixels.min(), 0)  # the legend has every state, the smallest share of the cells none
        drawn = pixels - pixels[np.argmin(cells)]
        self.assertGreater(drawn.sum(), 30000)
        np.testing.assert_allclose(drawn / drawn.sum(), cells / cells.sum(), atol=0.02)  # pixels on the boundary are of no state

        structure = picture[:550, :660]  # without the bar and the axes
        coloured = np.ptp(structure, axis=2) > 20
        rows = np.flatnonzero(coloured.any(axis=1))
        self.assertGreater(np.ptp(rows), 400)
        tip, platform = (structure[band][coloured[band]].mean(axis=0) for band in (rows[:40], rows[-20:]))
        self.assertGreater(tip[1], 2 * tip[0])  # viridis: green where it moves, violet where it rests
        self.assertGreater(platform[0], 4 * platform[1])

    def test_what_has_no_mesh_says_so(self):
        with self.assertRaisesRegex(microslip.RunError, "only scenes with a mesh"):
            self.run_.modes.mesh()
        with self.assertRaisesRegex(microslip.RunError, "no cells"):
            self.run_.maps["preload_50_peak"].mesh()


class Damaged(Case):
    def test_a_damaged_curve_costs_that_curve(self):
        folder = self.copy("damaged")
        path = os.path.join(folder, "curves", "preload_50.csv")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write(text[:len(text) // 2])
        run = microslip.open(folder)
        self.assertGreater(run.curves["free"].n_rows, 20)
        with self.assertRaisesRegex(microslip.RunError, r"preload_50.csv:\d+: "):
            run.curves["preload_50"]

    def test_no_run_an_older_one_and_one_that_goes_on(self):
        folder = self.copy("unfinished")
        path = os.path.join(folder, "summary.json")
        with open(path, encoding="utf-8") as file:
            summary = json.load(file)
        for content, complaint in (("{\n\"a\": [", r"summary.json:2:\d+: .* JSON"), ("[]", "no summary of a run"), ("{\"curves\": [{}]}", r"curves\[0\] lacks")):
            with open(path, "w", encoding="utf-8") as file:
                file.write(content)
            with self.assertRaisesRegex(microslip.RunError, complaint):
                microslip.open(folder)
        summary.update(exit_code=3, message="the run has not come to its end")
        for later in ("effects", "error_budget", "optimum"):  # which older versions did not write
            summary.pop(later)
        with open(path, "w", encoding="utf-8") as file:
            json.dump(summary, file)
        with self.assertWarnsRegex(microslip.RunWarning, "not come to its end"):
            run = microslip.open(folder)
        self.assertEqual((run.exit_code, run.optimum, run.budget.n_rows), (3, None, 0))
        self.assertGreater(run.curves["free"].n_rows, 20)
        summary["curves"] = []
        with open(path, "w", encoding="utf-8") as file:
            json.dump(summary, file)
        with self.assertWarns(microslip.RunWarning), self.assertRaisesRegex(microslip.RunError, "no finished curve"):
            microslip.open(folder).plot_curves()
        with self.assertRaisesRegex(microslip.RunError, "summary.json is missing"):
            microslip.open(os.path.join(folder, "curves"))
        with self.assertRaisesRegex(microslip.RunError, "summary.json is missing; is this the folder"):
            microslip.open(path)

    def test_a_run_that_is_being_written_has_its_finished_curves(self):
        folder = fresh("running")
        process = subprocess.Popen([PROGRAM, "run", BLADE, *SLOW, "-q", "-o", folder], env=ENVIRONMENT)
        try:
            path = os.path.join(folder, "summary.json")
            while not os.path.exists(path) or not microslip.files.read_summary(path)["curves"]:
                self.assertIsNone(process.poll(), "it has ended before it was looked at")
                time.sleep(0.05)
            with self.assertWarnsRegex(microslip.RunWarning, r"still being written: (1 curve is|\d+ curves are) there so far"):
                run = microslip.open(folder)
            self.assertTrue(run.is_running)
            self.assertIn("still being written", repr(run))
            self.assertLess(len(run.curves), 6)
            curve = run.curves["free"]
            self.assertTrue(curve.summary["complete"])
            self.assertGreater(curve.n_rows, 20)
            self.assertEqual(run.peaks["curve"], list(run.curves))
        finally:
            process.kill()
            process.wait()
        with self.assertWarnsRegex(microslip.RunWarning, "goes on, or was killed"):
            ended = microslip.open(folder)
        self.assertFalse(ended.is_running)
        self.assertIn("free", ended.curves)

    def test_packages_that_are_missing_are_named(self):
        for package, use in (("matplotlib", self.run_.plot_curves), ("pandas", self.run_.frame),
                             ("xarray", self.run_.peaks.dataset), ("meshio", self.run_.maps["preload_50_peak"].mesh),
                             ("h5py", lambda: microslip.open(self.run_.folder).curves["preload_50"].energy)):
            with self.subTest(package), mock.patch.dict(sys.modules, {package: None}):
                with self.assertRaisesRegex(microslip.MissingPackage, rf"{package} is not installed.*apt-get.*without it"):
                    use()


class Running(Case):
    def test_overrides_reach_the_scene(self):
        run = microslip.run(CHAIN, {**ONE_CURVE, "title": "a \"b\" µ\\", "modes.damping_ratio": np.float64(0.01)},
                            folder=fresh("overrides"), without=["plots", "maps"])
        self.assertEqual((run.title, run.scene["modes"]["damping_ratio"]), ("a \"b\" µ\\", 0.01))
        self.assertEqual((list(run.curves), run.optimum), (["preload_50"], None))
        self.assertFalse(os.path.exists(os.path.join(run.folder, "plots")))

    def test_errors_carry_message_and_exit_code(self):
        with self.assertRaises(microslip.BadInput) as caught:
            microslip.run(CHAIN, {"modes.dampng_ratio": 1}, folder=fresh("bad"))
        self.assertEqual(caught.exception.exit_code, 1)
        self.assertIn("damping_ratio", str(caught.exception))
        with self.assertRaises(microslip.Refused) as caught:
            microslip.run(self.loose(), folder=fresh("refused"))
        self.assertEqual(caught.exception.exit_code, 2)
        with self.assertRaisesRegex(microslip.BadInput, "no/such: no such program"):
            microslip.run(CHAIN, program="no/such")
        with self.assertRaisesRegex(TypeError, "a scene holds"):
            microslip.run(CHAIN, {"title": object()})

    def loose(self):
        """A scene with a mode that nothing holds."""
        path = os.path.join(WORK, "loose.toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write("[model]\nkind = \"modal\"\n[modal]\nfrequency = [0, 41.4]\ndamping_ratio = 0.01\nforce_sine = [0, 0.3]\n"
                       "output = [0.9, 0.35]\npoints = []\n[response]\nfrequency = [10, 30]\n")
        return path

    def test_a_sweep_goes_on_past_what_fails(self):
        sweep = microslip.sweep(CHAIN, {"contact.points[0].friction_coefficient": [0.5, -1], "response.preload": [[50], [100]]},
                                overrides={**ONE_CURVE}, folder=fresh("sweep"), progress=False)
        self.assertEqual([point.values["contact.points[0].friction_coefficient"] for point in sweep.failed], [-1, -1])
        self.assertIn("-1 is out of range", str(sweep.failed[0].error))
        self.assertEqual(sweep.peaks["curve"], ["preload_50", "preload_100"])
        once = self.run_.curves["preload_100"].peak["amplitude_m"]
        self.assertAlmostEqual(sweep.peaks["amplitude_m"][1] / once, 1.0, places=8)

    def test_a_sweep_takes_lists(self):
        for one in ("1 %", 0.01):  # a text is no list of letters
            with self.assertRaisesRegex(ValueError, "values of modes.damping_ratio: expected a list"):
                microslip.sweep(CHAIN, {"modes.damping_ratio": one}, progress=False)


class Page(Case):
    def page(self, folder):
        with open(os.path.join(folder, "report.html"), encoding="utf-8") as file:
            return file.read()

    def data(self, text):
        return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S)[1])

    def test_the_page_tells_the_best_value_with_other_contact_data(self):
        entries = self.run_.optimum["bracket"]
        self.assertEqual(len(entries), 4)
        rows = re.findall(r"<tr><td>([a-z ]+) × ([\d.]+).*?</td><td class=n>(.*?)</td>", self.page(self.run_.folder))
        self.assertEqual([(name.replace(" ", "_"), float(factor)) for name, factor, _ in rows],
                         [(entry["parameter"], entry["factor"]) for entry in entries])
        for (*_, value), entry in zip(rows, entries):
            self.assertAlmostEqual(float(value) / entry["value"], 1.0, delta=0.1)

    def test_the_page_holds_sections_curves_and_budget(self):
        text = self.page(self.run_.folder)
        headings = ["Warnings", "Response", "Peak against preload", "Contact maps", "How far the peaks can be trusted",
                    "What was asked", "Effects", "Structure", "Cost"]
        self.assertEqual(re.findall(r"<h2>(.*?)</h2>", text), headings)
        for curve in self.data(text)["curves"]:
            amplitude = self.run_.curves[curve["name"]]["amplitude_m"]
            np.testing.assert_allclose(np.array(curve["values"]["amplitude"]) * 1e-3, amplitude, rtol=1e-6)
            self.assertEqual(curve["stable"], list(self.run_.curves[curve["name"]]["stable"]))
        largest = max((row for row in self.run_.summary["error_budget"] if row["goal"] == "peak_amplitude"),
                      key=lambda row: abs(row["effect"]))
        self.assertIn(f"{100 * largest['effect']:+.2g} %", text)
        for asked in ("friction coefficient", "tangential stiffness", "amplitude 10", "damping ratio"):
            self.assertIn(asked, text)
        self.assertNotRegex(text, r"""(src|href)=["']?(https?:)?//""")

    def test_the_loops_of_points_enclose_what_they_dissipate(self):
        contact = next(self.run_.maps[name] for name in self.run_.maps
                       if self.run_.maps[name]["dissipated_energy_J_per_m2"].max() > 0)
        entry = next(entry for entry in self.data(self.page(self.run_.folder))["maps"] if entry["name"] == contact.name)
        along_p = entry["cycles"][0]
        n, m = entry["n"], len(entry["phases"])
        x, y = (part["unit"] * np.frombuffer(base64.b64decode(part["data"]), "<i2").reshape(n, m)
                for part in (along_p["x"], along_p["y"]))
        area = 0.5 * np.sum(y * (np.roll(x, -1, axis=1) - np.roll(x, 1, axis=1)), axis=1)  # µm × MPa: J/m²
        energy = contact["dissipated_energy_J_per_m2"]
        np.testing.assert_allclose(area, energy, atol=0.02 * energy.max())  # corners of the loop between phases are cut

    def test_a_title_cannot_end_the_page(self):
        run = microslip.run(CHAIN, {**ONE_CURVE, "title": "</script><script>alert(1)</script>"}, folder=fresh("title"))
        text = self.page(run.folder)
        self.assertEqual(text.count("<script"), 2)
        self.assertIn("&lt;script&gt;", text)

    def test_a_page_needs_neither_matplotlib_nor_every_file(self):
        folder = self.copy("lean")
        os.remove(os.path.join(folder, "scene.toml"))
        os.remove(os.path.join(folder, "curves", "stuck.csv"))
        hidden = tempfile.mkdtemp(dir=WORK)
        with open(os.path.join(hidden, "matplotlib.py"), "w", encoding="utf-8") as file:
            file.write("raise ModuleNotFoundError('hidden', name='matplotlib')\n")
        ended = subprocess.run(["/usr/bin/python3", os.path.join(SOURCE, "share", "scripts", "report_run.py"), folder],
                               capture_output=True, text=True, env={**ENVIRONMENT, "PYTHONPATH": hidden})
        self.assertEqual(ended.returncode, 1)
        self.assertIn("matplotlib is not installed", ended.stderr)
        text = self.page(folder)
        self.assertIn("curves/stuck.csv is missing", text)
        self.assertIn("scene.toml is missing", text)
        self.assertEqual(len(self.data(text)["curves"]), len(self.run_.curves) - 1)

    def browser(self, width):
        """Its command, for a window so wide."""
        browser = next(filter(None, map(shutil.which, ("chromium-headless-shell", "chromium", "chromium-browser"))), None)
        if not browser:
            self.skipTest("no browser is installed: apt-get install chromium-headless-shell")
        return [browser, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tempfile.mkdtemp(dir=WORK)}",
                f"--window-size={width},4000", "--virtual-time-budget=2000"]

    def drawn(self, page, width):
        """The page as its scripts leave it."""
        words = [*self.browser(width), "--dump-dom", "file://" + page]
        return subprocess.run(words, capture_output=True, text=True, timeout=120, check=True).stdout

    def measured(self, text, expression, width):
        """What a browser makes of an expression on a page."""
        page = os.path.join(WORK, "measured.html")
        with open(page, "w", encoding="utf-8") as file:
            file.write(text + f"<script>document.body.dataset.measured = {expression};</script>")
        return re.search(r'data-measured="(.*?)"', self.drawn(page, width))[1]

    def test_a_browser_draws_it_at_two_widths(self):
        target = os.path.join(self.run_.folder, "report.html")
        for width in (1200, 420):
            picture = os.path.join(WORK, f"report_{width}.png")
            subprocess.run([*self.browser(width), f"--screenshot={picture}", "file://" + target], capture_output=True, timeout=120,
                           check=True)
            self.assertGreater(os.path.getsize(picture), 20000)
        drawn = self.drawn(target, 420)
        paths = re.findall(r'<path d="M[^"]*[LC]', drawn)
        self.assertGreaterEqual(len(paths), len(self.run_.curves))
        self.assertRegex(drawn, r"Hysteresis of point \d+: [\d.]+ % of the area")

    def test_the_page_draws_the_cubics_and_no_line_over_a_gap(self):
        """The free curve alone: one cubic an interval; a gap parts it."""
        text = self.page(self.run_.folder)
        data = self.data(text)
        data["curves"] = [next(curve for curve in data["curves"] if curve["name"] == "free")]
        data["curves"][0]["stable"] = [1] * len(data["curves"][0]["stable"])
        n = len(data["curves"][0]["frequency"]) - 1
        self.assertEqual(len(data["curves"][0]["between"]["amplitude"]), n)
        data["curves"][0]["between"]["amplitude"][n // 2] = None
        start, end = re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S).span(1)
        letters = "document.querySelector('[data-chart=curves] svg g path').getAttribute('d').replace(/[^A-Z]/g, '')"
        drawn = self.measured(text[:start] + json.dumps(data) + text[end:], letters, 1000)
        self.assertEqual(drawn, "M" + n // 2 * "C" + "M" + (n - 1 - n // 2) * "C")

    def test_a_browser_draws_cells_part_by_part(self):
        """Of a row of squares half of the first slips, at every phase."""
        text = self.page(self.run_.folder)
        data = self.data(text)
        entry, n = data["maps"][0], data["maps"][0]["n"]
        corners = [[i // 2, i % 2] for i in range(2 * n + 2)]
        m = len(entry["phases"])
        halves = np.array([[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]])
        part = {"cells": [0], "states": [0, 1], "sizes": [3, 3],
                "corners": {"unit": 1.0, "data": base64.b64encode(halves.astype("<i2").tobytes()).decode()}}
        entry.update(cells=[[2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1] for i in range(n)], corners=sum(corners, []), boundaries=[],
                     arrows=[], period={}, parted=[part] * m, states=base64.b64encode(bytes(n * m)).decode())
        data["maps"] = [entry]
        start, end = re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S).span(1)
        pixels = ("(c => { const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data; let n = 0;"
                  "for (let i = 0; i < d.length; i += 4) if (d[i] > 200 && d[i + 2] < 120) ++n;"
                  "return n / c.height ** 2; })(document.querySelector('[data-chart=maps] canvas'))")
        share = float(self.measured(text[:start] + json.dumps(data) + text[end:], pixels, 1000))
        self.assertLess(abs(share / 0.5 - 1), 0.02)  # of a square; a ring lies on one

    def test_every_peak_can_be_zoomed_on(self):
        """In the middle, and the only one of its curve: 40 resonances of which the highest is 1000 times the lowest."""
        text = self.page(self.run_.folder)
        data = self.data(text)
        places, n = 20.0 + 10.0 * np.arange(40), 15
        near = np.sinh(np.linspace(-6.0, 6.0, n)) / np.sinh(6.0)
        frequency = (places[:, None] + 4.9 * near).ravel()
        amplitude = (np.geomspace(1.0, 1e-3, 40)[:, None] / np.hypot(1.0, 500.0 * near)).ravel()
        one = {**data["curves"][0], "frequency": list(frequency), "values": {"amplitude": list(amplitude)}, "between": {}, "bar": None,
               "stable": [1] * len(frequency), "mark": ["peak" if i % n == n // 2 else "" for i in range(len(frequency))]}
        one.pop("richer", None)
        data["curves"], data["peaks"] = [one], []
        start, end = re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S).span(1)
        seen = ("[...document.querySelectorAll('[data-tools=curves] select option')].slice(1).map((_, i) => {"
                "const list = document.querySelector('[data-tools=curves] select'); list.selectedIndex = i + 1; list.onchange();"
                "const svg = document.querySelector('[data-chart=curves] svg'), middle = (62 + svg.viewBox.baseVal.width - 12) / 2;"
                "return [...svg.querySelectorAll('g circle')].map(c => c.getAttribute('cx') - middle).filter(x => Math.abs(x) < 450)"
                ".map(x => Math.round(x)).join(' '); }).join()")
        self.assertEqual(self.measured(text[:start] + json.dumps(data) + text[end:], seen, 1000), ",".join("0" * 40))

    def test_rounding_does_not_squeeze_the_dissipated_energy(self):
        text = self.page(self.run_.folder)
        data = self.data(text)
        next(curve for curve in data["curves"] if curve["name"] == "preload_50")["values"]["dissipated_energy"][0] = 1e-18
        start, end = re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S).span(1)
        labels = ("(() => { [...document.querySelectorAll('[data-tools=curves] button')].find(b => b.textContent.startsWith('dissipated')).click();"
                  "return [...document.querySelectorAll('[data-chart=curves] svg text[text-anchor=end]')].map(t => t.textContent).join(); })()")
        drawn = self.measured(text[:start] + json.dumps(data) + text[end:], labels, 1000).split(",")
        self.assertGreater(len(drawn), 3)
        self.assertFalse([label for label in drawn if re.search("10⁻[¹²³⁴⁵⁶⁷⁸⁹]{2}|10⁻[⁷⁸⁹]", label)], drawn)

    def test_paper_names_the_map_it_shows(self):
        text = self.page(self.run_.folder).replace("@media print", "@media screen")
        shown = self.measured(text, "document.querySelector('[data-chart=maps]').innerText.split('\\n')[0]", 718)
        self.assertRegex(shown, r"^preload_\d+_peak, [\d.]+ Hz, state; θ = \d+°: ")

    def test_bars_of_one_budget_start_at_one_place(self):
        text = self.page(self.run_.folder).replace("<details>", "<details open>")
        starts = ("Math.max(...[...document.querySelectorAll('.budget')].map(b => new Set([...b.querySelectorAll('.bar i')]"
                  ".map(bar => Math.round(bar.getBoundingClientRect().left))).size))")
        self.assertGreater(text.count("<div class=bar>"), 3)
        for width in (1200, 420):
            self.assertEqual(self.measured(text, starts, width), "1")

    def test_the_limits_are_lines_beside_a_single_gap(self):
        text = self.page(self.run_.folder)
        data = self.data(text)
        next(peak for peak in data["peaks"] if peak["preload"] == 50).update(preload=-50, gap=8.0)
        start, end = re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S).span(1)
        longest = ("Math.max(...[...document.querySelectorAll('[data-chart=peaks] svg[aria-label$=\"gap [µm]\"] path')]"
                   ".map(line => line.getBoundingClientRect().width))")
        self.assertGreater(float(self.measured(text[:start] + json.dumps(data) + text[end:], longest, 1000)), 100)  # [px]

    def test_a_unit_stands_behind_numbers_alone(self):
        from microslip.report.sections import setting_row
        for key, value, told in (("preload", ["free", -500, "stuck"], "free, −500 N, stuck"), ("preload", [20, 30], "20, 30 N"),
                                 ("frequency", [285, 340], "285, 340 Hz"), ("frequency", ["285 Hz", "340 Hz"], "285 Hz, 340 Hz"),
                                 ("phase", 90, "90 °"), ("count", 10, "10"), ("clamped", ["root"], "root")):
            self.assertEqual(setting_row(key, value)[1], told)

    def test_a_narrow_window_and_paper_hide_nothing(self):
        text = self.page(self.run_.folder)
        beyond = "(t => t.scrollWidth - t.clientWidth)(document.querySelector('.effects'))"
        self.assertEqual(self.measured(text, beyond, 420), "0")  # [px]
        height = "document.querySelector('#what-was-asked details').offsetHeight"
        on_paper = text.replace("@media print", "@media screen")
        styles = ("(s => [s(document.querySelector('.bar i')).printColorAdjust, s(document.querySelector('.effects tbody tr')).breakInside,"
                  "s(document.querySelector('.effects thead')).display, s(document.querySelector('.effects')).overflowX].join())(getComputedStyle)")
        self.assertEqual(self.measured(on_paper, styles, 718), "exact,avoid,table-header-group,visible")
        beyond_paper = "Math.max(...[...document.querySelectorAll('.wide')].map(t => t.scrollWidth - t.clientWidth))"
        self.assertLessEqual(float(self.measured(on_paper, beyond_paper, 718)), 0)  # [px] of A4
        columns = "getComputedStyle(document.querySelector('.charts')).gridTemplateColumns.split(' ').length"
        self.assertEqual(self.measured(on_paper, columns, 718), "2")
        as_wide = ("(window.dispatchEvent(new Event('beforeprint')), [...document.querySelectorAll('.charts svg')]"
                   ".map(svg => svg.viewBox.baseVal.width).join())")
        self.assertRegex(self.measured(text, as_wide, 1200), "^345(,345)*$")  # so that letters keep their size
        split = ("[...document.querySelectorAll('.effects tbody td:not(:last-child)')].filter(cell => { const r = document.createRange();"
                 "r.selectNodeContents(cell); return r.getClientRects().length > cell.textContent.split(' ').length + cell.children.length; })"
                 ".length")
        self.assertEqual(self.measured(on_paper, split, 718), "0")  # no more lines than words
        folded, unfolded = (float(self.measured(page, height, 1200)) for page in (text, on_paper))
        self.assertGreater(unfolded, 5 * folded)


def duffing(amplitudes, alpha=0.1, zeta=0.02, force=0.2):
    """Upper branch of a spring that hardens, up to its peak: frequency over amplitude, F² = [(1 − ω² + ¾αA²)² + (2ζω)²] A².
    Its slopes are exact; it leans to higher frequencies and has no fold below its peak."""
    a = amplitudes
    k = 1 + 0.75 * alpha * a**2
    b = 2 * zeta**2 - k  # ω⁴ + 2bω² + k² − F²/A² = 0
    c = k**2 - (force / a) ** 2
    root = np.sqrt(b**2 - c)
    frequency = np.sqrt(-b - root)
    dk = 1.5 * alpha * a
    db, dc = -dk, 2 * k * dk + 2 * force**2 / a**3
    by_amplitude = (-db - (2 * b * db - dc) / (2 * root)) / (2 * frequency)
    return {"frequency_Hz": frequency, "amplitude_m": a, "amplitude_slope_m_per_Hz": 1 / by_amplitude, "mark": [""] * len(a)}


def distances(points, line):
    """Of points from a line through many."""
    first, way = line[:-1], np.diff(line, axis=0)
    known = np.isfinite(way).all(axis=1) & (way != 0).any(axis=1)
    first, way = first[known], way[known]
    gap = points[:, None, :] - first
    share = np.clip((gap * way).sum(axis=2) / (way**2).sum(axis=1), 0, 1)
    return np.sqrt(((gap - share[..., None] * way) ** 2).sum(axis=2).min(axis=1))


class BetweenPoints(Case):
    """The branch between the points of a curve, from its own tangents."""

    def shown(self, table, of):
        """Frequency and logarithm of the amplitude as shares of their ranges in a table."""
        frequency, height = of["frequency_Hz"], np.log(of["amplitude_m"])
        return np.column_stack([(table[:, 0] - frequency.min()) / np.ptp(frequency), np.log(table[:, 1]) / np.ptp(height)])

    def errors(self, coarse, fine, summary):
        """Largest and mean distance of the points of a fine curve from what is drawn through a coarse one, and from lines."""
        from microslip.branch import AMPLITUDE, cubics, polyline
        points = self.shown(np.column_stack([fine["frequency_Hz"], fine["amplitude_m"]]), fine)
        drawn = self.shown(polyline(cubics(summary, coarse, AMPLITUDE), True, 60), fine)
        lines = self.shown(np.column_stack([coarse["frequency_Hz"], coarse["amplitude_m"]]), fine)
        return distances(points, drawn), distances(points, lines)

    def test_the_drawn_curve_meets_the_branch_with_a_power_of_the_spacing(self):
        """The fourth of arcs; the third of the interval with the inflection, where the error is largest."""
        fine = duffing(np.geomspace(0.25, 2.0, 2001))
        largest, mean = [], []
        for n in (6, 11, 21):
            drawn, lines = self.errors(duffing(np.geomspace(0.25, 2.0, n)), fine, {})
            largest.append(drawn.max())
            mean.append(drawn.mean())
            self.assertLess(drawn.max(), 0.1 * lines.max())
        self.assertGreater(largest[0] / largest[2], 8.0**2)
        self.assertGreater(mean[0] / mean[2], 12.0**2)  # 16², but for the inflection

    def test_a_curve_of_a_third_of_its_points_is_drawn_near_the_others(self):
        for curve in self.run_.curves.values():
            n = curve.n_rows
            kept = np.array([i % 3 == 0 or i == n - 1 or curve["mark"][i] != "" for i in range(n)])
            drawn, lines = self.errors(curve.rows(kept), curve.rows(~kept), curve.summary)
            self.assertLess(drawn.mean(), 0.2 * lines.mean(), curve.name)

    def table(self, rows):
        names = ("frequency_Hz", "amplitude_m", "amplitude_slope_m_per_Hz", "mark")
        return {name: column if name == "mark" else np.array(column, dtype=float) for name, column in zip(names, zip(*rows))}

    def drawn(self, rows, summary=None):
        from microslip.branch import AMPLITUDE, cubics, polyline
        return polyline(cubics(summary or {}, self.table(rows), AMPLITUDE), True)

    def test_nothing_is_drawn_beyond_folds_and_peaks(self):
        nan = np.nan
        line = self.drawn([(1, 1, 2, ""), (2, 4, 0, "peak"), (2.2, 3, nan, "fold"), (2, 2, 4, ""), (1.9, 1, nan, "fold"), (3, 0.5, -0.1, "")])
        self.assertLessEqual(line[:, 1].max(), 4 * (1 + 1e-12))
        self.assertLessEqual(line[:26, 0].max(), 2.2 + 1e-12)
        self.assertGreaterEqual(line[26:, 0].min(), 1.9 - 1e-12)
        steps = np.diff(line[:13, 1])
        self.assertTrue((steps >= -1e-12).all())

    def test_a_peak_that_no_point_tells_is_none(self):
        line = self.drawn([(1, 1, 5, ""), (2, 1.5, -5, "")])
        np.testing.assert_allclose(line[6], [1.5, np.sqrt(1.5)])
        gap = self.drawn([(1, 1, 5, ""), (2, 1.5, -5, "")], {"diagnosis": "unbounded"})
        self.assertTrue(np.isnan(gap[1:-1, 1]).all())

    def test_no_line_joins_two_branches(self):
        rows = [(1, 1, 0.1, ""), (2, 1.1, 0.1, ""), (2.01, 5, 0.1, ""), (3, 5.1, 0.1, "")]
        line = self.drawn(rows, {"remedies": [{"frequency_Hz": 2.0, "remedy": "other-branch"}]})
        self.assertTrue(np.isnan(line[14:25, 1]).all())
        self.assertTrue(np.isfinite(line[:13]).all() and np.isfinite(line[26:]).all())

    def test_a_curve_without_tangents_is_drawn_by_lines(self):
        rows = [(1, 1, np.nan, ""), (2, 2, np.nan, ""), (4, 1, np.nan, "")]
        line = self.drawn(rows)
        np.testing.assert_allclose(line[:, 1], np.exp(np.interp(line[:, 0], [1, 2, 4], np.log([1, 2, 1]))))

    def test_a_phase_that_comes_round_is_parted(self):
        from microslip.branch import PHASE, cubics
        table = {**self.table([(1, 1, 0, ""), (2, 1, 0, ""), (3, 1, 0, "")]), "phase_deg": np.array([170.0, 179.0, -179.0])}
        self.assertEqual(list(np.isnan(cubics({}, table, PHASE)).any(axis=(1, 2))), [False, True])


class Numbers(unittest.TestCase):
    def test_a_value_and_its_half_width_are_those_of_the_program(self):
        from microslip.plots.numbers import with_half_width
        with open(os.path.join(SOURCE, "tests", "pipelines", "text", "half_widths.inc"), encoding="utf-8") as file:
            cases = re.findall(r'^\{(\S+), (\S+), "(.+)"\},$', file.read(), re.M)
        self.assertGreater(len(cases), 10)
        for value, bar, text in cases:
            raised = re.sub(r"e(-?\d+)$", lambda found: "·10" + found[1].translate(
                str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")), text)
            self.assertEqual(with_half_width(float(value), float(bar)), raised.replace("-", "−"))


class OverMaps(unittest.TestCase):
    """What lies over the cells of a map: boundaries of the states, arrows of slip."""

    def test_a_zero_line_is_closed_and_where_the_values_vanish(self):
        from microslip.boundaries import triangles_of, zero_line
        n = 21
        x, y = (part.ravel() for part in np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n)))
        first = np.array([i * n + j for i in range(n - 1) for j in range(n - 1)])
        cells = np.column_stack([first, first + 1, first + n + 1, first + n])
        lines = zero_line(np.column_stack([x, y]), triangles_of(cells), x**2 + y**2 - 0.5321)
        radius = np.linalg.norm(lines.reshape(-1, 2), axis=1)
        self.assertLess(np.abs(radius - np.sqrt(0.5321)).max(), 0.5 * (2 / (n - 1)) ** 2)  # of linear interpolation
        _, times = np.unique(np.round(lines.reshape(-1, 2), 9), axis=0, return_counts=True)
        self.assertEqual(set(times), {2})
        self.assertEqual(zero_line(np.column_stack([x, y]), triangles_of(cells), 1 + x**2).shape, (0, 2, 2))

    def test_cells_are_parted_where_the_boundary_crosses_them(self):
        """A disc that slips, as large as its boundary has it: whole cells err by more than linear interpolation does."""
        from microslip.boundaries import Vertices, parted_cells, triangles_of
        n = 21
        x, y = (part.ravel() for part in np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n)))
        first = np.array([i * n + j for i in range(n - 1) for j in range(n - 1)])
        cells = np.column_stack([first, first + 1, first + n + 1, first + n])
        ahead = 20 * (x**2 + y**2 - 0.5321)  # [deg] until slip begins
        never = np.full((n * n, 1), np.nan)
        vertices = Vertices(np.column_stack([x, y]), triangles_of(cells), np.array([90.0]), np.where(ahead < 0, 1, 0)[:, None],
                            [never, 90.0 + ahead[:, None], never, never, never])
        centres = np.column_stack([x, y])[cells].mean(axis=1)
        in_disc = np.where((centres**2).sum(axis=1) < 0.5321, 1, 0)
        parted, polygons, states = parted_cells(vertices, 0, in_disc)
        self.assertEqual(set(states), {0, 1})

        def area(polygon):
            return 0.5 * abs(np.sum(polygon[:, 0] * np.roll(polygon[:, 1], -1) - polygon[:, 1] * np.roll(polygon[:, 0], -1)))

        size = (2 / (n - 1)) ** 2
        self.assertAlmostEqual(sum(map(area, polygons)), len(parted) * size, places=12)
        whole = np.setdiff1d(np.arange(len(cells)), parted)
        slips = size * in_disc[whole].sum() + sum(area(polygon) for polygon, state in zip(polygons, states) if state == 1)
        self.assertLess(0, 1 - slips / (np.pi * 0.5321))
        self.assertLess(1 - slips / (np.pi * 0.5321), 0.5 * size / 0.5321)  # of linear interpolation, which lies above
        for polygon, state in zip(polygons, states):
            self.assertEqual(state, int((polygon.mean(axis=0)**2).sum() < 0.5321))

    def test_a_band_between_two_boundaries_has_the_state_that_began_last(self):
        from microslip.boundaries import Vertices, parted_cells
        corners = np.array([[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]])
        never = np.full((3, 1), np.nan)
        sticks, slips = np.array([[-20.0], [10.0], [10.0]]), np.array([[-25.0], [-10.0], [5.0]])
        vertices = Vertices(corners, np.array([[0, 1, 2]]), np.array([0.0]), np.array([[0], [1], [3]]), [sticks, slips, never, never, never])
        _, polygons, states = parted_cells(vertices, 0, np.array([3]))
        self.assertEqual(sorted(states), [0, 1, 3])
        self.assertAlmostEqual(sum(0.5 * abs(np.sum(p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1))) for p in polygons), 4.5)

    def test_arrows_point_where_the_slider_moves(self):
        from microslip.arrows import BOTH_DIRECTIONS, arrows_at
        theta = np.linspace(0, 2 * np.pi, 72, endpoint=False)
        size = np.array([[1e-6], [2e-6], [3e-6]])
        state = np.full((3, 72), BOTH_DIRECTIONS)
        state[2] = 0  # sticks
        points = np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]])
        arrows = arrows_at(points, (size * np.cos(theta), size * np.sin(theta)), state, 9)
        np.testing.assert_array_equal(arrows[:, :2], points[:2])
        direction = arrows[:, 2:] / np.linalg.norm(arrows[:, 2:], axis=1)[:, None]
        np.testing.assert_allclose(direction, [[-np.sin(theta[9]), np.cos(theta[9])]] * 2, atol=1e-12)
        self.assertAlmostEqual(*np.linalg.norm(arrows[:, 2:], axis=1) * [2, 1])
        self.assertEqual(len(arrows_at(points, (0 * size * theta, 0 * size * theta), state, 9)), 0)


class Examples(Case):
    def folder(self, name):
        """A folder like that of the sources, where runs may be left."""
        folder = fresh(name)
        os.makedirs(os.path.join(folder, "share", "examples"))
        os.symlink(os.path.join(SOURCE, "share", "scenes"), os.path.join(folder, "share", "scenes"))
        return folder

    def execute(self, script, folder):
        ended = subprocess.run([sys.executable, "-c", script], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        return ended.stdout

    @unittest.skipUnless(have("pandas"), "pandas is not installed")
    def test_the_examples_of_the_page_run(self):
        with open(os.path.join(SOURCE, "share", "doc", "python.md"), encoding="utf-8") as file:
            blocks = re.findall(r"```python\n(.*?)```", file.read(), re.S)
        self.assertGreaterEqual(len(blocks), 4)
        folder = self.folder("examples")
        told = self.execute("\n".join(blocks), folder)
        self.assertIn("-1 is negative", told)
        self.assertTrue(os.path.exists(os.path.join(folder, "limit.png")))

    @unittest.skipUnless(have("pandas"), "pandas is not installed")
    def test_the_notebook_runs(self):
        folder = os.path.join(self.folder("notebook"), "share", "examples")
        notebook = shutil.copy(os.path.join(SOURCE, "share", "examples", "first_steps.ipynb"), folder)
        if have("nbconvert") and have("ipykernel"):
            ended = subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output", "out.ipynb",
                                    notebook], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True)
            self.assertEqual(ended.returncode, 0, ended.stderr)
            with open(os.path.join(folder, "out.ipynb"), encoding="utf-8") as file:
                self.assertGreaterEqual(file.read().count("image/png"), 4)
            return
        with open(notebook, encoding="utf-8") as file:
            cells = [cell["source"] for cell in json.load(file)["cells"] if cell["cell_type"] == "code"]
        self.execute("\n".join(line for cell in cells for line in "".join(cell).splitlines() if not line.startswith("%")), folder)

    def test_pip_installs_it_without_compiling(self):
        if not (have("pip") and have("setuptools") and have("wheel")):
            self.skipTest("pip, setuptools and wheel are not all installed")
        folder = fresh("pip")
        package = shutil.copytree(os.path.join(SOURCE, "share", "python"), os.path.join(folder, "package"),
                                  ignore=shutil.ignore_patterns("__pycache__"))
        target = os.path.join(folder, "site")
        ended = subprocess.run([sys.executable, "-m", "pip", "install", "--no-deps", "--no-build-isolation", "--quiet", "--no-index",
                                "--target", target, package], capture_output=True, text=True)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        for file in ("py.typed", "report/page.css", "report/page.js", "report/chart.js", "meshes/nastran.py"):
            self.assertTrue(os.path.exists(os.path.join(target, "microslip", file)), file)


if __name__ == "__main__":
    warnings.simplefilter("error", ResourceWarning)
    unittest.main(verbosity=2)
