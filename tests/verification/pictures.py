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
sys.path.insert(0, os.path.join(SOURCE, "share", "python"))
sys.dont_write_bytecode = True

import numpy as np

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
    def test_what_no_curve_tells_has_no_name_and_what_is_too_small_says_so(self):
        told = [{"harmonics": 2.0, "newton": 1e-9}, None]
        self.assertEqual(error_budget.known_sources(told), ["harmonics", "newton"])
        self.assertEqual(error_budget.label_of("harmonics", told), "harmonics")
        self.assertEqual(error_budget.label_of("newton", told), "newton (below 0.0001 %)")


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
