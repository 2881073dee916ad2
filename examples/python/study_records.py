# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The records that measure-cases prints, one a line of JSON, and how an estimate compares with its truth.

A record has case ("study/name/scene"), seed, truth (a number for each quantity, or null), report, and what the tables
of its study need. An estimate counts if its status is identified.
"""

import json
import math
from collections import defaultdict
from pathlib import Path
from statistics import fmean
from typing import NamedTuple

from acceptance_stacks import holds, is_identified

# Places in the report of what is not a member of it by its own name.
PLACES = {
    "vibration_sd_x": ("vibration", "sd_x"),
    "vibration_sd_y": ("vibration", "sd_y"),
    "row_noise": ("noise_correlation", "row_noise"),
    "column_noise": ("noise_correlation", "column_noise"),
}


def read_records(names):
    """The records of files, in their order."""
    lines = [line for name in names for line in Path(name).read_text(encoding="utf-8").splitlines()]
    return [json.loads(line) for line in lines if line.strip()]


def case_of(record):
    """Study, name and scene of the record's case. The name may hold slashes."""
    study, rest = record["case"].split("/", 1)
    return study, *rest.rsplit("/", 1)


def by_case(records):
    """The records of each case, in the order of their first ones. Planes of a mosaic are cases of their own."""
    groups = defaultdict(list)
    for record in records:
        groups[record["case"], record.get("plane")].append(record)
    return list(groups.values())


class Estimate(NamedTuple):
    """A quantity of a report, its truth and its status. value, standard_error, interval and bounds may be None, as the
    truth where the stack has no one value."""

    truth: float | None
    value: float | None
    standard_error: float | None
    interval: tuple | None
    bounds: tuple | None
    status: str

    @property
    def error(self):
        """Value less truth; None if it is not identified."""
        return self.value - self.truth if self.status == "identified" and self.truth is not None else None

    @property
    def z(self):
        """The error in standard errors."""
        return self.error / self.standard_error if self.error is not None and self.standard_error else None

    @property
    def is_held(self):
        """Whether the 95 % interval contains the truth; None if the quantity is not identified."""
        return None if self.error is None else bool(self.interval) and holds(self.interval, self.truth)

    @property
    def is_below_limit(self):
        """Whether the truth is at most the upper limit; None for another status, or without a truth."""
        limit = self.bounds or self.interval
        if self.status != "upper-limit" or self.truth is None:
            return None
        return bool(limit) and self.truth <= limit[1]

    @property
    def is_within_bounds(self):
        """Whether the bounds contain the truth; None where there are none, or no truth."""
        return None if not self.bounds or self.truth is None else holds(self.bounds, self.truth)

    def is_within(self, fraction):
        """Whether the error is at most so large a fraction of the truth, or three standard errors."""
        return self.error is not None and (
            abs(self.error) <= fraction * abs(self.truth) or abs(self.z or math.inf) <= 3
        )


def estimate_of(record, name):
    """The estimate of a quantity."""
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
    """The codes of the report's warnings, each once, in the report's order."""
    return list(dict.fromkeys(warning["code"] for warning in record["report"]["warnings"]))


def used_fraction(record):
    pixels = record["report"]["pixels"]
    return pixels["used"] / max(1, pixels["total"])


def present(values):
    """The values that are not None."""
    return [value for value in values if value is not None]


def mean(values):
    """The mean of the values that are there; None if there is none."""
    values = present(values)
    return fmean(values) if values else None


def rms(values):
    """The root mean square of the values that are there; None if there is none."""
    values = present(values)
    return math.sqrt(fmean(value * value for value in values)) if values else None


def count_met(verdicts):
    """(met, count) of verdicts; None does not count."""
    verdicts = [verdict for verdict in verdicts if verdict is not None]
    return sum(map(bool, verdicts)), len(verdicts)


def text_of(value, form, width=0):
    """A number in a column; a dash where there is none."""
    return f"{'-' if value is None else format(value, form):>{width}}"


def text_of_fraction(pair, width=0):
    met, count = pair
    return f"{f'{met}/{count}' if count else '-':>{width}}"
