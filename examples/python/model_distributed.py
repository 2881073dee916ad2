# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Computes the time of a cluster from the time of its steps on one thread: see documentation/distributed.md."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

import itk
import numpy as np
from itk_sensornoise import SensorNoiseSums

FAN = 8  # number of sums that a task merges
LINK = 10e9 / 8  # network bandwidth of each worker [byte/s]
SAMPLE = 32 << 20  # largest noise sample of pass 3 [byte]
READ = LINK  # frames are read over the same link [byte/s]


@dataclass
class Steps:
    """Time and size of the steps of each pass, on one thread."""

    pixels: int
    add: list[float]  # time of a frame [s]
    merge: list[float]  # time to send and merge the sums of a part, independent of their size [s]
    merge_byte: list[float]  # additional time of each byte [s]
    end: list[tuple[float, float]]  # time of the end of a pass [s], and additional time of each frame [s]
    fixed: list[float]  # size of the sums of a part, independent of its frames [byte]
    per_frame: list[float]  # additional size of each frame [byte]; in pass 3, of each sampled frame

    def bytes_of(self, number: int, frames: float) -> float:
        """Returns the size of the sums over this number of frames [byte]."""
        of_frames = self.per_frame[number] * frames
        return self.fixed[number] + (min(of_frames, SAMPLE) if number == 2 else of_frames)


def measure_steps(size: int, frames: int) -> Steps:
    """Measures the steps with simulated frames in memory, which are read by copying."""
    stack = itk.simulate_sensor_noise(camera="B", condition=3, frames=frames, size=(size, size), seed=1)[0]
    one, two = (SensorNoiseSums(stack.shape, stack.dtype, bayer="none", threads=1) for _ in range(2))
    steps = Steps(size * size, [], [], [], [], [], [])
    merges = []
    half = frames // 2
    while not one.is_done:
        steps.add.append(_seconds(lambda: one.add(stack[:half])) / half)
        two.add(stack[half : half + 1], half)
        least = len(two.to_bytes())
        two.add(stack[half + 1 :], half + 1)
        most = len(two.to_bytes())
        merges.append((_seconds(lambda: one.merge(two)), most))
        steps.per_frame.append((most - least) / (frames - half - 1))
        steps.fixed.append(max(0.0, least - steps.per_frame[-1]))
        two.from_bytes(one.to_bytes())
        two.end_pass()
        one.end_pass()
    little = merges[1][0]  # the merge of pass 2, whose sums are small
    steps.merge = [little] * 3
    steps.merge_byte = [max(0.0, seconds - little) / count for seconds, count in merges]
    steps.merge_byte[1] = steps.merge_byte[0]
    few, many = _ends(stack[:half]), _ends(stack)
    for seconds_of_few, seconds in zip(few, many, strict=True):
        of_frame = max(0.0, (seconds - seconds_of_few) / (frames - half))
        steps.end.append((seconds - frames * of_frame, of_frame))
    return steps


def _ends(stack: np.ndarray) -> list[float]:
    """Returns the seconds of the end of each pass."""
    sums = SensorNoiseSums(stack.shape, stack.dtype, bayer="none", threads=1)
    sums.drop_history()
    found = []
    while not sums.is_done:
        sums.add(stack)
        found.append(_seconds(sums.end_pass))
    return found


def _seconds(work: Callable[[], object]) -> float:
    began = time.perf_counter()
    work()
    return time.perf_counter() - began


def seconds_of(steps: Steps, frames: int, workers: int, fan: int) -> dict[str, list[float]]:
    """Returns the seconds of the steps of each pass. A worker reads and adds at the same time; a merge waits for its
    last sums."""
    found: dict[str, list[float]] = {"read, add": [], "merge": [], "broadcast": [], "end": []}
    tasks = 2 * workers
    depth = math.ceil(math.log(tasks, fan)) if tasks > 1 else 0
    for number in range(3):
        frames_of_worker = math.ceil(frames / workers)
        found["read, add"].append(frames_of_worker * max(2.0 * steps.pixels / READ, steps.add[number]))
        waited = 0.0
        of_part = frames / tasks
        for _ in range(depth):
            bytes_of_part = steps.bytes_of(number, of_part)
            together = min(fan, tasks)
            waited += together * (steps.merge[number] + bytes_of_part * (1.0 / LINK + steps.merge_byte[number]))
            of_part = min(of_part * together, frames)
        found["merge"].append(waited)
        whole = steps.bytes_of(number, frames)
        # Workers with the sums send them on: their number doubles each time. After pass 3 only the driver gets them.
        found["broadcast"].append(whole / LINK * (math.ceil(math.log2(workers + 1)) if number < 2 else 1))
        counted = frames if number < 2 else min(frames, SAMPLE / max(1.0, steps.per_frame[number]))
        found["end"].append(steps.end[number][0] + counted * steps.end[number][1])
    return found


def print_model(steps: Steps, frames: int = 60000) -> None:
    """Prints the steps, 64 workers in detail, and other numbers of workers."""
    print(f"frames of {steps.pixels / 1e6:.1f} Mpx, one thread: pass 1, 2, 3")
    for name, values, unit in [
        ("add a frame", [1e3 * value for value in steps.add], "ms"),
        ("merge", [1e3 * value for value in steps.merge], "ms"),
        ("and a GB", [1e9 * value for value in steps.merge_byte], "s"),
        ("end", [1e3 * value for value, _ in steps.end], "ms"),
        ("and a frame", [1e3 * value for _, value in steps.end], "ms"),
        ("sums of a part", [value / 1e6 for value in steps.fixed], "MB"),
        ("and of a frame", [value / 1e3 for value in steps.per_frame], "kB"),
    ]:
        print(f"  {name:15} " + "  ".join(f"{value:8.1f}" for value in values) + f"  {unit}")
    print(f"{frames} frames, 64 workers of one thread, 10 Gbit/s: seconds of pass 1, 2, 3")
    for fan, name in [(FAN, "merged by tasks, eight at a time"), (2 * 64, "merged in one place")]:
        print(f"  {name}")
        found = seconds_of(steps, frames, 64, fan)
        for step, values in found.items():
            print(f"    {step:10} " + "  ".join(f"{value:7.1f}" for value in values))
        print(f"    in all     {sum(map(sum, found.values())):7.1f}")
    print("workers, seconds, times as fast as one")
    alone = sum(map(sum, seconds_of(steps, frames, 1, FAN).values()))
    for workers in (1, 4, 16, 64, 128, 256, 512, 1024):
        seconds = sum(map(sum, seconds_of(steps, frames, workers, FAN).values()))
        print(f"  {workers:5} {seconds:9.1f} {alone / seconds:7.1f}")
