#!/usr/bin/python3
"""A command of an example that takes too long to run, by the name it is called by: whatever can be told without running it
is, and what is wrong is an error.

  microslip          the program with --dry-run
  ctest              lists the tests it would run: there must be some
  python3 SCRIPT …   and scripts: the script is there and knows the options
  others             nothing

DRY_PROGRAM and DRY_SOURCE: the program and the sources.
"""
import os
import re
import subprocess
import sys

SOURCE = os.environ.get("DRY_SOURCE", "")


def script_knows(path, words):
    """What a script does not know; empty: all is well."""
    with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
        text = file.read()
    options = [word for word in words if re.match(r"--?[a-z]", word)]
    return [f"{path} has no option {option}" for option in options if not re.search(rf"(?<![\w-]){re.escape(option)}\b", text)]


def faults(name, words):
    if name == "microslip":
        more = [] if words[0] in ("init", "surfaces", "faces", "columns", "report", "check") else ["--dry-run"]
        return [] if subprocess.run([os.environ["DRY_PROGRAM"], *words, *more]).returncode == 0 else ["the program refuses it"]
    if name == "ctest":
        build = os.path.join(os.path.dirname(os.environ["DRY_PROGRAM"]), "..")
        words = [build if word == "build" else word for word in words if word not in ("-V",)]
        told = subprocess.run(["/usr/bin/env", "ctest", "-N", *words], capture_output=True, text=True, env={**os.environ, "PATH": os.defpath})
        return [] if re.search(r"Total Tests: [1-9]", told.stdout) else ["no such test"]
    if name in ("paraview", "pvbatch"):
        scripts = [word.removeprefix("--script=") for word in words if word.endswith(".py")]
        return [fault for script in scripts for fault in script_knows(script, [])]
    if name == "python3":
        return script_knows(words[0], words[1:]) if not words[0].startswith("-") else []
    return script_knows(os.path.join("share", "scripts", name), words)


if __name__ == "__main__":
    found = faults(os.path.basename(sys.argv[0]), sys.argv[1:])
    print(*found, sep="\n", file=sys.stderr)
    sys.exit(1 if found else 0)
