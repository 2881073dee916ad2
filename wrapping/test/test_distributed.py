# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests itk_sensornoise.distributed.estimate_sensor_noise(): Dask workers give the same bits as one process."""

import os
import signal
import time

import itk
import numpy as np
import pytest
from itk_sensornoise.distributed import estimate_sensor_noise

distributed = pytest.importorskip(
    "distributed", reason="dask.distributed is not installed: itk-sensornoise[distributed]"
)
dask_array = pytest.importorskip("dask.array")


@pytest.fixture(scope="module")
def client(tmp_path_factory):
    """Yields a client of two worker processes on this machine."""
    folder = str(tmp_path_factory.mktemp("dask"))
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=folder
        ) as cluster,
        distributed.Client(cluster) as connected,
    ):
        yield connected


@pytest.fixture(scope="module")
def stack(grey_values):
    return grey_values.astype(np.uint16)


@pytest.fixture(scope="module")
def expected(stack):
    return itk.estimate_sensor_noise(stack)


class Slow:
    """Frames that can be pickled and are read slowly. Each slice makes a file named by its start and the process
    number."""

    def __init__(self, stack, folder, seconds=0.0, once=False, lose=None):
        self.stack, self.folder, self.seconds, self.once, self.lose = stack, folder, seconds, once, lose
        self.shape, self.dtype = stack.shape, stack.dtype

    def __getitem__(self, times):
        mark = self.folder / f"{times.start}-{os.getpid()}"
        is_first = not any(self.folder.glob(f"{times.start}-*"))
        mark.touch()
        time.sleep(self.seconds)
        if self.once and is_first and times.start == 20:
            os.kill(os.getpid(), signal.SIGKILL)
        return self.stack[times]


@pytest.mark.parametrize("frames_per_task", [None, 3, 40])
def test_dask_arrays(client, stack, expected, frames_per_task):
    frames = dask_array.from_array(stack, chunks=(7, 40, 50))
    assert estimate_sensor_noise(frames, client, frames_per_task=frames_per_task) == expected


def test_files_and_options(client, stack, tmp_path):
    names = [str(tmp_path / f"{number:02}.mha") for number in range(len(stack))]
    for name, frame in zip(names, stack, strict=True):
        itk.imwrite(itk.image_view_from_array(frame), name)
    options = {"roi": (4, 2, 80, 50), "mask": stack[0] > 20, "frame_range": (2, 38), "method": "published"}
    expected = itk.estimate_sensor_noise(names, maps=True, **options)
    report = estimate_sensor_noise(names, frames_per_task=9, maps=True, **options)  # uses the current client
    assert report == expected
    np.testing.assert_array_equal(report.maps["corrected_variance"], expected.maps["corrected_variance"])
    itk.imwrite(itk.image_view_from_array(stack), str(tmp_path / "stack.mha"))
    one = str(tmp_path / "stack.mha")
    assert estimate_sensor_noise(one, client, frames_per_task=15) == itk.estimate_sensor_noise(one)
    dump = tmp_path / "stack.raw"
    stack.tofile(dump)
    assert estimate_sensor_noise(str(dump), client, raw="96x64:uint16le") == itk.estimate_sensor_noise(stack)


def test_mosaic_by_its_levels(client):
    stack = itk.simulate_sensor_noise(frames=30, size=(128, 96), bayer="GRBG", seed=4)[0]
    report = estimate_sensor_noise(dask_array.from_array(stack, chunks=(10, -1, -1)), client)
    assert report == itk.estimate_sensor_noise(stack) and "channels" in report


def test_equal_frames_of_different_tasks(client, stack):
    stack = stack.copy()
    stack[[13, 14, 35]] = stack[12]
    frames = dask_array.from_array(stack, chunks=(5, -1, -1))
    report = estimate_sensor_noise(frames, client, frames_per_task=7)
    assert report == itk.estimate_sensor_noise(stack) and report["frames_distinct"] == 37


def test_frames_unlike_the_others(client, stack):
    stack = stack.copy()
    stack[3] = 0
    frames = dask_array.from_array(stack, chunks=(5, -1, -1))
    report = estimate_sensor_noise(frames, client, frames_per_task=7, bayer="none")
    assert report == itk.estimate_sensor_noise(stack, bayer="none")
    assert report["frames_left_out"] == [{"frame": 3, "reason": "no-noise"}]


def test_floating_point_has_the_same_bits_in_any_order(client, stack, expected, tmp_path):
    reports = []
    for name, seconds in (("quick", 0.0), ("slow", 0.02)):
        (tmp_path / name).mkdir()
        frames = Slow(stack.astype(np.float32), tmp_path / name, seconds)
        reports.append(estimate_sensor_noise(frames, client, frames_per_task=4, bayer="none"))
    assert reports[0] == reports[1]
    of_one = itk.estimate_sensor_noise(stack.astype(np.float32))
    assert reports[0]["gain"]["value"] == pytest.approx(of_one["gain"]["value"], rel=1e-9)


def test_a_worker_that_is_killed_at_work(client, stack, expected, tmp_path):
    frames = Slow(stack, tmp_path, 0.05, once=True)
    assert estimate_sensor_noise(frames, client, frames_per_task=4, bayer="none") == expected
    readers = {mark.name.split("-")[1] for mark in tmp_path.glob("20-*")}
    assert len(readers) > 1  # one of these processes was killed
    client.wait_for_workers(2, timeout=60)


def test_what_readers_raise_is_raised(client, stack):
    frames = dask_array.from_array(stack, chunks=(8, -1, -1)).map_blocks(cannot_read, dtype=stack.dtype)
    with pytest.raises(OSError, match="the disk is gone"):
        estimate_sensor_noise(frames, client, bayer="none")
    short = dask_array.from_array(stack, chunks=(8, -1, -1)).map_blocks(lambda block: block[1:], dtype=stack.dtype)
    with pytest.raises(ValueError, match="^frame [0-9]* is missing in pass 1: the part that should hold"):
        estimate_sensor_noise(short, client, frames_per_task=8, bayer="none")


def cannot_read(block):
    raise OSError("the disk is gone")


def test_wrong_use_is_refused(client, stack):
    for frames, settings, pattern in [
        (stack, {"maps": "folder"}, "maps is 'folder'; expected True or False"),
        (stack, {"frames_per_task": 0}, "frames_per_task is 0"),
        (stack, {"method": "x"}, "method is 'x'"),
        (stack, {"hash": True}, "hash is no setting of a cluster; expected some of method, offset"),
        ([stack[0], stack[1]], {}, "frames is of type list; expected a dask array"),
        (stack, {"frame_range": (0, 41)}, "frame_range ends at 41, but there are 40 frames"),
    ]:
        with pytest.raises(ValueError, match=pattern):
            estimate_sensor_noise(frames, client, **settings)


def test_without_a_client(fresh):
    code = (
        "import numpy as np\n"
        "from itk_sensornoise.distributed import estimate_sensor_noise\n"
        "try:\n"
        "    estimate_sensor_noise(np.zeros((9, 8, 8), 'u1'))\n"
        "except ValueError as error:\n"
        "    print(error)"
    )
    assert fresh(code).startswith("there is no client of Dask; expected one, dask.distributed.Client()")


def test_without_dask(fresh):
    code = (
        "import sys\n"
        "sys.modules['distributed'] = sys.modules['dask'] = None\n"
        "import itk, numpy as np\n"
        "from itk_sensornoise.distributed import estimate_sensor_noise\n"
        "try:\n"
        "    estimate_sensor_noise(np.zeros((9, 8, 8), 'u1'))\n"
        "except ImportError as error:\n"
        "    print(error)"
    )
    assert fresh(code) == "Dask is not installed; expected it: pip install itk-sensornoise[distributed]\n"
