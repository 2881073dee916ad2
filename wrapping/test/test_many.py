# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests many bursts in one call: the table, and the errors for wrong arguments."""

import os
import sys

import itk
import numpy as np
import pytest
from itk_sensornoise import quantity_list
from itk_sensornoise.distributed import estimate_many
from many_bursts import NAMES, rows_of


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


def test_sources_are_named_by_their_files(burst_files, bursts, tmp_path):
    for name, frame in zip("xyz", np.array_split(bursts["a"], 3), strict=True):
        np.save(tmp_path / name, frame)
    frames = [os.fspath(tmp_path / f"{n:02}.mha") for n in range(30)]
    for name, frame in zip(frames, bursts["a"], strict=True):
        itk.imwrite(itk.image_view_from_array(frame), name)
    sources = [burst_files[0], frames, ("opened there", lambda: bursts["a"]), bursts["a"]]
    rows = rows_of(estimate_many(iter(sources)))
    assert [row.pop("name") for row in rows] == [
        burst_files[0],
        f"{frames[0]} to {frames[-1]}",
        "opened there",
        "source 3",
    ]
    assert all(row == rows[0] for row in rows)


def test_a_bad_burst_is_a_row_with_its_reason(bursts, reports, tmp_path):
    dask_array = pytest.importorskip("dask.array")

    def broken():
        raise OSError("no such\ndataset")

    sources = {"a": bursts["a"], "few": bursts["a"][:1], "none": tmp_path / "none.mha", "broken": broken} | bursts
    sources["masked"] = dask_array.ma.masked_greater(dask_array.from_array(bursts["a"]), 100)
    rows = {row["name"]: row for row in rows_of(estimate_many(sources))}
    assert [name for name, row in rows.items() if row["status"] == "measured"] == NAMES
    assert "none.mha" in rows["none"]["reason"] and "does not exist" in rows["none"]["reason"]
    assert rows["broken"]["reason"] == "OSError: no such dataset"
    assert rows["masked"]["reason"].startswith("frames is a masked array, expected a plain one")
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
def test_wrong_use_is_refused(sources, options, said, tmp_path, monkeypatch):
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
