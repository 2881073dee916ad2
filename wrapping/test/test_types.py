# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests type information: attributes, one protocol, overloads, and documentation of every public function."""

import dataclasses
import inspect
import json
import subprocess
import sys
from collections.abc import Mapping
from importlib.metadata import version

import itk
import itk_sensornoise as sn
import pytest

TOP_LEVEL = [entry["path"] for entry in sn.quantity_list() if "." not in entry["path"]]
CHANGES = {"clear", "pop", "popitem", "setdefault", "update"}


@pytest.fixture(scope="module")
def report():
    return sn.estimate_sensor_noise(sn.simulate_sensor_noise(frames=30, size=(96, 64))[0], bayer="none")


@pytest.fixture(scope="module")
def mosaic():
    stack, _ = sn.simulate_sensor_noise(frames=30, size=(96, 64), bayer="RGGB")
    return sn.estimate_sensor_noise(stack, bayer="RGGB")


@pytest.mark.parametrize("path", TOP_LEVEL)
def test_quantities_are_attributes(report, path):
    quantity = getattr(report, path)
    for name in ("value", "standard_error", "status", "unit"):
        assert getattr(quantity, name) == report[path][name]
    interval = report[path]["interval95"]
    assert quantity.interval95 == (None if interval is None else tuple(interval))
    assert report.quantity(path) == quantity and report[path]["unit"] in getattr(type(report), path).__doc__


def test_a_quantity_prints_as_the_table_has_it(report):
    for row in report.quantities():
        text = str(report.quantity(row["path"]))
        is_shown = f"{row['label'].split('sigma^2')[0]}" in str(report) and row["value"] is not None
        assert not is_shown or text.split(" ± ")[0] in str(report)
    assert str(report.gain).endswith(" DN/e⁻") and " ± " in str(report.gain)
    assert str(report.read_noise_median) == "not-identifiable"
    with pytest.raises(dataclasses.FrozenInstanceError):
        report.gain.value = 1.0
    with pytest.raises(KeyError, match="'moon' is no quantity of the report"):
        report.quantity("moon")


def test_both_kinds_of_reports_have_one_protocol(report, mosaic):
    for each in (report, mosaic):
        assert isinstance(each, sn.NoiseReport) and isinstance(each, Mapping)
        assert len(each.quantities()) >= 12
    assert {row["channel"] for row in mosaic.quantities()} == {"R", "G1", "G2", "B"}


def test_a_mosaic_draws_its_channels(mosaic):
    pytest.importorskip("matplotlib").use("svg")
    figure = mosaic.plot()
    assert [axes.get_title() for axes in figure.axes] == ["R", "G1", "G2", "B"]
    assert all(axes.get_lines() for axes in figure.axes)


def test_the_methods_that_would_change_a_record_are_not_offered(report):
    assert not CHANGES & set(dir(report)) and not CHANGES & set(dir(report["gain"]))
    assert {"gain", "items", "keys", "plot", "quantities", "to_html"} <= set(dir(report))
    assert not {"append", "sort"} & set(dir(report["warnings"]))


def test_version_is_that_of_the_distribution():
    assert (
        sn.__version__
        == version("itk-sensornoise")
        == json.loads(itk.estimate_sensor_noise(sn.simulate_sensor_noise(frames=5, size=(32, 32))[0]).to_json())[
            "version"
        ]
    )


@pytest.mark.parametrize("name", sorted(set(sn.__all__) - {"__version__"}))
def test_public_names_are_documented(name):
    documented = getattr(sn, name)
    text = inspect.getdoc(documented)
    assert text and len(text) > 60
    if inspect.isfunction(documented):
        parameters = inspect.signature(documented).parameters
        sections = ["Returns", "See Also", "Examples"] + (["Parameters"] if parameters else [])
        for section in sections:
            assert f"\n{section}\n{'-' * len(section)}\n" in text, section
        assert documented.__annotations__["return"] is not None
        described = text.partition("\nParameters\n----------\n")[2].partition("\nReturns\n")[0]
        names = [line for line in described.split("\n") if line and not line.startswith(" ")]
        assert all(" : " in line or line.startswith("**") for line in names), names


USE = """
from typing import assert_type
import numpy as np
import itk_sensornoise as sn
frames = np.zeros((6, 8, 9), np.uint16)
assert_type(sn.estimate_sensor_noise(frames, bayer="none", offset=100.0), sn.Report)
assert_type(sn.estimate_sensor_noise(frames, bayer="RGGB"), sn.ChannelReports)
assert_type(sn.estimate_sensor_noise(frames, roi=np.s_[1:5, 2:7]), sn.Report | sn.ChannelReports)
report = sn.estimate_sensor_noise(frames, bayer="none", progress=print)
assert_type(report.gain, sn.Quantity)
assert_type(report.gain.value, float | None)
protocol: sn.NoiseReport = sn.estimate_sensor_noise(frames)
protocol.to_html("page.html", title="x")
"""
WRONG = [
    'sn.estimate_sensor_noise(frames, bayer="none", sharpness=1)',
    'sn.estimate_sensor_noise(frames, bayer="moon")',
    'report["gain"] = 1',
    "report.update({})",
    "report.gain.value = 1.0",
]


def checked(tmp_path, source):
    (tmp_path / "use.py").write_text(source)
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), "use.py"]
    return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)


def test_a_type_checker_knows_what_is_returned(tmp_path):
    pytest.importorskip("mypy")
    result = checked(tmp_path, USE)
    assert result.returncode == 0, result.stdout + result.stderr
    result = checked(tmp_path, USE + "\n".join(WRONG))
    lines = {int(line.split(":")[1]) for line in result.stdout.splitlines() if ": error: " in line}
    first = USE.count("\n") + 1
    assert lines == set(range(first, first + len(WRONG))), result.stdout
