# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Lists the jobs of measure_acceptance.py, and reads and writes the file of finished jobs.

A job is one line, one variant and one seed. The file has one JSON object for each finished job, so that an interrupted
run can continue. A job is not repeated if the file has it with the same programs and the same recipe.
"""

import json
import os
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import NamedTuple

import acceptance_bursts
import acceptance_studies
import situations_all
from acceptance_lines import LINES, simulator_options, variants
from acceptance_programs import hash_of


class Plan(NamedTuple):
    """Numbers and sizes of the stacks of a run. The numbers of seeds are for each variant of a line."""

    burst_seeds: int  # times 3 scenes and 2 converters
    exposure_seeds: int  # for exposures/*, times 3 scenes and 2 converters
    situation_seeds: int  # for each scene of a situation
    efficiency_seeds: int
    efficiency_size: int  # width and height [pixels]
    robustness_seeds: int  # times 2 scenes
    robustness_size: int
    sensors_seeds: int  # times 6 to 108 settings
    sensors_size: int


# Numbers with which two cores need less than 5 minutes. Sensors of 128 pixels took 302 s.
QUICK = Plan(3, 1, 1, 6, 256, 4, 128, 2, 96)
# Numbers that give at least 100 stacks per line, but 40 for a situation without a scene of SCENES.
FULL = Plan(20, 20, 40, 100, 512, 50, 256, 20, 256)


class Job(NamedTuple):
    """Work that gives the stacks of one line, variant and seed."""

    line: str
    variant: str
    seed: int
    recipe: str  # options that determine the stacks together with line, variant and seed
    program: str  # hash of the programs
    measure: Callable[[], list[dict]]

    @property
    def key(self):
        return self.line, self.variant, self.seed, self.recipe, self.program


def burst_jobs(programs, plan):
    program = f"{hash_of(programs.estimator)} {hash_of(programs.simulator)}"
    for line in LINES:
        for scene, bits in variants():
            made_by = (
                *simulator_options(line, scene, bits),
                line.illumination,
                *line.factors,
                *line.replaced,
                *line.estimator,
            )
            recipe = " ".join(map(str, made_by))
            for seed in range(1, (plan.exposure_seeds if line.frames_per_level else plan.burst_seeds) + 1):
                measure = partial(acceptance_bursts.measure, programs, line, scene, bits, seed)
                yield Job(line.name, f"{scene}, {bits} bits", seed, recipe, program, measure)


def situation_jobs(programs, plan):
    """Yields the jobs of the bursts that NumPy makes. The source that makes them is part of the recipe."""
    program, recipe = hash_of(programs.estimator), situations_all.recipe()
    for situation, scene, seed in situations_all.bursts(plan.situation_seeds):
        measure = partial(situations_all.measure, programs, situation, scene, seed)
        yield Job(situation.name, scene, seed, recipe, program, measure)


def study_jobs(programs, plan):
    """Yields the jobs of measure-cases, if it was built. The jobs of the sensors take longest and come first, so that
    no processor is idle at the end."""
    program = programs.studies
    if not program.exists():
        return
    plans = [("sensors", "", plan.sensors_size, plan.sensors_seeds)]
    plans += [("efficiency", "target", plan.efficiency_size, plan.efficiency_seeds)]
    plans += [("robustness", scene, plan.robustness_size, plan.robustness_seeds) for scene in ("target", "texture")]
    for study, scene, size, seeds in plans:
        for name in acceptance_studies.names_of(program, study):
            pattern = f"{study}/{name}/{scene or '*'}"
            seeded = f"{study} {name} {scene}" if study == "robustness" else f"{study} {name}"
            for seed in range(1, seeds + 1):
                measure = partial(acceptance_studies.measure, program, pattern, seeded, size, seed)
                yield Job(f"{study}/{name}", scene, seed, f"size {size}", hash_of(program), measure)


def read_results(name):
    """Returns the jobs in a file of results. Incomplete lines, as after a crash, are left out."""
    path = Path(name)
    records = []
    for line in path.read_text(encoding="utf-8").splitlines() if path.exists() else ():
        try:
            records.append(json.loads(line))
        except json.JSONDecodeError:
            continue
    return records


def key_of(record):
    return tuple(record[name] for name in ("line", "variant", "seed", "recipe", "program"))


def missing_jobs(jobs, records):
    """Returns the jobs that are not in the records of a file of results."""
    done = {key_of(record) for record in records}
    return [job for job in jobs if job.key not in done]


def append_result(name, job, stacks):
    """Adds a job to a file of results, as one line in one write."""
    record = {**dict(zip(("line", "variant", "seed", "recipe", "program"), job.key, strict=True)), "stacks": stacks}
    with Path(name).open("ab+") as file:
        length = file.seek(0, os.SEEK_END)
        file.seek(max(0, length - 1))
        is_cut = length > 0 and file.read(1) != b"\n"
        file.write((("\n" if is_cut else "") + json.dumps(record) + "\n").encode())


def stacks_of(records, jobs=None):
    """Returns the stacks by (line, variant, setting, seed, recipe), of the jobs or of the last program of each line."""
    last = {record["line"]: record["program"] for record in records}
    wanted = None if jobs is None else {job.key for job in jobs}
    return {
        (record["line"], record["variant"], stack["setting"], record["seed"], record["recipe"]): stack
        for record in records
        if (record["program"] == last[record["line"]] if wanted is None else key_of(record) in wanted)
        for stack in record["stacks"]
    }
