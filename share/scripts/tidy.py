#!/usr/bin/python3
"""Runs clang-tidy over sources, as many at a time as there are processors, and fails on any finding.

    tidy.py BUILD [SOURCE …]     BUILD holds compile_commands.json; tidy.sh makes it and calls this

A source that was clean is not read again until something changes that its verdict rests on: its own text, a
header of the project it includes, directly or not, its compiler command, the settings, clang-tidy itself or an
installed development package. What was found of each source is kept in BUILD/verdicts.
"""
import concurrent.futures
import hashlib
import json
import os
import re
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ROOMS = ("mesh", "fem", "contact", "solver", "pipelines")
FORCED_HEADER = os.path.join(ROOT, "share", "scripts", "clang_source_location.hpp")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)
FINDING = re.compile(r"^\S+:\d+:\d+: (?:error|warning): ", re.M)


def product_sources():
    return sorted(os.path.relpath(os.path.join(folder, name), ROOT)
                  for room in ROOMS for folder, _, names in os.walk(os.path.join(ROOT, room))
                  for name in names if name.endswith(".cpp"))


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class Keys:
    """Digests of everything the verdict on a source rests on."""

    def __init__(self, build):
        self.commands = {os.path.realpath(os.path.join(entry["directory"], entry["file"])): entry["command"]
                         for entry in json.loads(text_of(os.path.join(build, "compile_commands.json")))}
        self.common = "\n".join([
            output_of("clang-tidy", "--version"), output_of("dpkg-query", "-W", "*-dev"),
            text_of(os.path.join(ROOT, ".clang-tidy")), text_of(FORCED_HEADER)])
        self.files = {}  # path: digest of its text, paths it includes

    def read(self, path):
        if path not in self.files:
            text = text_of(path)
            # Includes are written from the root; those of a library in quotes are not found there.
            included = [os.path.join(ROOT, name) for name in INCLUDE.findall(text)]
            self.files[path] = (hashlib.sha256(text.encode()).hexdigest(),
                                [name for name in included if os.path.isfile(name)])
        return self.files[path]

    def closure(self, source):
        """The source and every header of the project it reads."""
        seen, ahead = set(), [source]
        while ahead:
            path = ahead.pop()
            if path not in seen:
                seen.add(path)
                ahead += self.read(path)[1]
        return sorted(seen)

    def key(self, source):
        path = os.path.realpath(os.path.join(ROOT, source))
        if path not in self.commands:
            raise SystemExit(f"tidy: the build does not compile {source}")
        parts = [self.common, self.commands[path]]
        parts += [f"{name} {self.read(name)[0]}" for name in self.closure(path)]
        return hashlib.sha256("\n".join(parts).encode()).hexdigest()


class Verdicts:
    """One small file per source: the key under which it was clean, or "findings"; seconds it took."""

    def __init__(self, build):
        self.folder = os.path.join(build, "verdicts")
        os.makedirs(self.folder, exist_ok=True)

    def path(self, source):
        return os.path.join(self.folder, source.replace("/", "_"))

    def of(self, source):
        try:
            key, seconds = text_of(self.path(source)).split()
            return key, float(seconds)
        except (FileNotFoundError, ValueError):  # never read, or the machine went down while it was written
            return "", float("inf")

    def keep(self, source, key, seconds):
        with open(self.path(source), "w", encoding="utf-8") as file:
            file.write(f"{key} {seconds:.1f}\n")


def tidy(build, source):
    """Findings of one source, as text, empty if it is clean; seconds."""
    start = time.monotonic()
    run = subprocess.run(
        ["clang-tidy", "--quiet", f"--extra-arg=-include{FORCED_HEADER}", "-p", build, source],
        cwd=ROOT, capture_output=True, text=True, check=False)
    findings = ""
    if run.returncode != 0:
        # Its count of warnings in other people's headers says nothing.
        messages = [line for line in run.stderr.splitlines() if "warnings generated" not in line]
        findings = run.stdout + "\n".join(messages) or f"clang-tidy ended with {run.returncode}"
    return findings, time.monotonic() - start


def print_new(findings, seen):
    """A header's finding comes back with every source that includes it: it is printed once."""
    starts = [match.start() for match in FINDING.finditer(findings)] or [0]
    for begin, end in zip(starts, starts[1:] + [len(findings)]):
        finding = findings[begin:end].rstrip()
        if finding not in seen:
            seen.add(finding)
            print(finding, flush=True)


def run_all(build, due, verdicts):
    """The number of sources with findings."""
    seen, bad = set(), 0
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        waiting = {pool.submit(tidy, build, source): (source, key) for source, key in due}
        try:
            for done, run in enumerate(concurrent.futures.as_completed(waiting), 1):
                source, key = waiting[run]
                findings, seconds = run.result()
                verdicts.keep(source, "findings" if findings else key, seconds)
                print(f"tidy: {done} of {len(due)}: {source}, {seconds:.0f} s"
                      f"{': findings' if findings else ''}", flush=True)
                if findings:
                    bad += 1
                    print_new(findings, seen)
        except KeyboardInterrupt:
            pool.shutdown(cancel_futures=True)
            raise
    return bad


def main(build, sources):
    start = time.monotonic()
    sources = [os.path.relpath(source, ROOT) for source in sources] or product_sources()
    keys, verdicts = Keys(build), Verdicts(build)
    due = [(source, key) for source in sources
           if (key := keys.key(source)) != verdicts.of(source)[0]]
    # The longest first: none is left over when the others have ended.
    due.sort(key=lambda item: -verdicts.of(item[0])[1])
    print(f"tidy: {len(due)} files to read, {len(sources) - len(due)} clean and unchanged", flush=True)
    bad = run_all(build, due, verdicts)
    if bad:
        print(f"tidy: findings in {bad} files", file=sys.stderr)
        return 1
    print(f"tidy: clean, {len(sources)} files, {time.monotonic() - start:.0f} s")
    return 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    try:
        sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2:]))
    except KeyboardInterrupt:
        sys.exit(130)
