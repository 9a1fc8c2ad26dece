"""What pictures say: axes whose numbers can be read, lines that go to the right, names with a bar of their own, colours that
are told apart. No program is run.

usage: pictures.py SOURCE_FOLDER
"""
import os
import sys
import tempfile
import unittest

SOURCE = sys.argv[1]
del sys.argv[1]
sys.path[:0] = [os.path.join(SOURCE, "share", "python"), os.path.join(SOURCE, "tests", "support")]
sys.dont_write_bytecode = True

import numpy as np
from matplotlib import rc_context

import run_files
from microslip.plots import error_budget, run_folder, style, work_precision


def told_ticks(axis):
    """Numbers along an axis, within its limits."""
    axis.figure.canvas.draw()
    low, high = sorted(axis.get_view_interval())
    return [text.get_text() for value, text in zip(axis.get_majorticklocs(), axis.get_majorticklabels())
            if low <= value <= high and text.get_text()]


class Axes(unittest.TestCase):
    def test_shared_axes_are_scaled_by_all_of_them(self):
        _, grid = style.subplots(1, 2, (6.0, 2.0), sharey=True)
        grid[0].plot([1, 2], [3, 4])
        grid[1].plot([1, 2], [1, 1000])
        style.log_scale(grid[0].yaxis)
        self.assertEqual(style.data_of(grid[0].yaxis), (1, 1000))
        self.assertGreaterEqual(len(told_ticks(grid[0].yaxis)), 3)


class WorkPrecision(unittest.TestCase):
    def test_lines_go_to_the_right(self):
        _, axes = style.subplots(1, 1, (3.0, 2.0))
        rows = [{"seconds": seconds, "true_error": error, "estimated_error": None}
                for seconds, error in ((2.0, 0.1), (1.0, 0.2), (3.0, 0.01))]
        work_precision.draw_knob(axes, rows, "k")
        self.assertEqual(list(axes.lines[0].get_xdata()), [1.0, 2.0, 3.0])

    def test_numbers_along_the_axes_do_not_overlap(self):
        with tempfile.TemporaryDirectory() as folder:
            for fastest, slowest in ((2.1, 3.9), (103, 495)):
                with open(os.path.join(folder, "cells.csv"), "w") as file:
                    for curve in ("curve", "a", "b", "c"):  # three panels in a row
                        file.write("curve,value,seconds,true_error,estimated_error\n" if curve == "curve" else
                                   f"{curve},1,{fastest},0.001,0.002\n{curve},2,{slowest},0.0004,\n")
                figure = work_precision.work_precision_figure(folder)
                figure.canvas.draw()
                for axes in figure.axes:
                    self.assertGreaterEqual(len(told_ticks(axes.xaxis)), 2)
                    self.check_apart(axes.xaxis, (fastest, slowest))

    def check_apart(self, axis, what):
        low, high = sorted(axis.get_view_interval())
        ticks = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
        boxes = sorted((tick.label1.get_window_extent() for tick in ticks
                        if tick.label1.get_text() and low <= tick.get_loc() <= high), key=lambda box: box.x0)
        for one, other in zip(boxes, boxes[1:]):
            self.assertLess(one.x1, other.x0, what)


class ErrorBudget(unittest.TestCase):
    """Waterfalls of the folder that tests/support/run_files.py writes."""

    def panels(self, loads, change=lambda summary: None):
        summary = run_files.summary_of(loads)
        change(summary)
        with tempfile.TemporaryDirectory() as folder, rc_context(style.STYLE):
            run_files.write_run(folder, summary)
            figure = error_budget.error_budget_figure(run_folder.Run(folder))
            figure.canvas.draw()
        return [axes for axes in figure.axes if axes.axison]

    def steps(self, axes):
        """Where bars begin and end, but for the last, which is all together."""
        return [(bar.get_x(), bar.get_x() + bar.get_width()) for bar in axes.patches]

    def test_every_bar_begins_where_the_one_before_has_ended(self):
        (axes, _) = self.panels([60])
        *steps, whole = self.steps(axes)
        effects = [100.0 * size for size in run_files.SIZES.values()]  # the largest first
        np.testing.assert_allclose([end - begin for begin, end in steps], effects, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose([begin for begin, _ in steps[1:]], [end for _, end in steps[:-1]])
        np.testing.assert_allclose(whole, (-sum(map(abs, effects)), sum(map(abs, effects))), rtol=1e-9)
        self.assertEqual([label.get_text() for label in axes.get_yticklabels()],
                         [source.replace("_", " ") for source in run_files.SIZES] + ["all together"])
        self.assertEqual(axes.get_xscale(), "linear")

    def test_of_many_curves_the_least_certain_have_a_panel(self):
        panels = self.panels(["free", -2000, -500, 60, 100, 150, 300, 500, 1000, 3000, "stuck"])
        self.assertEqual([axes.get_title(loc="left") for axes in panels], ["300 N", "500 N", "1000 N", "3000 N", "stuck", "best value"])

    def test_names_and_numbers_do_not_overlap(self):
        for loads in ([60], [60, 100, 150], ["free", -500, 60, 100, 150, 300, "stuck"]):
            panels = self.panels(loads)
            boxes = [text.get_window_extent() for axes in panels for text in (*axes.texts, *axes.get_yticklabels())]
            for i, box in enumerate(boxes):
                self.assertFalse([other for other in boxes[i + 1:] if box.overlaps(other)], loads)

    def test_a_source_that_is_not_known_is_named(self):
        (axes, _) = self.panels([60], lambda summary: summary["curves"][0]["bar"]["not_known"].append("basis_degree"))
        self.assertEqual(axes.get_yticklabels()[-1].get_text(), "basis degree")
        self.assertEqual(axes.texts[-1].get_text(), "not known")
        (axes, _) = self.panels([60], lambda summary: summary["curves"][0].update(bar=None))
        self.assertEqual(len(axes.patches), len(run_files.SIZES))  # no sum of what is not known


class Colours(unittest.TestCase):
    def test_a_gap_and_a_low_preload_are_told_apart(self):
        loads = [-2000, -500, 60, 100, 150, 300, 500, 1000, 3000]
        colours = run_folder.colours_of(loads)
        self.assertEqual(list(colours), loads)
        for gap in loads[:2]:
            for preload in loads[2:]:
                distance = np.linalg.norm(np.subtract(colours[gap], colours[preload]))
                self.assertGreater(distance, 0.4, (gap, preload))
        self.assertGreater(np.linalg.norm(np.subtract(colours[-2000], colours[-500])), 0.4)


if __name__ == "__main__":
    unittest.main()
