# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Prints the two tables of measure_acceptance.py."""

from collections import Counter

from acceptance_compare import MEASURES, by_kind, by_line, compare, summarise

NONE = "-"


def cell(value, form, width):
    return f"{NONE if value is None else format(value, form):>{width}}"


def fraction(pair, width):
    met, count = pair
    return cell(f"{met}/{count}" if count else None, "", width)


def summary_row(name, row):
    columns = [
        f"{name:<32}{row['stacks']:6}",
        cell(None if row["error"] is None else 100 * row["error"], ".3g", 9),
        cell(row["over_bound"], ".3g", 9),
        cell(row["over_emva"], ".3g", 9),
        *(fraction(row["held"][quantity], 11) for quantity in ("gain", "offset", "read_noise")),
        fraction(row["held"]["linearity_error"], 10),
        fraction(row["named"], 8),
        f"{row['refused']:8}{row['wrong']:6}{row['silent']:7}{row['seconds']:7.2f}  ",
    ]
    return "".join(columns) + ", ".join(row["faults"])


def print_summary(stacks):
    """Prints one row for each line, and one row for all lines of a kind."""
    print(
        f"{'line':<32}{'stacks':>6}{'error %':>9}{'/bound':>9}{'/EMVA':>9}{'gain held':>11}{'offset':>11}"
        f"{'read noise':>11}{'linearity':>10}{'named':>8}{'refused':>8}{'wrong':>6}{'silent':>7}{'s':>7}  faults"
    )
    lines = by_line(stacks)
    for name, line in lines.items():
        print(summary_row(name, summarise(list(line.values()))))
    for name, line in by_kind(lines).items():
        print(summary_row(name, summarise(list(line.values())) | {"faults": []}))


def difference(found, scale, form, width):
    """Returns a mean difference with its standard error as text; = if no stack differs."""
    if found is None:
        return f"{NONE:>{width}}"
    if not found.changed:
        return f"{'=':>{width}}"
    return f"{format(scale * found.mean, form)} ± {format(scale * found.error, '.2g')}".rjust(width)


def comparison_row(name, line):
    differences = line["differences"]
    columns = [
        f"{name:<32}{line['stacks']:6}",
        difference(differences["error"], 100, "+.2g", 20),
        *(difference(differences[measure], 100, "+.0f", 12) for measure in MEASURES if measure != "error"),
        f"{line['time']:7.2f}  {line['verdict']}",
        f" ({', '.join(line['by'])})" if line["by"] else "",
    ]
    before, after = line["silent"]
    return "".join(columns) + (f", silent {before} -> {after}" if before != after else "")


def print_comparison(old, new):
    """Prints one row for each line: new less old, in % of the gain or of the stacks, with the standard error and the
    verdict."""
    counts = [measure for measure in MEASURES if measure != "error"]
    print(
        f"{'line':<32}{'stacks':>6}{'error %':>20}"
        + "".join(f"{name + ' %':>12}" for name in counts)
        + "   time  verdict"
    )
    compared = compare(old, new)
    for name, line in compared.items():
        print(comparison_row(name, line))
    verdicts = Counter(line["verdict"] for line in compared.values())
    print(", ".join(f"{verdicts[verdict]} {verdict}" for verdict in ("better", "same", "worse")))
    return verdicts
