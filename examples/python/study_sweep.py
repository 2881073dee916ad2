# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Simulates cameras of 8 ISO speeds with and without a switch of the conversion gain, and measures them by --sweep.

    python examples/python/study_sweep.py --bin build/bin --cameras 10
    python examples/python/study_sweep.py --bin build/bin --time

The gain of a camera is 0.002 DN/e- times the ISO speed. Its read noise is 3 e- before the amplifier, with a switch 1.5
e- from ISO 800 on, and 600 e- over the ISO speed behind it. Prints for both kinds: settings measured, gains within 1 %
or 3 standard errors of the truth, cameras whose switch is found, and cameras whose switch is found between ISO 400 and
800. Each camera takes some 5 seconds on two processors.

--time measures a sweep of --settings bursts instead, each of 20 frames of a mosaic of 6 megapixels, from files. Prints
the seconds that pass, and the processor time, which depends little on the load of the machine. The bursts have the same
pixels. They need 240 MB of the folder for temporary files.
"""

import argparse
import json
import math
import os
import tempfile
import time
from pathlib import Path

from acceptance_programs import run

ISO_SPEEDS = (100, 200, 400, 800, 1600, 3200, 6400, 12800)
GAIN_PER_ISO = 0.002  # [DN/e-]
FIRST_ISO = 800  # first setting behind the switch of the conversion gain
OFFSET = 1000  # [DN]: above the read noise of every ISO speed, so that no dark frame is cut off
BRIGHTEST = 14000  # signal [DN]
LARGEST_ERROR = 0.01  # largest relative error of a gain [1]
LARGEST_Z = 3.0  # [standard errors]


def read_noise(iso: int, has_switch: bool) -> float:
    """Returns the read noise [e-]."""
    return math.hypot(1.5 if has_switch and iso >= FIRST_ISO else 3.0, 600 / iso)


def simulate(folder: Path, seed: int, has_switch: bool, options: argparse.Namespace) -> None:
    """Writes the bursts of a camera, with dark frames."""
    for number, iso in enumerate(ISO_SPEEDS):
        gain = GAIN_PER_ISO * iso
        burst = folder / f"iso{iso}"
        (burst / "dark").mkdir(parents=True)
        camera = [options.bin / "simulate-sensor-noise", "--size", options.size, "--frames", options.frames]
        camera += ["--gain", gain, "--offset", OFFSET, "--bit-depth", 14]
        camera += ["--read-noise", gain * read_noise(iso, has_switch)]
        illumination = [
            "--electrons",
            min(60000, BRIGHTEST / gain),
            "--flicker-sd",
            0.02,
            "--seed",
            100 * seed + number,
        ]
        run([*camera, *illumination, "--output", burst / "light.mha"])
        run([*camera, "--dark", "--seed", 100 * seed + 50 + number, "--output", burst / "dark" / "dark.mha"])


def is_right(entry: dict) -> bool:
    """Returns whether the gain of a setting is within 1 % or 3 standard errors."""
    gain = entry["report"]["gain"]
    truth = GAIN_PER_ISO * entry["setting"]
    error = abs(gain["value"] - truth) if gain["value"] is not None else math.inf
    return error <= LARGEST_ERROR * truth or error <= LARGEST_Z * (gain["standard_error"] or 0)


def print_time(options: argparse.Namespace) -> None:
    """Prints how long a sweep of mosaics of 6 megapixels takes, from files."""
    frames, size = 20, "3000x2000"
    with tempfile.TemporaryDirectory() as folder:
        camera = Path(folder, "camera")
        first = camera / "iso100" / "light.mha"
        first.parent.mkdir(parents=True)
        simulator = [options.bin / "simulate-sensor-noise", "--size", size, "--frames", frames, "--bayer", "RGGB"]
        run([*simulator, "--gain", 0.5, "--electrons", 4000, "--seed", 1, "--output", first])
        for number in range(1, options.settings):
            burst = camera / f"iso{100 * 2**number}" / "light.mha"
            burst.parent.mkdir()
            os.link(first, burst)
        tool = [options.bin / "estimate-sensor-noise", "--sweep", camera, "--bayer", "RGGB", "--quiet"]
        begin = time.monotonic()
        done = run([*tool, "--json", Path(folder, "passport.json")])
        seconds = time.monotonic() - begin
    print(f"{options.settings} x {frames} frames of {size}, {os.cpu_count()} processors: ", end="")
    print(f"{seconds:.0f} s, processor time {done.seconds:.0f} s")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=Path("build/bin"), help="folder of the programs")
    parser.add_argument("--cameras", type=int, default=10, help="of each kind")
    parser.add_argument("--frames", type=int, default=30)
    parser.add_argument("--size", default="256x192", help="width x height [pixels]")
    parser.add_argument("--time", action="store_true", help="only measure the time of a sweep of 6 megapixels")
    parser.add_argument("--settings", type=int, default=len(ISO_SPEEDS), help="of --time")
    options = parser.parse_args()
    if options.time:
        print_time(options)
        return 0
    for has_switch in (True, False):
        measured = right = found = placed = 0
        for seed in range(1, options.cameras + 1):
            with tempfile.TemporaryDirectory() as folder:
                simulate(Path(folder), seed, has_switch, options)
                tool = options.bin / "estimate-sensor-noise"
                passport = json.loads(run([tool, "--sweep", folder, "--quiet", "--json", "-"], allowed=(0, 4)).output)
            entries = [entry for entry in passport["settings"] if entry["status"] == "measured"]
            measured += len(entries)
            right += sum(is_right(entry) for entry in entries)
            conversion = passport["conversion_gain_switch"]
            found += conversion is not None
            placed += conversion is not None and (conversion["below"], conversion["above"]) == (400, 800)
        kind = "with a switch" if has_switch else "without a switch"
        settings = options.cameras * len(ISO_SPEEDS)
        print(f"{kind}: {measured} of {settings} settings measured, {right} gains right, ", end="")
        print(f"switch found in {found} of {options.cameras}, at its place in {placed}", flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
