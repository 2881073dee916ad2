# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the page of a report: equal to the page of the tool, and complete or not written, for any kind of report."""

import base64
import copy
import hashlib
import os
import pickle
import re
import struct
import subprocess
import zlib

import itk
import itk_sensornoise
import numpy as np
import pytest

MOSAIC = {"size": (96, 96), "frames": 24, "bayer": "GRBG", "transmission": (0.6, 1.0, 0.4)}
STACKS = {
    "good": lambda: itk.simulate_sensor_noise(frames=60, size=(128, 96), seed=5)[0],
    "failed": lambda: np.full((8, 16, 17), 7, np.uint8),
    "mosaic": lambda: itk.simulate_sensor_noise(**MOSAIC)[0],
}


@pytest.fixture(scope="module", params=STACKS)
def stack(request, tmp_path_factory):
    """Writes a file with frames. Returns its name."""
    name = tmp_path_factory.mktemp("page") / "stack.mha"
    itk.imwrite(itk.image_view_from_array(STACKS[request.param]()), str(name))
    return name


@pytest.fixture(scope="module")
def report(stack):
    return itk.estimate_sensor_noise(stack, hash=True)  # the page of the tool always has the hash


def unpacked(page):
    """Returns the page with uncompressed pictures: the wheel uses ITK's zlib, the tool the system's."""

    def pixels(match):
        picture = base64.b64decode(match[1])
        position, content = 8, b""
        while position < len(picture):
            length, name = struct.unpack(">I4s", picture[position : position + 8])
            data = picture[position + 8 : position + 8 + length]
            content += data if name == b"IDAT" else b""
            position += 12 + length
        return f"pixels of {zlib.decompress(content).hex()}"

    page, pictures = re.subn(r"data:image/png;base64,([^\"]+)", pixels, page)
    assert pictures >= 2
    return page


def assert_same(found, expected):
    """Compares two pages. The last digit of a number may differ, as the tool adds 4-byte numbers in another order."""
    number = re.compile(r"(\d+\.\d+)")
    for ours, theirs in zip(number.split(found), number.split(expected), strict=True):
        if ours != theirs:
            assert len(ours) == len(theirs) and number.fullmatch(ours)
            decimals = len(theirs.partition(".")[2])
            assert float(ours) == pytest.approx(float(theirs), abs=1.01 * 10**-decimals)


def test_the_page_is_the_tool_s(tool, stack, report, tmp_path):
    try:
        tool("estimate-sensor-noise", stack, "--quiet", "--plot", tmp_path / "tool.html")
    except subprocess.CalledProcessError as error:
        assert error.returncode == 3 and "nothing-to-measure" in error.stderr
    report.to_html(tmp_path / "page.html")
    ours, theirs = (unpacked((tmp_path / name).read_text(encoding="utf-8")) for name in ("page.html", "tool.html"))
    # The tool knows the name and the date of the file.
    assert f"<h1>Noise of {stack.name}</h1>" in theirs and '<span class="date">' in theirs
    title = re.search(r"<h1>Noise of (.*?)</h1>", ours)[1]
    theirs = re.sub(r'<span class="date">.*?</span>', "", theirs).replace(stack.name, title)
    if "not computed: built without OpenSSL" in theirs:
        pytest.skip("the tool was built without OpenSSL: its page has no hash")
    assert hashlib.sha256(stack.read_bytes()).hexdigest() in ours
    assert_same(ours, theirs)


@pytest.mark.parametrize("travel", [lambda report: pickle.loads(pickle.dumps(report)), copy.copy, copy.deepcopy])
def test_pictures_travel(report, travel):
    other = travel(report)
    assert other.to_html() == report.to_html()
    assert other.figure_data == report.figure_data and other._repr_html_() == report._repr_html_()


@pytest.mark.parametrize("name", ["page.html", "PAGE.HTM"])
def test_a_page_takes_the_place_of_a_file(report, tmp_path, name):
    path = tmp_path / name
    path.write_text("old")
    assert report.to_html(path) is None and report.to_html(str(path)) is None
    assert path.read_text(encoding="utf-8") == report.to_html()
    assert os.listdir(tmp_path) == [name]


def test_a_link_stays_one(report, tmp_path):
    (tmp_path / "there").mkdir()
    (tmp_path / "link.html").symlink_to(tmp_path / "there" / "page.html")
    report.to_html(tmp_path / "link.html")
    assert (tmp_path / "link.html").is_symlink() and os.listdir(tmp_path / "there") == ["page.html"]


def test_a_page_that_cannot_be_written_leaves_the_old_one(report, tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device", "elsewhere")

    path = tmp_path / "page.html"
    path.write_text("old")
    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(OSError, match="No space left on device: .*page.html"):
        report.to_html(path)
    assert path.read_text() == "old" and os.listdir(tmp_path) == ["page.html"]


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("{}", "path is '.*', a folder; expected the name of a file that ends in .html or .htm"),
        ("{}/a.html", "path is '.*', a folder; expected the name of a file that ends in .html or .htm"),
        ("{}/page.svg", r"path is '.*page.svg'; expected the name of a file that ends in .html or .htm"),
        ("", "path is ''; expected the name of a file"),
        (7, "path is 7; expected the name of a file"),
    ],
)
def test_other_names_are_refused(report, tmp_path, path, expected):
    (tmp_path / "a.html").mkdir()
    with pytest.raises(ValueError, match=f"^{expected}"):
        report.to_html(path.format(tmp_path) if isinstance(path, str) else path)
    assert os.listdir(tmp_path) == ["a.html"]


def test_a_folder_that_is_missing_is_said(report, tmp_path):
    with pytest.raises(FileNotFoundError, match="no-such/page.html"):
        report.to_html(tmp_path / "no-such" / "page.html")


def test_a_channel_has_its_own_pictures():
    reports = itk.estimate_sensor_noise(STACKS["mosaic"](), bayer="GRBG")
    assert list(reports.figure_data) == ["R", "G1", "G2", "B"]
    for name, data in reports.figure_data.items():
        channel = reports.channel(name)
        assert channel.figure_data == data
        assert data["mean"] == channel["scatter"]["mean"] and data["flicker"] == channel["flicker"]
        assert channel.to_html().startswith("<!DOCTYPE html>")
    pictures = re.findall(r"<span>(\w+)</span><img [^>]*base64,([^\"]+)", reports._repr_html_())
    assert [name for name, _ in pictures] == list(reports.figure_data)
    assert len({base64.b64decode(curve) for _, curve in pictures}) == 4


def test_figure_data_are_those_of_the_record(burst):
    report = itk.estimate_sensor_noise(burst)
    data = report.figure_data
    for name in ("mean", "variance", "corrected_variance"):
        assert data[name] == report["scatter"][name]
    assert data["flicker"] == report["flicker"]
    assert list(map(list, zip(data["motion_x"], data["motion_y"], strict=True))) == report["motion"]
    assert data["lags"] == report["noise_correlation"]["space"] + report["noise_correlation"]["time"]
    line = report["variance_slope"]["value"] * np.array(data["line_mean"]) + report["total_intercept"]["value"]
    np.testing.assert_allclose(data["line_variance"], line)
    data["mean"].clear()  # data is a copy
    assert report.figure_data["mean"]
    assert report.figure_data["residual_spread"] >= 1 and len(data["residual"]) == len(report["scatter"]["mean"])


@pytest.mark.parametrize("given", [{"method": "published"}, {"dark": True}])
def test_the_line_is_the_report_s(burst, dark, given):
    report = itk.estimate_sensor_noise(burst, **({"dark": dark} if "dark" in given else given))
    data = report.figure_data
    line = report["variance_slope"]["value"] * np.array(data["line_mean"]) + report["total_intercept"]["value"]
    assert len(line) > 2 and not data["is_indicative"]
    np.testing.assert_allclose(data["line_variance"], line)


def test_a_regression_has_a_page_without_a_curve(burst):
    mean, variance, valid = itk.temporal_statistics_image_filter(burst)
    report = itk.noise_regression_estimator(mean, variance, valid)
    assert "No point of the noise curve was measured." in report.to_html()
    assert report.figure_data["mean"] == [] and "<img" not in report._repr_html_()
    with pytest.raises(ValueError, match="no noise curve"):
        report.plot()


def test_a_record_of_text_alone_has_table_and_curve(burst):
    measured = itk.estimate_sensor_noise(burst)
    report = itk_sensornoise.Report(measured.to_json())
    assert str(report) == str(measured) and report.to_html().count("<img ") == 1
    assert report._repr_html_() in report.to_html()
