# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Counts the simulated cameras whose switch of the conversion gain is found, and those without one where one is found.

    python examples/python/study_switch.py [--cameras 100]

A camera has 8 ISO speeds. Its gain is 0.002 DN/e- times the ISO speed, and its read noise 2 e- before the amplifier and
600 e- over the ISO speed behind it. Gains and read noises have normal errors of 0.4 % and 1.5 %, as a burst with
dark frames; no burst is simulated. It takes a few seconds. study_sweep.py does the same on simulated bursts.

Prints how often a switch is found, and how often at its place: without a switch, for a switch between ISO 400 and 800
that halves the noise before the amplifier, and for switches behind the second setting, where the noise behind the
amplifier dominates.
"""

import argparse
import json
import math

import itk
import numpy as np

ISO_SPEEDS = (100, 200, 400, 800, 1600, 3200, 6400, 12800)
GAIN_PER_ISO = 0.002  # [DN/e-]
PIXEL_NOISE = 2.0  # before the amplifier [e-]
AMPLIFIER_NOISE = 600.0  # noise behind the amplifier [e-], times the ISO speed
GAIN_ERROR, READ_NOISE_ERROR = 0.004, 0.015  # relative
# name, last setting before the switch, factor of the noise before the amplifier behind the switch
CASES = (
    ("no switch", None, 1.0),
    ("half of the noise behind ISO 400", 400, 0.5),
    ("half of the noise behind ISO 200", 200, 0.5),
    ("0.3 of the noise behind ISO 200", 200, 0.3),
)


def summarise(random: np.random.Generator, below: float | None, drop: float) -> dict:
    """Returns the summary of a camera with random errors."""
    sweep = itk.SensorNoiseSweep.New()
    for iso in ISO_SPEEDS:
        pixel = PIXEL_NOISE * (drop if below is not None and iso > below else 1.0)
        gain = GAIN_PER_ISO * iso * (1 + GAIN_ERROR * random.standard_normal())
        electrons = math.hypot(pixel, AMPLIFIER_NOISE / iso)
        noise = electrons * (1 + READ_NOISE_ERROR * random.standard_normal())
        sweep.SetText("/schema", "itk-sensornoise-report/1")
        for name, value, error in (
            ("gain", gain, GAIN_ERROR * gain),
            ("read_noise", noise * gain, READ_NOISE_ERROR * noise * gain),
            ("read_noise_electrons", noise, READ_NOISE_ERROR * noise),
        ):
            sweep.SetText(f"/{name}/status", "identified")
            sweep.SetNumber(f"/{name}/value", value)
            sweep.SetNumber(f"/{name}/standard_error", error)
        sweep.AddReport(f"iso{iso}", float(iso))
    sweep.Summarise()
    found: dict = json.loads(sweep.GetSummaryAsJson())
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cameras", type=int, default=100, help="of each kind")
    options = parser.parse_args()
    random = np.random.default_rng(1)
    for name, below, drop in CASES:
        switches = [summarise(random, below, drop)["conversion_gain_switch"] for _ in range(options.cameras)]
        found = [switch for switch in switches if switch is not None]
        placed = sum(switch["below"] == below for switch in found)
        print(f"{name}: a switch is found in {len(found)} of {options.cameras} cameras, at its place in {placed}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
