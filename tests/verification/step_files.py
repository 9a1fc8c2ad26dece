#!/usr/bin/env python3
"""A blade from a STEP file gives the frequencies and the peak of the same blade given as .msh.

share/scenes/step_blade.toml on larger elements; its own mesh, written as .msh, must give the same numbers (the same mesh:
1e-6); the parametric blade it was made of gives the same frequencies but for a coarser outline of the aerofoil and
another mesh. A run is not resumed with another file. Then what a user may get wrong: every message names the file, what is there and what to do.

usage: step_files.py MICROSLIP SOURCE WORK_FOLDER
"""
import json
import os
import shutil
import subprocess
import sys
import time
import unittest
import xml.etree.ElementTree

from program_run import run_scene, without_plots

PROGRAM, SOURCE, WORK = sys.argv[1:4]
del sys.argv[1:]
SCENES = os.path.join(SOURCE, "share", "scenes")
SCENE = os.path.join(SCENES, "step_blade.toml")
STEP = os.path.join(SCENES, "blade.step")
COARSE = ["model.element_size=12 mm", "faces.contact={ point = [0.03, 0.03, 0.01], size = 0.006 }"]
QUICK = ["modes.count=4", "contact.points=40", "response.preload=[100]", "response.maps=[]", "accuracy.error_budget=off",
         "modes.residual=none", "effects.second_direction=off"]


def path(name):
    return os.path.join(WORK, name)


def text_of(file):
    with open(file, encoding="utf-8") as stream:
        return stream.read()


def program(*arguments, code=0):
    """Standard output, or standard error where it is to fail."""
    finished = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300, cwd=WORK,
                              env=without_plots())
    if finished.returncode != code:
        raise AssertionError(f"{arguments}: {finished.returncode}\n{finished.stdout}{finished.stderr}")
    return finished.stdout if code == 0 else finished.stderr


def settings(values):
    return [word for value in values for word in ("--set", value)]


def numbers_of(scene, name, *values):
    """Frequencies and the peak of a run."""
    run_scene(PROGRAM, scene, path(name), *values)
    summary = json.loads(text_of(os.path.join(path(name), "summary.json")))
    peak = summary["curves"][0]["peak"]
    return [mode["frequency_Hz"] for mode in summary["modes"]] + [peak["frequency_Hz"], peak["amplitude_m"]]


class StepFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)

    def test_same_as_its_mesh_file(self):
        program("mesh", SCENE, "-o", "blade.msh", *settings(COARSE))
        scene = text_of(SCENE)
        begin, end = scene.index("[model]"), scene.index("[material]")
        with open(path("mesh.toml"), "w", encoding="utf-8") as stream:
            stream.write(scene[:begin] + '[model]\nkind = "mesh"\nfile = "blade.msh"\n' + scene[end:])
        found = numbers_of(SCENE, "step", *COARSE, *QUICK)
        expected = numbers_of(path("mesh.toml"), "mesh", *QUICK)
        worst = max(abs(a / b - 1.0) for a, b in zip(found, expected, strict=True))
        print(f"frequencies and peak differ by {worst:.1e} from those of the .msh file")
        self.assertLess(worst, 1e-6)
        self.assertIn("blade.step: lengths in millimetre", text_of(os.path.join(path("step"), "log.txt")))

    def test_a_run_is_not_resumed_with_another_file(self):
        """The mesh that stands in the run folder is that of the file as it was."""
        shutil.copy(STEP, path("resumed.step"))
        command = ["run", SCENE, "-q", "-o", "resumed", *settings(
            ["model.file=" + path("resumed.step"), *COARSE, *QUICK, "response.preload=" + str(list(range(50, 90)))])]
        process = subprocess.Popen([PROGRAM, *command], cwd=WORK, env=without_plots(), stderr=subprocess.DEVNULL)
        while not os.path.exists(path("resumed/checkpoint/modes")):
            self.assertIsNone(process.poll(), "the run ended before its modes were kept")
            time.sleep(0.02)
        process.kill()
        process.wait()
        with open(path("resumed.step"), "a", encoding="ascii") as stream:
            stream.write("\n")
        message = program(*command, "--resume", code=1)
        for words in ("--resume", "resumed.step", "run without --resume"):
            self.assertIn(words, message)

    def test_same_as_the_parametric_blade(self):
        blade = os.path.join(SCENES, "blade_to_ground.toml")
        for folder, scene in (("step_modes", SCENE), ("blade_modes", blade)):
            program("modes", scene, "-o", folder, *settings(["model.element_size=6 mm", "modes.count=3", "modes.residual=none"]))
        frequencies = [[float(line.split(",")[1]) for line in text_of(os.path.join(path(folder), "modes.csv")).split("\n")[1:4]]
                       for folder in ("step_modes", "blade_modes")]
        for a, b in zip(*frequencies, strict=True):
            print(f"{a:.3f} Hz from STEP, {b:.3f} Hz from the parametric blade")
            self.assertLess(abs(a / b - 1.0), 0.01)  # other meshes, and a coarser outline of the aerofoil

    def test_faces(self):
        found = json.loads(program("faces", STEP, "--json").splitlines()[-1])["faces"]
        self.assertEqual([face["number"] for face in found], list(range(1, 17)))
        self.assertEqual(sum(face["kind"] == "plane" for face in found), 12)
        contact = next(face for face in found if face["normal"] == [1.0, 0.0, 0.0] and face["centre"][0] > 0.029)
        self.assertAlmostEqual(contact["area"], 0.01 * 0.06, delta=1e-10)
        data = xml.etree.ElementTree.parse(path("blade_faces.vtp"))
        self.assertIn("face", [array.get("Name") for array in data.iter("DataArray")])

    def test_init_writes_a_scene_that_runs(self):
        text = program("init", "step", STEP)
        self.assertEqual(text, program("init", "mesh", STEP))
        with open(path("own.toml"), "w", encoding="utf-8") as stream:
            stream.write(text)
        listing = program("check", "own.toml", "--set", "model.element_size=15 mm")
        self.assertIn("lengths in millimetre", listing)
        self.assertIn("the scene is complete and consistent", listing)

    def refusal(self, *values, file=None):
        """Message for the scene with changed keys, or with another file."""
        changed = [f"model.file={path(file)}"] if file else []
        return program("check", SCENE, *settings([*COARSE, *values, *changed]), code=1)

    def changed_file(self, name, change):
        with open(path(name), "w", encoding="utf-8") as stream:
            stream.write(change(text_of(STEP)))
        return name

    def test_bad_faces(self):
        for value, words in (
                ("faces.contact={ point = [0.03, 0.03, 0.3] }", ["faces.contact", "is on no face", "nearest is 6", "microslip faces"]),
                ("faces.contact={ point = [0.03, 0.035, 0.01] }", ["fits 2 faces", "4 (plane", "6 (plane", "number"]),
                ("faces.contact={ point = [0, 0.3, 0] }", ["is on no face", "0.151 m away"]),
                ("faces.contact={ normal = [1, 0, 0] }", ["fits 2 faces", "6 (plane", "8 (plane", "near"]),
                ("faces.contact={ normal = [1, 1, 0] }", ["fits no face", "degrees away"]),
                ("faces.contact={ number = 17 }", ["there is no face 17", "1 to 16"]),
                ("faces.contact={ number = 6, point = [0, 0, 0] }", ["one of point, normal and number"]),
                ("faces.contact={ near = [0, 0, 0], number = 6 }", ["goes with normal"]),
                ("faces.contact={ pont = [0, 0, 0] }", ["did you mean \"point\""]),
                ("faces.contact=[{ number = 6 }, { number = 6 }]", ["face 6 is meant twice"]),
                ("model.element_size=4e-6", ["model.element_size", "elements", "usual is 0.00015 to 0.037 m", "larger size"]),
                ("model.length_unit=m", ["model.file", "blade.step", "149 m long", "length_unit"])):
            with self.subTest(value):
                message = self.refusal(value)
                for word in words:
                    self.assertIn(word, message)

    def test_the_element_size_is_treated_as_that_of_a_blade(self):
        """Questioned where a mesh is possible, refused where it would have too many elements."""
        blade = os.path.join(SOURCE, "share", "scenes", "blade_to_ground.toml")
        for scene in (SCENE, blade):
            with self.subTest(scene):
                told = program("check", scene, "--set", "model.element_size=4 m")
                self.assertIn("warning: model.element_size: the element size is 2683 % of the blade's height (4 m); usual is 0.1 to 25 %", told)
                told = program("check", scene, "--set", "model.element_size=4 um", code=1)
                self.assertRegex(told, "model.element_size: 4e-06 m would make some .* elements .* usual is 0.00015 to 0.037 m")

    def test_bad_files(self):
        self.changed_file("cut.step", lambda text: text[:len(text) // 2])
        self.changed_file("other.step", lambda _: "solid blade\nendsolid\n")
        # Broken in itself: OpenCASCADE 7.6 crashes on it, which ends the mesher alone.
        self.changed_file("broken.step", lambda text: text.replace("MANIFOLD_SOLID_BREP", "SHELL_BASED_SURFACE_MODEL"))
        self.changed_file("metres.step", lambda text: text.replace("SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)"))
        self.changed_file("no_unit.step", lambda text: text.replace("GLOBAL_UNIT_ASSIGNED_CONTEXT", "GLOBAL_CONTEXT"))
        for file, words in (("cut.step", ["was cut off", "END-ISO"]), ("other.step", ["not a STEP file"]),
                            ("broken.step", ["the mesher"]), ("metres.step", ["149 m long", "metre", "length_unit"]),
                            ("no_unit.step", ["model.length_unit", "does not say"]), ("none.step", ["no such file"])):
            with self.subTest(file):
                message = self.refusal(file=file)
                for word in [file, *words]:
                    self.assertIn(word, message)

    def test_a_wrong_unit_can_be_put_right(self):
        self.changed_file("metres_2.step", lambda text: text.replace("SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)"))
        listing = program("check", SCENE, *settings([*COARSE, f"model.file={path('metres_2.step')}", "model.length_unit=mm"]))
        self.assertIn("lengths in metre; taken as 0.001 m", listing)
        self.assertIn("y 0 to 0.1491", listing)


if __name__ == "__main__":
    unittest.main(verbosity=2)
