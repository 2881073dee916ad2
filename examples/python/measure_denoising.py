# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the benefit of a measured noise model for a denoiser, on frames that were not used for the model.

    measure_denoising.py [--denoiser nlm|itk|scikit-image] [--size 256] [--frames 60]

For the cameras A, B and C of Sur & Grédiac 2015 and two scenes, it prints PSNR (relative to the range of the levels)
[dB] and SSIM of four versions of one frame: the noisy frame; the denoiser alone, at the strength that is best according
to the truth; the denoiser between transform and inverse, with the report of a burst; and the same with the true
parameters. The burst is of condition 3, which has flicker.

The bias follows: the mean of each version less the truth, for each band of the signal [e-]. The bias of the noisy frame
is due to chance, and the other versions contain it as well.
"""

import argparse
from itertools import pairwise

import itk
import numpy as np

STRENGTHS = 0.4 * 1.15 ** np.arange(14)  # strengths of the denoiser alone, in units of the noise at the mean level
EDGES = np.array([0, 10, 30, 100, 300, 1000, 3100, 10100])  # edges of the signal bands [e-]
FEWEST_PIXELS = 100
HEAD = ("noisy", "denoiser alone", "our report", "true parameters")


def box(image, size=7):
    """Returns means over size x size pixels that lie within the image."""
    sums = np.pad(image.cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    return (sums[size:, size:] - sums[:-size, size:] - sums[size:, :-size] + sums[:-size, :-size]) / size**2


def psnr(image, truth):
    return 10 * np.log10(np.ptp(truth) ** 2 / np.mean((image - truth) ** 2))


def ssim(image, truth):
    """Returns the SSIM of Z. Wang et al., IEEE Trans. Image Process. 13(4), 2004, with windows of 7 x 7 pixels."""
    a, b = box(image), box(truth)
    variances = box(image**2) - a**2 + box(truth**2) - b**2
    covariance = box(image * truth) - a * b
    c1, c2 = (0.01 * np.ptp(truth)) ** 2, (0.03 * np.ptp(truth)) ** 2
    return np.mean((2 * a * b + c1) * (2 * covariance + c2) / ((a**2 + b**2 + c1) * (variances + c2)))


def total_variation(strength):
    from skimage.restoration import denoise_tv_chambolle

    return lambda image: denoise_tv_chambolle(image.astype(np.float64), weight=strength).astype(np.float32)


def named(denoiser, strength=1.0):
    """Returns the denoiser of this name, for noise of standard deviation 1 in an array (y, x)."""
    from itk_sensornoise._denoise import named_denoiser

    return total_variation(strength) if denoiser == "scikit-image" else named_denoiser(denoiser, strength)


def biases(image, truth, signal):
    """Returns the mean error for each band of the signal [DN]; None for a band with few pixels."""
    bands = [(signal >= low) & (signal < high) for low, high in pairwise(EDGES)]
    return [(image - truth)[band].mean() if band.sum() >= FEWEST_PIXELS else None for band in bands]


def alone(noisy, truth, slope, intercept, denoiser):
    """Returns the denoised frame without transform: levels divided by the noise at their mean, at the best strength."""
    sigma = np.sqrt(slope * truth.mean() + intercept)
    scaled = (noisy / sigma).astype(np.float32)
    results = (sigma * named(denoiser, float(strength))(scaled) for strength in STRENGTHS)
    return max(results, key=lambda clean: psnr(clean, truth))


def measure(camera, scene, denoiser, size, frames):
    common = {"camera": camera, "reference": scene, "size": (size, size)}
    burst, record = itk.simulate_sensor_noise(**common, condition=3, frames=frames, seed=1)
    report = itk.estimate_sensor_noise(burst)
    static = {**common, "flicker_sd": 0.0, "vibration_sd": (0.0, 0.0), "frames": 1, "seed": 2}
    noisy = itk.simulate_sensor_noise(**static)[0][0].astype(np.float64)
    gain = record["gain"]
    bright = {"electrons": 1e5 * record["electrons"], "gain": 1e-5 * gain, "read_noise": 0.0}
    truth = itk.simulate_sensor_noise(**static, **bright, dtype="float64")[0][0]  # unrounded
    slope, intercept = gain, record["read_noise"] ** 2 - gain * record["offset"] + 1 / 12
    measured = {name: report[name]["value"] for name in ("variance_slope", "total_intercept")}
    remove = named(denoiser)
    return (
        truth,
        record,
        (
            noisy,
            alone(noisy, truth, slope, intercept, denoiser),
            itk.denoise_with_noise_model(noisy, None, remove, **measured),
            itk.denoise_with_noise_model(noisy, None, remove, variance_slope=slope, total_intercept=intercept),
        ),
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--denoiser", default="nlm", choices=["nlm", "itk", "scikit-image"])
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--frames", type=int, default=60)
    options = parser.parse_args()
    print("camera  scene    " + "".join(f"{name:>22}" for name in HEAD))
    rows = []
    for camera in "ABC":
        for scene in ("target", "texture"):
            truth, record, images = measure(camera, scene, options.denoiser, options.size, options.frames)
            cells = [f"{psnr(image, truth):.2f} dB {ssim(image, truth):.4f}" for image in images]
            print(f"{camera:<8}{scene:<9}" + "".join(f"{cell:>22}" for cell in cells), flush=True)
            signal = (truth - record["offset"]) / record["gain"]
            for name, image in zip(HEAD, images, strict=True):
                rows.append((f"{camera:<8}{scene:<9}{name}", biases(image, truth, signal), record["gain"]))
    print("\nmean error per band of the signal [e-]\n" + " " * 33, end="")
    print("".join(f"{low}-{high}".rjust(11) for low, high in pairwise(EDGES)))
    for name, errors, gain in rows:
        cells = [f"{error / gain:+.2f}" if error is not None else "" for error in errors]
        print(f"{name:<33}" + "".join(f"{cell:>11}" for cell in cells).rstrip())


if __name__ == "__main__":
    main()
