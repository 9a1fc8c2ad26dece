"""Every example of README.md and share/doc does what it says: shell commands run, keys of a scene are read by the
program, Python compiles.

An example is a fenced block that names its language, or a paragraph of an indented one. It is
  sh      run by bash, in a folder with a copy of share/, a page's examples one after the other; or, if DEAR names it,
          run with `--dry-run` behind every study: command, options, scene and settings are those of the program, files
          and options those of the scripts, names of tests those of CTest;
  toml    put into a scene of its kind, which `microslip check` must take;
  python  compiled (those of python.md run in verification.python_package);
  text    what a command prints, right behind one; or one that TEXTS gives a reason for.
What is none of these fails, and so does an exception that no example needs.

usage: documented_examples.py PROGRAM SOURCE_FOLDER WORKING_FOLDER
"""
import ast
import collections
import os
import re
import shutil
import subprocess
import sys
import tomllib
import unittest

PROGRAM, SOURCE, WORK = (os.path.abspath(argument) for argument in sys.argv[1:4])
del sys.argv[1:4]
SHIM = os.path.join(SOURCE, "tests", "support", "dry_command.py")
LIMIT = 300  # [s] of one example; a sanitized program takes ten times as long

Example = collections.namedtuple("Example", "page line kind text")

# (page, begin of the example): why it is not run as it stands.
DEAR = {
    ("README.md", "share/scripts/quickstart.sh"): "installs packages and builds",
    ("README.md", "microslip run blade.toml -o runs/blade"): "two minutes: elements are cut twice",
    ("README.md", "microslip run blade.toml -o runs/best"): "minutes: a search for a best value",
    ("accuracy.md", "ctest"): "the test of that name runs by itself",
    ("accuracy.md", "microslip run scene.toml"): "a minute: that is its budget",
    ("accuracy.md", "microslip converge share"): "an hour",
    ("accuracy.md", "microslip converge coarse.toml --knobs refinement"): "90 s: elements cut twice",
    ("costs.md", "MICROSLIP_CAMPAIGNS=whole"): "half an hour",
    ("costs.md", "python3 tests/benchmarks/effect_sets.py"): "twenty minutes",
    ("harmonics.md", "build/bin/microslip run"): "10 s: ten harmonics of 96 points",
    ("harmonics.md", "scene="): "half a minute: time integration",
    ("interfaces.md", "microslip campbell"): "40 s: ten speeds of a fine mesh",
    ("interfaces.md", "python3 tests/hard_cases/killed_runs.py"): "an hour: a thousand runs",
    ("modes.md", "share/scripts/calculix_matrices.py"): "needs files that CalculiX stores",
    ("paraview.md", "paraview"): "needs ParaView; verification.python_package runs the script where it is there",
    ("paraview.md", "share/scripts/paraview.sh"): "fetches packages; share/scripts/test.sh does",
    ("scenes.md", "build/bin/microslip run share/scenes/NAME.toml"): "NAME stands for a scene; `check` of one is enough",
    ("truth.md", "share/scripts/truth_table.py"): "half an hour, and writes the page",
    ("verification.md", "ctest"): "NAME stands for a test",
    ("verification.md", "share/scripts/campaigns.sh"): "days",
}
# Not even looked at.
UNTRIED = {
    ("python.md", "python3 -m venv"): "pip may fetch packages; verification.python_package installs it without a network",
}
# (page, begin): what is no example but stands like one.
TEXTS = {
    ("README.md", "curve preload_100: "): "lines of the default study",
    ("README.md", "microslip: blade.toml:24"): "what a wrong name is answered",
    ("accuracy.md", "curve preload_100: peak"): "a line of the default study",
    ("accuracy.md", "best preload"): "a line of the default study",
    ("accuracy.md", "chain_3dof_normal: asked"): "lines of a study with a tolerance",
    ("accuracy.md", "mesh_file "): "what `converge` prints of four meshes",
    ("accuracy.md", "refinement "): "what `converge` prints of a mesh cut twice",
    ("interfaces.md", "{ \"program\""): "members of summary.json",
    ("interfaces.md", "{ \"id\""): "members of what `cycle` prints",
    ("layout.md", "CMakeLists.txt"): "the folders",
    ("static_preload.md", "static preload contact"): "a line that `check` prints",
}
ONLY_EQUATIONS = {"theory.md"}  # what is indented there
# (page, name): what stands for the reader's own file.
FILES = {
    ("accuracy.md", "scene.toml"): "share/scenes/chain_2dof.toml",
    ("interfaces.md", "blade.toml"): "share/scenes/blade_static_preload.toml",
    ("meshes.md", "blade.inp"): "share/scenes/plate/plate.inp",
    ("modes.md", "blade.frd"): "share/scenes/plate/plate.frd",
    ("modes.md", "blade.inp"): "share/scenes/plate/coarse.inp",
    ("modes.md", "matrices/stiffness.mtx"): "share/scenes/plate/stiffness.mtx",
    ("modes.md", "matrices/mass.mtx"): "share/scenes/plate/mass.mtx",
    ("modes.md", "matrices/nodes.csv"): "share/scenes/plate/nodes.csv",
    ("step.md", "blade.step"): "share/scenes/blade.step",
}
# Of those whose mesh is the reader's choice: as coarse as will do.
COARSE = {("interfaces.md", "blade.toml"): ('"4 mm"', '"10 mm"')}
# (page, begin): scene that keys are put into; else the default blade. Files of the scene are copied beside it.
SCENES = {
    ("modes.md", '[model]\nkind = "modes"\nfile'): ("plate_calculix.toml", {"blade.inp": "plate/plate.inp"}),
    ("modes.md", '[model]\nkind = "modes"\nstiffness'): ("plate_matrices.toml", {
        "stiffness.mtx": "plate/stiffness.mtx", "mass.mtx": "plate/mass.mtx", "nodes.csv": "plate/nodes.csv", "blade.inp": "plate/coarse.inp"}),
    ("step.md", "[model]"): ("step_blade.toml", {}),
}
QUICK = {"model": {"element_size": "15 mm"}, "response": {"harmonics": 1, "preload": [300]}}
COMMANDS = re.compile(r"(?:\w+=\S* )?(?:build/bin/)?(?:microslip|mpirun|share/scripts/\S+|tests/\S+|python3|pip|ctest|cmake|ninja|make|paraview|pvbatch\S*|"
                      r"alias|export|for|scene=\S+|cd|git|docker)(?=\s|$)")


def pages():
    folder = os.path.join(SOURCE, "share", "doc")
    yield os.path.join(SOURCE, "README.md")
    yield from (os.path.join(folder, name) for name in sorted(os.listdir(folder)) if name.endswith(".md"))


def kind_of(text):
    """Of a paragraph that does not name its language."""
    first = text.splitlines()[0]
    if re.match(r"\[\[?[\w.]+\]?\]$|\w+ = ", first):
        return "toml"
    if COMMANDS.match(first):
        return "sh"
    return "python" if text.startswith(("import ", "rows.")) else "text"


def blocks(page):
    """(line, language or None if indented, lines) of what Markdown sets as code."""
    with open(page, encoding="utf-8") as file:
        lines = file.read().splitlines()
    i = 0
    while i < len(lines):
        fence = re.match(r"```(\w*)$", lines[i])
        begin = i
        if fence:
            i = lines.index("```", i + 1)
            yield begin + 1, fence[1], lines[begin + 1:i]
        elif lines[i].startswith("    ") and (i == 0 or not lines[i - 1]):
            while i + 1 < len(lines) and (lines[i + 1].startswith("    ") or not lines[i + 1]):
                i += 1
            yield begin + 1, None, [line[4:] for line in lines[begin:i + 1]]
        i += 1


def paragraphs(line, lines):
    """Of an indented block, keys of a scene together."""
    found = []
    for text in re.split(r"\n\n+", "\n".join(lines).strip("\n")):
        kind = kind_of(text)
        if kind == "toml" and found and found[-1][0] == "toml":
            found[-1] = ("toml", found[-1][1] + "\n" + text)
        else:
            found.append((kind, text))
    return [(line, kind, text) for kind, text in found]


def examples(page):
    name, found = os.path.basename(page), []
    for line, language, lines in blocks(page):
        parts = paragraphs(line, lines) if language is None else [(line, language or kind_of("\n".join(lines)), "\n".join(lines))]
        if name in ONLY_EQUATIONS:
            parts = [part for part in parts if part[1] == "sh"]
        found += [Example(name, *part) for part in parts]
    return found


def excepted(table, example):
    """The entry for an example."""
    return next((key for key in table if key[0] == example.page and example.text.startswith(key[1])), None)


def toml_text(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f'"{key}" = {toml_text(entry)}' for key, entry in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml_text, value)) + "]"
    if isinstance(value, bool):
        return str(value).lower()
    return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"' if isinstance(value, str) else repr(value)


def scene_text(scene):
    """Sections of a scene, each with its keys."""
    head = [f"{key} = {toml_text(value)}" for key, value in scene.items() if not isinstance(value, dict)]
    for section, keys in scene.items():
        if isinstance(keys, dict):
            head += [f"[{section}]"] + [f"{key} = {toml_text(value)}" for key, value in keys.items()]
    return "\n".join(head) + "\n"


def with_keys(scene, keys):
    return {**scene, **{name: {**scene.get(name, {}), **value} if isinstance(value, dict) else value for name, value in keys.items()}}


class Examples(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.all = [example for page in pages() for example in examples(page)]
        cls.used = set()
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)

    def where(self, example):
        return f"{example.page}:{example.line}: {example.text.splitlines()[0]}"

    def key(self, table, example):
        found = excepted(table, example)
        self.used.add(found)
        return found

    def folder(self, name, dry):
        """Where the examples of a page run: the program, a copy of share/, the reader's own files."""
        folder = os.path.join(WORK, name.partition(".")[0] + ("_dry" if dry else ""))
        if os.path.exists(folder):
            return folder
        os.makedirs(os.path.join(folder, "build", "bin"))
        shutil.copytree(os.path.join(SOURCE, "share"), os.path.join(folder, "share"))
        os.symlink(os.path.join(SOURCE, "tests"), os.path.join(folder, "tests"))
        if dry:
            for command in ("ctest", "python3", "paraview", "pvbatch", "build/bin/microslip", "microslip"):
                os.symlink(SHIM, os.path.join(folder, command))
            scripts = os.path.join(folder, "share", "scripts")
            for script in os.listdir(scripts):
                os.remove(os.path.join(scripts, script))
                os.symlink(SHIM, os.path.join(scripts, script))
        else:
            os.symlink(PROGRAM, os.path.join(folder, "build", "bin", "microslip"))
            os.symlink(PROGRAM, os.path.join(folder, "microslip"))
        for (page, file), source in FILES.items():
            if page == name:
                os.makedirs(os.path.dirname(os.path.join(folder, file)), exist_ok=True)
                shutil.copy(os.path.join(SOURCE, source), os.path.join(folder, file))
                if (page, file) in COARSE:
                    self.replace(os.path.join(folder, file), *COARSE[page, file])
        return folder

    def replace(self, path, old, new):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        self.assertIn(old, text)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace(old, new))

    def copy_files(self, source, target):
        """What earlier examples of the page have made."""
        for entry in os.scandir(source):
            if entry.is_file(follow_symlinks=False):
                shutil.copy(entry.path, target)

    def execute(self, example, dry):
        folder = self.folder(example.page, dry)
        if dry:
            self.copy_files(self.folder(example.page, False), folder)
        text = example.text.replace("NAME.toml", "oscillator_1dof.toml").replace("-R NAME", "-R layout")
        environment = {**os.environ, "PATH": folder + os.pathsep + os.environ["PATH"], "MPLBACKEND": "agg", "PYTHONDONTWRITEBYTECODE": "1",
                       "MICROSLIP_CACHE": os.path.join(WORK, "cache"), "DRY_PROGRAM": PROGRAM, "DRY_SOURCE": SOURCE}
        ended = subprocess.run(["bash", "-e", "-u", "-O", "expand_aliases", "-c", text], cwd=folder, env=environment, capture_output=True,
                               text=True, timeout=LIMIT)
        self.assertEqual(ended.returncode, 0, f"{self.where(example)}\n{ended.stdout[-2000:]}{ended.stderr[-2000:]}")

    def check_scene(self, example):
        """What a reader gets who puts these keys into a scene."""
        key = self.key(SCENES, example)
        name, files = SCENES[key] if key else ("blade_to_ground.toml", {})
        folder = self.folder(example.page, False)
        scenes = os.path.join(SOURCE, "share", "scenes")
        for file, source in files.items():
            shutil.copy(os.path.join(scenes, source), os.path.join(folder, file))
        with open(os.path.join(scenes, name), "rb") as file:
            scene = tomllib.load(file)
        scene = with_keys(scene, QUICK if not key else {})
        scene = with_keys(scene, tomllib.loads(example.text))
        if key and "stiffness" not in example.text:
            scene["modes"].pop("count", None)
        path = os.path.join(folder, "example.toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(scene_text(scene))
        ended = subprocess.run([PROGRAM, "check", path], cwd=folder, capture_output=True, text=True, timeout=LIMIT)
        self.assertEqual(ended.returncode, 0, f"{self.where(example)}\n{ended.stderr[-2000:]}")

    def test_each_does_what_it_says(self):
        before = None
        for example in self.all:
            with self.subTest(self.where(example)):
                self.try_out(example, before)
            before = example
        unused = {key for table in (DEAR, UNTRIED, TEXTS, SCENES) for key in table} - self.used
        self.assertEqual(unused, set(), "exceptions without an example")

    def try_out(self, example, before):
        if example.kind == "sh":
            if not self.key(UNTRIED, example):
                self.execute(example, dry=self.key(DEAR, example) is not None)
        elif example.kind == "toml":
            self.check_scene(example)
        elif example.kind == "python":
            ast.parse(example.text)
        elif not self.key(TEXTS, example):
            follows = before is not None and (before.page, before.line) == (example.page, example.line) and before.kind in ("sh", "text")
            self.assertTrue(example.kind == "text" and follows,
                            f"{self.where(example)}: neither a command, keys of a scene nor Python, nor what the command above prints")

    def test_what_is_wrong_is_told(self):
        wrong = [("sh", "microslip run share/scenes/chain_2dof.toml --colour", False),
                 ("sh", "microslip run share/scenes/chain_2dof.toml --colour", True),
                 ("sh", "microslip run share/scenes/chain_2dof.toml --set response.harmonic=1", True),
                 ("sh", "share/scripts/plot_bar.py runs/a --colour", True), ("sh", "share/scripts/plot_nothing.py runs/a", True),
                 ("sh", "ctest --test-dir build -R no_such_test", True), ("sh", "python3 tests/nothing.py", True),
                 ("toml", "[response]\nharmonic = 1", False), ("python", "import microslip as", False), ("text", "peaks of the blade", False)]
        for kind, text, dry in wrong:
            with self.subTest(text), self.assertRaises((AssertionError, SyntaxError)):
                example = Example("wrong.md", 1, kind, text)
                self.execute(example, dry) if kind == "sh" else self.try_out(example, None)

    def test_there_are_examples_of_every_kind(self):
        kinds = collections.Counter(example.kind for example in self.all)
        self.assertGreater(kinds["sh"], 25)
        self.assertGreater(kinds["toml"], 6)
        self.assertGreater(kinds["python"], 4)


class Commands(unittest.TestCase):
    """Those within a sentence: the command is one of the program's, and takes the options."""

    def test_commands_in_sentences_have_their_options(self):
        help_of, seen = {}, 0
        for page in pages():
            with open(page, encoding="utf-8") as file:
                text = file.read()
            for command, rest in re.findall(r"`microslip ([a-z]\w*)([^`\n]*)`", text):
                if command not in help_of:
                    ended = subprocess.run([PROGRAM, command, "--help"], capture_output=True, text=True, timeout=LIMIT)
                    help_of[command] = ended.stdout if ended.returncode == 0 else ""
                with self.subTest(f"{os.path.basename(page)}: microslip {command}{rest}"):
                    self.assertIn("Usage", help_of[command])
                    for option in re.findall(r"(?:^|\s)(--?[a-z][\w-]*)", rest):
                        self.assertRegex(help_of[command], rf"(?m)^  \S*{re.escape(option)}\b")
                        seen += 1
        self.assertGreater(seen, 3)


if __name__ == "__main__":
    unittest.main(verbosity=1)
