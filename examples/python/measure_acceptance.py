# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the errors of the estimator in one table that can be compared between two commits.

    measure_acceptance.py --bin build/bin --quick --results before.jsonl
    measure_acceptance.py --bin build/bin --quick --results after.jsonl
    measure_acceptance.py --compare before.jsonl after.jsonl

A line is a kind of burst: the lines of acceptance_lines.py, which simulate-sensor-noise makes, the cases of
measure-cases, and the bursts that NumPy makes (situations.py). The columns of a line are:

    error %    mean absolute error of the gain; more than 100 % counts as 100 %
    /bound     rms error of the gain over its Cramér-Rao bound, if the bound is known
    /EMVA      rms error of the gain over the rms error of EMVA 1288's photon transfer of the same frames: exposures/*
    held       95 % intervals that contain the truth, of the identified quantities: gain, offset, read noise, and the
               linearity error
    named      frames unlike the others that the report leaves out, of all such frames
    refused    stacks whose gain is not identified
    wrong      stacks with an identified quantity whose error exceeds 4 standard errors and a smallest size
    silent     wrong stacks whose report has no warning of the severity warning or error
    s          processor seconds of the estimate; of a study: with the simulation
    faults     results that the line should not show. A gain that is not identified is a fault if one is expected.
               above EMVA: the errors exceed EMVA's by more than chance

Seeds are fixed and every estimate has one thread, so that two programs get the same stacks. The comparison shows the
mean of new less old over the same stacks, with its standard error. A line is better or worse if this difference exceeds
chance and a smallest size (acceptance_compare.py). Exit code: 0; with --compare 1 if a line is worse; 2 if a program
failed.

--results: file of the stacks, with one job per line. A job that the file has with the same programs is not run again:
the same command continues an interrupted run. --lines: names or patterns, such as 'illumination/*'. --estimator-bin:
the estimator and the studies of another build, such as an older commit, on the stacks of the simulator in --bin.
"""

import argparse
import os
import sys
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from fnmatch import fnmatchcase
from pathlib import Path

from acceptance_jobs import (
    FULL,
    QUICK,
    append_result,
    burst_jobs,
    missing_jobs,
    read_results,
    situation_jobs,
    stacks_of,
    study_jobs,
)
from acceptance_programs import ProgramError, Programs
from acceptance_tables import print_comparison, print_summary

PROGRESS_SECONDS = 30


def parse(arguments):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False
    )
    mode = parser.add_mutually_exclusive_group(required=True)
    mode.add_argument("--quick", action="store_true", help="at most 5 minutes on two cores")
    mode.add_argument("--full", action="store_true", help="at least 100 stacks a line, some hours")
    mode.add_argument("--show", type=Path, metavar="FILE", help="the table of a file of results")
    mode.add_argument("--compare", type=Path, nargs=2, metavar=("OLD", "NEW"), help="two files of results")
    parser.add_argument("--bin", type=Path, default=Path("build/bin"), help="folder of the built programs")
    parser.add_argument("--estimator-bin", type=Path, help="folder of the estimator and the studies, if another")
    parser.add_argument("--results", type=Path, help="file to which the results are added")
    parser.add_argument("--lines", nargs="+", default=["*"], metavar="PATTERN")
    parser.add_argument("--seeds", type=int, help="stacks of each variant instead of the mode's")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="programs at the same time")
    options = parser.parse_args(arguments)
    if (options.quick or options.full) and not options.results:
        parser.error("--quick and --full need --results FILE")
    return options


def plan_of(options):
    plan = QUICK if options.quick else FULL
    if options.seeds:
        plan = plan._replace(**{name: options.seeds for name in plan._fields if name.endswith("_seeds")})
    return plan


def is_chosen(line, patterns):
    return any(fnmatchcase(line, pattern) for pattern in patterns)


def run_jobs(jobs, results, processes):
    """Runs jobs in parallel, and files each finished job. Returns the errors of the failed jobs."""
    start = said = time.monotonic()
    errors = []
    with ThreadPoolExecutor(processes) as pool:
        running = {pool.submit(job.measure): job for job in jobs}
        try:
            for count, done in enumerate(as_completed(running), 1):
                job = running[done]
                try:
                    append_result(results, job, done.result())
                except (ProgramError, ValueError) as error:
                    errors.append(f"{job.line}, {job.variant}, seed {job.seed}: {error}")
                if time.monotonic() - said > PROGRESS_SECONDS:
                    said = time.monotonic()
                    print(f"{count} of {len(jobs)} jobs, {said - start:.0f} s", file=sys.stderr, flush=True)
        except KeyboardInterrupt:
            pool.shutdown(cancel_futures=True)
            raise
    print(f"{len(jobs)} jobs in {time.monotonic() - start:.0f} s", file=sys.stderr)
    return errors


def measure(options):
    programs = Programs(options.bin.resolve(), (options.estimator_bin or options.bin).resolve())
    for program in (programs.simulator, programs.estimator):
        if not program.exists():
            print(f"error: {program} does not exist: build it, or give its folder by --bin", file=sys.stderr)
            return 2
    plan = plan_of(options)
    jobs = [*study_jobs(programs, plan), *burst_jobs(programs, plan), *situation_jobs(programs, plan)]
    jobs = [job for job in jobs if is_chosen(job.line, options.lines)]
    errors = run_jobs(missing_jobs(jobs, read_results(options.results)), options.results, options.jobs)
    print_summary(stacks_of(read_results(options.results), jobs))
    for error in errors:
        print(f"error: {error}", file=sys.stderr)
    return 2 if errors else 0


def chosen_stacks(name, patterns):
    if not name.exists():
        raise SystemExit(f"error: {name} does not exist")
    return {key: stack for key, stack in stacks_of(read_results(name)).items() if is_chosen(key[0], patterns)}


def main(arguments=None) -> int:
    options = parse(arguments)
    if options.compare:
        verdicts = print_comparison(*(chosen_stacks(name, options.lines) for name in options.compare))
        return 1 if verdicts["worse"] else 0
    if options.show:
        print_summary(chosen_stacks(options.show, options.lines))
        return 0
    return measure(options)


if __name__ == "__main__":
    sys.exit(main())
