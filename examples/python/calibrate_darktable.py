# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Calibrates the factors between the noise of a mosaic and the noise profile of darktable. Needs darktable-cli.

    calibrate_darktable.py [--darktable-cli darktable-cli] [--method rcd] [--images 2] [--side 768]

darktable's noise profiles hold a and b of variance = a x + b. Its tool darktable-gen-noiseprofile exports a raw file as
linear floating-point numbers, takes the diagonal details (HH) of one level of a Haar transform, and their median
absolute deviation over 0.6745. The result is the variance of the mosaic times a factor, which depends on the
demosaicing and on the channel.

This script writes flat raw files (DNG, RGGB, 14 bits) with known noise, exports them with darktable-cli as that tool
does, and prints the factor for each channel: at several levels, for two gains, for grey and coloured illumination.
The colour changes the noise of the channels relative to each other. Flat files suffice, because darktable's tool asks
for an image out of focus. The last lines are the means and standard deviations of the cases with grey light and of
all cases, and the standard error of the latter. The standard deviation is the error of a profile. The constants in
module/src/exports/NoiseProfile.h are these numbers.

The median is taken of all details of an image, which have one level. Method: tools/noise/noiseprofile.c of darktable.
"""

import argparse
import itertools
import os
import struct
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from frame_stacks import write_dng

BLACK, WHITE = 512, 16383  # [DN]
LEVELS = (0.03, 0.1, 0.3)  # levels of green, from black to white
SCALES = (3e-5, 6e-4)  # S of a camera with 33000 electrons at base ISO, and at 20 times this ISO
OFFSETS = (4e-8, 2e-6)  # O of the same: a read noise of 7 electrons, and of 2
ILLUMINANTS = {"grey": (1.0, 1.0, 1.0), "daylight": (0.5, 1.0, 0.65), "tungsten": (0.8, 1.0, 0.35)}  # R, G, B over G
# Numbers of darktable's demosaicing methods.
METHODS = {"ppg": 0, "amaze": 1, "vng4": 2, "monochrome": 3, "rcd": 5, "lmmse": 6}
MAD = 0.6745  # median of the absolute value of a normal variable


def history(method: str) -> str:
    """Returns darktable's history (XMP): no white balance, one colour space, this demosaicing, and nothing else."""
    linear = 3  # darktable's linear Rec. 709 RGB, of input and output: the channels stay as they are
    modules = [
        ("temperature", 1, 3, struct.pack("<4f", 1, 1, 1, 1)),
        ("highlights", 0, 2, struct.pack("<i4f", 0, 1, 0, 0, 1)),
        ("demosaic", 1, 4, struct.pack("<ifiiif", 0, 0, 0, METHODS[method], 1, 0.2)),
        ("colorin", 1, 4, struct.pack("<i100siii", linear, b"", 0, 0, 1)),
        ("colorout", 1, 4, struct.pack("<i100si", linear, b"", 0)),
    ]
    items = "".join(
        f'<rdf:li darktable:operation="{name}" darktable:enabled="{on}" darktable:modversion="{version}"'
        f' darktable:params="{params.hex()}" darktable:multi_name="" darktable:multi_priority="0"/>'
        for name, on, version, params in modules
    )
    return (
        '<?xml version="1.0" encoding="UTF-8"?><x:xmpmeta xmlns:x="adobe:ns:meta/">'
        '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">'
        '<rdf:Description rdf:about="" xmlns:darktable="http://darktable.sf.net/" darktable:xmp_version="2"'
        f' darktable:raw_params="0" darktable:auto_presets_applied="1" darktable:history_end="{len(modules)}">'
        f"<darktable:history><rdf:Seq>{items}</rdf:Seq></darktable:history></rdf:Description></rdf:RDF></x:xmpmeta>"
    )


def read_pfm(path: Path) -> np.ndarray:
    """Returns the image, [row, column, channel]. Rows of a PFM file begin at the bottom."""
    with path.open("rb") as file:
        kind, size, scale = (file.readline().decode().split() for _ in range(3))
        if kind != ["PF"]:
            raise SystemExit(f"{path} begins with {kind}; expected PF, a colour image of floating-point numbers")
        values = np.fromfile(file, "<f4" if float(scale[0]) < 0 else ">f4")
    return values.reshape(int(size[1]), int(size[0]), 3)[::-1].astype(float)


def planes(mosaic: np.ndarray) -> list[np.ndarray]:
    """Returns the pixels of R, G and B of a mosaic."""
    green = np.concatenate((mosaic[0::2, 1::2].ravel(), mosaic[1::2, 0::2].ravel()))
    return [mosaic[0::2, 0::2].ravel(), green, mosaic[1::2, 1::2].ravel()]


def simulate(rng: np.random.Generator, side: int, illuminant: tuple, level: float, scale: float, offset: float):
    """Returns a flat mosaic [DN], and the variances of its channels R, G and B on [0, 1] with the rounding of DN."""
    means = np.tile(
        np.array([[illuminant[0], illuminant[1]], [illuminant[1], illuminant[2]]]) * level, (side // 2, side // 2)
    )
    values = scale * rng.poisson(means / scale) + np.sqrt(offset) * rng.standard_normal(means.shape)
    grey_values = np.rint(BLACK + values * (WHITE - BLACK))
    if grey_values.min() < 0 or grey_values.max() > WHITE:
        raise SystemExit("a simulated pixel is outside of the range of the file; choose other levels")
    variances = scale * level * np.array(illuminant) + offset + 1 / 12 / (WHITE - BLACK) ** 2
    return grey_values, variances


def export(cli: str, folder: Path, grey_values: np.ndarray, method: str) -> np.ndarray:
    """Returns the image that darktable makes of a mosaic, on [0, 1]."""
    raw, xmp, pfm = (folder / name for name in ("flat.dng", "flat.xmp", "flat.pfm"))
    pfm.unlink(missing_ok=True)
    write_dng(raw, grey_values, BLACK, WHITE, neutral=[1, 1, 1, 1, 1, 1])
    xmp.write_text(history(method))
    command = [cli, raw, xmp, pfm, "--icc-type", "LIN_REC709", "--apply-custom-presets", "false", "--core"]
    command += ["--configdir", folder / "config", "--cachedir", folder / "cache", "--library", ":memory:"]
    command += ["--disable-opencl", "--conf", "plugins/lighttable/export/style=none"]
    done = subprocess.run(command, check=False, capture_output=True, text=True, env={**os.environ, "HOME": str(folder)})
    if not pfm.exists():
        raise SystemExit(f"darktable-cli wrote no image. It said:\n{done.stdout}{done.stderr}")
    return read_pfm(pfm)


def factors(image: np.ndarray, grey_values: np.ndarray, variances: np.ndarray) -> np.ndarray:
    """Returns the variance by darktable's tool over the variance of the mosaic, for R, G and B."""
    margin = 16  # pixels at the border, where demosaicing has no neighbours
    means = np.array([plane.mean() for plane in planes((grey_values - BLACK) / (WHITE - BLACK))])
    inner = image[margin:-margin, margin:-margin]
    found = inner.mean(axis=(0, 1))
    # the demosaicing moves means by a fraction of the noise; another colour space would change them by percents
    if np.any(np.abs(found - means) > 0.1 * np.sqrt(variances) + 0.002 * means):
        raise SystemExit(f"darktable's means are {found}, the mosaic's {means}; expected the same: a module is active")
    details = (inner[::2, ::2] - inner[::2, 1::2] - inner[1::2, ::2] + inner[1::2, 1::2]) / 4
    deviations = np.median(np.abs(details), axis=(0, 1)) / MAD
    return deviations**2 / variances


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--darktable-cli", default="darktable-cli", help="program of darktable")
    parser.add_argument("--method", default="rcd", choices=METHODS, help="demosaicing")
    parser.add_argument("--images", type=int, default=2, help="images of each case")
    parser.add_argument("--side", type=int, default=768, help="width and height of an image [pixels]")
    given = parser.parse_args()
    version = subprocess.run(
        [given.darktable_cli, "--version"], check=False, capture_output=True, text=True
    ).stdout.splitlines()[0]
    print(f"{version}, {given.method}: factors of R, G, B")
    rng = np.random.default_rng(1)
    cases = []
    illuminants = {"grey": ILLUMINANTS["grey"]} if given.method == "monochrome" else ILLUMINANTS
    with tempfile.TemporaryDirectory() as name:
        for (illuminant, colour), (scale, offset), level in itertools.product(
            illuminants.items(), zip(SCALES, OFFSETS, strict=True), LEVELS
        ):
            found = []
            for _ in range(given.images):
                grey_values, variances = simulate(rng, given.side, colour, level, scale, offset)
                found.append(
                    factors(export(given.darktable_cli, Path(name), grey_values, given.method), grey_values, variances)
                )
            mean, error = np.mean(found, axis=0), np.std(found, axis=0, ddof=1) / np.sqrt(given.images)
            cases.append(mean)
            numbers = "  ".join(f"{m:.4f} ± {e:.4f}" for m, e in zip(mean, error, strict=True))
            print(f"{illuminant:9} S {scale:g} level {level:4}: {numbers}", flush=True)
    grey = np.array(cases[: len(SCALES) * len(LEVELS)])
    print("grey mean:         ", "  ".join(f"{value:.4f}" for value in grey.mean(axis=0)))
    print("grey deviation:    ", "  ".join(f"{value:.4f}" for value in grey.std(axis=0, ddof=1)))
    mean, scatter = np.mean(cases, axis=0), np.std(cases, axis=0, ddof=1)
    print("mean:              ", "  ".join(f"{value:.4f}" for value in mean))
    print("standard error:    ", "  ".join(f"{value:.4f}" for value in scatter / np.sqrt(len(cases))))
    print("standard deviation:", "  ".join(f"{value:.4f}" for value in scatter))


if __name__ == "__main__":
    main()
