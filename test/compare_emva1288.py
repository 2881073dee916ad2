#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Compares `estimate-sensor-noise --method emva1288` with the Python package emva1288 on the same frames.

    python3 -m venv VENV && VENV/bin/pip install emva1288==1.0.2 'numpy<2'
    VENV/bin/python test/compare_emva1288.py --bin build/bin [--descriptor FILE]

The package needs NumPy 1. It is the reference implementation of Release 4.0, with parts of Release 3.1. The script
simulates frames of a linear camera, writes them with a descriptor file, evaluates them by both programs, and prints
each number with its relative difference. Numbers whose arithmetic the standard prescribes must agree to 1e-6, and the
package must read the XML of the tool. The exit code is 1 if not. The last part of the table has the numbers in which
the programs differ on purpose, with reasons: they are not tested.

--descriptor FILE compares recorded frames instead. https://github.com/EMVA1288/datasets has three sets with their
descriptors: a CCD camera, a CMOS camera and a simulated one. The package takes the photon transfer curve from the pairs
of frames, so the script gives the tool a second descriptor with the pairs alone. The package takes the point of
saturation of the tool, because the programs search for it by different rules.
"""

import argparse
import contextlib
import json
import logging
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

TOLERANCE = 1e-6  # largest relative difference [1]
WIDTH, HEIGHT = 120, 90  # size of the frames [pixel]
BITS = 12
GAIN, OFFSET, READ_NOISE, EFFICIENCY = 0.4, 60.0, 7.0, 0.55  # [DN/e-], [DN], [e-], [1]
DARK_CURRENT = 300.0  # [e-/s]
EXPOSURES = 20
LONG_FRAMES = 12  # frames of the series for the non-uniformity


class Camera:
    """A linear camera with fixed-pattern noise of pixels, columns and rows."""

    def __init__(self):
        """Draws the patterns."""
        self.random = np.random.default_rng(1288)
        shape = (HEIGHT, WIDTH)
        self.prnu = 1 + 0.012 * self.random.standard_normal(shape) + 0.004 * self.random.standard_normal(WIDTH)
        self.dsnu = 2.5 * self.random.standard_normal(shape) + 1.0 * self.random.standard_normal((HEIGHT, 1))

    def frame(self, photons, seconds):
        """Returns a frame of 16-bit numbers."""
        flicker = 1 + 0.002 * self.random.standard_normal()
        electrons = self.random.poisson(EFFICIENCY * photons * self.prnu * flicker + DARK_CURRENT * seconds)
        level = GAIN * (electrons + READ_NOISE * self.random.standard_normal(self.prnu.shape)) + OFFSET + self.dsnu
        return np.clip(np.round(level), 0, 2**BITS - 1).astype(np.uint16)


def write_series(folder, lines, name, head, frames):
    """Writes the frames of one exposure, and adds their lines of the descriptor."""
    lines.append(head)
    for number, frame in enumerate(frames):
        file = f"{name}_{number}.png"
        Image.fromarray(frame).save(folder / file)
        lines.append(f"i {file}")


def write_frames(folder):
    """Writes the frames and the descriptor file, and returns its name."""
    camera = Camera()
    lines = [f"n {BITS} {WIDTH} {HEIGHT}"]
    largest = 1.05 * (2**BITS - 1) / GAIN / EFFICIENCY
    for level in range(1, EXPOSURES + 1):
        photons, seconds = largest * level / EXPOSURES, 0.01 * level
        frames = 2 if level != EXPOSURES // 2 else LONG_FRAMES
        for count in {2, frames}:
            bright = [camera.frame(photons, seconds) for _ in range(count)]
            dark = [camera.frame(0.0, seconds) for _ in range(count)]
            write_series(folder, lines, f"b{level}_{count}", f"b {seconds * 1e9:.17g} {photons:.17g}", bright)
            write_series(folder, lines, f"d{level}_{count}", f"d {seconds * 1e9:.17g}", dark)
    (folder / "descriptor.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return folder / "descriptor.txt"


def evaluate_by_package(descriptor, saturation=None):
    """Returns the results of the package. saturation: number of the point of saturation (default: found by itself)."""
    from emva1288 import process

    parsed = process.ParseEmvaDescriptorFile(str(descriptor), loglevel=logging.ERROR)
    loaded = process.LoadImageData(parsed.images, loglevel=logging.ERROR)
    data = process.Data1288(loaded.data, loglevel=logging.ERROR)
    return process.Results1288(data.data, index_u_ysat=saturation, loglevel=logging.ERROR)


def series_of(descriptor):
    """Lists the lines of a descriptor, each with the names of the frames that follow it."""
    series = []
    for line in descriptor.read_text(encoding="utf-8", errors="replace").splitlines():
        if line.startswith("i ") and series:
            series[-1][1].append(descriptor.parent / line[2:].strip().replace("\\", "/"))
        elif line.strip() and not line.startswith("#"):
            series.append((line, []))
    return series


def write_pairs(descriptor, folder):
    """Writes a descriptor with the series of two frames alone, and returns its name."""
    lines = []
    for head, files in series_of(descriptor):
        if len(files) in {0, 2}:
            lines += [head, *(f"i {file}" for file in files)]
    (folder / "pairs.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return folder / "pairs.txt"


def evaluate_by_tool(binaries, descriptor, folder):
    """Returns the JSON record of the tool, and the name of its XML."""
    report, xml = folder / f"{descriptor.stem}.json", folder / f"{descriptor.stem}.xml"
    command = [binaries / "estimate-sensor-noise", descriptor, "--method", "emva1288", "--quiet"]
    subprocess.run([*command, "--json", report, "--xml", xml], check=True)
    return json.loads(report.read_text(encoding="utf-8")), xml


def xml_pairs(record, xml):
    """Lists numbers of the JSON record, and of the XML as the package reads it."""
    from emva1288.process import routines

    read = routines.xml_to_dict(str(xml))
    slope = read["linearity"]["linearity"]["data"]["fit_slope"][0]
    return [
        ("K of the XML", value(record, "sensitivity", "gain"), read["sensitivity"]["k"]["value"]),
        ("PRNU1288 of the XML", value(record, "spatial", "prnu"), read["spatial"]["prnu1288"]["value"]),
        ("fit_slope of the XML", value(record, "linearity", "slope"), slope),
    ]


def value(record, section, name):
    """Returns the value of a quantity."""
    return record[section][name]["value"]


def temporal_pairs(record, package):
    """Lists the numbers of the photon transfer curve: (name, tool, package)."""
    points = record["points"]
    dark = sorted(
        (s for s in record["series"] if s["kind"] == "dark" and s["frames"] == 2), key=lambda s: s["exposure"]
    )
    temporal = package.temporal
    if len(dark) == 1:  # the package repeats a single dark series for each point
        dark *= len(temporal["u_ydark"])
    pairs = [
        ("mean of every exposure, u_y (16)", [p["mean"] for p in points], temporal["u_y"]),
        ("temporal variance, s2_y (18)", [p["variance"] for p in points], temporal["s2_y"]),
        ("mean of the dark frames, u_ydark", [s["mean"] for s in dark], temporal["u_ydark"]),
        ("dark variance, s2_ydark", [s["temporal_variance"] for s in dark], temporal["s2_ydark"]),
        ("saturation point, index_u_ysat", record["saturation_point"], package.index_u_ysat),
        ("responsivity, R (49)", value(record, "sensitivity", "responsivity"), package.R),
        ("gain without offset, K", value(record, "comparison", "gain_through_origin"), package.K),
        ("dark noise in DN, sigma_y_dark", value(record, "sensitivity", "dark_noise_dn"), package.sigma_y_dark),
        ("saturation, u_p_sat", value(record, "sensitivity", "saturation_photons"), package.u_p_sat),
    ]
    return [pair for pair in pairs if pair[1] is not None]  # quantization may hide the dark noise


def has_dark_current(record):
    """Returns whether the dark frames have enough exposure times for a dark current."""
    return value(record, "dark_current", "dark_current_dn") is not None


def line_pairs(record, package):
    """Lists the numbers of the linearity: (name, tool, package)."""
    linearity = package.linearity()
    ours = record["linearity"]
    deviations = [p["deviation_percent"] for p in record["points"]]
    inside = [i for i, deviation in enumerate(deviations) if deviation is not None]
    return [
        ("slope of the linearity, fit_slope (60)", ours["slope"]["value"], linearity["fit_slope"]),
        ("offset of the linearity, fit_offset (59)", ours["offset"]["value"], linearity["fit_offset"]),
        (
            "relative deviations (62)",
            [deviations[i] for i in inside],
            [linearity["relative_deviation"][i] for i in inside],
        ),
        ("lowest deviation, LE_min", ours["lowest_deviation"]["value"], package.LE_min),
        ("highest deviation, LE_max", ours["highest_deviation"]["value"], package.LE_max),
    ]


def dark_current_pairs(record, package):
    """Lists the numbers of the dark current: (name, tool, package)."""
    gain = value(record, "sensitivity", "gain")
    return [
        ("dark current in DN, u_I_mean_DN", value(record, "dark_current", "dark_current_dn"), package.u_I_mean_DN),
        (
            "slope of the dark variance",
            value(record, "dark_current", "dark_current_of_variance") * gain**2,
            package.u_I_var * package.K**2,
        ),
    ]


def spatial_pairs(record, package):
    """Lists the spatial variances without the highpass filter, which the package does not apply here. The package
    divides the measured variance by the number of pixels less 1, and the standard by the number of pixels (35)."""
    pairs = []
    width, height = record["width"], record["height"]
    pixels = width * height
    rest = pixels - width - height
    for number, end in ((record["bright_series"], ""), (record["dark_series"], "_dark")):
        ours = record["series"][number]["spatial_variance"]
        measured = ours["measured"] * pixels / (pixels - 1)
        total = measured - ours["stack"] / record["series"][number]["frames"]
        pixel = pixels / rest * (total - ours["column_mean"] - ours["row_mean"])
        pairs += [
            (f"s_2_y_measured{end} (35)", measured, getattr(package, f"s_2_y_measured{end}")),
            (f"sigma_2_y_stack{end} (65)", ours["stack"], getattr(package, f"sigma_2_y_stack{end}")),
            (f"s_2_y{end} (36)", total, getattr(package, f"s_2_y{end}")),
            (f"s_2_y_cav{end} (41)", ours["column_mean"], getattr(package, f"s_2_y_cav{end}")),
            (f"s_2_y_rav{end} (41)", ours["row_mean"], getattr(package, f"s_2_y_rav{end}")),
            (f"s_2_y_pixel{end} (42)", pixel, getattr(package, f"s_2_y_pixel{end}")),
            (f"s_2_y_col{end} (42)", ours["column_mean"] - pixel / height, getattr(package, f"s_2_y_col{end}")),
            (f"s_2_y_row{end} (42)", ours["row_mean"] - pixel / width, getattr(package, f"s_2_y_row{end}")),
        ]
    return pairs


def different_pairs(record, package):
    """Lists the numbers in which the programs differ, with the reason: (name, tool, package, reason)."""
    origin = "the package fits K without offset, as Release 3.1; Release 4 has one (50)"
    highpass = "the package does not apply the highpass filter of 8.1"
    threshold = "the package replaces the root of (26) by its first term"
    absolute = "Release 4 has the mean of absolute deviations (63), the package their extremes"
    ours = record["sensitivity"]
    extreme = max(abs(package.LE_min), abs(package.LE_max))
    return [
        ("system gain, K", ours["gain"]["value"], package.K, origin),
        ("quantum efficiency, QE", ours["quantum_efficiency"]["value"], package.QE, origin),
        ("dark noise, sigma_d", ours["dark_noise"]["value"], package.sigma_d, origin),
        ("saturation, u_e_sat", ours["saturation_electrons"]["value"], package.u_e_sat, origin),
        ("threshold, u_p_min", ours["threshold_photons"]["value"], package.u_p_min, threshold),
        ("dynamic range, DR", ours["dynamic_range"]["value"], package.DR, threshold),
        ("linearity error, LE", value(record, "linearity", "linearity_error"), extreme, absolute),
        ("DSNU1288", value(record, "spatial", "dsnu"), package.DSNU1288, highpass),
        ("PRNU1288", value(record, "spatial", "prnu"), package.PRNU1288, highpass),
        ("DSNU1288_row", value(record, "spatial", "dsnu_row"), package.DSNU1288_row, highpass),
    ]


def difference(tool, package):
    """Returns the largest difference relative to the largest number of the package [1]."""
    tool, package = np.atleast_1d(tool).astype(float), np.atleast_1d(package).astype(float)
    scale = np.max(np.abs(package))
    return float(np.max(np.abs(tool - package)) / (scale if scale > 0 else 1.0))


def shown(number):
    """Returns a number, or how many there are."""
    return f"{len(number)} numbers" if np.ndim(number) else f"{number:.8g}"


def main():
    """Writes, evaluates and compares the frames, and returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of estimate-sensor-noise")
    parser.add_argument("--descriptor", type=pathlib.Path, help="descriptor of recorded frames (default: simulated)")
    options = parser.parse_args()
    binaries = options.bin.resolve()
    if int(np.__version__.split(".")[0]) > 1:
        sys.exit(f"NumPy is {np.__version__}, and emva1288 1.0.2 needs NumPy 1: pip install 'numpy<2'")
    with tempfile.TemporaryDirectory() as temporary, contextlib.redirect_stderr(sys.stderr):
        folder = pathlib.Path(temporary)
        descriptor = options.descriptor.resolve() if options.descriptor else write_frames(folder)
        record, xml = evaluate_by_tool(binaries, descriptor, folder)
        temporal, saturation = record, None
        if options.descriptor:
            temporal, _ = evaluate_by_tool(binaries, write_pairs(descriptor, folder), folder)
            saturation = temporal["saturation_point"]
        package = evaluate_by_package(descriptor, saturation)
        pairs = temporal_pairs(temporal, package) + line_pairs(temporal, package)
        pairs += dark_current_pairs(temporal, package) if has_dark_current(temporal) else []
        pairs += spatial_pairs(record, package) + xml_pairs(record, xml)
        wrong = 0
        for name, tool, other in pairs:
            relative = difference(tool, other)
            is_right = math.isfinite(relative) and relative <= TOLERANCE
            wrong += not is_right
            print(f"{name:42} {shown(tool):>14} {shown(other):>14} {relative:9.1e} {'' if is_right else 'WRONG'}")
        print("\nwhat differs, and why")
        for name, tool, other, reason in different_pairs(record, package):
            text = "-" if tool is None else f"{tool:.6g}"
            print(f"{name:30} {text:>12} {other:12.6g}  {reason}")
        print(f"\n{len(pairs) - wrong} of {len(pairs)} numbers agree to {TOLERANCE:g}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
