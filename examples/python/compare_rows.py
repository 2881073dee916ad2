# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the frames of a setting by every method of estimate-sensor-noise, for compare_methods.py."""

import json
import math
from functools import cache
from typing import NamedTuple

from acceptance_programs import ProgramError, run
from compare_frames import read_npy, write_npy

QUANTITIES = ("gain", "offset", "read_noise", "intercept")
EXIT_NOTHING = 3  # exit code of the tool: nothing could be estimated
FLICKERING_BURST = "burst, flickering illumination"
BURST = "burst"
FRAME = "one frame"
FLATS = "pairs of flats and darks"
# These warnings are true of every single image, or are notes.
COMMON_WARNINGS = ("line-only",)
SHOWN_SEVERITIES = ("warning", "error")


class Estimate(NamedTuple):
    """Value and standard error of a quantity; the error may be None."""

    value: float
    error: float | None


class Row(NamedTuple):
    """Result of a method.

    needs: what the method needs; found: Estimate by quantity of QUANTITIES; seconds: processor time, or None; remark:
    codes of warnings, or the reason without a result."""

    method: str
    needs: str
    found: dict
    seconds: float | None
    remark: str = ""


def identified(quantity):
    """Returns the Estimate of a quantity of a report; None if it is not identified."""
    if not quantity or quantity.get("status") != "identified" or quantity.get("value") is None:
        return None
    return Estimate(quantity["value"], quantity.get("standard_error"))


def estimates_of(report):
    """Returns the identified quantities of a report."""
    found = {name: identified(report.get(name)) for name in QUANTITIES}
    return {name: estimate for name, estimate in found.items() if estimate}


def warning_codes(report):
    """Returns the codes of the warnings that a reader has to know, in their order."""
    shown = [one["code"] for one in report["warnings"] if one["severity"] in SHOWN_SEVERITIES]
    return ", ".join(code for code in dict.fromkeys(shown) if code not in COMMON_WARNINGS)


def measure(tools, file, *options):
    """Runs estimate-sensor-noise. Returns its report and the processor time [s]."""
    json_file = file.with_suffix(".report.json")
    command = [tools / "estimate-sensor-noise", file, "--quiet", "--json", json_file, *options]
    done = run(command, allowed=(0, EXIT_NOTHING))
    return json.loads(json_file.read_text()), done.seconds


def row_of(method, needs, report, seconds):
    return Row(method, needs, estimates_of(report), seconds, warning_codes(report))


def affine_row(report, seconds):
    """Returns the line through mean and variance without correction, which every report of a burst has."""
    line = report.get("affine_baseline")
    found = {"gain": Estimate(line["gain"], None), "intercept": Estimate(line["intercept"], None)} if line else {}
    return Row("affine fit, no correction", BURST, found, seconds, "" if line else "not fitted")


def single_image_rows(tools, burst, has_composite):
    """Returns the rows of the first frame and of all frames, each by itself or as one composite image."""
    options = ("--method", "single-image", "--bayer", "none")
    yield row_of("single image, one frame", FRAME, *measure(tools, burst, *options, "--frames", "0:1"))
    file, remark = burst, ""
    if has_composite:
        file = write_npy(burst.with_name("composite.npy"), read_npy(burst).composite())
        remark = "as one composite image"
    row = row_of("single image, all frames", BURST, *measure(tools, file, *options))
    yield row._replace(remark=", ".join(text for text in (remark, row.remark) if text))


@cache
def has_emva(tools):
    """Returns whether the tool has the method emva1288."""
    return "emva1288" in run([tools / "estimate-sensor-noise", "--help"]).output.split("--method", 1)[1]


def emva_estimates(report):
    """Returns the quantities of an evaluation by EMVA 1288. Its temporal dark noise is in electrons."""
    of_sensor = report["sensitivity"]
    gain, dark, noise = (identified(of_sensor[name]) for name in ("gain", "dark_signal", "dark_noise"))
    found = {"gain": gain, "offset": dark}
    if gain and noise:
        errors = [one.error / one.value for one in (gain, noise) if one.error]
        value = gain.value * noise.value
        found["read_noise"] = Estimate(value, value * math.hypot(*errors) if errors else None)
    if gain and dark and noise:
        found["intercept"] = Estimate(found["read_noise"].value ** 2 - gain.value * dark.value, None)
    return {name: estimate for name, estimate in found.items() if estimate}


@cache
def emva_row(tools, flats, exposures):
    """Returns the row of EMVA 1288 for an exposure series of flats; flats may be None."""
    method = "EMVA 1288"
    if not flats:
        return Row(method, FLATS, {}, None, "there are no flats")
    if not has_emva(tools):
        return Row(method, FLATS, {}, None, "this build of estimate-sensor-noise has no --method emva1288")
    options = ("--method", "emva1288", "--exposures", ",".join(map(str, exposures)))
    try:
        report, seconds = measure(tools, flats, *options)
    except ProgramError as error:
        return Row(method, FLATS, {}, None, f"failed: {str(error).rsplit('exit code', 1)[-1]}")
    return Row(method, FLATS, emva_estimates(report), seconds, ", ".join(note["code"] for note in report["notes"]))


def rows_by_tool(tools, setting, frames):
    """Returns the rows of all methods of the tool for the frames of a setting."""
    options = ("--bayer", "none")
    rows = [row_of("refined", FLICKERING_BURST, *measure(tools, frames.burst, *options))]
    report, seconds = measure(tools, frames.burst, *options, "--method", "published")
    rows.append(row_of("published", FLICKERING_BURST, report, seconds))
    rows.append(affine_row(report, seconds))
    rows.extend(single_image_rows(tools, frames.burst, setting.group == "paper"))
    rows.append(emva_row(tools, frames.flats, frames.exposures))
    return rows


def motion_rows(tools, setting, frames):
    """Returns the rows of the paper's Table 6: the vibration and the flicker of each channel of a mosaic, with their
    truth in pixels of the channel."""
    report, _ = measure(tools, frames.mosaic, "--bayer", "RGGB")
    x, y = (Estimate(sd / 2, None) for sd in frames.truth["realised_vibration_sd"])
    rows = [(setting.name, "truth", x, y, None, Estimate(frames.truth["realised_flicker_sd"], None))]
    for name, channel in zip(("R", "G1", "G2", "B"), report["channels"], strict=True):
        vibration = channel.get("vibration") or {}
        quantities = [vibration.get(member) for member in ("sd_x", "sd_y", "covariance")] + [channel.get("flicker_sd")]
        rows.append((setting.name, name, *map(identified, quantities)))
    return rows
