# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Prints the table of the robustness study: bursts with faults of recording and processing.

Each case has one row over its seeds: mean error and rms z of gain, intercept and offset; stacks whose offset is
identified; fraction of the pixels used; and a verdict. A gain is right within 1 %. If the response is non-linear, it is
right if its 95 % interval contains the mean gain. An intercept is right within 3 standard errors.
"""

from study_records import (
    by_case,
    case_of,
    estimate_of,
    mean,
    rms,
    text_of,
    text_of_fraction,
    used_fraction,
    warnings_of,
)

LARGEST_GAIN_ERROR = 0.01  # largest relative error of the gain [1]
LARGEST_Z = 3.0  # largest error of intercept and offset [standard errors]


def find_fault(record):
    """Returns the fault of a stack. It is empty if there is none, or if any result is right for the case."""
    expectation, gain = record["expectation"], estimate_of(record, "gain")
    if expectation == "processed":
        return ""
    if expectation == "refused":
        if gain.status != "failed":
            return "not refused"
        return "" if "variance-not-affine" in warnings_of(record) else "no variance-not-affine"
    if gain.error is None:
        return "no gain"
    is_small = abs(gain.error) <= LARGEST_GAIN_ERROR * gain.truth
    if not (gain.is_held if expectation == "non-linear" else is_small):
        return "gain"
    return "intercept" if abs(estimate_of(record, "intercept").z or 0.0) > LARGEST_Z else ""


def verdict_of(group, fault):
    expected = {"refused": "failed as expected", "processed": "processed"}
    return f"MISS ({fault})" if fault else expected.get(group[0]["expectation"], "ok")


def print_group(group):
    """Prints the row of a case. Returns the fault of its first faulty stack."""
    _, name, scene = case_of(group[0])
    gain, intercept, offset = ([estimate_of(one, key) for one in group] for key in ("gain", "intercept", "offset"))
    fault = next(filter(None, map(find_fault, group)), "")
    is_offset_off = any(abs(one.z or 0.0) > LARGEST_Z for one in offset)
    errors = [None if one.error is None else 100 * one.error / one.truth for one in gain]
    print(
        f"{name:<20} {scene:<8} ",
        text_of(mean(errors), "+.3f", 9),
        text_of(rms(one.z for one in gain), ".1f", 6),
        text_of(mean(one.error for one in intercept), "+.3f", 11),
        text_of(rms(one.z for one in intercept), ".1f", 6),
        text_of(mean(one.error for one in offset), "+.3f", 10),
        text_of(rms(one.z for one in offset), ".1f", 6),
        text_of_fraction((sum(one.error is not None for one in offset), len(group)), 6),
        f" {mean(map(used_fraction, group)):5.3f}  {verdict_of(group, fault)}"
        + (", offset beyond 3 standard errors" if is_offset_off else ""),
    )
    return fault


def print_table(records):
    print(
        f"{'case':<20} {'scene':<8}  {'g err %':>9} {'z':>6} {'c err DN^2':>11} {'z':>6} {'mu err DN':>10} {'z':>6} "
        f"{'id':>6}  {'used':>5}  verdict"
    )
    groups = by_case(records)
    faults = [print_group(group) for group in groups]
    tested = sum(group[0]["expectation"] != "processed" for group in groups)
    print(f"{sum(map(bool, faults))} of {tested} missed")
