# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests notebooks: each result is an HTML table and one figure, and a plot is shown once."""

import base64
import html
import json
import re
from xml.etree import ElementTree

import itk_sensornoise as sn
import numpy as np
import pytest

HEADERS = {"table", "thead", "tbody", "tr", "th", "td", "p", "figure", "img", "div", "br", "span"}


def simulated(**options):
    return sn.simulate_sensor_noise(**{"frames": 40, "size": (128, 96), "reference": "texture", **options})[0]


@pytest.fixture(scope="module")
def results():
    report = sn.estimate_sensor_noise(simulated())
    return {
        "report": report,
        "report of JSON": sn.Report.from_json(report.to_json()),
        "mosaic": sn.estimate_sensor_noise(simulated(bayer="RGGB", size=(192, 128)), bayer="RGGB"),
        "correlation": sn.noise_correlation_estimator(simulated(reference="flat", smoothing=0.6)),
        "check": sn.check_noise_model(simulated(seed=2, gain=1.2), report),
    }


@pytest.mark.parametrize("name", ["report", "report of JSON", "mosaic", "correlation", "check"])
def test_a_result_is_a_table_and_one_figure(results, name):
    text = results[name]._repr_html_()
    assert "<pre" not in text and text.count("<table>") == 1 and text.count("<figure") == 1
    assert set(re.findall("<([a-z]+)", text)) <= HEADERS
    assert "white-space:nowrap" in text  # a number and its error stay on one line
    pictures = re.findall(r'src="data:image/svg\+xml;base64,([^"]+)"', text)
    assert len(pictures) == (4 if name == "mosaic" else 1)
    for picture in pictures:
        assert ElementTree.fromstring(base64.b64decode(picture)).tag == "{http://www.w3.org/2000/svg}svg"


def cells_of(text):
    return [[html.unescape(cell) for cell in re.findall("<td[^>]*>(.*?)</td>", row)] for row in text.split("<tr>")]


def test_numbers_are_those_of_the_text(results):
    report = results["report"]
    found = {row[0]: row[1:] for row in cells_of(report._repr_html_()) if row}
    lines = [line for line in str(report).split("\n") if " identified " in line]
    assert len(found) == len(lines) == 9
    for line in lines:
        value, unit, status, limits = found[line[:24].strip()]
        assert re.sub(r"\s+", " ", line[24:]).strip() == f"{value} {unit} {status} {limits}"
    assert found["gain g"][:2] == [str(report.gain).removesuffix(" DN/e⁻"), "DN/e⁻"]
    channel = results["mosaic"].channel("G1")
    row = next(row for row in cells_of(results["mosaic"]._repr_html_()) if row and row[0] == "gain g")
    assert row[2] == str(channel.gain).removesuffix(" DN/e⁻") and row[5] == "DN/e⁻"


def test_the_sentences_are_there(results):
    assert "11408 of 12288 pixels used" in results["report"]._repr_html_()
    assert results["check"]["sentence"].split(" DN")[0].replace("+-", "±") in html.unescape(
        results["check"]._repr_html_()
    )
    assert "joint vibration" in results["mosaic"]._repr_html_()
    warned = sn.estimate_sensor_noise(simulated()[:8])
    assert html.escape(warned["warnings"][0]["message"].split("+-")[0]) in warned._repr_html_()


def test_nothing_measured_is_a_table_without_a_figure():
    report = sn.estimate_sensor_noise(np.full((8, 16, 17), 7, np.uint8))
    assert "<table>" in report._repr_html_() and "<figure" not in report._repr_html_()
    few = sn.noise_correlation_estimator(simulated()[:, :20, :40])
    assert "<table>" in few._repr_html_() and "<figure" not in few._repr_html_()


@pytest.mark.parametrize("indent", [None, 1])
@pytest.mark.parametrize("name", ["report", "mosaic", "correlation", "check"])
def test_json_takes_every_result(results, name, indent):
    assert json.loads(json.dumps({"found": results[name]}, indent=indent))["found"] == results[name]
    assert json.loads(results[name].to_json()) == results[name].to_dict() == results[name]


def test_a_check_that_fails_is_false_and_does_not_change(results):
    check = results["check"]
    assert not check and len(check) > 2
    with pytest.raises(TypeError, match="cannot be changed"):
        check["verdict"] = "fits"


CELLS = {
    "last line": ("report.plot()", 1),
    "not the last line": ("figure = report.plot()\nNone", 1),
    "value": ("figure = report.plot()\nfigure", 1),
    "later cell": ("figure", 1),
    "mosaic": ("mosaic.plot()", 1),
}


def test_a_plot_is_shown_once():
    pytest.importorskip("matplotlib")
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    setup = (
        "import itk_sensornoise as sn\n"
        "make = lambda **more: sn.simulate_sensor_noise(frames=20, size=(64, 48), **more)[0]\n"
        "report = sn.estimate_sensor_noise(make(), bayer='none')\n"
        "mosaic = sn.estimate_sensor_noise(make(bayer='RGGB'), bayer='RGGB')"
    )
    cells = [nbformat.v4.new_code_cell(source) for source in (setup, *(source for source, _ in CELLS.values()))]
    notebook = nbformat.v4.new_notebook(cells=cells)
    nbclient.NotebookClient(notebook, timeout=120).execute()
    for name, cell in zip(CELLS, notebook.cells[1:], strict=True):
        pictures = [output for output in cell.outputs if "image/png" in output.get("data", {})]
        assert len(pictures) == CELLS[name][1], name
