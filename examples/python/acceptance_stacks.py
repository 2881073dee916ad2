# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""The record of one stack: its errors, whether its intervals hold the truth, and whether it is silently wrong.

A stack is refused if its gain is not identified. It is wrong if an identified quantity is off by more than WRONG_ERRORS
of its own standard errors and by more than WRONG_SIZE; on a line whose gain cannot be determined, if the gain is
identified at all. It is silently wrong if it is wrong and the report has no warning of the severity warning or error.
"""

from acceptance_lines import MUST_REFUSE

# Normal errors exceed 4 standard errors in one stack of 16,000; a full run has 28,000.
WRONG_ERRORS = 4.0  # [standard errors]
# The gain is demanded within 1 % or 3 standard errors. The offset is held against the signal range, as strictly as the
# gain. The size for the read noise was chosen empirically: a variance off by 20 %.
WRONG_SIZE = {"gain": 0.01, "offset": 0.01, "read_noise": 0.1, "linearity_error": 0.001}
# What these sizes are relative to, where it is not the true value itself. A linearity error is in per cent.
SIZE_OF_LINEARITY = 100.0


def is_identified(quantity):
    return quantity.get("status") == "identified" and quantity.get("value") is not None


def holds(interval, truth):
    """Whether an interval, whose ends may be open (None), holds the truth."""
    low, high = interval
    return (low is None or low <= truth) and (high is None or truth <= high)


def is_wrong(error, standard_error, size):
    """Whether an identified quantity is off by more than chance and by more than a smallest size, in its unit."""
    return abs(error) > max(WRONG_ERRORS * standard_error, size)


def judge(found, truth, signal_range, loud, expected):
    """Judges a report.

    found: the quantities of the report by name; truth: their true values; signal_range: brightest signal less the
    offset [DN]; loud: the codes of the warnings of severity warning and error."""
    covered, wrong = {}, []
    sizes = {"offset": signal_range, "linearity_error": SIZE_OF_LINEARITY}
    for name, value in truth.items():
        quantity = found[name]
        if not is_identified(quantity):
            continue
        if quantity.get("interval95"):
            covered[name] = holds(quantity["interval95"], value)
        size = WRONG_SIZE[name] * sizes.get(name, abs(value))
        if is_wrong(quantity["value"] - value, quantity["standard_error"] or 0.0, size):
            wrong.append(name)
    gain = found["gain"]
    stack = {"refused": not is_identified(gain), "status": gain.get("status", "none"), "covered": covered}
    if is_identified(gain):
        error = gain["value"] - truth["gain"]
        stack |= {
            "error": error / truth["gain"],
            "z": error / gain["standard_error"] if gain["standard_error"] else None,
        }
    else:
        stack |= {"error": None, "z": None}
    return file_wrong(stack, wrong, loud, expected)


def judge_frames(reported, truth):
    """Compares the frames that a report leaves out with those that are unlike the others: how many of them are named,
    how many there are, and how many others are named."""
    reported, truth = set(reported), set(truth)
    return {"named": len(reported & truth), "unlike": len(truth), "named_falsely": len(reported - truth)}


def file_wrong(stack, wrong, loud, expected):
    """Adds to a stack what is wrong in it, and whether the report says nothing of it."""
    if expected == MUST_REFUSE and not stack["refused"] and "gain" not in wrong:
        wrong = [*wrong, "gain"]
    return stack | {"wrong": wrong, "silent": bool(wrong) and not loud, "warnings": loud, "expected": expected}
