#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the published method filter by filter, as an ITK pipeline that streams from files.

    reader -> TemporalStatistics -> VibrationMask -> FlickerCorrection(reader) -> TemporalStatistics -> NoiseRegression

This is Figure 2 of F. Sur, M. Gredi'ac, SIAM J. Imaging Sci. 8(1), 2015, https://doi.org/10.1137/140977035. The same
pipeline in C++ is examples/pipeline.cxx. itk.estimate_sensor_noise(method="published") gives the same numbers with
fewer passes over the files.

    pipeline.py                      # on frames that it simulates and writes into a temporary folder
    pipeline.py frames/*.tif         # on 2-D raw frames in time order, with one component
"""

import argparse
import json
import tempfile
from pathlib import Path
from typing import Any

import itk


def write_frames(folder: str, frames: int) -> list[str]:
    """Simulates the paper's camera B under its condition 3, writes it frame by frame and returns the file names."""
    stack, _ = itk.simulate_sensor_noise(camera="B", condition=3, frames=frames, seed=1)
    names = [str(Path(folder) / f"frame-{t:03d}.tif") for t in range(frames)]
    for frame, name in zip(stack, names, strict=True):
        itk.imwrite(itk.image_view_from_array(frame), name)
    return names


def measure(names: list[str]) -> tuple[dict[str, Any], list[int]]:
    """Measures frames that are read a few at a time: as many as 32 MiB hold.

    Returns a report with gain, offset, read noise and intercept, and the number of frames of each read, in order.
    """
    # A source has one pixel type. Any type can query the component type of the files.
    component = itk.SensorNoiseFrameListSource[itk.Image[itk.US, 3]].ReadComponentType(names)
    pixel = itk.ctype(itk.ImageIOBase.GetComponentTypeAsString(component).replace("_", " "))
    stack = itk.Image[pixel, 3]
    reader = itk.SensorNoiseFrameListSource[stack].New(file_names=names)

    # This filter of ITK passes the image on and records the requested regions.
    monitor = itk.PipelineMonitorImageFilter[stack].New(reader.GetOutput())
    monitor.ClearPipelineOnGenerateOutputInformationOff()

    statistics = itk.TemporalStatisticsImageFilter.New(monitor.GetOutput())
    mask = itk.VibrationMaskImageFilter.New(
        statistics.GetMean(),
        variance=statistics.GetVariance(),
        valid_mask=statistics.GetValidMask(),
        number_of_frames=len(names),
    )
    flicker = itk.FlickerCorrectionImageFilter.New(
        monitor.GetOutput(),
        mean=statistics.GetMean(),
        variance=statistics.GetVariance(),
        mask=mask.GetOutput(),
    )
    corrected = itk.TemporalStatisticsImageFilter.New(flicker.GetOutput())
    regression = itk.NoiseRegressionEstimator.New(
        statistics.GetMean(),
        variance=corrected.GetVariance(),
        mask=mask.GetOutput(),
        offset_input=flicker.GetOffsetOutput(),
    )
    regression.Update()  # the pixels are read here, not before

    reads = [region.GetSize()[2] for region in monitor.GetUpdatedRequestedRegions()]
    return json.loads(regression.GetReportAsJson()), reads


def main() -> None:
    """Measures the files of the command line, or simulated ones, in both ways."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", metavar="FRAME", help="2-D image files in time order; default: simulated")
    arguments = parser.parse_args()

    with tempfile.TemporaryDirectory() as folder:
        names = arguments.files or write_frames(folder, frames=160)
        chain, reads = measure(names)
        one_call = itk.estimate_sensor_noise(names, method="published")

    print(f"{len(names)} frames, {len(reads)} reads of at most {max(reads)} frames")
    print(f"{'quantity':<12}{'chain':>18}{'one call':>18}  unit    relative difference")
    for name in ("gain", "offset", "read_noise", "intercept"):
        values = chain[name]["value"], one_call[name]["value"]
        if None in values:
            print(f"{name:<12}{chain[name]['status']:>18}{one_call[name]['status']:>18}")
            continue
        difference = abs(values[0] / values[1] - 1.0)
        print(f"{name:<12}{values[0]:>18.12g}{values[1]:>18.12g}  {chain[name]['unit']:<8}{difference:.1e}")


if __name__ == "__main__":
    main()
