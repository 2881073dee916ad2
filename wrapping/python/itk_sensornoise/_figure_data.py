# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The numbers of the figures of a report that was read from JSON: those that C++ computes of the same record."""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

_TWO_SIDED_95 = 1.959963984540054
_LINE_PIECES = 32
_OF_LEVEL_SET = 2.3085  # TruncatedVariance of the module


def figure_data_of(record: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the members of Report.figure_data for a record."""
    scatter = record["scatter"]
    line = _line_of(record)
    rows = [
        (mean, variance, corrected, count)
        for mean, variance, corrected, count in _rows(scatter)
        if mean is not None and corrected is not None
    ]
    noise = record.get("noise_correlation") or {"space": [], "time": []}
    residuals = [] if line is None else _residuals(record, line, rows)
    return {
        "mean": [row[0] for row in rows],
        "variance": [row[1] for row in rows],
        "corrected_variance": [row[2] for row in rows],
        "residual_mean": [mean for mean, _ in residuals],
        "residual": [residual for _, residual in residuals],
        "residual_spread": math.sqrt(_factor_of(noise["space"])),
        **_line_members(record, line, [row[0] for row in rows]),
        "flicker": list(record["flicker"] or []),
        "motion_x": [shift[0] for shift in record["motion"] or []],
        "motion_y": [shift[1] for shift in record["motion"] or []],
        "lags": [*map(dict, noise["space"]), *map(dict, noise["time"])],
    }


def _rows(scatter: Mapping[str, Any]) -> list[tuple[Any, Any, Any, Any]]:
    names = ("mean", "variance", "corrected_variance", "count")
    count = len(scatter["mean"] or [])
    columns = [list(scatter.get(name) or []) for name in names]
    return list(zip(*(column + [None] * (count - len(column)) for column in columns), strict=False))


def _line_of(record: Mapping[str, Any]) -> tuple[float, float] | None:
    """Returns slope and intercept if they were identified, else slope and intercept of the indicative line."""
    slope, intercept = (record[name]["value"] for name in ("variance_slope", "total_intercept"))
    if slope is not None and intercept is not None:
        return slope, intercept
    line = record["fit"]["line"]
    return None if line is None else (line["gain"], line["intercept"])


def _factor_of(lags: Sequence[Mapping[str, Any]]) -> float:
    """Returns the variance inflation of a sample variance of values with correlated noise [1]."""
    squares: Iterable[float] = (
        lag["value"] ** 2 - lag["standard_error"] ** 2 for lag in lags if lag["standard_error"] is not None
    )
    return 1.0 + 2.0 * sum((max(square, 0.0) for square in squares), 0.0)


def _residuals(
    record: Mapping[str, Any], line: tuple[float, float], rows: Sequence[tuple[Any, Any, Any, Any]]
) -> list[tuple[float, float]]:
    """Returns for each intensity bin its level, and its corrected variance minus the line over the standard error."""
    slope, intercept = line
    frames = record["frames_distinct"]
    noise = record.get("noise_correlation")
    offset = record["offset"]["value"]
    known = [mean for mean in record["scatter"]["mean"] if mean is not None]
    dark = slope * (offset if offset is not None else min(known, default=math.inf)) + intercept
    kurtosis = (noise["excess_kurtosis"]["value"] or 0.0) if noise else 0.0
    shared = _factor_of(noise["time"]) if noise else 1.0
    found = []
    of_level_sets = record.get("single_image") is not None
    for mean, _, corrected, count in rows:
        if not count or (frames < 2 and not of_level_sets):
            continue
        expected = slope * mean + intercept
        of_pixel = _OF_LEVEL_SET
        if not of_level_sets:
            of_pixel = max(2.0 / (frames - 1.0) * shared + kurtosis / frames, 0.0)
        of_variance = abs(expected) * math.sqrt(of_pixel / count)
        if not of_variance > 0.0:
            continue
        of_level = 0.0
        if not of_level_sets:
            of_level = math.sqrt(abs(expected) / frames) * min(max(dark / abs(expected), 0.0), 1.0)
        error = math.hypot(of_variance, slope * of_level)
        if math.isfinite(error):
            found.append((mean, (corrected - expected) / error))
    return found


def _line_members(
    record: Mapping[str, Any], line: tuple[float, float] | None, means: Sequence[float]
) -> dict[str, Any]:
    """Returns the line from the darkest to the brightest level, and its 95 % band."""
    members: dict[str, Any] = {"line_mean": [], "line_variance": [], "band_low": [], "band_high": []}
    members["is_indicative"] = False
    if line is None or not means:
        return members
    members["is_indicative"] = record["gain"]["value"] is None
    darkest, brightest = min(means), max(means)
    for i in range(_LINE_PIECES + 1):
        mean = darkest + (brightest - darkest) * i / _LINE_PIECES
        variance = line[0] * mean + line[1]
        members["line_mean"].append(mean)
        members["line_variance"].append(variance)
        half = None if members["is_indicative"] else _half_width(record, mean)
        if half is not None:
            members["band_low"].append(variance - half)
            members["band_high"].append(variance + half)
    return members


def _half_width(record: Mapping[str, Any], mean: float) -> float | None:
    """Returns half the width of the 95 % interval of the line at a level [DN^2]; None if an error is not known."""
    slope, intercept = (record[name]["standard_error"] for name in ("variance_slope", "total_intercept"))
    if not record.get("covariance") or slope is None or intercept is None:
        return None
    (slope_variance, covariance, *_), (_, intercept_variance, *_), *_ = record["covariance"]["matrix"]
    if None in (slope_variance, covariance, intercept_variance) or slope_variance * intercept_variance <= 0.0:
        return None
    correlation = covariance / math.sqrt(slope_variance * intercept_variance)
    variance = (mean * slope) ** 2 + intercept**2 + 2.0 * correlation * mean * slope * intercept
    return _TWO_SIDED_95 * math.sqrt(max(variance, 0.0)) if math.isfinite(variance) else None
