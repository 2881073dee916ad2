# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the report: an immutable dict that can be printed, drawn, pickled and compared."""

import base64
import copy
import html
import json
import pickle
import re
import sys
from xml.etree import ElementTree

import itk
import itk_sensornoise
import itk_sensornoise._figure
import numpy as np
import pytest


@pytest.fixture(scope="module")
def report(burst):
    return itk.estimate_sensor_noise(burst)


def test_it_is_the_json_record(report):
    record = json.loads(report.to_json())
    assert dict(report) == record and report == record
    assert list(report) == list(record) and len(report) == len(record)
    assert report["schema"] == "itk-sensornoise-report/1"
    assert report["gain"]["unit"] == "DN/e-"
    assert "gain" in report and "moon" not in report and report.get("moon") is None
    with pytest.raises(KeyError):
        report["moon"]


def test_it_recovers_the_truth(report):
    # Camera B has g = 1. The standard error is about sqrt(2 / 60 frames / 6000 pixels), times 3 for the slope of the
    # line.
    assert report["gain"]["value"] == pytest.approx(1.0, abs=5 * 3 * np.sqrt(2 / 60 / 6000))


@pytest.mark.parametrize("travel", [lambda report: pickle.loads(pickle.dumps(report)), copy.copy, copy.deepcopy])
def test_it_travels(report, travel):
    other = travel(report)
    assert type(other) is type(report)
    assert other == report and str(other) == str(report) and other.to_json() == report.to_json()


def test_json_takes_it(report):
    assert (
        json.loads(json.dumps(report)) == json.loads(json.dumps(dict(report), indent=1)) == json.loads(report.to_json())
    )
    assert (
        json.loads(json.dumps({"mine": report["gain"], "scatter": report["scatter"]["mean"]}))["mine"] == report["gain"]
    )


CHANGES = {
    "member": lambda report: report.update(gain=None),
    "item": lambda report: report.__setitem__("gain", None),
    "union": lambda report: report.__ior__({"gain": None}),
    "less": lambda report: report.pop("gain"),
    "less still": lambda report: report.__delitem__("gain"),
    "nothing": lambda report: report.clear(),
    "default": lambda report: report.setdefault("moon", 1),
    "last": lambda report: report.popitem(),
    "value": lambda report: report["gain"].__setitem__("value", 1.0),
    "value in a dict": lambda report: dict(report)["gain"].__setitem__("value", 1.0),
    "warning": lambda report: report["warnings"].append("moon"),
    "warnings": lambda report: report["warnings"].__iadd__(["moon"]),
    "frame": lambda report: report["flicker"].__setitem__(0, 1.0),
    "order": lambda report: report["flicker"].sort(),
    "pair": lambda report: report["motion"][0].insert(0, 1.0),
}


@pytest.mark.parametrize("case", CHANGES)
def test_a_change_is_refused_and_not_lost(report, case):
    with pytest.raises(TypeError, match="the record of a measurement cannot be changed; to_dict"):
        CHANGES[case](report)
    assert report == json.loads(report.to_json())


def test_copies_of_it_can_be_changed(report):
    for record in (report.to_dict(), copy.deepcopy(dict(report)), json.loads(json.dumps(report))):
        record["gain"]["value"] = 7.0
        record["warnings"].append({"code": "mine"})
        assert json.loads(json.dumps(record))["gain"]["value"] == 7.0
    for travel in (copy.copy, copy.deepcopy, lambda member: pickle.loads(pickle.dumps(member))):
        gain, flicker = travel(report["gain"]), travel(report["flicker"])
        assert gain == report["gain"] and flicker == report["flicker"]
        gain["value"], flicker[0] = 7.0, 7.0
    assert report["gain"]["value"] != 7.0 and report["flicker"][0] != 7.0
    assert type(report | {"note": 1}) is dict


def identified(record):
    """Yields all quantities of a record that are identified."""
    if isinstance(record, dict) and record.get("status") == "identified":
        yield record
    for member in record.values() if isinstance(record, dict) else record if isinstance(record, list) else []:
        yield from identified(member)


@pytest.mark.parametrize("options", [{}, {"dark": True}, {"offset": 100}, {"level_range": (500, 2500)}])
def test_what_is_identified_has_an_error_and_an_interval(burst, dark, options):
    report = itk.estimate_sensor_noise(
        burst, **{name: dark if value is True else value for name, value in options.items()}
    )
    found = list(identified(report))
    assert len(found) >= 8 and report["vibration"]["covariance"] in found
    for quantity in found:
        assert quantity["standard_error"] is not None and None not in quantity["interval95"], quantity


def test_it_compares(report, burst):
    assert report != itk.estimate_sensor_noise(burst[:-1])
    assert report == itk.estimate_sensor_noise(burst)


def test_functions_can_be_pickled():
    names = [name for name in dir(itk) if name.endswith(("estimator", "sensor_noise"))]
    assert len(names) >= 6
    for name in names:
        assert pickle.loads(pickle.dumps(getattr(itk, name))) is getattr(itk, name)


def test_table_has_the_values(report):
    row = re.search(r"^gain g +([0-9.]+) ± ([0-9.]+) +DN/e⁻ +identified", str(report), re.MULTILINE)
    gain = report["gain"]
    assert float(row[1]) == pytest.approx(gain["value"], abs=0.05 * gain["standard_error"])
    assert float(row[2]) == pytest.approx(gain["standard_error"], rel=0.05)
    assert not str(report).endswith("\n")
    assert f"{report['gain']['value']:.5g} DN/e-" in repr(report)


def test_plot_draws_the_numbers_of_the_figures(report):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("svg")
    figure = report.plot()
    curve, below = figure.axes
    data = report.figure_data
    before, after, line = curve.get_lines()
    residuals = below.get_lines()[-1]
    for drawn, x, y in (
        (before, "mean", "variance"),
        (after, "mean", "corrected_variance"),
        (line, "line_mean", "line_variance"),
        (residuals, "residual_mean", "residual"),
    ):
        np.testing.assert_array_equal(drawn.get_xydata(), np.column_stack([data[x], data[y]]))
    (band,) = curve.collections
    corners = {tuple(corner) for corner in band.get_paths()[0].vertices}
    for end in ("band_low", "band_high"):
        assert corners.issuperset(zip(data["line_mean"], data[end], strict=True))
    assert line.get_linestyle() == "-" and curve.get_legend().get_title().get_text() == ""
    assert curve.get_ylabel() == "variance [DN$^2$]" and below.get_xlabel() == "mean [DN]"
    matplotlib.pyplot.close(figure)


def test_plot_has_the_colours_of_the_page(report):
    pytest.importorskip("matplotlib").use("svg")
    from matplotlib.figure import Figure

    axes = Figure().subplots()
    report.plot(axes)
    style = report.to_html()
    for drawn, kind in zip(axes.get_lines(), ("before", "after", "third"), strict=True):
        assert f"svg .{kind}{{stroke:{drawn.get_color()}}}" in style


def test_plot_draws_into_given_axes(report):
    pytest.importorskip("matplotlib").use("svg")
    import matplotlib.pyplot as plt
    from matplotlib.figure import Figure

    before = plt.get_fignums()
    figure = Figure()
    left, right = figure.subplots(1, 2)
    assert report.plot(ax=right) is figure and report.plot(right) is figure
    assert len(right.get_lines()) == 6 and not left.get_lines()
    part = figure.subfigures(1, 2)[0].subplots()
    assert report.plot(ax=part) is figure and part.get_lines()
    assert plt.get_fignums() == before


def test_plot_dashes_the_line_where_the_gain_is_not_identified():
    """A gamma curve gives no gain. The line through all levels is drawn dashed."""
    pytest.importorskip("matplotlib").use("svg")
    from matplotlib.figure import Figure

    stack, _ = itk.simulate_sensor_noise(frames=40, size=(128, 96), offset=300, seed=5)
    grey_values = np.clip(4095 * (np.clip(stack - 300.0, 0, None) / 3795) ** 0.45, 20, None)
    report = itk.estimate_sensor_noise(np.rint(grey_values).astype(np.uint16))
    assert "variance-not-affine" in [warning["code"] for warning in report["warnings"]]
    assert report["gain"]["value"] is None
    axes = Figure().subplots()
    report.plot(axes)
    line = axes.get_lines()[2]
    assert line.get_linestyle() == "--" and line.get_label() == "line, indicative: no gain"
    assert report.figure_data["is_indicative"] and not axes.collections
    fit = report["fit"]
    expected = fit["line"]["gain"] * np.array(line.get_xdata()) + fit["line"]["intercept"]
    np.testing.assert_allclose(line.get_ydata(), expected)
    title = axes.get_legend().get_title().get_text()
    assert title == f"the response is non-linear: variance off its line by up to {100 * fit['nonlinearity']:.2g} %"
    assert f"indicative: variance = {fit['line']['gain']:.5g} mean" in str(report)


def test_notebook_shows_table_and_curve(report, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)  # only plot() needs it
    text = report._repr_html_()
    assert "<pre" not in text and all(f">{html.escape(word)}<" in text for word in ("gain g", "DN/e⁻", "identified"))
    (picture,) = re.findall(r'<img [^>]*src="data:image/svg\+xml;base64,([^"]+)"', text)
    curve = base64.b64decode(picture).decode()
    root = ElementTree.fromstring(curve)
    assert root.tag == "{http://www.w3.org/2000/svg}svg" and "prefers-color-scheme:dark" in curve
    drawn = re.search("<svg [^>]*>(.*?)</svg>", report.to_html(), re.DOTALL)[1]
    assert len(drawn) > 5000 and drawn in curve  # the figure of the page
    with pytest.raises(ImportError):
        report.plot()


def test_report_of_nothing_is_shown_and_not_drawn():
    report = itk.estimate_sensor_noise(np.full((8, 16, 17), 7, np.uint8))
    assert report["gain"]["value"] is None
    assert report["warnings"][0]["code"] in report._repr_html_() and "<img" not in report._repr_html_()
    assert "Not measured" in report.to_html() and report.figure_data["mean"] == []
    with pytest.raises(ValueError, match="^the report has no noise curve"):
        report.plot()


@pytest.mark.parametrize("has_tqdm", [True, False])
def test_progress_ends_at_100_percent_on_standard_error(burst, capfd, monkeypatch, has_tqdm):
    if has_tqdm:
        pytest.importorskip("tqdm")
    else:
        monkeypatch.setitem(__import__("sys").modules, "tqdm.auto", None)
    report = itk.estimate_sensor_noise(list(burst), progress=True)
    captured = capfd.readouterr()
    assert captured.out == "" and "100" in captured.err and "%" in captured.err
    assert report == itk.estimate_sensor_noise(burst)


def test_its_quantities_are_rows(report):
    rows = report.quantities()
    assert [row["path"] for row in rows] == [entry["path"] for entry in itk_sensornoise.quantity_list()]
    gain, *_ = rows
    assert gain["label"] == "gain g" and gain["value"] == report["gain"]["value"]
    by_path = {row["path"]: row for row in rows}
    assert by_path["vibration.sd_x"]["interval95"] == report["vibration"]["sd_x"]["interval95"]
    for entry, row in zip(itk_sensornoise.quantity_list(), rows, strict=True):
        assert entry["unit"] == row["unit"] and row["status"]


def test_what_was_not_looked_at_has_no_row(burst):
    rows = itk.estimate_sensor_noise(burst, method="published").quantities()
    assert not [row for row in rows if row["path"].startswith("noise_correlation.")] and len(rows) >= 12


def test_warnings_are_those_of_the_table(burst):
    table = {kind["code"]: kind for kind in itk_sensornoise.warning_table()}
    assert {kind["severity"] for kind in table.values()} == {"note", "warning", "error"}
    warnings = itk.estimate_sensor_noise(burst[:10])["warnings"]
    assert "few-frames" in {warning["code"] for warning in warnings}
    for warning in warnings:
        assert warning["severity"] == table[warning["code"]]["severity"]


def test_the_code_speaks_of_warnings_that_exist():
    table = {kind["code"] for kind in itk_sensornoise.warning_table()}
    assert set(itk_sensornoise._figure.NONLINEARITY_CODES) <= table
