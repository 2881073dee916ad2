# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the cases of measure-cases for one seed, and tests the reports that it prints.

Only the gain can be wrong. The signal range of these stacks is not known, so the error of an offset has no reference.
"""

import json

from acceptance_lines import MAY_REFUSE, MEASURED, MUST_REFUSE, stream_of
from acceptance_programs import run
from acceptance_stacks import evaluate

HELD = ("gain", "offset", "read_noise")  # quantities whose intervals are counted
EXPECTED = {"measured": MEASURED, "non-linear": MEASURED, "refused": MUST_REFUSE, "processed": MAY_REFUSE}
EXPECTED_OF_STUDY = {"efficiency": MEASURED, "sensors": MAY_REFUSE}


def evaluate_record(record):
    """Returns the result of one record: what is wrong in it, and whether its intervals contain the truth."""
    study, name = record["case"].split("/", 1)
    report, truth = record["report"], record["truth"]
    loud = [warning["code"] for warning in report["warnings"] if warning["severity"] != "note"]
    expected = EXPECTED[record["expectation"]] if "expectation" in record else EXPECTED_OF_STUDY[study]
    held = evaluate(report, {key: truth[key] for key in HELD if key in truth}, float("inf"), loud, expected)["covered"]
    stack = evaluate(report, {"gain": truth["gain"]}, float("inf"), loud, expected)
    bound = record["limit"]["gain"] / truth["gain"] if "limit" in record else None
    setting = name.split("/", 1)[1] if study == "sensors" else ""
    return stack | {"covered": held, "setting": setting, "bound": bound}


def measure(program, pattern, line, size, seed):
    """Returns the results of all cases that match a pattern. line: text from which their seeds are derived."""
    options = ["--first-seed", stream_of(line, seed), "--size", size, "--threads", 1]
    done = run([program, pattern, *options])
    stacks = [evaluate_record(json.loads(text)) for text in done.output.splitlines()]
    return [stack | {"seconds": done.seconds / len(stacks)} for stack in stacks]


def names_of(program, study):
    """Returns the distinct names of the cases and lines of a study, without the scene."""
    names = [text.split("  ")[0].split("/") for text in run([program, "--list", f"{study}/*"]).output.splitlines()]
    return list(dict.fromkeys(name[1] for name in names))
