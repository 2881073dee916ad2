#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures how well `estimate-sensor-noise --method emva1288` finds the parameters of simulated cameras.

    measure_emva1288.py --bin build/bin [--cameras 200] [--size 256]

Each camera has a random gain, read noise, photo-response non-uniformity (PRNU) and dark-signal non-uniformity (DSNU).
It records a flat field at 50 exposures from 0 to 110 % of the range of 12 bits, with two frames each, and 30 frames
more in the dark and at 50 %. The illumination varies by 0.02 % from frame to frame. The program prints the root mean
square (rms) of the relative errors, with the largest rms that is allowed, and how many of the 95 % intervals hold the
truth. The exit code is 1 if an rms is too large. 200 cameras take some ten minutes. Needs Python alone.
"""

import argparse
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

EXPOSURES, LONG_FRAMES = 50, 30
HIGHEST_DN, OFFSET_DN = 4095, 100
FLICKER = 0.0002  # standard deviation of the illumination from frame to frame [1]

# name: (section and name in the record, largest rms error)
TARGETS = {
    "K": (("sensitivity", "gain"), 0.01),
    "K, weighted": (("sensitivity", "weighted_gain"), 0.01),
    "sigma_d": (("sensitivity", "dark_noise"), 0.02),
    "PRNU": (("spatial", "prnu"), 0.05),
    "DSNU": (("spatial", "dsnu"), 0.05),
}
# Fraction of the standard deviation of a white pattern that the highpass filter of the standard leaves [1]. The
# intervals are compared with this pattern. The errors of PRNU and DSNU include the whole pattern.
OF_HIGHPASS = {"PRNU": 0.9942, "DSNU": 0.9942}
LINEARITY = 0.1  # largest rms of the linearity error of a linear camera [%]


def draw_camera(number):
    """Draws a camera, with all noise in the units of the record."""
    draw = random.Random(number)
    gain = math.exp(draw.uniform(math.log(0.05), math.log(2.0)))  # DN/e-
    read_noise_dn = max(0.8, gain * draw.uniform(1.5, 12.0))
    dsnu_dn = read_noise_dn * draw.uniform(0.3, 1.0)
    prnu = draw.uniform(0.003, 0.015)
    return {"gain": gain, "read_noise_dn": read_noise_dn, "dsnu_dn": dsnu_dn, "prnu": prnu}


def series():
    """Lists the exposure of each frame, relative to the full range."""
    frames = [0.0] * (2 + LONG_FRAMES)
    for level in range(1, EXPOSURES + 1):
        frames += [1.1 * level / EXPOSURES] * 2
    return [*frames, *[0.5] * LONG_FRAMES]


def measure(camera, number, binaries, folder, size):
    """Simulates and measures one camera, and returns the record."""
    frames = series()
    exposures = folder / "exposures.txt"
    exposures.write_text("\n".join(map(str, frames)) + "\n", encoding="utf-8")
    stack = folder / "stack.mha"
    electrons = (HIGHEST_DN - OFFSET_DN) / camera["gain"]
    simulate = f"--reference flat --optical-blur 0 --vibration-sd 0,0 --flicker-sd {FLICKER} --offset {OFFSET_DN}"
    simulate += f" --size {size}x{size} --frames {len(frames)} --seed {number} --electrons {electrons!r}"
    simulate += f" --gain {camera['gain']!r} --read-noise {camera['read_noise_dn']!r}"
    simulate += f" --prnu {camera['prnu']!r} --dsnu {camera['dsnu_dn']!r} --illumination {exposures} --output {stack}"
    subprocess.run([binaries / "simulate-sensor-noise", *simulate.split()], check=True, stdout=subprocess.DEVNULL)
    estimate = f"{stack} --method emva1288 --exposures {exposures} --bit-depth 12 --quiet --json -"
    found = subprocess.run([binaries / "estimate-sensor-noise", *estimate.split()], check=True, capture_output=True)
    return json.loads(found.stdout)


def truth_of(camera):
    """Returns the true value of each target, in the unit of the record."""
    electrons = camera["read_noise_dn"] / camera["gain"]
    gains = {"K": camera["gain"], "K, weighted": camera["gain"]}
    return gains | {
        "sigma_d": electrons,
        "PRNU": 100 * camera["prnu"],
        "DSNU": camera["dsnu_dn"] / camera["gain"],
    }


def rms(values):
    """Returns the root mean square."""
    return math.sqrt(sum(value * value for value in values) / len(values))


def main():
    """Measures all cameras, prints the table, and returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of the programs")
    parser.add_argument("--cameras", type=int, default=200)
    parser.add_argument("--size", type=int, default=256, help="width and height of the frames [pixel]")
    options = parser.parse_args()
    errors, held, linearity = {name: [] for name in TARGETS}, dict.fromkeys(TARGETS, 0), []
    with tempfile.TemporaryDirectory() as folder:
        for number in range(1, options.cameras + 1):
            camera = draw_camera(number)
            record = measure(camera, number, options.bin.resolve(), pathlib.Path(folder), options.size)
            linearity.append(record["linearity"]["linearity_error"]["value"])
            for name, truth in truth_of(camera).items():
                section, member = TARGETS[name][0]
                quantity = record[section][member]
                if quantity["value"] is None:
                    sys.exit(f"camera {number} {camera}: {member} is {quantity['status']}")
                errors[name].append(quantity["value"] / truth - 1)
                low, high = quantity["interval95"]
                held[name] += low <= truth * OF_HIGHPASS.get(name, 1.0) <= high
    is_right = rms(linearity) <= LINEARITY
    print(f"{options.cameras} cameras of {options.size} x {options.size} pixels")
    print("quantity        rms error   allowed    mean error   95 % intervals that hold the truth")
    for name, (_, allowed) in TARGETS.items():
        found = errors[name]
        is_right = is_right and rms(found) <= allowed
        percent = 100 * held[name] / options.cameras
        mean = 100 * sum(found) / len(found)
        print(f"{name:14} {100 * rms(found):8.3f} % {100 * allowed:8.3g} % {mean:10.3f} %   {percent:.0f} %")
    print(f"{'linearity':14} {rms(linearity):8.4f} % {LINEARITY:8.3g} %   (a linear camera has 0)")
    return 0 if is_right else 1


if __name__ == "__main__":
    sys.exit(main())
