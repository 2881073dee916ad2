# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Compares the vibration from a mosaic with the truth, for each channel and for all four channels together.

The mosaics are simulated: cameras A, B and C, conditions 1 to 3, a chart and a texture. One line per stack is printed.
The last lines give the rms error of the standard deviations, and how many of their 95 % intervals contain the truth. It
takes two minutes.
"""

import argparse
import itertools
import math
from typing import Any

import itk


def deviations(quantity: dict[str, Any], truth: float) -> tuple[float, float] | None:
    """Returns the error of the quantity, relative to the truth and in its standard errors; None: it has no value."""
    if quantity["value"] is None:
        return None
    difference = quantity["value"] - truth
    return difference / truth, difference / quantity["standard_error"]


def describe(name: str, found: list[tuple[float, float]]) -> str:
    rms = math.sqrt(sum(relative**2 for relative, _ in found) / len(found))
    held = sum(abs(errors) < 1.96 for _, errors in found)
    return f"{name}: {100 * rms:.1f} % off (rms), {held} of {len(found)} intervals hold"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=2, help="stacks of each camera, condition and scene (2)")
    parser.add_argument("--size", type=int, default=512, help="width and height of the mosaics [pixels] (512)")
    parser.add_argument("--frames", type=int, default=100, help="frames of a stack (100)")
    arguments = parser.parse_args()
    joint: list[tuple[float, float]] = []
    planes: list[tuple[float, float]] = []
    for scene, camera, condition in itertools.product(("target", "texture"), "ABC", (1, 2, 3)):
        for seed in range(1, arguments.seeds + 1):
            stack, truth = itk.simulate_sensor_noise(
                camera, condition, arguments.frames, (arguments.size,) * 2, scene, seed, bayer="RGGB"
            )
            reports = itk.estimate_sensor_noise(stack, bayer="RGGB")
            line = f"{scene:8}{camera}{condition} seed {seed}"
            for axis, sd in zip("xy", truth["realised_vibration_sd"], strict=True):
                name = f"sd_{axis}"
                of_all = (reports["joint_vibration"] or {}).get(name)
                found = deviations(of_all, sd / 2) if of_all else None  # in pixels of a channel
                if found:
                    joint.append(found)
                    line += f"   {name} {100 * found[0]:+6.2f} %, {found[1]:+5.2f} errors"
                of_planes = [deviations(channel["vibration"][name], sd / 2) for channel in reports["channels"]]
                planes += [found for found in of_planes if found]
            print(line, flush=True)
    print(describe("one plane", planes))
    print(describe("all planes together", joint))


if __name__ == "__main__":
    main()
