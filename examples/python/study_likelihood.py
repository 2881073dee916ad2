# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Compares one likelihood of the variances of the pixels with the refined method, on the same simulated bursts.

    python examples/python/study_likelihood.py --bin build/bin --seeds 10

A row is a situation and a method. Its columns are the rms error of gain [%], intercept [DN^2] and offset [DN]. It also
has the number of bursts whose 95 % interval contains the truth, out of the bursts that have a value, and the terms of
the variance besides constant and level, with their numbers of bursts. The method `refined` is estimate-sensor-noise.
The methods `projected` and `variance` are one_likelihood.py with the motion and local illumination removed from each
pixel, or left to terms of the variance. It needs NumPy and SciPy.
"""

import argparse
import json
import os
import subprocess
import tempfile
from collections import Counter
from pathlib import Path
from typing import NamedTuple

import numpy as np
import situations as camera
from acceptance_stacks import holds, is_identified
from frame_stacks import read_frames, write_stack
from one_likelihood import estimate
from situations_dark import dark_scene, disc
from situations_good import shifted
from situations_parts import stereo
from situations_shared import filtered

HIGHEST = 4095  # limit of 12 bits; no burst of 16 bits comes near its limit [DN]
QUANTITIES = ("gain", "intercept", "offset")
NORMAL95 = 1.96  # half width of a 95 % interval of a normal error [standard errors]
METHODS = ("refined", "projected", "variance")


class Found(NamedTuple):
    """Error of a quantity, and whether its interval contains the truth."""

    error: float
    is_held: bool


def exposed(random, expected, **truth):
    """Returns a burst of the expected electrons (t, y, x)."""
    frames = np.concatenate([camera.expose(random, one, [1.0]) for one in expected])
    return camera.Burst(
        camera.digitise(frames), **({"offset": camera.OFFSET[12], "read_noise": camera.READ_NOISE} | truth)
    )


def plain(scene, flicker=camera.FLICKER):
    def make(random):
        electrons = camera.electrons_of(scene, random)
        return exposed(random, camera.illumination(random, flicker=flicker)[:, None, None] * electrons)

    return make


def strong_flicker(random):
    factors = random.uniform(0.3, 1.3, camera.FRAMES)
    return exposed(random, factors[:, None, None] * camera.electrons_of("texture", random))


def vibrating(scene, rms):
    """Motion of this rms along both axes [pixels], of a scene that is continued periodically."""

    def make(random):
        electrons = camera.electrons_of(scene, random)
        moves = rms * random.normal(size=(camera.FRAMES, 2))
        factors = camera.illumination(random)
        return exposed(random, [f * np.maximum(shifted(electrons, *m), 0) for f, m in zip(factors, moves, strict=True)])

    return make


def telegraph(random):
    """2 % of the pixels switch at random between two levels, whose distance is 0 to 40 DN."""
    electrons = camera.electrons_of("patches", random)
    frames = camera.expose(random, electrons, camera.illumination(random))
    jumps = random.uniform(0.0, 40.0, camera.SHAPE) * (random.random(camera.SHAPE) < 0.02)
    frames += jumps * (random.random(frames.shape) < 0.5)
    noise = np.sqrt(camera.READ_NOISE**2 + (jumps**2).mean() / 4)
    offset = camera.OFFSET[12] + jumps.mean() / 2
    return camera.Burst(camera.digitise(frames), offset=offset, read_noise=noise)


def object_crosses(random):
    """An object of 30 x 30 pixels, 2 % of the frame, is at another place of a strip in each frame."""
    electrons = camera.electrons_of("texture", random)
    expected = camera.illumination(random)[:, None, None] * electrons
    for t in range(camera.FRAMES):
        y, x = 80 + random.integers(10), random.integers(20, 40)
        expected[t, y : y + 30, x : x + 30] = 0.6 * camera.ELECTRONS
    return exposed(random, expected)


def two_lamps(random):
    """A second light source illuminates one side of the scene and changes by 3 %, independently of the first one."""
    electrons = camera.electrons_of("texture", random)
    side = np.linspace(0, 1, camera.SHAPE[1])
    first, second = camera.illumination(random), camera.illumination(random, flicker=0.03)
    return exposed(random, (first[:, None, None] * (1 - side) + second[:, None, None] * side) * electrons)


def gain_pattern(random):
    """Pixels whose gains differ by 1.5 %, on patches of 70 to 100 % of the signal."""
    electrons = camera.ELECTRONS * camera.scaled(camera.patches(random), 0.7, 1.0)
    gain = camera.GAIN * (1 + 0.015 * random.normal(size=camera.SHAPE))
    frames = camera.expose(random, electrons, camera.illumination(random), gain=gain)
    return camera.Burst(camera.digitise(frames), offset=camera.OFFSET[12], read_noise=camera.READ_NOISE)


def non_linear(random):
    """The local gain falls by 8 % from the dark to the brightest level. The true gain is the mean over the pixels."""
    electrons = camera.electrons_of("texture", random)
    signal = camera.expose(random, electrons, camera.illumination(random), offset=0.0, read_noise=0.0)
    curvature = 0.04 / (camera.GAIN * camera.ELECTRONS)
    frames = signal - curvature * signal**2 + camera.OFFSET[12] + camera.READ_NOISE * random.normal(size=signal.shape)
    gain = camera.GAIN * (1 - 2 * curvature * camera.GAIN * electrons.mean())
    return camera.Burst(camera.digitise(frames), gain=gain)


def simulated(program, *options):
    """Returns a function that makes bursts with simulate-sensor-noise."""

    def make(random):
        with tempfile.TemporaryDirectory() as folder:
            stack, truth = Path(folder, "burst.mha"), Path(folder, "truth.json")
            given = ["--size", "256x256", "--frames", str(camera.FRAMES), "--seed", str(random.integers(1, 2**31))]
            command = [program, "--output", stack, "--truth", truth, *given, *options]
            subprocess.run(list(map(str, command)), check=True, capture_output=True)
            values = json.loads(truth.read_text(encoding="utf-8"))
            frames = read_frames(stack)[0]
        noise = values["read_noise"]
        return camera.Burst(frames, gain=values["gain"], offset=values["offset"], read_noise=noise)

    return make


def situations(folder):
    """Returns the functions that make the bursts, by the name of the situation."""
    simulator = folder / "simulate-sensor-noise"
    return {
        "target": simulated(simulator, "--reference", "target"),
        "patches": plain("patches"),
        "texture": plain("texture"),
        "vibration 0.1, texture": vibrating("texture", 0.1),
        "vibration 0.1, patches": vibrating("patches", 0.1),
        "strong flicker": strong_flicker,
        "mostly dark": lambda random: dark_scene(random, disc(random, 0.04), 0.0),
        "hot pixels": simulated(simulator, "--reference", "target", "--hot-pixels", "0.01,10"),
        "telegraph pixels": telegraph,
        "moving object": object_crosses,
        "two lamps": two_lamps,
        "unlike parts": lambda random: stereo(random, camera.electrons_of("texture", random), 0.1),
        "gain pattern": gain_pattern,
        "smoothed": lambda random: filtered(random, camera.electrons_of("texture", random), 0.6, 0.0),
        "non-linear": non_linear,
    }


def truth_of(burst):
    """Returns the true values of the quantities that the situation defines."""
    truth = {"gain": burst.gain, "offset": burst.offset}
    if None not in (burst.gain, burst.offset, burst.read_noise):
        truth["intercept"] = burst.read_noise**2 - burst.gain * burst.offset
    return {name: value for name, value in truth.items() if value is not None}


def by_refined(program, burst, truth):
    with tempfile.TemporaryDirectory() as folder:
        stack = Path(folder, "burst.mha")
        write_stack(stack, burst.frames)
        command = [program, stack, "--quiet", "--threads", "1", "--json", "-"]
        done = subprocess.run(list(map(str, command)), capture_output=True, check=False)
    report = json.loads(done.stdout)
    found = {}
    for name, value in truth.items():
        quantity = report[name] or {}
        if is_identified(quantity):
            found[name] = Found(quantity["value"] - value, holds(quantity["interval95"], value))
    return found, ()


def by_likelihood(motion, burst, truth):
    bits = HIGHEST if burst.frames.max() <= HIGHEST else 16 * HIGHEST
    estimates = estimate(burst.frames, motion, bits)
    found = {}
    for name, value in truth.items():
        measured, error = getattr(estimates, name)
        if np.isfinite(error):
            found[name] = Found(measured - value, abs(measured - value) <= NORMAL95 * error)
    return found, estimates.terms


def is_moving(situation):
    """Returns whether the situation has motion or local illumination, where the two models differ."""
    return "vibration" in situation or "lamps" in situation


def print_row(situation, method, results, truths):
    cells = []
    for name in QUANTITIES:
        found = [one[0][name] for one in results if name in one[0]]
        scale = 100 / truths[0]["gain"] if name == "gain" else 1.0
        if name not in truths[0]:
            cells.append(f"{'-':>7} {'-':>5} |")
            continue
        rms = scale * np.sqrt(np.mean([one.error**2 for one in found])) if found else np.nan
        held = sum(one.is_held for one in found)
        cells.append(f"{rms:7.3g} {f'{held}/{len(found)}':>5} |")
    terms = Counter(term for one in results for term in one[1])
    listed = ", ".join(f"{name} {count}" for name, count in sorted(terms.items()))
    print(f"{situation:<23} {method:<10}| {' '.join(cells)} {listed}".rstrip(), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, required=True, help="folder of the built programs")
    parser.add_argument("--seeds", type=int, default=10, help="bursts of each situation (10)")
    parser.add_argument("--only", default="", help="situations whose name contains this text")
    options = parser.parse_args()
    header = " ".join(f"{name + ' rms':>7} held |" for name in ("g %", "c", "mu"))
    print(f"{'situation':<23} {'method':<10}| {header} terms")
    for number, (name, make) in enumerate(situations(options.bin).items()):
        if options.only not in name:
            continue
        results, truths = {method: [] for method in METHODS}, []
        for seed in range(options.seeds):
            burst = make(np.random.default_rng([seed, number]))
            truths.append(truth_of(burst))
            results["refined"].append(by_refined(options.bin / "estimate-sensor-noise", burst, truths[-1]))
            for motion in METHODS[1 : 3 if is_moving(name) else 2]:
                results[motion].append(by_likelihood(motion, burst, truths[-1]))
        for method, found in results.items():
            if found:
                print_row(name, method, found, truths)


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    main()
