# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests that reports that are read from JSON give the same table and figures as reports in C++."""

import json
import math
import pickle

import itk
import itk_sensornoise as sn
import numpy as np
import pytest


def simulated(**options):
    return sn.simulate_sensor_noise(**{"frames": 30, "size": (96, 64), **options})[0]


def ramp_of_exposures():
    stack = np.stack([simulated(frames=1, seed=i, electrons=1000 * (i % 5 + 1))[0] for i in range(25)])
    return sn.estimate_sensor_noise(stack, exposures=[i % 5 + 1 for i in range(25)])


# Options for tables of every kind: quantities, errors and sentences.
KINDS = {
    "refined": lambda: sn.estimate_sensor_noise(simulated()),
    "published": lambda: sn.estimate_sensor_noise(simulated(), method="published"),
    "dark frames and hash": lambda: sn.estimate_sensor_noise(
        simulated(), dark=simulated(electrons=1e-9, seed=4), hash=True
    ),
    "nothing measured": lambda: sn.estimate_sensor_noise(np.full((8, 16, 17), 7, np.uint8)),
    "few frames": lambda: sn.estimate_sensor_noise(simulated()[:8]),
    "repeated frames": lambda: sn.estimate_sensor_noise(np.concatenate([simulated()[:1], simulated()])),
    "filtered": lambda: sn.estimate_sensor_noise(simulated(smoothing=0.6, size=(256, 192))),
    "not linear": lambda: sn.estimate_sensor_noise(simulated(median=1, size=(256, 192))),
    "mixed frames": lambda: sn.estimate_sensor_noise(simulated(temporal_filter=0.4)),
    "floating point": lambda: sn.estimate_sensor_noise(simulated().astype(np.float32)),
    "exposures": ramp_of_exposures,
    "single image": lambda: sn.estimate_sensor_noise(simulated(size=(256, 192))[:1], method="single-image"),
    "single images": lambda: sn.estimate_sensor_noise(simulated(size=(256, 192))[:4], method="single-image"),
}


def require_close(found, expected, path=""):
    """Requires equal records. Numbers may differ by 1e-9, as sums are in another order."""
    if isinstance(expected, dict):
        assert found.keys() == expected.keys(), path
        for name in expected:
            require_close(found[name], expected[name], f"{path}.{name}")
    elif isinstance(expected, list):
        assert len(found) == len(expected), path
        for one, other in zip(found, expected, strict=True):
            require_close(one, other, path)
    elif isinstance(expected, float) and found is not None:
        assert math.isclose(found, expected, rel_tol=1e-9, abs_tol=1e-9), path
    else:
        assert found == expected, path


@pytest.mark.parametrize("kind", KINDS)
def test_a_report_is_whole_again(kind):
    report = KINDS[kind]()
    again = sn.Report.from_json(report.to_json())
    assert again == report and str(again) == str(report) and again.quantities() == report.quantities()
    require_close(again.figure_data, report.figure_data)
    assert again.to_json() == report.to_json() and repr(again) == repr(report)


@pytest.fixture(scope="module")
def report():
    return sn.estimate_sensor_noise(simulated())


@pytest.fixture(scope="module")
def mosaic():
    return sn.estimate_sensor_noise(simulated(bayer="RGGB", size=(192, 128)), bayer="RGGB")


def test_the_channels_of_a_mosaic_are_whole_again(mosaic):
    again = sn.ChannelReports.from_json(mosaic.to_json())
    assert again == mosaic and str(again) == str(mosaic)
    for name in ("R", "G1", "G2", "B"):
        assert str(again.channel(name)) == str(mosaic.channel(name))
    require_close(again.figure_data, mosaic.figure_data)
    assert "joint offset: " in again.to_html()


def test_a_file_is_read_by_its_name(report, tmp_path):
    name = tmp_path / "report.json"
    name.write_text(json.dumps(report), encoding="utf-8")
    for given in (name, str(name)):
        assert sn.Report.from_json(given) == report


def test_a_report_that_was_read_draws_and_has_a_page(report, tmp_path):
    again = sn.Report.from_json(report.to_json())
    pytest.importorskip("matplotlib").use("svg")
    from matplotlib.figure import Figure

    axes = Figure().subplots()
    again.plot(axes)
    np.testing.assert_array_equal(axes.get_lines()[1].get_xdata(), report.figure_data["mean"])
    again.to_html(tmp_path / "page.html", title="Camera <7>")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert page.count("<h1>Camera &lt;7&gt;</h1>") == 1 and "<td" in page and "data:image/svg+xml" in page
    assert str(pickle.loads(pickle.dumps(again))) == str(report)


def test_maps_are_not_in_the_json(report):
    with pytest.raises(KeyError, match="maps=True"):
        sn.Report.from_json(report.to_json()).maps["mean"]


def test_the_title_of_a_page_can_be_given(report, mosaic):
    for each in (report, mosaic):
        page = each.to_html(title="Camera 7")
        assert "<title>Camera 7</title>" in page and "<h1>Camera 7</h1>" in page
        assert len(page) > 20000
    with pytest.raises(TypeError, match="title is 7; expected a str"):
        report.to_html(title=7)


def without(record, name):
    return json.dumps({key: value for key, value in record.items() if key != name})


WRONG = {
    "no file": (lambda report, mosaic: "no-such.json", ValueError, "no-such.json cannot be read"),
    "no JSON": (lambda report, mosaic: "{gain}", ValueError, "the text is no JSON"),
    "no report": (lambda report, mosaic: "{}", ValueError, "the text has no schema; expected"),
    "another schema": (lambda report, mosaic: '{"schema": "x"}', ValueError, "the text has the schema 'x'; expected"),
    "a part": (
        lambda report, mosaic: without(report, "scatter"),
        ValueError,
        "the text lacks scatter; expected the whole",
    ),
    "a mosaic": (
        lambda report, mosaic: mosaic.to_json(),
        ValueError,
        "has the channels of a mosaic; expected one report",
    ),
    "a dict": (lambda report, mosaic: report, TypeError, "the report is of type Report; expected the JSON"),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_is_no_report_is_refused(report, mosaic, case):
    make, kind, words = WRONG[case]
    with pytest.raises(kind, match=words):
        sn.Report.from_json(make(report, mosaic))


def test_one_report_is_no_mosaic(report):
    with pytest.raises(ValueError, match="has one report; expected the reports of a mosaic: Report.from_json"):
        sn.ChannelReports.from_json(report.to_json())


def test_the_tool_s_file_is_read(tool, tmp_path):
    frames = tmp_path / "frames.mha"
    itk.imwrite(itk.image_view_from_array(simulated()), str(frames))
    table = tool("estimate-sensor-noise", frames, "--json", tmp_path / "report.json")
    assert str(sn.Report.from_json(tmp_path / "report.json")) == table.rstrip("\n")
