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
from microslip.plots.numbers import change_in_percent, digits_told, told_like, told_with, with_half_width
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


def rows_in(text, kind):
    """Of the table of a kind, each cell without tags."""
    table = re.search(rf'<div class="wide {kind}">(.*?)</div>', text, re.S)[1]
    return [[re.sub("<.*?>", "", cell) for cell in re.findall(r"<td.*?>(.*?)</td>", row)] for row in re.findall("<tr>(.*?)</tr>", table)[1:]]


class Digits(Case):
    """Peaks of 304.498… Hz and more, 2.995… mm and less, with the bars that run_files.py makes of its rows."""

    def test_peaks_and_folds_end_where_their_half_width_begins(self):
        rows = {row[0]: row[1:6] for row in rows_in(self.page(), "peaks")}
        self.assertEqual(rows["60"], ["318 ± 11", "1.0 ± 0.3", "34 %", "−70 %", "319, 317"])
        self.assertEqual(rows["free"][:4], ["304 ± 5", "3.0 ± 0.5", "17 %", "0 %"])

    def test_a_change_has_a_digit_at_least_and_no_more_than_its_half_width(self):
        for value, width, told in ((0.953, 0.059, "−5 %"), (0.29, 0.34, "−70 %"), (0.3333, 1e-5, "−66.7 %"), (1.5, None, "+50 %"), (1.0, 0.1, "0 %")):
            self.assertEqual(change_in_percent(value, width, 1.0, width), told)

    def test_what_has_no_bar_says_so(self):
        self.summary["curves"][2]["bar"] = None
        text = self.page()
        row = next(row for row in rows_in(text, "peaks") if row[0] == "60")
        self.assertEqual(row[1:6], ["≈ 318.5", "≈ 0.998", "no bar", "−67 %", "≈ 318.8, ≈ 316.9"])
        self.assertIn("≈: no bar is known", text)

    def test_the_best_value_has_the_same_digits_in_all_its_rows(self):
        text = self.page()
        self.assertIn("<b>250 ± 100 N</b>, peak 0.52 ± 0.11 mm at 333 ± 7 Hz", text)
        values = [cells for cells in re.findall(r"<td>(?:as given|\w+ \w+ × [\d.]+).*?</td>(.*?)</tr>", text)]
        numbers = [re.findall(r">([^<]+)<", cells) for cells in values]
        self.assertEqual(numbers[0], ["250", "0.52", "333"])
        self.assertEqual({tuple(len(cell) for cell in row) for row in numbers}, {(3, 4, 3)})

    def test_natural_frequencies_have_what_the_mesh_leaves(self):
        frequency = r"<td class=n>1</td><td class=n>(.*?)</td>"
        largest = 0.1 * SIZES["mesh"] * 3.0  # of the last curve
        self.assertEqual(re.search(frequency, self.page())[1], with_half_width(304.4997813889993, largest).split(" ")[0])
        self.summary["error_budget"] = []
        self.assertEqual(re.search(frequency, self.page())[1], "304.5")

    def test_no_number_has_more_than_eight_digits(self):
        for width in (1e-9, 0.0):
            for curve in self.summary["curves"]:
                curve["bar"] = {"peak_amplitude": width, "peak_frequency": width, "not_known": []}
            for row in rows_in(self.page(), "peaks"):
                for number in re.findall(r"[\d.]+", "; ".join(row[1:])):
                    self.assertLessEqual(len(number.replace(".", "").lstrip("0")), 8, row)

    def test_what_a_bar_does_not_count_allows_three_digits(self):
        bar = {"peak_frequency": 1e-6, "not_known": ["mesh"]}
        self.assertEqual(told_with(bar, "peak_frequency", 318.498409), "318")
        self.assertEqual(told_with({**bar, "not_known": []}, "peak_frequency", 318.498409), "318.4984 ± 0.0003")
        self.assertEqual(told_with(bar, "peak_frequency", None), "–")

    def test_the_script_has_the_digits_of_the_tables(self):
        for bar in ({"peak_amplitude": 0.34}, {"peak_amplitude": 1e-4}, {"peak_amplitude": 1e-9}, {"peak_amplitude": 0.0}, {},
                    {"peak_amplitude": 20.0}, {"peak_amplitude": 1e-5, "not_known": ["mesh"]}):
            told = told_like(bar, "peak_amplitude", 0.51757218)
            digits = len(re.sub(r"\D", "", told).lstrip("0"))
            self.assertEqual(digits_told(bar, "peak_amplitude", 0.51757218), digits, (bar, told))

    def test_the_plot_of_peaks_tells_the_best_value_as_the_page_does(self):
        titles = [axes.get_title(loc="right") for axes in self.figures(self.summary)[0].axes]
        self.assertIn("best preload 250 ± 100 N: 0.52 ± 0.11 mm at 333 ± 7 Hz", titles)


if __name__ == "__main__":
    unittest.main()
