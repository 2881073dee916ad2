# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Prints the efficiency study next to Tables 2 and 3 of Sur & Grédiac 2015.

The columns are the mean and twice the standard deviation over the seeds, and the numbers of the paper for its method.
Figure 6 is the same with --frames 10, 20, 50 and so on.
"""

from statistics import fmean, stdev

from study_records import by_case, case_of, estimate_of, mean, present, text_of

QUANTITIES = ("gain", "offset", "read_noise", "intercept", "flicker_sd", "vibration_sd_x", "vibration_sd_y")
# Mean and twice the standard deviation over 50 runs, in the order of QUANTITIES. Table 2 is for the synthetic target of
# the paper, Table 3 for its image Boat. Cells that are not readable in the available text of the paper are empty.
TABLES = {
    "target": {
        "A1": "5.00±0.03 200.1±0.6 15.2±0.4 -769.6±15.7 0.10±0.01 0.35±0.07 0.23±0.04",
        "A2": "5.00±0.01 199.9±4.6 15.0±0.8 -775.3±7.5 0.010±0.01 0.11±0.02 0.054±0.007",
        "A3": "5.00±0.01 200.0±1.0 15.0±0.3 -775.7±10.3 0.050±0.007 0.011±0.003 0.022±0.004",
        "B1": "1.00±0.00 100.0±0.3 8.2±0.1 -33.6±1.9 0.10±0.02 0.28±0.14 0.22±0.05",
        "B2": "1.01±0.00 99.6±3.1 8.0±0.2 -35.9±2.3 0.010±0.002 0.11±0.02 0.054±0.008",
        "B3": "1.00±0.00 100.0±0.6 8.0±0.1 -36.0±2.2 0.050±0.007 0.011±0.003 0.021±0.003",
        "C1": "0.300±0.000 40.0±0.1 3.34±0.13 -0.84±0.88 0.098±0.015 0.21±0.05 0.21±0.06",
        "C2": "0.300±0.001 40.0±1.1 3.00±0.12 -3.03±0.73 0.010±0.001 0.11±0.02 0.054±0.009",
        "C3": "0.300±0.000 40.0±0.2 3.02±0.10 -2.88±0.62 0.050±0.006 0.011±0.003 0.022±0.004",
    },
    "texture": {
        "A1": "5.06±0.02 200.3±8.1 16.4±1.6 -744±28 0.10±0.01 0.34±0.06 -",
        "A2": "- 218.3±85.2 16.5±14.8 - - 0.11±0.02 -",
        "A3": "- 198.7±19.0 14.6±3.3 -780±31 0.050±0.007 - -",
        "B1": "1.05±0.02 100.2±3.2 10.7±1.3 11.4±30 0.10±0.01 - -",
        "C1": "0.345±0.015 - - 50.4±28.8 - 0.33±0.10 0.20±0.05",
        "C2": "0.326±0.012 51.6±136 2.63±5.97 -9.22±10.8 0.010±0.001 - 0.052±0.007",
        "C3": "0.301±0.002 40.1±12.8 3.03±0.97 -2.65±3.90 0.050±0.007 0.011±0.006 0.019±0.005",
    },
}


def print_experiment(records):
    _, experiment, scene = case_of(records[0])
    paper = TABLES.get(scene, {}).get(experiment, "").split() or ["-"] * len(QUANTITIES)
    for name, figure in zip(QUANTITIES, paper, strict=True):
        estimates = [estimate_of(record, name) for record in records]
        values = present(one.value for one in estimates)
        # The paper compares with the nominal standard deviations, the study with the realised ones of the stack.
        truth = fmean(one.truth for one in estimates)
        average = mean(values)
        print(
            f"{experiment if name == 'gain' else '':<4} {scene if name == 'gain' else '':<8} {name:<15}",
            text_of(truth, ".5g", 9),
            text_of(average, ".5g", 11),
            "±",
            f"{text_of(2 * stdev(values) if len(values) > 1 else None, '.3g'):<9}",
            text_of(None if average is None or not truth else 100 * (average / truth - 1), ".2f", 8),
            f"{f'{len(values)}/{len(records)}':>7}",
            f" {figure}",
        )


def print_table(records):
    print(
        f"{'exp.':<4} {'scene':<8} {'parameter':<15} {'truth':>9} {'mean':>11} ± {'2 sd':<9} {'bias %':>8} "
        f"{'n/N':>7}  paper"
    )
    for group in by_case(records):
        print_experiment(group)
