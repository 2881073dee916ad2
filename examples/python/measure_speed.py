# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the cost of the estimates in one run: the table of documentation/performance.md.

    measure_speed.py --bin build/bin [--parts passes,threads,files,frames,programs] [--opencv VENV/bin/python] ...

Parts:
    passes     TemporalStatistics, ITK's projections, whole estimates, and a single image of 24 megapixels, in units of
               a pass that reads the stack sample by sample. SensorNoiseBenchmark measures this part and the next three
    threads    two threads against one
    files      100 TIFFs against the same frames in memory
    frames     the cost as a fixed part (in frames) and a part per sample, from 50 to 400 frames. The
               largest number of frames of 4096 x 3072 pixels, 25 MB each, is --large-frames; 0: none
    programs   programs of other authors on the same frames (speed_programs.py)

Programs that are compared run in turn. Each number is the median of the runs, followed by the lowest and the highest.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
from itertools import pairwise
from pathlib import Path

import numpy as np
from speed_programs import measure_programs

METHODS = ("Statistics", "Published", "Refined")
FILTERS = {
    "passes": "^(ReadPassAgain|TemporalStatistics|Projections|Estimate|SingleImage)/",
    "threads": "^TwoThreads/",
    "files": "^FromFiles/",
}
COUNTERS = {
    "passes": {"read_passes": "read passes"},
    "threads": {"times_faster": "times as fast", "of_read_pass": "(a read pass)"},
    "files": {"in_memory": "times the time in memory"},
}


def counters_of(program, pattern):
    """Returns the counters of the benchmarks that fit the pattern, by their names without the number of iterations."""
    command = [program, f"--benchmark_filter={pattern}", "--benchmark_format=json"]
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return {run["name"].split("/iterations")[0]: run for run in json.loads(done.stdout)["benchmarks"]}


def ends(run, name):
    return f"{run[name]:8.2f} [{run[f'{name}_min']:.2f}, {run[f'{name}_max']:.2f}]"


def print_ratios(program, part):
    for name, run in counters_of(program, FILTERS[part]).items():
        cells = [f"{ends(run, counter):<26} {unit}" for counter, unit in COUNTERS[part].items()]
        print(f"{name:<28}" + "   ".join(cells), flush=True)


def line_through(frames, cost):
    """Returns slope and fixed cost of a line through the cost over the number of frames, with equal relative errors."""
    weights = 1 / cost
    design = np.column_stack([frames, np.ones(len(frames))])
    slope, constant = np.linalg.lstsq(design * weights[:, None], np.ones(len(frames)), rcond=None)[0]
    return slope, constant / slope


def print_fits(program, large_frames):
    """Prints the fit of the cost over the number of frames, for each method and size."""
    sizes = [("1376", "1040", "400")]
    if large_frames:
        sizes.append(("4096", "3072", str(large_frames)))
    print(f"{'cost of frames, in read passes over one frame':<46}  a sample  fixed [frames]  slopes between")
    for size in sizes:
        for method in METHODS:
            pattern = "^CostOfFrames/{}/width:{}/height:{}/frames:{}/".format(method, *size)
            (run,) = counters_of(program, pattern).values()
            frames = np.array([int(size[2]) // share for share in (8, 4, 2, 1)])
            cost = np.array([run[f"frames_{count}"] for count in frames])
            slope, fixed = line_through(frames, cost)
            between = [(cost[j] - cost[i]) / (frames[j] - frames[i]) / slope for i, j in pairwise(range(4))]
            costs = " ".join(f"{count}: {value:.0f}" for count, value in zip(frames, cost, strict=True))
            row = f"{method} {size[0]} x {size[1]}"
            steps = ", ".join(f"{value:.2f}" for value in between)
            print(f"{row:<46}{slope:10.2f}{fixed:12.0f}        {steps} of it   ({costs})", flush=True)


def print_programs(options):
    pythons = {"itk-sensornoise": sys.executable, "numpy": options.numpy or sys.executable}
    for name in ("opencv", "anscombe-transform", "nanoimagingpack"):
        pythons[name] = getattr(options, name.replace("-", "_"))
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        truth, found = measure_programs(options.bin, pythons, options.size, options.rounds, folder)
    ours = np.array(found[0].seconds)
    print(f"{'program':<30}{'seconds':>22}{'of our refined estimate':>30}   gain (truth {truth:g} DN/e-)")
    for program in found:
        seconds = np.array(program.seconds)
        ratios = seconds / ours
        times = f"{statistics.median(seconds):.2f} [{seconds.min():.2f}, {seconds.max():.2f}]"
        of_ours = f"{statistics.median(ratios):.2f} [{ratios.min():.2f}, {ratios.max():.2f}]"
        print(f"{program.name:<30}{times:>22}{of_ours:>30}   {program.gain:.4f}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bin", default="build/bin", help="folder of SensorNoiseBenchmark and the tools")
    parser.add_argument("--parts", default="passes,threads,files,frames,programs")
    parser.add_argument("--large-frames", type=int, choices=(0, 200, 400), default=200, help="400: 10 GB of frames")
    parser.add_argument("--numpy", help="Python of an environment with NumPy (default: the Python of this program)")
    parser.add_argument("--opencv", help="Python of an environment with opencv-python-headless")
    parser.add_argument("--anscombe-transform", help="Python of an environment with anscombe-transform")
    parser.add_argument("--nanoimagingpack", help="Python of an environment with NanoImagingPack")
    parser.add_argument("--size", default="1376x1040", help="of the frames of the programs")
    parser.add_argument("--rounds", type=int, default=5, help="of the programs")
    parser.add_argument("--folder", help="for the simulated frames, 1 GB (default: the folder of temporary files)")
    options = parser.parse_args()

    parts = options.parts.split(",")
    for part in parts:
        if part not in (*FILTERS, "frames", "programs"):
            parser.error(f"--parts has {part!r}; expected some of passes, threads, files, frames, programs")
    benchmark = Path(options.bin, "SensorNoiseBenchmark")
    for part in parts:
        print(f"\n{part}")
        if part == "frames":
            print_fits(benchmark, options.large_frames)
        elif part == "programs":
            print_programs(options)
        else:
            print_ratios(benchmark, part)


if __name__ == "__main__":
    main()
