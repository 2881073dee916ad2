# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs programs of other authors with the numbers of the report and with their own calibration.

    measure_consumers.py --ndsafir VENV/bin/python --anscombe-transform VENV/bin/python [--camera A] [--size 128]

`ndsafir` (BSD) is a denoiser that takes a gain and an offset: variance_slope and total_intercept of the report.
`anscombe-transform` (MIT) encodes films. It takes a conversion gain and a zero level: variance_slope and
-total_intercept / variance_slope. Each program runs in a separate environment, into which `pip install` of its name put
it. The data are passed as .npz files.

Bursts of a smooth ramp and of a texture with flicker of 0, 0.2, 1 and 5 % are measured by the report and by each
program. Other frames without flicker follow. Two results are printed for each band of their signal. The first is the
temporal variance after the transform, which should equal the variance of the Poisson-Gaussian law. The second is the
brightness of the result less the truth [e-]. ndsafir does not return its transform: its variance is computed with the
formula of its method and its numbers, and its brightness is the mean of its denoised frames. The rounding of the codes
is subtracted from the variance of anscombe-transform. Its brightness is the mean code, decoded with its table.
"""

import argparse
import subprocess
import tempfile
from itertools import pairwise
from pathlib import Path

import itk
import numpy as np
from measure_held_out import STATIC, band_means, bands_of, held_out, law, model_of, stabilised, true_model

FLICKERS = (0.0, 0.002, 0.01, 0.05)
EDGES = (0, 10, 50, 200, 500)  # edges of the signal bands [e-]

NDSAFIR = """
import sys
import ndsafir
import numpy as np

data, found = np.load(sys.argv[1]), {}
for index, ours in enumerate(data["models"]):
    gains, offsets = ndsafir.calibrate_poisson_gaussian(data[f"burst{index}"], axes="TYX")
    found[f"own{index}"] = own = np.array([gains[0], offsets[0]])
    for name, (gain, offset) in (("ours", ours), ("own", own)):
        if gain > 0:
            for light in ("bright", "dim"):
                clean = ndsafir.denoise_poisson_gaussian(
                    data[light], axes="TYX", gains=[gain], offsets=[offset], nthreads=1)
                found[f"{name}{index}{light}"] = clean.mean(axis=0)
np.savez(sys.argv[2], **found)
"""

ANSCOMBE_TRANSFORM = """
import sys
import numpy as np
from anscombe_transform import codec, estimate

BETA = 0.5  # its step, in units of the noise
data, found = np.load(sys.argv[1]), {}
for index, (slope, intercept) in enumerate(data["models"]):
    own = estimate.compute_conversion_gain(data[f"burst{index}"])
    own = own["conversion_gain"], own["zero_level"]
    found[f"own{index}"] = np.array([own[0], -own[0] * own[1]])
    for name, (gain, zero) in (("ours", (slope, -intercept / slope)), ("own", own)):
        table = codec.make_anscombe_lookup(gain, zero_level=zero, output_type="uint16")
        back = codec.make_inverse_lookup(table, output_type="float64")
        for light in ("bright", "dim"):
            codes = codec.encode(data[light], conversion_gain=gain, zero_level=zero, encoded_dtype="uint16")
            found[f"{name}{index}{light}"] = np.interp(codes.mean(axis=0), np.arange(back.size), back)
            found[f"{name}{index}{light}variance"] = BETA**2 * (codes.var(axis=0, ddof=1) - 1 / 12)
np.savez(sys.argv[2], **found)
"""


def run(python, program, data):
    """Returns the results of the program for the data. It runs in its own environment."""
    with tempfile.TemporaryDirectory() as folder:
        given, made = Path(folder, "given.npz"), Path(folder, "made.npz")
        np.savez(given, **data)
        subprocess.run([python, "-c", program, given, made], check=True)
        with np.load(made) as found:
            return dict(found)


def joined(found, key, suffix=""):
    return np.concatenate([found[f"{key}{part}{suffix}"].ravel() for part in ("bright", "dim")])


def cells(values, bands, form):
    return "".join((format(mean[0], form) if mean else "").rjust(9) for mean in band_means(values, bands))


def measure(options, scene):
    """Prints the rows of a scene."""
    common = {"camera": options.camera, "reference": scene, "size": (options.size, options.size)}
    if scene == "ramp":
        common["reference"] = np.tile(np.linspace(0, 1, options.size) ** 2, (options.size, 1))
        del common["size"]
    stacks, signals, record = held_out(common, options.held_out)
    signal = np.maximum(1e-6, np.concatenate([values.ravel() for values in signals]))
    bands = bands_of(signal, record, EDGES)
    data = dict(zip(("bright", "dim"), stacks, strict=True))
    models = []
    for index, flicker in enumerate(FLICKERS):
        settings = {**common, **STATIC, "flicker_sd": flicker}
        data[f"burst{index}"], _ = itk.simulate_sensor_noise(**settings, frames=options.frames, seed=1)
        models.append(tuple(model_of(itk.estimate_sensor_noise(data[f"burst{index}"])).values()))
    data["models"] = np.array(models)

    truth = tuple(true_model(record).values())
    row = f"{f'{scene}: the law, true parameters':<38}{truth[0]:8.4f}{truth[1]:11.2f} "
    print(row + cells(law(signal, record), bands, ".3f"))
    for consumer, program in (("ndsafir", NDSAFIR), ("anscombe_transform", ANSCOMBE_TRANSFORM)):
        python = getattr(options, consumer)
        found = run(python, program, data) if python else {}
        for index, flicker in enumerate(FLICKERS if found else ()):
            for name, (slope, intercept) in (("ours", models[index]), ("own", found[f"own{index}"])):
                key = f"{name}{index}"
                row = f"{consumer:<19} {100 * flicker:3.1f} % {name:<12}{slope:8.4f}{intercept:11.2f} "
                if f"{key}bright" not in found:
                    print(row, "not usable")
                    continue
                if f"{key}brightvariance" in found:
                    variance = joined(found, key, "variance")
                else:
                    variance, _ = stabilised(stacks, {"variance_slope": slope, "total_intercept": intercept})
                bias = (joined(found, key) - record["offset"]) / record["gain"] - signal
                print(row + cells(variance, bands, ".3f") + " " + cells(bias, bands, "+.2f"), flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ndsafir", help="Python of an environment with ndsafir")
    parser.add_argument("--anscombe-transform", help="Python of an environment with anscombe-transform")
    parser.add_argument("--camera", default="A", help="anscombe-transform's table has gaps at the gains of B and C")
    parser.add_argument("--scenes", default="ramp,texture")
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--frames", type=int, default=60, help="of each burst")
    parser.add_argument("--held-out", type=int, default=30, help="frames in each of the two lights")
    options = parser.parse_args()

    columns = "".join(f"{low}-{high}".rjust(9) for low, high in pairwise(EDGES))
    print(f"{'variance after the transform':>92}{'brightness - truth [e-]':>37}")
    print(f"{'':<38}{'slope':>8}{'intercept':>11} {columns} {columns}")
    for scene in options.scenes.split(","):
        measure(options, scene)


if __name__ == "__main__":
    main()
