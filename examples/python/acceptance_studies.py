# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs measure-efficiency, measure-robustness and measure-real-sensors for one seed, and reads what they print.

All three are read as they print, so that programs of older commits can be measured, too. They judge the gain alone as
wrong. measure-robustness prints z with one decimal and no interval: there an interval holds the truth if |z| is at most
HELD_Z.
"""

import csv
import re
import tempfile
from pathlib import Path

from acceptance_lines import MAY_REFUSE, MEASURED, MUST_REFUSE, stream_of
from acceptance_programs import run
from acceptance_stacks import WRONG_ERRORS, WRONG_SIZE, file_wrong, judge

HELD_Z = 1.96  # 95 % of normal errors [standard errors]
WARNING_CODES = Path(__file__).resolve().parents[2] / "module" / "include" / "sensornoise" / "WarningCodes.h"
EXPERIMENTS = tuple(f"{camera}{condition}" for camera in "ABC" for condition in (1, 2, 3))
NONE = "-"  # of a table: no number

ROBUSTNESS_ROW = re.compile(
    r"(?P<case>\S+) +(?P<scene>target|texture) +(?P<seed>\d+) +(?P<error>\S+) +(?P<z>\S+) +\S+ +\S+ +"
    r"(?P<offset>\S+) +(?P<offset_z>\S+) +(?:\[.*?\]|-) +(?P<status>[a-z-]+) +(?P<used>\S+) +\S+ +(?P<warnings>\S+)"
)
ROBUSTNESS_VERDICTS = {
    "failed as expected": MUST_REFUSE,
    "not refused": MUST_REFUSE,
    "no variance-not-affine": MUST_REFUSE,
    "processed": MAY_REFUSE,
}
SENSORS_ROW = re.compile(
    r"(?P<name>.+?) +(?P<scene>target|texture|flat) +(?P<frames>\d+) +1 +(?P<refused>\d+) \| "
    r"*(?P<gain>\S+) +\S+ +(?P<z>\S+) +\S+ +(?P<error>\S+) +\S+ \| *(?P<offset>\S+) +\S+ \| .*? \| "
    r"*(?P<read_noise>\S+) +\S+ \| [^|]* \| (?P<warnings>.*)"
)


def loud_codes(header=WARNING_CODES):
    """The codes of the warnings of severity warning and error, from the table of the same checkout."""
    entry = re.compile(r'WarningCode::\w+,\s*"([a-z-]+)",\s*Severity::(Warning|Error)')
    return {code for code, _ in entry.findall(header.read_text(encoding="utf-8"))}


def number(text):
    return None if text == NONE else float(text)


def wrong_gain(error, z):
    """Names of the wrong quantities: the gain, by its relative error and the ratio of that to the standard error."""
    return ["gain"] if error is not None and abs(error) > WRONG_SIZE["gain"] and abs(z or 0) > WRONG_ERRORS else []


def file_study(error, z, status, covered, warnings, expected):
    """The record of one stack. error: of the gain, relative, None if the gain is not identified; z: over its standard
    error; covered: by quantity, whether its interval holds the truth."""
    stack = {"refused": error is None, "status": status, "covered": covered, "error": error, "z": z}
    return file_wrong(stack, wrong_gain(error, z), warnings, expected)


def read_efficiency(rows, seconds):
    """The stacks of a table that measure-efficiency wrote by --csv, as dictionaries of text."""
    found, truth, limit = {}, {}, None
    for row in rows:
        name = row["parameter"]
        if name in ("gain", "offset", "read_noise"):
            value, error, low, high = (
                float(row[column]) if row[column] else None
                for column in ("estimate", "standard_error", "low95", "high95")
            )
            interval = None if low is None and high is None else (low, high)
            found[name] = {"value": value, "standard_error": error, "interval95": interval, "status": row["status"]}
            truth[name] = float(row["truth"])
        if name == "gain":
            limit = float(row["limit"]) / truth["gain"]
    stack = judge(found, truth, float("inf"), [], MEASURED)
    stack = file_wrong(stack, wrong_gain(stack["error"], stack["z"]), [], MEASURED)
    return [stack | {"setting": "", "seconds": seconds, "bound": limit}]


def read_robustness(text, seconds, loud):
    """The stack of a run of measure-robustness with one case, scene and seed."""
    lines = text.splitlines()
    rows = [row for row in map(ROBUSTNESS_ROW.fullmatch, lines) if row]
    if len(rows) != 1:
        raise ValueError(f"measure-robustness printed {len(rows)} runs; expected 1")
    row = rows[0]
    (summary,) = (line for line in lines[lines.index(row[0]) + 1 :] if line.startswith(f"{row['case']} "))
    expected = next((kind for verdict, kind in ROBUSTNESS_VERDICTS.items() if verdict in summary), MEASURED)
    z, offset_z = number(row["z"]), number(row["offset_z"])
    error = number(row["error"])
    covered = {name: abs(ratio) <= HELD_Z for name, ratio in (("gain", z), ("offset", offset_z)) if ratio is not None}
    warnings = [code for code in row["warnings"].split(",") if code in loud]
    status = "failed" if error is None else "identified"
    stack = file_study(None if error is None else error / 100, z, status, covered, warnings, expected)
    return [stack | {"setting": "", "seconds": seconds, "bound": None}]


def read_sensors(text, seconds, loud):
    """The stacks of a run of measure-real-sensors with one line and one seed, one for each setting."""
    stacks = []
    for row in filter(None, map(SENSORS_ROW.fullmatch, text.splitlines())):
        is_gain = row["gain"] != NONE
        error, z = (number(row["error"]) / 100, number(row["z"])) if is_gain else (None, None)
        status = "identified" if is_gain else "failed" if row["refused"] == "1" else "not-identifiable"
        covered = {name: row[name] == "1/1" for name in ("gain", "offset", "read_noise") if row[name] != NONE}
        codes = re.findall(r"([a-z-]+) \d+", row["warnings"].split("; noise")[0])
        warnings = [code for code in codes if code in loud]
        stack = file_study(error, z, status, covered, warnings, MAY_REFUSE)
        setting = f"{row['scene']}, {row['name']}, {row['frames']} frames"
        stacks.append(stack | {"setting": setting, "bound": None})
    if not stacks:
        raise ValueError("measure-real-sensors printed no setting")
    return [stack | {"seconds": seconds / len(stacks)} for stack in stacks]


def measure_efficiency(program, experiment, size, seed):
    with tempfile.TemporaryDirectory(prefix="acceptance-") as folder:
        name = Path(folder) / "stacks.csv"
        stream = stream_of(f"efficiency {experiment}", seed)
        options = ["--experiments", experiment, "--first-seed", stream, "--seeds", 1, "--size", size, "--threads", 1]
        done = run([program, *options, "--csv", name])
        with name.open(newline="") as file:
            return read_efficiency(list(csv.DictReader(file)), done.seconds)


def measure_robustness(program, case, scene, size, seed):
    stream = stream_of(f"robustness {case} {scene}", seed)
    options = ["--cases", case, "--reference", scene, "--first-seed", stream, "--size", size, "--threads", 1]
    done = run([program, *options])
    return read_robustness(done.output, done.seconds, loud_codes())


def measure_sensors(program, line, size, seed):
    stream = stream_of(f"sensors {line}", seed)
    done = run([program, "--line", line, "--seeds", 1, "--seed", stream, "--size", size, "--threads", 1])
    return read_sensors(done.output, done.seconds, loud_codes())


def names_of(program):
    """The cases or lines that a study lists."""
    return [line.split()[0] for line in run([program, "--list"]).output.splitlines() if line.strip()]
