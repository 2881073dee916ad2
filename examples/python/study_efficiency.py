# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Prints the table of the efficiency study: how close the estimates come to the Cramér-Rao bound.

bias: mean error, in % of the truth. rms/lim: rms of error over limit; 1 is the best value of an unbiased estimate.
cover: fraction of the 95 % intervals that contain the truth. z-rms: rms of error over standard error, which should be
1. n/N: stacks whose quantity is identified.
"""

from study_records import by_case, case_of, estimate_of, mean, rms, text_of, used_fraction

QUANTITIES = ("gain", "intercept", "offset", "read_noise", "flicker_sd", "vibration_sd_x", "vibration_sd_y")
IDENTIFIABLE_LIMIT = 0.05  # the offset should be identified if its limit over the signal range is smaller [1]
# Errors of the vibration are printed relative to the larger of these: relative [1] and absolute [pixel].
VIBRATION_ERROR = (0.03, 0.0005)


def remark_on(name, records, estimates):
    if name == "gain":
        used = [used_fraction(record) for record in records]
        unclipped = mean(record["unclipped_fraction"] for record in records)
        return f"pixels used {mean(used):.3f} (least {min(used):.3f}), unclipped {unclipped:.3f}"
    if name == "offset":
        possible = [record["offset_limit_of_range"] for record in records]
        possible = [limit is not None and limit < IDENTIFIABLE_LIMIT for limit in possible]
        found = [one.error is not None for one, is_possible in zip(estimates, possible, strict=True) if is_possible]
        return f"limit < 5 % of range: {sum(possible)}, identified {sum(found)}"
    if name.startswith("vibration"):
        relative, absolute = VIBRATION_ERROR
        errors = [abs(one.error) / max(relative * one.truth, absolute) for one in estimates if one.error is not None]
        return f"worst {max(errors):.2f} of max(3 %, 0.0005 px)" if errors else ""
    return ""


def row(label, name, records, is_pooled):
    estimates = [estimate_of(record, name) for record in records]
    limits = [record["limit"][name] for record in records]
    relative = [one.error / abs(one.truth) if one.error is not None and one.truth else None for one in estimates]
    over_limit = [
        one.error / limit if one.error is not None and limit else None
        for one, limit in zip(estimates, limits, strict=True)
    ]
    bias, relative_rms = mean(relative), rms(relative)
    percent = None if relative_rms is None else 100 * relative_rms
    columns = [
        f"{label:<5} {name:<14}",
        text_of(None if is_pooled else mean(one.truth for one in estimates), ".5g", 9),
        text_of(None if bias is None else 100 * bias, "+.3f", 9),
        text_of(percent, ".3g", 8) + " %" if is_pooled else text_of(rms(one.error for one in estimates), ".3g", 10),
        text_of(rms(over_limit), ".2f", 8),
        text_of(mean(over_limit), "+.2f", 8),
        text_of(mean(one.is_held for one in estimates if one.interval), ".3f", 6),
        text_of(rms(one.z for one in estimates), ".2f", 7),
        f"{f'{sum(one.error is not None for one in estimates)}/{len(estimates)}':>8} ",
        remark_on(name, records, estimates),
    ]
    return " ".join(columns).rstrip()


def print_rows(label, records, is_pooled=False):
    """Prints one row for each quantity. Over several experiments the rms error is relative, as their true values
    differ."""
    for name in QUANTITIES if records else ():
        print(row(label if name == "gain" else "", name, records, is_pooled))


def print_table(records):
    print(
        f"{'exp.':<5} {'parameter':<14} {'truth':>9} {'bias %':>9} {'rms error':>10} {'rms/lim':>8} {'bias/lim':>8} "
        f"{'cover':>6} {'z-rms':>7} {'n/N':>8}  remark"
    )
    scenes = list(dict.fromkeys(case_of(record)[2] for record in records))
    for scene in scenes:
        print(f"scene {scene}")
        of_scene = [record for record in records if case_of(record)[2] == scene]
        groups = by_case(of_scene)
        for group in groups:
            experiment = case_of(group[0])[1]
            print_rows(f"{experiment}/{group[0]['plane']}" if "plane" in group[0] else experiment, group)
        if len(groups) > 1:
            for label, conditions in (("all", "123"), ("*2 *3", "23"), ("*1", "1")):
                print_rows(label, [one for one in of_scene if case_of(one)[1][1] in conditions], is_pooled=True)
