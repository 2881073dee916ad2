# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the time and the gain of programs of other authors and of this project on the same simulated frames.

Each program runs in a separate environment, in turn with the others, round by round. A function is called in a process
that holds the frames. A whole program also reads the frames, from one .npy file. The tool of this project reads them
from 100 TIFFs or from one .mha file.
"""

import json
import subprocess
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np

FRAMES = 100

# Each of these programs defines run(), which returns the gain [DN/e-].
LINE = """
def gain_of(mean, variance):
    return np.polyfit(np.ravel(mean), np.ravel(variance), 1)[0]
"""
NUMPY = """
def run():
    return frames.mean(axis=0), frames.var(axis=0, ddof=1)
"""
OPENCV = """
import cv2
def run():
    total, squares = np.zeros(frames.shape[1:]), np.zeros(frames.shape[1:])
    for frame in frames:
        cv2.accumulate(frame, total)
        cv2.accumulateSquare(frame, squares)
    mean = total / len(frames)
    return mean, (squares - total * mean) / (len(frames) - 1)
"""
STATISTICS = """
import itk
def run():
    return [np.asarray(image) for image in itk.temporal_statistics_image_filter(frames)[:2]]
"""
ESTIMATE = """
import itk
def run():
    return itk.estimate_sensor_noise(frames, method=METHOD)["gain"]["value"]
"""
SERVER = """
import sys, time
import numpy as np
frames = np.load(sys.argv[1])
{program}
{line}
run()  # what is loaded at the first call
print("ready", flush=True)
for _ in sys.stdin:
    start = time.perf_counter()
    found = run()
    seconds = time.perf_counter() - start
    print(seconds, found if np.isscalar(found) else gain_of(*found), flush=True)
"""

ANSCOMBE_TRANSFORM = """
import sys
import numpy as np
from anscombe_transform.estimate import compute_conversion_gain
print(compute_conversion_gain(np.load(sys.argv[1]))["conversion_gain"])
"""
NANOIMAGINGPACK = """
import sys
import numpy as np
import NanoImagingPack as nip
print("gain", 1 / nip.cal_readnoise(np.load(sys.argv[1]), np.load(sys.argv[2]), doPlot=False)[1])
"""


class Found(NamedTuple):
    """Seconds of a program in each round, and the gain that it found in the last round [DN/e-]."""

    name: str
    seconds: list[float]
    gain: float


class Server:
    """Process that holds the frames and calls a function on request."""

    def __init__(self, name, python, program, data):
        self.found = Found(name, [], np.nan)
        code = SERVER.format(program=program, line=LINE)
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
        self.process = subprocess.Popen([python, "-c", code, data], **pipes)
        self.answer("ready")

    def answer(self, start=""):
        line = self.process.stdout.readline()
        while line and not line.startswith(start):
            line = self.process.stdout.readline()
        if not line:
            raise RuntimeError(f"{self.found.name}: ended with exit code {self.process.wait()}; expected an answer")
        return line.split()

    def call(self):
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        seconds, gain = (float(word) for word in self.answer())
        self.found.seconds.append(seconds)
        self.found = self.found._replace(gain=gain)

    def end(self):
        self.process.stdin.close()
        self.process.wait()


class Process:
    """Command that runs as a whole. The gain is in its report, or without a report the last word that it prints."""

    def __init__(self, name, command, report=None):
        self.found = Found(name, [], np.nan)
        self.command, self.report = command, report

    def call(self):
        start = time.perf_counter()
        done = subprocess.run(self.command, check=True, capture_output=True, text=True)
        self.found.seconds.append(time.perf_counter() - start)
        gain = json.loads(self.report.read_text())["gain"]["value"] if self.report else done.stdout.split()[-1]
        self.found = self.found._replace(gain=float(gain))

    def end(self):
        pass


def simulated(folder, tools, size):
    """Makes frames under flickering illumination, and dark frames. Returns their .npy files, the .mha file, the TIFFs
    and the gain."""
    import itk

    made = []
    for name, options in (("frames", ["--frames", str(FRAMES)]), ("dark", ["--frames", "20", "--dark", "--seed", "2"])):
        stack = folder / f"{name}.mha"
        truth = folder / f"{name}.json"
        command = [tools / "simulate-sensor-noise", "--size", size, *options, "--output", stack, "--truth", truth]
        subprocess.run(command, check=True, capture_output=True)
        np.save(folder / f"{name}.npy", itk.array_from_image(itk.imread(stack)))
        made.append(folder / f"{name}.npy")
    tiffs = []
    for index, frame in enumerate(np.load(made[0])):
        tiffs.append(folder / f"{index:03}.tif")
        itk.imwrite(itk.image_view_from_array(frame), tiffs[-1])
    return made, folder / "frames.mha", tiffs, json.loads((folder / "frames.json").read_text())["gain"]


def measure_programs(tools, pythons, size, rounds, folder):
    """Returns the true gain, and time and gain of each program. `pythons` are interpreters by program name."""
    folder = Path(folder)
    (frames, dark), stack, tiffs, truth = simulated(folder, Path(tools), size)
    tool = Path(tools, "estimate-sensor-noise")
    report = folder / "report.json"
    ours = pythons["itk-sensornoise"]
    every = [
        Server("estimate, refined", ours, ESTIMATE.replace("METHOD", '"refined"'), frames),
        Server("estimate, published", ours, ESTIMATE.replace("METHOD", '"published"'), frames),
        Server("temporal statistics", ours, STATISTICS, frames),
        Server("NumPy mean + var", pythons["numpy"], NUMPY, frames),
        Process("tool, refined, 100 TIFFs", [tool, "--quiet", "--json", report, *tiffs], report),
        Process("tool, refined, one .mha", [tool, "--quiet", "--json", report, stack], report),
    ]
    if python := pythons.get("opencv"):
        every.insert(4, Server("OpenCV accumulate + Square", python, OPENCV, frames))
    if python := pythons.get("anscombe-transform"):
        every.append(Process("anscombe-transform", [python, "-c", ANSCOMBE_TRANSFORM, frames]))
    if python := pythons.get("nanoimagingpack"):
        every.append(Process("NanoImagingPack, 20 dark", [python, "-c", NANOIMAGINGPACK, frames, dark]))
    for _ in range(rounds):
        for program in every:
            program.call()
    for program in every:
        program.end()
    return truth, [program.found for program in every]
