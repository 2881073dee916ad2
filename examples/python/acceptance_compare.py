# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Sums up the results of measure_acceptance.py for each line, and compares two results by paired differences.

Stacks with the same line, variant, setting, seed and recipe have the same noise and form a pair. A difference is
significant if it exceeds chance (CHANCE, student_factor) and a smallest size (SMALLEST_FRACTION, SMALLEST_ERROR). A
significant difference in silently wrong stacks alone decides the verdict. Otherwise a line is worse if any measure is
significantly worse, and better if a measure is better and none is worse.
"""

import math
import statistics
from collections import defaultdict
from typing import NamedTuple

from acceptance_lines import LINES, MEASURED, MUST_REFUSE
from scipy import stats

CHANCE = 3.0  # standard errors of a normal distribution: chance exceeds it in one difference of 370
LARGEST_ERROR = 1.0  # larger relative errors of the gain count as this one, so that no stack dominates a line [1]
SMALLEST_FRACTION = 0.05  # fraction of the stacks that must change: 1 in 20, as a 95 % interval misses [1]
SMALLEST_ERROR = 0.05  # fraction of the old mean error [1]: 10 % more frames change it as much (1 / sqrt(1.1) = 0.953)
NOMINAL_COVERAGE = 0.95  # coverage of the intervals of the report [1]
ALL_LINES = ", all lines"
HELD = ("gain", "offset", "read_noise", "linearity_error")  # quantities whose intervals are counted
LEAST_NAMED = 0.95  # least fraction of the frames unlike the others that must be named [1]
# Probability of a result by chance, below which it is a fault: low coverage, or errors larger than EMVA's.
IMPROBABLE = 0.001


def student_factor(dof):
    """Returns the standard errors that Student's t exceeds as often as a normal variable exceeds CHANCE."""
    return float(stats.t.isf(stats.norm.sf(CHANCE), dof))


def lower_tail(met, count, probability):
    """Returns the binomial probability of at most `met` successes in `count` trials."""
    return float(stats.binom.cdf(met, count, probability))


def by_line(stacks):
    """Returns the stacks of each line, by their keys: first the lines of LINES, then the lines of studies."""
    lines = defaultdict(dict)
    for key, stack in stacks.items():
        lines[key[0]][key] = stack
    places = {line.name: place for place, line in enumerate(LINES)}
    return {name: lines[name] for name in sorted(lines, key=lambda name: (places.get(name, len(places)), name))}


def by_kind(lines):
    """Returns the stacks of all lines of a kind. The kind is the part of the name before the slash."""
    kinds = defaultdict(dict)
    for name, line in lines.items():
        kinds[name.split("/")[0] + ALL_LINES] |= line
    return kinds


def held(stacks, name):
    found = [stack["covered"][name] for stack in stacks if name in stack["covered"]]
    return sum(found), len(found)


def named(stacks):
    """Returns how many of the frames unlike the others are named, and how many there are."""
    return tuple(sum(stack.get(name, 0) for stack in stacks) for name in ("named", "unlike"))


def size_of(stack):
    return None if stack["error"] is None else min(abs(stack["error"]), LARGEST_ERROR)


def errors_beside_emva(stacks):
    """Returns pairs of relative errors of the gain, ours and EMVA's photon transfer, for stacks that have both [1]."""
    both = [(stack["error"], stack.get("emva_error")) for stack in stacks]
    return [(ours, theirs) for ours, theirs in both if ours is not None and theirs is not None]


def rms_over_emva(pairs):
    """Returns the rms error of the gain over the rms error of EMVA's photon transfer [1]; None without pairs."""
    theirs = sum(error**2 for _, error in pairs)
    return math.sqrt(sum(error**2 for error, _ in pairs) / theirs) if theirs else None


def summarise(stacks):
    """Returns a line of the table: counts and means over its stacks; None for an unknown value."""
    errors = [size_of(stack) for stack in stacks if stack["error"] is not None]
    ratios = [stack["error"] / stack["bound"] for stack in stacks if stack["error"] is not None and stack["bound"]]
    row = {
        "stacks": len(stacks),
        "error": statistics.fmean(errors) if errors else None,
        "over_bound": math.sqrt(statistics.fmean(ratio**2 for ratio in ratios)) if ratios else None,
        "over_emva": rms_over_emva(errors_beside_emva(stacks)),
        "held": {name: held(stacks, name) for name in HELD},
        "named": named(stacks),
        "named_falsely": sum(stack.get("named_falsely", 0) > 0 for stack in stacks),
        "refused": sum(stack["refused"] for stack in stacks),
        "wrong": sum(bool(stack["wrong"]) for stack in stacks),
        "silent": sum(stack["silent"] for stack in stacks),
        "seconds": statistics.fmean(stack["seconds"] for stack in stacks),
    }
    return row | {"faults": faults_of(row, stacks)}


def faults_of(row, stacks):
    """Returns the faults of a line: results that it should not show."""
    unexpected = sum(stack["refused"] for stack in stacks if stack["expected"] == MEASURED)
    faults = [name for name in ("silent", "wrong") if row[name]][:1]
    if unexpected:
        faults.append(f"refused {unexpected}")
    count = len(errors_beside_emva(stacks))
    if row["over_emva"] and row["over_emva"] ** 2 > stats.f.isf(IMPROBABLE, count, count):
        faults.append("above EMVA")
    for name, (met, count) in row["held"].items():
        if count and lower_tail(met, count, NOMINAL_COVERAGE) < IMPROBABLE:
            faults.append(f"coverage of {name}")
    met, count = row["named"]
    if met < LEAST_NAMED * count:
        faults.append("frames not named")
    if row["named_falsely"]:
        faults.append(f"named falsely {row['named_falsely']}")
    return faults


def scatter_of(differences):
    """Returns the standard error of the mean difference: the larger one of two estimates, from the scatter of the
    single stacks and from the scatter of their groups.

    differences: (group, difference). The settings of a study that have the noise of the same seed are a group."""
    values = [value for _, value in differences]
    error = statistics.stdev(values) / math.sqrt(len(values))
    groups = defaultdict(list)
    for group, value in differences:
        groups[group].append(value)
    if len(groups) > 1 and len(groups) < len(values):
        mean = statistics.fmean(values)
        squares = sum(sum(value - mean for value in group) ** 2 for group in groups.values())
        error = max(error, math.sqrt(squares * len(groups) / (len(groups) - 1)) / len(values))
    return error


class Difference(NamedTuple):
    """Mean of new less old, its standard error and the degrees of freedom of the error, and the number of pairs that
    differ."""

    mean: float
    error: float
    dof: int
    changed: int


def paired(pairs, measure, is_count):
    """Returns the difference of a measure over pairs of (group, old, new); None without pairs.

    is_count: the differences are -1, 0 or 1. One difference of each sign is then added to the scatter, so that a few
    equal changes do not look certain."""
    both = [(group, measure(old), measure(new)) for group, old, new in pairs]
    differences = [(group, new - old) for group, old, new in both if old is not None and new is not None]
    if not differences:
        return None
    mean = statistics.fmean(value for _, value in differences)
    changed = sum(value != 0 for _, value in differences)
    if is_count:
        differences = [*differences, ("one", 1.0), ("other", -1.0)]
    dof = len(differences) - 1
    return Difference(mean, scatter_of(differences) if dof else math.inf, dof, changed)


def coverage_of(stack):
    """Returns the fraction of the intervals that contain the truth."""
    return statistics.fmean(stack["covered"].values()) if stack["covered"] else None


MEASURES = {
    "silent": (lambda stack: float(stack["silent"]), True),
    "wrong": (lambda stack: float(bool(stack["wrong"])), True),
    "refused": (lambda stack: float(stack["refused"]), True),
    "error": (size_of, False),
    "coverage": (coverage_of, True),
}


def direction(name, difference, old_error):
    """Returns the direction of the difference of a measure: -1: worse, 1: better, 0: no significant difference."""
    if difference is None or not difference.changed or not difference.dof:
        return 0
    size = abs(difference.mean)
    smallest = SMALLEST_ERROR * (old_error or 0.0) if name == "error" else SMALLEST_FRACTION
    if size <= smallest or size <= difference.error * student_factor(difference.dof):
        return 0
    return (1 if difference.mean > 0 else -1) * (1 if name == "coverage" else -1)


def compare_line(old, new):
    """Returns the paired differences of a line and its verdict; None if no stack is in both results."""
    keys = [key for key in old if key in new]
    if not keys:
        return None
    # Stacks with the same line, variant and seed have the same noise: they are a group.
    pairs = [((line, variant, seed), old[key], new[key]) for key in keys for line, variant, _, seed, _ in [key]]
    differences = {name: paired(pairs, measure, is_count) for name, (measure, is_count) in MEASURES.items()}
    old_errors = [size_of(stack) for _, stack, _ in pairs if stack["error"] is not None]
    must_refuse = any(stack["expected"] == MUST_REFUSE for _, _, stack in pairs)
    signs = {
        name: direction(name, difference, statistics.fmean(old_errors) if old_errors else None)
        for name, difference in differences.items()
        if not (must_refuse and name in ("refused", "error", "coverage"))
    }
    seconds = statistics.median(after["seconds"] / max(before["seconds"], 1e-3) for _, before, after in pairs)
    silent = tuple(sum(pair[place]["silent"] for pair in pairs) for place in (1, 2))
    return {"stacks": len(keys), "differences": differences, "time": seconds, "silent": silent, **verdict_of(signs)}


def verdict_of(signs):
    """Returns the verdict, and the measures that decide it."""
    if signs["silent"]:
        return {"verdict": "better" if signs["silent"] > 0 else "worse", "by": ["silent"]}
    for verdict, sign in (("worse", -1), ("better", 1)):
        if by := [name for name, value in signs.items() if value == sign]:
            return {"verdict": verdict, "by": by}
    return {"verdict": "same", "by": []}


def compare(old, new):
    """Returns the comparison of each line, and of all lines of a kind, with stacks in both results."""
    old_lines, new_lines = (lines | by_kind(lines) for lines in map(by_line, (old, new)))
    compared = {name: compare_line(old_lines[name], new_lines[name]) for name in old_lines if name in new_lines}
    return {name: line for name, line in compared.items() if line}
