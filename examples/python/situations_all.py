# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the situations of all situations_*.py, one stack each, like the other lines of measure_acceptance.py."""

import hashlib
import tempfile
from pathlib import Path

import numpy as np
import situations
import situations_borders
import situations_branches
import situations_dark
import situations_drawn
import situations_frames
import situations_gains
import situations_good
import situations_light
import situations_parts
import situations_shared
import situations_structured
import situations_values
from acceptance_bursts import estimate
from acceptance_lines import stream_of
from acceptance_stacks import evaluate, evaluate_frames
from frame_stacks import write_stack

MODULES = (
    situations,
    situations_borders,
    situations_branches,
    situations_dark,
    situations_drawn,
    situations_frames,
    situations_gains,
    situations_good,
    situations_light,
    situations_parts,
    situations_shared,
    situations_structured,
    situations_values,
)
# The compared quantities: member of Burst, and path in the report.
COMPARED = {
    "gain": ("gain",),
    "offset": ("offset",),
    "read_noise": ("read_noise",),
    "linearity_error": ("linearity", "linearity_error_percent"),
}


def all_situations():
    return [situation for module in MODULES for situation in module.SITUATIONS]


def quantity_at(report, path):
    """Returns the quantity at a path of a report; empty if the report does not have it."""
    for name in path:
        report = report.get(name) or {}
    return report


def make(situation, scene, number):
    """Returns the burst of a situation: stack `number` of this scene."""
    random = np.random.default_rng(stream_of(f"{situation.name} {scene}", number))
    return situation.make(random, situations.electrons_of(scene, random) if scene else None)


def measure(programs, situation, scene, number):
    """Makes a burst, estimates its noise, and tests the report."""
    burst = make(situation, scene, number)
    with tempfile.TemporaryDirectory(prefix="situation-") as folder:
        stack, dark = Path(folder, "burst.mha"), Path(folder, "dark.mha")
        write_stack(stack, burst.frames)
        options = list(burst.options)
        if burst.dark is not None:
            write_stack(dark, burst.dark)
            options += ["--dark", dark]
        report, done = estimate(programs, situation.name, stack, options)
    truth = {name: float(getattr(burst, name)) for name in COMPARED if getattr(burst, name) is not None}
    found = {name: quantity_at(report, path) for name, path in COMPARED.items()}
    loud = [warning["code"] for warning in report["warnings"] if warning["severity"] != "note"]
    stack = evaluate(found, truth, burst.signal_range, loud, situation.expected)
    if burst.unlike_frames is not None:
        stack |= evaluate_frames((left["frame"] for left in report.get("frames_left_out", ())), burst.unlike_frames)
    return [stack | {"setting": "", "exit": done.code, "seconds": done.seconds, "bound": None, "emva_error": None}]


def bursts(seeds):
    """Returns all situations with their scenes and the seeds from 1 to `seeds`."""
    return [
        (situation, scene, seed)
        for situation in all_situations()
        for scene in situation.scenes or ("",)
        for seed in range(1, seeds + 1)
    ]


def recipe():
    """Returns the hash of the modules that make the bursts. With situation, scene and seed it determines them."""
    sources = b"".join(Path(module.__file__).read_bytes() for module in MODULES)
    return f"situations {hashlib.sha256(sources).hexdigest()[:12]}"
