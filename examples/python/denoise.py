# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures a camera from one burst, removes the noise from a frame of another burst, and draws both frames.

    denoise.py [--picture denoised.png] [--denoiser nlm|itk|scikit-image]

Both bursts are simulated (camera B of Sur & Grédiac 2015 with a tenth of its electrons), so that the truth is known.
The report comes from a burst without flicker, which does not determine the offset. Denoising needs no offset.
"""

import argparse

import itk
import numpy as np

CAMERA = {"camera": "B", "electrons": 300.0, "size": (256, 256)}
STATIC = {"flicker_sd": 0.0, "vibration_sd": (0.0, 0.0)}


def psnr(image, truth):
    """Returns the peak signal-to-noise ratio relative to the range of the true levels [dB]."""
    return 10 * np.log10(np.ptp(truth) ** 2 / np.mean((image.astype(np.float64) - truth) ** 2))


def total_variation(image):
    """Denoises an array (y, x) with noise of standard deviation 1. Any such function will do; this one is from
    scikit-image."""
    from skimage.restoration import denoise_tv_chambolle

    return denoise_tv_chambolle(image.astype(np.float64), weight=1.0)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--picture", help="file for the picture before and after; needs matplotlib")
    choices = {"nlm": "nlm", "itk": "itk", "scikit-image": total_variation}
    parser.add_argument("--denoiser", default="nlm", choices=list(choices), help="nlm needs OpenCV (cv2)")
    options = parser.parse_args()

    burst, _ = itk.simulate_sensor_noise(**CAMERA, **STATIC, frames=50, reference="texture", seed=1)
    report = itk.estimate_sensor_noise(burst)
    print("offset:", report["offset"]["status"], " variance slope:", report["variance_slope"]["value"])

    # Another scene, and the same scene with 100,000 times the electrons, which has hardly any noise.
    noisy = itk.simulate_sensor_noise(**CAMERA, **STATIC, frames=1, seed=2)[0][0]
    bright = {**CAMERA, **STATIC, "electrons": 3e7, "gain": 1e-5, "read_noise": 0.0}
    truth = itk.simulate_sensor_noise(**bright, frames=1, seed=2)[0][0].astype(np.float64)

    clean = itk.denoise_with_noise_model(noisy, report, choices[options.denoiser])
    print(f"PSNR: {psnr(noisy, truth):.2f} dB before, {psnr(clean, truth):.2f} dB after")
    if options.picture:
        draw(noisy, clean, truth, options.picture)


def draw(noisy, clean, truth, file) -> None:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8, 4.3), dpi=100, layout="constrained")
    low, high = np.quantile(truth, [0.001, 0.999])
    for axes, image, name in zip(figure.subplots(1, 2), (noisy, clean), ("one raw frame", "denoised"), strict=True):
        axes.imshow(image, cmap="gray", vmin=low, vmax=high, interpolation="nearest")
        axes.set_title(f"{name}: {psnr(image, truth):.1f} dB")
        axes.set_axis_off()
    figure.savefig(file)


if __name__ == "__main__":
    main()
