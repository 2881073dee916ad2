# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests exports, which are evaluated with the formulas of the programs that read them."""

import io
import json
import re
import struct
import xml.etree.ElementTree as ElementTree

import itk
import itk_sensornoise as sn
import numpy as np
import pytest

BLACK, WHITE = 90.0, 4095.0
LEVELS = np.array([120.0, 500.0, 2000.0, 4000.0])


@pytest.fixture(scope="module")
def report():
    stack, _ = sn.simulate_sensor_noise(frames=40, size=(192, 128), seed=3)
    return sn.estimate_sensor_noise(stack, bayer="none")


@pytest.fixture(scope="module")
def mosaic():
    stack, _ = sn.simulate_sensor_noise(frames=30, size=(192, 128), seed=1, bayer="RGGB")
    return sn.estimate_sensor_noise(stack, bayer="RGGB")


def variance(report, levels=LEVELS):
    """Returns the variance of a pixel according to the report [DN^2]."""
    return report.variance_slope.value * levels + report.total_intercept.value


def of_profile(scale, offset):
    """Returns the variance according to NoiseProfile [DN^2]: sqrt(scale x + offset), with x from 0 at black to 1 at
    white."""
    return (scale * (LEVELS - BLACK) / (WHITE - BLACK) + offset) * (WHITE - BLACK) ** 2


def of_sensor(offset, electrons_per_adu, read_noise):
    """Returns the variance according to the record of a sensor [DN^2]."""
    return ((LEVELS - offset) * electrons_per_adu + read_noise**2) / electrons_per_adu**2


def number_after(text, key):
    return float(re.search(re.escape(key) + r"\s*([-+.0-9eE]+)", text)[1])


def exported(report, name, **options):
    return report.export(name, black=BLACK, white=WHITE, **options)


def test_formats_of_the_line_are_the_line(report):
    expected = pytest.approx(variance(report), rel=1e-6)
    assert of_profile(*map(float, exported(report, "dng").text.split())) == expected
    model = json.loads(exported(report, "deepinv").text)
    assert of_profile(model["gain"], model["sigma"] ** 2) == expected
    model = json.loads(exported(report, "ndsafir").text)
    assert model["gains"][0] * LEVELS + model["offsets"][0] == expected
    model = json.loads(exported(report, "anscombe-transform").text)
    zero = -report.total_intercept.value / report.variance_slope.value
    assert model == {"conversion_gain": report.variance_slope.value, "zero_level": round(zero)}
    arrays = np.load(io.BytesIO(exported(report, "careamics").files["careamics_noise_model.npz"]))
    low, high = arrays["min_signal"], arrays["max_signal"]
    first, second = np.exp(arrays["trained_weight"][1])
    floor = arrays["min_sigma"].item()
    assert np.maximum(floor, first + second * (LEVELS - low) / (high - low)) == expected


def test_records_of_the_sensor_are_the_sensor(report):
    gain, offset, noise = report.gain.value, report.offset.value, report.read_noise.value
    expected = pytest.approx(gain * (LEVELS - offset) + noise**2, rel=1e-6)
    for name, keys in {
        "pyme": ("ADOffset:", "ElectronsPerCount:", "ReadNoise:"),
        "decode": ("baseline:", "e_per_adu:", "read_sigma:"),
    }.items():
        text = exported(report, name).text
        assert of_sensor(*(number_after(text, key) for key in keys)) == expected, name
    for name, keys in {
        "picasso": ("Baseline:", "Sensitivity:"),
        "smap": ('"offset":', '"conversion":'),
        "thunderstorm": ("offset=", "photons2adu="),
    }.items():
        text = exported(report, name).text
        assert of_sensor(*(number_after(text, key) for key in keys), noise / gain) == expected, name
    cards = exported(report, "fits").text
    assert [len(card) for card in cards.split("\n")] == [80, 80, 0]
    assert of_sensor(offset, number_after(cards, "EGAIN   ="), number_after(cards, "RDNOISE =")) == expected
    record = json.loads(exported(report, "ccdproc").text)
    assert of_sensor(*(record[name]["value"] for name in ("offset", "gain", "readnoise"))) == expected
    record = json.loads(exported(report, "lsst").text)
    assert of_sensor(offset, record["gain"]["mono"], record["noise"]["mono"]) == expected
    assert record["gainErr"]["mono"] == pytest.approx(report.gain.standard_error / gain**2)
    section = ElementTree.fromstring(exported(report, "emva1288").text).find("sensitivity")
    values = [float(section.find(f"{name}/Value").text) for name in ("K", "inverse_K", "sigma_d")]
    assert values[0] * values[1] == pytest.approx(1)
    assert of_sensor(offset, *values[1:]) == expected


def test_fitted_formats_say_how_near_they_are(report, mosaic):
    made = exported(report, "libcamera")
    assert set(json.loads(made.text)["rpi.noise"]) == {"reference_constant", "reference_slope"}
    assert re.search(r"differs from the measured one by [0-9.]+ % \(rms\)", made.note)
    records = [{**mosaic.to_dict(), "camera": {"iso_speed": iso}} for iso in (100, 400)]
    made = sn.export_noise_model(records, "android", black=BLACK, white=WHITE)
    model = json.loads(made.text)
    assert model["channels"] == ["R", "Gr", "Gb", "B"]
    assert {len(model[f"noise_model_{name}"]) for name in "ABCD"} == {4}
    assert "differs from the measured variance" in made.note


def test_presets_of_darktable_are_the_line_times_its_factors(mosaic):
    records = [{**mosaic.to_dict(), "camera": {"iso_speed": iso}} for iso in (400, 100)]
    made = sn.export_noise_model(records, "darktable", black=BLACK, white=WHITE)
    (maker,) = json.loads(made.text)["noiseprofiles"]
    presets = maker["models"][0]["profiles"]
    assert [preset["iso"] for preset in presets] == [100, 400]
    greens = (variance(mosaic.channel("G1")) + variance(mosaic.channel("G2"))) / 2
    factor = 0.0463  # calibrate_darktable.py
    assert of_profile(presets[0]["a"][1], presets[0]["b"][1]) / factor == pytest.approx(greens, rel=1e-6)
    with pytest.raises(ValueError, match="no ISO speed"):
        mosaic.export("darktable", black=BLACK, white=WHITE)


def test_a_mosaic_has_a_profile_of_three_planes(mosaic):
    pairs = np.array([float(word) for word in exported(mosaic, "dng").text.split()]).reshape(3, 2)
    lines = {name: variance(mosaic.channel(name)) for name in ("R", "G1", "G2", "B")}
    for pair, expected in zip(pairs, (lines["R"], (lines["G1"] + lines["G2"]) / 2, lines["B"]), strict=True):
        assert of_profile(*pair) == pytest.approx(expected, rel=1e-6)
    with pytest.raises(ValueError, match=r"4 channels.*\(channel=\)"):
        exported(mosaic, "deepinv")
    assert json.loads(exported(mosaic.channel("B"), "deepinv").text)["gain"] == pairs[2, 0]
    assert exported(mosaic, "deepinv", channel="B") == exported(mosaic.channel("B"), "deepinv")
    made = sn.export_noise_model(mosaic.to_dict(), "deepinv", channel="B", black=BLACK, white=WHITE)
    assert made == exported(mosaic.channel("B"), "deepinv")
    for reports, wrong in ((mosaic, "G"), (mosaic.channel("B"), "R"), (mosaic, 3)):
        with pytest.raises((TypeError, ValueError), match=rf'channel is {wrong!r}; expected "R"'):
            exported(reports, "deepinv", channel=wrong)
    with pytest.raises(ValueError, match=r"leave out the channel \(channel=\)"):
        exported(mosaic, "dng", channel="G1")


def test_a_dng_file_gets_the_tag(report, tmp_path):
    levels = ((50706, 1, 4, 0x401), (50714, 4, 1, int(BLACK)), (50717, 4, 1, int(WHITE)))
    tags = b"".join(struct.pack("<HHII", *tag) for tag in levels)
    (tmp_path / "photo.dng").write_bytes(struct.pack("<2sHIH", b"II", 42, 8, 3) + tags + struct.pack("<I", 0))
    made = exported(report, "dng", into=tmp_path / "photo.dng", output=tmp_path / "copy.dng")
    copy = (tmp_path / "copy.dng").read_bytes()
    assert made.files == {"noise_profile.dng": copy}
    (at,) = struct.unpack_from("<I", copy, 4)
    assert struct.unpack_from("<H", copy, at) == (4,)
    tag, kind, count, place = struct.unpack_from("<HHII", copy, at + 2 + 36)
    assert (tag, kind, count) == (51041, 12, 2)
    assert of_profile(*struct.unpack_from("<2d", copy, place)) == pytest.approx(variance(report), rel=1e-6)
    with pytest.raises(ValueError, match=r"white level is 16383 DN .* and the DNG file has"):
        report.export("dng", white=16383, into=tmp_path / "photo.dng")
    with pytest.raises(ValueError, match="expected the format dng"):
        exported(report, "fits", into=tmp_path / "photo.dng")


def test_maps_are_those_of_dark_frames(report, tmp_path):
    options = {"size": (96, 64), "seed": 3}
    stack, _ = sn.simulate_sensor_noise(frames=30, **options)
    dark, _ = sn.simulate_sensor_noise(frames=20, dark=True, **options)
    with_maps = sn.estimate_sensor_noise(stack, bayer="none", dark=dark, maps=True)
    made = with_maps.export("maps", output=tmp_path)
    gain = with_maps.gain.value
    for name, expected in (
        ("SERIAL_off.tiff", with_maps.maps["pixel_offset"]),
        ("SERIAL_var.tiff", with_maps.maps["pixel_read_noise"] ** 2),
        ("dark_ms.tif", with_maps.maps["pixel_offset"]),
        ("variance_ms.tif", (with_maps.maps["pixel_read_noise"] / gain) ** 2),
    ):
        found = itk.array_from_image(itk.imread(tmp_path / name))
        np.testing.assert_allclose(found, expected, rtol=1e-6)
    matrices = pytest.importorskip("scipy.io").loadmat(tmp_path / "smap_camera.mat")
    np.testing.assert_allclose(matrices["offsetmap"], with_maps.maps["pixel_offset"], rtol=1e-6)
    np.testing.assert_allclose(matrices["varmap"], with_maps.maps["pixel_read_noise"] ** 2, rtol=1e-6)
    np.testing.assert_allclose(matrices["gainmap"], np.full((64, 96), 1 / gain), rtol=1e-6)
    with pytest.raises(ValueError, match="5 files"):
        str(made)
    with pytest.raises(ValueError, match="no maps"):
        report.export("maps")


def test_what_is_written_is_what_the_program_writes(report, tmp_path):
    made = exported(report, "fits", output=tmp_path / "cards.txt")
    assert (tmp_path / "cards.txt").read_text() == made.text and str(made) == made.text.rstrip("\n")
    made = exported(report, "careamics")
    made.write(tmp_path / "model.npz")
    assert (tmp_path / "model.npz").read_bytes() == made.files["careamics_noise_model.npz"]
    with pytest.raises(ValueError, match="no text"):
        str(made)
    with pytest.raises(OSError, match="none"):
        made.write(tmp_path / "none" / "model.npz")


def test_reports_may_be_names_of_files(report, mosaic, tmp_path):
    for number, each in enumerate((report, mosaic)):
        name = tmp_path / f"{number}.json"
        name.write_text(each.to_json())
        expected = sn.export_noise_model(each, "dng", black=BLACK, white=WHITE)
        for given in (name, str(name), [name]):
            assert sn.export_noise_model(given, "dng", black=BLACK, white=WHITE).files == expected.files
    with pytest.raises(ValueError, match=r"none\.json cannot be read .*; expected the JSON of a report"):
        sn.export_noise_model("none.json", "dng")


def test_wrong_use_is_refused_with_a_sentence(report):
    with pytest.raises(ValueError, match=r'the format is "lightzone"; expected one of dng'):
        report.export("lightzone")
    with pytest.raises(ValueError, match=r"no black level.*\(black=\)"):
        report.export("dng")
    with pytest.raises(ValueError, match=r"no white level.*\(white=\)"):
        report.export("dng", black=BLACK)
    with pytest.raises(ValueError, match="variance of -"):
        report.export("dng", black=0, white=WHITE)
    with pytest.raises(TypeError, match="black is '90'"):
        report.export("dng", black="90")
    with pytest.raises(TypeError, match="format is 3"):
        report.export(3)
    with pytest.raises(TypeError, match="reports is 3"):
        sn.export_noise_model([3], "dng")
    with pytest.raises(TypeError, match="into is 3"):
        report.export("dng", into=3)
    with pytest.raises(ValueError, match="takes 2 or more"):
        sn.export_noise_model(report, "android")


def test_every_format_is_read_back_above():
    names = {entry["name"] for entry in sn.export_formats()}
    with open(__file__, encoding="utf-8") as tests:
        text = tests.read()
    assert {name for name in names if f'"{name}"' not in text} == set()
    assert {entry["takes"] for entry in sn.export_formats()} <= {"line", "sensor", "maps"}
