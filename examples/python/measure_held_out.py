# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Whether a burst's report stabilises frames that it was not made from, and leads their means back.

    measure_held_out.py [--size 256] [--frames 100] [--cameras ABC] [--scenes target,texture]

For the cameras A, B and C of Sur & Grédiac 2015, two scenes, light and floor of conditions 1 to 3 and a steady light on
a still floor, which leaves the offset unknown: one burst, its report by both methods. Then other frames of the same
camera, without flicker, in the same light and in a dim one of 40 electrons at most. Per band of the light:

- the temporal variance of the transformed frames less what the Poisson-Gaussian law gives for the true parameters; it
  holds within 0.02 or 3 standard errors;
- the mean over the frames of the transformed levels, led back, less the true light [e-]; it holds within 0.5 %, 0.02 e-
  or 3 standard errors.

The variance's standard error has two parts: that of the held-out frames, and the report's own, which its covariance of
slope and intercept makes of the variance at the band's level (0 for the published method, which tells no errors). The
mean's is that of the held-out frames, as it hardly hangs on the model. * marks what does not hold, ~ what holds by the
report's own error alone.
"""

import argparse
import warnings
from collections import defaultdict
from itertools import pairwise

import itk
import numpy as np

EDGES = np.array([0, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10002])  # of the bands [e-]
DIM_ELECTRONS = 40.0
STILL = {"flicker_sd": 0.0, "vibration_sd": (0.0, 0.0)}
FEWEST_PIXELS = 30


def variance_after(light, read_noise):
    """After the transform with the true parameters, at a mean of `light` and with a read noise [e-]."""
    spread = 9 * np.sqrt(light) + 30
    electrons = np.arange(max(0, int(light - spread)), int(light + spread))
    factorials = np.concatenate(([0.0], np.cumsum(np.log(np.arange(1, electrons[-1] + 1)))))[electrons]
    photons = np.exp(electrons * np.log(light) - light - factorials)
    z = np.linspace(-8, 8, 1601)
    normal = np.exp(-(z**2) / 2) / np.exp(-(z**2) / 2).sum()
    values = 2 * np.sqrt(np.maximum(0, electrons[:, None] + read_noise * z + 3 / 8 + read_noise**2))
    values -= photons @ values @ normal
    return photons @ values**2 @ normal


def law(light, record):
    """The same at every light [e-] of an array; the codes' rounding is noise, too."""
    read_noise = np.sqrt(record["read_noise"] ** 2 + 1 / 12) / record["gain"]
    grid = np.geomspace(1e-3, light.max(), 80)
    return np.interp(np.log(light), np.log(grid), [variance_after(value, read_noise) for value in grid])


def held_out(common, frames, seed=1000):
    """Frames without flicker in two lights, the mean light of their pixels [e-], and the camera's record."""
    stacks, lights = [], []
    for electrons in ({}, {"electrons": DIM_ELECTRONS}):
        stack, record = itk.simulate_sensor_noise(**{**common, **STILL, **electrons}, frames=frames, seed=seed)
        # The same with a billion electrons, unrounded, has no noise to speak of.
        bright = {"electrons": 1e9, "gain": record["electrons"] / 1e9 * record["gain"], "read_noise": 0.0}
        truth = itk.simulate_sensor_noise(**{**common, **STILL, **bright}, frames=1, dtype="float64")[0][0]
        stacks.append(stack)
        lights.append((truth - record["offset"]) / record["gain"])
    return stacks, lights, record


def true_model(record):
    variance = record["read_noise"] ** 2 + 1 / 12
    return {"variance_slope": record["gain"], "total_intercept": variance - record["gain"] * record["offset"]}


def model_of(report):
    """What the transform needs of a report; None where that is missing."""
    model = {name: report[name]["value"] for name in ("variance_slope", "total_intercept")}
    usable = None not in model.values() and model["variance_slope"] > 0
    return model if usable else None


def own_error(report, model, level):
    """What the report's errors make of the variance after the transform at a level [DN]; 0 where it tells none.

    There the transform divides the noise by sqrt(a x + 3/8 a^2 + b): a the slope, b the total intercept."""
    matrix = report["covariance"]["matrix"] if report else None
    if matrix is None:
        return 0.0
    (of_slope, both), (_, of_intercept) = (row[:2] for row in matrix[:2])
    slope = model["variance_slope"]
    by_slope = level + 0.75 * slope  # derivatives of what is under the root; that by b is 1
    error = np.sqrt(of_slope * by_slope**2 + 2 * both * by_slope + of_intercept)
    return error / (slope * level + 0.375 * slope**2 + model["total_intercept"])


def bands_of(light, record, edges=EDGES):
    """The pixels of each band that lie clear of the clip levels."""
    noise = np.sqrt(record["gain"] ** 2 * light + record["read_noise"] ** 2)
    level = record["gain"] * light + record["offset"]
    clear = (level > 6 * noise) & (level + 6 * noise < 2 ** record["bit_depth"] - 1)
    return [clear & (light >= low) & (light < high) for low, high in pairwise(edges)]


def band_means(values, bands):
    """Mean and standard error per band; None where a band has few pixels."""
    return [
        (values[band].mean(), values[band].std(ddof=1) / np.sqrt(band.sum())) if band.sum() >= FEWEST_PIXELS else None
        for band in bands
    ]


def stabilised(stacks, model):
    """Variance and mean over the frames of the transformed levels, all pixels in one row."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a few pixels in the dark become 0, and the law says how many
        values = [itk.generalized_anscombe_image_filter(stack, **model, dtype="float64") for stack in stacks]
    variance = np.concatenate([value.var(axis=0, ddof=1).ravel() for value in values])
    return variance, np.concatenate([value.mean(axis=0).ravel() for value in values])


def measure(stacks, light, record, model, report, expected):
    """Per quantity and band: the departure, its standard error, by how much it may and the report's own error."""
    variance, mean = stabilised(stacks, model)
    bands = bands_of(light, record)
    levels = [record["gain"] * light[band].mean() + record["offset"] if band.any() else 0.0 for band in bands]
    cells = {
        "variance": [
            found and (*found, 0.02, own_error(report, model, level))
            for found, level in zip(band_means(variance - expected, bands), levels, strict=True)
        ]
    }
    for inverse in ("exact-unbiased", "algebraic"):
        level = itk.inverse_generalized_anscombe_image_filter(mean[None, :], **model, inverse=inverse)[0]
        bias = (level - record["offset"]) / record["gain"] - light
        cells[inverse] = [
            found and low >= 2 and (*found, max(0.02, 0.005 * light[band].mean()), 0.0)
            for found, low, band in zip(band_means(bias, bands), EDGES[:-1], bands, strict=True)
        ]
    return cells


def holds(cell, with_own=True):
    return abs(cell[0]) <= max(cell[2], 3 * np.hypot(cell[1], cell[3] * with_own))


def text_of(cell):
    return f"{cell[0]:+.4f}" + (" " if holds(cell, False) else "~" if holds(cell) else "*") if cell else ""


def models_of(common, frames):
    """The reports and their models by condition and method."""
    for condition in (1, 2, 3, "steady"):
        light = STILL if condition == "steady" else {"condition": condition}
        burst, _ = itk.simulate_sensor_noise(**common, **light, frames=frames, seed=1)
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
            stacks, lights, record = held_out(common, options.frames)
            light = np.maximum(1e-6, np.concatenate([values.ravel() for values in lights]))
            expected = law(light, record)
            models = [("", "true", true_model(record), None), *models_of(common, options.frames)]
            for condition, method, model, report in models:
                nothing = defaultdict(lambda: None)
                cells = measure(stacks, light, record, model, report, expected) if model else nothing
                for quantity in ("variance", "exact-unbiased", "algebraic"):
                    tables[quantity].append((f"{camera} {scene:<8} {condition:<7} {method}", cells[quantity]))
                    known = [cell for cell in cells[quantity] or [] if cell]
                    found = sum(map(holds, known)), sum(holds(cell, False) for cell in known), len(known)
                    counts[quantity, method, scene] = np.add(counts[quantity, method, scene], found)
    print_table("variance of the transformed frames less the law's, per band of the light [e-]", tables["variance"])
    own = [(name, cells) for name, cells in tables["variance"] if name.endswith("refined")]
    print_table("the report's own standard error of that variance", own, own_text_of)
    for inverse in ("exact-unbiased", "algebraic"):
        print_table(f"mean over the frames, led back by the {inverse} inverse, less the light [e-]", tables[inverse])
    print(f"\n{'bands':<35}{'hold':>6}{'without the own error':>23}{'of':>6}")
    for (quantity, method, scene), (good, without_own, all_bands) in counts.items():
        print(f"{quantity:<16}{method:<10}{scene:<9}{good:6}{without_own:23}{all_bands:6}")


if __name__ == "__main__":
    main()
