"""What report.html and the plots make of summary.json: numbers that are not known, digits, a row for every source of error.
No program is run.

usage: report_page.py SOURCE_FOLDER
"""
import copy
import os
import re
import sys
import tempfile
import unittest
import warnings

SOURCE = sys.argv[1]
del sys.argv[1]
sys.path[:0] = [os.path.join(SOURCE, "share", "python"), os.path.join(SOURCE, "tests", "support")]
sys.dont_write_bytecode = True

from matplotlib import rc_context

from microslip.plots import run_folder as plotted
from microslip.plots.figures import OF_A_RUN
from microslip.plots.style import STYLE
from microslip.report.page import page
from microslip.results import Run, RunWarning
from run_files import SIZES, summary_of, write_run, write_summary


class Case(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("ignore", RunWarning)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder, self.summary = folder.name, summary_of()
        write_run(self.folder, self.summary)

    def page(self, summary=None):
        write_summary(self.folder, summary or self.summary)
        return page(Run(self.folder))

    def figures(self, summary):
        write_summary(self.folder, summary)
        with rc_context(STYLE):
            return [draw(plotted.Run(self.folder)) for draw in OF_A_RUN.values()]


def places_of_numbers(node, path=()):
    """Of floating-point numbers, which are null in JSON where they are not finite, and of what is null where it is not known."""
    for key, value in node.items() if isinstance(node, dict) else enumerate(node):
        if isinstance(value, float) or key in ("peak", "bar", "with_more", "optimum", "accuracy", "mesh"):
            yield (*path, key)
        if isinstance(value, (dict, list)):
            yield from places_of_numbers(value, (*path, key))


def without(summary, path):
    changed = copy.deepcopy(summary)
    node = changed
    for key in path[:-1]:
        node = node[key]
    node[path[-1]] = None
    return changed


class NotKnown(Case):
    def test_a_bracket_that_ran_out_of_time_has_a_row(self):
        entry = self.summary["optimum"]["bracket"][2]
        entry.update(preload_N=None, value=None, amplitude_m=None, frequency_Hz=None, at=None, found=False, objection="out of time")
        self.assertIn("friction coefficient × 2 (searched wider: 30 … 6000) (lowest: out of time)</td><td class=n>–</td><td class=n>–</td>", self.page())

    def test_every_number_may_be_null(self):
        for path in places_of_numbers(self.summary):
            if all(key in (0, 2) for key in path if isinstance(key, int)):  # the free curve, and one with contact
                with self.subTest(path):
                    self.page(without(self.summary, path))

    def test_plots_are_drawn_of_what_is_known(self):
        """Something else is missing of each curve, and of the best value in turn."""
        changed = self.summary
        for path in (("curves", 0, "peak"), ("curves", 1, "peak", "amplitude_m"), ("curves", 2, "bar", "peak_amplitude"),
                     ("curves", 3, "bar"), ("curves", 4, "peak", "frequency_Hz"), ("error_budget", 0, "effect")):
            changed = without(changed, path)
        for path in (("optimum", "amplitude_m"), ("optimum", "bar")):
            self.assertTrue(all(self.figures(without(changed, path))[i] for i in (0, 2, 3)))


def tables_in(text):
    """Tables of sources by what stands above them, as lists of cells without tags."""
    parts = re.findall(r"<details[^>]*><summary>([^<]*?)[:,][^<]*</summary><div class=\"wide sources\">(.*?)</div>", text, re.S)
    return {name: [[re.sub("<.*?>", "", cell) for cell in re.findall(r"<t[hd].*?>(.*?)</t[hd]>", row)]
                   for row in re.findall("<tr>(.*?)</tr>", table)] for name, table in parts}


class Sources(Case):
    def test_every_source_has_a_row_with_all_that_is_told_of_it(self):
        tables = tables_in(self.page())
        self.assertEqual(list(tables), ["free", "−500 N (gap 8.4 µm)", "60 N", "100 N", "stuck", "best value"])
        head, *rows = tables["60 N"]
        self.assertEqual(head, ["source", "peak amplitude", "peak frequency", "dissipated energy", "kind", "seconds", "gain [%/s]"])
        self.assertEqual([row[0] for row in rows], [source.replace("_", " ") for source in SIZES] + ["all together"])
        self.assertEqual(rows[0], ["harmonics", "−24 %", "+2.4 %", "+36 %", "solved", "0.02", "1200"])
        self.assertEqual(rows[-2], ["newton", "< 0.001 %", "< 0.001 %", "< 0.001 %", "estimated", "0", "–"])
        self.assertEqual(rows[-1], ["all together", "± 34 %", "± 3.4 %", "± 51 %", "sum of sizes", "0.1", "–"])
        self.assertEqual(tables["best value"][0][1], "best value")
        self.assertEqual(tables["best value"][1][1], "−29 %")
        self.assertFalse([cell for table in tables.values() for row in table for cell in row if not cell])

    def test_what_is_not_known_is_named(self):
        self.summary["curves"][2]["bar"]["not_known"] = ["mesh"]
        self.summary["error_budget"] = [row for row in self.summary["error_budget"] if row["source"] != "mesh"]
        tables = tables_in(self.page())
        self.assertIn(["mesh", "not known", "not known", "not known", "not known", "–", "–"], tables["60 N"])
        self.assertEqual({row[3] for row in tables["free"][1:]}, {"nothing dissipated"})
        self.summary["curves"][2]["bar"] = None
        text = self.page()
        self.assertIn("60 N: no bar, as harmonics are not known", text)


if __name__ == "__main__":
    unittest.main()
