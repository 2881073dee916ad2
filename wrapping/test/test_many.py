# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Many bursts in one call: what the table says, what is in the file, what a killed process leaves."""

import json
import os
import pickle
import signal
import subprocess
import sys
import time

import itk
import numpy as np
import pytest
from itk_sensornoise import quantity_list
from itk_sensornoise.distributed import _task, estimate_many
from itk_sensornoise.distributed._journal import Journal

NAMES = ["a", "b", "c"]


def rows_of(table):
    """The rows as dicts, whatever holds them."""
    if isinstance(table, list):
        return table
    rows = table.astype(object).where(table.notna(), None).to_dict("records")
    return [{str(name): value for name, value in row.items()} for row in rows]


def lines_of(name):
    return [json.loads(line) for line in name.read_text().splitlines()]


@pytest.fixture(scope="module")
def bursts() -> dict[str, np.ndarray]:
    """Three small bursts."""
    return {name: itk.simulate_sensor_noise(frames=30, size=(96, 64), seed=n)[0] for n, name in enumerate(NAMES)}


@pytest.fixture(scope="module")
def reports(bursts):
    return {name: itk.estimate_sensor_noise(frames) for name, frames in bursts.items()}


@pytest.fixture
def files(bursts, tmp_path) -> list[str]:
    """The bursts as files."""
    names = [os.fspath(tmp_path / f"{name}.mha") for name in bursts]
    for name, frames in zip(names, bursts.values(), strict=True):
        itk.imwrite(itk.image_view_from_array(frames), name)
    return names


def test_rows_say_what_the_reports_say(bursts, reports):
    rows = rows_of(estimate_many(bursts))
    assert [row["name"] for row in rows] == NAMES
    for row, report in zip(rows, reports.values(), strict=True):
        assert (row["status"], row["reason"], row["channel"]) == ("measured", None, "mono")
        assert (row["frames"], row["width"], row["height"]) == (30, 96, 64)
        assert row["gain_DN_per_e"] == report["gain"]["value"]
        assert row["gain_error_DN_per_e"] == report["gain"]["standard_error"]
        assert row["intercept_DN2"] == report["intercept"]["value"]
        assert row["read_noise_electrons_e"] == report["read_noise_electrons"]["value"]
        assert row["flicker_sd_error"] == report["flicker_sd"]["standard_error"]
        assert row["vibration_sd_x_pixel"] == report["vibration"]["sd_x"]["value"]
        assert row["vibration_covariance_pixel2"] == report["vibration"]["covariance"]["value"]
        assert row["offset_status"] == report["offset"]["status"]
        assert row["warnings"].split() == [warning["code"] for warning in report["warnings"]]
        found = {quantity["path"]: quantity for quantity in report.quantities()}
        assert sum(name.endswith("_status") for name in row) == len(quantity_list())
        for path, quantity in found.items():
            assert row[f"{path.replace('.', '_')}_status"] == quantity["status"]


def test_sources_are_named_by_their_files(files, bursts, tmp_path):
    for name, frame in zip("xyz", np.array_split(bursts["a"], 3), strict=True):
        np.save(tmp_path / name, frame)
    frames = [os.fspath(tmp_path / f"{n:02}.mha") for n in range(30)]
    for name, frame in zip(frames, bursts["a"], strict=True):
        itk.imwrite(itk.image_view_from_array(frame), name)
    sources = [files[0], frames, ("opened there", lambda: bursts["a"]), bursts["a"]]
    rows = rows_of(estimate_many(iter(sources)))
    assert [row.pop("name") for row in rows] == [files[0], f"{frames[0]} to {frames[-1]}", "opened there", "source 3"]
    assert all(row == rows[0] for row in rows)


def test_a_bad_burst_is_a_row_with_its_reason(bursts, reports, tmp_path):
    def broken():
        raise OSError("no such\ndataset")

    sources = {"a": bursts["a"], "few": bursts["a"][:1], "none": tmp_path / "none.mha", "broken": broken} | bursts
    rows = {row["name"]: row for row in rows_of(estimate_many(sources))}
    assert [name for name, row in rows.items() if row["status"] == "measured"] == NAMES
    assert "none.mha" in rows["none"]["reason"] and "does not exist" in rows["none"]["reason"]
    assert rows["broken"]["reason"] == "OSError: no such dataset"
    assert rows["few"]["gain_DN_per_e"] is None and rows["few"]["frames"] is None
    assert rows["c"]["gain_DN_per_e"] == reports["c"]["gain"]["value"]


def test_a_mosaic_has_a_row_for_each_channel():
    mosaic = itk.simulate_sensor_noise(frames=30, size=(128, 96), bayer="RGGB")[0]
    rows = rows_of(estimate_many({"mosaic": mosaic}, bayer="RGGB"))
    reports = itk.estimate_sensor_noise(mosaic, bayer="RGGB")
    assert [row["channel"] for row in rows] == ["R", "G1", "G2", "B"]
    for row in rows:
        assert (row["name"], row["width"]) == ("mosaic", 64)
        assert row["gain_DN_per_e"] == reports.channel(row["channel"])["gain"]["value"]


def test_without_pandas_there_is_a_list_of_the_same_rows(bursts, monkeypatch):
    with_pandas = estimate_many(bursts)
    monkeypatch.setitem(sys.modules, "pandas", None)
    rows = estimate_many(bursts)
    assert isinstance(rows, list) and rows == rows_of(with_pandas)


def test_types_of_the_columns_are_those_of_a_full_table():
    pandas = pytest.importorskip("pandas")
    table = estimate_many({"bad": "no such file"})
    assert isinstance(table, pandas.DataFrame)
    assert (table.dtypes["frames"], table.dtypes["gain_DN_per_e"], table.dtypes["offset_status"]) == (
        "Int64",
        "float64",
        "object",
    )


def test_lines_hold_the_whole_reports(bursts, reports, tmp_path):
    estimate_many(bursts, output=tmp_path / "x.jsonl", threads=1, method="refined")
    lines = lines_of(tmp_path / "x.jsonl")
    assert [line["name"] for line in lines] == NAMES
    assert all(line["report"] == report for line, report in zip(lines, reports.values(), strict=True))
    assert all(line["settings"] == {} and line["reason"] is None for line in lines)


class Counted:
    """Sources that count how often they are opened; some fail."""

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
    lines.write_bytes(whole[:-1] + b" " * len(whole))  # the last line has no end, as of a killed process
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
    estimate_many({"a": counted.sources["a"]}, output=tmp_path / "x.jsonl")  # another name
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


def test_a_wrong_name_is_told_before_anything_is_measured(bursts):
    counted = Counted(bursts)
    with pytest.raises(ValueError, match="source 1 has the name 3"):
        estimate_many([("a", counted.sources["a"]), (3, counted.sources["b"])])
    assert counted.opened == []


@pytest.mark.parametrize(
    ("sources", "options", "said"),
    [
        ("a.mha", {}, "of one source: "),
        (np.zeros((3, 4, 5)), {}, "sources is of type ndarray"),
        (3, {}, "sources is of type int"),
        ([("a", "x.mha"), ("a", "y.mha")], {}, "source 1 has the name 'a', as another one has"),
        ({3: "a.mha"}, {}, "source 0 has the name 3; expected a str"),
        ([np.zeros((3, 4, 5))], {"output": "x.jsonl"}, r"has no name.*expected \(name, frames\)"),
        ({}, {"output": "x.csv"}, r"ends in .jsonl or .parquet"),
        ({}, {"output": 3}, "output is 3; expected the name"),
        ({}, {"output": "no/such/folder/x.jsonl"}, "cannot be written"),
        ({}, {"maps": True}, "maps is no setting of many sources"),
        ({}, {"methods": "refined"}, "methods is no setting of many sources"),
        ({}, {"dark": iter([]), "output": "x.jsonl"}, "dark is of type list_iterator"),
        ({}, {"client": 3}, "client is of type int"),
    ],
)
def test_wrong_use_is_told(sources, options, said, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError, match=said):
        estimate_many(sources, **options)
    assert not any(tmp_path.glob("*.csv"))


def test_nothing_loads_dask(fresh):
    code = (
        "import sys; sys.modules['dask'] = sys.modules['distributed'] = None\n"
        "import itk, itk_sensornoise.distributed as many\n"
        "stack = itk.simulate_sensor_noise(frames=8, size=(64, 48))[0]\n"
        "print(len(many.estimate_many({'a': stack})))"
    )
    assert fresh(code) == "1\n"


@pytest.fixture(scope="module")
def client():
    distributed = pytest.importorskip("distributed", reason="Dask's distributed is not installed")
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster,
        distributed.Client(cluster) as connected,
    ):
        yield connected


def test_workers_give_the_rows_of_one_process(client, bursts, files, tmp_path):
    from dask import array

    lazy = array.from_array(bursts["a"], chunks=(7, 50, 60))
    sources = {**bursts, "dask": lazy, "lambda": lambda: lazy, **dict(zip("xyz", files, strict=True))}
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


def test_a_burst_is_not_blamed_for_what_its_neighbour_did(bursts):
    distributed = pytest.importorskip("distributed", reason="Dask's distributed is not installed")

    frames = bursts["a"]

    def killed():
        time.sleep(0.5)
        os.kill(os.getpid(), signal.SIGKILL)

    def beside():  # is at work at each end of the only worker
        time.sleep(2)
        return frames

    with (
        distributed.LocalCluster(n_workers=1, threads_per_worker=2, dashboard_address=":0") as cluster,
        distributed.Client(cluster) as client,
    ):
        rows = rows_of(estimate_many({"killed": killed, "beside": beside}, client))
    assert [row["status"] for row in rows] == ["error", "measured"]


@pytest.mark.parametrize("breaks", ["restart", "close"])
def test_a_scheduler_that_restarts_or_goes_away_is_told(breaks, bursts, tmp_path):
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
