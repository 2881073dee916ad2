# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Sums up the results of measure_acceptance.py line by line, and compares two: paired differences with their scatter.

Stacks are paired by line, variant, setting, seed and recipe, and so have the same noise. A difference counts if it is
beyond chance (CHANCE, student_factor) and above a smallest size (SMALLEST_FRACTION, SMALLEST_ERROR). Silently wrong
stacks decide the verdict first: where their number changes, nothing else counts. Otherwise a line is worse if any
measure is worse, and better if some measure is better and none is worse.
"""

import math
import statistics
from collections import defaultdict
from typing import NamedTuple

from acceptance_lines import LINES, MEASURED, MUST_REFUSE
from scipy import stats

CHANCE = 3.0  # standard errors, as of a normal distribution: one difference in 370 by chance
LARGEST_ERROR = 1.0  # a gain that is off by more counts as off by so much, lest one stack decides a line [1]
SMALLEST_FRACTION = 0.05  # of the stacks: 1 in 20 has to change, the fraction that a 95 % interval misses [1]
SMALLEST_ERROR = 0.05  # of the old mean error [1]: a tenth of the frames makes as much (1 / sqrt(1.1) = 0.953)
NOMINAL_COVERAGE = 0.95  # of the report's intervals [1]
ALL_LINES = ", all lines"
HELD = ("gain", "offset", "read_noise", "linearity_error")  # quantities whose intervals are counted
LEAST_NAMED = 0.95  # demanded fraction of the frames unlike the others that are named [1]
# Probability below which it is a fault that so few intervals hold the truth, or that errors are so much above EMVA's.
IMPROBABLE = 0.001


def student_factor(dof):
    """Standard errors that Student's t exceeds as often as a normal variable exceeds CHANCE."""
    return float(stats.t.isf(stats.norm.sf(CHANCE), dof))


def lower_tail(met, count, probability):
    """Probability of at most `met` of `count`, by the binomial distribution."""
    return float(stats.binom.cdf(met, count, probability))


def by_line(stacks):
    """The stacks of each line, by their keys; first the lines of LINES, then those of studies."""
    lines = defaultdict(dict)
    for key, stack in stacks.items():
        lines[key[0]][key] = stack
    places = {line.name: place for place, line in enumerate(LINES)}
    return {name: lines[name] for name in sorted(lines, key=lambda name: (places.get(name, len(places)), name))}


def by_kind(lines):
    """The stacks of all lines of a kind: what stands before the slash."""
    kinds = defaultdict(dict)
    for name, line in lines.items():
        kinds[name.split("/")[0] + ALL_LINES] |= line
    return kinds


def held(stacks, name):
    found = [stack["covered"][name] for stack in stacks if name in stack["covered"]]
    return sum(found), len(found)


def named(stacks):
    """How many of the frames unlike the others are named, and how many there are."""
    return tuple(sum(stack.get(name, 0) for stack in stacks) for name in ("named", "unlike"))


def size_of(stack):
    return None if stack["error"] is None else min(abs(stack["error"]), LARGEST_ERROR)


def errors_beside_emva(stacks):
    """The errors of the gain, ours and those of EMVA's photon transfer, of the stacks that have both."""
    both = [(stack["error"], stack.get("emva_error")) for stack in stacks]
    return [(ours, theirs) for ours, theirs in both if ours is not None and theirs is not None]


def rms_over_emva(pairs):
    """Rms error of the gain over that of EMVA's photon transfer; None without pairs."""
    theirs = sum(error**2 for _, error in pairs)
    return math.sqrt(sum(error**2 for error, _ in pairs) / theirs) if theirs else None


def summarise(stacks):
    """A line of the table: counts and means over its stacks; None where nothing is known."""
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
    """The faults of a line: results that it should not show."""
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
    """Standard error of the mean difference: the larger of that from the single stacks and that from their groups.

    differences: (group, difference). The settings of a study share the noise of a seed: they are a group."""
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
    """Mean of new less old, its standard error, the degrees of freedom of that, and how many pairs differ."""

    mean: float
    error: float
    dof: int
    changed: int


def paired(pairs, measure, is_count):
    """The difference of a measure over pairs, as (group, old, new); None without pairs.

    is_count: differences are -1, 0 or 1. One of each sign is added to their scatter, so that a few stacks that all
    change alike do not look certain."""
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
    """Fraction of the intervals that hold the truth."""
    return statistics.fmean(stack["covered"].values()) if stack["covered"] else None


MEASURES = {
    "silent": (lambda stack: float(stack["silent"]), True),
    "wrong": (lambda stack: float(bool(stack["wrong"])), True),
    "refused": (lambda stack: float(stack["refused"]), True),
    "error": (size_of, False),
    "coverage": (coverage_of, True),
}


def direction(name, difference, old_error):
    """-1: worse, 1: better, 0: the same, of one measure."""
    if difference is None or not difference.changed or not difference.dof:
        return 0
    size = abs(difference.mean)
    smallest = SMALLEST_ERROR * (old_error or 0.0) if name == "error" else SMALLEST_FRACTION
    if size <= smallest or size <= difference.error * student_factor(difference.dof):
        return 0
    return (1 if difference.mean > 0 else -1) * (1 if name == "coverage" else -1)


def compare_line(old, new):
    """Paired differences of a line and its verdict; None if no stack is in both."""
    keys = [key for key in old if key in new]
    if not keys:
        return None
    # Stacks of one line, variant and seed share their noise: they are a group.
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
    """The verdict, and the measures behind it."""
    if signs["silent"]:
        return {"verdict": "better" if signs["silent"] > 0 else "worse", "by": ["silent"]}
    for verdict, sign in (("worse", -1), ("better", 1)):
        if by := [name for name, value in signs.items() if value == sign]:
            return {"verdict": verdict, "by": by}
    return {"verdict": "same", "by": []}


def compare(old, new):
    """The comparison of each line, and of all lines of a kind, that has stacks in both results."""
    old_lines, new_lines = (lines | by_kind(lines) for lines in map(by_line, (old, new)))
    compared = {name: compare_line(old_lines[name], new_lines[name]) for name in old_lines if name in new_lines}
    return {name: line for name, line in compared.items() if line}
