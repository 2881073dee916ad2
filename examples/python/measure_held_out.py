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

The standard errors are those of the held-out frames alone. * marks what does not hold.
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
    z = np.linspace(-8, 8, 161)
    normal = np.exp(-(z**2) / 2) / np.exp(-(z**2) / 2).sum()
    values = 2 * np.sqrt(np.maximum(0, electrons[:, None] + read_noise * z + 3 / 8 + read_noise**2))
    values -= photons @ values @ normal
    return photons @ values**2 @ normal


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
    """The codes' rounding is noise, too."""
    variance = record["read_noise"] ** 2 + 1 / 12
    return {"variance_slope": record["gain"], "total_intercept": variance - record["gain"] * record["offset"]}


def model_of(report):
    """What the transform needs of a report; None where that is missing."""
    model = {name: report[name]["value"] for name in ("variance_slope", "total_intercept")}
    usable = None not in model.values() and model["variance_slope"] > 0
    return model if usable else None


def bands_of(light, record):
    """The pixels of each band that lie clear of the clip levels."""
    noise = np.sqrt(record["gain"] ** 2 * light + record["read_noise"] ** 2)
    level = record["gain"] * light + record["offset"]
    clear = (level > 6 * noise) & (level + 6 * noise < 2 ** record["bit_depth"] - 1)
    return [clear & (light >= low) & (light < high) for low, high in pairwise(EDGES)]


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


def measure(stacks, light, record, model, expected):
    """Per quantity and band, what departs, its standard error and by how much it may."""
    variance, mean = stabilised(stacks, model)
    bands = bands_of(light, record)
    cells = {"variance": [found and (*found, 0.02) for found in band_means(variance - expected, bands)]}
    for inverse in ("exact-unbiased", "algebraic"):
        level = itk.inverse_generalized_anscombe_image_filter(mean[None, :], **model, inverse=inverse)[0]
        bias = (level - record["offset"]) / record["gain"] - light
        cells[inverse] = [
            found and low >= 2 and (*found, max(0.02, 0.005 * light[band].mean()))
            for found, low, band in zip(band_means(bias, bands), EDGES[:-1], bands, strict=True)
        ]
    return cells


def holds(cell):
    return abs(cell[0]) <= max(cell[2], 3 * cell[1])


def models_of(common, frames):
    """The reports' models by condition and method."""
    for condition in (1, 2, 3, "steady"):
        light = STILL if condition == "steady" else {"condition": condition}
        burst, _ = itk.simulate_sensor_noise(**common, **light, frames=frames, seed=1)
        for method in ("refined", "published"):
            yield condition, method, model_of(itk.estimate_sensor_noise(burst, method=method))


def print_table(title, rows):
    print(f"\n{title}\n{'':<30}" + "".join(f"{low}-{high}".rjust(10) for low, high in pairwise(EDGES)))
    for name, cells in rows:
        texts = ["" if not cell else f"{cell[0]:+.4f}" + ("" if holds(cell) else "*") for cell in cells or []]
        print(f"{name:<30}" + ("".join(f"{text:>10}" for text in texts) if cells else "  no model"))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--frames", type=int, default=100, help="of the burst, and held out")
    parser.add_argument("--cameras", default="ABC")
    parser.add_argument("--scenes", default="target,texture")
    options = parser.parse_args()

    tables, counts = defaultdict(list), defaultdict(lambda: [0, 0])
    for camera in options.cameras:
        for scene in options.scenes.split(","):
            common = {"camera": camera, "reference": scene, "size": (options.size, options.size)}
            stacks, lights, record = held_out(common, options.frames)
            light = np.maximum(1e-6, np.concatenate([values.ravel() for values in lights]))
            read_noise = np.sqrt(record["read_noise"] ** 2 + 1 / 12) / record["gain"]
            grid = np.geomspace(1e-3, light.max(), 80)
            expected = np.interp(np.log(light), np.log(grid), [variance_after(value, read_noise) for value in grid])
            for condition, method, model in [("", "true", true_model(record)), *models_of(common, options.frames)]:
                cells = measure(stacks, light, record, model, expected) if model else defaultdict(lambda: None)
                for quantity in ("variance", "exact-unbiased", "algebraic"):
                    tables[quantity].append((f"{camera} {scene:<8} {condition:<7} {method}", cells[quantity]))
                    known = [cell for cell in cells[quantity] or [] if cell]
                    count = counts[quantity, method]
                    count[:] = count[0] + sum(map(holds, known)), count[1] + len(known)
    print_table("variance of the transformed frames less the law's, per band of the light [e-]", tables["variance"])
    for inverse in ("exact-unbiased", "algebraic"):
        print_table(f"mean over the frames, led back by the {inverse} inverse, less the light [e-]", tables[inverse])
    print("\nbands that hold")
    for (quantity, method), (good, all_bands) in counts.items():
        print(f"  {quantity:<16}{method:<10}{good:5} of {all_bands}")


if __name__ == "__main__":
    main()
