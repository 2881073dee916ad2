# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that a measurement that a cluster cannot finish ends with a clear error, and does not wait forever."""

import asyncio
import os
import pickle
import signal
import threading
import time
from types import SimpleNamespace

import itk
import numpy as np
import pytest
from itk_sensornoise import SensorNoiseSums, _progress
from itk_sensornoise.distributed import _memory, _task, _watch, _worker, estimate_many, estimate_sensor_noise

distributed = pytest.importorskip(
    "distributed", reason="dask.distributed is not installed: itk-sensornoise[distributed]"
)
MIB = 1 << 20


@pytest.fixture(scope="module")
def stack(grey_values):
    return grey_values.astype(np.uint16)


def cluster_of(**options):
    """Returns a cluster with one worker, which is a thread of this process unless the options say otherwise."""
    return distributed.LocalCluster(
        **{"n_workers": 1, "threads_per_worker": 1, "processes": False, "dashboard_address": None, **options}
    )


def client_of(cluster):
    """Returns a client that is not Dask's default. A default client would query a scheduler that is gone."""
    return distributed.Client(cluster, set_as_default=False)


class Read:
    """Frames that can be pickled. `read` is called with the first frame of each slice."""

    def __init__(self, stack, read):
        self.stack, self.read = stack, read
        self.shape, self.dtype = stack.shape, stack.dtype

    def __getitem__(self, times):
        self.read(times.start)
        return self.stack[times]


def test_too_little_memory_is_reported_before_a_frame_is_read(stack, tmp_path):
    frames = Read(stack, lambda first: (tmp_path / "read").touch())
    with (
        cluster_of(memory_limit="300MiB") as cluster,
        client_of(cluster) as client,
        pytest.raises(
            RuntimeError, match="the worker has too little memory for 40 frames of 96 x 64 pixels"
        ) as failure,
    ):
        estimate_sensor_noise(frames, client, bayer="none")
    assert "has a memory_limit of 300 MiB (Dask lets it use 95%), and needs at least 465 MiB" in str(failure.value)
    assert "expected a memory_limit of 490 MiB or more" in str(failure.value)
    assert not (tmp_path / "read").exists()


def test_the_need_grows_with_pixels_frames_and_blocks():
    need = _memory.need_of_worker(1 << 20, 100, "<u2", 0)
    assert _memory.need_of_worker(2 << 20, 100, "<u2", 0) - need == 120 << 20
    assert _memory.need_of_worker(1 << 20, 101, "<u2", 0) - need == 20_000
    assert _memory.need_of_worker(1 << 20, 100, "<f4", 0) - need == 100 << 20
    assert _memory.need_of_worker(1 << 20, 100, "<u2", 100 * MIB) - need == 36 * MIB  # memory beyond a chunk of files


def test_only_workers_with_a_limit_are_held_to_it():
    states = [_memory.WorkerState(f"tcp://{n}", limit, 0, False, False) for n, limit in enumerate([0, 900, 300])]
    _memory.require_memory(states, 285, "this")
    with pytest.raises(RuntimeError, match="1 of 3 workers have too little memory for this: tcp://2 has"):
        _memory.require_memory(states, 286, "this")
    _memory.require_memory([], 286, "this")


def pause(dask_worker):
    """Pauses a worker, as Dask does near the memory limit. Without a limit nothing resumes the worker."""
    dask_worker.status = distributed.Status.paused


def test_workers_that_stay_paused_are_reported(stack, monkeypatch):
    monkeypatch.setattr(_watch, "_PATIENCE_SECONDS", 1.0)
    with cluster_of(n_workers=2, memory_limit=0) as cluster, client_of(cluster) as client:
        expected = itk.estimate_sensor_noise(stack, bayer="none")
        assert estimate_sensor_noise(stack, client, bayer="none") == expected
        client.run(pause)
        with pytest.raises(RuntimeError, match="Dask paused 2 of 2 workers, as their memory is near its limit"):
            estimate_sensor_noise(stack, client, bayer="none")
        with pytest.raises(RuntimeError, match="Dask paused 2 of 2 workers, as their memory is near its limit"):
            estimate_many({"a": stack}, client)


def worker_state(is_paused=False, is_busy=False):
    return _memory.WorkerState("tcp://1", 900 * MIB, 800 * MIB, is_paused, is_busy)


IDLE, BUSY = worker_state(), worker_state(is_busy=True)
PAUSED, PAUSED_AT_WORK = worker_state(is_paused=True), worker_state(is_paused=True, is_busy=True)


def seconds_waited(workers, monkeypatch, moves=False, at_most=100):
    """Returns the seconds of waiting for a task that does not end. With `moves` other tasks end meanwhile."""
    clock = SimpleNamespace(now=0.0, monotonic=lambda: clock.now)
    clock.sleep = lambda seconds: setattr(clock, "now", clock.now + seconds)
    monkeypatch.setattr(_watch, "time", clock)
    monkeypatch.setattr(_watch, "worker_states", lambda client: workers)
    watch = _watch.Watch(SimpleNamespace(status="running"), "")
    try:
        while clock.now < at_most:
            watch.wait([SimpleNamespace(cancelled=lambda: False)], int(clock.now) if moves else 0)
    except RuntimeError as error:
        assert "800 MiB of 900 MiB" in str(error)
    return clock.now


def test_paused_workers_are_waited_for_30_seconds(monkeypatch, caplog):
    for workers in ([PAUSED], [PAUSED, IDLE], [PAUSED, PAUSED]):
        assert seconds_waited(workers, monkeypatch) == pytest.approx(30, abs=_watch._LOOK_SECONDS)
        assert seconds_waited(workers, monkeypatch, moves=True) >= 100
    for workers in ([IDLE], [BUSY], [PAUSED, BUSY], [PAUSED, PAUSED_AT_WORK]):
        assert seconds_waited(workers, monkeypatch) >= 100
    assert not caplog.records
    assert seconds_waited([], monkeypatch) >= 100
    assert [record.getMessage() for record in caplog.records] == ["Dask has no worker; waiting for one"]


@pytest.mark.parametrize("breaks", ["close", "restart"])
def test_a_scheduler_that_goes_away_or_restarts_is_reported(breaks, stack, tmp_path):
    mark = tmp_path / "pass"

    def read(first):
        mark.touch()
        time.sleep(0.2)

    def break_it():
        while not mark.exists():
            time.sleep(0.05)
        cluster.close() if breaks == "close" else other.restart(wait_for_workers=False)

    with cluster_of() as cluster, client_of(cluster) as client, client_of(cluster) as other:
        breaker = threading.Thread(target=break_it)
        breaker.start()
        with pytest.raises(RuntimeError, match="scheduler went away, was restarted or cancelled the tasks; meas"):
            estimate_sensor_noise(Read(stack, read), client, bayer="none", frames_per_task=1)
        breaker.join()
    with pytest.raises(RuntimeError, match="scheduler went away"):
        estimate_sensor_noise(stack, client, bayer="none")


def test_a_task_that_ends_its_workers_is_reported(stack, monkeypatch):
    frames = Read(stack, lambda first: os.kill(os.getpid(), signal.SIGKILL))
    with cluster_of(processes=True, memory_limit=0) as cluster, client_of(cluster) as client:
        monkeypatch.setattr(cluster.scheduler, "allowed_failures", 0)
        with pytest.raises(RuntimeError, match="^workers ended again and again over a task of pass 1.* least 465"):
            estimate_sensor_noise(frames, client, bayer="none")


def test_workers_forget_a_run_that_is_over(stack):
    with cluster_of(memory_limit=0) as cluster, client_of(cluster) as client:
        for frames in (stack, Read(stack, fail_late)):
            try:
                estimate_sensor_noise(frames, client, bayer="none", frames_per_task=10)
            except OSError as error:
                assert str(error) == "the disk is gone"
        deadline = time.monotonic() + 60
        while (_worker._STATE or cluster.scheduler.tasks) and time.monotonic() < deadline:
            time.sleep(0.05)
        assert not _worker._STATE and not cluster.scheduler.tasks  # the worker is a thread here


def test_a_task_that_begins_after_its_run_is_over_leaves_nothing(stack, monkeypatch):
    monkeypatch.setattr(distributed, "get_worker", worker_with(None))
    start = SensorNoiseSums(stack.shape, stack.dtype, bayer="none")._given
    try:
        _worker.fill("run", start, [], stack, (0, 10), (0, 10), None)
        assert list(_worker._STATE) == ["run"]
        asyncio.run(_worker.forget("run"))
        with pytest.raises(RuntimeError, match="run is over: nobody waits for this task"):
            _worker.fill("run", start, [], stack, (0, 10), (0, 10), None)
        assert not _worker._STATE
        _worker.fill("other", start, [], stack, (0, 10), (0, 10), None)
        with pytest.raises(RuntimeError, match="run is over: nobody waits for this task"):
            _worker.fill("run", start, [], stack, (0, 10), (0, 10), None)
        assert list(_worker._STATE) == ["other"]
    finally:
        _worker._STATE.clear()
        _worker._OVER.clear()


def fail_late(first):
    if first == 30:
        raise OSError("the disk is gone")


def worker_with(limit, threads=1):
    manager = SimpleNamespace(memory_limit=limit)
    return lambda: SimpleNamespace(memory_manager=manager, state=SimpleNamespace(nthreads=threads))


def test_a_burst_takes_no_more_memory_than_its_worker_has(stack, monkeypatch):
    monkeypatch.setattr(distributed, "get_worker", worker_with(300 * MIB))
    outcome = _task.measure_pickled(pickle.dumps(stack), {})
    assert outcome.report is None
    assert outcome.reason.startswith("the worker has a memory_limit of 300 MiB, and Dask lets it use 240 MiB: too")
    monkeypatch.setattr(distributed, "get_worker", worker_with(501 * MIB))
    assert "the memory limit is" in _task.measure_pickled(pickle.dumps(stack), {}).reason
    asked = []
    monkeypatch.setattr(_task, "estimate_sensor_noise", lambda _frames, **given: asked.append(given["memory_limit"]))
    for limit, given in [(1000 * MIB, {}), (None, {}), (1000 * MIB, {"memory_limit": 7})]:
        monkeypatch.setattr(distributed, "get_worker", worker_with(limit, threads=2))
        _task.measure_pickled(pickle.dumps(stack), given)
    assert asked == [200 * MIB - stack.nbytes, None, 7]


def test_progress_goes_to_100_percent(stack, monkeypatch):
    class Bar:
        def __init__(self):
            self.n, self.steps = 0, []

        def update(self, percent):
            self.steps.append(percent)
            self.n += percent

        def close(self):
            self.steps.append("closed")

    bar = Bar()
    monkeypatch.setattr(_progress, "make_bar", lambda: bar)
    with cluster_of(memory_limit=0) as cluster, client_of(cluster) as client:
        estimate_sensor_noise(stack, client, bayer="none", frames_per_task=5, progress=True)
    assert bar.n == 100 and bar.steps.pop() == "closed" and min(bar.steps) >= 0
