# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Makes the record of one stack: its errors, whether its intervals contain the truth, and whether it is silently wrong.

A stack is refused if its gain is not identified. It is wrong if the error of an identified quantity exceeds both
WRONG_ERRORS times its standard error and WRONG_SIZE. On a line whose gain cannot be determined, it is also wrong if the
gain is identified. It is silently wrong if it is wrong and the report has no warning of the severity warning or error.
"""

from acceptance_lines import MUST_REFUSE

# A normal error exceeds 4 standard errors in one stack of 16,000; a full run has 28,000 stacks.
WRONG_ERRORS = 4.0  # [standard errors]
# The studies demand a gain within 1 % or 3 standard errors. The error of the offset is relative to the signal range,
# with the same limit. The limit for the read noise was chosen empirically: it is a variance that is wrong by 20 %.
WRONG_SIZE = {"gain": 0.01, "offset": 0.01, "read_noise": 0.1, "linearity_error": 0.001}
# Reference of these limits if it is not the true value: a linearity error is in per cent.
SIZE_OF_LINEARITY = 100.0


def is_identified(quantity):
    return quantity.get("status") == "identified" and quantity.get("value") is not None


def holds(interval, truth):
    """Returns whether an interval contains the truth. An end of the interval may be open (None)."""
    low, high = interval
    return (low is None or low <= truth) and (high is None or truth <= high)


def is_wrong(error, standard_error, size):
    """Returns whether the error of an identified quantity exceeds both chance and a smallest size, in its unit."""
    return abs(error) > max(WRONG_ERRORS * standard_error, size)


def evaluate(found, truth, signal_range, loud, expected):
    """Returns the test of a report.

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


def evaluate_frames(reported, truth):
    """Compares the frames that a report leaves out with the frames that are unlike the others. Returns how many of the
    latter are named, how many there are, and how many other frames are named."""
    reported, truth = set(reported), set(truth)
    return {"named": len(reported & truth), "unlike": len(truth), "named_falsely": len(reported - truth)}


def file_wrong(stack, wrong, loud, expected):
    """Adds to a stack its wrong quantities, and whether the report has no warning about them."""
    if expected == MUST_REFUSE and not stack["refused"] and "gain" not in wrong:
        wrong = [*wrong, "gain"]
    return stack | {"wrong": wrong, "silent": bool(wrong) and not loud, "warnings": loud, "expected": expected}
