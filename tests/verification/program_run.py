"""Runs of the program, and how much of a study is asked for."""
import os
import subprocess

NO_PLOTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support", "no_plots")


def without_plots():
    """An environment in which the program draws nothing, loading matplotlib takes longer than most runs, and takes nothing from
    earlier runs unless a folder of theirs is named."""
    return {"MICROSLIP_CACHE": "off", **os.environ, "PYTHONPATH": NO_PLOTS}


def whole_campaigns():
    """As tests/support/campaign.hpp has it."""
    asked = os.environ.get("MICROSLIP_CAMPAIGNS")
    if asked not in (None, "whole"):
        raise ValueError(f"MICROSLIP_CAMPAIGNS is {asked}, not whole")
    return asked is not None


def run_scene(program, scene, folder, *settings, options=(), plots=False, cache=None):
    """The run folder. `cache`: a folder of meshes and modes that runs share; none of its own."""
    command = [program, "run", scene, "-q", *options, "-o", folder]
    for setting in settings:
        command += ["--set", setting]
    environment = dict(os.environ) if plots else without_plots()
    if cache:
        environment["MICROSLIP_CACHE"] = cache
    finished = subprocess.run(command, capture_output=True, text=True, timeout=900, env=environment)
    if finished.returncode != 0:
        raise RuntimeError(f"{' '.join(command)} ended with {finished.returncode}: {finished.stderr}")
    return folder
