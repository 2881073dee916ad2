#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Simulates an archive of cameras, measures it session by session, and tests whether small steps are found.

    measure_archive.py                                 # 100 cameras, 12 sessions each
    measure_archive.py --cameras 12 --size 96          # a short run
    measure_archive.py --output archive.jsonl          # continues an interrupted run

Every second camera has one step of 0.5 %, up or down, in turn of its gain, offset or read noise. There are at least two
sessions before and after the step. Each burst is simulated by the worker that measures it, with its own illumination,
motion and noise. itk_sensornoise.distributed.find_steps() then gets only the values and errors of the reports. Needs
pandas and Dask: pip install itk-sensornoise[distributed] pandas.
"""

import argparse
import functools
import math
import time
from collections import Counter
from itertools import product
from statistics import NormalDist

import numpy as np
from distributed import Client, LocalCluster
from itk_sensornoise import estimate_sensor_noise, simulate_sensor_noise
from itk_sensornoise.distributed import estimate_many, find_steps

COLUMNS = {
    "gain": ("gain_DN_per_e", "gain_error_DN_per_e"),
    "offset": ("offset_DN", "offset_error_DN"),
    "read_noise": ("read_noise_DN", "read_noise_error_DN"),
}
STEP = 0.005
ILLUMINATION = {"electrons": 1000, "flicker_sd": 0.1}


def cameras_of(count, sessions):
    """Returns the parameters of each camera, and its step as (quantity, session, relative change) or None."""
    random = np.random.default_rng(20)
    cameras = []
    for number in range(count):
        parameters = {
            "gain": random.uniform(0.8, 1.25),
            "offset": random.uniform(150, 250),
            "read_noise": random.uniform(10, 14),
        }
        at, sign = int(random.integers(2, sessions - 1)), random.choice([-1, 1])
        step = (list(COLUMNS)[number // 2 % 3], at, sign * STEP) if number % 2 else None
        cameras.append((parameters, step))
    return cameras


def burst(camera, session, seed, size, frames):
    """Returns the frames of one session."""
    parameters, step = dict(camera[0]), camera[1]
    if step is not None and session >= step[1]:
        parameters[step[0]] *= 1 + step[2]
    return simulate_sensor_noise(**parameters, **ILLUMINATION, frames=frames, size=(size, size), seed=seed)[0]


def sources_of(cameras, options):
    """Returns a function for each burst, by the numbers of camera and session."""
    return {
        f"{number} {session}": functools.partial(
            burst, cameras[number], session, 1 + number * options.sessions + session, options.size, options.frames
        )
        for number, session in product(range(len(cameras)), range(options.sessions))
    }


def measured(sources, workers, output=None):
    """Returns the table, and the seconds that it took with this number of workers of one thread each."""
    with (
        LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=":0") as cluster,
        Client(cluster) as client,
    ):
        estimate_many({f"first {n}": each for n, each in enumerate(list(sources.values())[:workers])}, client)
        start = time.perf_counter()
        return estimate_many(sources, client, output=output), time.perf_counter() - start


def print_times(sources, count):
    """Prints the seconds of the simulation and the measurement of a burst, and of `count` bursts with one and two
    workers."""
    some = dict(list(sources.items())[:count])
    start = time.perf_counter()
    stacks = [each() for each in list(some.values())[:10]]
    drawn = time.perf_counter()
    for stack in stacks:
        estimate_sensor_noise(stack, threads=1)
    done = time.perf_counter()
    each = f"{(drawn - start) / len(stacks):.3f} s, measured by one thread in {(done - drawn) / len(stacks):.3f} s"
    print(f"one burst: simulated in {each}")
    seconds = {1: 0.0, 2: 0.0}
    for workers in (1, 2, 2, 1):
        seconds[workers] += measured(some, workers)[1] / 2
    times = f"one worker {seconds[1]:.1f} s, two {seconds[2]:.1f} s"
    print(f"{len(some)} bursts: {times}, {seconds[1] / seconds[2]:.2f} times as fast")


def chance_to_see(errors, at, change, threshold):
    """Returns the probability that a step is detected at its place, if the errors are right [1]."""
    weights = errors**-2.0
    z = change / math.sqrt(1 / weights[:at].sum() + 1 / weights[at:].sum())
    return NormalDist().cdf(abs(z) - threshold)


def evaluate(quantity, cameras, table, sessions, rate):
    """Returns the results of find_steps() for a quantity of all cameras, by the names of print_row()."""
    value, error = (table[name].to_numpy().reshape(len(cameras), sessions) for name in COLUMNS[quantity])
    counts = Counter()
    for values, errors, (parameters, step) in zip(value, error, cameras, strict=True):
        determined = np.isfinite(values)
        if not determined.any():
            continue
        seen = find_steps(values, errors, rate)
        if step is None or step[0] != quantity:
            mean = np.average(values[determined], weights=errors[determined] ** -2.0)
            counts["squares"] += (((values - mean) / errors)[determined] ** 2).sum()
            counts["freedom"] += determined.sum() - 1
            counts["false"] += len(seen)
            continue
        _, at, change = step
        before, after = determined[:at].sum(), determined[at:].sum()
        hits = [each for each in seen if abs(each.at - at) <= 1 and each.change * change > 0]
        counts["steps"] += 1
        if before and after:
            threshold = NormalDist().inv_cdf(1 - rate / 2)
            counts["expected"] += chance_to_see(errors[determined], before, parameters[quantity] * change, threshold)
        counts["found"] += bool(hits)
        counts["exact"] += any(each.at == at for each in hits)
        counts["false"] += len(seen) - bool(hits)
    return {**counts, "error": np.nanmedian(error / value), "allowed": rate * len(cameras) * (sessions - 1)}


def print_row(quantity, row):
    scatter = f"{math.sqrt(row['squares'] / row['freedom']):.3f} ± {1 / math.sqrt(2 * row['freedom']):.3f}"
    steps = f"{row.get('steps', 0):>7}{row.get('expected', 0):>10.1f}{row.get('found', 0):>7}{row.get('exact', 0):>7}"
    print(f"{quantity:<11}{row['error']:>9.3%}{scatter:>17}{steps}{row.get('false', 0):>7}{row['allowed']:>9.2f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cameras", type=int, default=100)
    parser.add_argument("--sessions", type=int, default=12, help="of each camera, 4 or more")
    parser.add_argument("--size", type=int, default=256, help="width and height of the frames [pixel]")
    parser.add_argument("--frames", type=int, default=70, help="of each burst")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--timed", type=int, default=0, help="bursts whose time is taken with one worker and two")
    parser.add_argument("--false-alarms", type=float, default=0.001, help="of a camera and session, all quantities")
    parser.add_argument("--output", help="file of the reports, .jsonl or .parquet")
    options = parser.parse_args()

    cameras = cameras_of(options.cameras, options.sessions)
    sources = sources_of(cameras, options)
    if options.timed:
        print_times(sources, options.timed)
    table, seconds = measured(sources, options.workers, options.output)
    bursts = f"{len(sources)} bursts of {options.frames} frames of {options.size} x {options.size} pixels"
    bad = (table["status"] != "measured").sum()
    print(f"{bursts}, {options.workers} workers: {seconds:.0f} s; {bad} without a report")

    rate = options.false_alarms / len(COLUMNS)
    print(f"steps of {STEP:.1%}, of one kind in every second camera; a false alarm in {1 / rate:,.0f} places each")
    print("                error  scatter/error  steps  expected  found  at it  false  allowed")
    for quantity in COLUMNS:
        print_row(quantity, evaluate(quantity, cameras, table, options.sessions, rate))


if __name__ == "__main__":
    main()
