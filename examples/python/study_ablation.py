# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Switches off one mechanism of the refined method at a time, and prints the losses as a Markdown table.

    cmake -S . -B build -DSensorNoise_BUILD_INFLUENCE=ON && cmake --build build --target measure-varied-stack
    python examples/python/study_ablation.py --bin build/bin --seeds 3 --lines 'drawn/*'

The constants of a test switch its mechanism off: with a threshold of 10^9 no effect is large enough. Bursts are
the situations of measure_acceptance.py whose pixels have 16 bits. Each burst is made once, and is measured as it is and
without each mechanism. The columns:

    changed    bursts whose report changes by more than 0.05 of a standard error, in a status or in a warning
    refused    bursts whose gain is measured with the mechanism and refused without it, and the reverse
    wrong      bursts with a wrong quantity: with the mechanism, and without it (acceptance_stacks.py has the limits)
    held       95 % intervals of gain, offset and read noise that contain the truth: with it, and without it
    error      mean absolute error of the gain without it over the one with it, of bursts measured both times [1]
    lines      the kinds of burst with one that becomes wrong or refused without it
"""

import argparse
import fnmatch
import json
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np
import situations_all
from acceptance_programs import run
from acceptance_stacks import evaluate
from study_influence import effect_on
from study_records import mean

NONE, ALL = 1e9, 1e-9  # factors of a threshold that no effect exceeds, and that each exceeds


class Mechanism(NamedTuple):
    """Part of the method, and the factors of constants that switch it off."""

    name: str
    section: str  # number in the derivation
    off: dict[str, float]


MECHANISMS = (
    Mechanism("trim of outliers", "3.6", {"InPixels.trimTail": 1e-11}),
    Mechanism("misfit of neighbourhoods", "3.5", {"InPixels.leastNeighbourhoodExcess": NONE}),
    Mechanism("roughness classes", "3.5", {"InPixels.leastClassExcess": NONE, "InPixels.leastClassOutliers": NONE}),
    Mechanism("pixels compared at their own levels", "3.5", {"InPixels.leastPixelsOfLevel": NONE}),
    Mechanism("quiet pixels", "3.5", {"InPixels.leastQuietFraction": ALL}),
    Mechanism("defective pixels", "3.5", {"InMoments.defectiveNoiseFactor": 1e3}),
    Mechanism("guard band at the clip levels", "3.2", {"InScene.guardBandSds": ALL}),
    Mechanism("full wells", "3.2", {"InScene.reachOfFullWells": ALL}),
    Mechanism("masked border", "3.2", {"InScene.largestBorder": ALL}),
    Mechanism("scene changes", "3.1", {"InMoments.sceneChangeFraction": NONE}),
    Mechanism("frames unlike the others, by their cells", "3.1", {"InMoments.unlikeZ": NONE}),
    Mechanism(
        "frames of other noise",
        "3.14",
        {
            "InRefined.leastUnlikeNoise": NONE,
            "InRefined.leastUnlikeUnderLocalIllumination": NONE,
            "InRefined.leastUnlikeUnderMotion": NONE,
        },
    ),
    Mechanism("photon transfer of the frames", "3.14", {"InRefined.leastFrameContrast": NONE}),
    Mechanism("third order of the motion", "3.3", {"InSeries.framesForThirdOrder": 1e3}),
    Mechanism("local illumination", "3.4", {"InSeries.edgeOfNoise": NONE}),
    Mechanism("illumination of lines", "3.18", {"InCorrelation.leastLeftOfLine": NONE}),
    Mechanism("rest of the illumination of lines", "3.18", {"InRefined.leastLineIllumination": NONE}),
    Mechanism("local motion, by tiles", "3.7", {"InPattern.leastLocalMotion": NONE}),
    Mechanism("drift of local offsets", "3.7", {"InPattern.leastDriftExplained": NONE}),
    Mechanism("fixed pattern by levels", "3.7", {"InPattern.fewestPatternTiles": NONE}),
    Mechanism("fixed pattern beside flicker", "3.5", {"InPixels.largestDsnuEffect": NONE}),
    Mechanism("gains of parts", "3.15", {"InParts.fewestTiles": NONE}),
    Mechanism("steps of the variance", "3.16", {"InSteps.leastSize": NONE}),
    Mechanism("curve of the response", "3.8", {"InRefined.largestNonlinearity": NONE}),
    Mechanism("error of a curve", "3.8", {"InRefined.errorOfNonlinearity": ALL}),
    Mechanism("rounding that depends on the noise", "3.6", {"InPixels.errorOfQuantisationNoise": ALL}),
    Mechanism("feedback of the level on the variance", "3.5", {"InPixels.leastFeedback": NONE}),
    Mechanism("sum over the lags", "3.12", {"InCorrelation.leastEffect": NONE, "InCorrelation.leastCoefficient": NONE}),
    Mechanism("error of unseen lags", "3.12", {"InCorrelation.unseenErrors": ALL}),
    Mechanism("correlation in time", "3.12", {"InCorrelation.leastTimeCoefficient": NONE}),
    Mechanism("interference", "3.12", {"InCorrelation.leastPeak": NONE}),
    Mechanism("repeated frames", "3.12", {"InRefined.largestRepeatedFraction": NONE}),
    Mechanism("computed pixels", "3.12", {"InCorrelation.leastInterpolated": NONE}),
    Mechanism("oscillation over the place", "3.12", {"InCorrelation.leastOscillation": NONE}),
    Mechanism(
        "shape of the noise",
        "3.12",
        {"InCorrelation.largestExcess": NONE, "InCorrelation.largestTailDeficit": NONE},
    ),
    Mechanism("motion left in the noise", "3.12", {"InCorrelation.leastLocalMotion": NONE}),
    Mechanism("errors of the motion", "3.3", {"InRefined.errorOfMotion": ALL, "InRefined.errorOfSharpEdges": ALL}),
    Mechanism("light in dark frames", "3.9", {"InRefined.leastSignalOfDark": NONE}),
    Mechanism("scores of cells", "3.6", {"InPattern.leastLikeness": NONE}),
)


class Outcome(NamedTuple):
    """Report of a burst, and its test."""

    report: dict
    stack: dict


def measure(program, burst, expected, folder, factors):
    """Returns the outcome of a burst with these factors of constants."""
    height, width = burst.frames.shape[1:]
    command = [program, folder / "burst.raw", "--size", f"{width},{height}"]
    if burst.dark is not None:
        command += ["--dark", folder / "dark.raw"]
    for name, factor in factors.items():
        command += ["--constant", f"{name}={factor}"]
    report = json.loads(run(command).output)
    names = {name: path for name, path in situations_all.COMPARED.items() if getattr(burst, name) is not None}
    truth = {name: float(getattr(burst, name)) for name in names}
    found = {name: situations_all.quantity_at(report, path) for name, path in names.items()}
    loud = [warning["code"] for warning in report["warnings"] if warning["severity"] != "note"]
    return Outcome(report, evaluate(found, truth, burst.signal_range, loud, expected))


def outcomes_of(program, situation, scene, seed, mechanisms):
    """Returns the outcomes of a burst: as it is, and without each mechanism; none for another pixel type."""
    burst = situations_all.make(situation, scene, seed)
    if burst.options or burst.frames.dtype != np.uint16:
        return []
    with tempfile.TemporaryDirectory(prefix="ablation-") as name:
        folder = Path(name)
        burst.frames.tofile(folder / "burst.raw")
        if burst.dark is not None:
            burst.dark.astype(np.uint16).tofile(folder / "dark.raw")
        factors = [{}, *(mechanism.off for mechanism in mechanisms)]
        return [measure(program, burst, situation.expected, folder, one) for one in factors]


def held(outcomes):
    """Returns how many intervals contain the truth, and how many there are."""
    intervals = [one for outcome in outcomes for one in outcome.stack["covered"].values()]
    return f"{sum(intervals)}/{len(intervals)}"


def row(mechanism, names, as_is, without):
    """Returns the row of a mechanism. names: the kind of each burst."""
    pairs = list(zip(as_is, without, strict=True))
    changed = sum(effect_on(off.report, on.report) == 2 for on, off in pairs)
    lost = [off.stack["refused"] and not on.stack["refused"] for on, off in pairs]
    gained = sum(on.stack["refused"] and not off.stack["refused"] for on, off in pairs)
    wrong = [bool(off.stack["wrong"]) and not on.stack["wrong"] for on, off in pairs]
    errors = [
        (abs(on.stack["error"]), abs(off.stack["error"]))
        for on, off in pairs
        if on.stack["error"] is not None and off.stack["error"] is not None
    ]
    ratio = mean(off for _, off in errors) / mean(on for on, _ in errors) if errors else float("nan")
    worse = sorted({name for name, a, b in zip(names, lost, wrong, strict=True) if a or b})
    number_wrong = [sum(bool(one.stack["wrong"]) for one in some) for some in (as_is, without)]
    return (
        f"| {mechanism.name} | {mechanism.section} | {changed} | {sum(lost)}, {gained} "
        f"| {number_wrong[0]}, {number_wrong[1]} | {held(as_is)}, {held(without)} | {ratio:.2f} | {', '.join(worse)} |"
    )


def main(arguments=None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=Path("build/bin"), help="folder of measure-varied-stack")
    parser.add_argument("--lines", nargs="+", default=["drawn/*"], metavar="PATTERN", help="names of situations")
    parser.add_argument("--mechanism", action="append", default=[], help="this one alone; may be repeated")
    parser.add_argument("--seeds", type=int, default=1, help="bursts of each situation and scene")
    parser.add_argument("--jobs", type=int, default=2, help="bursts at the same time")
    options = parser.parse_args(arguments)
    unknown = set(options.mechanism) - {mechanism.name for mechanism in MECHANISMS}
    if unknown:
        parser.error(f"no mechanism has the name {min(unknown)!r}; see MECHANISMS in {Path(__file__).name}")
    mechanisms = [one for one in MECHANISMS if not options.mechanism or one.name in options.mechanism]
    program = (options.bin / "measure-varied-stack").resolve()
    bursts = [
        one
        for one in situations_all.bursts(options.seeds)
        if any(fnmatch.fnmatch(one[0].name, pattern) for pattern in options.lines)
    ]
    with ThreadPoolExecutor(options.jobs) as executor:
        found = list(executor.map(lambda one: outcomes_of(program, *one, mechanisms), bursts))
    measured = [(one[0].name, outcomes) for one, outcomes in zip(bursts, found, strict=True) if outcomes]
    names = [name for name, _ in measured]
    print(f"{len(measured)} of {len(bursts)} bursts, the others have another pixel type or need options\n")
    print(
        "| mechanism | section | changed | refused | wrong | held | error | lines |\n|---|---|---|---|---|---|---|---|"
    )
    for k, mechanism in enumerate(mechanisms):
        as_is = [outcomes[0] for _, outcomes in measured]
        print(row(mechanism, names, as_is, [outcomes[k + 1] for _, outcomes in measured]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
