# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Prints the table of the check study.

It shows how many noise models fit another burst of their camera, how many models with a slope that is 5 % too steep do
not fit, and the range of the variance over the model.
"""

from study_records import by_case, case_of, text_of_fraction


def row(label, records):
    models = [record for record in records if record["has_model"]]
    fits = sum(record["verdict"] == "fits" for record in models)
    seen = sum(record["verdict_of_wrong_slope"] == "does-not-fit" for record in models)
    ratios = [ratio for record in models for ratio in record["variance_over_model"] if ratio is not None]
    span = f"{min(ratios):.3f} to {max(ratios):.3f}" if ratios else "-"
    count = len(models)
    return f"{label:<21} {text_of_fraction((fits, count), 9)} {text_of_fraction((seen, count), 12)}   {span}"


def print_table(records):
    print(f"{'experiment and scene':<21} {'fits':>9} {'5 % wrong':>12}   variance/model, all bands")
    for group in by_case(records):
        _, experiment, scene = case_of(group[0])
        print(row(f"{experiment:<12} {scene}", group))
    print(row("all", records))
