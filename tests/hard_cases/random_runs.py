#!/usr/bin/env python3
"""Random scenes of every kind, every law of friction and one to seven harmonics, through the command line: points and chains of
1, 3 and 5 harmonics here, bars, blocks, areas, several contacts, small meshes and the other numbers in random_models.py.

Hard: nobody chose these scenes so that they work: stiff and soft contacts, gaps, light damping, loads of every size,
curves that fold and part.
Right: a complete curve, or a diagnosis that has a name (how many of each is told); never a signal, code 1 or 5, a number that is none, or rows that are
no solutions: a march through sampled time, which shares no code with the program, finds the forces of some rows again.

usage: random_runs.py MICROSLIP WORK_FOLDER [N] [SEED] [models]      N scenes, 2000 where MICROSLIP_CAMPAIGNS=whole, else one harmonic
of every kind and law; the seed is 1 by default; models: those of random_models.py, seed 3. A scene is SEED.NUMBER, or models
SEED.NUMBER, and does not depend on N. Prints a line for each scene that is not complete, or takes longer than the 99 % are to take, as
it goes, and a table at the end, also where it is stopped by SIGINT or SIGTERM. Exit code 1: a scene was wrong; 3: stopped.
"""
import collections
import csv
import json
import math
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "verification"))
from program_run import whole_campaigns, without_plots

CAP = 20  # s of processor time per scene
LONG = 5  # s that 99 % of the scenes are to stay below
OVER = f"over {CAP} s"
UNBOUNDED = "unbounded"  # what has no end: counted apart from what is diagnosed
# Of the largest force: sampled 4096 times a period, a contact that begins between two samples costs some 1e-6.
BALANCE = 1e-4
ROWS = 6  # of a curve that are marched through
LAWS = {
    "constant": "",
    "exponential": 'friction_law = {{ law = "exponential", static = {mu}, kinetic = {low}, rate = {rate} }}',
    "hyperbolic": 'friction_law = {{ law = "hyperbolic", static = {mu}, rate = {rate} }}',
    "cubic": 'roughness = {{ law = "cubic", height = {height} }}',
    "gaussian": 'roughness = {{ law = "gaussian", height = {height} }}',
}
KINDS = [("points", law) for law in LAWS] + [("planar", "constant"), ("chain", "constant")]
HARMONICS = (1, 3, 5)


class Draw(random.Random):
    def log(self, low, high):
        return math.exp(self.uniform(math.log(low), math.log(high)))

    def row(self, n, size=1.0):
        return [size * self.uniform(-1.0, 1.0) for _ in range(n)]


def modal_scene(draw, law, harmonics, planar):
    """1 to 4 modes, 1 to 6 points; stiffness, load and gap of 0.01 to 100 times what the structure has."""
    n_modes, n_points = draw.randint(1, 4), draw.randint(1, 6)
    frequency = [draw.log(2.0, 2000.0)]
    while len(frequency) < n_modes:
        frequency.append(frequency[-1] * draw.uniform(1.02, 3.0))
    force = draw.log(1e-2, 1e2)
    stiffness = (2.0 * math.pi * frequency[0])**2 * draw.log(1e-2, 1e2) / n_points
    normal = draw.choice((0.0, draw.log(0.1, 10.0)))
    mu = draw.log(0.05, 1.0)
    load = force * draw.log(0.05, 50.0) / n_points
    if normal and draw.random() < 0.25:
        load = -load
    if law in ("cubic", "gaussian"):
        normal, load = normal or 1.0, abs(load)
    share = draw.log(0.05, 1.0)
    points = []
    for _ in range(n_points):
        point = {"weight": draw.uniform(0.5, 1.5), "tangential_stiffness": stiffness, "normal_stiffness": normal * stiffness,
                 "friction_coefficient": mu, "preload": load * draw.uniform(0.5, 1.5)}
        point |= {f"phi_u_{i + 1}": value for i, value in enumerate(draw.row(n_modes))}
        if normal:
            point |= {f"phi_v_{i + 1}": value for i, value in enumerate(draw.row(n_modes, share))}
        if planar:
            point |= {f"phi_w_{i + 1}": value for i, value in enumerate(draw.row(n_modes, share))}
        points.append(point)
    size = force / stiffness / n_points  # of a displacement
    words = LAWS[law].format(mu=mu, low=mu * draw.uniform(0.3, 1.0), height=size * draw.log(0.1, 10.0),
                             rate=draw.log(0.1, 10.0) / (size * 2.0 * math.pi * frequency[0]))
    ends = [frequency[0] * draw.uniform(0.5, 0.9), frequency[-1] * draw.uniform(1.1, 2.0)]
    if draw.random() < 0.3:
        ends.reverse()
    modal = {"frequency": frequency, "damping_ratio": draw.log(1e-4, 0.05), "force_sine": draw.row(n_modes, force),
             "force_cosine": draw.row(n_modes, force), "output": draw.row(n_modes), "points": points}
    lines = ['[model]', 'kind = "modal"', '[modal]', *(f"{key} = {inline(value)}" for key, value in modal.items()),
             '[contact]', words, '[response]', f"frequency = {ends}", f"harmonics = {harmonics}", ACCURACY]
    return "\n".join(lines), modal


ACCURACY = '[accuracy]\nerror_budget = "off"\n'


def inline(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {inline(part)}" for key, part in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(inline(part) for part in value) + "]"
    return repr(value)


def chain_scene(draw, harmonics):
    """2 to 5 masses; the contact rubs on the ground or between two of them, pressed constantly or by another mass."""
    n = draw.randint(2, 5)
    masses = [draw.log(0.1, 10.0) for _ in range(n)]
    springs = [draw.log(1e4, 1e6) for _ in range(n + draw.randint(0, 1))]
    a, b = draw.sample(range(1, n + 1), 2)
    slip = draw.choice((f'"m{a}"', f"{{ m{a} = 1, m{b} = -1 }}"))
    stiffness, force = draw.log(1e3, 1e7), draw.log(0.1, 100.0)
    approach = f', approach = "m{b}", normal_stiffness = {draw.log(1e3, 1e7)}' if draw.random() < 0.5 and "{" not in slip else ""
    low = math.sqrt(min(springs) / max(masses)) / (2.0 * math.pi)
    high = 2.0 * math.sqrt(max(springs) / min(masses)) / (2.0 * math.pi)
    ends = [draw.log(0.1 * low, low), draw.log(low, high)]
    return f"""[model]
kind = "chain"
masses = {masses}
springs = {springs}
[modes]
damping_ratio = {draw.log(1e-4, 0.05)}
[contact]
points = [ {{ slip = {slip}, tangential_stiffness = {stiffness}, friction_coefficient = {draw.log(0.05, 1.0)}{approach} }} ]
[excitation]
forces = [ {{ at = "m{draw.randint(1, n)}", amplitude = {force} }} ]
[response]
output = "m{draw.randint(1, n)}"
frequency = {ends}
harmonics = {harmonics}
preload = [ {force * draw.log(0.05, 50.0)} ]
""" + ACCURACY, None


def scene_of(seed, number):
    """(kind, law, harmonics), the scene and, of modal scenes, its numbers."""
    draw = Draw(f"{seed}.{number}")
    kind, law = KINDS[number % len(KINDS)]
    harmonics = HARMONICS[number // len(KINDS) % len(HARMONICS)]
    if kind == "chain":
        return (kind, law, harmonics), *chain_scene(draw, harmonics)
    return (kind, law, harmonics), *modal_scene(draw, law, harmonics, kind == "planar")


def model_as_points(folder, known, load):
    """The numbers of a modal scene, read from the model of a run; `known` is its law."""
    import h5py  # runs without meshes do without

    with h5py.File(os.path.join(folder, "model.h5")) as file:
        contact = {name: np.array(file["contact"][name]) for name in
                   ("weights", "tangential_stiffness", "normal_stiffness", "friction_coefficient", "preload", "phi_u", "phi_v")}
        modal = {"frequency": np.array(file["angular_frequency"]) / (2.0 * np.pi), "damping_ratio": np.array(file["damping_ratio"])}
        modal |= {name: np.array(file[name]) for name in ("force_sine", "force_cosine")}
    names = {"weight": "weights", "preload": "preload"} | {name: name for name in list(contact)[1:4]}
    modal["points"] = []
    for i in range(len(contact["weights"])):
        point = {name: float(contact[of][i]) for name, of in names.items()}
        point["preload"] *= load
        for way in "uv":
            point |= {f"phi_{way}_{n + 1}": float(value) for n, value in enumerate(contact[f"phi_{way}"][i])}
        modal["points"].append(point)
    return modal | {"law": known}


def law_of(text):
    """Of a modal scene: as its coefficient is marched through."""
    found = re.search(r'law = "(exponential|hyperbolic)", static = (\S+), (?:kinetic = (\S+), )?rate = (\S+) ', text)
    return found and (found[1], float(found[2]), float(found[3] or 0.0), float(found[4]))


def coefficient(modal, column, speed):
    """By the imposed speed [m/s]."""
    if not modal.get("law"):
        return np.broadcast_to(column, speed.shape)
    name, rest, fast, rate = modal["law"]
    falls = fast + (rest - fast) * np.exp(-rate * speed) if name == "exponential" else rest / (1.0 + rate * speed)
    return np.where(column > 0.0, falls, 0.0)


def imbalance(modal, states):
    """Largest force left over in the equations of motion (theory, section 13), of the largest term in them."""
    n_modes, points = len(modal["frequency"]), modal["points"]
    q = states[:, 1:].reshape(len(states), -1, n_modes)  # rows: mean, sin 1, cos 1, …
    n_harmonics = (q.shape[1] - 1) // 2
    theta = 2.0 * np.pi * np.arange(4096) / 4096
    basis, rates = [np.ones_like(theta)], [np.zeros_like(theta)]
    for k in range(1, n_harmonics + 1):
        basis += [np.sin(k * theta), np.cos(k * theta)]
        rates += [k * np.cos(k * theta), -k * np.sin(k * theta)]
    basis = np.array(basis)
    column = {key: np.array([point.get(key, 0.0) for point in points]) for key in points[0]}
    phi = [np.array([[point.get(f"phi_{way}_{i + 1}", 0.0) for i in range(n_modes)] for point in points]) for way in "uv"]
    u, v = (np.einsum("cn,rhn,ht->trc", shape, q, basis) for shape in phi)
    load = np.maximum(column["preload"] + column["normal_stiffness"] * v, 0.0)
    speed = np.abs(np.einsum("cn,rhn,ht->trc", phi[0], q, np.array(rates))) * (2.0 * np.pi * states[:, 0])[None, :, None]
    friction = march(column["tangential_stiffness"], coefficient(modal, column["friction_coefficient"], speed), u, load,
                     column["preload"] + column["normal_stiffness"] * v)
    load = load - np.maximum(column["preload"], 0.0)
    traction = sum(np.einsum("trc,c,cn->trn", force, column["weight"], shape) for force, shape in ((friction, phi[0]), (load, phi[1])))
    contact = 2.0 * np.einsum("trn,ht->rhn", traction, basis) / len(theta)
    contact[:, 0] *= 0.5
    return left_over(modal, 2.0 * np.pi * states[:, 0], q, contact)


def left_over(modal, omega, q, contact):
    natural = 2.0 * np.pi * np.array(modal["frequency"])
    inertia, left = np.zeros_like(q), contact.copy()
    inertia[:, 0] = natural**2 * q[:, 0]
    for h in range(1, q.shape[1], 2):
        k = (h + 1) // 2
        turn = k * omega[:, None]
        sine, cosine = q[:, h], q[:, h + 1]
        damping = 2.0 * modal["damping_ratio"] * natural * turn
        inertia[:, h] = (natural**2 - turn**2) * sine - damping * cosine
        inertia[:, h + 1] = (natural**2 - turn**2) * cosine + damping * sine
    left += inertia
    left[:, 1] -= modal["force_sine"]
    left[:, 2] -= modal["force_cosine"]
    size = max(np.abs(inertia).max(), np.abs(contact).max(), np.abs(modal["force_sine"]).max(), np.abs(modal["force_cosine"]).max())
    return np.abs(left).max() / size


def march(stiffness, mu, u, load, pressure):
    """Coulomb friction with a spring in series, the second of two periods. Arrays: instant, row, point."""
    friction = np.empty_like(u)
    force = stiffness * u[0]
    for step in range(2 * len(u)):
        now, before = step % len(u), (step - 1) % len(u) if step else 0
        begins = (pressure[before] < 0.0) & (pressure[now] >= 0.0)
        rise = pressure[now] - pressure[before]
        since = np.where(begins, pressure[now] / np.where(rise == 0.0, 1.0, rise), 1.0)  # share of the step in contact
        trial = np.where(begins, 0.0, force) + stiffness * since * (u[now] - u[before])
        force = np.clip(trial, -mu[now] * load[now], mu[now] * load[now])
        friction[now] = force
    return friction


class Stopped(Exception):
    """By a signal."""


def stop(number, _frame):
    raise Stopped(signal.Signals(number).name)


class Campaign:
    def __init__(self, program, work, seed, models=False):
        self.program, self.work, self.seed, self.models = program, work, seed, models
        self.outcomes = collections.defaultdict(collections.Counter)
        self.seconds, self.worst, self.n_rows, self.n_marched = [], 0.0, 0, 0
        shutil.rmtree(work, ignore_errors=True)
        os.makedirs(work)

    def case(self, number):
        row, text, numbers = self.scene(number)
        folder = os.path.join(self.work, str(number))
        os.makedirs(folder)
        with open(os.path.join(folder, "scene.toml"), "w", encoding="utf-8") as file:
            file.write(text)
        if row[0] == "mesh":
            random_models.write_mesh(os.path.join(folder, "cantilever.msh"))
        code, words, seconds = self.run(folder)
        try:
            outcome = self.outcome(folder, code, words, numbers, seconds)
        except AssertionError as wrong:
            outcome = "WRONG"
            words = str(wrong)
        self.seconds.append(seconds)
        self.outcomes[row][outcome] += 1
        if outcome != "complete" or seconds > LONG:
            print(f"{'models ' if self.models else ''}{self.seed}.{number} ({' '.join(map(str, row))}): {outcome}, {seconds:.1f} s: {words.strip()[:250]}", flush=True)
        if outcome == "complete":
            shutil.rmtree(folder)

    def scene(self, number):
        """As scene_of(), and what gives the numbers of its points in a run folder; None: its rows are not marched through."""
        if not self.models:
            row, text, modal = scene_of(self.seed, number)
            return row, text, (lambda run: modal) if row[:2] == ("points", "constant") else None
        row, text, how = random_models.model_of(self.seed, number)
        if how is None:
            return row, text, None
        known, load = (law_of(text), 1.0) if row[0] in ("points", "bar") else how[1:]
        return row, text, lambda run: model_as_points(run, known, load)

    def run(self, folder):
        with open(os.path.join(folder, "words"), "w+", encoding="utf-8") as words:
            process = subprocess.Popen([self.program, "run", "scene.toml", "-q", "-j", "1", "-o", "run", "--without", "plots"],
                                       cwd=folder, stdout=subprocess.DEVNULL, stderr=words, env=without_plots(),
                                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (CAP, CAP + 5)))
            try:
                _, status, used = os.wait4(process.pid, 0)
            except Stopped:
                process.kill()
                process.wait()
                raise
            process.returncode = os.waitstatus_to_exitcode(status)
            words.seek(0)
            return process.returncode, words.read(), used.ru_utime + used.ru_stime

    def outcome(self, folder, code, words, numbers, seconds):
        # By SIGXCPU and nothing else; the limit counts ticks of the clock, on a busy machine up to a third more than was used.
        if code == 3 and "interrupted" in words:
            return OVER
        if code < 0:
            raise AssertionError(f"ended by signal {-code}")
        if code not in (0, 2, 3, 4):
            raise AssertionError(f"exit code {code}: {words}")
        with open(os.path.join(folder, "run", "summary.json"), encoding="utf-8") as file:
            said = file.read()
        for name in sorted(os.listdir(os.path.join(folder, "run", "curves"))):
            with open(os.path.join(folder, "run", "curves", name), encoding="utf-8") as file:
                table = file.read()
            if re.search(r"nan|inf", table):
                raise AssertionError(f"{name}: a number that is none")
            if name.endswith(".states.csv") and numbers:
                self.march(name, table, numbers(os.path.join(folder, "run")))
        curves = json.loads(said)["curves"]
        if not all(curve["complete"] or curve["diagnosis"] for curve in curves):
            raise AssertionError("incomplete without a name")
        for curve in curves:
            if len(curve["folds_Hz"]) % 2 and is_one_piece(curve):
                raise AssertionError(f"{curve['name']}: {len(curve['folds_Hz'])} folds from end to end, an odd number")
        outcome = next((curve["diagnosis"] for curve in curves if not curve["complete"]), "complete")
        if (outcome == "complete") != (code == 0):
            raise AssertionError(f"{outcome}, and exit code {code}")
        return outcome

    def march(self, name, table, modal):
        rows = np.array([[float(cell) for cell in row] for row in list(csv.reader(table.splitlines()))[1:]])
        self.n_rows += len(rows)
        if len(rows) == 0:
            return
        chosen = rows[np.unique(np.linspace(0, len(rows) - 1, ROWS).astype(int))]
        self.n_marched += len(chosen)
        error = imbalance(modal, chosen)
        self.worst = max(self.worst, error)
        if not error < BALANCE:
            raise AssertionError(f"{name}: forces {error:.1e} out of balance")

    def report(self):
        columns = ["tried", "complete", "diagnosed", UNBOUNDED, OVER, "WRONG"]
        print(f"{'':28s}" + "".join(f"{name:>11s}" for name in columns))
        total, named = collections.Counter(), collections.Counter()
        for row in sorted(self.outcomes):
            counts = counted(self.outcomes[row])
            total += counts
            named += self.outcomes[row]
            print(f"{' '.join(map(str, row)):28s}" + "".join(f"{counts[name]:11d}" for name in columns))
        print(f"{'all':28s}" + "".join(f"{total[name]:11d}" for name in columns))
        print("diagnosed: " + (", ".join(f"{name} {named[name]}" for name in sorted(named) if name not in columns) or "none"))
        bounded = total["tried"] - total[UNBOUNDED]
        if bounded:
            print(f"{100.0 * total['complete'] / bounded:.2f} % of those that have a bound are complete")
        times = sorted(self.seconds)
        if times:
            n = len(times)
            print(f"processor time per scene: median {times[n // 2]:.2f} s, 99 % below {times[min(n - 1, 99 * n // 100)]:.2f} s")
        print(f"{self.n_marched} of {self.n_rows} rows marched through: forces balance within {self.worst:.1e}")
        return 1 if total["WRONG"] else 0


def is_one_piece(curve):
    """From one end of the range to the other without a place at which it was entered anew."""
    anew = {"fixed-frequency", "homotopy", "other-branch"}
    return curve["complete"] and not any(step["remedy"] in anew for step in curve["remedies"])


def counted(outcomes):
    """The columns of a row: what has a name of its own is diagnosed."""
    counts = collections.Counter()
    for outcome, n in outcomes.items():
        counts["tried"] += n
        counts[outcome if outcome in ("complete", UNBOUNDED, OVER, "WRONG") else "diagnosed"] += n
    return counts


def main(program, work, n, seed, models):
    began = time.monotonic()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, stop)
    campaign = Campaign(os.path.abspath(program), work, seed, models)
    number, stopped = 0, ""
    try:
        for number in range(n):
            campaign.case(number)
        number = n
    except Stopped as by:
        stopped = f", stopped by {by}"
    print(f"the first {number} of {'models' if models else 'scenes'} {seed}.0 to {seed}.{n - 1} in {time.monotonic() - began:.0f} s{stopped}:")
    return campaign.report() or (3 if stopped else 0)


if __name__ == "__main__":
    import random_models  # which draws as this file does

    if len(sys.argv) < 3:
        sys.exit(__doc__)
    of_models = sys.argv[-1] == "models"
    asked = [int(word) for word in sys.argv[3:len(sys.argv) - of_models]]
    one_each = len(random_models.KINDS if of_models else KINDS)
    sys.exit(main(sys.argv[1], sys.argv[2], asked[0] if asked else 2000 if whole_campaigns() else one_each,
                  asked[1] if len(asked) > 1 else 3 if of_models else 1, of_models))
