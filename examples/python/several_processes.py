#!/usr/bin/env python3
# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures the noise of a camera with several processes. Each process reads a part of the frames.

    several_processes.py frames/*.tif      # or no files: a simulated burst

The report has the same bits as the report of itk.estimate_sensor_noise(). On one machine that function is faster. This
example shows the steps for programs on many machines, with MPI, Spark or a job queue. For Dask they are already
implemented: itk_sensornoise.distributed.
"""

import multiprocessing
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from itertools import repeat

import itk
from itk_sensornoise import SensorNoiseSums

PROCESSES = 3


def sums_of(sums: SensorNoiseSums, names: list[str], first: int) -> bytes:
    """Returns the sums of a part of the frames. It runs in another process, on a copy of `sums` from the start of the
    pass."""
    for number in range(first, len(names), PROCESSES):  # frames may be added in any order, or in runs
        sums.add([names[number]], number)
    return sums.to_bytes()


def measure(names: list[str]) -> object:
    """Returns the report of frames in files."""
    first = itk.array_from_image(itk.sensor_noise_frame_list_source(names[:1]))
    sums = SensorNoiseSums((len(names), *first.shape[1:]), first.dtype, first_frame=first[0])
    # Processes are not forked: fork() does not copy the threads of ITK.
    with ProcessPoolExecutor(PROCESSES, multiprocessing.get_context("spawn")) as pool:
        while not sums.is_done:
            for part in pool.map(sums_of, repeat(sums), repeat(names), range(PROCESSES)):
                sums.merge(part)
            sums.end_pass()
    return sums.report()


def main() -> int:
    """Returns the exit code: 0 done, 2 unreadable input."""
    with tempfile.TemporaryDirectory() as folder:
        names = sys.argv[1:] or [f"{folder}/{t:03}.tif" for t in range(60)]
        if not sys.argv[1:]:
            for name, frame in zip(
                names, itk.simulate_sensor_noise(size=(192, 128), frames=len(names))[0], strict=True
            ):
                itk.imwrite(itk.image_view_from_array(frame), name)
        try:
            print(measure(names))
        except (ValueError, RuntimeError) as error:
            print(str(error).splitlines()[0], file=sys.stderr)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
