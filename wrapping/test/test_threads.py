# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that other threads of Python run while ITK works, and that frames which Python reads are still measured."""

import concurrent.futures
import threading
import time

import itk
import itk_sensornoise as sn
import numpy as np
import pytest
from itk_sensornoise._denoise import named_denoiser

LEAST_TICKS = 10  # with the lock held, another thread runs once or twice, before and after the call


def ticks_during(work) -> list[float]:
    """Returns the times at which another thread ran during work() in this thread [s]: each millisecond, or less often
    on a machine with other work."""
    ticks, is_done = [], threading.Event()

    def tick():
        while not is_done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    work()
    end = time.perf_counter()
    is_done.set()
    thread.join()
    return [at for at in ticks if start < at < end]


def test_threads_run_during_a_call_that_has_no_observer():
    """The frames are drawn in one call of ITK, which shows no progress: with the lock held, the other thread waits."""
    itk.simulate_sensor_noise(frames=8, size=(64, 48))  # loads the library
    assert len(ticks_during(lambda: itk.simulate_sensor_noise(frames=30, size=(512, 512)))) >= LEAST_TICKS


def test_result_does_not_depend_on_other_threads(burst):
    expected = itk.estimate_sensor_noise(burst)
    found = []
    ticks_during(lambda: found.append(itk.estimate_sensor_noise(burst)))
    assert found == [expected]


def test_two_threads_measure_at_once(bursts, reports):
    found = {}
    threads = [
        threading.Thread(target=lambda name=name: found.update({name: itk.estimate_sensor_noise(bursts[name])}))
        for name in bursts
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == reports


class Lazy:
    """Frames that Python reads, a few at a time."""

    def __init__(self, frames: np.ndarray) -> None:
        self.shape, self.dtype, self._frames = frames.shape, frames.dtype, frames

    def __getitem__(self, times):
        return self._frames[times]


def test_frames_that_python_reads_are_measured_beside_a_busy_thread(burst, dark):
    """The lock must be kept where ITK calls functions of Python without taking it: for frames and for dark frames."""
    expected = itk.estimate_sensor_noise(burst, dark=dark)
    for frames, of_dark in ((Lazy(burst), dark), (burst, Lazy(dark)), (list(burst), list(dark))):
        found = []
        ticks_during(
            lambda frames=frames, of_dark=of_dark, found=found: found.append(
                itk.estimate_sensor_noise(frames, dark=of_dark)
            )
        )
        assert found == [expected]


def test_error_in_a_call_without_the_lock_is_raised(burst):
    with pytest.raises(ValueError, match="exposures"):
        itk.estimate_sensor_noise(burst, exposures=[1.0, 2.0])
    assert itk.estimate_sensor_noise(burst)["gain"]["status"] == "identified"


def test_threads_run_while_frames_are_added():
    """One call of ITK adds all frames, as in test_threads_run_during_a_call_that_has_no_observer()."""
    stack = np.tile(sn.simulate_sensor_noise(frames=100, size=(128, 128))[0], (1, 8, 8))
    sums = sn.SensorNoiseSums(stack.shape, stack.dtype, bayer="none", threads=1)
    assert len(ticks_during(lambda: sums.add(stack))) >= LEAST_TICKS


def test_two_threads_add_frames_to_the_same_sums(burst):
    """Frames are added, and sums are read, by several threads at once. The result has the same bits."""
    sums = sn.SensorNoiseSums(burst.shape, burst.dtype, bayer="none")
    while not sums.is_done:
        parts = [range(first, len(burst), 4) for first in range(4)]

        def add(part):
            for number in part:
                sums.add(burst[number : number + 1], number)
                assert number in sums.frames

        with concurrent.futures.ThreadPoolExecutor(len(parts)) as threads:
            for done in threads.map(add, parts):
                assert done is None
        sums.end_pass()
    assert sums.report() == itk.estimate_sensor_noise(burst, bayer="none")


def test_threads_run_while_the_bilateral_filter_works():
    if not hasattr(itk, "BilateralImageFilter"):
        pytest.skip("itk-filtering is not installed: its bilateral filter was not tested")
    remove = named_denoiser("itk", 1.0)
    frame = np.random.default_rng(1).normal(10.0, 1.0, (1200, 1600)).astype(np.float32)
    remove(frame[:16, :16])  # loads the library
    assert len(ticks_during(lambda: remove(frame))) >= LEAST_TICKS
