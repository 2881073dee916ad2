# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests whether the report of a burst stabilises other frames of the camera, and whether the inverse is unbiased.

    measure_held_out.py [--size 256] [--frames 100] [--cameras ABC] [--scenes target,texture]

The cameras are A, B and C of Sur & Grédiac 2015, with two scenes. The conditions are 1 to 3, and steady illumination
without vibration, in which the offset is not identifiable. One burst gives a report for each of the two methods. Other
frames of the same camera follow, without flicker, at the same illumination and at a low one of at most 40 electrons.
Two deviations are printed for each band of the signal:

- the temporal variance of the transformed frames less the variance of the Poisson-Gaussian law for the true parameters;
  it may be 0.02 or 3 standard errors;
- the inverse of the mean over the transformed frames less the true signal [e-]; it may be 0.5 %, 0.02 e- or 3 standard
  errors.

The standard error of the variance has two parts. The first is from the held-out frames. The second is from the report:
the covariance of slope and intercept gives the error of the variance at the level of the band. It is 0 for the
published method, which reports no errors. The standard error of the mean is from the held-out frames, as the mean
hardly depends on the model. A deviation with * is too large. A deviation with ~ is allowed only because of the errors
of the report.
"""

import argparse
import warnings
from collections import defaultdict
from itertools import pairwise

import itk
import numpy as np

EDGES = np.array([0, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10002])  # edges of the signal bands [e-]
DIM_ELECTRONS = 40.0
STATIC = {"flicker_sd": 0.0, "vibration_sd": (0.0, 0.0)}
FEWEST_PIXELS = 30


def variance_after(signal, read_noise):
    """Returns the variance after the transform with the true parameters, for a mean signal and a read noise [e-]."""
    spread = 9 * np.sqrt(signal) + 30
    electrons = np.arange(max(0, int(signal - spread)), int(signal + spread))
    factorials = np.concatenate(([0.0], np.cumsum(np.log(np.arange(1, electrons[-1] + 1)))))[electrons]
    photons = np.exp(electrons * np.log(signal) - signal - factorials)
    z = np.linspace(-8, 8, 1601)
    normal = np.exp(-(z**2) / 2) / np.exp(-(z**2) / 2).sum()
    values = 2 * np.sqrt(np.maximum(0, electrons[:, None] + read_noise * z + 3 / 8 + read_noise**2))
    values -= photons @ values @ normal
    return photons @ values**2 @ normal


def law(signal, record):
    """Returns the variance after the transform for an array of mean signals [e-]. The quantization noise is part of the
    read noise."""
    read_noise = np.sqrt(record["read_noise"] ** 2 + 1 / 12) / record["gain"]
    grid = np.geomspace(1e-3, signal.max(), 80)
    return np.interp(np.log(signal), np.log(grid), [variance_after(value, read_noise) for value in grid])


def held_out(common, frames, seed=1000):
    """Returns frames without flicker at two illuminations, the mean signal of their pixels [e-], and the record of the
    camera."""
    stacks, signals = [], []
    for electrons in ({}, {"electrons": DIM_ELECTRONS}):
        stack, record = itk.simulate_sensor_noise(**{**common, **STATIC, **electrons}, frames=frames, seed=seed)
        # The same scene with a billion electrons, unrounded, has negligible noise.
        bright = {"electrons": 1e9, "gain": record["electrons"] / 1e9 * record["gain"], "read_noise": 0.0}
        truth = itk.simulate_sensor_noise(**{**common, **STATIC, **bright}, frames=1, dtype="float64")[0][0]
        stacks.append(stack)
        signals.append((truth - record["offset"]) / record["gain"])
    return stacks, signals, record


def true_model(record):
    variance = record["read_noise"] ** 2 + 1 / 12
    return {"variance_slope": record["gain"], "total_intercept": variance - record["gain"] * record["offset"]}


def model_of(report):
    """Returns the noise model of a report for the transform; None if it is missing or has no positive slope."""
    model = {name: report[name]["value"] for name in ("variance_slope", "total_intercept")}
    usable = None not in model.values() and model["variance_slope"] > 0
    return model if usable else None


def own_error(report, model, level):
    """Returns the error of the variance after the transform at a level [DN], from the errors of the report; 0 without
    errors.

    The transform divides the noise at the level x by sqrt(a x + 3/8 a^2 + b), with the slope a and the total intercept
    b."""
    matrix = report["covariance"]["matrix"] if report else None
    if matrix is None:
        return 0.0
    (of_slope, both), (_, of_intercept) = (row[:2] for row in matrix[:2])
    slope = model["variance_slope"]
    by_slope = level + 0.75 * slope  # derivative of the argument of the root by a; by b it is 1
    error = np.sqrt(of_slope * by_slope**2 + 2 * both * by_slope + of_intercept)
    return error / (slope * level + 0.375 * slope**2 + model["total_intercept"])


def bands_of(signal, record, edges=EDGES):
    """Returns the pixels of each band whose levels are at least 6 standard deviations from the clip levels."""
    noise = np.sqrt(record["gain"] ** 2 * signal + record["read_noise"] ** 2)
    level = record["gain"] * signal + record["offset"]
    clear = (level > 6 * noise) & (level + 6 * noise < 2 ** record["bit_depth"] - 1)
    return [clear & (signal >= low) & (signal < high) for low, high in pairwise(edges)]


def band_means(values, bands):
    """Returns mean and standard error for each band; None for a band with few pixels."""
    return [
        (values[band].mean(), values[band].std(ddof=1) / np.sqrt(band.sum())) if band.sum() >= FEWEST_PIXELS else None
        for band in bands
    ]


def stabilised(stacks, model):
    """Returns variance and mean over the frames of the transformed levels, with all pixels in one row."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a few dark pixels become 0, as the law predicts
        values = [itk.generalized_anscombe_image_filter(stack, **model, dtype="float64") for stack in stacks]
    variance = np.concatenate([value.var(axis=0, ddof=1).ravel() for value in values])
    return variance, np.concatenate([value.mean(axis=0).ravel() for value in values])


def measure(stacks, signal, record, model, report, expected):
    """Returns for each quantity and band the deviation, its standard error, its limit, and the error of the report."""
    variance, mean = stabilised(stacks, model)
    bands = bands_of(signal, record)
    levels = [record["gain"] * signal[band].mean() + record["offset"] if band.any() else 0.0 for band in bands]
    cells = {
        "variance": [
            found and (*found, 0.02, own_error(report, model, level))
            for found, level in zip(band_means(variance - expected, bands), levels, strict=True)
        ]
    }
    for inverse in ("exact-unbiased", "algebraic"):
        level = itk.inverse_generalized_anscombe_image_filter(mean[None, :], **model, inverse=inverse)[0]
        bias = (level - record["offset"]) / record["gain"] - signal
        cells[inverse] = [
            found and low >= 2 and (*found, max(0.02, 0.005 * signal[band].mean()), 0.0)
            for found, low, band in zip(band_means(bias, bands), EDGES[:-1], bands, strict=True)
        ]
    return cells


def holds(cell, with_own=True):
    return abs(cell[0]) <= max(cell[2], 3 * np.hypot(cell[1], cell[3] * with_own))


def text_of(cell):
    return f"{cell[0]:+.4f}" + (" " if holds(cell, False) else "~" if holds(cell) else "*") if cell else ""


def models_of(common, frames):
    """Yields the reports and their models by condition and method."""
    for condition in (1, 2, 3, "steady"):
        conditions = STATIC if condition == "steady" else {"condition": condition}
        burst, _ = itk.simulate_sensor_noise(**common, **conditions, frames=frames, seed=1)
        for method in ("refined", "published"):
            report = itk.estimate_sensor_noise(burst, method=method)
            yield condition, method, model_of(report), report


def own_text_of(cell):
    return f"{cell[3]:.4f} " if cell else ""


def print_table(title, rows, text=text_of):
    print(f"\n{title}\n{'':<28}" + "".join(f"{low}-{high} ".rjust(11) for low, high in pairwise(EDGES)))
    for name, cells in rows:
        print(f"{name:<28}" + ("".join(f"{text(cell):>11}" for cell in cells).rstrip() if cells else "  no model"))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--frames", type=int, default=100, help="of the burst, and held out")
    parser.add_argument("--cameras", default="ABC")
    parser.add_argument("--scenes", default="target,texture")
    options = parser.parse_args()

    tables, counts = defaultdict(list), defaultdict(lambda: [0, 0, 0])
    for camera in options.cameras:
        for scene in options.scenes.split(","):
            common = {"camera": camera, "reference": scene, "size": (options.size, options.size)}
            stacks, signals, record = held_out(common, options.frames)
            signal = np.maximum(1e-6, np.concatenate([values.ravel() for values in signals]))
            expected = law(signal, record)
            models = [("", "true", true_model(record), None), *models_of(common, options.frames)]
            for condition, method, model, report in models:
                nothing = defaultdict(lambda: None)
                cells = measure(stacks, signal, record, model, report, expected) if model else nothing
                for quantity in ("variance", "exact-unbiased", "algebraic"):
                    tables[quantity].append((f"{camera} {scene:<8} {condition:<7} {method}", cells[quantity]))
                    known = [cell for cell in cells[quantity] or [] if cell]
                    found = sum(map(holds, known)), sum(holds(cell, False) for cell in known), len(known)
                    counts[quantity, method, scene] = np.add(counts[quantity, method, scene], found)
    print_table("variance of the transformed frames less the law's, per band of the signal [e-]", tables["variance"])
    own = [(name, cells) for name, cells in tables["variance"] if name.endswith("refined")]
    print_table("the report's own standard error of that variance", own, own_text_of)
    for inverse in ("exact-unbiased", "algebraic"):
        print_table(f"mean over the frames, led back by the {inverse} inverse, less the signal [e-]", tables[inverse])
    print(f"\n{'bands':<35}{'hold':>6}{'without the own error':>23}{'of':>6}")
    for (quantity, method, scene), (good, without_own, all_bands) in counts.items():
        print(f"{quantity:<16}{method:<10}{scene:<9}{good:6}{without_own:23}{all_bands:6}")


if __name__ == "__main__":
    main()
