# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests whether the parts of a burst of unknown gain have the same gain: chi-square per degree of freedom.

    measure_consistency.py build/bin/estimate-sensor-noise FRAMES...

The gain is measured separately in the quadrants of the frame, and in halves and quarters of the burst (--roi,
--frames). With the gains g_k and their standard errors e_k, chi-square is the sum of ((g_k - g) / e_k)^2 about their
weighted mean g. It has one degree of freedom fewer than there are parts. It is about 1 if the parts have the same gain
and the errors are right. If it is far above 1, the gains differ or the errors are too small. If it is far below 1, the
errors are too large.
"""

import argparse
import json
import subprocess
from itertools import pairwise

FEWEST_PARTS = 2


def report_of(program, frames, *options):
    """Returns the report of some of the frames or pixels; empty if there is none."""
    done = subprocess.run([program, *frames, *options, "--json", "-", "--quiet"], capture_output=True, check=False)
    return json.loads(done.stdout) if done.stdout else {}


def chi_square(gains):
    """Returns chi-square per degree of freedom of gains with standard errors about their weighted mean; None: too few
    gains."""
    if len(gains) < FEWEST_PARTS:
        return None
    weights = [error**-2 for _, error in gains]
    mean = sum(w * gain for w, (gain, _) in zip(weights, gains, strict=True)) / sum(weights)
    return sum(((gain - mean) / error) ** 2 for gain, error in gains) / (len(gains) - 1)


def rois(width, height):
    """Returns the quadrants of the frame, as options."""
    w, h = width // 2, height // 2
    return [("--roi", f"{x},{y},{w},{h}") for y in (0, height - h) for x in (0, width - w)]


def spans(frames, parts):
    """Returns the burst in this number of parts, as options."""
    edges = [frames * k // parts for k in range(parts + 1)]
    return [("--frames", f"{first}:{last}") for first, last in pairwise(edges)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="estimate-sensor-noise")
    parser.add_argument("frames", nargs="+", metavar="FRAMES")
    options = parser.parse_args()
    whole = report_of(options.program, options.frames)
    if not whole:
        raise SystemExit(f"error: {options.program} gives no report of these frames; run it to see why")
    divisions = {
        "quadrants": rois(whole["width"], whole["height"]),
        "halves of the burst": spans(whole["frames"], 2),
        "quarters of the burst": spans(whole["frames"], 4),
    }
    for name, parts in divisions.items():
        found = [report_of(options.program, options.frames, *part).get("gain", {}) for part in parts]
        gains = [(gain["value"], gain["standard_error"]) for gain in found if gain.get("status") == "identified"]
        chi2 = chi_square(gains)
        listed = ", ".join(f"{gain:.4g} ± {error:.2g}" for gain, error in gains) or "none"
        text = "" if chi2 is None else f"; chi-square {chi2:.2f} per degree of freedom"
        print(f"{name}: {len(gains)} of {len(parts)} identified: {listed} DN/e⁻{text}")


if __name__ == "__main__":
    main()
