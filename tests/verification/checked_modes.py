"""What `check` of a scene with a mesh asks of its modes: those that an earlier run has kept, and those that are solved for in seconds.

usage: checked_modes.py MICROSLIP SOURCE_FOLDER RUN_FOLDER
"""
import os
import shutil
import subprocess
import sys
import unittest

PROGRAM, SOURCE, WORK = sys.argv[1:4]
SCENE = os.path.join(SOURCE, "share", "scenes", "blade_to_ground.toml")
COARSE = ('model.element_size="20 mm"', "response.harmonics=1", "response.optimum=", "response.optimum_range=")
MANY = ('model.element_size="10 mm"', "modes.count=300")  # by the forecast 2.5 s
LEFT = "the first two by `check` as well once the modes are quickly solved for, or kept by `modes` or a run"


class CheckedModes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)

    def program(self, command, *options, settings=(), cache="cache"):
        """With what the tests before have kept, but in a cache of its own."""
        words = [word for setting in (*COARSE, *settings) for word in ("--set", setting)]
        finished = subprocess.run([PROGRAM, command, SCENE, *options, *words], capture_output=True, text=True, cwd=WORK,
                                  env={**os.environ, "MICROSLIP_CACHE": os.path.join(WORK, cache)})
        self.assertEqual(finished.returncode, 0, finished.stderr)
        return finished.stdout + finished.stderr

    def test_a_range_without_a_mode_is_questioned(self):
        before = set(os.listdir(WORK))
        told = self.program("check", settings=['response.frequency=["20 Hz", "100 Hz"]'], cache="own")
        self.assertIn("modes: solved for, as that takes seconds", told)
        self.assertRegex(told, r"natural frequencies: 10 from \S+ to \S+ Hz; with every contact point stuck from \S+ Hz")
        self.assertIn("warning: response.frequency: the number of modes is 0 between 20 and 100 Hz", told)
        self.assertEqual(set(os.listdir(WORK)) - before, {"own"}, "a run folder")

    def test_a_range_above_the_last_mode_is_questioned(self):
        told = self.program("check", settings=['response.frequency=["90 kHz", "95 kHz"]'])
        self.assertIn("warning: response.frequency: the frequency range reaches ", told)
        self.assertIn("% of the last natural frequency", told)

    def test_a_usual_range_is_not(self):
        told = self.program("check")
        self.assertNotIn("response.frequency:", told)
        self.assertIn("asked by `run` alone, which knows the curves", told)

    def test_a_run_takes_the_modes_that_check_has_solved_for(self):
        self.program("check")
        self.assertIn("modes: taken from an earlier run", self.program("modes", "-o", "modes"))

    def test_more_modes_than_there_can_be_are_refused_by_their_key(self):
        plate = os.path.join(SOURCE, "share", "scenes", "plate_mesh.toml")
        told = subprocess.run([PROGRAM, "check", plate, "--set", "modes.count=500"], capture_output=True, text=True)
        self.assertEqual(told.returncode, 1, told.stdout)
        self.assertRegex(told.stderr, "--set modes.count=500: modes.count: 500 modes are asked for, and what is not held has [0-9]+ degrees of freedom")

    def test_modes_that_are_kept_are_asked_though_they_take_long(self):
        settings = [*MANY, 'response.frequency=["20 Hz", "100 Hz"]']
        self.assertIn(LEFT, self.program("check", settings=settings))
        self.program("modes", "-o", "modes", settings=settings)
        told = self.program("check", settings=settings)
        self.assertIn("modes: taken from an earlier run", told)
        self.assertIn("the number of modes is 0 between 20 and 100 Hz", told)
        self.assertIn(LEFT, self.program("check", "--no-cache", settings=settings))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
