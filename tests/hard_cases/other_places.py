#!/usr/bin/env python3
"""One scene on other machines and in other places (rows 61 and 64 of the list of hard cases).

Hard: what a program takes for granted on the machine where it was written: some cores and threads, a home, a display, a
locale with decimal points, folders whose names are short and plain. Names are pasted into messages, command lines,
pages and formats; links lead in circles; a path of 4000 bytes has folders that no single call can name.
Right: the same curves, maps and modes byte for byte whatever the machine has, numbers with points; a name the file system
takes is worked in, one it does not take is refused in a line with the name in it: never a signal, an internal error, or
a file elsewhere.

usage: other_places.py MICROSLIP WORK_FOLDER        prints a table
"""
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "verification"))
from program_run import without_plots

MODAL = """title = "two modes"
[model]
kind = "modal"
[modal]
frequency = [15.9, 41.4]
damping_ratio = 0.01
force_sine = [0.0, 0.3]
output = [0.9, 0.35]
points = "points.csv"
[response]
frequency = [10.5, 30]
harmonics = 3
preload_scale = [0.5, 2]
maps = ["peak"]
map_phases = 4
"""
# One curve of one harmonic: a name is pasted into as many places; the run is shorter.
FEWER = MODAL.replace("[0.5, 2]", "[1]").replace("harmonics = 3", "harmonics = 1")
POINTS = ("weight,tangential_stiffness,normal_stiffness,friction_coefficient,preload,phi_u_1,phi_u_2,phi_v_1\n"
          "1,1e4,1e4,0.3,2,0.8,-0.5,0.1\n0.5,2e4,1e4,0.3,1,0.7,-0.4,0.2\n")
# Assembly, factorisation and modes by the libraries that have threads of their own.
MESHED = """[model]
kind = "mesh"
file = "mesh.inp"
length_unit = "m"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = 7800
[modes]
count = 4
damping_ratio = 0.01
[supports]
clamped = ["left"]
[contact]
surface = "right"
slip_direction = [0, 0, 1]
friction_coefficient = 0.4
normal_stiffness = 1e11
tangential_stiffness = 1e11
[excitation]
forces = [ { at = "tip", direction = [0, 0, 1], amplitude = 1 } ]
[response]
output = { at = "tip", direction = [0, 0, 1] }
frequency = [1000, 1500]
harmonics = 1
preload = [5]
[accuracy]
error_budget = "off"
"""
COMPARED = ("curves", "maps", "modes.csv", "modes.vtu", "model.h5")
CRASHES = ("terminate called", "what():", "internal error", "Aborted", "std::", "Traceback")
NAMES = ("with spaces", " ", "Gehäuse Ω 轮", "per%sent %n", "{} {0:d}", "$HOME `id` $(id)", "quo'te\"s", "a\\b\\n", "#hash", "-o", "--help",
         "new\nline", "tab\t", "a,b;c", "<b>&amp;", "[brackets]*?", "x.toml", "n" * 255, "\udcff\udcfe", "~", "...", "CON", "nul:")


def block_mesh():
    """Two bricks of eight nodes side by side, as Abaqus writes them."""
    lines = ["*NODE"]
    for i in range(5):
        for j in range(2):
            for k in range(2):
                lines.append(f"{1 + 4 * i + 2 * j + k}, {0.05 * i}, {0.02 * j}, {0.02 * k}")
    lines.append("*ELEMENT, TYPE=C3D8, ELSET=all")
    for i in range(4):
        a = 1 + 4 * i
        lines.append(f"{i + 1}, {a}, {a + 4}, {a + 6}, {a + 2}, {a + 1}, {a + 5}, {a + 7}, {a + 3}")
    lines += ["*NSET, NSET=tip", "20", "*SURFACE, NAME=left, TYPE=ELEMENT", "1, S6", "*SURFACE, NAME=right, TYPE=ELEMENT", "4, S4"]
    return "\n".join(lines) + "\n"


def put(folder, modal=MODAL):
    for name, text in (("scene.toml", modal), ("points.csv", POINTS), ("mesh.toml", MESHED), ("mesh.inp", block_mesh())):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)


class Places:
    def __init__(self, program, work):
        self.program = os.path.abspath(program)
        self.work = os.path.abspath(work)
        self.n, self.wrong = 0, []
        shutil.rmtree(self.work, ignore_errors=True)
        os.makedirs(self.work)
        put(self.work)

    def call(self, arguments, folder=None, environment=None, prefix=(), **more):
        more = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, **more}
        done = subprocess.run([*prefix, self.program, *arguments], cwd=folder or self.work, timeout=300,
                              stderr=subprocess.PIPE, env=environment or without_plots(), check=False, **more)
        return done.returncode, done.stderr.decode("utf-8", "replace")

    def hold(self, name, what_is_wrong):
        self.n += 1
        if what_is_wrong:
            self.wrong.append(f"{name!r}: {what_is_wrong}")

    def run(self, scene, output, options=(), **how):
        return self.call(["run", scene, "-q", "--no-cache", *options, "-o", output], **how)

    def contents(self, run):
        found = {}
        for name in COMPARED:
            path = os.path.join(run, name)
            for inside, _, names in os.walk(path):
                for file in names:
                    found[os.path.relpath(os.path.join(inside, file), run)] = read(os.path.join(inside, file))
            if os.path.isfile(path):
                found[name] = read(path)
        return found

    def same(self, name, reference, run, outcome):
        code, words = outcome
        if code != 0:
            return self.hold(name, f"exit code {code}: {words[:300]}")
        found = self.contents(run)
        differ = sorted(file for file in reference.keys() | found.keys() if reference.get(file) != found.get(file))
        return self.hold(name, f"{', '.join(differ)} differ" if differ else "")

    # ---- row 61

    def machines(self):
        base = without_plots()
        bare = {key: value for key, value in base.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
        # The kernels of OpenBLAS that someone has chosen stay: others add up in another order, as another machine does.
        # What a sanitizer was told stays as well.
        nothing = {key: base[key] for key in ("PYTHONPATH", "OPENBLAS_CORETYPE", "ASAN_OPTIONS") if key in base}
        kinds = {
            "OMP_NUM_THREADS 0": {"environment": {**base, "OMP_NUM_THREADS": "0"}},
            "OMP_NUM_THREADS 1": {"environment": {**base, "OMP_NUM_THREADS": "1"}},
            "OMP_NUM_THREADS -3": {"environment": {**base, "OMP_NUM_THREADS": "-3"}},
            "OMP_NUM_THREADS no number": {"environment": {**base, "OMP_NUM_THREADS": "many", "OPENBLAS_NUM_THREADS": ""}},
            "OPENBLAS_NUM_THREADS 200": {"environment": {**base, "OPENBLAS_NUM_THREADS": "200"}},
            "one core": {"prefix": ("taskset", "-c", str(min(os.sched_getaffinity(0))))},
            "200 workers": {"options": ("-j", "200")},
            "decimal commas": {"environment": {**base, "LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8"}},
            "a locale that is none": {"environment": {**base, "LC_ALL": "nonsense", "LANG": "x_Y.Z"}},
            "no locale": {"environment": {**base, "LC_ALL": "C"}},
            "no display": {"environment": bare},
            "a display that is none": {"environment": {**base, "DISPLAY": ":77"}},
            "nothing in the environment": {"environment": nothing},
            "a home that is none": {"environment": {**base, "HOME": "/no/such/home", "XDG_CACHE_HOME": ""}},
            "no PATH, and so no ssh for MPI": {"environment": {**base, "PATH": "/no/such/folder"}},
            "another time zone": {"environment": {**base, "TZ": "Asia/Kathmandu"}},
            "no input, no output": {"preexec_fn": lambda: (os.close(0), os.close(1))},
            "no error output": {"preexec_fn": lambda: os.close(2)},
        }
        for scene in ("scene.toml", "mesh.toml"):
            reference_run = os.path.join(self.work, "reference")
            code, words = self.run(scene, reference_run)
            reference = self.contents(reference_run)
            self.hold(f"{scene} as it is", "" if code == 0 and len(reference) > 3 else f"exit code {code}: {words[:300]}")
            for i, (name, how) in enumerate(kinds.items()):
                run = os.path.join(self.work, f"machine{i}")
                self.same(f"{scene}, {name}", reference, run, self.run(scene, run, **how))
                shutil.rmtree(run, ignore_errors=True)
            shutil.rmtree(reference_run)

    def threads(self):
        """Factors of a blade have blocks that OpenBLAS cuts among its threads."""
        blade = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "share", "scenes", "blade_to_ground.toml")
        command = ["modes", blade, "--set", 'model.element_size="25 mm"', "-q", "-o"]
        free = {key: value for key, value in without_plots().items() if key != "OPENBLAS_NUM_THREADS"}
        kinds = {
            "as it is": {"environment": free},
            "OMP_NUM_THREADS 1": {"environment": {**free, "OMP_NUM_THREADS": "1"}},
            "OMP_NUM_THREADS 2": {"environment": {**free, "OMP_NUM_THREADS": "2"}},
            "OPENBLAS_NUM_THREADS 3": {"environment": {**free, "OPENBLAS_NUM_THREADS": "3"}},
            "one core": {"environment": free, "prefix": ("taskset", "-c", str(min(os.sched_getaffinity(0))))},
        }
        first = None
        for name, how in kinds.items():
            run = os.path.join(self.work, "threads")
            code, words = self.call([*command, run], **how)
            found = [read(os.path.join(run, file)) for file in ("modes.csv", "model.h5")] if code == 0 else words[:300]
            first = first or found
            self.hold(f"modes of a blade, {name}", "" if code == 0 and found == first else f"exit code {code}, or other bits")
            shutil.rmtree(run, ignore_errors=True)

    # ---- row 64

    def names(self):
        put(self.work, FEWER)
        reference_run = os.path.join(self.work, "reference")
        self.run("scene.toml", reference_run)
        reference = self.contents(reference_run)
        for name in NAMES:
            folder = os.path.join(self.work, "in", name)
            os.makedirs(folder)
            put(folder, FEWER)
            run = os.path.join(folder, name)
            self.same(f"folder {name}", reference, run, self.run("./scene.toml", f"./{name}", folder=folder))
            shutil.rmtree(os.path.join(self.work, "in"))
        for name in NAMES:
            scene = os.path.join(self.work, name[:250] + ".toml")
            shutil.copy(os.path.join(self.work, "scene.toml"), scene)
            run = os.path.join(self.work, "named")
            self.same(f"scene {name}", reference, run, self.run("./" + os.path.basename(scene), run))
            os.remove(scene)
            shutil.rmtree(run, ignore_errors=True)

    def meshes(self):
        """A mesh file by such a name; the scene names it in a string of TOML."""
        reference_run = os.path.join(self.work, "mesh-reference")
        self.run("mesh.toml", reference_run)
        reference = self.contents(reference_run)
        for name in ("with spaces", "Gehäuse Ω 轮", "{} %s", "n" * 240):
            folder = os.path.join(self.work, name)
            os.makedirs(folder)
            shutil.copy(os.path.join(self.work, "mesh.inp"), os.path.join(folder, f"{name}.inp"))
            with open(os.path.join(folder, "s.toml"), "w", encoding="utf-8") as file:
                file.write(MESHED.replace("mesh.inp", f"{name}.inp"))
            run = os.path.join(folder, "run")
            self.same(f"mesh {name}", reference, run, self.run("s.toml", "run", folder=folder))

    def refused(self, name, arguments, codes, says, **how):
        code, words = self.call(arguments, **how)
        wrong = ""
        if code not in codes:
            wrong = f"exit code {code}: {words[:300]}"
        elif any(crash in words for crash in CRASHES):
            wrong = words[:300]
        elif len(words) > 6000 or words.count("\n") > 8:
            wrong = f"{len(words)} characters, {words.count(chr(10))} lines"
        elif not all(part in words for part in says):
            wrong = f"lacks {says}: {words[:300]}"
        self.hold(name, wrong)

    def long_and_looping(self):
        deep = os.path.join(*["d" * 200] * 19)  # 3818 bytes below the work folder
        inside = os.open(self.work, os.O_RDONLY)
        for part in deep.split(os.sep):  # no single call can name it from the root
            os.mkdir(part, dir_fd=inside)
            below = os.open(part, os.O_RDONLY, dir_fd=inside)
            os.close(inside)
            inside = below
        with os.fdopen(os.open("scene.toml", os.O_WRONLY | os.O_CREAT, dir_fd=inside), "w", encoding="utf-8") as file:
            file.write(FEWER)
        with os.fdopen(os.open("points.csv", os.O_WRONLY | os.O_CREAT, dir_fd=inside), "w", encoding="utf-8") as file:
            file.write(POINTS)
        reference_run = os.path.join(self.work, "reference2")
        self.run("scene.toml", reference_run)
        reference = self.contents(reference_run)
        self.same("a scene 3.8 kB down", reference, os.path.join(self.work, "run"), self.run(f"{deep}/scene.toml", "run"))
        code, words = self.run(f"{deep}/scene.toml", f"{deep}/run")
        self.hold("results 3.8 kB down", "" if code in (0, 1, 4) and not any(crash in words for crash in CRASHES) else f"{code}: {words[:300]}")
        # From inside the names are short again.
        stay = lambda: os.fchdir(inside)
        code, words = self.call(["run", "scene.toml", "-q", "--no-cache", "-o", "r"], preexec_fn=stay)
        self.hold("from inside a folder 3.8 kB down",
                  "" if code in (0, 1, 4) and not any(crash in words for crash in CRASHES) else f"{code}: {words[:300]}")
        os.close(inside)
        too_long = "/".join(["e" * 200] * 25)
        self.refused("a path beyond PATH_MAX", ["check", too_long], (1,), ["eee"])
        self.refused("results beyond PATH_MAX", ["run", "scene.toml", "-o", too_long], (1, 4), ["eee"])
        self.refused("a name beyond NAME_MAX", ["run", "scene.toml", "-o", "f" * 256], (1, 4), ["fff"])
        shutil.rmtree(self.work, ignore_errors=True)
        os.makedirs(self.work)
        put(self.work, FEWER)
        os.symlink("loop.toml", os.path.join(self.work, "loop.toml"))
        os.symlink("b", os.path.join(self.work, "a"))
        os.symlink("a", os.path.join(self.work, "b"))
        self.refused("a scene that is a loop of links", ["check", "loop.toml"], (1,), ["loop.toml"])
        self.refused("results in a loop of links", ["run", "scene.toml", "-o", "a"], (1, 4), ["a"])
        self.refused("results below a loop of links", ["run", "scene.toml", "-o", "b/run"], (1, 4), ["b/run"])
        self.refused("a table that is a loop of links", ["check", "scene.toml", "--set", "modal.points=a"], (1,), ["a"])
        self.refused("a mesh that is a loop of links", ["check", "mesh.toml", "--set", "model.file=loop.toml"], (1,), ["loop.toml"])
        os.symlink("nowhere", os.path.join(self.work, "dangling.toml"))
        self.refused("no folder for temporary files", ["run", "scene.toml", "-q", "--no-cache", "-o", "r"], (4,), ["TMPDIR"],
                     environment={**without_plots(), "TMPDIR": os.path.join(self.work, "scene.toml", "below")})
        self.refused("a link to nothing", ["check", "dangling.toml"], (1,), ["dangling.toml"])
        os.makedirs(os.path.join(self.work, "real"))
        os.symlink("real", os.path.join(self.work, "linked"))
        os.symlink(os.path.join("..", "scene.toml"), os.path.join(self.work, "real", "s.toml"))
        os.symlink(os.path.join("..", "points.csv"), os.path.join(self.work, "real", "points.csv"))
        self.same("a linked scene into a linked folder", reference, os.path.join(self.work, "real", "run"),
                  self.run("linked/s.toml", "linked/run"))
        gone = os.path.join(self.work, "gone")
        os.makedirs(gone)
        leave = lambda: (os.chdir(gone), os.rmdir(gone))
        self.refused("a working folder that is gone", ["check", "scene.toml"], (1, 4), ["scene.toml"], preexec_fn=leave)

    def report(self):
        print(f"{self.n} runs in other places, {len(self.wrong)} wrong")
        print("\n".join(self.wrong))
        return 1 if self.wrong else 0


def read(path):
    with open(path, "rb") as file:
        return file.read()


def main(program, work):
    places = Places(program, work)
    places.machines()
    places.threads()
    places.names()
    places.meshes()
    places.long_and_looping()
    return places.report()


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2]))
