# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Prints the tables of the study of single images.

The first table has one row for each case. n/N: frames whose gain is identified. bias, rms, worst: error of the gain, in
% of the truth. z-rms: rms of error over standard error, which should be 1. gain, intercept: 95 % intervals that contain
the truth. warned: reports that warn of texture. silent: gains that are off by more than 10 % without that warning.

The second table has the images composed of all frames of a burst, next to the column "Foi et al." of the paper: mean
and twice the standard deviation over the seeds. closer: the mean is closer to the truth than the mean of the paper.
within: it is within two standard deviations of the paper, apart from rounding of the printed numbers.
"""

from statistics import fmean, stdev

from paper_tables import SINGLE_IMAGE
from study_records import by_case, case_of, count_met, estimate_of, mean, rms, text_of, text_of_fraction, warnings_of

QUANTITIES = ("gain", "intercept")
TEXTURE = "texture-dominates"
LARGE_ERROR = 0.1  # relative error of the gain that a report should not have without a warning [1]
COMPOSITE = " composite"


def row(records):
    _, name, scene = case_of(records[0])
    gains = [estimate_of(record, "gain") for record in records]
    errors = [None if one.error is None else 100 * one.error / one.truth for one in gains]
    found = [error for error in errors if error is not None]
    warned = [TEXTURE in warnings_of(record) for record in records]
    silent = sum(
        error is not None and abs(error) > 100 * LARGE_ERROR and not is_warned
        for error, is_warned in zip(errors, warned, strict=True)
    )
    columns = [
        f"{name:<10} {scene:<8}",
        text_of_fraction((len(found), len(records)), 8),
        text_of(mean(errors), "+.2f", 8),
        text_of(rms(errors), ".2f", 7),
        text_of(max(map(abs, found)) if found else None, ".2f", 7),
        text_of(rms(one.z for one in gains), ".2f", 7),
        text_of_fraction(count_met(one.is_held for one in gains), 8),
        text_of_fraction(count_met(estimate_of(record, "intercept").is_held for record in records), 10),
        f"{sum(warned):7}{silent:8}",
    ]
    return " ".join(columns)


def verdict_on(average, truth, paper):
    """Returns whether a mean is closer to the truth than the paper's mean, or within its two standard deviations."""
    figure, two_sd = paper
    if abs(average - truth) <= abs(figure - truth):
        return "closer"
    return "within" if abs(average - figure) <= two_sd else "neither"


def print_composite(records):
    _, name, scene = case_of(records[0])
    experiment = name.removesuffix(COMPOSITE)
    paper = dict(zip(QUANTITIES, SINGLE_IMAGE.get(scene, {}).get(experiment, ()), strict=False))
    for quantity in QUANTITIES:
        estimates = [estimate_of(record, quantity) for record in records]
        truth = fmean(one.truth for one in estimates)
        values = [one.value for one in estimates if one.value is not None]
        print(
            f"{experiment if quantity == 'gain' else '':<4} {scene if quantity == 'gain' else '':<8} {quantity:<10}",
            text_of(truth, ".4g", 8),
            text_of(mean(values), ".5g", 10),
            "±",
            f"{text_of(2 * stdev(values) if len(values) > 1 else None, '.2g'):<8}",
            text_of_fraction((len(values), len(records)), 7),
            f"{'{:g} ± {:g}'.format(*paper[quantity]) if paper else '-':>18}",
            f" {verdict_on(fmean(values), truth, paper[quantity]) if paper and values else '-'}",
        )


def print_table(records):
    groups = by_case(records)
    composites = [group for group in groups if case_of(group[0])[1].endswith(COMPOSITE)]
    frames = [group for group in groups if group not in composites]
    if frames:
        print(
            f"{'case':<10} {'scene':<8} {'n/N':>8} {'bias %':>8} {'rms %':>7} {'worst %':>7} {'z-rms':>7} {'gain':>8} "
            f"{'intercept':>10} {'warned':>7} {'silent':>7}"
        )
    for group in frames:
        print(row(group))
    if composites:
        print(
            f"{'exp.':<4} {'scene':<8} {'parameter':<10} {'truth':>8} {'mean':>10} ± {'2 sd':<8} {'n/N':>7} "
            f"{'Foi et al.':>18}  verdict"
        )
    for group in composites:
        print_composite(group)
