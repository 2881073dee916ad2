# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the effect of half and twice the constants of the refined method, as a Markdown table.

    cmake -S . -B build -DSensorNoise_BUILD_INFLUENCE=ON && cmake --build build --target measure-varied-cases
    python examples/python/study_influence.py --bin build/bin
    python examples/python/study_influence.py --bin build/bin --screen --seeds 1 --size 128

The first prints the twelve most influential ones. A cell has the mean error of the gain [%] ± the mean standard error,
the largest error over its standard error, and the number of stacks within 3 standard errors / the number of stacks
whose gain is identified. "=" means that no report changes. The run takes about half a second for each stack, constant,
value and processor.

The second counts the constants of each struct by their largest effect: "none", if no report changes; "little", if no
value changes by more than 0.05 of its standard error, no standard error by more than 5 %, and no status, warning or
noise class; "much". It takes about 0.2 s for each stack, constant and value.
"""

import argparse
import json
import sys
from collections import Counter
from pathlib import Path

from acceptance_programs import run
from study_records import estimate_of, mean

CASES = ("waving_quarter", "hot_pixels", "bleach_mixed", "shoulder+4", "brighter_fatter", "smoothed")
CONSTANTS = (
    *("Significance." + level for level in ("hint", "oneTest", "severalTests", "manyTests", "everyPixel")),
    *("InMoments.defectiveNoiseFactor", "InSeries.leastSignalFraction", "InSeries.edgeOfNoise"),
    *("InCorrelation.unseenErrors", "InRefined.leastVarianceInflation"),
    *("InRefined.errorOfNonlinearity", "InRefined.largestNonlinearity"),
)
FACTORS = (0.5, 2.0)
LITTLE = 0.05  # change of a value in standard errors, and of a standard error relative to it
EFFECTS = ("none", "little", "much")
LARGEST_Z = 3.0  # [standard errors]


def measure(program, case, options, *more):
    """Returns the records of a case, by their seeds."""
    command = [program, f"robustness/{case}/{options.scene}", "--seeds", options.seeds, "--size", options.size, *more]
    return [json.loads(line) for line in run(command).output.splitlines()]


def cell(records):
    gains = [one for one in (estimate_of(record, "gain") for record in records) if one.z is not None]
    if not gains:
        return f"0/{len(records)}"
    bias = mean(100 * one.error / one.truth for one in gains)
    error = mean(100 * one.standard_error / one.truth for one in gains)
    right = sum(abs(one.z) <= LARGEST_Z for one in gains)
    return f"{bias:+.2f} ± {error:.2f}, {max(abs(one.z) for one in gains):.1f}, {right}/{len(gains)}"


def quantities_of(part, path=()):
    """Yields path, value, standard error and status of all quantities of a report."""
    if isinstance(part, dict) and {"value", "standard_error"} <= part.keys():
        yield path, part["value"], part["standard_error"], part.get("status")
    elif isinstance(part, (dict, list)):
        for key, one in part.items() if isinstance(part, dict) else enumerate(part):
            yield from quantities_of(one, (*path, key))


def verdicts_of(report):
    warnings = [warning["code"] for warning in report["warnings"]]
    return warnings, report["frames_left_out"], (report["noise_correlation"] or {}).get("kind")


def effect_on(new, old):
    """Returns the effect on a report, an index of EFFECTS."""
    if new == old:
        return 0
    news, olds = list(quantities_of(new)), list(quantities_of(old))
    if verdicts_of(new) != verdicts_of(old) or len(news) != len(olds):
        return 2
    for (new_path, value, error, status), (path, old_value, old_error, old_status) in zip(news, olds, strict=True):
        if (new_path, status, value is None, error is None) != (path, old_status, old_value is None, old_error is None):
            return 2
        if value is not None and old_error and abs(value - old_value) > LITTLE * old_error:
            return 2
        if error is not None and abs(error - old_error) > LITTLE * old_error:
            return 2
    return 1


def screen(program, cases, as_is, options):
    """Prints the number of constants of each struct with each effect."""
    counts = {}
    for name in constants_of(program, options.constant):
        effects = [0]
        for case in cases:
            for factor in FACTORS:
                new = measure(program, case, options, "--constant", f"{name}={factor}")
                effects += [effect_on(a["report"], b["report"]) for a, b in zip(new, as_is[case], strict=True)]
        counts.setdefault(name.split(".")[0], Counter())[EFFECTS[max(effects)]] += 1
    print("| struct |" + "".join(f" {effect} |" for effect in EFFECTS) + "\n|---|" + "---|" * len(EFFECTS))
    for struct, of_struct in counts.items():
        print(f"| {struct} |" + "".join(f" {of_struct[effect]} |" for effect in EFFECTS))


def constants_of(program, names):
    """Returns name and value of the constants that the program lists."""
    lines = run([program, "--list-constants"]).output.splitlines()
    known = {line.split()[0]: float(line.split()[1]) for line in lines}
    missing = set(names) - set(known)
    if missing:
        raise SystemExit(f"error: no constant has the name {min(missing)}; known are {', '.join(known)}")
    return {name: value for name, value in known.items() if not names or name in names}


def main(arguments=None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=Path("build/bin"), help="folder of measure-varied-cases")
    parser.add_argument("--constant", action="append", default=[], help="this one alone; may be repeated")
    parser.add_argument("--screen", action="store_true", help="count the constants by their effect; default: all")
    parser.add_argument("--cases", default=",".join(CASES), help="names of robustness cases, with commas between them")
    parser.add_argument("--scene", default="texture", choices=("target", "texture"))
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--size", type=int, default=256, help="width and height [pixels]")
    options = parser.parse_args(arguments)
    program = (options.bin / "measure-varied-cases").resolve()
    cases = options.cases.split(",")
    as_is = {case: measure(program, case, options) for case in cases}
    if options.screen:
        screen(program, cases, as_is, options)
        return 0
    print("| constant | value |" + "".join(f" {case} |" for case in cases) + "\n|---|---|" + "---|" * len(cases))
    print("| as they are | |" + "".join(f" {cell(as_is[case])} |" for case in cases))
    changed = count = 0
    for name, value in constants_of(program, options.constant or CONSTANTS).items():
        for factor in FACTORS:
            cells = []
            for case in cases:
                records = measure(program, case, options, "--constant", f"{name}={factor}")
                different = sum(new["report"] != old["report"] for new, old in zip(records, as_is[case], strict=True))
                changed, count = changed + different, count + len(records)
                cells.append(cell(records) if different else "=")
            print(f"| {name} | {factor * value:.4g} |" + "".join(f" {text} |" for text in cells), flush=True)
    print(f"\n{changed} of {count} reports changed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
