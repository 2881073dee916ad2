# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Reads the records that measure-cases prints, one per line of JSON, and compares estimates with their truth.

A record has case ("study/name/scene"), seed, truth (a number or null for each quantity), report, and the numbers that
the tables of its study need. An estimate counts if its status is identified.
"""

import json
import math
from collections import defaultdict
from pathlib import Path
from statistics import fmean
from typing import NamedTuple

from acceptance_stacks import holds, is_identified

# Paths in the report of quantities that are not members of it under their own name.
PLACES = {
    "vibration_sd_x": ("vibration", "sd_x"),
    "vibration_sd_y": ("vibration", "sd_y"),
    "row_noise": ("noise_correlation", "row_noise"),
    "column_noise": ("noise_correlation", "column_noise"),
}


def read_records(names):
    """Returns the records of files, in their order."""
    lines = [line for name in names for line in Path(name).read_text(encoding="utf-8").splitlines()]
    return [json.loads(line) for line in lines if line.strip()]


def case_of(record):
    """Returns study, name and scene of the case of a record. The name may contain slashes."""
    study, rest = record["case"].split("/", 1)
    return study, *rest.rsplit("/", 1)


def by_case(records):
    """Returns the records of each case, in the order of their first records. Mosaic channels are separate cases."""
    groups = defaultdict(list)
    for record in records:
        groups[record["case"], record.get("plane")].append(record)
    return list(groups.values())


class Estimate(NamedTuple):
    """Quantity of a report, its truth and its status.

    value, standard_error, interval and bounds may be None. truth is None if the stack has no single true value."""

    truth: float | None
    value: float | None
    standard_error: float | None
    interval: tuple | None
    bounds: tuple | None
    status: str

    @property
    def error(self):
        """Value less truth; None if the quantity is not identified or has no truth."""
        return self.value - self.truth if self.status == "identified" and self.truth is not None else None

    @property
    def z(self):
        """Error in units of the standard error; None if one of them is missing."""
        return self.error / self.standard_error if self.error is not None and self.standard_error else None

    @property
    def is_held(self):
        """Returns whether the 95 % interval contains
        the truth; None if the quantity is not identified or has no truth."""
        return None if self.error is None else bool(self.interval) and holds(self.interval, self.truth)

    @property
    def is_below_limit(self):
        """Returns whether the truth is at most the upper limit; None for another status or without a truth."""
        limit = self.bounds or self.interval
        if self.status != "upper-limit" or self.truth is None:
            return None
        return bool(limit) and self.truth <= limit[1]

    @property
    def is_within_bounds(self):
        """Returns whether the bounds contain the truth; None if there are no bounds or no truth."""
        return None if not self.bounds or self.truth is None else holds(self.bounds, self.truth)

    def is_within(self, fraction):
        """Returns whether the error is at most this fraction of the truth, or at most three standard errors."""
        return self.error is not None and (
            abs(self.error) <= fraction * abs(self.truth) or abs(self.z or math.inf) <= 3
        )


def estimate_of(record, name):
    """Returns the estimate of a quantity."""
    quantity = record["report"]
    for member in PLACES.get(name, (name,)):
        quantity = (quantity or {}).get(member) or {}
    return Estimate(
        truth=record["truth"].get(name),
        value=quantity.get("value") if is_identified(quantity) else None,
        standard_error=quantity.get("standard_error"),
        interval=quantity.get("interval95"),
        bounds=quantity.get("bracket"),
        status=quantity.get("status", "none"),
    )


def warnings_of(record):
    """Returns the distinct codes of the warnings of the report, in their order."""
    return list(dict.fromkeys(warning["code"] for warning in record["report"]["warnings"]))


def used_fraction(record):
    pixels = record["report"]["pixels"]
    return pixels["used"] / max(1, pixels["total"])


def present(values):
    """Returns the values that are not None."""
    return [value for value in values if value is not None]


def mean(values):
    """Returns the mean of the values that are not None; None if there is no such value."""
    values = present(values)
    return fmean(values) if values else None


def rms(values):
    """Returns the root mean square of the values that are not None; None if there is no such value."""
    values = present(values)
    return math.sqrt(fmean(value * value for value in values)) if values else None


def count_met(verdicts):
    """Returns (met, count) of verdicts. A verdict None does not count."""
    verdicts = [verdict for verdict in verdicts if verdict is not None]
    return sum(map(bool, verdicts)), len(verdicts)


def text_of(value, form, width=0):
    """Returns a number as text of a column; a dash for None."""
    return f"{'-' if value is None else format(value, form):>{width}}"


def text_of_fraction(pair, width=0):
    met, count = pair
    return f"{f'{met}/{count}' if count else '-':>{width}}"
