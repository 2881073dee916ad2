# SPDX-FileCopyrightText: the ITKSensorNoise contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests denoise_with_noise_model(): any denoiser of unit Gaussian noise between transform and exact inverse."""

import importlib.util
import json
import subprocess
import sys

import itk
import numpy as np
import pytest

B = {"variance_slope": 1.0, "total_intercept": 64.0 - 100.0 + 1 / 12}  # g = 1 DN/e-, mu = 100 DN, sigma = 8 DN
has_opencv = pytest.mark.skipif(importlib.util.find_spec("cv2") is None, reason="OpenCV (cv2) is not installed")


def record(**more):
    """Returns a report of camera B without offset."""
    return {
        "schema": "itk-sensornoise-report/1",
        "offset": {"value": None, "status": "not-identifiable"},
        "variance_slope": {"value": B["variance_slope"], "status": "identified"},
        "total_intercept": {"value": B["total_intercept"], "status": "identified"},
        "quantisation_step": 1,
        "clip_low": 0,
        "clip_high": 4095,
        "scatter": {"mean": [150, 1000, 3500]},
        **more,
    }


def box(frame):
    """Returns the mean of 3 x 3 pixels."""
    height, width = frame.shape
    padded = np.pad(frame, 1, mode="edge")
    return sum(padded[y : y + height, x : x + width] for y in range(3) for x in range(3)) / 9


@pytest.fixture(scope="module")
def scene():
    """Returns a frame of camera B, and the same frame with 1e5 times the electrons: 1/316 of the shot noise."""
    static = {"frames": 1, "size": (96, 96), "flicker_sd": 0.0, "vibration_sd": (0.0, 0.0), "seed": 7}
    noisy, _ = itk.simulate_sensor_noise(**static)
    truth, _ = itk.simulate_sensor_noise(**static, gain=1e-5, electrons=3e8, read_noise=0.0)
    return noisy[0], truth[0].astype(np.float64)


def psnr_gain(noisy, clean, truth):
    return 10 * np.log10(np.mean((noisy - truth) ** 2) / np.mean((clean - truth) ** 2))


def test_mean_of_many_is_unbiased():
    """On a uniform dark frame the result is the inverse of the stabilised mean. It is 1/4 e- above the algebraic
    inverse. Its error is the error of the mean of 10^4 pixels of variance 64 + 10: 0.09 DN."""
    random = np.random.default_rng(1)
    levels = (100.0 + random.poisson(10.0, (100, 100)) + random.normal(0, 8, (100, 100))).astype(np.float32)
    clean = itk.denoise_with_noise_model(levels, None, lambda frame: np.full_like(frame, frame.mean()), **B)
    assert np.ptp(clean) == 0 and clean.dtype == np.float32
    assert clean.flat[0] == pytest.approx(110.0, abs=3 * 0.09)


def test_identity_gives_the_inverse_of_the_transform(scene):
    noisy, _ = scene
    stabilised = itk.generalized_anscombe_image_filter(noisy, **B)
    expected = itk.inverse_generalized_anscombe_image_filter(stabilised, **B, dtype="uint16")
    np.testing.assert_array_equal(itk.denoise_with_noise_model(noisy, record(), lambda frame: frame), expected)


def test_noise_that_the_denoiser_sees_is_unit_gaussian():
    random = np.random.default_rng(2)
    levels = np.linspace(200, 3000, 400)[:, np.newaxis] + np.zeros((1, 400))
    noisy = (100 + random.poisson(levels - 100) + random.normal(0, 8, levels.shape)).astype(np.float32)
    seen = []
    itk.denoise_with_noise_model(noisy, record(), lambda frame: seen.append(frame.copy()) or frame)
    variance = seen[0].var(axis=1, ddof=1)  # of 400 pixels; standard error 0.07 of a row, 0.0035 of all
    assert seen[0].dtype == np.float32 and variance.mean() == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize("denoiser, least", [(box, 0.0), ("itk", 3.0), pytest.param("nlm", 5.0, marks=has_opencv)])
def test_psnr_rises(scene, denoiser, least):
    noisy, truth = scene
    clean = itk.denoise_with_noise_model(noisy, record(), denoiser)
    assert clean.dtype == noisy.dtype and clean.shape == noisy.shape
    if denoiser is box:  # it blurs the edges of the chart: only uniform areas are tested
        even = np.abs(truth - box(truth)) < 1
        noisy, clean, truth = noisy[even], clean[even], truth[even]
        least = 6.0  # the closed form is 9.5 dB
    assert psnr_gain(noisy, clean, truth) > least


def test_types_images_and_stacks(grey_values, pixel):
    stack = grey_values[:3].astype(pixel)
    model = {"variance_slope": 0.07, "total_intercept": 1.44 - 0.84 + 1 / 12}
    clean = itk.denoise_with_noise_model(stack, None, box, **model)
    assert clean.shape == stack.shape and clean.dtype == stack.dtype
    for found, frame in zip(clean, stack, strict=True):
        np.testing.assert_array_equal(found, itk.denoise_with_noise_model(frame, None, box, **model))
    image = itk.image_from_array(stack)
    image.SetSpacing([0.5, 2.0, 1.0])
    made = itk.denoise_with_noise_model(image, None, box, **model)
    assert type(made) is type(image) and list(made.GetSpacing()) == [0.5, 2.0, 1.0]
    np.testing.assert_array_equal(itk.array_from_image(made), clean)
    np.testing.assert_array_equal(itk.array_from_image(image), stack)
    real = itk.denoise_with_noise_model(stack, None, box, **model, dtype="float32")
    assert real.dtype == np.float32
    if stack.dtype.kind != "f":
        assert np.abs(real - clean.astype(np.float64)).max() <= 0.5 + 1e-4  # 1e-4: float32


def test_array_of_another_byte_order_and_report_on_file(scene, tmp_path):
    noisy, _ = scene
    name = tmp_path / "report.json"
    name.write_text(json.dumps(record()))
    expected = itk.denoise_with_noise_model(noisy, record(), box)
    np.testing.assert_array_equal(itk.denoise_with_noise_model(noisy.astype(">u2"), name, box), expected)


@pytest.mark.parametrize("denoiser", ["itk", pytest.param("nlm", marks=has_opencv)])
def test_same_as_the_tool(scene, tool, tmp_path, denoiser):
    noisy, _ = scene
    (tmp_path / "report.json").write_text(json.dumps(record()))
    itk.imwrite(itk.image_view_from_array(noisy), str(tmp_path / "frame.tif"))
    arguments = ["--report", tmp_path / "report.json", tmp_path / "frame.tif", tmp_path / "clean.tif"]
    try:
        tool("denoise-with-noise-model", "--denoiser", denoiser, *arguments)
    except subprocess.CalledProcessError:
        pytest.skip(f"the tool was built without {denoiser}")
    found = itk.array_from_image(itk.imread(str(tmp_path / "clean.tif"))).astype(int)
    clean = itk.denoise_with_noise_model(noisy, record(), denoiser).astype(int)
    assert np.abs(found - clean).max() <= 1  # another version of ITK or OpenCV may round otherwise
    assert np.mean(found != clean) < 0.01


def test_missing_opencv_is_said(scene, monkeypatch):
    monkeypatch.setitem(sys.modules, "cv2", None)
    with pytest.raises(ImportError, match=r"itk-sensornoise\[denoise\].*denoiser=\"itk\""):
        itk.denoise_with_noise_model(scene[0], record())


def test_bad_reports(scene):
    def quantity(value):
        return {"value": value, "status": "failed"}

    for report, words in (
        ({"schema": "other/1"}, "schema"),
        (record(variance_slope=quantity(None)), "variance_slope has no value"),
        (record(total_intercept=quantity(None)), "total_intercept has no value"),
        (record(variance_slope=quantity(0.0)), "variance_slope is 0"),
        (record(variance_slope=quantity(-1.0)), "variance_slope is -1"),
        ("no-such.json", "no-such.json cannot be read"),
        (None, "there is no noise model"),
    ):
        with pytest.raises(ValueError, match=words):
            itk.denoise_with_noise_model(scene[0], report, box)


def test_other_scales(scene):
    noisy, _ = scene
    with pytest.raises(ValueError, match="multiples of 16"):
        itk.denoise_with_noise_model(noisy * 16, record(), box)
    with pytest.raises(ValueError, match="another scale.*attains 4095"):
        itk.denoise_with_noise_model(noisy * np.float32(15.8), record(), box)
    with pytest.raises(ValueError, match="another scale.*zero signal"):
        itk.denoise_with_noise_model(noisy / np.float32(200), record(), box)
    with pytest.raises(ValueError, match="another scale.*brightest"):
        itk.denoise_with_noise_model(noisy, record(scatter={"mean": [60, 100]}), box)
    with pytest.warns(UserWarning, match="far brighter"):
        itk.denoise_with_noise_model(noisy, record(scatter={"mean": [150, 300]}), box)


def test_bad_images_and_denoisers(scene):
    noisy, _ = scene
    nan = noisy.astype(np.float32)
    nan[3, 4] = np.nan
    for image, words in (
        (nan, "1 pixels that are NaN"),
        (noisy[0], "shape"),
        (noisy.astype(np.int32), "int32"),
        (np.zeros((0, 4), np.uint8), "shape"),
        ("frame.tif", "str"),
    ):
        with pytest.raises(ValueError, match=words):
            itk.denoise_with_noise_model(image, record(), box)
    for denoiser, words in (
        ("median", "denoiser is 'median'"),
        (None, "denoiser is None"),
        (lambda frame: frame[1:], "shape"),
        (lambda frame: frame * np.nan, "NaN"),
        (lambda frame: None, "NoneType"),
    ):
        with pytest.raises(ValueError, match=words):
            itk.denoise_with_noise_model(noisy, record(), denoiser)
    for strength in (0, -1, np.nan, 11, "1"):
        with pytest.raises(ValueError, match="strength"):
            itk.denoise_with_noise_model(noisy, record(), "itk", strength=strength)


def test_denoiser_of_a_package_that_is_not_installed_is_named(burst, monkeypatch):
    getattr(itk, "BilateralImageFilter", None)  # loads the module of ITK: the class then is an ordinary attribute
    monkeypatch.delattr(itk, "BilateralImageFilter", raising=False)
    with pytest.raises(ImportError, match=r"itk-filtering.*pip install itk-sensornoise\[itk\]"):
        itk.denoise_with_noise_model(burst[0], denoiser="itk", variance_slope=1.0, total_intercept=-36.0)
