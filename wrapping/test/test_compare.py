# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the comparison of reports, with differences in units of their errors."""

import math
import re

import itk_sensornoise as sn
import pytest


def measured(**options):
    return sn.estimate_sensor_noise(sn.simulate_sensor_noise(**{"frames": 30, "size": (96, 64), **options})[0])


@pytest.fixture(scope="module")
def reports():
    return {"May": measured(seed=1), "June": measured(seed=2), "July": measured(seed=3, gain=1.2)}


def test_differences_are_in_units_of_their_errors(reports):
    comparison = sn.compare(reports)
    assert comparison.labels == ("May", "June", "July")
    gain = next(row for row in comparison.rows if row.path == "gain")
    may, june, _ = (report.gain for report in reports.values())
    assert gain.quantities == tuple(report.gain for report in reports.values()) and gain.differences[0] is None
    error = math.hypot(may.standard_error, june.standard_error)
    assert gain.differences[1] == pytest.approx((june.value - may.value) / error)
    # For the same camera, chance exceeds 4 standard errors once in 16,000. The other gain differs by 0.2 with an error
    # of 0.008.
    assert abs(gain.differences[1]) < 4 and gain.differences[2] > 15


def test_the_table_has_quantities_as_rows_and_reports_as_columns(reports):
    text = str(sn.compare(reports))
    assert re.search(r"^quantity +unit +May +June +July$", text, re.MULTILINE)
    number = r"[0-9.]+ ± [0-9.]+"
    assert re.search(
        rf"^gain g +DN/e⁻ +{number} +{number} \([+-][0-9.]+\) +{number} \(\+[0-9.]+ !\)$", text, re.MULTILINE
    )
    value = re.search(r"^gain g +([0-9.]+ ± [0-9.]+) +DN", str(reports["May"]), re.MULTILINE)[1]
    assert value in text
    html = sn.compare(reports)._repr_html_()
    assert html.count("<table>") == 1 and value in html and "<pre>" not in html


def test_files_lists_and_labels(reports, tmp_path):
    files = [tmp_path / "a.json", tmp_path / "b.json"]
    for file, report in zip(files, reports.values(), strict=False):
        file.write_text(report.to_json(), encoding="utf-8")
    comparison = sn.compare(files)
    assert comparison.labels == ("a.json", "b.json")
    assert comparison.rows == sn.compare([reports["May"], reports["June"]]).rows
    assert sn.compare(list(reports.values())).labels == ("report 1", "report 2", "report 3")
    assert sn.compare(files, labels=["x", "y"]).labels == ("x", "y")
    rows = comparison.to_rows()
    assert rows[0]["path"] == "gain" and rows[1]["report"] == "b.json" and rows[1]["difference"] is not None


def test_channels_are_compared_with_the_same_channel():
    mosaics = [measured(seed=seed, bayer="RGGB", size=(192, 128)) for seed in (1, 2)]
    mosaics = [mosaic if isinstance(mosaic, sn.ChannelReports) else None for mosaic in mosaics]
    comparison = sn.compare(mosaics)
    assert comparison.labels[0] == "report 1 R" and comparison.labels[-1] == "report 2 B"
    gain = comparison.rows[0]
    assert [difference is None for difference in gain.differences] == 4 * [True] + 4 * [False]


def test_it_has_a_page(reports, tmp_path):
    assert sn.compare(reports).to_html(tmp_path / "page.html", title="Three months") is None
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "<h1>Three months</h1>" in page and "June" in page
    assert "<title>Comparison of noise reports</title>" in sn.compare(reports).to_html()


@pytest.mark.parametrize(
    "given, kind, words",
    [
        (lambda reports: reports["May"], TypeError, "reports is of type Report; expected a list"),
        (lambda reports: "a.json", TypeError, "reports is of type str; expected a list"),
        (lambda reports: 3, TypeError, "reports is of type int; expected a list"),
        (lambda reports: [reports["May"]], ValueError, "reports has 1 report; expected 2 or more"),
        (lambda reports: [reports["May"], 7], TypeError, "report 2 is of type int; expected a report"),
        (lambda reports: [reports["May"], "no-such.json"], ValueError, "no-such.json cannot be read"),
    ],
)
def test_what_cannot_be_compared_is_refused(reports, given, kind, words):
    with pytest.raises(kind, match=f"^{words}"):
        sn.compare(given(reports))


def test_labels_are_one_a_report(reports):
    with pytest.raises(ValueError, match="^labels has 1 names for 3 reports; expected one for each"):
        sn.compare(reports, labels=["x"])
    with pytest.raises(TypeError, match="^labels is 'abc'; expected one str for each report"):
        sn.compare(reports, labels="abc")
