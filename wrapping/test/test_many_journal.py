# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the file of many bursts in one call, also after a stopped or killed process, and how a call continues it."""

import signal
import subprocess
import sys

import numpy as np
import pytest
from itk_sensornoise.distributed import estimate_many
from itk_sensornoise.distributed._journal import Journal
from many_bursts import NAMES, lines_of, rows_of


def test_lines_hold_the_whole_reports(bursts, reports, tmp_path):
    estimate_many(bursts, output=tmp_path / "x.jsonl", threads=1, method="refined")
    lines = lines_of(tmp_path / "x.jsonl")
    assert [line["name"] for line in lines] == NAMES
    assert all(line["report"] == report for line, report in zip(lines, reports.values(), strict=True))
    assert all(line["settings"] == {} and line["reason"] is None for line in lines)


class Counted:
    """Sources that count how often they are opened. Some of them fail."""

    def __init__(self, bursts, bad=()):
        self.opened = []
        self.bad = set(bad)
        self.sources = {name: lambda name=name: self.open(name, bursts[name]) for name in bursts}

    def open(self, name, frames):
        self.opened.append(name)
        if name in self.bad:
            raise OSError("the disk is not there")
        return frames


@pytest.mark.parametrize("ending", ["jsonl", "parquet"])
def test_a_run_goes_on_where_it_was(bursts, tmp_path, ending):
    if ending == "parquet":
        pytest.importorskip("pyarrow")
    output = tmp_path / f"x.{ending}"
    lines = tmp_path / ("x.jsonl" if ending == "jsonl" else "x.parquet.jsonl")
    counted = Counted(bursts, bad=["b"])
    assert [row["status"] for row in rows_of(estimate_many(counted.sources, output=output))] == [
        "measured",
        "error",
        "measured",
    ]
    whole = lines.read_bytes()
    lines.write_bytes(whole[:-1] + b" " * len(whole))  # the last line is incomplete, as after a killed process
    counted.bad.clear()
    table = estimate_many(counted.sources, output=output)
    assert counted.opened == ["a", "b", "c", "b", "c"]
    assert rows_of(table) == rows_of(estimate_many(bursts))
    kept = lines.read_bytes()
    assert kept.startswith(b"".join(whole.splitlines(keepends=True)[:2]))
    assert [line["name"] for line in lines_of(lines)] == ["a", "b", "b", "c"]
    assert rows_of(estimate_many(counted.sources, output=output)) == rows_of(table)
    assert len(counted.opened) == 5 and lines.read_bytes() == kept


def test_other_settings_are_refused_before_anything_is_measured(bursts, tmp_path):
    counted = Counted(bursts)
    estimate_many({"b": counted.sources["b"]}, output=tmp_path / "x.jsonl", roi=(0, 0, 64, 64), mask=bursts["a"][0] > 0)
    same = {
        "roi": [0, 0, 64, np.int64(64)],
        "mask": bursts["a"][0] > 0,
        "threads": 1,
        "memory_limit": 10**9,
        "level": 0.01,
    }
    estimate_many({"b": counted.sources["b"]}, output=tmp_path / "x.jsonl", **same)
    for other in ({}, {**same, "roi": (0, 0, 64, 63)}, {**same, "mask": bursts["a"][0] > 200}):
        with pytest.raises(ValueError, match=r"x\.jsonl: b was measured with the settings"):
            estimate_many({"b": counted.sources["b"]}, output=tmp_path / "x.jsonl", **other)
    assert counted.opened == ["b"]
    estimate_many({"a": counted.sources["a"]}, output=tmp_path / "x.jsonl")  # the name is different
    assert [line["name"] for line in lines_of(tmp_path / "x.jsonl")] == ["b", "a"]


def test_ctrl_c_leaves_what_was_measured(bursts, tmp_path):
    pq = pytest.importorskip("pyarrow.parquet")

    def interrupted():
        raise KeyboardInterrupt

    sources = {"a": bursts["a"], "stop": interrupted, "c": bursts["c"]}
    with pytest.raises(KeyboardInterrupt):
        estimate_many(sources, output=tmp_path / "x.parquet")
    assert [line["name"] for line in lines_of(tmp_path / "x.parquet.jsonl")] == ["a"]
    assert pq.read_table(tmp_path / "x.parquet").column("name").to_pylist() == ["a"]


KILLED = """
import os, signal, sys
import itk
from itk_sensornoise.distributed import estimate_many

def burst(seed):
    if seed == 1:
        raise OSError("a line that is shorter than any buffer")
    if seed == 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return itk.simulate_sensor_noise(frames=30, size=(96, 64), seed=seed)[0]

estimate_many({name: lambda seed=seed: burst(seed) for seed, name in enumerate("abc")}, output=sys.argv[1])
"""


def test_a_killed_process_leaves_what_was_measured(bursts, tmp_path):
    result = subprocess.run([sys.executable, "-c", KILLED, tmp_path / "x.jsonl"], check=False)
    assert result.returncode == -signal.SIGKILL
    assert [(line["name"], line["reason"] is None) for line in lines_of(tmp_path / "x.jsonl")] == [
        ("a", True),
        ("b", False),
    ]
    assert rows_of(estimate_many(bursts, output=tmp_path / "x.jsonl")) == rows_of(estimate_many(bursts))


def test_parquet_holds_the_table(bursts, tmp_path):
    pq = pytest.importorskip("pyarrow.parquet")
    table = estimate_many({**bursts, "bad": "no such file"}, output=tmp_path / "x.parquet")
    assert pq.read_table(tmp_path / "x.parquet").to_pylist() == rows_of(table)
    estimate_many({"d": bursts["a"]}, output=tmp_path / "x.parquet")
    assert pq.read_table(tmp_path / "x.parquet").column("name").to_pylist() == [*NAMES, "bad", "d"]
    assert sorted(each.name for each in tmp_path.iterdir()) == ["x.parquet", "x.parquet.jsonl"]


def test_parquet_without_pyarrow_says_what_to_install(bursts, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(ImportError, match=r"pip install pyarrow.*\.jsonl"):
        estimate_many(bursts, output=tmp_path / "x.parquet")
    assert list(tmp_path.iterdir()) == []


def test_two_runs_do_not_write_into_one_file(bursts, tmp_path):
    with Journal(tmp_path / "x.jsonl"), pytest.raises(ValueError, match="is being written by another run"):
        estimate_many(bursts, output=tmp_path / "x.jsonl")
    assert len(rows_of(estimate_many(bursts, output=tmp_path / "x.jsonl"))) == 3


def test_a_file_of_something_else_is_left_alone(bursts, tmp_path):
    name = tmp_path / "x.jsonl"
    for text in ('{"name": "a"}\n', "not JSON\n", "[1]\n"):
        name.write_text(text)
        with pytest.raises(ValueError, match=r"x\.jsonl: line 1 is no row"):
            estimate_many(bursts, output=name)
        assert name.read_text() == text


def test_a_wrong_name_is_reported_before_anything_is_measured(bursts):
    counted = Counted(bursts)
    with pytest.raises(ValueError, match="source 1 has the name 3"):
        estimate_many([("a", counted.sources["a"]), (3, counted.sources["b"])])
    assert counted.opened == []
