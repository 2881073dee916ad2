#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the noise of a camera from frames that another package reads, a few frames at a time.

    lazy.py frames/*.png           # with OpenCV's cv2.imread
    lazy.py recording.avi          # with OpenCV's cv2.VideoCapture: the video must have uncompressed grey values
    lazy.py stack.npy              # with numpy.memmap
    lazy.py                        # a simulated burst in a .npy file

itk.estimate_sensor_noise() accepts any object with a shape (t, y, x), a dtype and slices along time: datasets of h5py
and arrays of zarr, dask and xarray. Other sources are wrapped in a class of five lines.
"""

import sys
import tempfile
from pathlib import Path

import itk
import numpy as np


class Images:
    """Image files with one frame each, as cv2 reads them."""

    def __init__(self, names: list[str]) -> None:
        first = read_grey(names[0])
        self.names, self.shape, self.dtype = names, (len(names), *first.shape), first.dtype

    def __getitem__(self, times: slice) -> np.ndarray:
        return np.stack([read_grey(name) for name in self.names[times]])


class Video:
    """First channel of a video, as cv2 reads it. Seeking is exact if every frame is a key frame, as in raw videos."""

    def __init__(self, name: str) -> None:
        import cv2

        self.video, self.seek = cv2.VideoCapture(name), cv2.CAP_PROP_POS_FRAMES
        size = (cv2.CAP_PROP_FRAME_COUNT, cv2.CAP_PROP_FRAME_HEIGHT, cv2.CAP_PROP_FRAME_WIDTH)
        self.shape, self.dtype = tuple(int(self.video.get(key)) for key in size), np.dtype(np.uint8)

    def __getitem__(self, times: slice) -> np.ndarray:
        self.video.set(self.seek, times.start)
        frames = [self.video.read() for _ in range(times.start, times.stop)]
        if not all(is_read for is_read, _ in frames):
            raise ValueError(f"the video ends before frame {times.stop}")
        return np.stack([frame[..., 0] for _, frame in frames])


def read_grey(name: str) -> np.ndarray:
    """Returns the grey values of an image file [DN]."""
    import cv2

    image = cv2.imread(name, cv2.IMREAD_UNCHANGED)
    if image is None or image.ndim != 2:
        raise ValueError(f"{name}: cannot be read as grey values")
    return image


def open_lazily(names: list[str]) -> object:
    """Returns frames that are read when they are sliced."""
    ending = Path(names[0]).suffix.lower()
    if ending == ".npy":
        return np.load(names[0], mmap_mode="r")
    if ending in (".avi", ".mkv", ".mov", ".mp4"):
        return Video(names[0])
    return Images(names)


def main() -> int:
    """Returns the exit code: 0 done, 2 unreadable input, 3 nothing could be estimated."""
    with tempfile.TemporaryDirectory() as folder:
        names = sys.argv[1:]
        if not names:
            names = [f"{folder}/stack.npy"]
            np.save(names[0], itk.simulate_sensor_noise(camera="B", condition=3, frames=60)[0])
        try:
            report = itk.estimate_sensor_noise(open_lazily(names))
        except (ValueError, RuntimeError) as error:
            print(str(error).splitlines()[0], file=sys.stderr)
            return 2
    print(report)
    return 0 if "identified" in (report["gain"]["status"], report["intercept"]["status"]) else 3


if __name__ == "__main__":
    sys.exit(main())
