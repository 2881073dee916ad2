# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Lists the demands on the stacks of each line of the sensor study."""

from collections.abc import Callable
from typing import NamedTuple

from acceptance_stacks import holds
from study_records import case_of, estimate_of, warnings_of

LEAST_COVERAGE = 0.9  # least coverage of the 95 % intervals of a line [1]
LEAST_BOUNDS = 0.95
MOST_STACKS = 0.97
LEAST_FAILED = 0.95
SAME_GAIN = 1e-9  # largest relative difference of gains that count as equal [1]
MAP_COVERAGE = (0.93, 0.97)  # coverage of the 95 % intervals of the pixels of a map [1]


class Demand(NamedTuple):
    """Demand on the stacks of a line.

    what: the demand in words; test: whether a stack meets it, None if the stack does not count; least: fraction of the
    stacks that must meet it; is_coverage: it is about 95 % intervals, so that a single improbable setting is shown as
    well."""

    what: str
    test: Callable[[dict], bool | None]
    least: float = 1.0
    is_coverage: bool = False


def has_gain(record):
    return estimate_of(record, "gain").error is not None


def is_failed(record):
    return estimate_of(record, "gain").status == "failed"


NOT_FAILED = Demand("not failed", lambda record: not is_failed(record))


def coverage(name):
    return Demand(f"interval contains {name}", lambda record: estimate_of(record, name).is_held, LEAST_COVERAGE, True)


def within(name, fraction, counts=lambda _record: True):
    return Demand(
        f"{name} within {100 * fraction:g} % or 3 standard errors",
        lambda record: estimate_of(record, name).is_within(fraction) if counts(record) else None,
    )


def gain_within(fraction):
    return within("gain", fraction)


def noise_class(least):
    def test(record):
        expected = record["expected_noise_classes"]
        return (record["report"]["noise_correlation"] or {}).get("kind") in expected if expected else None

    return Demand("noise class as expected", test, least)


def warned(code):
    return Demand(f"warning {code}", lambda record: code in warnings_of(record))


def line_noise(name):
    return within(name, 0.05, lambda record: record["truth"][name] > 0)


def bounds_contain(name):
    return Demand(f"bounds contain {name}", lambda record: estimate_of(record, name).is_within_bounds, LEAST_BOUNDS)


def identified_within_bounds(name):
    def test(record):
        one = estimate_of(record, name)
        return holds(one.bounds, one.value) if one.bounds and one.error is not None else None

    return Demand(f"identified {name} lies within its own bounds", test)


def map_covers(name):
    def test(record):
        maps = record["coverage_of_maps"]
        return MAP_COVERAGE[0] <= maps[name] <= MAP_COVERAGE[1] if maps else None

    return Demand(f"{name} map: 93 to 97 % of the pixels' intervals contain the truth", test)


def median_within(record):
    one = estimate_of(record, "read_noise_median")
    return abs(one.error) <= 0.03 * one.truth if one.error is not None else None


def distinct_gain(record):
    gain, expected = estimate_of(record, "gain").value, record["gain_of_distinct_frames"]
    return gain is not None and expected is not None and abs(gain - expected) <= SAME_GAIN * abs(expected)


NO_GAIN = [
    Demand("failed, or no gain", lambda record: not has_gain(record), LEAST_FAILED),
    Demand("no interval that misses the gain", lambda record: estimate_of(record, "gain").is_held is not False),
    noise_class(LEAST_FAILED),
]


def gain_in_spite(fraction, *more):
    return [NOT_FAILED, gain_within(fraction), coverage("gain"), *more]


NAMED = noise_class(MOST_STACKS)
TONE_CURVES = [
    Demand("target: failed", lambda record: is_failed(record) if case_of(record)[2] == "target" else None, 0.95),
    Demand(
        "texture: failed, or interval contains gain",
        lambda record: (
            is_failed(record) or estimate_of(record, "gain").is_held is not False
            if case_of(record)[2] == "texture"
            else None
        ),
        LEAST_COVERAGE,
    ),
    coverage("gain"),
]
FLATS = [
    *(coverage(name) for name in ("gain", "offset", "flicker_sd")),
    Demand(
        "upper limit of the flicker is above it",
        lambda record: estimate_of(record, "flicker_sd").is_below_limit,
        LEAST_COVERAGE,
    ),
]
SMALL_ERROR = Demand(
    "standard error of gain at most 0.5 %",
    lambda record: one.standard_error <= 0.005 * one.truth if (one := estimate_of(record, "gain")).error else None,
)
PLAIN_FLAT = Demand(
    "gain identified: no pattern, shading 3 %, 50 frames",
    lambda record: (
        has_gain(record) if not record["has_pattern"] and record["shading"] == 0.03 and record["frames"] >= 50 else None
    ),
)
SCMOS = [
    NOT_FAILED,
    gain_within(0.02),
    *(coverage(name) for name in ("gain", "offset", "flicker_sd")),
    within("read_noise", 0.03, lambda record: estimate_of(record, "offset").error is not None),
    coverage("read_noise"),
]
DEMANDS = {
    "bends": [NOT_FAILED, coverage("gain")],
    "gamma": TONE_CURVES,
    "narrow": [
        Demand(
            "response-unchecked, of those not failed",
            lambda record: None if is_failed(record) else "response-unchecked" in warnings_of(record),
        )
    ],
    "flats": [*FLATS, PLAIN_FLAT],
    "flats-dark": [*FLATS, Demand("gain identified", has_gain), SMALL_ERROR],
    "scmos": SCMOS,
    "scmos-dark": [
        *SCMOS,
        Demand("median read noise within 3 %", median_within),
        map_covers("offset"),
        map_covers("read_noise"),
    ],
    "brackets": [
        bounds_contain("offset"),
        identified_within_bounds("offset"),
        bounds_contain("read_noise"),
        coverage("offset"),
    ],
    "plain": gain_in_spite(0.02, NAMED, line_noise("row_noise"), line_noise("column_noise")),
    **{name: gain_in_spite(0.02, NAMED) for name in ("smoothed", "resampled", "coupling", "blur")},
    "temporal": [
        Demand(
            "gain within 5 % or 3 standard errors, or no gain",
            lambda record: not has_gain(record) or estimate_of(record, "gain").is_within(0.05),
        ),
        coverage("gain"),
        NAMED,
    ],
    "repeated": gain_in_spite(
        0.02, warned("repeated-frames"), Demand("gain equals the gain of the distinct frames", distinct_gain), NAMED
    ),
    "companded": gain_in_spite(0.01, warned("companded")),
    "brighter-fatter": gain_in_spite(0.01, NAMED),
    **dict.fromkeys(("binned", "defects", "median", "blocks"), NO_GAIN),
}


def demands_on(line):
    """Returns the demands on a line of settings. Lines without an entry have the demands on a plain measurement."""
    return DEMANDS.get(line, [NOT_FAILED, gain_within(0.01), coverage("gain")])
