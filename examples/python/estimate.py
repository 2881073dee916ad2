#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the noise of a camera from raw frames of a static scene.

    estimate.py                                            # a simulated burst, with its truth
    estimate.py frames/*.tif                               # 2-D frames in time order
    estimate.py stack.mha --json report.json --plot report.html

itk.estimate_sensor_noise() has the same options; the command-line tool estimate-sensor-noise has more.
"""

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import itk


def parse_arguments() -> argparse.Namespace:
    """Returns the options of the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("frames", nargs="*", metavar="FRAME", help="image files or one stack file; default: simulated")
    parser.add_argument("--bit-depth", type=int, metavar="N", help="bits of the digital numbers (default: found)")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the report as JSON")
    parser.add_argument(
        "--plot",
        type=Path,
        metavar="FILE",
        help="the report as a page, .html, or its noise curve, .png, .svg, .pdf (matplotlib)",
    )
    return parser.parse_args()


def print_truth(report: Mapping[str, Any], truth: Mapping[str, Any]) -> None:
    """Prints the true values of a simulated stack next to the estimates."""
    print(f"\n{'quantity':<18}{'truth':>10}{'estimate':>12}  {'error':<11}  unit")
    for name, true in (
        ("gain", truth["gain"]),
        ("offset", truth["offset"]),
        ("read_noise", truth["read_noise"]),
        ("intercept", truth["intercept"]),
        ("flicker_sd", truth["realised_flicker_sd"]),
    ):
        value = report[name]["value"]
        estimate = f"{value:.5g}" if value is not None else report[name]["status"]
        error = report[name]["standard_error"]
        text = "" if error is None else f"± {error:.2g}"
        print(f"{name:<18}{true:>10.5g}{estimate:>12}  {text:<11}  {report[name]['unit']}")


def main() -> int:
    """Returns the exit code: 0 done, 2 wrong use or unreadable input, 3 nothing could be estimated."""
    arguments = parse_arguments()
    truth = None
    frames = arguments.frames if len(arguments.frames) != 1 else arguments.frames[0]
    if not frames:
        frames, truth = itk.simulate_sensor_noise(camera="B", condition=3, frames=100)
    try:
        report = itk.estimate_sensor_noise(frames, bit_depth=arguments.bit_depth, progress=sys.stderr.isatty())
    except (ValueError, RuntimeError) as error:
        print(str(error).splitlines()[0], file=sys.stderr)
        return 2
    print(report)  # a table, followed by the warnings
    if truth is not None:
        print_truth(report, truth)
    if arguments.json:
        arguments.json.write_text(report.to_json(), encoding="utf-8")
    if arguments.plot and arguments.plot.suffix == ".html":
        report.to_html(arguments.plot)
    elif arguments.plot and report["scatter"]["mean"]:
        report.plot().savefig(arguments.plot)
    return 0 if "identified" in (report["gain"]["status"], report["intercept"]["status"]) else 3


if __name__ == "__main__":
    sys.exit(main())
