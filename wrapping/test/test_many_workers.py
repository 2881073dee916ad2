# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests many bursts in one call with Dask workers."""

import os
import pickle
import signal
import time

import pytest
from itk_sensornoise.distributed import _task, estimate_many
from many_bursts import lines_of, rows_of


@pytest.fixture(scope="module")
def client():
    distributed = pytest.importorskip("distributed", reason="Dask's distributed is not installed")
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster,
        distributed.Client(cluster) as connected,
    ):
        yield connected


def test_workers_give_the_rows_of_one_process(client, bursts, burst_files, tmp_path):
    from dask import array

    lazy = array.from_array(bursts["a"], chunks=(7, 50, 60))
    sources = {**bursts, "dask": lazy, "lambda": lambda: lazy, **dict(zip("xyz", burst_files, strict=True))}
    expected = rows_of(estimate_many(sources))
    sources |= {"unpicklable": (each for each in ())}
    rows = rows_of(estimate_many(sources.items(), client, output=tmp_path / "x.jsonl"))
    assert rows[:-1] == expected
    assert rows[-1]["reason"].startswith("it cannot be pickled and sent to a worker: TypeError")
    assert sorted(line["name"] for line in lines_of(tmp_path / "x.jsonl")) == sorted(sources)


@pytest.mark.parametrize(("settings", "threads"), [({}, 1), ({"threads": None}, 1), ({"threads": 3}, 3)])
def test_a_task_is_measured_by_one_thread(monkeypatch, settings, threads):
    asked = []
    monkeypatch.setattr(_task, "estimate_sensor_noise", lambda _frames, **given: asked.append(given["threads"]))
    _task.measure_pickled(pickle.dumps("a.mha"), settings)
    assert asked == [threads]


def test_a_killed_worker_is_no_end(client, bursts, reports, tmp_path):
    frames, first = bursts["b"], tmp_path / "first"

    def killed_once():
        if not first.exists():
            first.write_text("")
            os.kill(os.getpid(), signal.SIGKILL)
        return frames

    rows = rows_of(estimate_many({"a": bursts["a"], "b": killed_once, "c": bursts["c"]}, client))
    assert [row["gain_DN_per_e"] for row in rows] == [report["gain"]["value"] for report in reports.values()]


def test_a_burst_that_kills_its_workers_is_a_row(client, bursts):
    def killed():
        os.kill(os.getpid(), signal.SIGKILL)

    rows = rows_of(estimate_many({"a": bursts["a"], "killed": killed}, client))
    assert rows[1]["status"] == "error" and rows[1]["reason"].startswith("every worker that measured it was killed")
    assert rows[0]["status"] == "measured"


def test_a_burst_is_not_failed_by_its_neighbour(bursts):
    distributed = pytest.importorskip("distributed", reason="Dask's distributed is not installed")

    frames = bursts["a"]

    def killed():
        time.sleep(0.5)
        os.kill(os.getpid(), signal.SIGKILL)

    def beside():  # runs whenever the only worker ends
        time.sleep(2)
        return frames

    with (
        distributed.LocalCluster(n_workers=1, threads_per_worker=2, dashboard_address=":0") as cluster,
        distributed.Client(cluster) as client,
    ):
        rows = rows_of(estimate_many({"killed": killed, "beside": beside}, client))
    assert [row["status"] for row in rows] == ["error", "measured"]


@pytest.mark.parametrize("breaks", ["restart", "close"])
def test_a_scheduler_that_restarts_or_goes_away_is_reported(breaks, bursts, tmp_path):
    distributed = pytest.importorskip("distributed", reason="Dask's distributed is not installed")
    mark = tmp_path / "over"

    def sleep():
        while not mark.exists():
            time.sleep(0.05)

    def sources(client):
        yield "a", bursts["a"]
        yield "b", sleep
        client.restart(wait_for_workers=False) if breaks == "restart" else client.close()
        yield "c", bursts["c"]

    options = {"n_workers": 1, "threads_per_worker": 2, "processes": False, "dashboard_address": None}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster, set_as_default=False) as client:
        with pytest.raises(RuntimeError, match="scheduler went away, was restarted.*; the same call goes on"):
            estimate_many(sources(client), client, output=tmp_path / "x.jsonl")
        mark.touch()
    assert len(rows_of(estimate_many({"a": bursts["a"]}, output=tmp_path / "x.jsonl"))) == 1
