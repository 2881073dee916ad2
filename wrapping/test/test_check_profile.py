# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests the comparison of noise profiles of other programs with frames."""

import json

import itk
import itk_sensornoise as sn
import pytest

LEVELS = {"black": 100.0, "white": 4095.0}
CAMERA = {"gain": 0.3, "read_noise": 3.0, "frames": 40, "size": (128, 96)}


@pytest.fixture(scope="module")
def frames():
    return sn.simulate_sensor_noise(reference="texture", seed=5, **CAMERA)[0]


@pytest.fixture(scope="module")
def dark():
    return sn.simulate_sensor_noise(dark=True, seed=6, **CAMERA)[0]


@pytest.fixture(scope="module")
def report(frames, dark):
    return sn.estimate_sensor_noise(frames, dark=dark, bayer="none")


@pytest.mark.parametrize("format", ["dng", "libcamera", "pyme", "picasso", "ndsafir", "careamics", "fits"])
def test_an_export_is_true_of_its_frames(report, tmp_path, format):
    report.export(format, tmp_path / "profile", **LEVELS)
    found = sn.check_noise_profile(report, tmp_path / "profile", **LEVELS)
    assert found and found["schema"] == "itk-sensornoise-check/1", found
    # The formula of libcamera is off near the black level.
    conclusion = "libcamera's formula" if format == "libcamera" else "this model can be used"
    assert all(band["fits"] for band in found["bands"]) and conclusion in str(found)


def test_the_mistake_is_named(report, tmp_path):
    text = report.export("pyme", **LEVELS).text
    start = text.index("ElectronsPerCount: ") + len("ElectronsPerCount: ")
    end = text.index("\n", start)
    (tmp_path / "camera.yaml").write_text(text[:start] + str(1 / float(text[start:end])) + text[end:])
    found = itk.check_noise_profile(report, tmp_path / "camera.yaml")
    assert not found
    assert found["sentence"].startswith(f"the profile {tmp_path}/camera.yaml (pyme) is ")
    assert "e-/ADU and ADU/e- are exchanged" in found["sentence"]


def test_frames_reports_and_files_of_reports_say_the_same(frames, dark, report, tmp_path):
    report.export("ndsafir", tmp_path / "ndsafir.json")
    (tmp_path / "report.json").write_text(report.to_json(), encoding="utf-8")
    expected = sn.check_noise_profile(report, tmp_path / "ndsafir.json")
    assert sn.check_noise_profile(tmp_path / "report.json", tmp_path / "ndsafir.json") == expected
    assert sn.check_noise_profile(frames, tmp_path / "ndsafir.json", dark=dark, bayer="none") == expected


def test_the_tool_says_the_same(report, tool, tmp_path):
    report.export("ndsafir", tmp_path / "ndsafir.json")
    simulate = ("--gain", "0.3", "--read-noise", "3", "--frames", "40", "--size", "128x96", "--reference", "texture")
    tool("simulate-sensor-noise", *simulate, "--seed", "5", "--output", str(tmp_path / "burst.mha"))
    options = ("--check-profile", str(tmp_path / "ndsafir.json"), "--json", str(tmp_path / "record.json"), "--quiet")
    tool("estimate-sensor-noise", str(tmp_path / "burst.mha"), "--bayer", "none", *options)
    record = json.loads((tmp_path / "record.json").read_text(encoding="utf-8"))
    assert sn.check_noise_profile(record, tmp_path / "ndsafir.json") == record["profile_check"]


def test_a_mosaic_has_a_check_for_each_channel(tmp_path):
    stack, _ = sn.simulate_sensor_noise(frames=40, size=(192, 128), bayer="RGGB", seed=1)
    reports = sn.estimate_sensor_noise(stack, bayer="RGGB")
    reports.export("dng", tmp_path / "profile.txt", black=90, white=4095)
    found = sn.check_noise_profile(reports, tmp_path / "profile.txt", black=90, white=4095)
    assert list(found) == ["R", "G1", "G2", "B"] and all(found.values())


def test_wrong_use_is_refused(frames, report, tmp_path):
    report.export("dng", tmp_path / "dng.txt", **LEVELS)
    report.export("ndsafir", tmp_path / "ndsafir.json")
    (tmp_path / "broken.json").write_text('{"gains": [')
    (tmp_path / "nan.json").write_text('{"gains": [NaN], "offsets": [1.0]}')
    (tmp_path / "notes.txt").write_text("no profile")
    for name in ("broken.json", "nan.json"):
        with pytest.raises(ValueError, match=f"{name} begins like JSON, but is none"):
            sn.check_noise_profile(report, tmp_path / name)
    with pytest.raises(ValueError, match=r"notes\.txt"):
        sn.check_noise_profile(report, tmp_path / "notes.txt")
    with pytest.raises(ValueError, match="none.yaml cannot be read"):
        sn.check_noise_profile(report, tmp_path / "none.yaml")
    with pytest.raises(ValueError, match=r"Give the black level in DN \(black=\)"):
        sn.check_noise_profile(report, tmp_path / "dng.txt")
    with pytest.raises(TypeError, match="profile is 3; expected the name"):
        sn.check_noise_profile(report, 3)
    with pytest.raises(TypeError, match="dark was given with a report"):
        sn.check_noise_profile(report, tmp_path / "ndsafir.json", dark=frames)
    with pytest.raises(ValueError, match='method is .published.; expected "refined"'):
        sn.check_noise_profile(frames, tmp_path / "ndsafir.json", method="published")
    published = sn.estimate_sensor_noise(frames, method="published", bayer="none")
    with pytest.raises(ValueError, match="is of the method published"):
        sn.check_noise_profile(published, tmp_path / "ndsafir.json")
