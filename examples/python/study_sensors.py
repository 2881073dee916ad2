# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Prints the table of the sensor study: sensors that deviate from the noise model as real sensors do.

A row is a setting: n stacks; failed gains; 95 % intervals that contain the truth, of identified quantities, for gain g,
offset mu, flicker fl and read noise rn; rms and mean of error over standard error; mean standard error and mean error
of the gain [%]; p: probability of so few intervals or fewer, at a coverage of 95 % for each gain;
upper limits above the flicker if it is not distinguished from 0; bounds that contain the offset; warnings with the
number of stacks. The last row has all settings of a line together. The demands of study_demands.py on them follow.
"""

from collections import Counter, defaultdict

from acceptance_compare import NOMINAL_COVERAGE, lower_tail
from study_demands import LEAST_COVERAGE, demands_on
from study_records import (
    by_case,
    case_of,
    count_met,
    estimate_of,
    mean,
    rms,
    text_of,
    text_of_fraction,
    warnings_of,
)

IMPROBABLE_SETTING = 0.001  # probability below which a single setting is counted as improbable
LARGEST_COVERAGE = 0.99  # above it intervals are wider than necessary, which is no fault
ENOUGH_STACKS = 200  # number of stacks from which too wide intervals are not due to chance
SUMMARISED = ("gain", "offset", "flicker_sd", "read_noise")


def line_of(record):
    """Returns the line of settings of a record, and its setting."""
    return case_of(record)[1].split("/", 1)


def percent_of(values):
    value = mean(values)
    return None if value is None else 100 * value


def statistics_of(records, name):
    """Returns the statistics of the estimates of a quantity, as a dictionary of numbers and fractions."""
    estimates = [estimate_of(record, name) for record in records]
    known = [one for one in estimates if one.error is not None and one.truth]
    held = count_met(one.is_held for one in estimates)
    return {
        "held": held,
        "z": rms(one.z for one in estimates),
        "mean z": mean(one.z for one in estimates),
        "standard error": percent_of(one.standard_error / abs(one.truth) for one in known if one.standard_error),
        "bias": percent_of(one.error / abs(one.truth) for one in known),
        "p": lower_tail(*held, NOMINAL_COVERAGE) if held[1] else None,
        "limits": count_met(one.is_below_limit for one in estimates),
        "bounds": count_met(one.is_within_bounds for one in estimates),
    }


def count_failed(records):
    return sum(estimate_of(record, "gain").status == "failed" for record in records)


def texts_of(counter):
    return ", ".join(f"{name} {count}" for name, count in sorted(counter.items())) or "-"


def print_setting(records):
    _, setting = line_of(records[0])
    gain, offset, flicker, read_noise = (statistics_of(records, name) for name in SUMMARISED)
    classes = Counter((record["report"]["noise_correlation"] or {}).get("kind") for record in records)
    warnings = Counter(code for record in records for code in warnings_of(record))
    columns = [
        f"{setting:<58} {case_of(records[0])[2]:<7} {len(records):4} {count_failed(records):4} |",
        text_of_fraction(gain["held"], 7),
        text_of(gain["z"], ".2f", 5),
        text_of(gain["mean z"], "+.2f", 6),
        text_of(gain["standard error"], ".3g", 7),
        text_of(gain["bias"], "+.3g", 7),
        text_of(gain["p"], ".2g", 7),
        f"| {text_of_fraction(offset['held'], 7)} {text_of(offset['z'], '.2f', 5)}",
        f"| {text_of_fraction(flicker['held'], 7)} {text_of(flicker['z'], '.2f', 5)}",
        text_of_fraction(flicker["limits"], 5),
        f"| {text_of_fraction(read_noise['held'], 7)} {text_of(read_noise['z'], '.2f', 5)}",
        f"| {text_of_fraction(offset['bounds'], 7)} | {texts_of(warnings)}; noise {texts_of(classes)}",
    ]
    print(" ".join(columns))


def print_demand(demand, settings):
    single = [count_met(map(demand.test, records)) for records in settings]
    met, count = (sum(values) for values in zip(*single, strict=True))
    fraction = met / count if count else None
    verdict = (
        "no stack counts"
        if fraction is None
        else "MISS"
        if fraction < demand.least
        else "ok, above 99 %"
        if demand.least == LEAST_COVERAGE and fraction > LARGEST_COVERAGE and count >= ENOUGH_STACKS
        else "ok"
    )
    expected = "all," if demand.least == 1 else "at least"
    print(
        f"  {demand.what:<58} {text_of_fraction((met, count), 11)} "
        f"{text_of(None if fraction is None else 100 * fraction, '.1f', 6)} %  "
        f"expected {expected} {100 * demand.least:g} %: {verdict}"
    )
    tails = [
        (lower_tail(*pair, NOMINAL_COVERAGE), pair, records)
        for pair, records in zip(single, settings, strict=True)
        if pair[1]
    ]
    if demand.is_coverage and tails:
        least, pair, records = min(tails, key=lambda one: one[0])
        print(
            f"      smallest p (lower tail) of a single setting {least:.2g} ({text_of_fraction(pair)}: "
            f"{records[0]['case']}); below {IMPROBABLE_SETTING:g}: "
            f"{sum(one[0] < IMPROBABLE_SETTING for one in tails)} of {len(tails)} settings"
        )


def print_line(line, settings):
    print(
        f"\n{line}\n{'setting':<58} {'scene':<7} {'n':>4} {'fail':>4} | {'g held':>7} {'rms z':>5} {'mean z':>6} "
        f"{'s.e. %':>7} {'bias %':>7} {'p':>7} | {'mu held':>7} {'rms z':>5} | {'fl held':>7} {'rms z':>5} "
        f"{'limit':>5} | {'rn held':>7} {'rms z':>5} | {'bounds':>7} | warnings"
    )
    for records in settings:
        print_setting(records)
    together = [record for records in settings for record in records]
    failed = count_failed(together)
    print(
        f"{line}, all settings together: {len(together)} stacks, failed {failed} ({100 * failed / len(together):.1f} %)"
    )
    for name in SUMMARISED:
        found = statistics_of(together, name)
        print(
            f"  {name:<10} identified {found['held'][1]}, interval contains {text_of_fraction(found['held'])}, "
            f"rms z {text_of(found['z'], '.2f')}, mean z {text_of(found['mean z'], '+.2f')}, mean s.e. "
            f"{text_of(found['standard error'], '.3g')} %, bias {text_of(found['bias'], '+.3g')} %; upper limits hold "
            f"{text_of_fraction(found['limits'])}"
        )
    for demand in demands_on(line):
        print_demand(demand, settings)


def print_table(records):
    lines = defaultdict(list)
    for group in by_case(records):
        lines[line_of(group[0])[0]].append(group)
    for line, settings in lines.items():
        print_line(line, settings)
