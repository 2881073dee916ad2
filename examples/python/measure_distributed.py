#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures time, memory and bytes of itk_sensornoise.distributed.estimate_sensor_noise() and of one process.

    measure_distributed.py --size 2048 --frames 400 --workers 2 --repeat 3

Simulated frames (camera B, condition 3) are written to files, one frame per file. They are measured in turn by one
process with as many threads as there are workers, and by workers of one thread each. Each measurement has a fresh
interpreter, so that the peak memory is its own. The start of the cluster is not counted. --model computes the time of a
cluster of 64 workers from the measured time of a frame, a merge and the end of a pass, see
documentation/distributed.md.
"""

import argparse
import json
import logging
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import itk

MIB = 1 << 20


def peak_mib(line_of: str = "VmHWM") -> float:
    """Returns the peak memory of this process, or with "VmRSS" its present memory [MiB]."""
    lines = Path("/proc/self/status").read_text(encoding="utf-8").splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(line_of)) / 1024


def run_one(names: list[str], threads: int) -> dict[str, object]:
    """Measures the frames in one process."""
    began = time.perf_counter()
    report = itk.estimate_sensor_noise(names, threads=threads, bayer="none")
    return {"seconds": time.perf_counter() - began, "peak_mib": peak_mib(), "report": report.to_json()}


class Rounds(logging.Handler):
    """Handler that keeps the log records of the rounds of a run."""

    def __init__(self) -> None:
        super().__init__()
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.lines.append(record.getMessage())


def run_workers(names: list[str], workers: int, memory_limit: str) -> dict[str, object]:
    """Measures the frames with workers of one thread each."""
    from distributed import Client, LocalCluster
    from itk_sensornoise.distributed import estimate_sensor_noise

    rounds = Rounds()
    log = logging.getLogger("itk_sensornoise.distributed")
    log.setLevel(logging.INFO)
    log.addHandler(rounds)
    options = {"threads_per_worker": 1, "dashboard_address": None, "memory_limit": memory_limit}
    with LocalCluster(n_workers=workers, **options) as cluster, Client(cluster) as client:
        client.run(load)
        before = max(client.run(peak_mib, "VmRSS").values())
        began = time.perf_counter()
        report = estimate_sensor_noise(names, client, bayer="none")
        seconds = time.perf_counter() - began
        peaks = list(client.run(peak_mib).values())
    return {
        "seconds": seconds,
        "peak_mib": peak_mib(),
        "before_mib": before,
        "workers_mib": peaks,
        "rounds": rounds.lines,
        "report": report.to_json(),
    }


def load() -> None:
    """Loads the module of ITK on a worker, once. A module that arrives with a function is not loaded."""
    import itk

    itk.SensorNoiseSums[itk.Image[itk.US, 3]].New()


def in_fresh_process(names: list[str], *arguments: object) -> dict[str, object]:
    """Returns the result of run_one() or run_workers() in a fresh interpreter."""
    command = [sys.executable, __file__, "--child", *map(str, arguments)]
    done = subprocess.run(command, input=json.dumps(names), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}:\n{done.stderr}")
    found: dict[str, object] = json.loads(done.stdout.splitlines()[-1])
    return found


def write_frames(folder: str, size: int, frames: int, pixels: str) -> list[str]:
    """Writes simulated frames to files. Returns the file names."""
    stack = itk.simulate_sensor_noise(camera="B", condition=3, frames=frames, size=(size, size), seed=1)[0]
    names = [f"{folder}/{number:05}.mha" for number in range(frames)]
    for name, frame in zip(names, stack, strict=True):
        itk.imwrite(itk.image_view_from_array(frame.astype(pixels)), name)
    return names


def compare(names: list[str], workers: int, repeat: int, memory_limit: str) -> None:
    """Runs both measurements in turn, and prints their results."""
    ratios = []
    for turn in range(repeat):
        one = in_fresh_process(names, "one", workers)
        many = in_fresh_process(names, "workers", workers, memory_limit)
        ratios.append(one["seconds"] / many["seconds"])
        same = "the same bits" if one["report"] == many["report"] else "OTHER BITS"
        print(f"turn {turn}: one process, {workers} threads {one['seconds']:.2f} s, {one['peak_mib']:.0f} MiB")
        print(f"        {workers} workers {many['seconds']:.2f} s, ratio {ratios[-1]:.2f}, {same}")
        peaks = ", ".join(f"{peak:.0f}" for peak in many["workers_mib"])
        before = f"{many['before_mib']:.0f} before they began"
        print(f"        peaks: driver {many['peak_mib']:.0f} MiB, workers {peaks} MiB ({before})")
        for line in many["rounds"]:
            print(f"        {line}")
    print(f"one process over {workers} workers: {min(ratios):.2f} to {max(ratios):.2f}")


def main() -> int:
    """Returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=2048, help="rows and columns of a frame [pixel]")
    parser.add_argument("--frames", type=int, default=400)
    parser.add_argument("--pixels", default="uint16", choices=["uint16", "float32"], help="type of the pixels")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--memory-limit", default="auto", help="of a worker, as Dask has it: 4GiB")
    parser.add_argument("--folder", help="for the files, which are removed at the end (default: a temporary one)")
    parser.add_argument("--model", action="store_true", help="reckon a cluster instead of comparing")
    parser.add_argument("--child", nargs="+", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        names = json.load(sys.stdin)
        kind, count, *rest = options.child
        found = run_one(names, int(count)) if kind == "one" else run_workers(names, int(count), *rest)
        print(json.dumps(found))
        return 0
    if options.model:
        from model_distributed import measure_steps, print_model

        print_model(measure_steps(options.size, min(options.frames, 64)))
        return 0
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        names = write_frames(folder, options.size, options.frames, options.pixels)
        compare(names, options.workers, options.repeat, options.memory_limit)
    return 0


if __name__ == "__main__":
    sys.exit(main())
